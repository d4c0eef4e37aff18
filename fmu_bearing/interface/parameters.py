"""Parameters, which are set before initialisation, and constants, which are fixed when the model is built."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any, get_args

from fmu_bearing.engine.choices import FIDELITIES, METHODS
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P
from fmu_bearing.formulas import iso76, makers
from fmu_bearing.interface.variable import Variable, usual
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.fit import interferences
from fmu_bearing.scene.preload import classes
from fmu_bearing.scene.seats import SMALLEST_RATIO
from fmu_bearing.scene.sound import Radiator, Sound
from fmu_bearing.scene.spindle import SetBearing

#: Numbers of the radiators.
RADIATORS = {name: number for number, name in enumerate(("none", *get_args(Radiator)))}


def parameters(scene: Scene) -> list[Variable]:
    """Return the parameters: places of ``p`` that may be set before initialisation."""
    fidelity = si(scene.fidelity)
    table = [
        _tunable(
            "tolerance", P.TOLERANCE, "Relative error of ring velocities", fidelity.tolerance, 1e-6, 0.1
        ),
        _tunable(
            "max_internal_step",
            P.MAX_STEP,
            "Largest internal step",
            fidelity.max_internal_step,
            1e-7,
            1e-4,
            "s",
        ),
        _tunable(
            "lubricant.viscosity_ref",
            P.VISCOSITY,
            "Dynamic viscosity of the oil at 20 degC",
            si(scene.lubricant).viscosity,
            1e-3,
            2.0,
            "Pa.s",
        ),
    ]
    table += _interferences(scene)
    if scene.imperfections is not None:
        words = "Factor on all imperfections"
        table.append(_tunable("imperfection.scale", P.IMPERFECTION_SCALE, words, 1.0, 0.0, 100.0))
        table += _defect_scales(scene)
    if scene.sound is not None:
        table += _metering(scene.sound.time_weighting, si(scene.sound).metering_start)
    elif scene.accelerometers:
        table.append(_metering_start(Sound.model_fields["metering_start_s"].default))
    return table


def _defect_scales(scene: Scene) -> list[Variable]:
    """Return the scales of the local defects, which may be changed between steps: growth can be stepped."""
    table = []
    for b, bearing in enumerate(scene.bearings()):
        for k, (number, defect) in enumerate(scene.defects_of(b).items(), start=1):
            words = f"Factor on the depth of a local defect, which may change between steps: {defect.words}"
            place = P.DEFECT_SCALE + number
            scale = _tunable(f"{bearing.prefix}defect[{k}].scale", place, words, 1.0, 0.0, 100.0)
            table.append(replace(scale, variability="tunable"))
    return table


def _interferences(scene: Scene) -> list[Variable]:
    """Return the interferences of shaft and housing, of a set those of all bearings."""
    table = []
    first = scene.geometries[0]
    places = ("shaft", first.bore_mm), ("housing", first.outside_diameter_mm)
    for race, ((name, seat_mm), found) in enumerate(zip(places, interferences(scene), strict=True)):
        if found is not None:
            words = f"Interference with the {name} on diameter at 20 degC and standstill, + tight"
            if len(scene.assembly.members) > 1:
                words += "; of the first bearing, the others keep their difference from it"
            place, most = P.INTERFERENCE + race, 1e-3 * seat_mm / SMALLEST_RATIO
            value = 1e-6 * found.um
            table.append(_tunable(f"fit.{name}_interference", place, words, value, -most, most, "m"))
    return table


def constants(scene: Scene, rotor_inertia: float, rings: tuple[float, float, float]) -> list[Variable]:
    """Return the constants: choices made when the model was built."""
    radiator = RADIATORS["none" if scene.sound is None else scene.sound.radiator]
    table = [
        _whole(
            "fidelity",
            "Fidelity: " + _numbered(enumerate(FIDELITIES)),
            FIDELITIES.index(scene.fidelity.model),
        ),
        _whole(
            "method",
            "Integrator of fidelity full: " + _numbered((number, name) for name, number in METHODS.items()),
            METHODS[scene.fidelity.method],
        ),
        _whole(
            "radiator",
            "What radiates: 0 nothing, 1 the bare bearing, 2 the housing, 3 its face in a rigid plane",
            radiator,
        ),
        *_turning(scene, rotor_inertia, rings),
    ]
    if scene.imperfections is not None:
        seed = scene.imperfections.seed
        table.append(_whole("imperfection.seed", "Seed of the imperfections", seed))
    if scene.differing:
        for bearing in scene.bearings():
            head, words = bearing.prefix, f"Bearing {bearing.number}: "
            table += [
                replace(one, name=head + one.name, description=words + one.description)
                for one in _ratings(bearing.scene)
            ]
    else:
        table += _ratings(scene)
    table += _arrangement(scene.assembly.members)
    for k, (name, place) in enumerate(scene.microphones):
        for axis, metres in zip("xyz", place, strict=True):
            words = f"Place of microphone {name}, {axis}"
            table.append(_constant(f"mic[{k + 1}].position.{axis}", words, metres, "m", nominal=0.1))
    return table


def _turning(scene: Scene, polar: float, rings: tuple[float, float, float]) -> list[Variable]:
    """Return inertia that belongs to another model: to the drive, or to the rotor at a mechanical port."""
    if scene.on_other_shaft:
        mass, static, transverse = rings
        words, unit = "of the inner rings, which the rotor has", "kg.m2"
        return [
            _constant("port.mass", f"Mass {words}", mass, "kg"),
            _constant("port.static_moment", f"Mass times distance from X = 0 {words}", static, "kg.m"),
            _constant("port.inertia.transverse", f"Inertia {words}, about Y or Z at X = 0", transverse, unit),
            _constant("port.inertia.polar", f"Inertia {words}, about the axis", polar, unit),
        ]
    what = "shaft and inner rings" if scene.assembly.joined else "inner ring and rotor"
    return [_constant("rotor.inertia", f"Polar inertia of {what}, which the drive owns", polar, "kg.m2")]


def _arrangement(members: Sequence[SetBearing]) -> list[Variable]:
    """Return where each bearing of a set is, and which way it carries."""
    table = []
    for b, member in enumerate(members, start=1):
        words = f"Bearing {b}: ball plane from the shaft's nose, towards +X"
        place = si(member).position
        table.append(_constant(f"bearing[{b}].position", words, place, "m", nominal=0.1))
        words = f"Bearing {b}: 1 where it carries force on the shaft towards +X, -1 where towards -X"
        table.append(_whole(f"bearing[{b}].direction", words, member.sign))
    return table


def _ratings(scene: Scene) -> list[Variable]:
    """Return ratings and limits that need no run; rings of ceramics have none."""
    bearing, kind = scene.bearing, scene.materials.kind
    if not scene.materials.steel_rings:
        return []
    table = []
    greased = scene.lubricant.greased
    limit = makers.speed_limit(bearing.nominal_angle_deg, kind == "hybrid", greased)
    if limit is not None:
        supply = "grease, on springs (NSK)" if greased else "oil, on springs (GMN, NSK)"
        words = f"Shaft speed up to which makers run such a bearing with {supply}"
        speed = limit / bearing.pitch_diameter_mm * RPM
        table.append(_constant("rating.speed_limit", words, speed, "rad/s", display_unit="r/min"))
    dynamic = bearing.dynamic_rating
    words = "Dynamic load rating C (ISO 281)"
    table.append(_constant("rating.dynamic", words, dynamic, "N", nominal=1e4))
    factor, words = (iso76.HYBRID, ", 0.7 of it for ceramic balls (GMN)") if kind == "hybrid" else (1.0, "")
    static = factor * iso76.static_rating(*bearing.for_ratings)
    table.append(
        _constant("rating.static", f"Static load rating C0 (ISO 76{words})", static, "N", nominal=1e4)
    )
    maker, loads = classes(bearing) or ("", {})
    for name, load in loads.items():
        words = f"Preload of the {name} class ({maker})"
        table.append(_constant(f"rating.preload_{name.replace(' ', '_')}", words, load, "N"))
    if bearing.is_deep_groove:
        return table
    words = "Contact pressure of makers' heaviest preload class (GMN, NSK; computed)"
    pressure = {"min": 0.0, "max": 1e12, "nominal": 1e9, "display_unit": "GPa"}
    table.append(_constant("rating.pressure_limit", words, makers.CLASS_PRESSURE[kind], "Pa", **pressure))
    return table


def _tunable(
    name: str, index: int, description: str, value: float, low: float, high: float, unit: str = ""
) -> Variable:
    return Variable(
        name,
        "parameter",
        "fixed",
        description,
        unit=unit,
        start=value,
        array="p",
        index=index,
        **usual(unit, {"min": low, "max": high, "nominal": value or 1.0}),
    )


def _metering(weighting: str, start: float) -> list[Variable]:
    words = "Time constant of the levels: 0.125 Fast, 1 Slow"
    constant = 0.125 if weighting == "fast" else 1.0
    return [
        _tunable("sound.time_weighting", P.TIME_WEIGHTING, words, constant, 0.02, 10.0, "s"),
        _metering_start(start),
    ]


def _metering_start(start: float) -> Variable:
    words = "Time after initialisation at which metering begins"
    return _tunable("sound.metering_start", P.METERING_START, words, start, 0.0, 1000.0, "s")


def _constant(name: str, description: str, value: float, unit: str, **more: Any) -> Variable:
    return Variable(name, "local", "constant", description, unit=unit, value=value, **usual(unit, more))


def _whole(name: str, description: str, value: int) -> Variable:
    return Variable(name, "local", "constant", description, type="Integer", value=value)


def _numbered(choices: Iterable[tuple[int, str]]) -> str:
    return ", ".join(f"{number} {name}" for number, name in choices)
