"""Film force of a short, plain journal bearing (Ocvirk) with squeeze, cavitating, by quadrature.

Sources: G. B. DuBois and F. W. Ocvirk (1953), NACA report 1157; a film that carries no suction (Guembel's
boundary condition, on wedge and squeeze together).

Signs. The journal (inner body, surface speed w1) sits displaced by e along the unit vector n from the centre
of the sleeve (outer body, surface speed w2); n has the angle phi, t is n turned by +90 degrees, all in the
sense of positive rotation. Returned is the force ON THE JOURNAL along n and t; the sleeve feels the opposite.

Closed forms are known for the two pure motions. With eps = e/c and W = w1 + w2 - 2 phi':

* wedge alone (eps' = 0), the half Sommerfeld solution:
  F_n = -K |W| eps^2 / (1 - eps^2)^2,  F_t = +K pi W eps / (4 (1 - eps^2)^(3/2));
* squeeze alone (W = 0), r^2 = 1 - eps^2, s = +1 for eps' > 0 (closing) and -1 for eps' < 0 (opening):
  F_n = -K eps' [(1 + 2 eps^2)(pi/2 + s asin eps) + 3 s eps r] / r^5,  F_t = 0,

with K = eta R L^3 / c^2. F_n of the wedge pushes the journal back to the middle, F_t drives it forward:
half-speed whirl.
"""

import functools
from dataclasses import dataclass
from itertools import pairwise
from math import asin, copysign, cos, pi, sin, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq


@dataclass(frozen=True)
class Film:
    """Viscosity in Pa s; journal radius, axial length and radial clearance in m."""

    viscosity: float
    radius: float
    length: float
    clearance: float


@dataclass(frozen=True)
class Motion:
    """Eccentricity, its angle, the rates of both, and the speeds of both surfaces (m, rad, s)."""

    eccentricity: float
    eccentricity_rate: float
    angle: float
    angle_rate: float
    journal_speed: float
    sleeve_speed: float

    @property
    def wedge_speed(self) -> float:
        """Speed W = w1 + w2 - 2 phi' that drags oil into the wedge, in rad/s."""
        return self.journal_speed + self.sleeve_speed - 2.0 * self.angle_rate


def pressure(film: Film, motion: Motion, around: float, along: float) -> float:
    """Reynolds pressure in Pa at a fixed angle (rad) and axial place (m from the middle).

    No flow around, only along. Everything stands in the sleeve's fixed frame: journal centre (X, Y),
    ``h = c - X cos - Y sin``,
    ``d/dz(h^3 / 12 eta dp/dz) = (w1 + w2)/2 dh/dTheta + dh/dt``, p = 0 at both ends.
    """
    e, e_rate, phi, phi_rate = motion.eccentricity, motion.eccentricity_rate, motion.angle, motion.angle_rate
    centre = e * cos(phi), e * sin(phi)
    velocity = e_rate * cos(phi) - e * phi_rate * sin(phi), e_rate * sin(phi) + e * phi_rate * cos(phi)
    thickness = film.clearance - centre[0] * cos(around) - centre[1] * sin(around)
    slope = centre[0] * sin(around) - centre[1] * cos(around)
    rate = -velocity[0] * cos(around) - velocity[1] * sin(around)
    source = 0.5 * (motion.journal_speed + motion.sleeve_speed) * slope + rate
    return 6.0 * film.viscosity / thickness**3 * source * (along**2 - 0.25 * film.length**2)


def force_by_quadrature(film: Film, motion: Motion) -> tuple[float, float]:
    """Force on the journal along n and t in N: pressure, where it is positive, over length and turn."""

    @functools.cache
    def along_axis(around: float) -> float:
        """Integral over the length (N/m); a parabola of one sign, whose suction the oil does not carry."""
        half = 0.5 * film.length
        return max(quad(lambda z: pressure(film, motion, around, z), -half, half, epsabs=0.0)[0], 0.0)

    def middle(around: float) -> float:
        return pressure(film, motion, around, 0.0)

    # the film ends where the pressure changes sign: twice per turn
    grid = motion.angle + np.linspace(-pi, pi, 73)
    ends = [
        brentq(middle, one, other, xtol=1e-15)
        for one, other in pairwise(grid)
        if middle(one) * middle(other) < 0.0
    ]

    def around_integral(direction: float) -> float:
        def ring(around: float) -> float:
            return -along_axis(around) * cos(around - direction) * film.radius

        # Integrand parts cancel: the tolerance has to be absolute, so it is taken from the integrand. At 95 %
        # eccentricity the pressure's peak is 0.3 rad wide, ten of these places.
        size = max(abs(ring(float(place))) for place in np.linspace(grid[0], grid[-1], 200))
        return sum(
            quad(ring, one, other, epsabs=1e-12 * size, epsrel=1e-12, limit=500)[0]
            for one, other in pairwise([grid[0], *ends, grid[-1]])
        )

    return around_integral(motion.angle), around_integral(motion.angle + 0.5 * pi)


def wedge_alone(film: Film, eps: float, wedge: float) -> tuple[float, float]:
    """Force along n and t in N of a journal whose eccentricity stays, from the module's docstring."""
    room = 1.0 - eps**2
    scale = film.viscosity * film.radius * film.length**3 / film.clearance**2
    return -scale * abs(wedge) * eps**2 / room**2, scale * pi * wedge * eps / (4.0 * room**1.5)


def squeeze_alone(film: Film, eps: float, rate: float) -> float:
    """Force along n in N of a film without wedge; ``rate``: of eps, in 1/s."""
    root, side = sqrt(1.0 - eps**2), copysign(1.0, rate)
    scale = film.viscosity * film.radius * film.length**3 / film.clearance**2
    shape = (1.0 + 2.0 * eps**2) * (0.5 * pi + side * asin(eps)) + 3.0 * side * eps * root
    return -scale * rate * shape / root**5


def film_force_numeric(
    viscosity: float, radius: float, length: float, clearance: float, ratio: float, rate: float, wedge: float
) -> tuple[float, float]:
    """Integrate as `force_by_quadrature`, from eps, its rate (1/s) and W: push inwards (-F_n), F_t, in N."""
    film = Film(viscosity, radius, length, clearance)
    # only W counts: a journal turning at W in a sleeve at rest, not whirling
    motion = Motion(ratio * clearance, rate * clearance, 0.0, 0.0, wedge, 0.0)
    radial, tangential = force_by_quadrature(film, motion)
    return -radial, tangential
