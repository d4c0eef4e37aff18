"""Circles of 24 points as the sound-field paper reads them, and its statements on them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from examples.papers.reduced import ANGLES, PLACES, RADII, WHOLE, ZONES, L, R
from examples.papers.statements import UNSEEN, Judged, both, trend, verdict
from fmu_bearing.acoustics.analysis.directivity import directivity

IMPACT, FRICTION = "impact", "friction"
TOLERANCE = 30.0  # deg: what a directivity angle may differ by where a load direction is set
ALMOST_DB = 1.0  # what falls may differ by that the paper calls almost the same
_SAME = 7.5  # deg: half a step of the circle
_MEASURED_RISE = 81.87 - 71.30  # dB, middles: mean of 24 points at 18,000, 180 deg at 3,000 r/min
_FALLS = (14.34, 19.5)  # dB: the paper's, over r and over l


class Circle:
    """One circle of a result of `reduced.circles`, or of a median of such results.

    Attributes
    ----------
    levels : array
        Of the 24 points (dB).
    mean : float
        Their mean (dB).
    top, dv : float
        SPLmax and DV (dB), read from each run.
    """

    def __init__(self, result: Mapping[str, Any], r: int = R, place: int = L) -> None:
        whole = len(result["field"]) > 1
        radii, places = (RADII, PLACES) if whole else ((R,), (L,))
        self._result, self._at = result, (radii.index(r), places.index(place))
        self.levels = np.asarray(self._of(result["field"]), dtype=float)
        self.mean = float(self.levels.mean())
        self.top = float(self._of(result["top"]["whole"]))
        self.dv = float(self._of(result["dv"]))

    def _of(self, rows: Any) -> Any:
        return rows[self._at[0]][self._at[1]]

    def dl(self, zone: str = "whole") -> float:
        """DL of a zone, or of the whole circle (eq. 14), read from each run."""
        return float(self._of(self._result["dl"][zone]))

    def loudest(self, zone: str = "whole") -> float:
        """Largest level in a zone of this circle (dB)."""
        return self._read(zone).highest

    def angle(self, zone: str = "whole") -> int:
        """DA of a zone of this circle (deg)."""
        return round(np.degrees(self._read(zone).da))

    def _read(self, zone: str):
        ends = ZONES[zone]
        inside = None if ends is None else (float(np.radians(ends[0])), float(np.radians(ends[1])))
        return directivity(np.radians(ANGLES), self.levels, inside)


def apart(one: float, other: float) -> float:
    """Smallest difference of two angles (deg)."""
    return abs((one - other + 180.0) % 360.0 - 180.0)


def falls(result: Mapping[str, Any]) -> tuple[list[float], list[float]]:
    """Falls of SPLmax (dB) between the ends of r, for each of `PLACES`, and of l, for each of `RADII`."""
    top = result["top"]["whole"]
    return (
        [top[0][k] - top[-1][k] for k in range(len(PLACES))],
        [row[0] - row[-1] for row in top],
    )


def orderings(
    results: Mapping[int, dict[str, Any]], steel: Mapping[int, dict[str, Any]], directive: bool = True
) -> list[Judged]:
    """Judge the paper's statements for one variant and one seed.

    Parameters
    ----------
    results, steel : mapping of int to result
        By speed (r/min): of the bearing, and of its steel twin.
    directive : bool
        Whether the radiation model resolves angles; if not, statements on angles are not judged.
    """
    speeds = sorted(results)
    round_ = {rpm: Circle(results[rpm]) for rpm in speeds}
    found = [
        *_zones(round_, speeds), *_with_speed(round_, speeds), *_with_distance(results.get(WHOLE)),
        *_twins(results.get(WHOLE), steel.get(WHOLE)),
    ]  # fmt: skip
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
    angles = {zone: {rpm: round_[rpm].angle(zone) for rpm in speeds} for zone in ZONES}

    def near(zone, first, last):
        margins = []
        for rpm in speeds:
            da, wanted = angles[zone][rpm], first + (last - first) * (rpm - 3000) / 15000
            margins.append((f"{rpm:,} at {da} deg", TOLERANCE - apart(da, wanted)))
        return margins

    opposite = [
        (f"{rpm:,}", TOLERANCE - abs(180.0 - apart(angles[IMPACT][rpm], angles[FRICTION][rpm])))
        for rpm in speeds
    ]
    inside = [(f"{rpm:,} at {da} deg", 15.0 - _outside(da)) for rpm, da in angles["whole"].items()]
    difference = {rpm: round_[rpm].loudest(FRICTION) - round_[rpm].loudest(IMPACT) for rpm in speeds}
    return [
        verdict(_TURNS[0], near(IMPACT, 15, 45), "deg"),
        verdict(_TURNS[1], near(FRICTION, 195, 225), "deg"),
        verdict(_TURNS[2], opposite, "deg"),
        verdict(_TURNS[3], inside, "deg"),
        verdict(_LOUDER[0], [(f"{rpm:,}", -difference[rpm]) for rpm in speeds if rpm == 3000]),
        verdict(_LOUDER[1], [(f"{rpm:,}", difference[rpm]) for rpm in speeds if rpm > 3000]),
    ]


def _outside(angle: float) -> float:
    """How far an angle lies outside both zones (deg)."""
    return min(
        max(apart(angle, 0.5 * (low + high)) - 0.5 * (high - low), 0.0)
        for low, high in (zone for zone in ZONES.values() if zone is not None)
    )


def _with_speed(round_: dict[int, Circle], speeds: list[int]) -> list[Judged]:
    """Judge levels and DL over speed."""
    rising = [
        (f"point {k + 1}, {b:,}", float(round_[b].levels[k] - round_[a].levels[k]))
        for k in (0, 6, 12, 18)
        for a, b in zip(speeds, speeds[1:], strict=False)
    ]
    sized = (
        [("3,000 to 18,000, mean", _MEASURED_RISE, round_[WHOLE].mean - round_[3000].mean)]
        if {3000, WHOLE} <= set(speeds)
        else []
    )

    def change(first, last, zone="whole"):
        if not {first, last} <= set(speeds):
            return []
        return [(f"{first:,} to {last:,}", 100.0 * (round_[last].dl(zone) - round_[first].dl(zone)))]

    return [
        both(verdict("points 1, 7, 13, 19 louder with every step of speed", rising), trend("", sized)),
        verdict(_FIRMER[0], change(3000, WHOLE, FRICTION), "%"),
        verdict(_FIRMER[1], change(WHOLE, 12000, IMPACT), "%"),
        verdict("DL of the whole circle grows from 3,000 to 18,000 r/min", change(3000, WHOLE), "%"),
    ]


def _with_distance(result: dict[str, Any] | None) -> list[Judged]:
    """Judge statements on r and l at 18,000 r/min."""
    if result is None or len(result["field"]) == 1:
        return [Judged(words, UNSEEN, "") for words in _FAR]
    over_r = [Circle(result, r, L) for r in RADII]
    over_l = [Circle(result, R, place) for place in PLACES]

    def still(circles, names, own):
        margins = []
        for zone in (IMPACT, FRICTION):
            wanted = circles[names.index(own)].angle(zone)
            for name, c in zip(names, circles, strict=True):
                margins.append((f"{name} mm", _SAME - apart(c.angle(zone), wanted)))
        return margins

    def steps(names, value):
        return [(b, value(b) - value(a)) for a, b in zip(names, names[1:], strict=False)]

    def fall(circles, zone):
        return circles[0].loudest(zone) - circles[-1].loudest(zone)

    def firmer(zone):
        return 100.0 * (over_r[-1].dl(zone) - over_r[0].dl(zone))

    dl = {r: 100.0 * c.dl() for r, c in zip(RADII, over_r, strict=True)}
    zones = [(f"{r} mm", c.loudest(FRICTION) - c.loudest(IMPACT)) for r, c in zip(RADII, over_r, strict=True)]
    by_r, by_l = falls(result)
    dv, top = ({(r, x): read(Circle(result, r, x)) for r in RADII for x in PLACES} for read in (_dv, _top))
    grow = [(f"l {x}, r {r}", up) for x in PLACES for r, up in steps(RADII, lambda r, x=x: dv[r, x])]
    fade = [(f"r {r}, l {x}", -up) for r in RADII for x, up in steps(PLACES, lambda x, r=r: dv[r, x])]
    lower = [(f"l {x}, r {r}", -up) for x in PLACES for r, up in steps(RADII, lambda r, x=x: top[r, x])]
    lower += [(f"r {r}, l {x}", -up) for r in RADII for x, up in steps(PLACES, lambda x, r=r: top[r, x])]
    return [
        verdict(_FAR[0], still(over_r, RADII, R), "deg"),
        verdict(_FAR[1], still(over_l, PLACES, L), "deg"),
        verdict(_FAR[2], [(f"{r} mm", up) for r, up in steps(RADII, dl.__getitem__)], "%"),
        verdict(_FAR[3], zones),
        trend(_FAR[4], [("18,000", _FALLS[1] - _FALLS[0], by_l[RADII.index(30)] - by_r[PLACES.index(L)])]),
        both(verdict(_FAR[5], grow), trend("", [(f"l {x}", *_over_r(dv, x, paper)) for x, paper in _GROWS])),
        both(verdict(_FAR[6], fade), trend("", [(f"r {r}", *_over_l(dv, r, paper)) for r, paper in _FADES])),
        verdict(_FAR[7], lower),
        verdict(_FAR[8], [("30 to 270 mm", fall(over_r, IMPACT) - fall(over_r, FRICTION))]),
        verdict(_FAR[9], [("30 to 270 mm", firmer(FRICTION) - firmer(IMPACT))], "%"),
        verdict(_FAR[10], [("20 to 200 mm", ALMOST_DB - abs(fall(over_l, IMPACT) - fall(over_l, FRICTION)))]),
        verdict(_FAR[11], [("20 to 200 mm", 100.0 * (over_l[0].dl() - over_l[-1].dl()))], "%"),
    ]


def _dv(circle: Circle) -> float:
    return circle.dv


def _top(circle: Circle) -> float:
    return circle.top


#: Differences of DV between the ends of r at a place l, and of l at a radius r, that the paper prints.
_GROWS = ((20, 7.99 - 3.62), (200, 6.32 - 2.36))
_FADES = ((30, 2.36 - 3.62), (270, 6.32 - 7.99))


def _over_r(dv: dict[tuple[int, int], float], place: int, paper: float) -> tuple[float, float]:
    return paper, dv[RADII[-1], place] - dv[RADII[0], place]


def _over_l(dv: dict[tuple[int, int], float], r: int, paper: float) -> tuple[float, float]:
    return paper, dv[r, PLACES[-1]] - dv[r, PLACES[0]]


_TURNS = (
    "DA of the zone 0-60 deg goes from 15 to 45 deg (within 30)",
    "DA of the zone 180-240 deg goes from 195 to 225 deg (within 30)",
    "both DA 180 deg apart (within 30)",
    "DA of the whole circle in or beside one of the zones (within 15 deg)",
)
_LOUDER = (
    "3,000 r/min: zone 0-60 louder than 180-240",
    "above: zone 180-240 louder than 0-60",
)
_FIRMER = (
    "DL of the zone 180-240 deg grows from 3,000 to 18,000 r/min",
    "DL of the zone 0-60 deg falls from 12,000 to 18,000 r/min",
)
_FAR = (
    "both DA the same at all r (18,000 r/min)",
    "both DA the same at all l",
    "DL grows with r",
    "zone 180-240 louder than 0-60 at all r",
    "level falls by more for l 20 to 200 mm (at r 30) than for r 30 to 270 mm (at l 50)",
    "DV grows with r at every l",
    "DV falls with l at every r",
    "SPLmax falls with every step of r and of l",
    "over r the zone 180-240 falls by less than 0-60 (at l 50)",
    "DL grows with r by more in the zone 180-240 than in 0-60",
    f"over l both zones fall by the same (within {ALMOST_DB:.0f} dB, at r 210)",
    "DL falls for l 20 to 200 mm (at r 210)",
)
_TWINS = ("ceramic louder than steel (mean of the circle)", "ceramic more directive than steel (DV)")


def _twins(ceramic: dict[str, Any] | None, steel: dict[str, Any] | None) -> list[Judged]:
    """Judge ceramic against steel at 18,000 r/min, where the paper compares them."""
    if ceramic is None or steel is None:
        return [Judged(words, UNSEEN, "") for words in _TWINS]
    one, other = Circle(ceramic), Circle(steel)
    return [
        verdict(_TWINS[0], [("18,000", one.mean - other.mean)]),
        trend(_TWINS[1], [("18,000", 6.53 - 2.76, one.dv - other.dv)]),
    ]
