"""Verdicts on a scene's bearings at their operating point, and on the whole.

A limit is from a standard, a maker's rule or a rule of the field, and its source is given. Figures without a
limit are `not judged`: limits for steel hold for no ceramic rings, and hybrid bearings have no modified life.
"""

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from fmu_bearing.design.fit_verdicts import fit_verdicts, mounted_preload
from fmu_bearing.design.mounted import preloads
from fmu_bearing.design.operating_point import RINGS, BearingPoint, OperatingPoint
from fmu_bearing.design.preload_verdicts import preload_verdicts
from fmu_bearing.design.rating import preload_classes, unclassed, unrated
from fmu_bearing.design.seal_verdicts import seal_verdicts
from fmu_bearing.design.verdict import Judgement, Verdict, judged_life, shown_hours, unjudged
from fmu_bearing.formulas import iso76, iso281, makers
from fmu_bearing.modal.campbell.doubts import whirl_words
from fmu_bearing.modal.equations.remarks import LOOSE, UNSTEADY
from fmu_bearing.scene import Scene

#: Pa: pressures beyond which races of hardened steel are marked in the long run: a rule, not a standard.
HIGH_PRESSURE = 2.0e9
#: Film over roughness below which surfaces touch, and from which on they are apart (Harris 2006).
MIXED, APART = 1.0, 3.0
#: Viscosity ratio below which wear is expected, and from which on the film is full (ISO 281, makers).
WEAR, FULL_FILM = 0.4, 1.0
#: Spin over roll of a ball beyond which it heats and wears: GMN's plots end there; no standard.
SPIN = 0.4
#: Coefficient of friction that a lubricated ball certainly finds against its gyroscopic moment (Harris 2006).
GYROSCOPIC = 0.02
#: Static safety for quiet running, and the least: NSK.
QUIET, LEAST_SAFETY = 2.0, 1.0
_TOUCHES = 1e6  # Pa: below it balls of an unloaded bearing just touch, and a safety means nothing
_LITTLE = 2.0  # deg: a groove's edge and a contact angle are known no better
_SIDEWAYS = 0.1  # of the axial load: less, as of a weight, hardly tilts the ring (chosen)
_CLEAN = "high"


def verdicts(point: OperatingPoint) -> tuple[Verdict, ...]:
    """Return the verdicts on a scene's bearings, in the order of a designer's questions, then on the whole.

    Parameters
    ----------
    point : OperatingPoint

    Examples
    --------
    >>> from fmu_bearing import operating_point, verdicts
    >>> for one in verdicts(operating_point("examples/scenes/7003C-spindle.toml")):
    ...     if one.judgement == "watch":
    ...         print(one.label, one.text, "limit:", one.limit)
    pressure, inner race, GPa 1.89 limit: 1.50 heaviest class; 2.0 marks races
    preload class, N 500: 2.8 x heavy limit: light 29.8, medium 89.4, heavy 179
    """
    judged: list[Verdict] = []
    for place, bearing in enumerate(point.bearings):
        own = bearing_verdicts(bearing)
        judged += [*own, *mounted_preload(bearing, preloads(point, place), own)]
    return *judged, *_set_life(point), *_lift_off(point), _whirl(point)


def bearing_verdicts(bearing: BearingPoint) -> list[Verdict]:
    """Return the verdicts on one bearing."""
    judged = [
        _pressure(bearing),
        *_static_safety(bearing),
        *_life(bearing),
        *preload_verdicts(bearing),
        _speed(bearing),
        *seal_verdicts(bearing),
    ]
    judged += [*_film(bearing), _spin(bearing), _gyroscopic(bearing), _shoulder(bearing)]
    judged += fit_verdicts(bearing)
    return [replace(one, bearing=bearing.load.number) for one in judged]


def shared_label(one: Verdict) -> str:
    """Return the label of a figure for a row of several bearings, whose gravest race may differ."""
    return one.label.split(":")[0].replace(", inner race", "").replace(", outer race", "")


