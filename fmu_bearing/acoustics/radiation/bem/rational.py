"""Rational functions of frequency through solved ones, and the choice of the frequencies to solve.

Pressures on and around bodies are analytic functions of frequency, with poles where air in gaps resonates.
All quantities of one circumferential order share these poles and one barycentric denominator:

    r(f) = sum of w_j F_j / (f - f_j) over sum of w_j / (f - f_j),  r(f_j) = F_j.

Source: Nakatsukasa, Sete and Trefethen (2018) for this form, its weights from the least singular vector of a
Loewner matrix and the greedy choice of the f_j; Lietaert, Meerbergen, Perez and Vandereycken (2022) for one
set of weights for many functions. SciPy's ``AAA`` takes one function at a time.
"""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

#: Largest error of a prediction, over the size of what is predicted, where fits are most uncertain, and at
#: frequencies drawn at random: -40 dB. What is predicted is then solved, which makes the rest better still.
TOLERANCE, TYPICAL = 2.5e-2, 1e-2
_FLOOR = 0.2  # of its largest size in the band: what is smaller is measured by this,
_COMPACT = 6000.0  # Hz: and below by less, by the square of frequency, as compact bodies' sound falls
SILENT = 5e-3  # of the loudest drive of its family, in the place of its own largest size
_RESIDUAL = 0.05  # of the tolerance: fits that are closer to frequencies not their own follow rounding
_HELD = 2  # frequencies at least that determine weights
_CANDIDATES = 400  # frequencies at which fits are compared
FIRST = 8  # frequencies solved before the first fit
AT_ONCE = 2  # frequencies solved at a time afterwards
_BETTER = 6.0  # times, as measured, that predictions become by two more frequencies
_IN_A_ROW = 3  # predictions within the tolerance that end the search
_CHECKS = 2  # frequencies, drawn at random, that are predicted in the end
_SHARPEST = 300.0  # quality factor of a pole: walls and radiation damp all real ones more


def barycentric(wanted: Real, supports: Real, weights: Complex) -> Complex:
    """Return factors (wanted, supports) of the values at the supports; the sum of each row is 1."""
    offset = wanted[:, None] - supports
    met = offset == 0.0
    terms = weights / np.where(met, 1.0, offset)
    factors = terms / terms.sum(axis=1, keepdims=True)
    factors[met.any(axis=1)] = 0.0
    factors[met] = 1.0
    return factors


def poles(supports: Real, weights: Complex) -> Complex:
    """Poles (Hz), zeros of the denominator, as eigenvalues; one more is 0."""
    matrix = np.diag(supports).astype(complex)
    matrix -= weights * supports / weights.sum()
    roots: Complex = np.linalg.eigvals(matrix)
    return roots


