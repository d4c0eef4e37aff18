"""Circles of 24 points as the sound-field paper reads them, and its statements on them."""

from typing import Any

import numpy as np

from examples.papers.statements import AGAINST, CHANCE, UNSEEN, Judged, Reason, both, trend, verdict
from fmu_bearing.acoustics.analysis.directivity import directivity

RADII, PLACES = (30, 90, 150, 210, 270), (20, 50, 100, 150, 200)  # mm
R, L = 210, 50  # mm: the paper's circle
ANGLES = tuple(range(0, 360, 15))
IMPACT, FRICTION = (0, 60), (180, 240)  # deg: the paper's two load zones
TOLERANCE = 30.0  # deg: what a directivity angle may differ by where a load direction is set
_SAME = 7.5  # deg: half a step of the circle
_MEASURED_RISE = 81.87 - 71.30  # dB, middles: mean of 24 points at 18,000, 180 deg at 3,000 r/min


class Circle:
    """Levels (dB) round one circle and the paper's parameters of it (eqs. 13 to 15)."""

    def __init__(self, levels) -> None:
        self.levels = np.asarray(levels, dtype=float)
        whole = directivity(np.radians(ANGLES), self.levels)
        self.top, self.mean, self.dv, self.dl = whole.highest, whole.mean, whole.dv, whole.dl
        self.angle = round(np.degrees(whole.da))

    def zone(self, zone: tuple[int, int]) -> tuple[float, int, float]:
        """Largest level in a zone (dB), its angle (deg) and DL."""
        low, high = np.radians(zone)
        found = directivity(np.radians(ANGLES), self.levels, (float(low), float(high)))
        return found.highest, round(np.degrees(found.da)), found.dl


def circle_at(result: dict[str, Any], r: int = R, place: int = L) -> Circle:
    """Circle at r and l (mm)."""
    return Circle(result["field"][result["radii"].index(r)][result["places"].index(place)])


def apart(one: float, other: float) -> float:
    """Smallest difference of two angles (deg)."""
    return abs((one - other + 180.0) % 360.0 - 180.0)


def orderings(results: dict[int, dict[str, Any]], directive: bool = True) -> list[Judged]:
    """Judge the paper's statements for one variant; results by speed.

    ``directive``: whether the radiation model resolves angles; if not, statements on angles are not judged.
    """
    speeds = sorted(results)
    round_ = {rpm: circle_at(results[rpm]) for rpm in speeds}
    found = [*_zones(round_, speeds), *_with_speed(round_, speeds), *_with_distance(results.get(18000))]
    if directive:
        return found
    silent = ("DA", "DL", "DV", "zone")
    return [
        Judged(one.statement, UNSEEN, "this radiation model gives no directivity")
        if any(word in one.statement for word in silent)
        else one
        for one in found
    ]


def _zones(round_: dict[int, Circle], speeds: list[int]) -> list[Judged]:
    """Judge levels and angles of the two zones' maxima."""
    impact = {rpm: round_[rpm].zone(IMPACT) for rpm in speeds}
    friction = {rpm: round_[rpm].zone(FRICTION) for rpm in speeds}

    def near(found, first, last):
        margins = []
        for rpm in speeds:
            da, wanted = found[rpm][1], first + (last - first) * (rpm - 3000) / 15000
            margins.append((f"{rpm:,} at {da} deg", TOLERANCE - apart(da, wanted)))
        return margins

    opposite = [
        (f"{rpm:,}", TOLERANCE - abs(180.0 - apart(impact[rpm][1], friction[rpm][1]))) for rpm in speeds
    ]
    inside = [(f"{rpm:,} at {round_[rpm].angle} deg", 15.0 - _outside(round_[rpm].angle)) for rpm in speeds]
    difference = {rpm: friction[rpm][0] - impact[rpm][0] for rpm in speeds}
    return [
        verdict("DA of the zone 0-60 deg goes from 15 to 45 deg (within 30)", near(impact, 15, 45), "deg"),
        verdict(
            "DA of the zone 180-240 deg goes from 195 to 225 deg (within 30)", near(friction, 195, 225), "deg"
        ),
        verdict("both DA 180 deg apart (within 30)", opposite, "deg"),
        verdict("DA of the whole circle in or beside one of the zones (within 15 deg)", inside, "deg"),
        verdict(
            "3,000 r/min: zone 0-60 louder than 180-240",
            [(f"{rpm:,}", -difference[rpm]) for rpm in speeds if rpm == 3000],
        ),
        verdict(
            "above: zone 180-240 louder than 0-60",
            [(f"{rpm:,}", difference[rpm]) for rpm in speeds if rpm > 3000],
        ),
    ]


