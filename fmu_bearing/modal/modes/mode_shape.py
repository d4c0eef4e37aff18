"""How rings and balls move in a mode: places as complex amplitudes."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P, Q
from fmu_bearing.modal.equations.bearing import BearingLinearised
from fmu_bearing.modal.equations.coordinates import Coordinates

_BALL_PLACES = 3  # x, r, theta


class Bend(NamedTuple):
    """Bending of a ring in one order: amplitudes of cos n theta and sin n theta, and what they move."""

    ring: int  # 0 inner, 1 outer
    order: int
    cosine: complex
    sine: complex
    x: float  # of the groove, per unit
    r: float
    theta: float


@dataclass(frozen=True)
class Shape:
    """Places of a mode, complex, the largest of them 1; times e^(i w t) the real parts are the motion.

    Attributes
    ----------
    inner, outer : ndarray, shape (6,)
        x, turn about x, y, z, tilts about y and z of a ring; angles times the pitch radius. The turn of the
        inner ring is an input, so it is 0.
    bends : tuple of Bend
        One per order in which a ring bends.
    patterns : ndarray, shape (3, balls)
        Places x, r and along the orbit of the balls by their patterns 1, cos theta, sin theta, cos 2 theta...
    orbit, shaft : float
        Turns of the orbit and of the shaft per period of the mode.
    """

    inner: NDArray[np.complex128]
    outer: NDArray[np.complex128]
    bends: tuple[Bend, ...]
    patterns: NDArray[np.complex128]
    orbit: float
    shaft: float

    def balls(self, first: float = 0.0) -> NDArray[np.complex128]:
        """Places x, r, along the orbit of each ball, shape (3, balls); ``first``: angle of ball 0, rad."""
        count = self.patterns.shape[1]
        angles = first + 2.0 * np.pi * np.arange(count) / count
        columns = [np.ones(count)]
        for k in range(1, (count - 1) // 2 + 1):
            columns += [np.cos(k * angles), np.sin(k * angles)]
        if count % 2 == 0:
            columns.append(np.where(np.arange(count) % 2, -1.0, 1.0))
        return np.asarray(self.patterns @ np.array(columns))


def shape(system: BearingLinearised, vector: NDArray[np.complex128], value: complex) -> Shape:
    """Return the shape of an eigenvector with its eigenvalue (1/s)."""
    at, p = system.coordinates, system.arrays.p
    pitch = float(p[P.PITCH_RADIUS])
    rings = vector[at.rings : at.ring_rates]
    outer = rings[Q.OUTER :]
    inside = rings[[Q.X, Q.X, Q.Y, Q.Z, Q.INNER_BY, Q.INNER_BZ]] * [1.0, 0.0, 1.0, 1.0, pitch, pitch]
    outside = outer[[Q.X, Q.TURN, Q.Y, Q.Z, Q.BY, Q.BZ]] * [1.0, pitch, 1.0, 1.0, pitch, pitch]
    balls = np.array([vector[at.ball_state(kind)] for kind in range(_BALL_PLACES)])
    balls[2] *= pitch
    bends = _bends(at, p, vector)
    grooves = [np.outer([bend.cosine, bend.sine], [bend.x, bend.r, bend.theta]).ravel() for bend in bends]
    everything = np.concatenate([inside, outside, balls.ravel(), *grooves])
    # the largest part is at its end when the motion begins
    largest = everything[int(np.argmax(abs(everything)))]
    scale = 1.0 / largest if abs(largest) > 0.0 else 1.0
    turns = abs(value.imag) or 1.0
    scaled = tuple(bend._replace(cosine=scale * bend.cosine, sine=scale * bend.sine) for bend in bends)
    return Shape(
        scale * inside,
        scale * outside,
        scaled,
        np.asarray(scale * balls),
        system.orbit / turns,
        system.speed / turns,
    )


def _bends(at: Coordinates, p: NDArray[np.float64], vector: NDArray[np.complex128]) -> list[Bend]:
    places, table = vector[at.flexure : at.flexure_rates], int(p[P.AT_MODES])
    bends = []
    for k, (order, ring) in enumerate(zip(at.orders, at.bodies, strict=True)):
        row = p[table + k * P.MODE_SIZE : table + (k + 1) * P.MODE_SIZE]
        units = (float(row[place]) for place in (P.MODE_X, P.MODE_R, P.MODE_T))
        bends.append(Bend(ring, order, complex(places[2 * k]), complex(places[2 * k + 1]), *units))
    return bends
