"""Hertz point contact between a ball and a groove, with complete elliptic integrals at 30 digits.

Source: K. L. Johnson (1985), Contact Mechanics, section 4.2: for the gap ``A x^2 + B y^2`` (A <= B, so x is
the long direction) and an ellipse a >= b of eccentricity e, ``e^2 = 1 - b^2/a^2``, under the peak pressure
p0,

    A     = p0 / E* . b / (e^2 a^2) . (K - E)
    B     = p0 / E* . b / (e^2 a^2) . (a^2/b^2 E - K)
    delta = p0 / E* . b K,                   Q = 2/3 pi a b p0

The ratio A/B fixes e, the sum A + B the size. `surface_displacement` integrates the pressure over the ellipse
and so checks these expressions without using any of them.
"""

from dataclasses import dataclass
from math import cos, hypot, pi, sin, sqrt

import mpmath
from scipy.integrate import quad

from . import Bearing

DIGITS = 30


@dataclass(frozen=True)
class Contact:
    """A contact under load (SI): gap curvatures A and B, E*, semi-axes, approach, peak pressure."""

    load: float
    long_curvature: float
    short_curvature: float
    modulus: float
    semi_major: float
    semi_minor: float
    approach: float
    peak_pressure: float

    @property
    def constant(self) -> float:
        """Load over approach to the power 1.5, in N/m^1.5 (independent of the load)."""
        return self.load / self.approach**1.5


def point_contact(load: float, first: float, second: float, modulus: float) -> Contact:
    """Solve the elliptic contact for the sums of both bodies' curvatures in the two principal planes.

    Parameters
    ----------
    load : float
        Normal load in N.
    first, second : float
        Relative curvatures in 1/m (sum over both bodies, convex positive), in any order, different.
    modulus : float
        Contact modulus E* in Pa.
    """
    with mpmath.workdps(DIGITS):
        long_half, short_half = (mpmath.mpf(c) / 2 for c in sorted((first, second)))
        ratio = long_half / short_half

        def mismatch(m: mpmath.mpf) -> mpmath.mpf:
            complete_k, complete_e = mpmath.ellipk(m), mpmath.ellipe(m)
            return (complete_k - complete_e) / (complete_e / (1 - m) - complete_k) - ratio

        # m = e^2; the ratio falls from 1 (circle) to 0 (line) as m grows, so the bracket holds the root
        bracket = (mpmath.mpf("1e-8"), 1 - mpmath.mpf("1e-12"))
        m = mpmath.findroot(mismatch, bracket, solver="anderson", tol=mpmath.mpf(10) ** (-40), maxsteps=500)
        complete_k, complete_e = mpmath.ellipk(m), mpmath.ellipe(m)
        b_over_a = mpmath.sqrt(1 - m)
        # A = p0/E* . b/(m a^2) (K - E) with p0 = 3 Q / (2 pi a b) leaves a^3 alone
        a = mpmath.cbrt(3 * load * (complete_k - complete_e) / (2 * mpmath.pi * modulus * m * long_half))
        b = a * b_over_a
        peak = 3 * load / (2 * mpmath.pi * a * b)
        return Contact(
            load=load,
            long_curvature=float(long_half),
            short_curvature=float(short_half),
            modulus=modulus,
            semi_major=float(a),
            semi_minor=float(b),
            approach=float(peak / modulus * b * complete_k),
            peak_pressure=float(peak),
        )


def contact_modulus(bearing: Bearing) -> float:
    """Plane-strain contact modulus E* of ball on ring in Pa."""
    ball = (1.0 - bearing.ball_poisson**2) / bearing.ball_modulus
    ring = (1.0 - bearing.ring_poisson**2) / bearing.ring_modulus
    return 1.0 / (ball + ring)


def race_contact(bearing: Bearing, race: str, load: float = 100.0) -> Contact:
    """Contact of a ball with the `inner` or `outer` race at the free contact angle.

    In the rolling plane the race's radius of curvature is the distance along the contact normal from the
    contact to the bearing axis, ``(d_m/2 -+ D/2 cos a) / cos a``: convex inside, concave outside. The groove
    is concave with radius f D in the other plane.
    """
    diameter, angle = bearing.ball_diameter, bearing.contact_angle
    if race == "inner":
        rolling = cos(angle) / (0.5 * bearing.pitch_diameter - 0.5 * diameter * cos(angle))
        groove = -1.0 / (bearing.inner_conformity * diameter)
    else:
        rolling = -cos(angle) / (0.5 * bearing.pitch_diameter + 0.5 * diameter * cos(angle))
        groove = -1.0 / (bearing.outer_conformity * diameter)
    ball = 2.0 / diameter
    return point_contact(load, ball + groove, ball + rolling, contact_modulus(bearing))


def surface_displacement(contact: Contact, x: float, y: float) -> float:
    """Sum of both surfaces' displacement in m at a point inside the ellipse, by integrating the pressure.

    Boussinesq: each element of pressure lowers the surface at distance s by ``p dA / (pi E* s)``. In polar
    coordinates about the point the 1/s cancels, so both integrals are regular up to a square root at the rim.
    """
    a, b = contact.semi_major, contact.semi_minor

    def chord(angle: float) -> float:
        # 1 - (x/a)^2 - (y/b)^2 along the ray: c0 - 2 c1 s - c2 s^2, zero at the rim
        c0 = 1.0 - (x / a) ** 2 - (y / b) ** 2
        c1 = x * cos(angle) / a**2 + y * sin(angle) / b**2
        c2 = hypot(cos(angle) / a, sin(angle) / b) ** 2
        root = sqrt(c1**2 + c0 * c2)
        near, far = (-c1 - root) / c2, (-c1 + root) / c2
        # s = far - far u^2 takes the square root out of the integrand's end
        integral, _ = quad(
            lambda u: sqrt(c2 * far * (far - far * u * u - near)) * u * 2.0 * far * u, 0.0, 1.0, epsabs=0.0
        )
        return integral

    scale = contact.peak_pressure / (pi * contact.modulus)
    breaks = [0.5 * pi, pi, 1.5 * pi]
    total, _ = quad(chord, 0.0, 2.0 * pi, points=breaks, epsabs=0.0, epsrel=1e-10, limit=400)
    return scale * total
