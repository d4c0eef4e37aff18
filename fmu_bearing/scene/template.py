"""The text of a new scene file: few keys, each with its unit, and a remark wherever a value is assumed."""

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.entries import KEY as CATALOGUES, entries
from fmu_bearing.scene.estimate import Estimate, cage_estimates, estimates
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.preload import CLASS, FORCE, OFFSET
from fmu_bearing.scene.read import read_scene_text

#: Materials of rings, balls and cage, by kind of bearing.
MATERIALS = {
    "steel": ("GCr15", "GCr15", "GCr15", "bakelite"),
    "hybrid": ("GCr15", "GCr15", "Si3N4", "bakelite"),
    "full-ceramic": ("ZrO2", "ZrO2", "Si3N4", "PEEK"),
}
_FAR_STIFFNESS = 3e7  # N/m: of the far bearing whose lever holds the ring against tilting
_BODIES = ("inner_ring", "outer_ring", "balls", "cage")


@dataclass(frozen=True)
class Dimensions:
    """Boundary dimensions (mm) and contact angle (deg) of a bearing that is not in the catalogue.

    Examples
    --------
    >>> from fmu_bearing import Dimensions, new_scene
    >>> text = new_scene("my-7008C", Dimensions(bore=40.0, outside=68.0, width=15.0), sound=False)
    >>> "ball_diameter_mm = 8.12 # assumed: 0.29 of outside diameter minus bore" in text
    True
    """

    bore: float
    outside: float
    width: float
    angle: float = 15.0


def new_scene(
    name: str,
    bearing: str | Dimensions,
    *,
    kind: str = "hybrid",
    speed_rpm: float = 20_000.0,
    preload_N: float = 300.0,
    grade: str = "P4",
    lubricant: str = "spindle-oil",
    sound: bool = True,
    designation: str | None = None,
    preload_class: str | None = None,
    preload_offset_um: float | None = None,
    folder: Path | None = None,
    speed_rule: str = "",
    preload_rule: str = "",
) -> str:
    """Return the text of a scene file with these values, which reads back without a refusal.

    `fmu_bearing.new_scene` chooses the speed and the preload that are not given.

    Parameters
    ----------
    name : str
        Of the scene.
    bearing : str or Dimensions
        A bearing of the catalogue, or dimensions from which the rest is estimated.
    kind : str
        ``steel``, ``hybrid`` (steel rings, ceramic balls) or ``full-ceramic``.
    speed_rpm, preload_N : float
    grade, lubricant : str
        Names in the catalogue.
    sound : bool
        With four microphones around the bare bearing, or without sound.
    designation : str, optional
        What the bearing is called; default: its catalogue name, or the scene's.
    preload_class : str, optional
        Class of a maker's pairs, in place of ``preload_N``.
    preload_offset_um : float, optional
        Offset of the ring faces, in place of ``preload_N``.
    folder : Path, optional
        Where the scene will be written, for the path of the user's file that has the bearing; default: the
        current folder.
    speed_rule, preload_rule : str, optional
        Why speed and preload are what they are: marked as assumed.

    Raises
    ------
    SceneError
        For names that are not in the catalogue and values outside their range.
    """
    if kind not in MATERIALS:
        raise SceneError(f"there is no kind of bearing '{kind}': choose from {', '.join(MATERIALS)}")
    materials = zip(_BODIES, MATERIALS[kind], strict=True)
    outside, pitch = _size(bearing)
    parts = [
        f"# Made by `fmu-bearing scene new`. Values marked assumed are not from you: replace what you know.\n"
        f'name = "{name}"{_catalogues(bearing, folder or Path())}',
        *_bearing(bearing, designation or (bearing if isinstance(bearing, str) else name)),
        "[materials]\n" + "\n".join(f'{body} = "{material}"' for body, material in materials),
        f'[lubricant]\ncatalogue = "{lubricant}" # assumed; keys given here win over the catalogue',
        _MOUNTING.format(
            preload=_preload(preload_N, preload_class, preload_offset_um) + _remark(preload_rule),
            tilt=float(f"{_FAR_STIFFNESS * (1e-3 * pitch) ** 2:.3g}"),
            far=f"{_FAR_STIFFNESS:g}",
        ),
        f'[imperfections] # assumed, by tolerance class\ngrade = "{grade}"\nseed = 1\n'
        "highest_frequency_kHz = 20.0 # assumed: the audible range",
        _OPERATION.format(speed=f"{float(speed_rpm)}{_remark(speed_rule)}"),
        *([_sound(outside)] if sound else []),
    ]
    text = "\n\n".join(parts) + "\n"
    read_scene_text(text, name, folder)
    return text


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


