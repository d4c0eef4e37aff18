"""Where a line of motion comes from: its order, the surface that makes it, and the bearing it belongs to.

Orders count in turns of the shaft. A bearing with Z balls and rigid rings makes (Wardle 1988):

==================  ====================================================================================
order               what makes it
==================  ====================================================================================
whole               what turns with the shaft: unbalance, order 1 of the inner race
k f_i + m f_r       waves of the inner race, orders k Z + m: m = 0 axial, m = +-1 radial and tilt
k f_o + m f_r       waves of the outer race, orders near k Z; unequal loads make m f_r
n f_c               balls of unequal size, an unbalanced cage
q f_b, q f_b +- f_c  form of the balls: axial, and radial with tilt
==================  ====================================================================================

k f_o alone is also what balls make that pass the place of a radial load (varying compliance).
"""

from collections.abc import Iterator
from dataclasses import dataclass

from fmu_bearing.acoustics.analysis.lines import combination
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies

#: Sources, in the words of tables.
SHAFT, INNER, OUTER = "shaft", "inner race", "outer race"
BALL_SIZES, BALL_FORM = "ball sizes, cage", "ball form"
SOURCES = (SHAFT, INNER, OUTER, BALL_SIZES, BALL_FORM)
_SIDEBANDS = 2  # by f_r, to either side: unequal loads and tilts make no more that is seen
_BALL_SIDEBANDS = 1  # by f_c, of rigid rings


@dataclass(frozen=True)
class Origin:
    """A line that rolling makes, and what makes it.

    Attributes
    ----------
    name : str
        As in spectra: ``2 f_i - f_r``.
    source : str
        One of `SOURCES`.
    bearing : int
        From 1, of a set from the nose on; 0: the shaft's.
    order : float
        Frequency over the shaft's.
    terms : int
        How many frequencies are added up: 3 for ``2 f_i - f_r``. The line with fewer explains better.
    wave : int
        Order of the wave that makes it: of the inner race k Z + m in a line k f_i + m f_r, of the outer race
        k Z, for all waves near it, of a ball q; 0: no wave does.
    beside : int
        How many times the sideband is taken, m: 0 in a line without.
    """

    name: str
    source: str
    bearing: int
    order: float
    terms: int
    wave: int = 0
    beside: int = 0

    @property
    def off_whole(self) -> float:
        """Distance from the nearest whole order."""
        return abs(self.order - round(self.order))


def shaft_origins(highest: float) -> list[Origin]:
    """Return the whole orders up to ``highest``."""
    return [Origin(combination(n, "f_r"), SHAFT, 0, float(n), n) for n in range(1, int(highest) + 1)]


def bearing_origins(
    frequencies: KinematicFrequencies, highest: float, bearing: int = 1, sidebands: int = _SIDEBANDS,
    ball_sidebands: int = _BALL_SIDEBANDS,
) -> list[Origin]:  # fmt: skip
    """Return the lines of one bearing up to the order ``highest``, by order.

    Parameters
    ----------
    frequencies : KinematicFrequencies
        At any speed but 0, of rolling or measured: their ratios to f_r count.
    highest : float
        Order, in turns of the shaft.
    bearing : int
        Its number.
    sidebands : int
        Multiples of f_r to either side of those of f_i and f_o. A ring that bends in n lobes has n.
    ball_sidebands : int
        Multiples of f_c to either side of those of f_b, in the same way.

    Raises
    ------
    ValueError
        Where the shaft does not turn.
    """
    if not frequencies.f_r > 0.0:
        raise ValueError(f"f_r = {frequencies.f_r:g} Hz: orders need a shaft that turns")
    candidates = (
        Origin(
            combination(n, carrier, m, modulator), source, bearing,
            (n * getattr(frequencies, carrier) + m * getattr(frequencies, modulator)) / frequencies.f_r,
            n + abs(m), _wave(carrier, n, m, round(frequencies.f_o / frequencies.f_c)), m,
        )
        for carrier, modulator, source, n, m in _combinations(frequencies, highest, sidebands, ball_sidebands)
    )  # fmt: skip
    return sorted((one for one in candidates if 0.0 < one.order <= highest), key=lambda one: one.order)


def _wave(carrier: str, n: int, m: int, balls: int) -> int:
    """Return the order of the wave behind n times a carrier and m times its sideband."""
    return {"f_i": n * balls + m, "f_o": n * balls, "f_b": n}.get(carrier, 0)


def _combinations(
    frequencies: KinematicFrequencies, highest: float, sidebands: int, ball_sidebands: int
) -> Iterator[tuple[str, str, str, int, int]]:
    """Yield carrier, modulator, source, and how many times each is taken."""
    top = highest * frequencies.f_r

    def times(base: float, beside: float) -> range:
        return range(1, int((top + beside) / base) + 1)

    beside = sidebands * frequencies.f_r
    for carrier, source in (("f_i", INNER), ("f_o", OUTER)):
        for n in times(getattr(frequencies, carrier), beside):
            yield from ((carrier, "f_r", source, n, m) for m in range(-sidebands, sidebands + 1))
    balls = round(frequencies.f_o / frequencies.f_c)
    # balls times f_c is f_o, and what follows repeats its sidebands
    yield from (("f_c", "f_r", BALL_SIZES, n, 0) for n in times(frequencies.f_c, 0.0) if n < balls)
    for n in times(frequencies.f_b, ball_sidebands * frequencies.f_c):
        yield from (("f_b", "f_c", BALL_FORM, n, m) for m in range(-ball_sidebands, ball_sidebands + 1))
