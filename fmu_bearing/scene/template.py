"""The text of a new scene file: few keys, each with its unit, and a remark wherever a value is assumed."""

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from fmu_bearing.scene import deep_groove
from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.conformity import conformity_from_stiffness
from fmu_bearing.scene.designation import Designation, suggestion
from fmu_bearing.scene.entries import KEY as CATALOGUES, entries
from fmu_bearing.scene.estimate import Estimate, cage_estimates, estimates
from fmu_bearing.scene.lubricant import SUPPLIES
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.own_bearing import (
    Dimensions,
    angle_of,
    ask,
    balls_of,
    is_deep_groove,
    kind_of,
    meant,
    with_angle,
)
from fmu_bearing.scene.preload import CLASS, FORCE, OFFSET, preload, preload_key
from fmu_bearing.scene.read import Scene, read_scene_text
from fmu_bearing.scene.scene import SLOW_RPM, Tables
from fmu_bearing.scene.set_template import set_parts, set_shape

#: Materials of rings, balls and cage, by kind of bearing.
MATERIALS = {
    "steel": ("GCr15", "GCr15", "GCr15", "bakelite"),
    "hybrid": ("GCr15", "GCr15", "Si3N4", "bakelite"),
    "full-ceramic": ("ZrO2", "ZrO2", "Si3N4", "PEEK"),
}
#: How the rule of a conformity begins that a printed stiffness gives.
FITTED = "fitted to the stiffness given"
_NORMAL_GRADE = "P0"  # of a deep groove bearing without another one
_GRADE = "P4"  # where neither a value nor a designation says
_FAR_STIFFNESS = 3e7  # N/m: of the far bearing whose lever holds the ring against tilting
_WAVES_RPM = 3000.0  # waves up to 20 kHz are then of orders up to 400
_BODIES = ("inner_ring", "outer_ring", "balls", "cage")


_UNKNOWN = Dimensions(10.0, 30.0, 9.0)  # any size, for a name that is refused