def _outside(angle: float) -> float:
    """How far an angle lies outside both zones (deg)."""
    half = 0.5 * (IMPACT[1] - IMPACT[0])
    return min(max(apart(angle, sum(zone) / 2) - half, 0.0) for zone in (IMPACT, FRICTION))


def _with_speed(round_: dict[int, Circle], speeds: list[int]) -> list[Judged]:
    """Judge levels and DL over speed."""
    rising = [
        (f"point {k + 1}, {b:,}", float(round_[b].levels[k] - round_[a].levels[k]))
        for k in (0, 6, 12, 18)
        for a, b in zip(speeds, speeds[1:], strict=False)
    ]

    sized = (
        [("3,000 to 18,000, mean", _MEASURED_RISE, round_[18000].mean - round_[3000].mean)]
        if {3000, 18000} <= set(speeds)
        else []
    )

    def change(first, last, dl):
        if not {first, last} <= set(speeds):
            return []
        return [(f"{first:,} to {last:,}", 100.0 * (dl(round_[last]) - dl(round_[first])))]

    return [
        both(verdict("points 1, 7, 13, 19 louder with every step of speed", rising), trend("", sized)),
        verdict(
            "DL of the zone 180-240 deg grows from 3,000 to 18,000 r/min",
            change(3000, 18000, lambda c: c.zone(FRICTION)[2]),
            "%",
        ),
        verdict(
            "DL of the zone 0-60 deg falls from 12,000 to 18,000 r/min",
            change(18000, 12000, lambda c: c.zone(IMPACT)[2]),
            "%",
        ),
        verdict(
            "DL of the whole circle grows from 3,000 to 18,000 r/min",
            change(3000, 18000, lambda c: c.dl),
            "%",
        ),
    ]


def _with_distance(result: dict[str, Any] | None) -> list[Judged]:
    """Judge statements on r and l at 18,000 r/min."""
    if result is None:
        return [Judged(words, UNSEEN, "") for words in _FAR]
    over_r = [circle_at(result, r, L) for r in RADII]
    over_l = [circle_at(result, R, place) for place in PLACES]

    def still(circles, names, own):
        margins = []
        for zone in (IMPACT, FRICTION):
            wanted = circles[names.index(own)].zone(zone)[1]
            for name, c in zip(names, circles, strict=True):
                margins.append((f"{name} mm", _SAME - apart(c.zone(zone)[1], wanted)))
        return margins

    def steps(names, value):
        return [(b, value(b) - value(a)) for a, b in zip(names, names[1:], strict=False)]

    dl = {r: 100.0 * c.dl for r, c in zip(RADII, over_r, strict=True)}
    zones = [(f"{r} mm", c.zone(FRICTION)[0] - c.zone(IMPACT)[0]) for r, c in zip(RADII, over_r, strict=True)]
    near = [circle_at(result, RADII[0], place) for place in (PLACES[0], PLACES[-1])]
    fall = near[0].top - near[1].top - (over_r[0].top - over_r[-1].top)
    dv = {(r, x): circle_at(result, r, x).dv for r in RADII for x in PLACES}
    grow = [(f"l {x}, r {r}", up) for x in PLACES for r, up in steps(RADII, lambda r, x=x: dv[r, x])]
    fade = [(f"r {r}, l {x}", -up) for r in RADII for x, up in steps(PLACES, lambda x, r=r: dv[r, x])]
    return [
        verdict(_FAR[0], still(over_r, RADII, R), "deg"),
        verdict(_FAR[1], still(over_l, PLACES, L), "deg"),
        verdict(_FAR[2], [(f"{r} mm", up) for r, up in steps(RADII, dl.__getitem__)], "%"),
        verdict(_FAR[3], zones),
        trend(_FAR[4], [("18,000", 19.5 - 14.34, fall)]),
        both(verdict(_FAR[5], grow), trend("", [(f"l {x}", *_over_r(dv, x, paper)) for x, paper in _GROWS])),
        both(verdict(_FAR[6], fade), trend("", [(f"r {r}", *_over_l(dv, r, paper)) for r, paper in _FADES])),
    ]


