"""What a designer can choose otherwise in a scene: preload, balls, grade, oil, geometry, speed, supports."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from fmu_bearing.design.rating import preload_classes
from fmu_bearing.scene import Scene
from fmu_bearing.scene.preload import CLASS, preload
from fmu_bearing.scene.read import catalogue
from fmu_bearing.scene.values import value_at

_PRELOADS = (0.7, 1.4)
_WARMER = 10.0  # K
#: Two neighbouring grades of ISO 3448 differ by half of the thinner one's viscosity.
_GRADE = 1.5
_CONFORMITY = 0.005
_ANGLES = (15.0, 25.0)  # deg: those that makers of spindle bearings offer
_NEAR = 1.0  # deg
_SPEEDS = (0.9, 1.1)
_PEDESTALS = (0.5, 2.0)
_BALANCE = 0.5
#: Values of a tolerance grade that the maker of the bearing decides; unbalance is the rotor's.
_GRADED = (
    "inner_race_amplitude_um", "outer_race_amplitude_um", "ball_diameter_spread_nm", "ball_form_nm",
)  # fmt: skip
_RACES, _BALLS = _GRADED[:2], ("ball_form_nm", "ball_diameter_spread_nm")
#: Grades of balls (ISO 3290), from coarse to fine, and the class of bearings from which they take form and
#: spread of diameters.
_BALL_GRADES = {"G10": "P6", "G5": "P5", "G3": "P4"}
#: One grade is about a factor of two in A_1.
_STEP = 2.0
_STEEL, _CERAMIC = "GCr15", "Si3N4"


class Alternative(NamedTuple):
    """One choice: what it concerns, from what to what, and the values of the scene by dotted key."""

    topic: str
    words: str
    values: Mapping[str, Any]


def alternatives(scene: Scene) -> list[Alternative]:
    """Return the choices that a designer has in a scene, each a change of its values.

    Number and size of the balls stay, because they make another bearing. Whether a scene allows a choice,
    only `Scene.replace` checks.
    """
    choices = [
        *_preload(scene), *_balls(scene), *_grades(scene), *_oil(scene), *_geometry(scene), *_supports(scene),
    ]  # fmt: skip
    return choices


def _preload(scene: Scene) -> Iterator[Alternative]:
    key = scene.assembly.preload_key
    if not scene.assembly.can_preload:
        return
    now = value_at(scene, key) or 0.0
    wanted = [(float(f"{factor * now:.3g}"), "") for factor in _PRELOADS if now > 0.0]
    classes = None if key.endswith("force_N") else preload_classes(scene)  # springs have no offset of faces
    for name in classes.loads if classes else ():
        made = preload({CLASS: name}, scene.bearing, scene.materials, scene.assembly.carries)
        if made is not None:
            wanted.append((made.force, f" {name}"))
    for force, name in wanted:
        if force != now:
            yield Alternative("preload", f"preload {now:g} -> {force:g} N{name}", {key: force})


def _balls(scene: Scene) -> Iterator[Alternative]:
    here = scene.materials.kind
    if here == "steel":
        yield Alternative("balls", "balls steel -> Si3N4", {"materials.balls": _CERAMIC})
    elif here == "hybrid":
        yield Alternative("balls", "balls ceramic -> steel", {"materials.balls": _STEEL})


def _grades(scene: Scene) -> Iterator[Alternative]:
    """Yield the next finer and the next coarser grade, or half and twice the waviness of another law."""
    flaws = scene.imperfections
    if flaws is None:
        return
    now = {key: value for key in _GRADED if (value := getattr(flaws, key))}
    grades = catalogue("grades")  # from coarse to fine
    laws = {row["waviness_exponent"] for row in grades.values()}
    if flaws.follows_law and flaws.waviness_exponent not in laws:
        for factor, words in ((1.0 / _STEP, "half"), (_STEP, "twice")):
            values = {f"imperfections.{key}": factor * value for key, value in now.items()}
            yield Alternative("grade", f"waviness, ball sizes -> {words}", values)
        return
    same = [name for name, row in grades.items() if all(row[key] == now[key] for key in now)]
    finer = [n for n, row in grades.items() if n not in same and all(row[k] <= now[k] for k in now)]
    coarser = [n for n, row in grades.items() if n not in same and all(row[k] >= now[k] for k in now)]
    before = f"grade {same[0]}" if same else "own surfaces"
    for name in (*finer[:1], *coarser[-1:]):
        values = {f"imperfections.{key}": grades[name][key] for key in now}
        if values:
            yield Alternative("grade", f"{before} -> {'' if same else 'grade '}{name}", values)
    yield from _part("race grade", "races", grades, _RACES, now)
    named = {ball: grades[name] for ball, name in _BALL_GRADES.items()}
    yield from _part("ball grade", "balls", named, _BALLS, now)


def _part(
    topic: str, words: str, rows: Mapping[str, Mapping[str, Any]], keys: tuple[str, ...],
    now: Mapping[str, float],
) -> Iterator[Alternative]:  # fmt: skip
    """Yield the next finer and the next coarser of rows from coarse to fine, of races or of balls alone."""
    own = [key for key in keys if key in now]
    judged = [key for key in own if key != "ball_diameter_spread_nm"]  # a class sets that, no grade of balls
    if not judged:
        return
    same = [name for name, row in rows.items() if all(row[key] == now[key] for key in judged)]
    others = {name: row for name, row in rows.items() if name not in same}
    finer = [name for name, row in others.items() if all(row[key] <= now[key] for key in judged)]
    coarser = [name for name, row in others.items() if all(row[key] >= now[key] for key in judged)]
    before = f"{words} {same[0]}" if same else f"own {words}"
    for name in (*finer[:1], *coarser[-1:]):
        changed = {f"imperfections.{key}": rows[name][key] for key in own}
        yield Alternative(topic, f"{before} -> {name}", changed)


def _oil(scene: Scene) -> Iterator[Alternative]:
    temperature = scene.operation.oil_temperature_degC
    for step in (-_WARMER, _WARMER):
        yield Alternative(
            "oil",
            f"oil {temperature:g} -> {temperature + step:g} degC",
            {"operation.oil_temperature_degC": temperature + step},
        )
    viscosity = scene.lubricant.viscosity_Pa_s
    for factor in (1.0 / _GRADE, _GRADE):
        changed = float(f"{factor * viscosity:.3g}")
        yield Alternative(
            "oil",
            f"oil {1e3 * viscosity:g} -> {1e3 * changed:g} mPa s",
            {"lubricant.viscosity_Pa_s": changed},
        )


def _geometry(scene: Scene) -> Iterator[Alternative]:
    for race in ("inner", "outer"):
        now = getattr(scene.bearing, f"{race}_conformity")
        for step in (-_CONFORMITY, _CONFORMITY):
            changed = round(now + step, 6)
            yield Alternative(
                "conformity", f"{race} groove {now:g} -> {changed:g}", {f"bearing.{race}_conformity": changed}
            )
    if scene.bearing.is_deep_groove:
        yield from _clearances(scene)
        return
    angle = scene.bearing.nominal_angle_deg
    near = [one for one in _ANGLES if abs(one - angle) <= _NEAR]
    for other in _ANGLES:
        if other not in near:
            yield Alternative(
                "contact angle", f"contact angle {angle:g} -> {other:g} deg",
                {"bearing.contact_angle_deg": other},
            )  # fmt: skip


def _clearances(scene: Scene) -> Iterator[Alternative]:
    """Yield the other groups of a deep groove bearing's clearance."""
    bearing = scene.bearing
    now = bearing.clearance or f"{1e6 * bearing.radial_clearance:g} um"
    for group in bearing.clearance_groups:
        if group != bearing.clearance:
            yield Alternative("clearance", f"clearance {now} -> {group}", {"bearing.clearance": group})