def shared_limit(same: Iterable[Verdict | None], scene: Scene) -> str:
    """Return the limit of a figure for a row of several bearings; of ones that differ each limit."""
    limits = [one.limit for one in same if one is not None]
    return " / ".join(dict.fromkeys(limits)) if scene.differing else limits[0]


def side_by_side(judged: Iterable[Verdict]) -> Iterator[list[Verdict | None]]:
    """Yield the verdicts on each figure of the bearings; None where a bearing has no such figure.

    A bearing without load has neither life nor static safety.
    """
    tables: dict[int, dict[str, Verdict]] = {}
    for one in judged:
        if one.bearing is not None:
            tables.setdefault(one.bearing, {})[one.key] = one
    for key in max(tables.values(), key=len):
        yield [table.get(key) for table in tables.values()]


_NUMBER = re.compile(r"[0-9.]+")


def cautions(point: OperatingPoint, judged: Iterable[Verdict] | None = None) -> list[str]:
    """Return what a designer should look at: of the statics, of each bearing, of the whole.

    What holds for several bearings of a set is said once, with the figures of the others behind.

    ``judged``: `verdicts` of the point, where they are known.
    """
    lines = point.statics.cautions()
    said: dict[tuple[str, ...], list[Verdict]] = {}
    for one in verdicts(point) if judged is None else judged:
        if one.advice:
            said.setdefault((one.key, one.judgement, _NUMBER.sub("", one.advice)), []).append(one)
    for same in said.values():
        first = same[0]
        if first.bearing is None or not point.bearings[0].on_shaft:
            lines.append(first.advice)
            continue
        numbers = [str(one.bearing) for one in same]
        named = f"bearing {numbers[0]}"
        if same[1:]:
            named = f"bearings {', '.join(numbers[:-1])} and {numbers[-1]}"
        others = [f"bearing {one.bearing}: {one.text}" for one in same[1:] if one.advice != first.advice]
        lines.append(f"{named}: {first.advice}" + (f" ({'; '.join(others)})" if others else ""))
    return lines


def _pressure(point: BearingPoint) -> Verdict:
    race = max(RINGS, key=lambda ring: point.contacts[ring]["pressure_max"])
    pressure = point.contacts[race]["pressure_max"]
    label, text = f"pressure, {race} race, GPa", f"{1e-9 * pressure:.2f}"
    if not point.scene.materials.steel_rings:
        why = "limits are known for races of steel: ask for the maker's proof load"
        return unjudged("pressure", label, why, pressure, text)
    usual = makers.CLASS_PRESSURE[point.scene.materials.kind]
    if point.scene.bearing.is_deep_groove:  # classes are of angular contact bearings
        usual = HIGH_PRESSURE
    shown = f"contact pressure {text} GPa at the {race} race"
    limit = f"{1e-9 * HIGH_PRESSURE:.1f} marks races"
    source = "rule of the field, no standard"
    if usual < HIGH_PRESSURE:
        limit = f"{1e-9 * usual:.2f} heaviest class; {limit}"
        source = f"GMN and NSK, computed; {source}"
    judgement: Judgement = "good"
    advice = ""
    if pressure > iso76.STATIC_PRESSURE:
        judgement = "change"
        advice = (
            f"{shown}: above {1e-9 * iso76.STATIC_PRESSURE:.1f} GPa, where races of steel are dented at once "
            "(ISO 76): reduce preload or load, or take a larger bearing"
        )
    elif pressure > HIGH_PRESSURE:
        judgement = "change"
        advice = (
            f"{shown}: above {1e-9 * HIGH_PRESSURE:.1f} GPa (rule of the field, no standard): reduce preload "
            "or load, take more or larger balls, or closer conformity"
        )
    elif pressure > usual:
        judgement = "watch"
        advice = (
            f"{shown}: above the {1e-9 * usual:.2f} GPa of makers' heaviest preload class (GMN, NSK; "
            "computed): reduce preload or load, or take a larger bearing"
        )
    return Verdict("pressure", label, pressure, text, limit, source, judgement, advice)


