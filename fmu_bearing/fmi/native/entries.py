"""The engine's three entries with C's calling convention, and their LLVM code for no machine in particular.

Run as ``python -m fmu_bearing.fmi.native.entries FILE`` in a process of its own: what Numba generates
depends on settings that it reads when it is loaded. With its optimisation off and no processor named, the
code is the same wherever it is made; `compile` optimises it for each target.
"""

import gc
import os
import re
import sys
import warnings
from pathlib import Path
from typing import Any

__all__ = ["ENTRIES", "SETTINGS", "symbol"]

#: Entries of `fmu_bearing.engine.abi` that a library needs.
ENTRIES = ("init", "step", "outputs")

#: Environment under which Numba generates portable code.
SETTINGS = {
    "NUMBA_OPT": "0",
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_DISABLE_INTEL_SVML": "1",
    # Numba colours the messages of all the overloads it tries and drops: a tenth of its time
    "NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING": "1",
}


def symbol(entry: str, instruction_set: str = "") -> str:
    """Name of an entry in object files and in the shim."""
    return f"fb_{entry}_{instruction_set}" if instruction_set else f"fb_{entry}"


def _functions() -> dict[str, Any]:
    """Return the entries as Numba C functions: arrays as pointers, their lengths in ``sizes``.

    ``int32 init(p, u, s, z, w, sizes, time)``, ``step(p, u, s, z, w, sizes, h)``, ``outputs(p, s, z, sizes)``
    with pointers to doubles and ``sizes`` to five int64: the lengths of p, u, s, z and w.
    """
    import numba
    from numba import carray, cfunc, types

    from fmu_bearing.engine import abi
    from fmu_bearing.engine.jit import FLAGS

    flags: dict[str, Any] = dict(FLAGS)
    # the entries themselves keep what they compile; what is compiled here is of no use to them
    init, step, outputs = (numba.njit(**flags)(getattr(abi, name).py_func) for name in ENTRIES)
    numbers, sizes = types.CPointer(types.float64), types.CPointer(types.int64)
    advance = types.int32(numbers, numbers, numbers, numbers, numbers, sizes, types.float64)
    read = types.int32(numbers, numbers, numbers, sizes)

    def c_init(p, u, s, z, w, n, time):
        return init(
            carray(p, (n[0],)), carray(u, (n[1],)), carray(s, (n[2],)), carray(z, (n[3],)),
            carray(w, (n[4],)), time,
        )  # fmt: skip

    def c_step(p, u, s, z, w, n, h):
        return step(
            carray(p, (n[0],)), carray(u, (n[1],)), carray(s, (n[2],)), carray(z, (n[3],)),
            carray(w, (n[4],)), h,
        )  # fmt: skip

    def c_outputs(p, s, z, n):
        return outputs(carray(p, (n[0],)), carray(s, (n[2],)), carray(z, (n[3],)))

    with warnings.catch_warnings():
        # kernels that Numba cannot keep on disk with these settings: nothing is to be kept
        warnings.simplefilter("ignore", numba.core.errors.NumbaWarning)
        return {
            "init": cfunc(advance, **flags)(c_init),
            "step": cfunc(advance, **flags)(c_step),
            "outputs": cfunc(read, **flags)(c_outputs),
        }


def portable_code() -> bytes:
    """LLVM bitcode of all entries in one module; what they share stands in it once.

    Raises
    ------
    RuntimeError
        If Numba was loaded with other settings than :data:`SETTINGS`.
    """
    import llvmlite.binding as llvm
    import numba

    config: Any = numba.config
    if config.OPT != 0 or config.CPU_NAME != "generic":
        raise RuntimeError("portable code needs Numba loaded under the settings of this module")
    whole = llvm.parse_assembly("")
    for entry, function in _functions().items():
        text = function.inspect_llvm().replace(function.native_name, symbol(entry))
        # names of the machine that generated it: each target sets its own
        text = re.sub(r"^target (triple|datalayout) = .*$", "", text, flags=re.MULTILINE)
        whole.link_in(llvm.parse_assembly(text))
    whole.verify()
    return whole.as_bitcode()


def main() -> None:
    """Write the bitcode to the file named on the command line."""
    gc.set_threshold(500_000, 20, 100)  # millions of small objects stay: looking through them often is vain
    Path(sys.argv[1]).write_bytes(portable_code())


if __name__ == "__main__":
    if any(os.environ.get(key) != value for key, value in SETTINGS.items()):
        sys.exit("fmu_bearing.fmi.native.entries: to be run by fmu_bearing.fmi.native.compile")
    main()
