"""Tolerances of bearings and their seats: ISO 492 (classes P5, P4, P2) and ISO 286, 6 to 250 mm.

Diameters in mm, deviations and interference in um of the *diameter*; interference is positive where tight.

Neither standard was read. The tables are those that others print:

* P5, P4, P2: GOST 520-2011, tables 5 to 8, 11 and 12, which follow ISO 492:2002. NODES Bearing (P5,
  nodeshk.com), manv.in (P4) and Loyal (P2, loyal.sg) print the same.
* IT3 to IT6: Big Daishowa's catalogue, page 139 (shafts h3 to h6, catalog.bigdaishowa.com); TPI's catalogue
  2202/TE, table 5.3, has the same to 180 mm.
* g, k, m: Sumitomo's page on JIS B 0401 (1999), shafts g5, k5, m5 (docs.steelcam.org); mechguru.com beyond
  80 mm.
* K, M of holes: the shaft's deviation with the other sign, plus IT of the grade less IT of the next finer
  one. The rule gives all K5, K6, M5, M6 of germany-bearing.com (articles s67, s70); no print of K4, M4 was
  found.
"""

import bisect
import math
import re

#: Which interference of a pair of tolerance zones is taken.
TAKES = ("min", "probable min", "mean", "probable max", "max")
_SHARES = dict(zip(TAKES, (-1.0, -1.0, 0.0, 1.0, 1.0), strict=True))
Limits = tuple[float, float]

#: Steps of size: each reaches to its diameter (mm), included.
_ENDS = (10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 150.0, 180.0, 250.0)
_LEAST = 6.0  # mm, excluded
#: ISO 492, um: lower limit of the mean bore, and of the mean outside diameter; the upper one is 0.
_BORES = {
    "P5": (-5.0, -5.0, -6.0, -8.0, -9.0, -10.0, -13.0, -13.0, -15.0),
    "P4": (-4.0, -4.0, -5.0, -6.0, -7.0, -8.0, -10.0, -10.0, -12.0),
    "P2": (-2.5, -2.5, -2.5, -2.5, -4.0, -5.0, -7.0, -7.0, -8.0),
}
_OUTSIDES = {
    "P5": (-5.0, -5.0, -6.0, -7.0, -9.0, -10.0, -11.0, -13.0, -15.0),
    "P4": (-4.0, -4.0, -5.0, -6.0, -7.0, -8.0, -9.0, -10.0, -11.0),
    "P2": (-2.5, -2.5, -4.0, -4.0, -4.0, -5.0, -5.0, -7.0, -8.0),
}
#: ISO 286, um: standard tolerances, and the limit next to the drawn size: the upper one of g and h, the
#: lower one of k and m.
_GRADES = {
    3: (2.5, 3.0, 4.0, 4.0, 5.0, 6.0, 8.0, 8.0, 10.0),
    4: (4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 12.0, 14.0),
    5: (6.0, 8.0, 9.0, 11.0, 13.0, 15.0, 18.0, 18.0, 20.0),
    6: (9.0, 11.0, 13.0, 16.0, 19.0, 22.0, 25.0, 25.0, 29.0),
}
_DEVIATIONS = {
    "g": (-5.0, -6.0, -7.0, -9.0, -10.0, -12.0, -14.0, -14.0, -15.0),
    "h": (0.0,) * len(_ENDS),
    "k": (1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 4.0),
    "m": (6.0, 7.0, 8.0, 9.0, 11.0, 13.0, 15.0, 15.0, 17.0),
}
#: Names of the classes that are known.
BEARING_CLASSES = tuple(_BORES)
SHAFT_CLASSES = tuple(f"{letter}{grade}" for letter in ("g", "h", "js", "k", "m") for grade in (4, 5, 6))
HOUSING_CLASSES = tuple(f"{letter}{grade}" for letter in ("H", "JS", "K", "M") for grade in (4, 5, 6))


class ToleranceError(ValueError):
    """A class or a size that no table has; the message names it, what is allowed, and the way out."""


def bore_limits(bore_mm: float, bearing_class: str) -> Limits:
    """Return the least and largest deviation of a bearing's mean bore (um).

    Parameters
    ----------
    bore_mm : float
        More than 6, up to 250 mm.
    bearing_class : str
        One of :data:`BEARING_CLASSES`.

    Raises
    ------
    ToleranceError
        For another class or size, as all functions of this module.
    """
    _known("bearing_class", bearing_class, BEARING_CLASSES)
    return _BORES[bearing_class][_step("bore", bore_mm)], 0.0