def new_scene(
    name: str,
    bearing: str | Dimensions,
    *,
    kind: str | None = None,
    speed_rpm: float = 20_000.0,
    preload_N: float = 300.0,
    radial_load_N: float = 0.0,
    clearance: str | None = None,
    grade: str | None = None,
    lubricant: str = "spindle-oil",
    supply: str | None = None,
    sound: bool = True,
    designation: str | None = None,
    preload_class: str | None = None,
    preload_offset_um: float | None = None,
    folder: Path | None = None,
    arrangement: str | None = None,
    distance_mm: float | None = None,
    spring_N: float | None = None,
    stiffness_N_um: float | None = None,
    stiffness_preload_N: float | None = None,
    stiffness_of: str = "pair",
    speed_rule: str = "",
    preload_rule: str = "",
    radial_rule: str = "",
    spall_mm: float | None = None,
) -> str:
    """Return the text of a scene file with these values, which reads back without a refusal.

    `fmu_bearing.new_scene` chooses the speed and the preload that are not given.

    Parameters
    ----------
    name : str
        Of the scene.
    bearing : str or Dimensions
        A bearing of the catalogue, or dimensions from which the rest is estimated.
    kind : str, optional
        ``steel``, ``hybrid`` (steel rings, ceramic balls) or ``full-ceramic``; default: what the designation
        says, see `read_designation`; without a designation hybrid, assumed; a deep groove bearing is of
        steel.
    speed_rpm, preload_N : float
    radial_load_N : float
        Of a single bearing, downwards.
    clearance : str, optional
        Group of the clearance of a deep groove bearing, as ``"C3"``; default: the catalogue's, CN.
    grade : str, optional
        Name in the catalogue; default: what the designation says, else P4.
    lubricant : str
        Name in the catalogue.
    supply : str, optional
        How oil comes to the contacts, a value of ``lubricant.supply``; default: ``oil-air``, assumed.
    sound : bool
        With four microphones around the bare bearing, or without sound.
    designation : str, optional
        What the bearing is called; default: its catalogue name, or the scene's. Contact angle, balls and
        tolerance class follow from it.
    preload_class : str, optional
        Class of a maker's pairs, in place of ``preload_N``.
    preload_offset_um : float, optional
        Offset of the ring faces, in place of ``preload_N``.
    arrangement : str, optional
        Makers' name of a set of these bearings on one shaft, as ``DB`` or ``TBT``; default: one bearing on
        its mounting. Where all carry one way, as in ``DT``, the preload is written as the axial force that
        loads each bearing so.
    distance_mm : float, optional
        Of a set, between neighbouring ball planes; default: the width of the bearing.
    spring_N : float, optional
        Of a set, the force of springs on each bearing that carries as the last one does, in place of
        ``preload_N``.
    stiffness_N_um, stiffness_preload_N : float, optional
        Axial stiffness that the maker prints of the bearing with these materials, and the preload of that
        print: the conformities are fitted to it, their difference kept, see `conformity_from_stiffness`.
    stiffness_of : str
        ``pair`` or ``bearing``: what that stiffness is of.
    folder : Path, optional
        Where the scene will be written, for the path of the user's file that has the bearing; default: the
        current folder.
    speed_rule, preload_rule, radial_rule : str, optional
        Why speed, preload and radial load are what they are: marked as assumed.
    spall_mm : float, optional
        Length of a spall of the outer race, of a set that of its first bearing; default: no defect.

    Raises
    ------
    SceneError
        For names that are not in the catalogue, values outside their range, a designation of another kind of
        bearing, bore or angle, and one that leaves angle or balls open where they are not given.
    """
    if kind is not None and kind not in MATERIALS:
        raise SceneError(f"there is no kind of bearing '{kind}': choose from {', '.join(MATERIALS)}")
    if supply is not None and supply not in SUPPLIES:
        near = suggestion(supply, SUPPLIES)
        raise SceneError(f"there is no supply '{supply}': {near}choose from {', '.join(SUPPLIES)}")
    if sum(value is not None for value in (preload_class, preload_offset_um, spring_N)) > 1:
        raise SceneError("give one of preload_class, preload_offset_um and spring_N: each is the preload")
    if arrangement is None and (distance_mm is not None or spring_N is not None):
        raise SceneError("a distance of ball planes and springs are of a set: give its arrangement, as 'DB'")
    deep = is_deep_groove(bearing)
    if clearance is not None and not deep:
        raise SceneError(f"a clearance ('{clearance}') is of a deep groove bearing of a catalogue, as 6205")
    if arrangement is not None and (deep or radial_load_N):
        what = "deep groove bearings" if deep else "a radial load"
        raise SceneError(f"new scenes of sets are without {what}: write [spindle] and its load by hand")
    said = meant(bearing, designation)
    ask(said, bearing, kind)
    kind = kind or ("steel" if deep else None)
    materials = _materials(kind, said)
    kind = kind or kind_of(said)
    tolerance = grade or (said and said.tolerance) or (_NORMAL_GRADE if deep else _GRADE)
    bearing = bearing if isinstance(bearing, str) else with_angle(bearing, said)
    size, pitch = _size(bearing)
    if (stiffness_N_um is None) != (stiffness_preload_N is None):
        raise SceneError(
            "a printed stiffness holds at one preload: give stiffness_N_um and stiffness_preload_N together"
        )
    fitted: dict[str, str] = {}
    if stiffness_N_um is not None and stiffness_preload_N is not None:
        usual = new_scene(name, bearing, kind=kind, folder=folder, sound=False)
        fitted = _fitted(
            read_scene_text(usual, name, folder), stiffness_N_um, stiffness_preload_N, stiffness_of
        )
    tables = _bearing(
        bearing, designation or (bearing if isinstance(bearing, str) else name), kind, fitted, said
    )
    if clearance is not None:
        tables = [f'{tables[0]}\nclearance = "{clearance}"', *tables[1:]]
    line = _preload(preload_N, preload_class, preload_offset_um) + _remark(preload_rule)
    places = [0.0]
    if arrangement is None:
        mounted = [_MOUNTING.format(
            preload=line,
            radial=f"{0.0 - float(radial_load_N)}{_remark(radial_rule)}",
            tilt=float(f"{_FAR_STIFFNESS * (1e-3 * pitch) ** 2:.3g}"),
            far=f"{_FAR_STIFFNESS:g}",
        )]  # fmt: skip
    else:
        apart = None if size is _UNKNOWN else distance_mm
        shape = set_shape(arrangement, size.bore, size.width, apart, spring_N)
        places = shape.places
        if shape.one_way:
            alone = new_scene(
                name, bearing, kind=kind, preload_N=preload_N, preload_class=preload_class,
                preload_offset_um=preload_offset_um, folder=folder, sound=False,
                stiffness_N_um=stiffness_N_um, stiffness_preload_N=stiffness_preload_N,
                stiffness_of=stiffness_of,
            )  # fmt: skip
            given = {CLASS: preload_class, OFFSET: preload_offset_um}
            line = _axial_force(len(places), read_scene_text(alone, name, folder), given, preload_rule)
        mounted = list(set_parts(shape, line))
    parts = [
        f"# Made by `fmu-bearing scene new`. Values marked assumed are not from you: replace what you know.\n"
        f'name = "{name}"{_catalogues(bearing, folder or Path())}',
        *tables,
        "[materials]\n" + "\n".join(materials),
        f'[lubricant]\ncatalogue = "{lubricant}" # assumed; keys given here win over the catalogue\n'
        + _supply(supply),
        *mounted,
        f'[imperfections] # assumed, by tolerance class\ngrade = "{tolerance}"\nseed = 1\n'
        "highest_frequency_kHz = 20.0 # assumed: the audible range",
        *([] if spall_mm is None else [_spall(spall_mm, arrangement is not None)]),
        _OPERATION.format(speed=f"{float(speed_rpm)}{_remark(speed_rule)}{_lowest(speed_rpm)}"),
        *([_sound(size.outside, places)] if sound else []),
    ]
    text = "\n\n".join(parts) + "\n"
    read_scene_text(text, name, folder)
    return text