class Group:
    """Quantities that share their poles, solved at some frequencies, and two fits of them.

    Values have the shape (frequencies, drives, parts, quantities): quantities of one size are a part,
    whose errors are seen for themselves. The last fit has the supports that it needs, the one before has
    one less: where they differ, frequencies are missing.
    """

    def __init__(self) -> None:
        self._order: list[float] = []  # supports as they were taken
        self._barred: set[float] = set()  # frequencies that are none, as a pole would be beside them

    def renew(self, frequencies: Real, values: Complex, silent: Real | float = 0.0) -> None:
        """Fit again; supports stay, and one is added where the fit is worst until its residual is small.

        ``silent``: sizes (parts,) below which errors do not count.
        """
        self._largest = np.linalg.norm(values, axis=-1).max(axis=0)
        self._silent = silent
        self._frequencies, self._values = frequencies, values
        sizes = self._sizes(frequencies, values)
        self._scaled = sizes[..., None]
        places = [int(np.searchsorted(frequencies, f)) for f in self._order] or [0, len(frequencies) - 1]
        self._fits = [self._fit(places)]
        while len(places) < len(frequencies) - _HELD:
            wrong = _wrong(self.predicted(frequencies), values, sizes)
            wrong[places] = wrong[[f in self._barred for f in frequencies]] = 0.0
            if wrong.max() < _RESIDUAL * TOLERANCE:
                break
            places.append(int(wrong.argmax()))
            self._fits = [self._fits[-1], self._fit(places)]
        if len(self._fits) == 1:
            self._fits.insert(0, self._fit(places[:-1]))
        self._order = frequencies[places].tolist()

    def _fit(self, places: list[int]) -> tuple[list[int], Complex]:
        """Places and weights of supports; the frequencies that are none are met in least squares."""
        rest = np.delete(np.arange(len(self._frequencies)), places)
        slopes = self._values[rest][:, None] - self._values[places]
        slopes /= (self._frequencies[rest][:, None] - self._frequencies[places])[..., None, None, None]
        slopes /= self._scaled[rest][:, None]
        loewner = np.moveaxis(slopes, 1, -1).reshape(-1, len(places))
        if len(loewner) > len(places):
            loewner = np.asarray(np.linalg.qr(loewner, mode="r"))
        return list(places), np.linalg.svd(loewner)[2][-1].conj()

    def _sizes(self, at: Real, values: Complex) -> Real:
        """Sizes of values at frequencies (Hz) that their errors are measured by."""
        falling = np.minimum(at / _COMPACT, 1.0)[:, None, None] ** 2
        floor = falling * np.maximum(_FLOOR * self._largest, self._silent) + 1e-300
        return np.maximum(np.linalg.norm(values, axis=-1), floor)

    def predicted(self, wanted: Real, before: bool = False) -> Complex:
        """Return values of a fit at frequencies (Hz)."""
        places, weights = self._fits[0 if before else -1]
        factors = barycentric(wanted, self._frequencies[places], weights)
        return np.tensordot(factors, self._values[places], axes=1)

    def uncertainty(self, wanted: Real) -> Real:
        """Difference of both fits at frequencies (Hz), over the size of what is fitted."""
        values = self.predicted(wanted)
        return _wrong(self.predicted(wanted, before=True), values, self._sizes(wanted, values))

    def missed(self, at: Real, values: Complex) -> Real:
        """Error of the prediction at frequencies (Hz) whose values are known by now, over their size."""
        return _wrong(self.predicted(at), values, self._sizes(at, values))

    def sharp(self, low: float, high: float) -> list[float]:
        """Frequencies (Hz) between two of poles that are sharper than any resonance of air.

        Where one is beside a support, its rounding is what the pole follows: the support is given up. The
        others are returned.
        """
        while True:
            places, weights = self._fits[1]
            supports = self._frequencies[places]
            roots = poles(supports, weights)
            width = 2.0 * np.abs(roots.imag)
            sharp = roots.real[(roots.real > _SHARPEST * width) & (low < roots.real) & (roots.real < high)]
            nearest = [int(np.abs(supports - f).argmin()) for f in sharp]
            beside = {k for k, f in zip(nearest, sharp, strict=True) if abs(supports[k] - f) < f / _SHARPEST}
            if not beside or len(beside) > len(places) - 2:
                return sharp.tolist()
            self._barred |= {supports[k] for k in beside}
            self._order = [f for f in self._order if f not in self._barred]
            kept = [place for k, place in enumerate(places) if k not in beside]
            self._fits = [self._fits[0], self._fit(kept)]


def _wrong(predicted: Complex, values: Complex, sizes: Real) -> Real:
    """Largest error of any drive and part at each frequency, over its size (frequencies, drives, parts)."""
    return np.max(np.linalg.norm(predicted - values, axis=-1) / sizes, axis=(1, 2))


#: Solves at frequencies (Hz) and returns the values of each group (`Group`).
Measure = Callable[[Real], list[Complex]]
#: Takes the least number of frequencies that are still to be solved, and whether it will be that one.
Left = Callable[[float, bool], None]


