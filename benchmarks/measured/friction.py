"""Torque of the 7210B and heat of the 35 mm bearing, with all that is assumed moved over its range."""

import functools
import math
from typing import Any

from benchmarks.measured.sources import Value
from fmu_bearing import Dimensions, Scene, new_scene, operating_point
from fmu_bearing.design.heat import Heat
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE, RPM
from fmu_bearing.engine.layout import C, S
from fmu_bearing.scene import read_scene_text, si
from fmu_bearing.scene.estimate import cage_estimates
from fmu_bearing.steady.rest import started

#: Of the 35 mm bearing.
KINDS = ("steel", "hybrid")
_DENSITY = 870.0  # kg/m3: spindle-oil's

# The 35 mm bearing, as somebody else gives it: mm, K, mm2/s; kg/m3 is assumed.
_PITCH, _BALL, _WIDTH = 46.5, 7.14, 14.0
INLET, _NU = 394.0, 4.0
_ESTER = 860.0
#: Of esters to MIL-L-23699, mm2/s at K: the slope of the rig's oil.
_ESTERS = {313.15: 27.6, 373.15: 5.1}
_LANDS = "lubricant.land_viscosity_Pa_s"
_LAND_GAP, _CAGE_WIDTH = "bearing.cage.land_clearance_mm", "bearing.cage.width_mm"
_POCKET = "bearing.cage.pocket_diameter_mm"
#: Places for the loss of whichever parts are of steel, and of ceramic.
_STEEL_LOSS, _CERAMIC_LOSS = "loss of steel", "loss of ceramic"

Moved = dict[str, Any]


def _double(nu: float) -> float:
    return math.log10(math.log10(nu + 0.7))


_SLOPE = (_double(_ESTERS[313.15]) - _double(_ESTERS[373.15])) / math.log10(373.15 / 313.15)


def ester(nu: float, at: float, to: float) -> float:
    """Return the viscosity (mm2/s) at ``to`` (K) of an ester that has ``nu`` at ``at``: Walther's law."""
    return 10.0**10.0 ** (_double(nu) - _SLOPE * math.log10(to / at)) - 0.7


def _grooves(inner: float, outer: float) -> Moved:
    return {"bearing.inner_conformity": inner, "bearing.outer_conformity": outer}


def _oil(key: str, value: float) -> Moved:
    return {f"lubricant.{key}": value}


def _cold(nu: float, density: float = _ESTER) -> Moved:
    """Return keys of an ester of ``nu`` mm2/s at the inlet."""
    thick = 1e-6 * density * ester(nu, INLET, REFERENCE_TEMPERATURE)
    return {"lubricant.viscosity_Pa_s": thick, "lubricant.density_kg_m3": density}


def _warm(**kelvin: float) -> Moved:
    """Return temperatures by what they are above that of the oil at the inlet."""
    return {f"operation.{key}_temperature_degC": INLET - 273.15 + more for key, more in kelvin.items()}


