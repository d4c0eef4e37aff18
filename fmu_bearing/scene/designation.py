"""What a designation says: maker, kind, size, contact angle, balls, cage, tolerance class.

`suggestion` finds the entry of a catalogue that a misspelt or short name may mean.
"""

import difflib
import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

from fmu_bearing.scene.dimension_series import boundary
from fmu_bearing.scene.symbols import CERAMIC, SILENT, STEEL, meaning

# 70, 79 or 719; two digits of the bore; letters of the contact angle
_SIZE = re.compile(r"7(0|19|9)(\d\d)(AC|A5|C)?")
_BORES = {"00": 10, "01": 12, "02": 15, "03": 17}  # mm; from 04 on five times the digits
#: Figures behind the 7 of makers' series, by which their dimensions go.
_FIGURES = {
    **{f"7{one}": one for one in ("0", "9", "2", "3", "4", "18", "8")}, "719": "9", "60": "0", "62": "2",
    "618": "18", "619": "9", **dict.fromkeys(("EX", "VEX", "HX", "HSE0"), "0"),
    **dict.fromkeys(("SEB", "VEB", "HB", "HSE9"), "9"), "SEA": "18",
    **{f"{kind}{size}": one for kind in ("BNR", "BER", "BGR", "BAR", "BTR")
       for size, one in (("10", "0"), ("19", "9"))},
}  # fmt: skip
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue", "ß": "ss"})
_ALIKE = 0.5  # likeness of letters below which a suggestion is a guess
_MOST = 3  # names that a suggestion lists

