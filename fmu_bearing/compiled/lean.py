"""Numba as a front end alone: each kernel to LLVM code once, nothing optimised or made executable on the way.

For every kernel Numba also makes a wrapper for Python and one for C, links the kernel with all that it calls,
optimises the whole and emits machine code. An ahead-of-time build needs none of that: 345 times. Here the
code of each kernel is kept as text, and what an entry reaches is linked once.

Left out besides, because kernels neither allocate nor raise: counting of references (each array that is
passed on would be counted up and down) and wrapping of negative indices, which every access would have to
ask for. Types that Numba found for an operator are remembered.

This reaches into Numba: it is used with the versions that `settings` names; `lower` has the plain way for
others.
"""

import functools
import operator
from collections.abc import Iterable
from typing import Any

import llvmlite.binding as llvm
from numba import _dynfunc, core, types  # type: ignore[attr-defined]
from numba.core.runtime.context import NRTContext
from numba.extending import lower_builtin

__all__ = ["install", "modules"]


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
    wrap = context.create_cfunc_wrapper

    def wrap_entries(self: Any, library: Any, fndesc: Any, env: Any, call_helper: Any) -> None:
        if any(isinstance(one, types.CPointer) for one in fndesc.argtypes):
            wrap(self, library, fndesc, env, call_helper)

    context.create_cfunc_wrapper = wrap_entries
    counting.incref = counting.decref = _nothing
    # Consistency of Numba's own passes is checked after each of them: 15 % of the time.
    core.compiler_machinery.PassManager._ENFORCING = False
    _take_plain_arguments()
    _remember_operators()
    _plain_access()


def modules(functions: Iterable[Any]) -> list[llvm.ModuleRef]:
    """Return the code of compiled C functions and of all that they reach, one module per kernel.

    A kernel is in it once, whichever of them reach it, and also if a unit before had it.
    """
    found: dict[int, Any] = {}
    due = [function._library for function in functions]
    while due:
        library = due.pop()
        if id(library) not in found:
            found[id(library)] = library
            due += [one for one in library._linking_libraries if isinstance(one, Library)]
    return [llvm.parse_assembly(text) for one in found.values() for text in getattr(one, "texts", ())]


def _nothing(*arguments: Any, **named: Any) -> None:
    """Do nothing."""


def _no_executable(self: Any, library: Any, fndesc: Any, env: Any) -> Any:
    """Return the substitute for the compiled kernel in Numba's tables; never called."""
    name = fndesc.qualname.split(".")[-1]
    return _dynfunc.make_function(fndesc.lookup_module(), name, "not executable", 1, env, (library,))


def _take_plain_arguments() -> None:
    """Compile a kernel once per types, not per literals (`get_call_template`): LLVM specialises by itself."""
    kind: Any = core.dispatcher._DispatcherBase
    template = kind.get_call_template

    def plain(self: Any, args: Any, kws: Any) -> Any:
        named = {name: types.unliteral(one) for name, one in kws.items()}
        return template(self, tuple(map(types.unliteral, args)), named)

    kind.get_call_template = plain


def _plain_access() -> None:
    """Read and write numbers of flat arrays by their place, which is never negative."""

    def address(context: Any, builder: Any, array_type: Any, array: Any, place: Any) -> Any:
        model = context.data_model_manager[array_type]
        data = builder.extract_value(array, model.get_field_position("data"))
        return builder.gep(data, [place], inbounds=True)

    def read(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.load(address(context, builder, signature.args[0], args[0], args[1]))

    def write(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        builder.store(args[2], address(context, builder, signature.args[0], args[0], args[1]))
        return context.get_dummy_value()

    flat = types.Array(types.float64, 1, "C")
    constant = types.Array(types.float64, 1, "C", readonly=True)
    for one in (flat, constant):
        lower_builtin(operator.getitem, one, types.intp)(read)
    lower_builtin(operator.setitem, flat, types.intp, types.float64)(write)


def _remember_operators() -> None:
    """Let operators and functions of numbers alone be resolved once per types."""
    context: Any = core.typing.context.BaseContext
    resolve = context._resolve_user_function_type
    known: dict[Any, Any] = {}

    def resolved(self: Any, func: Any, args: Any, kws: Any, literals: Any = None) -> Any:
        numbers = type(func) is types.Function and not kws
        if not numbers or not all(isinstance(one, (types.Number, types.Boolean)) for one in args):
            return resolve(self, func, args, kws, literals)
        found = known.get((func, args))
        if found is None:
            found = resolve(self, func, args, kws, literals)
            if found is not None:
                known[func, args] = found
        return found

    context._resolve_user_function_type = resolved
