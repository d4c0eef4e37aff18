"""One kernel compiled as the FMU's library is: portable code first, then each instruction set."""

import os
import re
import subprocess
import sys

from fmu_bearing.compiled.settings import SETTINGS

_SCRIPT = """
import importlib, sys
import llvmlite.binding as llvm
from numba import carray, cfunc, types
from fmu_bearing.engine.jit import FLAGS
from fmu_bearing.compiled import optimise

module, name, kinds = sys.argv[1:]
function = getattr(importlib.import_module(module), name)
letters = [f"x{i}" for i in range(len(kinds))]
arguments = [f"carray({x}, (1000000,))" if kind == "a" else x for x, kind in zip(letters, kinds)]
scope = {"carray": carray, "function": function}
exec(f"def entry({', '.join(letters)}):\\n function({', '.join(arguments)})", scope)
given = {"a": types.CPointer(types.float64), "d": types.float64, "i": types.int64}
signature = [given[kind] for kind in sys.argv[3]]
entry = cfunc(types.void(*signature), **FLAGS)(scope["entry"])
bitcode = llvm.parse_assembly(entry.inspect_llvm()).as_bitcode()
llvm.initialize_all_targets()
llvm.initialize_all_asmprinters()
for triple, processor in (
    ("x86_64-unknown-linux-gnu", "x86-64-v2"),
    ("x86_64-unknown-linux-gnu", "x86-64-v3"),
    ("aarch64-unknown-linux-gnu", "generic"),
):
    made = llvm.parse_bitcode(bitcode)
    target = llvm.Target.from_triple(triple).create_target_machine(cpu=processor, opt=3, reloc="pic")
    made.triple, made.data_layout = triple, str(target.target_data)
    for one in made.functions:
        if not one.is_declaration and one.name != entry.native_name:
            one.linkage = "internal"
    optimise.improve(made, target)
    optimise.check(made)
    print("====", processor)
    print(target.emit_assembly(made))
"""


def assembly(module, kernel, kinds):
    """Assembly by processor of a kernel; ``kinds``: per argument ``a`` array, ``d`` double or ``i`` integer.

    The native library's own check holds: no call of Python and no address of this process.
    """
    ran = subprocess.run(
        [sys.executable, "-c", _SCRIPT, module, kernel, kinds],
        env={**os.environ, **SETTINGS}, capture_output=True, text=True, timeout=600,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    return {part.split("\n", 1)[0]: part for part in ran.stdout.split("==== ")[1:]}


def count(code, pattern):
    """How many lines of assembly match a pattern."""
    return sum(bool(re.search(pattern, line)) for line in code.splitlines())
