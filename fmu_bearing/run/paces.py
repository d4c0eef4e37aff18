"""How fast a bearing runs with constant inputs, and with inputs that move as in a co-simulation.

Fidelities rings and response hold an operating point, and renew it where inputs have moved: constant inputs
alone would say little of what they cost in a co-simulation.
"""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import U

COMMUNICATION = 1e-3  # s, of what is timed or only passed through
# Chosen: a spindle that reaches 10,000 r/min in a second, a fast warm-up, a speed with a trace of the mains.
RAMP = 1e3  # rad/s2
TURN = 0.1  # s: of a ramp down, then up; slow shafts lose and regain half of their speed
WARMING = 5.0  # K/s
RIPPLE = 5e-4  # of the speed
MAINS = 50.0  # Hz

#: Puts inputs ``u`` to what they are some seconds after the state from which a run is timed.
Motion = Callable[[NDArray[np.float64], float], None]


@dataclass(frozen=True)
class Paces:
    """Simulated s per CPU s, without sound, in communication steps of 1 ms; NaN where not timed.

    Attributes
    ----------
    constant : float
        With constant inputs, settled.
    ramp : float
        The speed falls and rises again by 1,000 rad/s2.
    warming : float
        All temperatures rise by 5 K/s.
    ripple : float
        The speed ripples by 0.05 % at 50 Hz.
    """

    constant: float = math.nan
    ramp: float = math.nan
    warming: float = math.nan
    ripple: float = math.nan

    @property
    def slowest(self) -> float:
        """The slowest of them: what a co-simulation can count on."""
        return min(getattr(self, field.name) for field in fields(self))


def motions(bearing: Arrays) -> dict[str, Motion | None]:
    """Return how inputs move for each of `Paces`, from the bearing's present inputs on."""
    start, warm = bearing.u.copy(), bearing.temperatures
    speed = float(start[U.SPEED])
    rate = min(RAMP, 0.5 * abs(speed) / TURN)

    def ramp(u: NDArray[np.float64], time: float) -> None:
        u[U.SPEED] = speed - math.copysign(rate, speed) * (TURN - abs(time % (2.0 * TURN) - TURN))

    def warming(u: NDArray[np.float64], time: float) -> None:
        u[warm] = start[warm] + WARMING * time

    def ripple(u: NDArray[np.float64], time: float) -> None:
        u[U.SPEED] = speed * (1.0 + RIPPLE * math.sin(2.0 * math.pi * MAINS * time))

    return {"constant": None, "ramp": ramp, "warming": warming, "ripple": ripple}


def paces(bearing: Arrays, budget: float, repeats: int = 2, longest: float = 1.0) -> Paces:
    """Time a bearing from its state, as `speed` does, with each of the `motions`; state and inputs stay."""
    return Paces(**{
        name: speed(bearing, budget, repeats, longest, motion=motion)[1]
        for name, motion in motions(bearing).items()
    })  # fmt: skip


def speed(
    bearing: Arrays, budget: float, repeats: int, longest: float, communication: float = COMMUNICATION,
    motion: Motion | None = None,
) -> tuple[float, float]:  # fmt: skip
    """Return simulated s per wall s and per CPU s, best of ``repeats`` runs from the bearing's state.

    A run lasts about ``budget`` s of wall time and at most ``longest`` s of simulated time, in communication
    steps of ``communication`` (s); ``motion`` moves the inputs before each.
    """
    state, inputs = bearing.s.copy(), bearing.u.copy()

    def run(steps: int) -> None:
        for k in range(steps):
            if motion is not None:
                motion(bearing.u, (k + 1) * communication)
            bearing.step(communication)

    clock = time.perf_counter()
    run(2)
    pilot = (time.perf_counter() - clock) / 2
    steps = max(1, min(round(longest / communication), round(budget / pilot)))
    wall = cpu = float("inf")
    for _ in range(repeats):
        bearing.s[:] = state
        clock, used = time.perf_counter(), time.process_time()
        run(steps)
        passed, used = time.perf_counter() - clock, time.process_time() - used
        # a coarse clock counts less than its tick as nothing; one thread uses no more than what passes
        wall, cpu = min(wall, passed), min(cpu, used or passed)
    bearing.s[:], bearing.u[:] = state, inputs
    simulated = steps * communication
    return simulated / wall, simulated / cpu
