"""One variable, defaults for its unit, and one at a place of the outputs."""

from dataclasses import dataclass
from typing import Any

from fmu_bearing.engine.layout import Z


@dataclass(frozen=True)
class Variable:
    """One variable of the model.

    ``array`` names the engine's flat array (``u``, ``z`` or ``p``; empty for a constant) and ``index`` the
    place there. ``value`` is that of a constant. Ranges and starts are in SI units.
    """

    name: str
    causality: str
    variability: str
    description: str
    type: str = "Real"
    unit: str = ""
    display_unit: str = ""
    quantity: str = ""
    min: float | None = None
    max: float | None = None
    nominal: float | None = None
    start: float | None = None
    array: str = ""
    index: int = 0
    value: float | None = None


# What a variable has unless it says otherwise, by unit: quantity, min, max, nominal. The bounds of what is
# read lie beyond anything a bearing does; they show a tool where a value has lost its meaning.
USUAL = {
    "m": ("Length", -1e3, 1e3, 1e-6),
    "m/s2": ("Acceleration", -1e7, 1e7, 1.0),
    "m/s": ("Velocity", -1e4, 1e4, 1e-2),
    "N": ("Force", 0.0, 1e7, 100.0),
    "N.m": ("Torque", -1e5, 1e5, 1e-2),
    "N/m": ("TranslationalSpringConstant", 0.0, 1e13, 1e8),
    "N.m/rad": ("RotationalSpringConstant", 0.0, 1e13, 1e5),
    "W": ("Power", -1e8, 1e8, 10.0),
    "Pa": ("Pressure", -1e5, 1e5, 1e-2),
    "Pa.s": ("DynamicViscosity", 0.0, 10.0, 1e-2),
    "rad/s": ("AngularVelocity", -1e6, 1e6, 1e3),
    "1/s": ("GrowthRate", 0.0, 1e6, 100.0),
    "rad": ("Angle", -3.2, 3.2, 0.3),
    "dB": ("Level", -200.0, 300.0, 60.0),
    "kg": ("Mass", 0.0, 1e6, 1.0),
    "kg.m": ("MassMoment", -1e6, 1e6, 1e-2),
    "kg.m2": ("MomentOfInertia", 0.0, 1e6, 1e-5),
    "s": ("Time", 0.0, 1e4, 1e-3),
    "": ("Ratio", -1e9, 1e9, 1.0),
}


def usual(unit: str, more: dict[str, Any]) -> dict[str, Any]:
    """Keywords of a variable, completed by the defaults for its unit."""
    return {**dict(zip(("quantity", "min", "max", "nominal"), USUAL[unit], strict=True)), **more}


def read(
    name: str, causality: str, description: str, unit: str = "", index: int | None = None, **more: Any
) -> Variable:
    """Output or local variable at its place in ``z``."""
    place = Z.BEARING_OUTPUTS.index(name) if index is None else index
    return Variable(
        name, causality, "continuous", description, unit=unit, array="z", index=place, **usual(unit, more)
    )
