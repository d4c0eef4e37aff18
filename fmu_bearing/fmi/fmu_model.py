"""A model with its variables as the FMU shows them, whose names and causalities the scene may change."""

from dataclasses import dataclass

from fmu_bearing.interface import flat, fmu_variables, variables
from fmu_bearing.prepare.model import Model
from fmu_bearing.prepare.unread_outputs import without_unread

__all__ = ["FmuModel", "as_fmu_model"]


@dataclass(frozen=True)
class FmuModel(Model):
    """A model whose variables have the names and causalities of the FMU."""

    @property
    def left_out(self) -> frozenset[str]:
        """Names of what the scene's bearing has, and its FMU does not."""
        every = (variable.name for variable in variables(self.scene, 0.0))
        named = {flat(name) if self.is_flat else name for name in every}
        return frozenset(named.difference(variable.name for variable in self.variables))

    @property
    def is_flat(self) -> bool:
        """Whether names are identifiers instead of structured ones."""
        return self.scene.fmu is not None and self.scene.fmu.naming == "flat"


def as_fmu_model(model: Model) -> FmuModel:
    """Return the model as its FMU shows it; one that is so already stays.

    Raises
    ------
    SceneError
        If ``[fmu]`` of the scene names variables that the model does not have.
    """
    if isinstance(model, FmuModel):
        return model
    shown = fmu_variables(model.scene, model.variables)
    return FmuModel(model.scene, without_unread(model.parameters, shown), shown, model.note)