def _static_safety(point: BearingPoint) -> Iterator[Verdict]:
    limit = f"{QUIET:g} quiet running, {LEAST_SAFETY:g} at least"
    label = "static safety"
    if point.rating is None:
        words = f"{unrated(point.scene)}: ask for the maker's proof load"
        yield unjudged("static_safety", label, words)
        return
    kind = point.scene.materials.kind
    share = iso76.HYBRID if kind == "hybrid" else 1.0
    note = f"; {share:g} C0 for ceramic balls (GMN)" if kind == "hybrid" else ""
    load = point.rating.static_load
    if load is None:
        yield unjudged("static_safety", f"{label}, C0 / P0", _no_factors(point, "P0"))
    elif load > 0.0:
        safety = share * point.rating.static / load
        yield _safety("static_safety", f"{label}, C0 / P0", safety, limit, f"ISO 76, NSK{note}")
    worst = max(point.contacts[ring]["pressure_max"] for ring in RINGS)
    if worst > _TOUCHES:
        safety = (iso76.STATIC_PRESSURE / worst) ** 3
        words = f"{label}, ball loads"
        yield _safety("static_safety_pressure", words, safety, limit, "4.2 GPa (ISO 76), computed; NSK")


def _no_factors(point: BearingPoint, load: str) -> str:
    angle = point.scene.bearing.nominal_angle_deg
    return f"factors of {load} are known for contact angles of 14 to 46 deg, not {angle:g}; see ball loads"


def _safety(key: str, label: str, safety: float, limit: str, source: str) -> Verdict:
    judgement: Judgement = "good" if safety >= QUIET else "watch" if safety >= LEAST_SAFETY else "change"
    advice = ""
    if judgement != "good":
        below = QUIET if judgement == "watch" else LEAST_SAFETY
        advice = (
            f"{label} {safety:.2f}: below {below:g} ({source}): reduce preload or load, or take a larger one"
        )
    return Verdict(key, label, safety, f"{safety:.2f}", limit, source, judgement, advice)


def _life(point: BearingPoint) -> Iterator[Verdict]:
    scene = point.scene
    required, rpm = scene.operation.required_life_h, scene.operation.speed_rpm
    if point.rating is None:
        yield unjudged("life", "rating life", f"{unrated(scene)}; ask for the maker's experience")
        return
    if rpm == 0.0:
        return
    load = point.rating.equivalent
    if load is None:
        yield unjudged("life_basic", "L10, h", _no_factors(point, "P"))
    elif point.rating.life is not None:
        basic = point.rating.life
        source = "ISO 281, loads of the scene; judged as L10r"
        yield unjudged("life_basic", "L10, h", source, basic, shown_hours(basic))
    hours = point.life
    if hours is not None and math.isfinite(hours):
        note = "; hybrid: no modified life" if scene.materials.kind == "hybrid" else ""
        if point.radial > _SIDEWAYS * point.axial:  # a quarter of the life depends on it
            support = "held by tilt_support" if scene.mounted.tilt_support else "free to tilt"
            support = "held by the shaft" if point.on_shaft else support
            note = f"; inner ring {support}{note}"
        source = f"ISO 16281, computed ball loads; clean oil, full film{note}"
        yield judged_life("life", "L10r", hours, required, source)
        if scene.materials.kind == "steel" and load is None:
            yield unjudged("life_modified", "L10mr, h", _no_factors(point, "P"))
        elif scene.materials.kind == "steel" and load:
            clean = scene.lubricant.cleanliness or _CLEAN
            pitch = scene.bearing.pitch_diameter_mm
            factor = iso281.life_modification(point.viscosity_ratio, clean, point.rating.static, load, pitch)
            source = f"ISO 281: a_ISO {factor:.2g}, cleanliness {clean}, kappa {point.viscosity_ratio:.2g}"
            yield judged_life("life_modified", "L10mr", factor * hours, required, source)