def search(
    measure: Measure,
    low: float,
    high: float,
    most: int,
    family: Sequence[int] = (),
    left: Left = lambda least, certain: None,
) -> Real | None:
    """Solve from ``low`` to ``high`` (Hz) where fits are uncertain, until predictions are right.

    Two frequencies are solved at a time, on any machine, so that the result does not depend on it.
    ``family`` numbers groups whose drives act together: errors far below the loudest of them do not count. By
    default each group is one.

    Returns
    -------
    The frequencies, rising; None where ``most`` do not do.
    """
    draw = np.random.default_rng(int(high))
    candidates = np.linspace(low**0.5, high**0.5, _CANDIDATES)[1:-1] ** 2
    solved = np.linspace(low**0.5, high**0.5, FIRST) ** 2
    solved[[0, -1]] = low, high
    values = measure(solved)
    groups = [Group() for _ in values]
    right, wrong, checked = 0, np.inf, False
    # Sharp poles at which the prediction was right: their residue is of the size of rounding, and each fit
    # has one again, a little beside (d 300 x 60 mm: 47 times between 5,999 and 6,000 Hz).
    harmless: list[float] = []
    while len(solved) < most and not checked:
        renew(groups, solved, values, family)
        sharp = [f for group in groups for f in group.sharp(low, high)] if right >= _IN_A_ROW else []
        sharp = [f for f in sharp if all(abs(f - other) > f / _SHARPEST for other in harmless)]
        last = right >= _IN_A_ROW and not sharp
        if wrong < np.inf:
            left(_left(wrong, right) + len(sharp), last)
        if last:
            due = draw.uniform(low, high, _CHECKS)
        else:
            due = np.array(sharp[:1]) if sharp else _uncertain(groups, solved, candidates)
        due = np.setdiff1d(due, solved)
        if not len(due):  # a pole that stays where it was solved
            return None
        fresh = measure(due)
        wrong = float(max(group.missed(due, known).max() for group, known in zip(groups, fresh, strict=True)))
        checked = last and wrong < TYPICAL
        right = right + len(due) if wrong < TOLERANCE else 0
        harmless += sharp[:1] if right else []
        order = np.argsort(np.concatenate([solved, due]))
        solved = np.concatenate([solved, due])[order]
        values = [np.concatenate([value, two])[order] for value, two in zip(values, fresh, strict=True)]
    if not checked:
        return None
    left(0.0, True)
    return solved


def renew(
    groups: list[Group],
    solved: Real,
    values: list[Complex],
    family: Sequence[int],
    share: Real | float = SILENT,
) -> None:
    """Fit all groups again; ``family``: as in `search`, ``share`` of its loudest that counts (parts,)."""
    largest = np.array([np.linalg.norm(known, axis=-1).max(axis=(0, 1)) for known in values])
    number = np.array(family or range(len(groups)))
    for group, known, own in zip(groups, values, number, strict=True):
        group.renew(solved, known, share * largest[number == own].max(axis=0))


def _left(wrong: float, right: int) -> float:
    """Least number of frequencies until the end, from the last error and the right predictions in a row."""
    if right:
        return max(_IN_A_ROW - right, 0) + _CHECKS
    return _IN_A_ROW + _CHECKS + 2.0 * np.log(max(wrong / TOLERANCE, 1.0)) / np.log(_BETTER)


def _uncertain(groups: list[Group], solved: Real, candidates: Real) -> Real:
    """Return two frequencies: the most uncertain one, and that of another gap or the widest gap's middle."""
    doubt = np.max([group.uncertainty(candidates) for group in groups], axis=0)
    doubt[np.isin(candidates, solved)] = 0.0
    first = int(doubt.argmax())
    gap = np.searchsorted(solved, candidates)
    doubt[gap == gap[first]] = 0.0
    second = int(doubt.argmax())
    if doubt[second] > TOLERANCE:
        return np.sort(candidates[[first, second]])
    widths = np.diff(solved)
    widths[gap[first] - 1] = 0.0
    widest = int(widths.argmax())
    return np.sort([candidates[first], 0.5 * (solved[widest] + solved[widest + 1])])
