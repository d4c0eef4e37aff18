"""What the symbols in makers' designations of angular contact ball bearings mean, with their sources.

Only what the package uses: contact angle, balls, cage and tolerance class. A symbol that two prints of a
maker explain differently is left out: what it means is asked for. `SILENT` has the suffixes that say nothing
of contact angle and balls.
"""

import re
from typing import NamedTuple

#: Where the symbols of a maker are printed.
SOURCES = {
    "NSK": "NSK, Super Precision Bearings, CAT. No. E1254, numbering system, and Rolling Bearings, E1102",
    "SKF": "SKF, Super-precision bearings, 13383, High-precision bearings, 6002, and Rolling bearings, "
    "10000, designation systems",
    "FAG": "FAG, Super Precision Bearings, AC 41 130, bearing code, and Rolling Bearings, HR 1, suffixes",
    "NTN": "NTN, Precision Rolling Bearings, CAT. No. 2260, bearing designations",
    "GMN": "GMN, High precision ball bearings, 4000, bearing designation",
    "SNFA": "SNFA, General catalogue, bearing codes, and SKF, Super-precision bearings, SNFA names",
}
STEEL, CERAMIC = "steel", "Si3N4"
PHENOLIC, POLYAMIDE, PEEK, BRASS = "phenolic", "polyamide", "PEEK", "brass"


class Symbol(NamedTuple):
    """A symbol of a maker: where it is, and what it means.

    Attributes
    ----------
    maker : str
    where : str
        ``prefix``, ``angle`` (behind the bore), ``suffix``, or ``type`` of series named by letters.
    text : str
        Empty: no symbol there.
    field : str
        ``angle`` (deg), ``balls``, ``cage`` or ``tolerance``.
    value : str or float
    """

    maker: str
    where: str
    text: str
    field: str
    value: str | float


def _rows(maker: str, where: str, field: str, meanings: dict[str, str | float]) -> tuple[Symbol, ...]:
    return tuple(Symbol(maker, where, text, field, value) for text, value in meanings.items())


SYMBOLS: tuple[Symbol, ...] = (
    *_rows("NSK", "angle", "angle", {"": 30.0, "C": 15.0, "AC": 25.0, "A5": 25.0, "A": 30.0, "B": 40.0}),
    *_rows("NSK", "type", "angle", {"BGR": 15.0, "BNR": 18.0, "BER": 25.0, "BAR": 30.0, "BTR": 40.0}),
    *_rows("NSK", "suffix", "balls", {"": STEEL, "SN24": CERAMIC}),
    *_rows("NSK", "type", "balls", {"S": STEEL, "H": CERAMIC, "X": CERAMIC}),
    *_rows("NSK", "suffix", "cage", {"TYN": POLYAMIDE, "TR": PHENOLIC, "T": PHENOLIC}),
    *_rows("SKF", "angle", "angle", {"C": 15.0, "F": 18.0, "AC": 25.0, "A": 30.0, "B": 40.0}),
    *_rows("SKF", "prefix", "balls", {"": STEEL, "S": STEEL, "V": CERAMIC, "SV": CERAMIC}),
    *_rows("SKF", "suffix", "balls", {"HC": CERAMIC}),
    *_rows("SKF", "suffix", "cage", {"": PHENOLIC, "TNHA": PEEK, "MA": BRASS}),
    *_rows("FAG", "angle", "angle", {"C": 15.0, "D": 20.0, "E": 25.0, "B": 40.0}),
    *_rows("FAG", "prefix", "balls", {
        "": STEEL, "B": STEEL, "HCB": CERAMIC, "XCB": CERAMIC, "HS": STEEL, "HC": CERAMIC, "XC": CERAMIC,
        "RS": STEEL, "HCRS": CERAMIC, "XCRS": CERAMIC, "HSS": STEEL, "HCS": CERAMIC, "XCS": CERAMIC,
        "M": STEEL, "HCM": CERAMIC, "XCM": CERAMIC,
    }),
    *_rows("FAG", "suffix", "cage", {"T": PHENOLIC, "TPA": PHENOLIC}),
    *_rows("NTN", "angle", "angle", {"": 30.0, "C": 15.0, "AD": 25.0, "B": 40.0}),
    *_rows("NTN", "prefix", "balls", {"": STEEL, "5S": CERAMIC}),
    *_rows("NTN", "suffix", "cage", {"T1": PHENOLIC, "T2": POLYAMIDE}),
    *_rows("GMN", "angle", "angle", {"C": 15.0, "E": 25.0}),
    *_rows("GMN", "prefix", "balls", {
        "S": STEEL, "SM": STEEL, "KH": STEEL, "HYS": CERAMIC, "HYSM": CERAMIC, "HYKH": CERAMIC,
    }),
    *_rows("GMN", "suffix", "cage", {"TA": PHENOLIC, "TB": PHENOLIC}),
    *_rows("SNFA", "angle", "angle", {"0": 12.0, "1": 15.0, "2": 18.0, "3": 25.0}),
    *_rows("SNFA", "suffix", "balls", {"": STEEL, "NS": CERAMIC}),
    *_rows("SNFA", "suffix", "cage", {"CE": PHENOLIC}),
)  # fmt: skip

_ORDER = r"[DTQP]?(?:B|F|T|U|G|BC|FC|BT|FT|BB|FF|BD|FD|TT|UD|TBT|TFT)"  # of a set, or for any set
#: Suffixes of cage, class, set, preload, seal and grease; empty: those on which makers agree.
SILENT = {
    maker: re.compile(rf"(?:[\s/.+_-]|{one})*")
    for maker, one in {
        "": r"D[BFT]|P[2-6]",
        "NSK": rf"TYN|TR|T85|T|W|MR|M|EA|SN24|V1V|SUN?|{_ORDER}|D|EL|L|H|C[PNABE]\d*|G[ABN]|P[2-6]Y?"
        r"|K[L\d]\d*",
        "SKF": rf"TNHA|HC|PA?[24579]A?|SP|UP|{_ORDER}[A-D]?|C[ABC]|G\d*[A-D]?|PH|PHAS|P|J|M[AB]?|Y|F|2RZ|S"
        r"|L1?|H1?|N[12]?|W\d+|VJ\d+|GMM|GXN|VT\d+",
        "FAG": rf"TPA|TVP|TVH|T|MP|JP|XL|2RSD|2RS|2Z|P4S|P[2456]|[DTQ]?U[LMHAOB]|UO|{_ORDER}|K5|L\d+|GA\d*",
        "NTN": rf"T[12]|LLB|{_ORDER}|D2|G[LNMH]?|P[2456]2?|L\d+|Q\d+|\d",
        "GMN": rf"TA|TB|P[24]|ABEC ?[79]|A[79]|HG|UP|{_ORDER}|[DTQ]?U?[LMSX]|2RZ",
        "SNFA": rf"{_ORDER}|[LMF]|\d+|DAN",
    }.items()
}


def meaning(maker: str, where: str, text: str, field: str) -> str | float | None:
    """Return what a symbol means; None where the maker has none such."""
    return next((one.value for one in SYMBOLS if one[:4] == (maker, where, text, field)), None)