_HELD: Moved = {
    "mounting.tilt_support.stiffness_N_m_rad": 70600.0, "mounting.tilt_support.damping_ratio": 0.05,
}  # fmt: skip
#: What of the 7210B is assumed, moved alone to the ends of its range.
MOVES_7210B: dict[str, Moved] = {
    "conformities 0.515, 0.52": _grooves(0.515, 0.52),
    "conformities 0.52, 0.53": _grooves(0.52, 0.53),
    "pressure-viscosity coefficient 15 1/GPa": _oil("pressure_viscosity_1_GPa", 15.0),
    "pressure-viscosity coefficient 25 1/GPa": _oil("pressure_viscosity_1_GPa", 25.0),
    "hysteresis loss 0.005": {_STEEL_LOSS: 0.005},
    "hysteresis loss 0.04": {_STEEL_LOSS: 0.04},
}
#: The same of the 35 mm bearing.
MOVES_35: dict[str, Moved] = {
    "conformities 0.52": _grooves(0.52, 0.52),
    "conformities 0.54": _grooves(0.54, 0.54),
    "viscosity 0.7 times": _cold(0.7 * _NU),
    "viscosity 1.4 times": _cold(1.4 * _NU),
    "density of the oil 930 kg/m3": _cold(_NU, 930.0),
    "oil 10 K colder": _warm(oil=-10.0),
    "oil 10 K hotter": _warm(oil=10.0),
    "inner ring 20 K hotter": _warm(inner_ring=20.0),
    "both rings 40 K hotter": _warm(inner_ring=40.0, outer_ring=40.0),
    "pressure-viscosity coefficient 10 1/GPa": _oil("pressure_viscosity_1_GPa", 10.0),
    "pressure-viscosity coefficient 25 1/GPa": _oil("pressure_viscosity_1_GPa", 25.0),
    "rolling law of starved inlets": {"lubricant.rolling_law": "starved"},
    "starvation K_rs 6e-8": _oil("replenishment_constant", 6e-8),
    "hysteresis loss 0.005": {_STEEL_LOSS: 0.005},
    "hysteresis loss 0.04": {_STEEL_LOSS: 0.04},
    "ceramic with the loss of steel": {_CERAMIC_LOSS: 0.021},
    "largest traction 0.03": _oil("traction_max", 0.03),
    "largest traction 0.05": _oil("traction_max", 0.05),
    "conductivity of the oil 0.1 W/(m K)": _oil("conductivity_W_mK", 0.1),
    "slide-to-roll ratio 0.0025": _oil("traction_slide_to_roll", 0.0025),
    "slide-to-roll ratio 0.01": _oil("traction_slide_to_roll", 0.01),
    "traction falls in heated oil": {"fidelity.terms.thermal_traction": True},
    "oil-air 0.9 kg/m3": _oil("oil_air_density_kg_m3", 0.9),
    "oil-air 2.3 kg/m3": _oil("oil_air_density_kg_m3", 2.3),
    "oil-air 10 kg/m3": _oil("oil_air_density_kg_m3", 10.0),
    "drag coefficient 0.1": _oil("drag_coefficient", 0.1),
    "drag coefficient 1": _oil("drag_coefficient", 1.0),
    "no oil in the lands": {_LANDS: 0.0},
    "oil of the lands 6 mPa s": {_LANDS: 0.006},
    "clearance of the lands 0.5 times": {_LAND_GAP: 0.03},
    "clearance of the lands 2 times": {_LAND_GAP: 0.12},
    "width of the lands 0.5 times": {_CAGE_WIDTH: 9.94},
    "cage as wide as the rings: lands 1.26 times": {_CAGE_WIDTH: _WIDTH},
    "pocket friction 0.02": {"bearing.cage.pocket_friction": 0.02},
    "pocket friction 0.1": {"bearing.cage.pocket_friction": 0.1},
    "pockets 1 % larger than a ball": {_POCKET: 1.01 * _BALL},
    "pockets 4 % larger than a ball": {_POCKET: 1.04 * _BALL},
    "cage of PEEK": {"materials.cage": "PEEK"},
    "ring held against tilting as in a new scene": _HELD,
    "222 N across beside the thrust, ring held": {**_HELD, "mounting.radial_load_y_N": 222.0},
}


def bearing(
    name: str, size: Dimensions, kind: str, ball: float, count: int, pitch: float | None = None
) -> Scene:  # fmt: skip
    """Return a scene of a bearing whose balls are known; rings and cage follow by the rules for them."""
    scene = read_scene_text(new_scene(name, size, kind=kind, sound=False, speed_rpm=1e3, preload_N=500.0))
    middle = 0.5 * (size.bore + size.outside)
    off = 0.0 if pitch is None else pitch - middle
    given: dict[str, Any] = {
        "bearing.ball_diameter_mm": ball, "bearing.ball_count": count,
        "bearing.pitch_diameter_mm": middle + off,
        "bearing.inner_ring_outer_diameter_mm": round(middle + off - 0.7 * ball, 2),
        "bearing.outer_ring_inner_diameter_mm": round(middle + off + 0.7 * ball, 2),
    }  # fmt: skip
    for one in cage_estimates(size.bore + off, size.outside + off, size.width, ball):
        given[f"bearing.cage.{one.key}"] = one.value
    return scene.replace(given | {_LAND_GAP: scene.bearing.cage.land_clearance_mm})


@functools.cache
def _b7210() -> Scene:
    """Return the 7210B; its oil has one viscosity at any temperature, because SKF's model is given that.

    Oil-air or grease, as SKF's constant of starvation has it.
    """
    return bearing("7210B", Dimensions(50.0, 90.0, 20.0, 40.0), "steel", 12.7, 15).replace(
        {"lubricant.vogel_B_K": 0.0}
    )


