"""A model with its variables as the FMU shows them, whose names and causalities the scene may change."""

from dataclasses import dataclass

from fmu_bearing.interface import shown
from fmu_bearing.prepare.model import Model

__all__ = ["ShownModel", "as_shown"]


@dataclass(frozen=True)
class ShownModel(Model):
    """A model whose variables have the names and causalities of the FMU."""

    @property
    def is_flat(self) -> bool:
        """Whether names are identifiers instead of structured ones."""
        return self.scene.fmu is not None and self.scene.fmu.naming == "flat"


def as_shown(model: Model) -> ShownModel:
    """Return the model as its FMU shows it; one that is so already stays.

    Raises
    ------
    SceneError
        If ``[fmu]`` of the scene names variables that the model does not have.
    """
    if isinstance(model, ShownModel):
        return model
    return ShownModel(model.scene, model.parameters, shown(model.scene, model.variables), model.note)
