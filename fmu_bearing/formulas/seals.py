"""Friction of the seals of a bearing by SKF's empirical formula. Units mm, N mm.

The torque of two contact seals is K_S1 d_s^beta + K_S2, d_s the diameter on which their lips rub. It depends
neither on speed nor on load nor on grease, and holds for seals that have run in. Source: SKF, general
catalogue (Russian edition), pages 90 and 96, table 4; a transcription of table 3 of the 2013 catalogue has
the same numbers.
"""

from typing import Literal, NamedTuple

#: Seals of the table that single rows of balls have: RZ does not touch, RSL hardly, RSH and RS1 do.
Kind = Literal["RZ", "RSL", "RSH", "RS1"]
KINDS: tuple[Kind, ...] = ("RZ", "RSL", "RSH", "RS1")
#: Seals whose lips rub with a force that limits their speed.
RUBBING = ("RSH", "RS1")
#: m/s at the lip, and the largest: SKF's limit for another seal of the same rubber (ICOS, catalogue page
#: 294). The limiting speeds that SKF prints for sixteen bearings with RSH and RS1 (pages 330 to 334) are 13.2
#: to 16.0 m/s there.
LIP_SPEED, MOST_LIP_SPEED = 14.0, 16.0
# (d_s - d)/(D - d): means of the d_2 that SKF prints for eleven bearings with RSH, 6002 to 6304 (0.206 to
# 0.252), of the d_1 for nine with RS1, 6006 to 63005 (0.314 to 0.348; those of thin series rub on d_2), and
# of the d_1 for eleven open angular contact bearings, 7200 B to 7305 B (0.385 to 0.416)
_RECESS, _SHOULDER, _HIGH_SHOULDER = 0.23, 0.33, 0.40


class Row(NamedTuple):
    """A row of the table: for outside diameters above ``over`` up to ``to``."""

    over: float
    to: float
    exponent: float
    factor: float
    """K_S1."""
    constant: float
    """K_S2, N mm."""
    inside: float
    """Where the lip is, where its diameter is not given."""
    whole: bool = False
    """Whether one seal counts as two."""


_ANY = float("inf")
_DEEP_GROOVE: dict[Kind, tuple[Row, ...]] = {
    "RZ": (Row(0.0, 175.0, 0.0, 0.0, 0.0, _RECESS),),
    "RSL": (
        Row(0.0, 25.0, 0.0, 0.0, 0.0, _RECESS),
        Row(25.0, 52.0, 2.25, 0.0018, 0.0, _RECESS, whole=True),
    ),
    "RSH": (Row(0.0, 52.0, 2.25, 0.028, 2.0, _RECESS),),
    "RS1": (
        Row(0.0, 62.0, 2.25, 0.023, 2.0, _SHOULDER),
        Row(62.0, 80.0, 2.25, 0.018, 20.0, _SHOULDER),
        Row(80.0, 100.0, 2.25, 0.018, 15.0, _SHOULDER),
        Row(100.0, _ANY, 2.25, 0.018, 0.0, _SHOULDER),
    ),
}
# RZ has no row for them; a seal that does not touch has no torque in any bearing
_ANGULAR: dict[Kind, tuple[Row, ...]] = {
    "RZ": (Row(0.0, _ANY, 0.0, 0.0, 0.0, _HIGH_SHOULDER),),
    "RS1": (Row(30.0, 120.0, 2.0, 0.014, 10.0, _HIGH_SHOULDER),),
}


def rows(kind: Kind, deep_groove: bool) -> tuple[Row, ...]:
    """Return the rows of a seal in deep groove or in angular contact bearings; empty: none is printed."""
    return (_DEEP_GROOVE if deep_groove else _ANGULAR).get(kind, ())


def row(kind: Kind, deep_groove: bool, outside: float) -> Row | None:
    """Return the row for an outside diameter (mm); None where none is printed."""
    return next((one for one in rows(kind, deep_groove) if one.over < outside <= one.to), None)


def lip_diameter(one: Row, bore: float, outside: float) -> float:
    """Return the diameter (mm) on which the lips rub where it is not given: assumed."""
    return bore + one.inside * (outside - bore)


def torque(one: Row, lip: float, sides: int) -> float:
    """Return the torque (N mm) of one seal or two, ``sides``, on a diameter ``lip`` (mm)."""
    both = one.factor * lip**one.exponent + one.constant
    return both if sides == 2 or one.whole else 0.5 * both
