"""Flexural modes of the rings as the engine's table."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.frequencies import BAND
from fmu_bearing.elastic.modes import RingMode
from fmu_bearing.engine.layout import MAX_MODES, P
from fmu_bearing.scene import Scene, SceneError, si

# Internal steps over the period of the highest audible mode at rest. The methods then lower a free mode's
# frequency by 0.5 % (esdirk4, which damps it like a damping ratio of 1e-4), 1 % (trbdf2, 5e-4) or 0.03 %
# (rk4, 1e-4); lower modes fare better by the square of the frequency at least.
_STEPS = {"esdirk4": 4.0, "trbdf2": 12.5, "rk4": 14.0}


def mode_table(scene: Scene, modes: Sequence[RingMode]) -> NDArray[np.float64]:
    """Rows of ``MODE_SIZE`` numbers, one per mode; empty without modes.

    Raises
    ------
    SceneError
        Where the scene asks for more modes than the engine has places.
    """
    if not modes:
        return np.empty(0)
    if len(modes) > MAX_MODES:
        raise SceneError(
            f"{scene.name}: mounting.flexure asks for {len(modes)} modes; at most {MAX_MODES} are "
            "carried: leave out the highest orders"
        )
    assert scene.mounted.flexure is not None  # it is what asked for the modes
    flexure = si(scene.mounted.flexure)
    seats = flexure.inner_seat_stiffness, flexure.outer_seat_stiffness
    table = np.zeros((len(modes), P.MODE_SIZE))
    for row, mode in zip(table, modes, strict=True):
        free = 2.0 * math.pi * mode.frequency
        row[P.MODE_BODY], row[P.MODE_ORDER] = mode.body, mode.order
        row[P.MODE_MASS] = mode.modal_mass
        row[P.MODE_STIFFNESS] = mode.modal_mass * free**2 + seats[mode.body] * mode.seat
        row[P.MODE_DAMPING] = 2.0 * flexure.damping_ratio * free
        row[P.MODE_GYROSCOPIC] = mode.gyroscopic
        shape = groove_centre(scene, mode)
        row[P.MODE_X], row[P.MODE_R], row[P.MODE_T] = shape
        row[P.MODE_TILT] = mode.groove_tilt
        row[P.MODE_WEIGHT] = 0.5 * (shape @ shape)
    return table.ravel()


def groove_centre(scene: Scene, mode: RingMode) -> NDArray[np.float64]:
    """Shape (x, r, t) of a mode at the centre of the groove's circle, carried there by the section's turn.

    ``mode.groove`` belongs to the point of the groove that the unloaded ball touches.
    """
    bearing = si(scene.bearing)
    conformity = bearing.inner_conformity if mode.body == 0 else bearing.outer_conformity
    reach = conformity * bearing.ball_diameter * (1.0 if mode.body == 0 else -1.0)
    x, r, t = mode.groove
    # from the contact to the centre; a turn about t takes r to -x and x to r
    angle = scene.bearing.nominal_angle
    dx, dr = reach * math.sin(angle), reach * math.cos(angle)
    return np.array([x - mode.groove_tilt * dr, r + mode.groove_tilt * dx, t])


def inner_modes(table: NDArray[np.float64]) -> int:
    """Return how many modes of a table are the inner ring's: the engine takes the first ones for them."""
    bodies = table.reshape(-1, P.MODE_SIZE)[:, P.MODE_BODY]
    return int((bodies == 0.0).sum())


def longest_step(table: NDArray[np.float64], method: str) -> float:
    """Longest internal step (s) that resolves every audible mode of a table; infinite where there is none.

    Modes above hearing bend with their stiffness at any step. Their own ringing is damped and lowered by the
    method, unless the step's error estimate, of which they are part, asks for shorter steps. The explicit
    method resolves them all: its long steps would be unstable.
    """
    rows = table.reshape(-1, P.MODE_SIZE)
    frequencies = np.sqrt(rows[:, P.MODE_STIFFNESS] / rows[:, P.MODE_MASS]) / (2.0 * math.pi)
    audible = frequencies if method == "rk4" else frequencies[frequencies <= BAND[1]]
    return 1.0 / (_STEPS[method] * float(audible.max())) if audible.size else math.inf
