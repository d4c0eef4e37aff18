"""Inputs of a set of bearings on one shaft, and their values at the scene's operating point."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import placed
from fmu_bearing.engine.layout import SP
from fmu_bearing.formulas.iso76 import static_rating
from fmu_bearing.interface.inputs import FORCE, KELVIN, SPRING, speed
from fmu_bearing.interface.variable import Variable
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.assembly import preload_asked
from fmu_bearing.scene.member import HELD, set_of

_MOMENT = {"unit": "N.m", "quantity": "Torque", "nominal": 10.0}  # with a range of the set's own
#: Of a moment, in static ratings of all bearings at the distance of the farthest one. With four 7003C
#: fidelity full computes 10 kN m, this range ends at 12 kN m, and 30 kN m are refused.
_OVERLOAD = 5.0

_LOADS = (
    ("nose.force.x", "Load on the shaft's nose along the axis, +X from nose to rear", FORCE),
    ("nose.force.y", "Horizontal load on the shaft's nose", FORCE),
    ("nose.force.z", "Upward load on the shaft's nose", FORCE),
    ("nose.moment.y", "Moment on the nose about +Y, as of an upward force ahead of it", _MOMENT),
    ("nose.moment.z", "Moment on the nose about +Z, as of a force towards -Y ahead of it", _MOMENT),
)
_PLACE = {"unit": "m", "quantity": "Length", "nominal": 1e-5, "min": -1e-2, "max": 1e-2, "display_unit": "um"}
_TILT = {"unit": "rad", "quantity": "Angle", "nominal": 1e-4, "min": -0.1, "max": 0.1}
_RATE = {"unit": "m/s", "quantity": "Velocity", "nominal": 0.1, "min": -100.0, "max": 100.0}
_TURN = {"unit": "rad/s", "quantity": "AngularVelocity", "nominal": 1.0, "min": -1e4, "max": 1e4}
_WAYS = (("x", "along the axis, +X to the rear"), ("y", "horizontal"), ("z", "upwards"))
# what another model gives for its shaft, where X = 0
_PORT = (
    *(
        (f"port.displacement.{axis}", f"Displacement of the shaft at X = 0 {way}", _PLACE)
        for axis, way in _WAYS
    ),
    *((f"port.tilt.{axis}", f"Tilt of the shaft about +{axis.upper()}", _TILT) for axis in "yz"),
    *((f"port.velocity.{axis}", f"Velocity of the shaft at X = 0 {way}", _RATE) for axis, way in _WAYS),
    *((f"port.tilt_rate.{axis}", f"Rate of the shaft's tilt about +{axis.upper()}", _TURN) for axis in "yz"),
)


def set_inputs(scene: Scene) -> NDArray[np.float64]:
    """Return the inputs ``u`` of a set at the scene's operating point."""
    spindle, operation = set_of(scene), si(scene.operation)
    shaft = si(spindle.shaft.model_copy(update={"sections_mm": None, "material": None}))
    housing = si(spindle.housing.model_copy(update={"material": None}))
    u = np.zeros(SP.U_BEARINGS + len(spindle.bearing) * SP.U_ROW)
    u[SP.U_SPEED] = operation.speed
    load = spindle.load
    force = np.array([load.force_x_N, load.force_y_N, load.force_z_N, 0.0, 0.0])
    u[SP.U_NOSE : SP.U_NOSE + SP.PLANE] = placed(1.0, 1e-3 * load.position_mm).T @ force
    u[SP.U_PRELOAD] = preload_asked(spindle)
    u[SP.U_SHAFT_T] = _or(shaft.temperature, operation.inner_ring_temperature)
    u[SP.U_HOUSING_T] = _or(housing.temperature, operation.outer_ring_temperature)
    u[SP.U_PEDESTAL] = _or(housing.pedestal_stiffness, HELD)
    for k, one in enumerate(spindle.bearing):
        at, own = SP.U_BEARINGS + k * SP.U_ROW, si(one)
        u[at + SP.U_OIL] = operation.oil_temperature
        u[at + SP.U_INNER] = _or(own.inner_ring_temperature, operation.inner_ring_temperature)
        u[at + SP.U_OUTER] = _or(own.outer_ring_temperature, operation.outer_ring_temperature)
    return u


