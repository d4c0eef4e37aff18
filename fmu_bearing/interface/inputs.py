"""Continuous inputs: public names of places in the engine's ``u``, and their values in a scene.

What single bearings and sets call by other names is the same place: the load on the nose is for a single
bearing that on its inner ring.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import rigid_transform
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import SP, Q, U
from fmu_bearing.formulas.iso76 import static_rating
from fmu_bearing.interface.variable import Variable
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.member import HELD, set_of

#: Place in ``u``, public name, description; unit, range and nominal value.
Row = tuple[int, str, str, dict[str, Any]]

_FORCE: dict[str, Any] = {"unit": "N", "quantity": "Force", "nominal": 100.0}
_MOMENT: dict[str, Any] = {"unit": "N.m", "quantity": "Torque", "nominal": 10.0}
_SPEED: dict[str, Any] = {
    "unit": "rad/s",
    "nominal": 1000.0,
    "quantity": "AngularVelocity",
    "display_unit": "r/min",
}
_SPRING: dict[str, Any] = {
    "unit": "N/m",
    "min": 1e4,
    "max": 1e12,
    "nominal": 1e8,
    "quantity": "TranslationalSpringConstant",
}
_KELVIN: dict[str, Any] = {
    "unit": "K",
    "min": 233.0,
    "max": 473.0,
    "nominal": 300.0,
    "quantity": "ThermodynamicTemperature",
    "display_unit": "degC",
}
#: Of a moment, in static ratings of all bearings at the distance of the farthest one. With four 7003C
#: fidelity full computes 10 kN m, this range ends at 12 kN m, and 30 kN m are refused.
_OVERLOAD = 5.0

_LOADS = (
    ("nose.force.x", "Load on the shaft's nose along the axis, +X from nose to rear", _FORCE),
    ("nose.force.y", "Horizontal load on the shaft's nose", _FORCE),
    ("nose.force.z", "Upward load on the shaft's nose", _FORCE),
    ("nose.moment.y", "Moment on the nose about +Y, as of an upward force ahead of it", _MOMENT),
    ("nose.moment.z", "Moment on the nose about +Z, as of a force towards -Y ahead of it", _MOMENT),
)
_PLACE: dict[str, Any] = {
    "unit": "m",
    "quantity": "Length",
    "nominal": 1e-5,
    "min": -1e-2,
    "max": 1e-2,
    "display_unit": "um",
}
_TILT: dict[str, Any] = {"unit": "rad", "quantity": "Angle", "nominal": 1e-4, "min": -0.1, "max": 0.1}
_RATE: dict[str, Any] = {"unit": "m/s", "quantity": "Velocity", "nominal": 0.1, "min": -100.0, "max": 100.0}
_TURN: dict[str, Any] = {
    "unit": "rad/s",
    "quantity": "AngularVelocity",
    "nominal": 1.0,
    "min": -1e4,
    "max": 1e4,
}
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


def inputs_of(scene: Scene) -> list[Variable]:
    """Return the inputs that a scene reads, in the order of the value references."""
    start = input_values(scene)
    speed = "Rotational speed of the shaft, right-handed about +X"
    rows = [
        (U.SPEED, "shaft_speed", speed, _SPEED | _symmetric(_fastest(scene))),
        *(_of_shaft(scene, start) if scene.assembly.joined else _of_mounting(scene)),
    ]
    return [
        Variable(
            name, "input", "continuous", words, start=float(start[place]), array="u", index=place, **more
        )
        for place, name, words, more in rows
    ]


def input_values(scene: Scene) -> NDArray[np.float64]:
    """Return the engine's inputs ``u`` at the scene's operating point, SI units.

    Inputs that are no variables are included: a partner without a temperature of its own has its ring's.
    """
    operation, members = si(scene.operation), scene.assembly.members
    u = np.zeros(U.BEARINGS + max(len(members), 1) * U.ROW)
    u[U.SPEED] = operation.speed
    u[U.PRELOAD] = scene.assembly.preload_N
    rings = operation.inner_ring_temperature, operation.outer_ring_temperature
    u[U.OIL_T], u[U.INNER_T], u[U.OUTER_T] = operation.oil_temperature, *rings
    for k, member in enumerate(members):
        at, own = U.BEARINGS + k * U.ROW, si(member)
        u[at + U.OIL] = operation.oil_temperature
        u[at + U.INNER] = _or(own.inner_ring_temperature, rings[0])
        u[at + U.OUTER] = _or(own.outer_ring_temperature, rings[1])
    if not scene.assembly.joined:
        mounting = si(scene.mounted)
        u[U.LOAD_Y], u[U.LOAD_Z] = mounting.radial_load_y, mounting.radial_load_z
        partners = tuple(None if seat is None else si(seat).temperature for seat in _seats(scene))
        pedestal = mounting.pedestal_stiffness
    else:
        spindle = set_of(scene)
        force = np.array([spindle.load.force_x_N, spindle.load.force_y_N, spindle.load.force_z_N, 0.0, 0.0])
        u[U.NOSE : U.NOSE + SP.PLANE] = rigid_transform(1.0, 1e-3 * spindle.load.position_mm).T @ force
        shaft = si(spindle.shaft.model_copy(update={"sections_mm": None, "material": None}))
        housing = si(spindle.housing.model_copy(update={"material": None}))
        partners, pedestal = (shaft.temperature, housing.temperature), housing.pedestal_stiffness
    u[U.SHAFT_T], u[U.HOUSING_T] = (_or(own, ring) for own, ring in zip(partners, rings, strict=True))
    u[U.PEDESTAL] = _or(pedestal, HELD)
    return u


def led_inputs(scene: Scene) -> range:
    """Return the places in ``u`` of place and rate of a shaft that another model owns; empty without one."""
    return range(U.PORT, U.PORT + 2 * SP.PLANE) if scene.on_other_shaft else range(0)


def largest_moment(scene: Scene, start: NDArray[np.float64]) -> float:
    """Return the largest moment on the nose (N m): bearings cannot carry more, or twice the scene's own."""
    bearings = scene.bearings()
    ratings = sum(static_rating(*bearing.scene.bearing.for_ratings) for bearing in bearings)
    reach = max(bearing.position + 1e-3 * bearing.scene.bearing.pitch_diameter_mm for bearing in bearings)
    own = np.abs(start[U.NOSE + Q.INNER_BY : U.NOSE + SP.PLANE]).max()
    return float(f"{max(_OVERLOAD * ratings * reach, 2.0 * own):.2g}")


