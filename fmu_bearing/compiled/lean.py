"""Numba as a front end alone: each kernel to LLVM code once, nothing optimised or made executable on the way.

For every kernel Numba also makes a wrapper for Python and one for C, links the kernel with all that it calls,
optimises the whole and emits machine code. An ahead-of-time build needs none of that: 700 times. Here the
code of each kernel is kept as text, and what a unit reaches is linked once.

Kernels use less than Numba offers, and what they do not use is left out: they neither allocate (no references
are counted) nor raise (calls have no status; a kernel that raises is refused), have no closures (few passes),
and index flat arrays from their begin (`flat`).

This reaches into Numba: it is used with the versions that `settings` names; `lower` has the plain way for
others. Both ways compute the same bits: a test compares them for every entry.
"""

import functools
import operator
from collections.abc import Iterable
from typing import Any

import llvmlite.binding as llvm
from llvmlite.ir import Constant, Function, FunctionType, IRBuilder
from numba import _dynfunc, core, types  # type: ignore[attr-defined]
from numba.core.runtime.context import NRTContext

from fmu_bearing.compiled import flat
from fmu_bearing.compiled.errors import BuildError

__all__ = ["install", "modules"]

_RAISES = tuple(kind for name, kind in vars(core.ir).items() if name.endswith("Raise"))


class Library(core.codegen.JITCodeLibrary):
    """Keeps the code of one kernel as text, and the libraries of the kernels that it calls."""

    def add_ir_module(self, ir_module: Any) -> None:
        """Keep a module."""
        self.__dict__.setdefault("texts", []).append(core.cgutils.normalize_ir_text(str(ir_module)))

    def add_linking_library(self, library: Any) -> None:
        """Remember a library that is called."""
        self._linking_libraries.append(library)

    def finalize(self) -> None:
        """Take no more code."""
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Return no address: nothing is executable."""
        return 0


@functools.cache
def install() -> None:
    """Turn Numba in this process into a front end, once for all units; not to be undone."""
    context: Any = core.cpu.CPUContext
    counting: Any = NRTContext
    core.registry.cpu_target.target_context.codegen()._library_class = Library
    context.get_executable, context.create_cpython_wrapper = _no_executable, _nothing
    context.create_cfunc_wrapper = _wrap_entry
    counting.incref = counting.decref = _nothing
    # Consistency of Numba's own passes is checked after each of them: 15 % of the time.
    core.compiler_machinery.PassManager._ENFORCING = False
    _take_plain_arguments()
    _refuse_raises()
    _call_without_status()
    _run_few_passes()
    _remember_calls()
    _emit_operators()
    flat.install()


def modules(functions: Iterable[Any]) -> list[llvm.ModuleRef]:
    """Return the code of compiled C functions and of all that they reach, one module per kernel.

    A kernel is in it once, whichever of them reach it, and also if a unit before had it.
    """
    code: dict[int, Any] = {}
    due = [function._library for function in functions]
    while due:
        library = due.pop()
        if id(library) not in code:
            code[id(library)] = library
            due += [one for one in library._linking_libraries if isinstance(one, Library)]
    return [llvm.parse_assembly(text) for one in code.values() for text in getattr(one, "texts", ())]


def _nothing(*arguments: Any, **named: Any) -> None:
    """Do nothing."""


def _no_executable(self: Any, library: Any, fndesc: Any, env: Any) -> Any:
    """Return the substitute for the compiled kernel in Numba's tables; never called."""
    name = fndesc.qualname.split(".")[-1]
    return _dynfunc.make_function(fndesc.lookup_module(), name, "not executable", 1, env, (library,))


def _is_kernel(module: str) -> bool:
    """Whether a function of that module is a kernel of ours; Numba's own may need all of Numba."""
    return module.split(".")[0] != "numba"


def _take_plain_arguments() -> None:
    """Compile a kernel once per types, not per literals (`get_call_template`): LLVM specialises by itself."""
    kind: Any = core.dispatcher._DispatcherBase
    template = kind.get_call_template

    def plain(self: Any, args: Any, kws: Any) -> Any:
        named = {name: types.unliteral(one) for name, one in kws.items()}
        return template(self, tuple(map(types.unliteral, args)), named)

    kind.get_call_template = plain


def _refuse_raises() -> None:
    """Refuse kernels that raise when they are lowered: a caller would go on as if nothing had happened."""
    kind: Any = core.lowering.Lower
    lower = kind.lower_function_body

    def lower_function_body(self: Any) -> Any:
        module, name = self.fndesc.modname, self.fndesc.qualname
        for one in (one for block in self.blocks.values() for one in block.body):
            if isinstance(one, _RAISES) and _is_kernel(module):
                raise BuildError(f"kernels raise nothing: {module}.{name} does in line {one.loc.line}")
        return lower(self)

    kind.lower_function_body = lower_function_body