def _size(bearing: str | Dimensions) -> tuple[float, float]:
    """Return outside and pitch diameter (mm), or any numbers for an unknown name, which is refused later."""
    if isinstance(bearing, Dimensions):
        return bearing.outside, 0.5 * (bearing.bore + bearing.outside)
    entry = entries("bearings").get(bearing)
    if entry is None:
        return 30.0, 20.0
    return float(entry.values["outside_diameter_mm"]), float(entry.values["pitch_diameter_mm"])


def _remark(rule: str) -> str:
    return f" # assumed: {rule}" if rule else ""


def _bearing(bearing: str | Dimensions, designation: str) -> Sequence[str]:
    if isinstance(bearing, str):
        return (f'[bearing]\ncatalogue = "{bearing}"{_MADE[bearing in sizes()]}\n'
                f'designation = "{designation}"',)  # fmt: skip
    d = bearing
    given = (
        f'designation = "{designation}"\nbore_mm = {float(d.bore)}\n'
        f"outside_diameter_mm = {float(d.outside)}\nwidth_mm = {float(d.width)}\n"
    )
    return (
        "[bearing]\n" + given + _lines(estimates(d.bore, d.outside, d.width, float(d.angle))),
        "[bearing.cage]\n" + _lines(cage_estimates(d.bore, d.outside, d.width)),
    )


def _lines(found: Iterable[Estimate]) -> str:
    def remark(one: Estimate) -> str:
        if one.key == "contact_angle_deg":
            return ""
        return _remark(one.rule) or " # assumed"

    return "\n".join(f"{one.key} = {one.value}{remark(one)}" for one in found)


#: Behind the name of a catalogue entry: whether it is a maker's size.
_MADE = {True: " # sizes and angle are NSK's print; balls are derived, all else is assumed", False: ""}

_MOUNTING = """[mounting]
{preload}
pedestal_stiffness_N_m = 1e8 # assumed
pedestal_axial_ratio = 1.0 # assumed
pedestal_rotational_ratio_mm2 = 200.0 # assumed
pedestal_damping_ratio = 0.05 # assumed
radial_load_y_N = 0.0
radial_load_z_N = 0.0

[mounting.tilt_support] # assumed: a far bearing of {far} N/m, one pitch diameter away
stiffness_N_m_rad = {tilt}
damping_ratio = 0.05"""

_OPERATION = """[operation]
speed_rpm = {speed}
oil_temperature_degC = 40.0 # assumed: a spindle that runs warm
inner_ring_temperature_degC = 40.0 # assumed
outer_ring_temperature_degC = 40.0 # assumed"""


def _sound(outside: float) -> str:
    """Return a table of sound with four microphones at three outside diameters; ahead is -X."""
    r = float(round(3.0 * outside, -1) or 10.0)
    places = (("right", 0.0, r, 0.0), ("top", 0.0, 0.0, r), ("front", -r, 0.0, 0.0), ("back", r, 0.0, 0.0))
    microphones = "\n\n".join(
        f'[[sound.microphone]]\nname = "{name}"\nx_mm = {x}\ny_mm = {y}\nz_mm = {z}'
        for name, x, y, z in places
    )
    return f'[sound]\nradiator = "bare" # assumed: no housing\n\n{microphones}'