def _speed(point: BearingPoint) -> Verdict:
    number, single = point.speed_number, point.speed_limit
    label, text = "n d_m, 1e6 mm r/min", f"{1e-6 * number:.2f}"
    if single is None:
        steel = point.scene.materials.steel_rings
        why = "no maker's limit at this contact angle" if steel else "makers' limits are for rings of steel"
        if steel and point.scene.bearing.is_deep_groove:
            why = "makers' limits here are of spindle bearings: ask for the maker's"
        return unjudged("speed", label, why, number, text)
    factor, mounted = 1.0, "on springs"
    if point.scene.mounted.preload_mode == "rigid":
        classes = preload_classes(point.scene)
        if classes is None:
            return unjudged("speed", label, f"rigid pair: {unclassed(point.scene)}", number, text)
        name = makers.preload_class(point.scene.mounted.preload_N, classes.loads) or "heavy"
        factor, mounted = makers.RIGID_SPEED[name], f"as a rigid {name} pair"
    limit = factor * single
    supply, whose = ("grease", "NSK") if point.scene.lubricant.greased else ("oil", "GMN, NSK")
    source = f"{whose}: {supply}, {mounted}"
    share = number / limit
    advice = ""
    if share > 1.0:
        advice = (
            f"speed number n d_m {1e-6 * number:.2f}e6 mm r/min: above the {1e-6 * limit:.2f}e6 of bearings "
            f"with {supply} {mounted} ({whose}): lower the speed, or take a smaller bearing"
            + (", or oil in place of grease" if supply == "grease" else "")
        )
    return Verdict(
        "speed", label, number, text, f"{1e-6 * limit:.2f}", source, "change" if advice else "good", advice
    )


def _film(point: BearingPoint) -> Iterator[Verdict]:
    if point.scene.operation.speed_rpm == 0.0:
        return
    film, kappa = point.film, point.viscosity_ratio
    advice = ""
    if film < APART:
        state = "surfaces touch" if film < MIXED else "surfaces touch in part"
        advice = (
            f"film over roughness {film:.2f}: below {MIXED if film < MIXED else APART:g} {state} "
            f"(Harris 2006; viscosity ratio of ISO 281 {kappa:.2f}): take thicker or cooler oil, "
            "or smoother surfaces"
        )
    judgement: Judgement = "good" if film >= APART else "watch" if film >= MIXED else "change"
    limit = f"{APART:g} apart, {MIXED:g} touching"
    yield Verdict("film", "film over roughness", film, f"{film:.2f}", limit, "Harris 2006", judgement, advice)
    label, text = "viscosity ratio kappa", f"{kappa:.2f}"
    if not point.scene.materials.steel_rings:
        yield unjudged("kappa", label, "limits of ISO 281 are for rings of steel", kappa, text)
        return
    judgement = "good" if kappa >= FULL_FILM else "watch" if kappa >= WEAR else "change"
    advice = ""
    if judgement != "good":
        state = "a mixed film" if judgement == "watch" else "wear without additives"
        below = FULL_FILM if judgement == "watch" else WEAR
        advice = (
            f"viscosity ratio kappa {kappa:.2f}: below {below:g} means {state} (ISO 281): take thicker or "
            "cooler oil"
        )
    limit = f"{FULL_FILM:g} full film, {WEAR:g} wear"
    yield Verdict("kappa", label, kappa, text, limit, "ISO 281", judgement, advice)


def _spin(point: BearingPoint) -> Verdict:
    race = max(RINGS, key=lambda ring: point.contacts[ring]["spin_to_roll"])
    spin = point.contacts[race]["spin_to_roll"]
    label, text = f"spin over roll, {race} race", f"{spin:.2f}"
    if not point.scene.materials.steel_rings:
        return unjudged("spin", label, "GMN's limit is for rings of steel", spin, text)
    advice = ""
    if spin > SPIN:
        advice = (
            f"spin over roll {text} at the {race} race: above {SPIN:g} (GMN's plots end there; no "
            "standard) balls heat and smear: take "
            + (
                "less axial load, or a smaller clearance"
                if point.scene.bearing.is_deep_groove
                else "a smaller contact angle, or more preload at this speed"
            )
        )
    return Verdict(
        "spin", label, spin, text, f"{SPIN:g}", "GMN; no standard", "watch" if advice else "good", advice
    )


