"""A driver of fixed steps: compiled as the engine's kernels are, in a process of its own, and called here.

Numba alone takes 250 CPU seconds for what the driver reaches: it optimises every kernel anew in each one that
calls it. The lean way of `fmu_bearing.compiled` optimises all of them once, for single bearings.
"""

import ctypes
import os
import subprocess
import sys

import numpy as np

from fmu_bearing.compiled.settings import SETTINGS
from tests.conftest import ROOT

NAME = "fixed_steps"


def driver():
    """Return a function that advances a state by ``count`` steps of ``h`` (s): number that converged."""
    # the engine is linked there, it is not needed where the driver is made
    from fmu_bearing.compiled.load import _linked
    from fmu_bearing.compiled.platforms import instruction_set, own
    from fmu_bearing.compiled.units import symbol

    made = subprocess.run(
        [sys.executable, "-m", __name__], cwd=ROOT, env={**os.environ, **SETTINGS}, capture_output=True,
        timeout=1800,
    )  # fmt: skip
    assert made.returncode == 0, made.stderr.decode()
    engine = _linked(made.stdout)
    kinds = [ctypes.c_void_p] * 4 + [ctypes.c_double] * 4
    address = engine.get_function_address(symbol(NAME, instruction_set(own())))
    function = ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(address)

    def fixed_steps(p, s, w, h, count, tableau, tolerance, _alive=engine):
        lengths = np.array([p.size, s.size, w.size])
        places = (one.ctypes.data for one in (p, s, w, lengths))
        return function(*places, h, count, tableau, tolerance)

    return fixed_steps


def entry():
    """Return the driver as a function that Numba can compile for pointers."""
    from numba import carray

    from fmu_bearing.engine.fidelities.full.jacobians import factor_all, renew_jacobians
    from fmu_bearing.engine.fidelities.full.march import accept_all
    from fmu_bearing.engine.fidelities.full.methods.table import TABLEAUX
    from fmu_bearing.engine.fidelities.full.progress import total_energy
    from fmu_bearing.engine.fidelities.full.step import runge_kutta_step
    from fmu_bearing.engine.jit import kernel
    from fmu_bearing.engine.layout import TAB, S

    @kernel
    def march(p, s, w, h, count, tableau, tolerance):
        total_energy(p, s, w)  # accelerations behind the push
        renew_jacobians(p, s, w, True)
        factor_all(p, s, w, h, TABLEAUX[tableau + TAB.GAMMA] * h)
        for n in range(count):
            if not runge_kutta_step(p, s, w, h, tableau, tolerance, True, s[S.SPEED]):
                return n
            accept_all(p, s, w, h, tableau)
        return count

    def fixed_steps(p, s, w, n, h, count, tableau, tolerance):
        return march(
            carray(p, (n[0],)), carray(s, (n[1],)), carray(w, (n[2],)), h, int(count), int(tableau), tolerance
        )  # fmt: skip

    return {NAME: fixed_steps}


def main():
    """Write the driver's object file to standard output."""
    import numba

    from fmu_bearing.compiled import lower, single, units
    from fmu_bearing.compiled.optimise import object_code
    from fmu_bearing.compiled.platforms import instruction_set, own
    from fmu_bearing.compiled.settings import lean

    single.install()
    units.ENTRIES[NAME] = units.Entry(NAME, "psw", 4)
    lower.functions = lambda unit: entry()
    code = lower.portable_code(NAME, lambda done: None, lean(numba.__version__))
    platform = own()
    sys.stdout.buffer.write(object_code(code, platform, instruction_set(platform), lambda done: None))


if __name__ == "__main__":
    main()