#: Differences of DV between the ends of r at a place l, and of l at a radius r, that the paper prints.
_GROWS = ((20, 7.99 - 3.62), (200, 6.32 - 2.36))
_FADES = ((30, 2.36 - 3.62), (270, 6.32 - 7.99))


def _over_r(dv: dict[tuple[int, int], float], place: int, paper: float) -> tuple[float, float]:
    return paper, dv[RADII[-1], place] - dv[RADII[0], place]


def _over_l(dv: dict[tuple[int, int], float], r: int, paper: float) -> tuple[float, float]:
    return paper, dv[r, PLACES[-1]] - dv[r, PLACES[0]]


_FAR = (
    "both DA the same at all r (18,000 r/min)",
    "both DA the same at all l",
    "DL grows with r",
    "zone 180-240 louder than 0-60 at all r",
    "level falls by more for l 20 to 200 mm (at r 30) than for r 30 to 270 mm (at l 50)",
    "DV grows with r at every l",
    "DV falls with l at every r",
)


def twins(ceramic: dict[int, dict[str, Any]], steel: dict[int, dict[str, Any]], directive: bool):
    """Judge ceramic against steel at 18,000 r/min, where the paper compares them; results by speed."""
    words = ("ceramic louder than steel (mean of the circle)", "ceramic more directive than steel (DV)")
    if 18000 not in ceramic or 18000 not in steel:
        return [Judged(text, UNSEEN, "") for text in words]
    one, other = circle_at(ceramic[18000]), circle_at(steel[18000])
    louder = verdict(words[0], [("18,000", one.mean - other.mean)])
    if not directive:
        return [louder, Judged(words[1], UNSEEN, "this radiation model gives no directivity")]
    return [louder, trend(words[1], [("18,000", 6.53 - 2.76, one.dv - other.dv)])]


_NO_CAUSE = (
    "no direction in the paper's inputs: without a radial load only phases of waviness and ball sizes tell "
    "one angle from another"
)
_DISTANCE = (
    "by distance alone (its eq. 12, r_i 30 mm) one contact is heard over 10 log[((r + r_i)^2 + l^2) / "
    "((r - r_i)^2 + l^2)]: "
)
#: Statements on angles, decided by the paper's inputs, and those against its own equation.
REASONS = {
    name: Reason(CHANCE, _NO_CAUSE)
    for name in (
        "DA of the zone 0-60 deg goes from 15 to 45 deg (within 30)",
        "DA of the zone 180-240 deg goes from 195 to 225 deg (within 30)",
        "both DA 180 deg apart (within 30)",
        "DA of the whole circle in or beside one of the zones (within 15 deg)",
        "3,000 r/min: zone 0-60 louder than 180-240",
        "above: zone 180-240 louder than 0-60",
        "DL of the zone 180-240 deg grows from 3,000 to 18,000 r/min",
        "DL of the zone 0-60 deg falls from 12,000 to 18,000 r/min",
        "DL of the whole circle grows from 3,000 to 18,000 r/min",
        *_FAR[:4],
    )
} | {
    _FAR[5]: Reason(AGAINST, _DISTANCE + "10.0 dB at r 30, 1.9 dB at r 270 mm (l 20), so it falls with r"),
    _FAR[6]: Reason(AGAINST, _DISTANCE + "at r 30 it falls by 9.6 dB from l 20 to 200 mm, not by 1.26"),
}
