"""From portable code to the object file of one instruction set, by LLVM.

Run as ``python -m fmu_bearing.fmi.native.optimise BITCODE PLATFORM SET FILE``: LLVM's passes hold the
interpreter, so several objects are made by several processes.

Numba's code for a function that might raise calls back into Python. The kernels never raise; once every
symbol but the entries is internal, LLVM proves that and drops those calls. The result is checked: an object
may call the C library's mathematics only.
"""

import re
import sys
from pathlib import Path

import llvmlite.binding as llvm

from fmu_bearing.files import write_whole
from fmu_bearing.fmi.native.entries import ENTRIES, symbol
from fmu_bearing.fmi.native.platforms import PLATFORMS, Platform

__all__ = ["BuildError", "check", "object_code"]

#: Functions of the C library that an object may call; compilers add those on memory.
MATHEMATICS = frozenset(
    "acos asin atan atan2 cbrt ceil copysign cos cosh exp exp2 expm1 fabs floor fmod hypot log log10 log1p "
    "log2 pow round sin sincos sinh sqrt tan tanh trunc memcpy memmove memset".split()
)
#: Passes over the module: the second sees the entries without Python's error paths, and halves them.
_PASSES = 2


class BuildError(RuntimeError):
    """A library that could not be built, and why."""


def object_code(bitcode: bytes, platform: Platform, suffix: str) -> bytes:
    """Optimise bitcode for one instruction set of a platform and return its object file.

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
    for function in module.functions:
        if function.is_declaration:
            continue
        if function.name in names:
            function.name = names[function.name]
            function.linkage, function.visibility = "external", "hidden"
        else:
            function.linkage = "internal"
    for variable in module.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"
    for _ in range(_PASSES):
        _optimise(module, target)
    check(module)
    return target.emit_object(module)


def _optimise(module: llvm.ModuleRef, target: llvm.TargetMachine) -> None:
    """Run LLVM's standard passes of the highest level."""
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_vectorization = tuning.slp_vectorization = tuning.loop_unrolling = True
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


def main() -> None:
    """Write one object file."""
    code, name, suffix, path = sys.argv[1:]
    try:
        write_whole(Path(path), object_code(Path(code).read_bytes(), PLATFORMS[name], suffix))
    except BuildError as problem:
        sys.exit(str(problem))


if __name__ == "__main__":
    main()