ANGULAR = "angular contact ball bearing"
DEEP_GROOVE = "deep groove ball bearing"
MAKERS = ("NSK", "SKF", "FAG", "NTN", "GMN", "SNFA")
_NAMED = re.compile(rf"^({'|'.join(MAKERS)})[\s_-]*")
#: Makers' forms: of each size, what is before and behind it.
_FORMS = {
    "SKF": re.compile(
        r"^(?P<prefix>SV|S|V|)(?P<series>70|72|718|719)(?P<slash>/?)(?P<bore>\d{1,2}) ?"
        r"(?P<angle>AC|C|F)[BDE](?P<rest>(?:D?G[A-D]|TNHA|MA)?(?![A-Z]).*)$"
    ),
    "SKF industrial": re.compile(
        r"^(?P<prefix>)(?P<series>70|72|73|74)(?P<bore>\d\d) ?(?P<angle>AC|A|B)E?(?P<rest>.*)$"
    ),
    "FAG": re.compile(
        r"^(?P<prefix>(?:HC|XC)?(?:RS|B|M)|H[SC]S?|XCS?)-?(?P<series>70|72|718|719)(?P<bore>\d\d)-?"
        r"(?P<angle>[CDE])(?=-|$)(?P<rest>.*)$"
    ),
    "FAG industrial": re.compile(
        r"^(?P<prefix>)(?P<series>70|72|73|74)(?P<bore>\d\d)-(?P<angle>B)(?=-|$)(?P<rest>.*)$"
    ),
    "GMN": re.compile(
        r"^(?P<prefix>(?:HY)? ?(?:SM|S|KH)) ?(?P<series>60|62|618|619)(?P<bore>\d\d) ?"
        r"(?P<angle>[CE])\b ?(?P<rest>.*)$"
    ),
    "GMN hybrid": re.compile(
        r"^(?P<prefix>HY ?(?:SM|S|KH)) ?(?P<series>60|62|618|619)(?P<bore>\d\d)(?P<angle>)(?P<rest>.*)$"
    ),
    "NTN": re.compile(
        r"^(?P<prefix>(?:5S-?)?(?:2LA-?)?)(?P<series>70|72|73|78|79)(?P<bore>\d\d)U?"
        r"(?P<angle>AD|C|B|)(?P<rest>(?:D|G|T1|T2|LLB|/|P\d|L1|$).*)$"
    ),
    "NTN high speed": re.compile(
        r"^(?P<prefix>(?:5S-?)?(?:2LA-?)?)(?P<series>HSE[09])(?P<bore>\d\d)"
        r"(?:(?P<angle>AD|C)(?![A-CE-Z]))?(?P<rest>.*)$"
    ),
    # DU behind the bore may be a seal or a set: asked for
    "NSK": re.compile(
        r"^(?P<prefix>)(?P<series>70|72|73|79)(?P<bore>\d\d)(?P<angle>A5|AC|C|A|B|(?!DU))(?P<rest>.*)$"
    ),
}
#: NSK's series that letters name: bore in mm, type, dimension series, balls.
_LETTERS = re.compile(
    r"^(?P<bore>\d{2,3})(?P<series>(?P<type>BNR|BER|BGR|BAR|BTR)\d\d)(?P<balls>[SHX])(?P<rest>.*)$"
)
#: SNFA's: series, bore in mm, seal, balls, class of ABEC, cage, angle.
_SNFA = re.compile(
    r"^(?P<series>SEA|SEB|VEB|VEX|EX|HB|HX)(?P<bore>\d{1,3})(?:/S)?(?P<balls>/NS)?"
    r"(?P<grade>[579])(?P<cage>C[A-Z])(?P<angle>\d)(?P<rest>.*)$"
)
#: Of these no cage is read: without a sign it is of several materials.
_INDUSTRIAL = tuple(pattern for form, pattern in _FORMS.items() if form.endswith("industrial"))
_ABEC = {"5": "P5", "7": "P4", "9": "P2"}
_PLAIN = re.compile(
    r"^(?P<series>718|719|70|72|73|74|79)(?P<bore>\d\d)(?!\d)[ -]?(?P<angle>A5|AC|C|A|B|E|)(?P<rest>.*)$"
)
_TOLERANCE = re.compile(r"P([A-Z]?)(\d)")
#: Kinds of bearings beside angular contact ones, by how their designations begin (ISO, SKF, NSK, FAG).
_OTHERS = (
    (r"(?:NU|NJ|NUP|NN|NNU|NNC|NCF|NF|N|RNU|RN)(?=\d)", "cylindrical roller bearing"),
    (r"(?:QJF?)(?=\d)", "four-point contact ball bearing"),
    (r"(?:R?NA|NKI?S?|HK|BK|K)(?=\d)", "needle roller bearing"),
    (r"C[234][0-9]{3}(?!\d)", "toroidal roller bearing"),
    (r"[SW]?(?:6\d{2,4}|16\d{3})(?!\d)", DEEP_GROOVE),
    (r"4[23]\d\d(?!\d)", "double-row deep groove ball bearing"),
    (r"(?:234[47]\d\d|BT[WM]\d+)", "double-direction angular contact thrust ball bearing"),
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
        ``"angular contact ball bearing"``, or another one.
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
    unread : str
        The part that no table knows; from there on angle and balls are None, unless a sign before says them.
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
    unread: str = ""

    def why(self, field: str) -> str:
        """Return maker and sign behind a value, as ``SKF: AC``."""
        whose, sign = self.maker or "all makers", self.symbols.get(field, "")
        return f"{whose}: {sign or 'no symbol'} in {self.text}"


def read_designation(text: str) -> Designation | None:
    """Return what a designation says; None where it is not one that is known.

    Tables of signs and their sources are in ``symbols``. Capitals, blanks and dashes do not matter. ``7010C``
    without a maker has what all makers mean: 15 deg and steel balls.
    """
    folded = re.sub(r"\s+", " ", text.upper()).strip()
    named = _NAMED.match(folded)
    maker = named[1] if named else ""
    body = folded[named.end() :] if named else folded
    for whose, match in _matches(body, maker):
        if whose == "SNFA":
            return _snfa(text, match)
        return _lettered(text, match) if match.re is _LETTERS else _of(text, whose, match)
    other = _other_kind(text)
    return Designation(text, maker, other, "") if other else None


def _matches(body: str, maker: str) -> Iterator[tuple[str, "re.Match[str]"]]:
    """Yield makers and matches of their forms; without a maker those of signs that no other maker writes."""
    closed = re.sub(r"[ _-]", "", body)
    dashed = re.sub(r"[ ._]+", "-", body)
    texts = {"NSK": closed, "NTN": closed, "FAG": dashed}
    if maker in ("", "NSK") and (match := _LETTERS.match(closed)):
        yield "NSK", match
    if maker in ("", "SNFA", "SKF") and (match := _SNFA.match(closed)):
        yield "SNFA", match
    for form, pattern in _FORMS.items():
        whose = form.partition(" ")[0]
        match = pattern.match(texts.get(whose, body))
        if match and (whose == maker or (not maker and _OWN[form](match))):
            yield whose, match
    if match := _PLAIN.match(body):
        yield "", match


def _always(match: "re.Match[str]") -> bool:
    return True


#: Whether a form without its maker has signs that no other maker writes.
_OWN: dict[str, Callable[["re.Match[str]"], object]] = {
    **dict.fromkeys(("SKF", "FAG", "FAG industrial", "GMN", "GMN hybrid", "NTN high speed"), _always),
    "SKF industrial": lambda match: re.match(r".*BE(?:C[ABC]|G[ABC]|[PJMYF])", match[0]),
    "NTN": lambda match: re.match(r"5S|7\d{3}U|7\d{3}(?:AD|C)?T[12]", match[0]),
    "NSK": lambda match: match["angle"] == "A5" or re.match(r"SN24|TYN|TR|EA", match["rest"]),
}


def _other_kind(text: str) -> str:
    """Return the kind of bearing that a designation names beside angular contact ones; empty: none."""
    folded = _folded(text)
    makers = "|".join((*MAKERS, "INA", "KOYO", "TIMKEN", "SNR", "NACHI"))
    return next((kind for form, kind in _OTHERS if re.match(rf"(?:{makers})?(?:{form})", folded)), "")


def _of(text: str, maker: str, match: "re.Match[str]") -> Designation:
    """Return what a form of a maker says; without a maker what all mean."""
    said = match.groupdict()
    prefix, sign, rest = said.get("prefix") or "", match["angle"], match["rest"]
    prefix = prefix.replace(" ", "").replace("2LA", "").strip("-")
    if not maker:
        angle = _AGREED.get(sign)
    else:
        angle = _number(None if sign is None else meaning(maker, "angle", sign, "angle"))
    if maker == "FAG" and "M" in prefix:
        angle = None
    unread = _unread(maker, rest)
    if unread and not sign or rest[:1].isalnum() and rest.startswith(unread or " "):
        angle = None  # the sign may be longer
    balls, whose = _balls(maker, prefix, rest, unread)
    cages = _CAGES.get(maker, ())
    cage = next((one for one in cages if re.search(rf"{one}(?!85|[A-Z]*LU)", rest)), "")
    return Designation(
        text, maker, ANGULAR, match["series"], _bore(match["bore"], bool(said.get("slash"))), angle, balls,
        None if match.re in _INDUSTRIAL else _word(meaning(maker, "suffix", cage, "cage")), _class(rest),
        {"angle": sign or "", "balls": whose}, unread,
    )  # fmt: skip


def _balls(maker: str, prefix: str, rest: str, unread: str) -> tuple[str | None, str]:
    """Return the balls and the sign for them; None where an unknown part may say it."""
    for ceramic in ("SN24", "HC"):
        if meaning(maker, "suffix", ceramic, "balls") == CERAMIC and ceramic in rest.removesuffix(unread):
            return CERAMIC, ceramic
    by_prefix = _word(meaning(maker, "prefix", prefix, "balls"))
    if by_prefix == CERAMIC or not unread:
        return by_prefix or STEEL, prefix
    return None, ""


def _unread(maker: str, rest: str) -> str:
    """Return the suffixes from the first one on that no table of the maker knows."""
    known = SILENT[maker]
    if known.fullmatch(rest):
        return ""
    match = known.match(rest)
    return rest[match.end() if match else 0 :].strip()


def _lettered(text: str, match: "re.Match[str]") -> Designation:
    """Return what NSK's series with letters say."""
    cage = next((one for one in _CAGES["NSK"] if match["rest"].startswith(one)), "")
    return Designation(
        text, "NSK", ANGULAR, match["series"], float(match["bore"]),
        _number(meaning("NSK", "type", match["type"], "angle")),
        _word(meaning("NSK", "type", match["balls"], "balls")), _word(meaning("NSK", "suffix", cage, "cage")),
        _class(match["rest"]), {"angle": match["type"], "balls": match["balls"]},
        _unread("NSK", match["rest"]),
    )  # fmt: skip


def _snfa(text: str, match: "re.Match[str]") -> Designation:
    """Return what SNFA's designations say."""
    balls = (match["balls"] or "").strip("/")
    return Designation(
        text, "SNFA", ANGULAR, match["series"], float(match["bore"]),
        _number(meaning("SNFA", "angle", match["angle"], "angle")),
        _word(meaning("SNFA", "suffix", balls, "balls")),
        _word(meaning("SNFA", "suffix", match["cage"], "cage")), _ABEC[match["grade"]],
        {"angle": match["angle"], "balls": balls}, _unread("SNFA", match["rest"]),
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
    match = _TOLERANCE.search(rest)
    if match is None:
        scale = re.search(r"ABEC ?([579])", rest)
        return None if scale is None else _ABEC[scale[1]]
    by_letter = {"7": "P4", "9": "P2"}
    name = by_letter.get(match[2]) if match[1] == "A" else f"P{match[2]}"
    return {"P3": "P4"}.get(name or "", name) if name in ("P6", "P5", "P4", "P3", "P2") else None


class _Size(NamedTuple):
    """What a size is near by: maker, figures of the series, bore (mm), contact angle (deg) or None."""

    maker: str
    series: str
    bore: float
    angle: float | None


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
        angle = asked.angle is not None and one.angle != asked.angle
        return abs(one.bore - asked.bore), one.series != asked.series, angle, 1.0 - maker

    least = min(map(distance, read))
    nearest = " or ".join(f"'{name}'" for name in [name for name in read if distance(name) == least][:_MOST])
    if least[:3] == (0, 0, 0):
        return f"did you mean {nearest}? "
    way = _by_dimensions(*asked[1:])
    if least[:2] == (0, 0):
        return f"of this size with {asked.angle:g} deg it has none, {nearest} is the nearest, or {way}"
    return f"the nearest in size is {nearest}, or {way}"


def _not_there(wanted: str, known: Sequence[str]) -> str:
    """Say what a designation names that no catalogue has: another series or kind; empty: it may be one."""
    folded = _folded(wanted)
    size = _read(wanted)
    if (size and size.series in ("0", "9")) or any(folded == _folded(name) for name in known):
        return ""
    if size is not None:
        series = getattr(read_designation(wanted), "series", "")
        return f"it is of series {series}, and the catalogue has 70 and 79 (719): {_by_dimensions(*size[1:])}"
    kind = _other_kind(wanted)
    if kind == DEEP_GROOVE:
        return _deep_groove(wanted, known)
    if kind:
        return (
            f"it is a {kind}, which is not modelled: single-row angular contact and deep groove ball "
            "bearings are; "
        )
    return ""


def _deep_groove(wanted: str, known: Sequence[str]) -> str:
    """Say which entry a deep groove bearing may mean, by its figures, or how it is given."""
    of_size = [name for name in known if name.isdigit() and re.search(rf"(?<!\d){name}(?!\d)", wanted)]
    if of_size:
        return f"did you mean '{of_size[0]}', clearance and seals as bearing.clearance and bearing.seal? "
    return (
        "it is a deep groove ball bearing, of which the catalogue has 60, 62 and 63 with bores of 10 to 50 "
        "mm: give another one in a file of your own (`catalogues`); "
    )


def _by_dimensions(series: str, bore: float, contact_angle: float | None) -> str:
    """Say how a bearing is given by its dimensions, with those that its series has."""
    outside, width = boundary(series, bore) or ("D", "B")
    angle = "DEG" if contact_angle is None else f"{contact_angle:g}"
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


def _read(text: str) -> _Size | None:
    """Return the size that a designation names, at least by figures in it; None: it is of no known series."""
    said = read_designation(text)
    if said is not None and said.series in _FIGURES and said.bore is not None:
        return _Size(said.maker, _FIGURES[said.series], said.bore, said.angle)
    folded = _folded(text)
    match = _SIZE.search(folded)
    if match is None:
        return None
    series, digits, angle = match[1][-1], match[2], match[3] or ""
    return _Size(folded[: match.start()], series, _bore(digits, False), _AGREED.get(angle))
