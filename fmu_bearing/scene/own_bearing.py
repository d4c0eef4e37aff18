"""A bearing of one's own: its dimensions, what its designation says, and its balls by its ratings."""

import re
from dataclasses import dataclass, replace

from fmu_bearing.scene import bearing as bearings
from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.designation import ANGULAR, DEEP_GROOVE, Designation, read_designation
from fmu_bearing.scene.entries import entries
from fmu_bearing.scene.estimate import Balls, balls_by_rule, balls_of_ratings, check_dimensions
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.symbols import STEEL

_KINDS = "steel|hybrid|full-ceramic"
_DIGITS = 2  # of the bore, in every maker's designation
_KIND, _ANGLE = "hybrid", 15.0  # where neither a value nor a designation says


@dataclass(frozen=True)
class Dimensions:
    """Boundary dimensions (mm) and contact angle (deg) of a bearing that is not in the catalogue.

    Without an angle it is the one that the designation says, else 15 deg, assumed. ``dynamic`` and
    ``static``: C and C0 (N) as the maker prints them, of which its balls follow; without them these are
    estimated.

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
    angle: float | None = None
    dynamic: float | None = None
    static: float | None = None


def angle_of(bearing: Dimensions) -> float:
    """Return the contact angle (deg), the usual one where none is given."""
    return _ANGLE if bearing.angle is None else float(bearing.angle)


def balls_of(bearing: Dimensions, kind: str | None, designation: str | None = None) -> Balls:
    """Return the balls of a bearing that is given by its dimensions, by its printed ratings where there are.

    ``kind``: ``steel``, ``hybrid`` or ``full-ceramic``; without it the designation says, as of the angle.

    Raises
    ------
    SceneError
        For one rating alone, for dimensions without room for balls, and for ratings that no balls have.
    """
    said = meant(bearing, designation)
    ask(said, bearing, kind)
    bore, outside, angle = bearing.bore, bearing.outside, angle_of(with_angle(bearing, said))
    check_dimensions(bore, outside, bearing.width)
    if bearing.dynamic is None and bearing.static is None:
        return balls_by_rule(bore, outside, angle)
    if bearing.dynamic is None or bearing.static is None:
        raise SceneError(
            "one rating leaves the balls open: give C and C0 (N), --dynamic-rating and --static-rating"
        )
    ceramic = (kind or kind_of(said)) != "steel"
    return balls_of_ratings(bore, outside, angle, bearing.dynamic, bearing.static, ceramic)


def meant(bearing: str | Dimensions, designation: str | None = None) -> Designation | None:
    """Return what the designation of a bearing says; None without one.

    The papers' bearings, which no maker has named, have none; names without two digits name no size.
    `ask` refuses what it leaves open.

    Raises
    ------
    SceneError
        For another kind of bearing.
    """
    if designation is None and isinstance(bearing, str):
        entry = entries("bearings").get(bearing)
        own = entry is not None and entry.file is not None
        designation = str(entry.values.get("designation", "")) if entry is not None and own else bearing
        if not own and bearing not in sizes():
            return None
    if designation is None or len(re.findall("[0-9]", designation)) < _DIGITS:
        return None
    said = read_designation(designation) or Designation(designation, "", ANGULAR, "", unread=designation)
    if said.kind == DEEP_GROOVE:
        if is_deep_groove(bearing):
            return None
        raise SceneError(
            f"{designation} is a deep groove ball bearing: give one of the catalogue, as --bearing 6205, or "
            "one of a file of your own (--catalogue)"
        )
    if said.kind != ANGULAR:
        raise SceneError(
            f"{designation} is a {said.kind}, and this package models angular contact and deep groove ones: "
            "leave the designation out to model one of these dimensions"
        )
    return said


def is_deep_groove(bearing: str | Dimensions) -> bool:
    """Whether a bearing is a deep groove one of a catalogue."""
    entry = None if isinstance(bearing, Dimensions) else entries("bearings").get(bearing)
    return entry is not None and entry.values.get("kind") == bearings.DEEP_GROOVE


def ask(said: Designation | None, bearing: str | Dimensions, kind: str | None) -> None:
    """Refuse a designation that leaves contact angle or balls open where no value gives them.

    Raises
    ------
    SceneError
        Naming the part of the designation that no table has, and what to give; and where the designation
        says another bore.
    """
    if said is None:
        return
    own = isinstance(bearing, Dimensions)
    entry = None if isinstance(bearing, Dimensions) else entries("bearings").get(bearing)
    bore = bearing.bore if isinstance(bearing, Dimensions) else entry and entry.values.get("bore_mm")
    if said.bore is not None and bore is not None and float(bore) != said.bore:
        raise SceneError(
            f"a bore of {bore:g} mm: the designation {said.text} means {said.bore:g} mm: give one of both, "
            "or a designation of your own with --contact-angle and --kind"
        )
    angle = None if entry is None else entry.values.get("contact_angle_deg")
    if said.angle is not None and angle is not None and float(angle) != said.angle:
        raise SceneError(
            f"a contact angle of {angle:g} deg, of {bearing}: the designation {said.text} means "
            f"{said.angle:g} deg: give the bearing that it means, or a designation of your own with --kind"
        )
    no_angle = isinstance(bearing, Dimensions) and bearing.angle is None and said.angle is None
    missing = {
        "contact angle": ("--contact-angle DEG", "Dimensions(angle=)", no_angle),
        "balls": (f"--kind {_KINDS}", "kind=", kind is None and said.balls is None),
    }
    asked = {what: way for what, (*way, open_) in missing.items() if open_}
    if asked:
        part = f": '{said.unread}' is in no table of makers' signs" if said.unread else ""
        verb, them = ("is", "it") if list(asked) == ["contact angle"] else ("are", "them")
        raise SceneError(
            f"the designation {said.text} says no {' and no '.join(asked)} that {verb} known{part}: give "
            f"{them} as the maker prints {them}, {' and '.join(way[0] for way in asked.values())} (in Python "
            f"{', '.join(way[1] for way in asked.values())})"
            + (", or leave the designation out for assumed ones" if own else "")
        )


def with_angle(bearing: Dimensions, said: Designation | None) -> Dimensions:
    """Return dimensions with the contact angle that was given, or that a designation says.

    Raises
    ------
    SceneError
        Where both differ.
    """
    if said is None:
        return bearing
    if bearing.angle is None:
        return replace(bearing, angle=said.angle)
    if said.angle is not None and bearing.angle != said.angle:
        raise SceneError(
            f"contact angle {bearing.angle:g} deg: {said.why('angle')} means {said.angle:g} deg: give one of "
            "both, or a designation of your own"
        )
    return bearing


def kind_of(said: Designation | None) -> str:
    """Return the kind of bearing that a designation says, else the usual one."""
    return _KIND if said is None or said.balls is None else {STEEL: "steel"}.get(said.balls, _KIND)
