"""Remarks on the state that a scene is linearised about."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fmu_bearing.modal.equations.linearised import Linearised

UNSTEADY = (
    "no steady state was found: balls drift from the state that these numbers hold for, in which a run "
    "starts; give more preload or less speed"
)
#: A note, no failure: under a load across its axis every deep groove bearing has loose balls.
LOOSE = (
    "loads across the axis leave some balls loose, as usual under a radial load, and the cage carries them; "
    "torque, heat and orbit are sums over the balls at rest under these loads, and growth is not judged"
)
_SOFT = (
    0.5e-3  # m: a seat gives way by some hundredths of a millimetre; ten times and more is a slip (chosen)
)


def unsteady(system: "Linearised") -> str:
    """Return the remark on a state that is not steady."""
    return LOOSE if system.carried else UNSTEADY


def remarks(system: "Linearised") -> Iterator[str]:
    """Yield that the state is not steady, that the pedestal is soft."""
    if not system.steady:
        yield unsteady(system)
    moved, stiffness = system.on_pedestal
    if moved > _SOFT:
        key = "spindle.housing" if system.shaft.count else "mounting"
        body = "housing" if system.shaft.housed else "outer ring"
        yield (
            f"soft pedestal: with {key}.pedestal_stiffness_N_m = {stiffness:g} the loads move the {body} by "
            f"{1e3 * moved:.2g} mm; give {stiffness * moved / _SOFT:.2g} N/m or more, or less load"
        )
