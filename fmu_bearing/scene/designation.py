"""What a designation says: maker, kind, size, contact angle, balls, cage, tolerance class.

`suggestion` finds the entry of a catalogue that a misspelt or short name may mean.
"""

import difflib
import re
import unicodedata
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from fmu_bearing.scene.dimension_series import boundary
from fmu_bearing.scene.symbols import CERAMIC, STEEL, meaning

# 70, 79 or 719; two digits of the bore; letters of the contact angle
_SIZE = re.compile(r"7(0|19|9)(\d\d)(AC|A5|C)?")
_BORES = {"00": 10, "01": 12, "02": 15, "03": 17}  # mm; from 04 on five times the digits
#: Series of single-row angular contact ball bearings that no entry has: two digits of the bore follow.
_SERIES = re.compile(r"7(2|3|4|18|8)(\d\d)(?!\d)(B|AC|A5|A|C)?")
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue", "ß": "ss"})
_ALIKE = 0.5  # likeness of letters below which a suggestion is a guess
_MOST = 3  # names that a suggestion lists

ANGULAR = "angular contact ball bearing"
MAKERS = ("NSK", "SKF", "FAG", "NTN", "GMN")
_NAMED = re.compile(rf"^({'|'.join(MAKERS)})\b[\s_-]*")
#: Makers' forms: of each size, what is before and behind it. Only signs that no other maker writes are ones.
_FORMS = {
    "SKF": re.compile(
        r"^(?P<prefix>SV|S|V|)(?P<series>70|72|718|719)(?P<slash>/?)(?P<bore>\d{1,2}) ?"
        r"(?P<angle>AC|C|F)(?P<design>[BDE])\b ?(?P<rest>.*)$"
    ),
    "FAG": re.compile(
        r"^(?P<prefix>(?:HC|XC)?(?:RS|B|M)|H[SC]S?|XCS?)(?P<series>70|72|718|719)(?P<bore>\d\d)-?"
        r"(?P<angle>[CDE])(?=-|$)(?P<rest>.*)$"
    ),
    "GMN": re.compile(
        r"^(?P<prefix>(?:HY)? ?(?:SM|S|KH)) ?(?P<series>60|62|618|619)(?P<bore>\d\d) ?"
        r"(?P<angle>[CE])\b ?(?P<rest>.*)$"
    ),
    "NTN": re.compile(
        r"^(?P<prefix>(?:5S-)?(?:2LA-)?)(?P<series>70|72|78|79)(?P<bore>\d\d)U?"
        r"(?P<angle>AD|C|B|)(?P<rest>(?:DB|DF|DT|DTBT|D2|G|T1|T2|/|P\d|L1|$).*)$"
    ),
    "NSK": re.compile(r"^(?P<prefix>)(?P<series>70|72|79)(?P<bore>\d\d)(?P<angle>A5|AC|C|A|B)(?P<rest>.*)$"),
}
#: NSK's series that letters name: bore in mm, type, dimension series, balls.
_LETTERS = re.compile(r"^(?P<bore>\d{2,3}) ?(?P<series>BNR|BER|BGR) ?\d\d ?(?P<balls>[SHX])(?P<rest>.*)$")
_PLAIN = re.compile(r"^(?P<series>70|72|79|718|719)(?P<bore>\d\d)(?P<angle>A5|AC|C|A|B|E)?\b")
_TOLERANCE = re.compile(r"P([A-Z]?)(\d)")
#: Kinds of bearings that are not modelled, by how their designations begin (ISO, SKF, NSK, FAG).
_OTHERS = (
    (r"(?:NU|NJ|NUP|NN|NNU|NNC|NCF|NF|N|RNU|RN)(?=\d)", "cylindrical roller bearing"),
    (r"(?:QJF?)(?=\d)", "four-point contact ball bearing"),
    (r"(?:R?NA|NKI?S?|HK|BK|K)(?=\d)", "needle roller bearing"),
    (r"C[234][0-9]{3}(?!\d)", "toroidal roller bearing"),
    (r"(?:6\d{2,4}|16\d{3}|4[23]\d\d)(?!\d)", "deep groove ball bearing"),
    (r"(?:32|33|52|53)\d\d(?!\d)", "double-row angular contact ball bearing"),
    (r"(?:1[0234]|2[23])\d\d(?!\d)", "self-aligning ball bearing"),
    (r"(?:213|22[234]|23[0-9]|24[01])\d\d(?!\d)", "spherical roller bearing"),
    (r"(?:3[0-3][0-9])\d\d(?!\d)", "tapered roller bearing"),
    (r"5[1-4]\d{3}(?!\d)", "thrust ball bearing"),
    (r"(?:29[234]|8[1-9]\d)\d\d(?!\d)", "thrust roller bearing"),
    (r"(?:BSA|BSB|BSD|BST|TAC|760|762)\d+|\d\dTAC", "bearing for screws, of 60 deg"),
)
#: Angles (deg) on which all makers agree; AC and A5 are 25, A and E mean different ones.
_AGREED = {"C": 15.0, "AC": 25.0, "A5": 25.0, "B": 40.0}
_CAGES = {"NSK": ("TYN", "TR", "T"), "SKF": ("TNHA", "MA"), "FAG": ("TPA", "T"), "NTN": ("T1", "T2"),
          "GMN": ("TA", "TB")}  # fmt: skip


