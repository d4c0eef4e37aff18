"""Reference trajectory: fidelity ``full`` by two integrators that share no code.

One is classical Runge-Kutta of fourth order, explicit, at tens of nanoseconds; it knows only the right-hand
side. The other is the engine's own implicit method at a tight tolerance. Their difference bounds the error of
both.

Measured on the scene 7003C-spindle at 20,000 r/min over 5 ms after 50 ms: Runge-Kutta at 40 ns and at 20 ns
agree to 6e-11; ESDIRK4 differs from them by 2.0e-6, 2.6e-7, 5e-8 and 2e-8 at 4, 2, 1 and 0.5 us (tolerance
1e-5 to 1e-8). The races' waviness limits both to second order: its cubic pieces join with a jump in the
second derivative, which contact damping turns into a kink of the force, one per ball and 2.5 us there.
Without waviness 4 us give 6e-10. At 1,000 r/min stiff traction makes Runge-Kutta unstable above 60 ns.
"""

import time

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import RINGS, Arrays
from fmu_bearing.compiled import call, ready
from fmu_bearing.engine.choices import ESDIRK4, RK4
from fmu_bearing.engine.layout import SP, C, S, Y
from fmu_bearing.engine.reference.runge_kutta import ROWS, SIZE


def explicit_rings(
    bearing: Arrays, duration: float, sample: float, step: float
) -> tuple[NDArray[np.float64], float]:
    """Ring velocities (m/s, six columns) every ``sample`` (s) from the bearing's state, and the CPU time (s).

    The bearing's state is not changed; ``step`` (s) is shortened to divide ``sample``. A set, with six
    columns for each bearing, is run by the engine's own explicit method, because the integrator apart from
    the engine knows one bearing.
    """
    if SP.has_shaft(bearing.p):
        return _timed(bearing, duration, sample, METHOD=RK4, MAX_STEP=step)
    y = np.concatenate([bearing.s[S.Y : S.Y + Y.SIZE], bearing.s[S.AXES : S.JAC]])
    c = bearing.s[S.C : S.C + C.SIZE].copy()
    angle, speed = float(bearing.s[S.ANGLE]), float(bearing.s[S.SPEED])
    steps = int(np.ceil(sample / step - 1e-9))
    w = np.zeros(bearing.w.size)
    k = np.zeros(ROWS * SIZE)
    ready("study")  # before the clock
    rows = np.empty((round(duration / sample), 6))
    begin = time.process_time()
    for n, row in enumerate(rows):
        at = angle + speed * (n * sample)
        call("runge_kutta", bearing.p, c, y, w, k, at, speed, sample / steps, steps)
        row[:] = y[RINGS]
    return rows, time.process_time() - begin


def implicit_rings(
    bearing: Arrays, duration: float, sample: float, step: float, tolerance: float
) -> tuple[NDArray[np.float64], float]:
    """As :func:`explicit_rings` by the engine's default method with ``step`` and ``tolerance`` as bounds."""
    return _timed(bearing, duration, sample, METHOD=ESDIRK4, MAX_STEP=step, TOLERANCE=tolerance)


def _timed(
    bearing: Arrays, duration: float, sample: float, **parameters: float
) -> tuple[NDArray[np.float64], float]:
    """Ring velocities in fidelity full with other parameters, and the CPU time (s)."""
    tight = bearing.with_parameters(FIDELITY=0, **parameters)
    begin = time.process_time()
    rows = tight.rings(duration, sample)
    return rows, time.process_time() - begin


def relative_error(rows: NDArray[np.float64], exact: NDArray[np.float64]) -> float:
    """Rms difference over time and columns, over the rms of ``exact`` about each column's mean."""
    return float(np.sqrt(np.mean((rows - exact) ** 2) / np.mean((exact - exact.mean(0)) ** 2)))
