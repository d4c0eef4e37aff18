"""A scene: one bearing, its mounting, its oil, its microphones, what to model and how finely."""

import math

import tomli_w
from pydantic import Field, model_validator

from fmu_bearing.scene.base import Part
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.fidelity import Fidelity
from fmu_bearing.scene.imperfections import Imperfections
from fmu_bearing.scene.lubricant import Lubricant
from fmu_bearing.scene.material import Materials
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.sound import Point, Sound


class Operation(Part):
    """Speed and temperatures at the start; all are inputs of the FMU."""

    speed_rpm: float = Field(ge=-1e5, le=1e5, examples=[20000.0], description="shaft speed")
    oil_temperature_degC: float = Field(ge=-40, le=200, examples=[20.0], description="oil")
    inner_ring_temperature_degC: float = Field(ge=-40, le=200, examples=[20.0], description="inner ring")
    outer_ring_temperature_degC: float = Field(ge=-40, le=200, examples=[20.0], description="outer ring")


class Scene(Part):
    """Everything a model is made from."""

    name: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._ -]{0,59}$", examples=["7003C-spindle"])
    bearing: Bearing
    materials: Materials
    lubricant: Lubricant
    mounting: Mounting
    operation: Operation
    fidelity: Fidelity
    imperfections: Imperfections | None = None
    sound: Sound | None = None

    @model_validator(mode="after")
    def _together(self) -> "Scene":
        if self.bearing.cage is not None and self.materials.cage is None:
            raise ValueError("materials.cage is missing: the bearing has a cage")
        if self.sound is not None:
            if self.sound.radiator == "housing" and self.mounting.housing is None:
                raise ValueError("sound.radiator = 'housing' needs a table [mounting.housing]")
            self._microphones_outside()
        return self

    def _microphones_outside(self) -> None:
        """Refuse a microphone within a radiating body."""
        b = self.bearing
        radius, low, high = b.outside_diameter_mm / 2, -b.width_mm / 2, b.width_mm / 2
        body = "bearing"
        if self.sound is not None and self.sound.radiator == "housing" and self.mounting.housing is not None:
            h = self.mounting.housing
            low = -b.width_mm / 2 - h.front_face_mm
            radius, high, body = h.diameter_mm / 2, low + h.length_mm, "housing"
        for name, (x, y, z) in self.microphones:
            if low < 1e3 * x < high and 1e3 * math.hypot(y, z) < radius:
                raise ValueError(
                    f"microphone '{name}' at x = {1e3 * x:g}, r = {1e3 * math.hypot(y, z):g} mm lies inside "
                    f"the {body}, which reaches to r = {radius:g} mm from x = {low:g} to {high:g} mm"
                )

    @property
    def microphones(self) -> list[tuple[str, Point]]:
        """Names and places (m) of all microphones; empty without sound."""
        return [] if self.sound is None else self.sound.points()

    def to_toml(self) -> str:
        """Write the scene, catalogue entries resolved, as TOML that reads back to an equal scene."""
        return tomli_w.dumps(self.model_dump(mode="json", exclude_none=True))
