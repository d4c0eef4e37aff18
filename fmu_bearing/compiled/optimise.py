"""From portable code to the object file of one instruction set, by LLVM.

Code made the plain way calls back into Python where a function might raise. The kernels never raise; once
every symbol but the entries is internal, LLVM proves that and drops those calls. Code made the lean way has
none. The result is checked: an object may call the C library's mathematics only.
"""

import re
from collections.abc import Callable

import llvmlite.binding as llvm

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import Platform
from fmu_bearing.compiled.units import ENTRIES, ONCE, symbol

__all__ = ["MATHEMATICS", "check", "improve", "object_code"]

#: Functions of the C library that an object may call; compilers add those on memory.
MATHEMATICS = frozenset(
    "acos asin atan atan2 cbrt ceil copysign cos cosh exp exp2 expm1 fabs floor fmod hypot log log10 log1p "
    "log2 pow round sin sincos sinh sqrt tan tanh trunc memcpy memmove memset".split()
)
#: How the names of functions of Python begin, which code that might raise calls.
_PYTHON = ("Py", "numba_")
#: Part of the processor's time that has passed after each task: each kernel made simple, the whole optimised;
#: machine code is the rest. Measured on x86-64-v3, for step, init, study: 0.06, 0.14, 0.05; 0.68, 0.72, 0.70.
_THROUGH = (0.08, 0.7)


def object_code(bitcode: bytes, platform: Platform, suffix: str, tell: Callable[[float], None]) -> bytes:
    """Optimise a unit's bitcode for one instruction set of a platform and return its object file.

    Parameters
    ----------
    bitcode : bytes
    platform : Platform
    suffix : str
        Of the instruction set; the entries' names end in it.
    tell : callable
        Takes the part (0 to 1) of the work that is done.

    Raises
    ------
    BuildError
        If Python is still needed, or an address of the compiling process is left in the code.
    """
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    processor = dict(platform.instruction_sets)[suffix]
    module = llvm.parse_bitcode(bitcode)
    target = llvm.Target.from_triple(platform.triple).create_target_machine(
        cpu=processor, opt=3, reloc="pic", codemodel="default"
    )
    module.triple = platform.triple
    module.data_layout = str(target.target_data)
    names = {symbol(entry): symbol(entry, suffix) for entry in ENTRIES}
    once = False
    for function in module.functions:
        if function.is_declaration:
            continue
        if function.name in names:
            once = once or function.name in map(symbol, ONCE)
            function.name = names[function.name]
            function.linkage, function.visibility = "external", "hidden"
        else:
            function.linkage = "internal"
    for variable in module.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"
    improve(module, target, tell, once)
    check(module)
    return target.emit_object(module)


def improve(
    module: llvm.ModuleRef,
    target: llvm.TargetMachine,
    tell: Callable[[float], None] = lambda done: None,
    once: bool = False,
) -> None:
    """Optimise a module whose functions but the entries are internal; ``once``: its entry is called once."""
    # Numba's code keeps every variable in memory: in registers it is a fifth as long for all that follows
    _simplify(module, target)
    tell(_THROUGH[0])
    if any(function.is_declaration and function.name.startswith(_PYTHON) for function in module.functions):
        _optimise(module, target, speed=2, loops=False)  # against the paths of errors
    _optimise(module, target, speed=1 if once else 3, loops=not once)
    tell(_THROUGH[1])


def _simplify(module: llvm.ModuleRef, target: llvm.TargetMachine) -> None:
    """Make each function simple by itself."""
    builder = llvm.create_pass_builder(target, llvm.create_pipeline_tuning_options(speed_level=3))
    passes = llvm.create_new_module_pass_manager()
    passes.add_sroa_pass()
    passes.add_simplify_cfg_pass()
    passes.add_instruction_combine_pass()
    passes.add_simplify_cfg_pass()
    passes.add_sroa_pass()
    passes.run(module, builder)


def _optimise(module: llvm.ModuleRef, target: llvm.TargetMachine, speed: int, loops: bool) -> None:
    """Run LLVM's standard passes of a level of speed; ``loops``: make vectors of loops, and unroll them."""
    tuning = llvm.create_pipeline_tuning_options(speed_level=speed)
    tuning.loop_vectorization = tuning.slp_vectorization = tuning.loop_unrolling = loops
    builder = llvm.create_pass_builder(target, tuning)
    builder.getModulePassManager().run(module, builder)


def check(module: llvm.ModuleRef) -> None:
    """Refuse a module that needs Python or carries an address of the process that compiled it."""
    needed = {
        function.name
        for function in module.functions
        if function.is_declaration and not function.name.startswith("llvm.")
    }
    strange = sorted(needed - MATHEMATICS)
    if strange:
        raise BuildError(f"the kernels are not free of Python: they call {', '.join(strange)}")
    if re.search(r"inttoptr \(i64 \d+", str(module)):
        raise BuildError("the kernels hold an address of the process that compiled them")
