"""What is to be said about the state that a linearised bearing or set stands in."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from fmu_bearing.scene import Scene

if TYPE_CHECKING:
    from fmu_bearing.modal.equations.linearised import Linearised
    from fmu_bearing.modal.equations.set_linearised import SetLinearised

UNSTEADY = (
    "no steady state was found: balls drift from the state that these numbers hold for, in which a run "
    "starts; give more preload or less speed"
)
_SOFT = (
    0.5e-3  # m: a seat gives way by some hundredths of a millimetre; ten times and more is a slip (chosen)
)


def remarks(scene: Scene, system: "Linearised | SetLinearised") -> Iterator[str]:
    """Yield that no steady state was found, that rings count as rigid, that the pedestal is soft."""
    if not system.steady:
        yield UNSTEADY
    if scene.spindle is not None and scene.bends:
        yield "rings count as rigid: modes and stiffness of sets leave out [spindle.flexure]; runs have it"
    moved, stiffness = system.on_pedestal
    if moved > _SOFT:
        key = "mounting" if scene.spindle is None else "spindle.housing"
        body = "housing" if scene.spindle is not None and scene.spindle.housing.moves else "outer ring"
        yield (
            f"soft pedestal: with {key}.pedestal_stiffness_N_m = {stiffness:g} the loads move the {body} by "
            f"{1e3 * moved:.2g} mm; give {stiffness * moved / _SOFT:.2g} N/m or more, or less load"
        )