def _call(context: Any, builder: Any, fndesc: Any, values: Iterable[Any]) -> Any:
    """Emit a call of a compiled function that takes the result and asks for no status."""
    if isinstance(fndesc.restype, types.Optional):
        raise BuildError(f"kernels return one type: {fndesc.modname}.{fndesc.qualname} may return nothing")
    function = context.declare_function(builder.module, fndesc)
    place, error, *_ = function.function_type.args
    result = core.cgutils.alloca_once(builder, place.pointee)
    given = context.call_conv._get_arg_packer(fndesc.argtypes).as_arguments(builder, values)
    builder.call(function, [result, Constant(error, None), *given])
    return context.get_returned_value(builder, fndesc.restype, builder.load(result))


def _call_without_status() -> None:
    """Leave out the check after each call (`user_function`, `call_internal`): nothing raises."""

    def user_function(fndesc: Any, libs: Any) -> Any:
        def call(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            return _call(context, builder, fndesc, values)

        vars(call).update(signature=fndesc.argtypes, libs=tuple(libs))
        return call

    def call_internal(self: Any, builder: Any, fndesc: Any, signature: Any, values: Any) -> Any:
        return _call(self, builder, fndesc, values)

    base: Any = core.base
    base.user_function, base.BaseContext.call_internal = user_function, call_internal


def _wrap_entry(self: Any, library: Any, fndesc: Any, env: Any, call_helper: Any) -> None:
    """Make the C function of an entry, which takes pointers, without Numba's way out to Python."""
    if any(isinstance(one, types.CPointer) for one in fndesc.argtypes):
        result, *kinds = map(self.get_value_type, (fndesc.restype, *fndesc.argtypes))
        module = self.create_module("entry")
        wrapper = Function(module, FunctionType(result, kinds), fndesc.llvm_cfunc_wrapper_name)
        builder = IRBuilder(wrapper.append_basic_block("entry"))
        builder.ret(_call(self, builder, fndesc, wrapper.args))
        library.add_ir_module(module)


def _run_few_passes() -> None:
    """Run those of Numba's passes that change a kernel (`DefaultPassBuilder`); its own functions get all.

    Left out are closures, inlining, `with`, unrolling of literals, pruning of branches, which LLVM does, and
    the end of each variable's life, where references would be counted.
    """
    compiler, builder = core.compiler, core.compiler.DefaultPassBuilder
    few = {
        "define_untyped_pipeline": "TranslateByteCode FixupArgs IRProcessing GenericRewrites "
        "RewriteDynamicRaises ReconstructSSA",
        "define_typed_pipeline": "NopythonTypeInference PreLowerStripPhis",
        "define_nopython_lowering_pipeline": "NativeLowering NoPythonBackend",
    }

    def defined(whole: Any, passes: str) -> Any:
        def define(state: Any) -> Any:
            if not _is_kernel(state.func_id.modname):
                return whole(state)
            manager = compiler.PassManager("kernel")
            for one in passes.split():
                manager.add_pass(getattr(compiler, one), one)
            manager.finalize()
            return manager

        return staticmethod(define)

    for name, passes in few.items():
        setattr(builder, name, defined(getattr(builder, name), passes))


def _remember_calls() -> None:
    """Let operators and functions be resolved once per types (`BaseFunction.get_call_type`).

    A literal number counts as its type. So it does for Numba, but for templates that prefer literals, as
    powers do. Functions as arguments are looked at each time: what they stand for may grow.
    """
    kind: Any = core.types.functions.BaseFunction
    resolve = kind.get_call_type
    known: dict[Any, Any] = {}

    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        if kws or any(isinstance(one, types.Callable) for one in args):
            return resolve(self, context, args, kws)
        plain = tuple(map(types.unliteral, args))
        numbers = all(isinstance(one, types.Number | types.Boolean | types.Array) for one in plain)
        literal = not numbers or any(template.prefer_literal for template in self.templates)
        key = self, context, tuple(args) if literal else plain
        if key not in known:
            known[key] = resolve(self, context, args, kws)
        return known[key]

    kind.get_call_type = get_call_type


def _emit_operators() -> None:
    """Emit + - * of two doubles or whole numbers, and comparisons of doubles, at once (`lower_binop`).

    It is the instruction that Numba emits, after it has looked for the implementation up to four times.
    """
    kind: Any = core.lowering.Lower
    lower, double, whole = kind.lower_binop, types.float64, types.intp
    known: dict[Any, tuple[str, ...]] = {}
    for name in ("add", "sub", "mul"):
        for one in (getattr(operator, name), getattr(operator, f"i{name}")):
            known[one, double, double], known[one, whole, whole] = (f"f{name}",), (name,)
    for name, sign in {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "=="}.items():
        known[getattr(operator, name), double, types.boolean] = ("fcmp_ordered", sign)

    def lower_binop(self: Any, result: Any, expr: Any, op: Any) -> Any:
        one, other = self.fndesc.calltypes[expr].args
        found = known.get((op, one, result))
        if found is None or one != other:
            return lower(self, result, expr, op)
        instruction, *sign = found
        sides = (self._cast_var(side, one) for side in (expr.lhs, expr.rhs))
        return getattr(self.builder, instruction)(*sign, *sides)

    kind.lower_binop = lower_binop