class Designation(NamedTuple):
    """What a designation says; None where it says nothing.

    Attributes
    ----------
    text : str
        As given.
    maker : str
        Empty: makers write it in the same way.
    kind : str
        ``"angular contact ball bearing"``, or another that is not modelled.
    series : str
    bore : float or None
        In mm.
    angle : float or None
        Contact angle (deg).
    balls : str or None
        ``"steel"`` or ``"Si3N4"``.
    cage : str or None
        ``"phenolic"``, ``"polyamide"``, ``"PEEK"`` or ``"brass"``.
    tolerance : str or None
        ``"P5"``, ``"P4"`` or ``"P2"``, which makers' P4A, P4S and PA9A come near.
    symbols : dict of str to str
        The sign behind ``angle`` and ``balls``, for people: ``{"angle": "AC"}``.
    """

    text: str
    maker: str
    kind: str
    series: str
    bore: float | None = None
    angle: float | None = None
    balls: str | None = None
    cage: str | None = None
    tolerance: str | None = None
    symbols: dict[str, str] = {}

    def why(self, field: str) -> str:
        """Return maker and sign behind a value, as ``SKF: AC``."""
        whose, sign = self.maker or "all makers", self.symbols.get(field, "")
        return f"{whose}: {sign or 'no symbol'} in {self.text}"


def read_designation(text: str) -> Designation | None:
    """Return what a designation says; None where it is not one that is known.

    Tables of signs and their sources are in ``symbols``. ``7010C`` without a maker has what all makers mean:
    15 deg and steel balls.
    """
    folded = re.sub(r"\s+", " ", text.upper()).strip()
    named = _NAMED.match(folded)
    maker = named[1] if named else ""
    body = folded[named.end() :] if named else folded
    if maker in ("", "NSK") and (match := _LETTERS.match(body)):
        return _lettered(text, match)
    for whose in (maker,) if maker else ("SKF", "FAG", "GMN"):
        if match := _FORMS[whose].match(body):
            return _of(text, whose, match)
    if not maker and (body.startswith("5S-") or re.match(r"^7\d{3}U", body)):
        if match := _FORMS["NTN"].match(body):
            return _of(text, "NTN", match)
    nsk = _FORMS["NSK"].match(body)
    if not maker and nsk and (nsk["angle"] == "A5" or re.match(r"(SN24|TYN|TR)", nsk["rest"])):
        return _of(text, "NSK", nsk)
    if plain := _PLAIN.match(body):
        angle = _AGREED.get(plain["angle"] or "")
        signs = {"angle": plain["angle"] or "", "balls": ""}
        tolerance = _class(body[plain.end() :])
        return Designation(
            text, maker, ANGULAR, plain["series"], _bore(plain["bore"], False), angle, STEEL,
            tolerance=tolerance, symbols=signs,
        )  # fmt: skip
    other = _other_kind(text)
    return Designation(text, maker, other, "") if other else None


def _other_kind(text: str) -> str:
    """Return the kind of bearing that is not modelled and that a designation names; empty: none."""
    folded = _folded(text)
    makers = "|".join((*MAKERS, "INA", "KOYO", "TIMKEN", "SNR", "NACHI"))
    return next((kind for form, kind in _OTHERS if re.match(rf"(?:{makers})?(?:{form})", folded)), "")


def _of(text: str, maker: str, match: "re.Match[str]") -> Designation:
    """Return what a form of a maker says."""
    prefix, sign, rest = match["prefix"].replace(" ", "").strip("-"), match["angle"], match["rest"]
    if maker == "NTN":
        prefix = prefix.partition("-")[0].replace("2LA", "")
    angle = None if "M" in prefix and maker == "FAG" else meaning(maker, "angle", sign, "angle")
    balls, whose = meaning(maker, "prefix", prefix, "balls"), prefix
    for ceramic in ("SN24", "HC"):
        if meaning(maker, "suffix", ceramic, "balls") == CERAMIC and ceramic in rest:
            balls, whose = CERAMIC, ceramic
    if balls is None:
        balls = meaning(maker, "suffix", "", "balls")
    cage = next((one for one in _CAGES[maker] if re.search(rf"(?:^|[ /-])?{one}(?![A-Z]*LU)", rest)), "")
    slash = bool(match.groupdict().get("slash"))
    return Designation(
        text, maker, ANGULAR, match["series"], _bore(match["bore"], slash), _number(angle), _word(balls),
        _word(meaning(maker, "suffix", cage, "cage")), _class(rest), {"angle": sign, "balls": whose},
    )  # fmt: skip


