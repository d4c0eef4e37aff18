"""`Setting`: one way to compute a scene."""

from dataclasses import dataclass

from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import Subject, exclusion
from fmu_bearing.scene.fidelity import Terms
from fmu_bearing.scene.read import with_fidelity

TERMS = tuple(Terms.model_fields)


@dataclass(frozen=True)
class Setting:
    """One way to compute a scene; ``max_step`` in s, ``without``: names of terms left out."""

    fidelity: str = "full"
    method: str = "esdirk4"
    tolerance: float = 2e-3
    max_step: float = 25e-6
    strips: int = 5
    without: tuple[str, ...] = ()

    def scene(self, scene: Scene) -> Scene:
        """Return the scene computed this way."""
        return with_fidelity(
            scene,
            model=self.fidelity,
            method=self.method,
            tolerance=self.tolerance,
            max_internal_step_us=1e6 * self.max_step,
            traction_strips=self.strips,
            terms=scene.fidelity.terms.model_dump() | dict.fromkeys(self.without, False),
        )

    def carries(self, scene: Scene) -> bool:
        """Whether the scene can be computed this way, see `against`."""
        return not self.against(scene)

    def against(self, scene: Scene) -> str:
        """Return why the scene cannot be computed this way; "": it can.

        Bending rings and another model's shaft need full; local defects full or rings.
        """
        subjects: tuple[Subject, ...] = () if self.fidelity == "full" else ("fidelities",)
        if self.fidelity == "response":
            subjects += ("response",)
        found = (exclusion(scene, subject) for subject in subjects)
        return next((row.reason for row in found if row is not None), "")

    @property
    def name(self) -> str:
        """Fidelity and, for full, method."""
        return f"{self.fidelity} / {self.method}" if self.fidelity == "full" else self.fidelity

    @property
    def left_out(self) -> str:
        """Terms left out, in words."""
        if len(self.without) == len(TERMS):
            return "all that can be"
        return ", ".join(term.replace("_", " ") for term in self.without)