def _supply(supply: str | None) -> str:
    """Return the line of how oil comes to the contacts."""
    if supply is not None:
        return f'supply = "{supply}"'
    first, *others = SUPPLIES
    return f'supply = "{first}" # assumed: others are {", ".join(others)}'


def _spall(length: float, in_set: bool) -> str:
    """Return the table of a spall that the load presses the balls into."""
    whose = "bearing = 1 # assumed\n" if in_set else ""
    return (
        f'[[imperfections.defect]]\n{whose}on = "outer"\nshape = "spall"\nlength_mm = {float(length)}\n'
        f"width_mm = {float(length)} # assumed: as long as it is; one as wide as the track is louder\n"
        "depth_um = 100.0 # assumed\nangle_deg = 180.0 # assumed: 6 o'clock"
    )


def _lowest(speed: float) -> str:
    """Return the line of the speed that decides the order of waves, where a slow shaft's own does not."""
    if abs(speed) >= SLOW_RPM:
        return ""
    return f"\nlowest_speed_rpm = {_WAVES_RPM} # assumed: speed at which waves reach highest_frequency_kHz"


def _catalogues(bearing: str | Dimensions, folder: Path) -> str:
    """Return the line that names the user's file which has the bearing, if one has it."""
    entry = entries("bearings").get(bearing) if isinstance(bearing, str) else None
    if entry is None or entry.file is None:
        return ""
    try:
        path = Path(os.path.relpath(entry.file, folder))
    except ValueError:  # another drive
        path = entry.file
    return f'\n{CATALOGUES} = ["{path.as_posix()}"]'


def _preload(force: float, by_class: str | None, offset: float | None) -> str:
    if by_class is not None:
        return f'{CLASS} = "{by_class}"'
    return f"{FORCE} = {float(force)}" if offset is None else f"{OFFSET} = {float(offset)}"


def _axial_force(count: int, alone: Tables, given: Mapping[str, Any], rule: str) -> str:
    """Return the line of the axial force that loads bearings that all carry one way as one ``alone`` is."""
    each = alone.mounted.preload_N
    load = preload(given, alone.bearing, alone.materials) if preload_key(given) else None
    why = rule or (f"{each:g} N each, as given" if load is None else load.words)
    return f"force_x_N = {count * each} # assumed: {count} bearings, {why}"


def _size(bearing: str | Dimensions) -> tuple[Dimensions, float]:
    """Return dimensions and pitch diameter (mm); of an unknown name, which is refused later, any."""
    if isinstance(bearing, Dimensions):
        return bearing, 0.5 * (bearing.bore + bearing.outside)
    entry = entries("bearings").get(bearing)
    if entry is None:
        return _UNKNOWN, 20.0
    keys = ("bore_mm", "outside_diameter_mm", "width_mm")
    return Dimensions(*(float(entry.values[key]) for key in keys)), float(entry.values["pitch_diameter_mm"])


def _remark(rule: str) -> str:
    return f" # assumed: {rule}" if rule else ""


def _fitted(scene: Scene, stiffness: float, load: float, of: str) -> dict[str, str]:
    """Return the lines of both conformities that give a printed stiffness, by key."""
    usual = scene.bearing
    found = conformity_from_stiffness(
        scene, stiffness, load, of=of, offset=usual.outer_conformity - usual.inner_conformity
    )
    rule = f"{FITTED}, {stiffness:g} N/um of a {of} at {load:g} N"
    return {f"{race}_conformity": f"{value:.6f} # assumed: {rule}" for race, value in found._asdict().items()}


