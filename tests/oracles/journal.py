"""Film force of a short, plain journal bearing (Ocvirk) with squeeze, by quadrature and in closed form.

Sources: G. B. DuBois and F. W. Ocvirk (1953), NACA report 1157; half-Sommerfeld (Guembel) film boundary.

Signs. The journal (inner body, surface speed w1) sits displaced by e along the unit vector n from the centre
of the sleeve (outer body, surface speed w2); n has the angle phi, t is n turned by +90 degrees, all in the
sense of positive rotation. Returned is the force ON THE JOURNAL along n and t; the sleeve feels the opposite.
With eps = e/c, d(eps)/dt = e'/c, W = w1 + w2 - 2 phi' and s = +1 for W >= 0, -1 otherwise:

    F_n = -eta R L^3 / c^2 . [ |W| eps^2 / (1 - eps^2)^2  +  pi (1 + 2 eps^2) eps' / (2 (1 - eps^2)^(5/2)) ]
    F_t = +eta R L^3 / c^2 . [ pi W eps / (4 (1 - eps^2)^(3/2))  +  2 s eps eps' / (1 - eps^2)^2 ]

F_n pushes the journal back to the middle, F_t drives it forward: half-speed whirl. The film is the half
revolution in which the wedge term alone presses, so the squeeze may leave suction there, and the second part
of F_t jumps by 4 eps eps'/(1 - eps^2)^2 where W changes sign.
"""

import functools
from dataclasses import dataclass
from math import copysign, cos, pi, sin

from scipy.integrate import quad


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
    """Force on the journal along n and t in N: pressure over the length and the pressing half turn."""
    # the film is thinnest at phi; W > 0 drags oil towards there from behind
    start = motion.angle - pi if motion.wedge_speed >= 0.0 else motion.angle

    @functools.cache
    def along_axis(around: float) -> float:
        half = 0.5 * film.length
        return quad(lambda z: pressure(film, motion, around, z), -half, half, epsabs=0.0)[0]

    def around_integral(direction: float) -> float:
        def ring(around: float) -> float:
            return -along_axis(around) * cos(around - direction) * film.radius

        # Integrand parts cancel: the tolerance has to be absolute, so it is taken from the integrand. At 95 %
        # eccentricity the pressure's peak is 0.3 rad wide, ten of these places.
        size = max(abs(ring(start + 0.01 * pi * (k + 0.5))) for k in range(100))
        total, _ = quad(ring, start, start + pi, epsabs=1e-12 * size, epsrel=1e-12, limit=500)
        return total

    return around_integral(motion.angle), around_integral(motion.angle + 0.5 * pi)


def force_closed_form(film: Film, motion: Motion) -> tuple[float, float]:
    """Force on the journal along n and t in N from the expressions in the module's docstring."""
    eps = motion.eccentricity / film.clearance
    rate = motion.eccentricity_rate / film.clearance
    wedge = motion.wedge_speed
    side = copysign(1.0, wedge) if wedge != 0.0 else 1.0
    room = 1.0 - eps**2
    scale = film.viscosity * film.radius * film.length**3 / film.clearance**2
    along_n = -scale * (abs(wedge) * eps**2 / room**2 + pi * (1.0 + 2.0 * eps**2) * rate / (2.0 * room**2.5))
    along_t = scale * (pi * wedge * eps / (4.0 * room**1.5) + 2.0 * side * eps * rate / room**2)
    return along_n, along_t


def film_force_numeric(
    viscosity: float, radius: float, length: float, clearance: float, ratio: float, rate: float, wedge: float
) -> tuple[float, float]:
    """Integrate as `force_by_quadrature`, from eps, its rate (1/s) and W: push inwards (-F_n), F_t, in N."""
    film = Film(viscosity, radius, length, clearance)
    # only W counts: a journal turning at W in a sleeve at rest, not whirling
    motion = Motion(ratio * clearance, rate * clearance, 0.0, 0.0, wedge, 0.0)
    radial, tangential = force_by_quadrature(film, motion)
    return -radial, tangential