def _supports(scene: Scene) -> Iterator[Alternative]:
    speed = scene.operation.speed_rpm
    if speed != 0.0:
        for factor in _SPEEDS:
            changed = float(f"{factor * speed:.6g}")
            yield Alternative(
                "speed", f"speed {speed:g} -> {changed:g} r/min", {"operation.speed_rpm": changed}
            )
    key = scene.assembly.pedestal_key
    stiffness = value_at(scene, key)
    for factor in _PEDESTALS if stiffness else ():  # the housing of a set may be at rest
        words = f"pedestal {1e-6 * stiffness:g} -> {1e-6 * factor * stiffness:g} N/um"
        yield Alternative("pedestal", words, {key: factor * stiffness})
    if spots := scene.assembly.heavy_spots:
        lighter = [spot.model_dump() | {"amount_g_mm": _BALANCE * spot.amount_g_mm} for spot in spots]
        yield Alternative(
            "balance", f"unbalance of the shaft x{_BALANCE:g}", {"spindle.shaft.unbalance": lighter}
        )
    flaws = scene.imperfections
    if flaws is not None and flaws.unbalance_um > 0.0:
        changed = _BALANCE * flaws.unbalance_um
        yield Alternative(
            "balance",
            f"unbalance {flaws.unbalance_um:g} -> {changed:g} um",
            {"imperfections.unbalance_um": changed},
        )