def outside_limits(outside_mm: float, bearing_class: str) -> Limits:
    """Return the least and largest deviation of a bearing's mean outside diameter (um).

    Parameters
    ----------
    outside_mm : float
        More than 6, up to 250 mm.
    bearing_class : str
        One of :data:`BEARING_CLASSES`.
    """
    _known("bearing_class", bearing_class, BEARING_CLASSES)
    return _OUTSIDES[bearing_class][_step("outside diameter", outside_mm)], 0.0


def shaft_limits(diameter_mm: float, shaft_class: str) -> Limits:
    """Return the least and largest deviation of a shaft's diameter (um).

    Parameters
    ----------
    diameter_mm : float
        More than 6, up to 250 mm.
    shaft_class : str
        One of :data:`SHAFT_CLASSES`.
    """
    _known("shaft_class", shaft_class, SHAFT_CLASSES)
    letter, grade = _parts(shaft_class)
    place = _step("shaft", diameter_mm)
    width = _GRADES[grade][place]
    if letter == "js":
        return -0.5 * width, 0.5 * width
    near = _DEVIATIONS[letter][place]
    return (near - width, near) if letter in "gh" else (near, near + width)


def housing_limits(diameter_mm: float, housing_class: str) -> Limits:
    """Return the least and largest deviation of a housing's bore (um).

    Parameters
    ----------
    diameter_mm : float
        More than 6, up to 250 mm.
    housing_class : str
        One of :data:`HOUSING_CLASSES`.
    """
    _known("housing_class", housing_class, HOUSING_CLASSES)
    letter, grade = _parts(housing_class)
    place = _step("housing", diameter_mm)
    width = _GRADES[grade][place]
    if letter == "JS":
        return -0.5 * width, 0.5 * width
    if letter == "H":
        return 0.0, width
    high = -_DEVIATIONS[letter.lower()][place] + width - _GRADES[grade - 1][place]
    return high - width, high


def interference(part_limits: Limits, bearing_limits: Limits, take: str, housing: bool = False) -> float:
    """Return the interference of a seat on diameter (um, + tight).

    Parameters
    ----------
    part_limits : tuple of float
        Deviations of the shaft or the housing (um), as `shaft_limits` and `housing_limits` give them.
    bearing_limits : tuple of float
        Deviations of the bore or the outside diameter (um).
    take : str
        One of :data:`TAKES`. Probable: both limits of a part count as 3 standard deviations from its middle,
        and both parts add up as the root of the sum of squares.
    housing : bool
        The part holds the bearing from outside: its bore is larger where the fit is looser.

    Raises
    ------
    ToleranceError
        For another take.
    """
    if take not in TAKES:
        raise ToleranceError(f"take = {take!r} is not known; give one of {', '.join(TAKES)}")
    middles = [0.5 * (low + high) for low, high in (part_limits, bearing_limits)]
    halves = [0.5 * (high - low) for low, high in (part_limits, bearing_limits)]
    mean = (middles[0] - middles[1]) * (-1.0 if housing else 1.0)
    spread = math.hypot(*halves) if take.startswith("probable") else sum(halves)
    return mean + _SHARES[take] * spread


def _known(key: str, name: str, names: tuple[str, ...]) -> None:
    if name not in names:
        raise ToleranceError(f"{key} = {name!r} is not known: {', '.join(names)}; or give interference_um")


def _parts(name: str) -> tuple[str, int]:
    """Letter and grade of a class."""
    match = re.fullmatch(r"([A-Za-z]+)(\d+)", name)
    assert match is not None
    return match[1], int(match[2])


def _step(what: str, diameter: float) -> int:
    """Place of a diameter (mm) among the steps of size."""
    if not _LEAST < diameter <= _ENDS[-1]:
        allowed = f"more than {_LEAST:g}, up to {_ENDS[-1]:g} mm"
        raise ToleranceError(
            f"{what} of {diameter:g} mm: tolerances are known for {allowed}; give interference_um"
        )
    return bisect.bisect_left(_ENDS, diameter)
