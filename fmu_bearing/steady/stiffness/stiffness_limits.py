"""What limits a table of stiffness and damping, in sentences."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.remarks import UNSTEADY
from fmu_bearing.modal.modes.mode import SPREAD
from fmu_bearing.modal.modes.natural_modes import STICKING
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable

_NEAR = 0.2  # of the orbit's frequency: nearer to it, free balls that bunch are seen
_APART = 0.03  # of the stiffness: K for frequency to 0 is then no substitute
_ROUNDING = 1e-9  # of the stiffness: a smaller loss is none


def limits_of(table: StiffnessTable) -> Iterator[str]:
    """Yield what limits a table, in sentences."""
    largest = float(table.spread.max())
    if largest > SPREAD:
        yield (
            f"single phases of a ball pitch differ by up to {100.0 * largest:.1f} % from these means: the "
            "balls' loads are unequal, and a rotor sees stiffness that changes as they pass"
        )
    held = table.on_shaft or table.scene.bearing.is_deep_groove  # by loads, it may be
    if not held and table.preloads[0] == 0.0:
        yield "0 N: no preload holds balls and races together: K and C are of loose balls and mean little"
    slow = table.speeds[np.abs(table.speeds) / 60.0 < STICKING]
    if slow.size:
        yield (
            f"{slow[0]:g} r/min: contacts that do not roll stick below 1 mm/s: damping holds for motions "
            "slower than that only"
        )
    for i, k in np.argwhere(~table.steady)[:1]:
        yield f"{table.speeds[i]:g} r/min, {table.preloads[k]:g} N: {UNSTEADY}"
    yield from _whirl(table)
    if table.spacing == "free":
        ratio = table.frequencies / table.orbit[:, :, None]
        if np.any(np.abs(ratio - 1.0) < _NEAR):
            yield (
                "frequencies within 20 % of the balls' orbit f_c: free balls bunch there and K has a pole; "
                "spacing = held leaves that out"
            )
    if table.scene.bends:
        yield "K and C include the bending of the rings, which matters where balls carry unequal loads"
    apart = table.against_static()
    if apart > _APART:
        yield (
            f"K at {table.frequencies[0]:.4g} Hz differs from K for frequency to 0 by up to "
            f"{100.0 * apart:.0f} %: balls that carry little take tens of milliseconds to turn over to new "
            "contact angles"
        )


def _whirl(table: StiffnessTable) -> Iterator[str]:
    """Yield the caution of a motion that takes power from the shaft, and which one it is."""
    lost, vectors = table.losses()
    least = lost[..., 0]
    if least.min() >= -_ROUNDING:
        return
    at = np.unravel_index(int(least.argmin()), least.shape)
    highest = table.frequencies[np.flatnonzero((least < -_ROUNDING).any(axis=(0, 1)))[-1]]
    yield (
        f"{_motion(vectors[at][:, 0], table.speeds[at[0]] >= 0.0)} of up to {highest:.4g} Hz takes power "
        f"from the shaft through the rolling contacts: at {table.speeds[at[0]]:g} r/min and "
        f"{table.frequencies[at[2]]:.4g} Hz {-100.0 * least.min():.2f} % of the stiffness"
    )


def _motion(vector: NDArray[np.complex128], positive: bool) -> str:
    """Return what moves most in a motion of the ring, and which way; ``positive``: sense of the shaft."""
    parts = {"axial": vector[:1], "radial": vector[1:3], "tilting": vector[3:5]}
    name = max(parts, key=lambda key: float(np.linalg.norm(parts[key])))
    if name == "axial":
        return "an axial motion"
    first, second = parts[name]
    forward = (abs(first + 1j * second) > abs(first - 1j * second)) == positive
    return f"a {'forward' if forward else 'backward'} {name} whirl"
