"""Axial load and displacement of an angular contact ball bearing at rest. Units N, mm, deg, Pa.

The rings move along the axis alone. Every ball carries the same load; its contacts follow Hertz with the
constants of the free contact angle, while the contact angle itself grows with the load.
"""

import math
from typing import NamedTuple

from scipy.optimize import brentq

from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.formulas.iso281 import relative_ball

Elastic = tuple[float, float]
_FIRST = 1e-3  # mm: a displacement to begin the search with


class StiffnessRange(ValueError):
    """No allowed conformities give a stiffness; ``least`` and ``most`` (N/um) are what they give."""

    def __init__(self, least: float, most: float) -> None:
        """Keep what is possible."""
        super().__init__(f"allowed conformities give {least:.4g} to {most:.4g} N/um")
        self.least, self.most = least, most


class Axial(NamedTuple):
    """What the axial load depends on.

    Attributes
    ----------
    balls : int
    angle : float
        Free contact angle (rad).
    distance : float
        Of the groove centres without load (mm).
    stiffness : float
        K of Q = K d^1.5 (N/mm^1.5), both contacts of a ball in series.
    """

    balls: int
    angle: float
    distance: float
    stiffness: float


def axial(
    balls: int,
    ball: float,
    pitch: float,
    angle_deg: float,
    conformities: tuple[float, float],
    elastic: tuple[Elastic, Elastic, Elastic],
) -> Axial:
    """Return what the axial load of a bearing depends on.

    Parameters
    ----------
    balls : int
    ball, pitch : float
        Ball and pitch diameter (mm).
    angle_deg : float
        Free contact angle.
    conformities : tuple of float
        Inner and outer.
    elastic : tuple
        Modulus of elasticity (Pa) and Poisson's ratio of inner ring, outer ring and ball.
    """
    angle = math.radians(angle_deg)
    g = relative_ball(ball, pitch, angle)
    compliance = 0.0
    sides = zip(conformities, (g / (1.0 - g), -g / (1.0 + g)), elastic[:2], strict=True)
    for conformity, curvature, ring in sides:
        along = 0.5 * ball / (1.0 + curvature)
        across = ball / (2.0 - 1.0 / conformity)
        contact = point_contact(along * 1e-3, across * 1e-3, effective_modulus(*ring, *elastic[2]))
        compliance += (contact.stiffness * 1e-3**1.5) ** (-2.0 / 3.0)
    return Axial(balls, angle, (sum(conformities) - 1.0) * ball, compliance**-1.5)


def axial_load(bearing: Axial, displacement: float) -> float:
    """Return the axial load (N) at an axial displacement (mm) from where the balls touch without load."""
    if displacement <= 0.0:
        return 0.0
    across = bearing.distance * math.cos(bearing.angle)
    along = bearing.distance * math.sin(bearing.angle) + displacement
    loaded = math.hypot(across, along)
    return bearing.balls * bearing.stiffness * (loaded - bearing.distance) ** 1.5 * along / loaded


def axial_displacement(bearing: Axial, load: float) -> float:
    """Return the axial displacement (mm) at an axial load (N): the inverse of `axial_load`."""
    if load <= 0.0:
        return 0.0
    high = _FIRST
    while axial_load(bearing, high) < load:
        high *= 2.0
    return float(brentq(lambda x: axial_load(bearing, x) - load, 0.0, high, xtol=1e-15, rtol=1e-12))


def axial_stiffness(bearing: Axial, load: float) -> float:
    """Return the axial stiffness (N/um) at an axial load (N); a rigid pair in the middle has twice that."""
    x = axial_displacement(bearing, load)
    step = 1e-4 * x  # the load is smooth there: the error of the difference is about 1e-8
    rise = axial_load(bearing, x + step) - axial_load(bearing, x - step)
    return 1e-3 * rise / (2.0 * step) if load > 0.0 else 0.0


def conformities(
    stiffness: float,
    load: float,
    balls: int,
    ball: float,
    pitch: float,
    angle_deg: float,
    elastic: tuple[Elastic, Elastic, Elastic],
    offset: float = 0.0,
    allowed: tuple[float, float] = (0.505, 0.6),
) -> tuple[float, float]:
    """Return the conformities with which a bearing has an axial stiffness: the inverse of `axial_stiffness`.

    Stiffness falls where either conformity grows, so that there is one answer. It determines the sum alone.

    Parameters
    ----------
    stiffness : float
        Of one bearing (N/um).
    load : float
        Axial load (N).
    balls, ball, pitch, angle_deg, elastic
        As of `axial`.
    offset : float
        Outer minus inner conformity; 0: one number for both.
    allowed : tuple of float
        Least and largest conformity.

    Returns
    -------
    tuple of float
        Inner and outer conformity.

    Raises
    ------
    StiffnessRange
        Where no allowed conformities give it.
    """

    def found(inner: float) -> float:
        bearing = axial(balls, ball, pitch, angle_deg, (inner, inner + offset), elastic)
        return axial_stiffness(bearing, load)

    closest, widest = allowed[0] + max(0.0, -offset), allowed[1] - max(0.0, offset)
    least, most = found(widest), found(closest)
    if not least <= stiffness <= most:
        raise StiffnessRange(least, most)
    inner = float(brentq(lambda x: found(x) - stiffness, closest, widest, xtol=1e-13, rtol=1e-13))
    return inner, inner + offset


def flush_load(bearing: Axial, pair: float, more: int, fewer: int) -> float:
    """Return the axial load (N) of each bearing on the side with more, where the faces of a set are flush.

    Equal bearings, ground for a pair: each has the offset of its faces that ``pair`` (N) closes. Flush faces
    displace bearings of one side equally and both sides by two offsets in all; their loads are in balance.

    Parameters
    ----------
    bearing : Axial
    pair : float
        Load of each bearing of a pair (N).
    more, fewer : int
        Bearings that carry one way and the other way.
    """
    offset = axial_displacement(bearing, pair)

    def excess(x: float) -> float:
        return more * axial_load(bearing, x) - fewer * axial_load(bearing, 2.0 * offset - x)

    return axial_load(bearing, float(brentq(excess, 0.0, 2.0 * offset, xtol=1e-15, rtol=1e-12)))