def _or(value: float | None, other: float) -> float:
    return other if value is None else value


def _symmetric(most: float) -> dict[str, float]:
    """Range to both sides of zero."""
    return {"min": -most, "max": most}


def _fastest(scene: Scene) -> float:
    """Return the largest shaft speed (rad/s), in five digits, rounded up."""
    most = scene.most_speed * RPM
    digits = 10.0 ** (math.floor(math.log10(most)) - 4)
    return math.ceil(most / digits) * digits


def _seats(scene: Scene) -> tuple[Any, Any]:
    """Return the fits of a single bearing on its shaft and in its housing, None without one."""
    return (None, None) if scene.fit is None else (scene.fit.shaft, scene.fit.housing)


def _of_mounting(scene: Scene) -> list[Row]:
    """Return what a single bearing is given beside the speed."""
    load = _FORCE | _symmetric(scene.bearing.most_radial)
    preload = "Axial force that pushes the inner ring towards +X"
    if scene.mounted.preload_mode == "rigid":
        preload += ", at standstill and 20 degC; its displacement is then held"
    pedestal = "Radial stiffness under the outer ring; the other directions keep their ratio to it"
    grown = "Temperature that expands the {} ring and, by half, the balls"
    rows = [
        (
            U.PRELOAD,
            "preload",
            preload,
            {**_FORCE, "min": scene.bearing.least_preload, "max": scene.bearing.most_preload},
        ),
        (U.PEDESTAL, "pedestal_stiffness", pedestal, _SPRING),
        (U.LOAD_Y, "radial_load.y", "Horizontal load on the inner ring", load),
        (U.LOAD_Z, "radial_load.z", "Upward load on the inner ring", load),
        (U.OIL_T, "oil_temperature", "Temperature that sets the oil's viscosity", _KELVIN),
        (U.INNER_T, "inner_ring_temperature", grown.format("inner"), _KELVIN),
        (U.OUTER_T, "outer_ring_temperature", grown.format("outer"), _KELVIN),
    ]
    names = (U.SHAFT_T, "shaft", "inner"), (U.HOUSING_T, "housing", "outer")
    for (place, name, ring), seat in zip(names, _seats(scene), strict=True):
        if seat is not None and seat.temperature_degC is not None:
            words = f"Temperature of the {name}, which with that of the {ring} ring sets its fit"
            rows.append((place, f"{name}_temperature", words, _KELVIN))
    return rows


def _of_shaft(scene: Scene, start: NDArray[np.float64]) -> list[Row]:
    """Return what shaft, housing and each bearing of a set are given beside the speed."""
    spindle, rows = set_of(scene), list[Row]()
    if not spindle.shaft.external:
        most = (*spindle.most_loads(scene.geometries), *[largest_moment(scene, start)] * 2)
        for k, ((name, text, more), limit) in enumerate(zip(_LOADS, most, strict=True)):
            rows.append((U.NOSE + k, name, text, more | _symmetric(limit)))
    if spindle.preload is not None and spindle.preload.kind == "spring":
        text = "Force of each spring on its sliding outer ring, at standstill and 20 degC"
        most_preload = min(one.most_preload for one in scene.geometries)
        rows.append((U.PRELOAD, "preload", text, {**_FORCE, "min": 0.0, "max": most_preload}))
    for place, part, ends in ((U.SHAFT_T, "shaft", "bearings"), (U.HOUSING_T, "housing", "seats")):
        text = f"Mean temperature that lengthens the {part} between its {ends}"
        rows.append((place, f"{part}_temperature", text, _KELVIN))
    if spindle.housing.moves:
        text = "Radial stiffness under the housing; the other directions keep their ratio to it"
        rows.append((U.PEDESTAL, "pedestal_stiffness", text, _SPRING))
    elif any(bearing.seat == "pedestal" for bearing in spindle.bearing):
        text = "Radial stiffness under each outer ring on a pedestal; other directions keep their ratio to it"
        rows.append((U.PEDESTAL, "pedestal_stiffness", text, _SPRING))
    if spindle.shaft.external:
        rows += [(U.PORT + k, *one) for k, one in enumerate(_PORT)]
    words = (
        "temperature that sets the viscosity of its oil",
        "temperature that expands its inner ring and, by half, its balls",
        "temperature that expands its outer ring and, by half, its balls",
    )
    for b in range(len(spindle.bearing)):
        for i, (name, text) in enumerate(zip(U.BEARING_INPUTS, words, strict=True)):
            place = U.BEARINGS + b * U.ROW + i
            rows.append((place, f"bearing[{b + 1}].{name}", f"Bearing {b + 1}: {text}", _KELVIN))
    return rows