def _gyroscopic(point: BearingPoint) -> Verdict:
    needed = point.gyroscopic_friction
    advice = ""
    if needed > GYROSCOPIC:
        advice = (
            f"gyroscopic slip: balls need a friction of {needed:.4f} to keep their axis, above "
            f"{GYROSCOPIC:g} (Harris 2006): give more preload, lower speed, or lighter balls"
        )
    return Verdict(
        "gyroscopic", "gyroscopic friction", needed, f"{needed:.4f}", f"{GYROSCOPIC:g}",
        "Harris 2006", "watch" if advice else "good", advice,
    )  # fmt: skip


def _shoulder(point: BearingPoint) -> Verdict:
    race = min(RINGS, key=lambda ring: point.contacts[ring]["shoulder_margin"])
    margin = math.degrees(point.contacts[race]["shoulder_margin"])
    judgement: Judgement = "good" if margin >= _LITTLE else "watch" if margin >= 0.0 else "change"
    advice = ""
    if judgement == "watch":
        advice = (
            f"shoulder: the contact ellipse of the {race} race ends {margin:.1f} deg before its edge, "
            f"less than {_LITTLE:g} deg (assumed: what tolerances take): reduce preload or load, or give "
            "a higher shoulder"
        )
    elif judgement == "change":
        advice = (
            f"shoulder: the contact ellipse of the {race} race reaches {-margin:.1f} deg beyond its edge, "
            "which cuts in there: reduce preload or load, or give a higher shoulder"
        )
    return Verdict(
        "shoulder", f"ellipse to shoulder, {race}, deg", math.radians(margin), f"{margin:.1f}",
        f"{_LITTLE:g}", "assumed: what tolerances take", judgement, advice,
    )  # fmt: skip


def _set_life(point: OperatingPoint) -> Iterator[Verdict]:
    hours = point.life
    if hours is not None and math.isfinite(hours) and len(point.bearings) > 1:
        yield judged_life(
            "set_life", "L10r of all bearings together", hours, point.scene.operation.required_life_h,
            "Lundberg and Palmgren 1947, exponent 10/9",
            "relieve the bearing with the shortest life, or take a larger one",
        )  # fmt: skip


def _lift_off(point: OperatingPoint) -> Iterator[Verdict]:
    """Yield the load that unloads a bearing over the axial force given, where the set has both."""
    statics = point.statics
    force = float(statics.load[0])
    first = statics.lift_off.get("+x" if force > 0.0 else "-x") if force else None
    if first is None:
        return
    margin, advice = first.load / force, ""
    if margin < 1.0:
        advice = (
            f"axial load {abs(force):.0f} N: above the {abs(first.load):.0f} N that unload bearing "
            f"{first.bearing} at standstill: raise the preload, or give the loaded side more bearings"
        )
    judgement: Judgement = "change" if advice else "good"
    yield Verdict(
        "lift_off", "lift-off over axial load", margin, f"{margin:.1f}", "1",
        "axial load alone, standstill, temperatures of the scene", judgement, advice,
    )  # fmt: skip


#: What `LOOSE` says at length among the cautions.
_LOOSE = "not judged while loads across the axis leave balls loose"


def _whirl(point: OperatingPoint) -> Verdict:
    label, source = "whirl of the ring, 1/s", "the linearised equations: no mode of the rings grows"
    if not point.steady:
        return unjudged("whirl", label, _LOOSE if LOOSE in point.remarks else UNSTEADY)
    if point.whirl is None:
        return Verdict("whirl", label, None, "none", "none", source, "good")
    frequency, growth = point.whirl
    advice = whirl_words(frequency, growth, point.scene)
    text = f"{growth:.0f} at {frequency:.0f} Hz"
    return Verdict("whirl", label, growth, text, "none", source, "change", advice)