def _materials(kind: str | None, said: Designation | None) -> list[str]:
    """Return the lines of the materials, with what decided on the balls."""
    by_sign = None if said is None or said.balls is None else f"{said.why('balls')}, {said.balls} balls"
    if kind is None:
        remark = f" # {by_sign}" if by_sign else " # assumed: no designation says; steel ones are GCr15"
    else:
        differs = by_sign is not None and kind_of(said) != kind and kind != "full-ceramic"
        remark = f" # as given; {by_sign}" if differs else ""
    return [
        f'{body} = "{material}"{remark if body == "balls" else ""}'
        for body, material in zip(_BODIES, MATERIALS[kind or kind_of(said)], strict=True)
    ]


def _bearing(
    bearing: str | Dimensions,
    designation: str,
    kind: str,
    fitted: Mapping[str, str],
    said: Designation | None,
) -> Sequence[str]:
    """Return the tables of the bearing; ``fitted``: lines by key that win over catalogue and estimates."""
    if isinstance(bearing, str):
        more = "".join(f"\n{key} = {line}" for key, line in fitted.items())
        made = _MADE[bearing in sizes()] or _MADE_DEEP[bearing in deep_groove.sizes()]
        return (f'[bearing]\ncatalogue = "{bearing}"{made}\n'
                f'designation = "{designation}"{more}',)  # fmt: skip
    d = bearing
    angle = " # assumed: no designation says" if d.angle is None else ""
    if said is not None and said.angle == d.angle:
        angle = f" # {said.why('angle')}"
    given = (
        f'designation = "{designation}"\nbore_mm = {float(d.bore)}\n'
        f"outside_diameter_mm = {float(d.outside)}\nwidth_mm = {float(d.width)}\n"
    )
    balls = balls_of(d, kind)
    estimated = estimates(d.bore, d.outside, d.width, angle_of(d), balls)
    return (
        "[bearing]\n" + given + _lines(estimated, fitted, angle),
        "[bearing.cage]\n" + _lines(cage_estimates(d.bore, d.outside, d.width, balls.diameter, balls.number)),
    )


def _lines(
    found: Iterable[Estimate], fitted: Mapping[str, str] = MappingProxyType({}), angle: str = ""
) -> str:
    def remark(one: Estimate) -> str:
        if one.key == "contact_angle_deg":
            return angle
        return _remark(one.rule) or " # assumed"

    return "\n".join(f"{one.key} = {fitted.get(one.key, f'{one.text}{remark(one)}')}" for one in found)


#: Behind the name of a catalogue entry: whether it is a maker's size.
_MADE = {True: " # sizes and angle are NSK's print; balls are derived, all else is assumed", False: ""}

_MADE_DEEP = {True: " # sizes are of ISO 15; balls are derived from print, all else is assumed", False: ""}

_MOUNTING = """[mounting]
{preload}
pedestal_stiffness_N_m = 1e8 # assumed
pedestal_axial_ratio = 1.0 # assumed
pedestal_rotational_ratio_mm2 = 200.0 # assumed
pedestal_damping_ratio = 0.05 # assumed
radial_load_y_N = 0.0
radial_load_z_N = {radial}
# How tight the rings sit on shaft and in housing is in [mounting.fit]; without it they are as drawn.

[mounting.tilt_support] # assumed: a far bearing of {far} N/m, one pitch diameter away
stiffness_N_m_rad = {tilt}
damping_ratio = 0.05"""

_OPERATION = """[operation]
speed_rpm = {speed}
oil_temperature_degC = 40.0 # assumed: a spindle that runs warm
inner_ring_temperature_degC = 40.0 # assumed
outer_ring_temperature_degC = 40.0 # assumed"""


def _sound(outside: float, places: Sequence[float]) -> str:
    """Return a table of sound with four microphones at three outside diameters; ahead is -X.

    ``places``: of the ball planes along the axis (mm).
    """
    r = float(round(3.0 * outside, -1) or 10.0)
    first, last = places[0], places[-1]
    middle = round(0.5 * (first + last), 4)
    spots = (
        ("right", middle, r, 0.0), ("top", middle, 0.0, r), ("front", first - r, 0.0, 0.0),
        ("back", last + r, 0.0, 0.0),
    )  # fmt: skip
    microphones = "\n\n".join(
        f'[[sound.microphone]]\nname = "{name}"\nx_mm = {x}\ny_mm = {y}\nz_mm = {z}'
        for name, x, y, z in spots
    )
    return f'[sound]\nradiator = "bare" # assumed: no housing\n\n{microphones}'
