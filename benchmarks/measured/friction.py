"""Torque of the 7210B and heat of the 35 mm bearing, with all that is assumed moved over its range."""

import functools
import math
from collections.abc import Mapping
from typing import Any

from benchmarks.measured.sources import Value
from fmu_bearing import Dimensions, Scene, new_scene, operating_point
from fmu_bearing.engine.constants import RPM
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.estimate import cage_estimates

KINDS = ("steel", "hybrid")
_DENSITY = 870.0  # kg/m3: spindle-oil's
_LAND = "bearing.cage.land_clearance_mm"
_HOT = 394.0 - 273.15  # degC: oil of the 35 mm rig
_PITCH = 46.5  # mm: of the 35 mm bearing, as somebody else gives it


def _grooves(inner: float, outer: float) -> dict[str, float]:
    return {"bearing.inner_conformity": inner, "bearing.outer_conformity": outer}


def _oil(key: str, value: float) -> dict[str, float]:
    return {f"lubricant.{key}": value}


#: What of the 7210B is assumed, moved alone to the ends of its range.
MOVES_7210B: dict[str, Mapping[str, float]] = {
    "conformities 0.515, 0.52": _grooves(0.515, 0.52),
    "conformities 0.52, 0.53": _grooves(0.52, 0.53),
    "pressure-viscosity coefficient 15 1/GPa": _oil("pressure_viscosity_1_GPa", 15.0),
    "pressure-viscosity coefficient 25 1/GPa": _oil("pressure_viscosity_1_GPa", 25.0),
}
#: The same of the 35 mm bearing.
MOVES_35: dict[str, Mapping[str, float]] = {
    "conformities 0.52": _grooves(0.52, 0.52),
    "conformities 0.54": _grooves(0.54, 0.54),
    "viscosity 0.7 times": _oil("viscosity_Pa_s", 2.8e-6 * _DENSITY),
    "viscosity 1.4 times": _oil("viscosity_Pa_s", 5.6e-6 * _DENSITY),
    "pressure-viscosity coefficient 10 1/GPa": _oil("pressure_viscosity_1_GPa", 10.0),
    "pressure-viscosity coefficient 25 1/GPa": _oil("pressure_viscosity_1_GPa", 25.0),
    "largest traction 0.04": _oil("traction_max", 0.04),
    "largest traction 0.06": _oil("traction_max", 0.06),
    "oil-air 0.9 kg/m3": _oil("oil_air_density_kg_m3", 0.9),
    "oil-air 10 kg/m3": _oil("oil_air_density_kg_m3", 10.0),
    "oil of the lands 0.0034 Pa s": _oil("land_viscosity_Pa_s", 0.0034),
    "oil of the lands 0.008 Pa s": _oil("land_viscosity_Pa_s", 0.008),
    "no oil in the lands": _oil("land_viscosity_Pa_s", 0.0),
    "clearance of the lands 1.4 times": {_LAND: 1.4 * 0.06},
    "clearance of the lands 0.7 times": {_LAND: 0.7 * 0.06},
    "starvation of jets, K_rs 3e-8": _oil("replenishment_constant", 3e-8),
    "inner ring 20 K hotter": {"operation.inner_ring_temperature_degC": _HOT + 20.0},
}


def bearing(
    name: str, size: Dimensions, kind: str, ball: float, count: int, pitch: float | None = None
) -> Scene:  # fmt: skip
    """Return a scene of a bearing whose balls are known; rings and cage follow by the rules for them.

    Oil has one viscosity at any temperature, because sources give it at that of the bearing.
    """
    scene = read_scene_text(new_scene(name, size, kind=kind, sound=False, speed_rpm=1e3, preload_N=500.0))
    middle = 0.5 * (size.bore + size.outside)
    off = 0.0 if pitch is None else pitch - middle
    given: dict[str, Any] = {
        "bearing.ball_diameter_mm": ball, "bearing.ball_count": count,
        "bearing.pitch_diameter_mm": middle + off,
        "bearing.inner_ring_outer_diameter_mm": round(middle + off - 0.7 * ball, 2),
        "bearing.outer_ring_inner_diameter_mm": round(middle + off + 0.7 * ball, 2),
        "lubricant.vogel_B_K": 0.0,
    }  # fmt: skip
    for one in cage_estimates(size.bore + off, size.outside + off, size.width, ball):
        given[f"bearing.cage.{one.key}"] = one.value
    return scene.replace(given | {_LAND: scene.bearing.cage.land_clearance_mm})


@functools.cache
def b7210() -> Scene:
    """Return the 7210B at 40 degC."""
    return bearing("7210B", Dimensions(50.0, 90.0, 20.0, 40.0), "steel", 12.7, 15)


@functools.cache
def b35(kind: str) -> Scene:
    """Return the 35 mm bearing at the temperature of its oil."""
    scene = bearing("35-mm", Dimensions(35.0, 62.0, 14.0, 24.0), kind, 7.14, 16, _PITCH)
    warm = {f"operation.{one}_temperature_degC": _HOT for one in ("oil", "inner_ring", "outer_ring")}
    return scene.replace(warm | {"bearing.inner_conformity": 0.535, "bearing.outer_conformity": 0.535})


def at(scene: Scene, value: Value) -> Scene:
    """Return a scene at the speed, load and viscosity of a value."""
    return scene.replace({
        "operation.speed_rpm": value.speed_rpm, "mounting.preload_N": value.load_N,
        "lubricant.viscosity_Pa_s": 1e-6 * value.viscosity_mm2_s * _DENSITY,
    })  # fmt: skip


def contact_torque(value: Value, moved: Mapping[str, float] | None = None) -> float:
    """Return the torque of rolling and sliding of the 7210B, N mm: without cage, lands and drag."""
    heat = operating_point(at(b7210(), value).replace(moved or {})).heat
    return 1e3 * (heat.rolling + heat.sliding) / (value.speed_rpm * RPM)


def friction_coefficient(value: Value) -> float:
    """Return 2 M / (P d) of the 7210B with all its friction, in thousandths; d is the bore."""
    heat = operating_point(at(b7210(), value)).heat
    return 2e6 * heat.total / (value.speed_rpm * RPM) / (value.load_N * 50.0)


@functools.cache
def _heat_35(kind: str, value: Value, moved: tuple[tuple[str, float], ...]) -> float:
    return operating_point(at(b35(kind), value).replace(dict(moved))).heat.total


def heat_35(value: Value, moved: Mapping[str, float] | None = None, kind: str = "steel") -> float:
    """Return the heat of the 35 mm bearing, W."""
    return _heat_35(kind, value, tuple((moved or {}).items()))


def hybrid_over_steel(value: Value, moved: Mapping[str, float] | None = None) -> float:
    """Return the heat of the 35 mm bearing with ceramic balls over that with steel balls."""
    hybrid, steel = (heat_35(value, moved, kind) for kind in ("hybrid", "steel"))
    return hybrid / steel


def exponent(speeds: list[float], heats: list[float]) -> float:
    """Return n of heat over speed^n between the first and the last speed."""
    return math.log(heats[-1] / heats[0]) / math.log(speeds[-1] / speeds[0])