def led_inputs(scene: Scene) -> range:
    """Return the places in ``u`` of place and rate of a shaft that another model owns; empty without one."""
    return range(SP.U_PORT, SP.U_PORT + 2 * SP.PLANE) if scene.on_other_shaft else range(0)


def inputs_of_set(scene: Scene) -> list[Variable]:
    """Return the inputs of a set that its scene reads, in the order of the engine's array ``u``."""
    start = set_inputs(scene)
    words = {**_shared(scene), **_of_bearings(len(start))}
    spans = {"nose.moment": largest_moment(scene, start)}
    spans |= {
        f"nose.force.{axis}": most
        for axis, most in zip("xyz", set_of(scene).most_loads(scene.bearing), strict=True)
    }
    for place, (name, text, more) in words.items():
        for span, most in spans.items():
            if name.startswith(span):
                words[place] = (name, text, {**more, "min": -most, "max": most})
    return [
        Variable(name, "input", "continuous", text, start=float(start[place]), array="u", index=place, **more)
        for place, (name, text, more) in sorted(words.items())
    ]


def largest_moment(scene: Scene, start: NDArray[np.float64]) -> float:
    """Return the largest moment on the nose (N m): bearings cannot carry more, or twice the scene's own."""
    bearings = scene.bearings()
    ratings = sum(static_rating(*one.scene.bearing.for_ratings) for one in bearings)
    reach = max(one.position + 1e-3 * one.scene.bearing.pitch_diameter_mm for one in bearings)
    own = np.abs(start[SP.U_NOSE + 3 : SP.U_NOSE + SP.PLANE]).max()
    return float(f"{max(_OVERLOAD * ratings * reach, 2.0 * own):.2g}")


def _or(value: float | None, other: float) -> float:
    return other if value is None else value


def _shared(scene: Scene) -> dict[int, tuple[str, str, dict[str, Any]]]:
    """Return name, description and range of what shaft and housing are given, by place in ``u``."""
    spindle, most_preload = set_of(scene), scene.bearing.most_preload
    words = [
        ("shaft_speed", "Rotational speed of the shaft, right-handed about +X", speed(scene)),
        *(_PORT if spindle.shaft.external else _LOADS),
    ]
    if spindle.preload is not None and spindle.preload.kind == "spring":
        text = "Force of each spring on its sliding outer ring, at standstill and 20 degC"
        words.append(("preload", text, {**FORCE, "min": 0.0, "max": most_preload}))
    words += [
        ("shaft_temperature", "Mean temperature that lengthens the shaft between its bearings", KELVIN),
        ("housing_temperature", "Mean temperature that lengthens the housing between its seats", KELVIN),
    ]
    if spindle.housing.moves:
        text = "Radial stiffness under the housing; the other directions keep their ratio to it"
        words.append(("pedestal_stiffness", text, SPRING))
    elif any(one.seat == "pedestal" for one in spindle.bearing):
        text = "Radial stiffness under each outer ring on a pedestal; other directions keep their ratio to it"
        words.append(("pedestal_stiffness", text, SPRING))
    return {SP.INPUTS.index(name): (name, text, more) for name, text, more in words}


def _of_bearings(size: int) -> dict[int, tuple[str, str, dict[str, Any]]]:
    """Return the same of each bearing."""
    words = (
        "temperature that sets the viscosity of its oil",
        "temperature that expands its inner ring and, by half, its balls",
        "temperature that expands its outer ring and, by half, its balls",
    )
    found = {}
    for place in range(SP.U_BEARINGS, size):
        b, i = divmod(place - SP.U_BEARINGS, SP.U_ROW)
        text = f"Bearing {b + 1}: {words[i]}"
        found[place] = (f"bearing[{b + 1}].{SP.BEARING_INPUTS[i]}", text, KELVIN)
    return found