@functools.cache
def _b35(kind: str) -> Scene:
    """Return the 35 mm bearing at the temperature of its oil, with jets of an ester.

    Its lands have that oil, heated by its own shear. Its inner ring is free to tilt: the shaft is not known.
    """
    scene = bearing("35-mm", Dimensions(35.0, 62.0, _WIDTH, 24.0), kind, _BALL, 16, _PITCH)
    oil = {
        "lubricant.supply": "jet", "lubricant.base_oil": "synthetic", "lubricant.viscosity_law": "walther",
        "lubricant.walther_slope": _SLOPE, "mounting.tilt_support": None,
    }  # fmt: skip
    warm = _warm(oil=0.0, inner_ring=0.0, outer_ring=0.0)
    return scene.replace(oil | warm | _cold(_NU) | _grooves(0.535, 0.535))


def _lost(scene: Scene, moved: Moved) -> dict[str, Any]:
    """Return moves with the losses of steel and ceramic at the parts that are of them."""
    steel = ("inner_ring", "outer_ring") + (("balls",) if scene.materials.kind == "steel" else ())
    parts = {_STEEL_LOSS: steel, _CERAMIC_LOSS: () if "balls" in steel else ("balls",)}
    plain = {key: value for key, value in moved.items() if key not in parts}
    given = [(part, moved[key]) for key, of_it in parts.items() if key in moved for part in of_it]
    return plain | {f"materials.{part}.hysteresis_loss": loss for part, loss in given}


def at_7210b(value: Value, moved: Moved | None = None) -> Scene:
    """Return the 7210B at the speed, load and viscosity of a value, and what is moved."""
    scene = _b7210().replace({
        "operation.speed_rpm": value.speed_rpm, "mounting.preload_N": value.load_N,
        "lubricant.viscosity_Pa_s": 1e-6 * value.viscosity_mm2_s * _DENSITY,
    })  # fmt: skip
    return scene.replace(_lost(scene, moved or {}))


def at_35(value: Value, moved: Moved | None = None, kind: str = "steel") -> Scene:
    """Return the 35 mm bearing at the speed and load of a value, and what is moved."""
    scene = _b35(kind).replace({
        "operation.speed_rpm": value.speed_rpm, "mounting.preload_N": value.load_N,
    })  # fmt: skip
    return scene.replace(_lost(scene, moved or {}))


def contact_torque(value: Value, moved: Moved | None = None) -> float:
    """Return the torque of rolling and sliding of the 7210B, N mm: without cage, lands and drag."""
    heat = operating_point(at_7210b(value, moved)).heat
    return 1e3 * (heat.rolling + heat.sliding) / (value.speed_rpm * RPM)


def friction_coefficient(value: Value) -> float:
    """Return 2 M / (P d) of the 7210B with all its friction, in thousandths; d is the bore."""
    heat = operating_point(at_7210b(value)).heat
    return 2e6 * heat.total / (value.speed_rpm * RPM) / (value.load_N * 50.0)


@functools.cache
def _heats_35(kind: str, value: Value, moved: tuple[tuple[str, Any], ...]) -> Heat:
    return operating_point(at_35(value, dict(moved), kind)).heat


def heats_35(value: Value, moved: Moved | None = None, kind: str = "steel") -> Heat:
    """Return the heat of the 35 mm bearing by where it arises."""
    return _heats_35(kind, value, tuple((moved or {}).items()))


def heat_35(value: Value, moved: Moved | None = None, kind: str = "steel") -> float:
    """Return the heat of the 35 mm bearing, W."""
    return heats_35(value, moved, kind).total


def centred_35(value: Value, kind: str) -> float:
    """Return the heat (W) of the 35 mm bearing, were its cage in the middle: Petroff's loss, no pockets."""
    scene, heat = at_35(value, kind=kind), heats_35(value, kind=kind)
    run, cage = started(scene, fidelity="response"), si(scene.bearing.cage)
    radius = 0.5 * cage.bore - cage.land_clearance
    slide = radius * value.speed_rpm * RPM * (1.0 - run.get("cage.speed_ratio"))
    area = 2.0 * math.pi * radius * (cage.width - cage.pocket_diameter)  # of both lands
    viscosity = float(run.s[S.C + C.LAND_VISCOSITY])
    return heat.total - heat.cage + viscosity * slide**2 * area / cage.land_clearance


def hybrid_over_steel(value: Value, moved: Moved | None = None) -> float:
    """Return the heat of the 35 mm bearing with ceramic balls over that with steel balls."""
    hybrid, steel = (heat_35(value, moved, kind) for kind in ("hybrid", "steel"))
    return hybrid / steel


def exponent(speeds: list[float], heats: list[float]) -> float:
    """Return n of heat over speed^n between the first and the last speed."""
    return math.log(heats[-1] / heats[0]) / math.log(speeds[-1] / speeds[0])
