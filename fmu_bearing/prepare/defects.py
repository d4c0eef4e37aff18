"""Tables of the contact over a local defect: what is left of the approach, at places along the track."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.prepare.defect_shapes import Shape

Real = NDArray[np.float64]


class Table(NamedTuple):
    """Effective approach of a ball over a defect, bicubic between nodes; SI units.

    A ball whose middle is at x from the middle of the defect, with the approach delta of the undamaged
    contact, stores U = (2/5) K eta^(5/2), with

        e = delta - touch(x),    eta = e - drop(e, x),    no force where e <= 0 or eta <= 0.

    ``touch`` is a cubic Hermite polynomial between ``places``, ``drop`` a bicubic one between ``places`` and
    ``approaches``. Outside of ``places`` both are zero, with slopes zero at both ends. From the last approach
    on ``drop`` keeps its value: its slope along e is zero there. At e = 0 it is zero.

    Attributes
    ----------
    places : array, shape (n,)
        x, ascending, not evenly spaced (m).
    approaches : array, shape (m,)
        e, in even steps of the root: e_k = e_(m-1) (k/(m-1))^2 (m).
    touch, touch_x : array, shape (n,)
        Approach at which a rigid ball touches first (m); its slope along x.
    drop, drop_x, drop_e, drop_xe : array, shape (n, m)
        Approach that is lost beyond it (m), its slopes along x (1) and e (1) and both (1/m).
    across : float
        Half of the width of the shape across the track, its offset included (m).
    """

    places: Real
    approaches: Real
    touch: Real
    touch_x: Real
    drop: Real
    drop_x: Real
    drop_e: Real
    drop_xe: Real
    across: float


def defect_table(shape: Shape, radius_x: float, radius_y: float, modulus: float) -> Table:
    """Table of a defect under a ball: effective radii along and across rolling (m), E' (Pa)."""
    raise NotImplementedError


def eta(table: Table, delta: float, x: float, scale: float = 1.0) -> tuple[float, float, float]:
    """Effective approach (m) at approach and place (m), with its slopes along both.

    A defect of another scale has s zeta(delta/s, x), zeta = delta - eta: depths grow, lengths do not.
    No force: three zeros.
    """
    if scale <= 0.0 or not table.places[0] < x < table.places[-1]:
        return (delta, 1.0, 0.0) if delta > 0.0 else (0.0, 0.0, 0.0)
    i = int(np.searchsorted(table.places, x, side="right")) - 1
    step = table.places[i + 1] - table.places[i]
    cubic, slope = hermite((x - table.places[i]) / step, step)
    touch = cubic @ _ends(table.touch, table.touch_x, i)
    touch_x = slope @ _ends(table.touch, table.touch_x, i)
    e = delta / scale - touch
    if e <= 0.0:
        return 0.0, 0.0, 0.0
    last = len(table.approaches) - 1
    if e >= table.approaches[last]:
        values = _ends(table.drop[:, last], table.drop_x[:, last], i)
        drop, drop_x, drop_e = cubic @ values, slope @ values, 0.0
    else:
        k = min(int(last * np.sqrt(e / table.approaches[last])), last - 1)
        width = table.approaches[k + 1] - table.approaches[k]
        along, along_e = hermite((e - table.approaches[k]) / width, width)
        # rows: value and slope along x at both places; columns: value and slope along e at both approaches
        block = np.empty((4, 4))
        for j in (0, 1):
            block[:, j] = _ends(table.drop[:, k + j], table.drop_x[:, k + j], i)
            block[:, 2 + j] = _ends(table.drop_e[:, k + j], table.drop_xe[:, k + j], i)
        drop, drop_x, drop_e = cubic @ block @ along, slope @ block @ along, cubic @ block @ along_e
    left = e - drop
    if left <= 0.0:
        return 0.0, 0.0, 0.0
    return scale * left, 1.0 - drop_e, -scale * (touch_x * (1.0 - drop_e) + drop_x)


def hermite(t: float, step: float) -> tuple[Real, Real]:
    """Weights of both values, then of both slopes, at t from 0 to 1 of a step; those of the slope there."""
    value = [(1.0 + 2.0 * t) * (1.0 - t) ** 2, t**2 * (3.0 - 2.0 * t)]
    value += [step * t * (1.0 - t) ** 2, -step * t**2 * (1.0 - t)]
    rate = 6.0 * t * (1.0 - t) / step
    return np.array(value), np.array([-rate, rate, (1.0 - t) * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)])


def _ends(values: Real, slopes: Real, i: int) -> Real:
    """Values, then slopes, at both ends of interval i."""
    return np.array([values[i], values[i + 1], slopes[i], slopes[i + 1]])