def _lettered(text: str, match: "re.Match[str]") -> Designation:
    """Return what NSK's series with letters say."""
    cage = next((one for one in _CAGES["NSK"] if match["rest"].strip().startswith(one)), "")
    return Designation(
        text, "NSK", ANGULAR, match["series"], float(match["bore"]),
        _number(meaning("NSK", "type", match["series"], "angle")),
        _word(meaning("NSK", "type", match["balls"], "balls")), _word(meaning("NSK", "suffix", cage, "cage")),
        _class(match["rest"]), {"angle": match["series"], "balls": match["balls"]},
    )  # fmt: skip


def _number(value: str | float | None) -> float | None:
    return value if isinstance(value, float) else None


def _word(value: str | float | None) -> str | None:
    return value if isinstance(value, str) else None


def _bore(digits: str, millimetres: bool) -> float:
    """Return the bore (mm) of the digits of a designation; a slash before them means mm."""
    return float(digits) if millimetres else float(_BORES.get(digits, 5 * int(digits)))


def _class(rest: str) -> str | None:
    """Return the tolerance class; makers' classes in letters come near P4 (PA7) and P2 (PA9)."""
    found = _TOLERANCE.search(rest)
    if found is None:
        return None
    by_letter = {"7": "P4", "9": "P2"}
    name = by_letter.get(found[2]) if found[1] == "A" else f"P{found[2]}"
    return {"P3": "P4"}.get(name or "", name) if name in ("P6", "P5", "P4", "P3", "P2") else None


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
    if any(map(_read, known)) and (words := _not_there(wanted, known)):
        return words
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
    if least[:2] == (0, 0):
        return f"did you mean {nearest}? "
    way = _by_dimensions(asked.series, asked.bore, asked.angle)
    return f"the nearest in size is {nearest}, or {way}"


def _not_there(wanted: str, known: Sequence[str]) -> str:
    """Say what a designation names that no catalogue has: another series or kind; empty: it may be one."""
    folded = _folded(wanted)
    if _SIZE.search(folded) or any(folded == _folded(name) for name in known):
        return ""
    of_series = _SERIES.search(folded)
    if of_series is not None:
        series, digits, letters = of_series.groups()
        way = _by_dimensions(series, _bore(digits, False), letters or "")
        return f"it is of series 7{series}, and the catalogue has 70 and 79 (719): {way}"
    if kind := _other_kind(wanted):
        return f"it is a {kind}, which is not modelled: single-row angular contact ball bearings are; "
    return ""


def _by_dimensions(series: str, bore: float, letters: str) -> str:
    """Say how a bearing is given by its dimensions, with those that its series has."""
    outside, width = boundary(series, bore) or ("D", "B")
    angle = f"{_AGREED[letters]:g}" if letters in _AGREED else "DEG"
    return (
        f"give its dimensions, `fmu-bearing scene new --bore {bore:g} --outside-diameter {outside} --width "
        f"{width} --contact-angle {angle}`, and for its own balls the maker's C and C0 "
        "(N) by --dynamic-rating and --static-rating; "
    )


def _folded(text: str) -> str:
    return re.sub(r"[^A-Z0-9]", "", text.upper())


def ascii_word(text: str) -> str:
    """Return a text in ASCII letters, digits and underscores: accents left out, others as underscores.

    Two texts that differ only in what is left out get the same word.
    """
    plain = unicodedata.normalize("NFKD", unicodedata.normalize("NFC", text).translate(_UMLAUTS))
    bare = "".join(letter for letter in plain if not unicodedata.combining(letter))
    return re.sub(r"\W", "_", bare, flags=re.ASCII)


def _read(text: str) -> _Designation | None:
    """Return what a designation says, blanks and dashes left out; None: it is of no known series."""
    folded = _folded(text)
    match = _SIZE.search(folded)
    if match is None:
        return None
    series, digits, angle = match[1][-1], match[2], (match[3] or "").replace("A5", "AC")
    return _Designation(folded[: match.start()], series, _BORES.get(digits, 5 * int(digits)), angle)
