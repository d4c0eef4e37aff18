"""Which entry of a catalogue a misspelt or short name may mean: bearings by size and maker."""

import difflib
import re
from collections.abc import Iterable
from typing import NamedTuple

# 70, 79 or 719; two digits of the bore; letters of the contact angle
_SIZE = re.compile(r"7(0|19|9)(\d\d)(AC|A5|C)?")
_BORES = {"00": 10, "01": 12, "02": 15, "03": 17}  # mm; from 04 on five times the digits
_ALIKE = 0.5  # likeness of letters below which a suggestion is a guess
_MOST = 3  # names that a suggestion lists


class _Designation(NamedTuple):
    """What a designation says: letters ahead of the size, series, bore (mm), letters of the angle or none."""

    maker: str
    series: str
    bore: int
    angle: str


def suggestion(wanted: str, names: Iterable[str]) -> str:
    """Return a question or a hint that names the nearest entries of a catalogue; empty where none is near.

    Bearings are near by bore, series and contact angle, then by maker: a size is worth more than letters.
    """
    known = list(names)
    asked = _read(wanted)
    read = {name: found for name in known if (found := _read(name)) is not None}
    if asked is None or not read:
        folded = {name.lower(): name for name in known}
        near = difflib.get_close_matches(wanted.lower(), folded, n=1, cutoff=_ALIKE)
        return f"did you mean '{folded[near[0]]}'? " if near else ""

    def distance(name: str) -> tuple[float, ...]:
        one = read[name]
        maker = difflib.SequenceMatcher(None, asked.maker, one.maker).ratio()
        angle = bool(asked.angle) and one.angle != asked.angle
        return abs(one.bore - asked.bore), one.series != asked.series, angle, 1.0 - maker

    least = min(map(distance, read))
    nearest = " or ".join(f"'{name}'" for name in [name for name in read if distance(name) == least][:_MOST])
    return f"did you mean {nearest}? " if least[:2] == (0, 0) else f"the nearest in size is {nearest}; "


def _read(text: str) -> _Designation | None:
    """Return what a designation says, blanks and dashes left out; None: it is of no known series."""
    folded = re.sub(r"[^A-Z0-9]", "", text.upper())
    match = _SIZE.search(folded)
    if match is None:
        return None
    series, digits, angle = match[1][-1], match[2], (match[3] or "").replace("A5", "AC")
    return _Designation(folded[: match.start()], series, _BORES.get(digits, 5 * int(digits)), angle)
