"""What limits a table of stiffness and damping, in sentences."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from fmu_bearing.modal.stiffness import Stiffness

_STICKING = 1e-3  # turns per second: slower, contacts stick, as for `modes`
_SPREAD = 0.01  # over one ball pitch, beyond which it is told
_NEAR = 0.2  # of the orbit's frequency: nearer to it, free balls that bunch are seen
_ROUNDING = 1e-9  # of the stiffness: a loss below it is none


def limits_of(found: "Stiffness") -> Iterator[str]:
    """Yield what limits a table, in sentences."""
    largest = float(found.spread.max())
    if largest > _SPREAD:
        yield (
            f"single phases of a ball pitch differ by up to {100.0 * largest:.1f} % from these means: the "
            "balls' loads are unequal, and a rotor sees stiffness that changes as they pass"
        )
    slow = found.speeds[np.abs(found.speeds) / 60.0 < _STICKING]
    if slow.size:
        yield (
            f"{slow[0]:g} r/min: contacts that do not roll stick below 1 mm/s: damping holds for motions "
            "slower than that only"
        )
    yield from _whirl(found)
    if found.spacing == "free":
        ratio = found.frequencies / found.orbit[:, :, None]
        if np.any(np.abs(ratio - 1.0) < _NEAR):
            yield (
                "frequencies within 20 % of the balls' orbit f_c: free balls bunch there and K has a pole; "
                "spacing = held leaves that out"
            )
    if found.scene.bends:
        yield "the rings bend in K and C, while the quasi-static matrix is that of rigid rings"


def _whirl(found: "Stiffness") -> Iterator[str]:
    """Yield the caution of a motion that takes power from the shaft, and which one it is."""
    lost, vectors = found.losses()
    least = lost[..., 0]
    if least.min() >= -_ROUNDING:
        return
    at = np.unravel_index(int(least.argmin()), least.shape)
    highest = found.frequencies[np.flatnonzero((least < -_ROUNDING).any(axis=(0, 1)))[-1]]
    motion = vectors[at][:, 0]
    name, pair = max(
        (("radial", motion[1:3]), ("tilting", motion[3:5])), key=lambda part: float(np.linalg.norm(part[1]))
    )
    ahead, behind = abs(pair[0] + 1j * pair[1]), abs(pair[0] - 1j * pair[1])
    with_shaft = (ahead > behind) == (found.speeds[at[0]] >= 0.0)
    yield (
        f"a {'forward' if with_shaft else 'backward'} {name} whirl of up to {highest:g} Hz takes power from "
        f"the shaft through the rolling contacts: at {found.speeds[at[0]]:g} r/min and "
        f"{found.frequencies[at[2]]:g} Hz {-100.0 * least.min():.2f} % of the stiffness"
    )
