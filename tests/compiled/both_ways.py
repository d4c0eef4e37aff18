"""One entry compiled the lean or the plain way, in a process of its own."""

import os
import subprocess
import sys

from fmu_bearing.compiled.settings import SETTINGS

_SCRIPT = """
import ctypes, sys
import numpy as np
from numba import carray
from fmu_bearing.compiled import lower, units
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.load import _linked
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import instruction_set, own
from fmu_bearing.engine.jit import kernel

{code}

units.ENTRIES["entry"] = units.Entry("entry", "ab")
lower.functions = lambda unit: {{"entry": entry}}
try:
    code = lower.portable_code("entry", lambda done: None, sys.argv[1] == "lean")
except BuildError as problem:
    sys.exit(str(problem))
suffix = instruction_set(own())
engine = _linked(object_code(code, own(), suffix, lambda done: None))
call = ctypes.CFUNCTYPE(ctypes.c_int32, *[ctypes.c_void_p] * 3)(
    engine.get_function_address(units.symbol("entry", suffix))
)
a = np.random.default_rng(7).standard_normal(25)
b, n = np.zeros(25), np.array([25, 25])
call(a.ctypes.data, b.ctypes.data, n.ctypes.data)
print(b.tobytes().hex())
"""


def run(code, way):
    """Return the finished process: it prints what ``entry(a, b, n)`` of ``code`` writes to b, in hex.

    a: 25 normal numbers, `default_rng(7)`; b: 25 zeros.
    """
    return subprocess.run(
        [sys.executable, "-c", _SCRIPT.format(code=code), way], env={**os.environ, **SETTINGS},
        capture_output=True, text=True, timeout=600,
    )  # fmt: skip
