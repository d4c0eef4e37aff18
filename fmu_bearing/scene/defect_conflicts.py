"""What does not fit between local defects and the bearing that has them, or between two of them."""

import math
from collections.abc import Iterator
from itertools import combinations

from fmu_bearing.scene.base import Conflict
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.defect import Defect
from fmu_bearing.scene.scene import Tables

_SIDES = {"inner": -1.0, "outer": 1.0}


def conflicts(tables: Tables) -> Iterator[Conflict]:
    """Yield defects that their bearing cannot have, and two that run into each other."""
    flaws = tables.imperfections
    placed: list[tuple[int, Defect, Bearing]] = []
    for number, defect in enumerate(() if flaws is None else flaws.defect, start=1):
        path = f"imperfections.defect[{number}]"
        found = list(_owner(tables, defect, path))
        yield from found
        if not found:
            bearing = tables.geometries[(defect.bearing or 1) - 1]
            placed.append((number, defect, bearing))
            yield from _too_large(defect, bearing, path)
    for (one, first, bearing), (other, second, _) in combinations(placed, 2):
        if _body(first) == _body(second):
            yield from _overlap(one, first, other, second, bearing)


def race_radius(bearing: Bearing, on: str) -> float:
    """Radius (mm) of the circle on a race's surface on which balls roll at the nominal contact angle."""
    across = bearing.ball_diameter_mm * math.cos(bearing.nominal_angle)
    return 0.5 * (bearing.pitch_diameter_mm + _SIDES[on] * across)


def _owner(tables: Tables, defect: Defect, path: str) -> Iterator[Conflict]:
    """Yield a bearing or a ball that is not there."""
    count = len(tables.members)
    if not count and defect.bearing is not None:
        yield Conflict(f"{path}.bearing", "is of sets of bearings: this scene has one; leave it out")
    elif count and defect.bearing is None:
        yield Conflict(
            f"{path}.bearing",
            f"is missing, for example bearing = 1: which of the {count} bearings has the defect",
        )
    elif count and (defect.bearing or 0) > count:
        yield Conflict(
            f"{path}.bearing",
            f"= {defect.bearing} is refused; allowed: 1 to {count}, the bearings of the set",
        )
    else:
        balls = tables.geometries[(defect.bearing or 1) - 1].ball_count
        if defect.ball is not None and defect.ball > balls:
            yield Conflict(
                f"{path}.ball", f"= {defect.ball} is refused; allowed: 1 to {balls}, the balls of the bearing"
            )


def _too_large(defect: Defect, bearing: Bearing, path: str) -> Iterator[Conflict]:
    """Yield sizes beyond the distance of the balls, and beyond the groove.

    Shoulders are known by effective diameters alone, so a groove counts as wide as its ball.
    """
    wide = bearing.ball_diameter_mm
    if defect.on == "ball":
        limit, words, across = wide, "the diameter of the ball", "the diameter of the ball"
    else:
        limit = 2.0 * math.pi * race_radius(bearing, defect.on) / bearing.ball_count
        words = "the distance of the balls along the race: two of them would be over it at once"
        across = "the diameter of the ball: no groove is wider"
    key = "width_mm" if defect.shape == "scratch" else "length_mm"
    if defect.span_mm > limit:
        yield Conflict(
            f"{path}.{key}",
            f"takes {defect.span_mm:.4g} mm along rolling; allowed: up to {limit:.4g}, {words}",
        )
    width = defect.across_mm
    if width is not None and width > wide:
        key = "length_mm" if defect.width_mm is None or defect.shape == "scratch" else "width_mm"
        yield Conflict(
            f"{path}.{key}", f"is {width:.4g} mm across the track; allowed: up to {wide:.4g}, {across}"
        )
    offset = abs(defect.offset_mm or 0.0)
    if defect.on != "ball" and offset > 0.5 * wide:
        yield Conflict(
            f"{path}.offset_mm",
            f"= {defect.offset_mm:g} is refused; allowed: {-0.5 * wide:.4g} to {0.5 * wide:.4g} mm, within "
            "the groove",
        )


def _body(defect: Defect) -> tuple[int | None, str, int | None]:
    return defect.bearing, defect.on, defect.ball


def _overlap(one: int, first: Defect, other: int, second: Defect, bearing: Bearing) -> Iterator[Conflict]:
    """Yield a second defect on the same race or ball whose middle is nearer than both lengths together."""
    if first.on == "ball":
        key = "tilt_deg"
        turned = math.radians(abs((first.tilt_deg or 0.0) - (second.tilt_deg or 0.0)))
        apart = 0.5 * bearing.ball_diameter_mm * turned
        words = f"ball {first.ball}"
    else:
        key = "angle_deg"
        turned = math.remainder(first.angle - second.angle, 2.0 * math.pi)
        apart = race_radius(bearing, first.on) * abs(turned)
        words = f"the {first.on} race"
    least = first.span_mm + second.span_mm
    if apart < least:
        yield Conflict(
            f"imperfections.defect[{other}].{key}",
            f"puts it {apart:.3g} mm from defect {one} on {words}; allowed: {least:.4g} mm or more, both "
            "lengths together: move one of them, or give one defect as long as both",
        )
