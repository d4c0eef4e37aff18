"""Continuous inputs, with the scene's values as start values."""

import math
from typing import Any

from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import U
from fmu_bearing.interface.variable import Variable
from fmu_bearing.scene import Scene, si

#: Units, ranges and nominal values of inputs.
SPEED = {
    "unit": "rad/s",
    "nominal": 1000.0,
    "quantity": "AngularVelocity",
    "display_unit": "r/min",
}
FORCE = {"unit": "N", "quantity": "Force", "nominal": 100.0}
SPRING = {
    "unit": "N/m",
    "min": 1e4,
    "max": 1e12,
    "nominal": 1e8,
    "quantity": "TranslationalSpringConstant",
}
KELVIN = {
    "unit": "K",
    "min": 233.0,
    "max": 473.0,
    "nominal": 300.0,
    "quantity": "ThermodynamicTemperature",
    "display_unit": "degC",
}


def speed(scene: Scene) -> dict[str, Any]:
    """Return unit, range and nominal value of a shaft speed; the largest, in five digits, is rounded up."""
    most = scene.bearing.most_speed * RPM
    digits = 10.0 ** (math.floor(math.log10(most)) - 4)
    most = math.ceil(most / digits) * digits
    return {**SPEED, "min": -most, "max": most}


def inputs(scene: Scene) -> list[Variable]:
    """Return the inputs of the model, in the order of the engine's array ``u``."""
    mounting, start = si(scene.mounted), si(scene.operation)
    most = scene.bearing.most_radial
    load = {**FORCE, "min": -most, "max": most}
    preload = "Axial force that pushes the inner ring towards +X"
    if scene.mounted.preload_mode == "rigid":
        preload += ", at standstill and 20 degC; its displacement is then held"
    rows: tuple[tuple[str, str, dict[str, Any], float], ...] = (
        ("shaft_speed", "Rotational speed of the shaft, right-handed about +X", speed(scene), start.speed),
        ("preload", preload, {**FORCE, "min": 0.0, "max": scene.bearing.most_preload}, mounting.preload),
        (
            "pedestal_stiffness",
            "Radial stiffness under the outer ring; the other directions keep their ratio to it",
            SPRING,
            mounting.pedestal_stiffness,
        ),
        ("radial_load.y", "Horizontal load on the inner ring", load, mounting.radial_load_y),
        ("radial_load.z", "Upward load on the inner ring", load, mounting.radial_load_z),
        ("oil_temperature", "Temperature that sets the oil's viscosity", KELVIN, start.oil_temperature),
        (
            "inner_ring_temperature",
            "Temperature that expands the inner ring and, by half, the balls",
            KELVIN,
            start.inner_ring_temperature,
        ),
        (
            "outer_ring_temperature",
            "Temperature that expands the outer ring and, by half, the balls",
            KELVIN,
            start.outer_ring_temperature,
        ),
    )
    rows += _partners(scene)
    return [
        Variable(
            name, "input", "continuous", words, start=value, array="u", index=U.INPUTS.index(name), **more
        )
        for name, words, more, value in rows
    ]


def _partners(scene: Scene) -> tuple[tuple[str, str, dict[str, Any], float], ...]:
    """Return the temperatures of shaft and housing, where fits have any: absent ones are the rings'."""
    fit, rows = scene.fit, []
    seats = () if fit is None else (("shaft", "inner", fit.shaft), ("housing", "outer", fit.housing))
    for name, ring, seat in seats:
        if seat is not None and seat.temperature_degC is not None:
            words = f"Temperature of the {name}, which with that of the {ring} ring sets its fit"
            rows.append((f"{name}_temperature", words, KELVIN, si(seat).temperature))
    return tuple(rows)
