"""Friction of a lubricated rolling contact, slowly: as printed in dimensionless groups, or by integration.

Sources: [A] Biboulet and Houpert (2010), Proc. IMechE J 224, 777, doi 10.1243/13506501JET791, equations 28 to
32; [B] Balan, Houpert, Tufescu and Olaru (2015), Lubricants 3, 222, doi 10.3390/lubricants3020222. Of the
rest everything is derived here: hysteresis from the pressure of a Hertz ellipse, heat of films and flashes
from heat conduction. Nothing of the package is used.
"""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
from mpmath import ellipe
from scipy.integrate import dblquad
from scipy.linalg import solve_banded
from scipy.optimize import brentq

from .hertz import Contact

LAWS = ("houpert-1987-ehl", "starved", "flooded")
_CHANGE = 6.6  # value of M at which the two regimes weigh the same


@dataclass(frozen=True)
class Inlet:
    """A contact that entrains oil: solved contact, viscosity (Pa s), entrainment (m/s), alpha (1/Pa)."""

    contact: Contact
    viscosity: float
    speed: float
    pressure_viscosity: float

    @property
    def modulus(self) -> float:
        """E' (Pa), twice the contact modulus."""
        return 2.0 * self.contact.modulus

    @property
    def radius(self) -> float:
        """R_x (m), along rolling: across the long axis of the ellipse."""
        return 0.5 / self.contact.short_curvature

    @property
    def ratio(self) -> float:
        """R_y / R_x."""
        return self.contact.short_curvature / self.contact.long_curvature

    @property
    def kappa(self) -> float:
        """Semi-minor over semi-major axis."""
        return self.contact.semi_minor / self.contact.semi_major

    @property
    def u(self) -> float:
        """Dimensionless speed of [A]: 2 eta u / (E' R_x)."""
        return 2.0 * self.viscosity * self.speed / (self.modulus * self.radius)

    @property
    def w(self) -> float:
        """Dimensionless load Q / (E' R_x^2)."""
        return self.contact.load / (self.modulus * self.radius**2)

    @property
    def beta(self) -> float:
        """(4 / pi) E(kappa) / (1 + R_x / R_y), with the complete integral of the second kind."""
        return 4.0 / pi * float(ellipe(1.0 - self.kappa**2)) / (1.0 + 1.0 / self.ratio)

    @property
    def regime(self) -> float:
        """M of [A]: small where the surfaces are rigid and the oil isoviscous, large in EHL."""
        return self.beta**0.25 * self.kappa * self.w * self.u**-0.75

    def rigid_force(self, law: str) -> float:
        """F_i (N) on either surface: rigid surfaces, isoviscous oil."""
        size = self.modulus * self.radius
        if law == "flooded":
            length = 2.0 * self.contact.semi_major
            return 0.77 * self.beta ** (-1 / 3) * self.kappa**0.12 * size * length * self.u ** (2 / 3)
        return 0.835 * size * self.radius * self.ratio**0.358 * self.u**0.636 * self.w**0.364

    def elastic_force(self, law: str) -> float:
        """F_e (N) on either surface: elastic surfaces, oil that pressure thickens."""
        size = self.modulus * self.radius
        if law == "flooded":
            return 1.8 * self.beta**-0.25 * size * 2.0 * self.contact.semi_major * self.u**0.75
        material = (self.pressure_viscosity * self.modulus) ** 0.022
        groups = self.ratio**0.348 * material * (self.u / 2.0) ** 0.66 * self.w**0.47
        return 2.86 * size * self.radius * groups

    def force(self, law: str) -> float:
        """Force (N) on either surface by one of `LAWS`."""
        elastic = self.elastic_force(law)
        if law == "houpert-1987-ehl":
            return elastic
        return (self.rigid_force(law) - elastic) / (1.0 + self.regime / _CHANGE) + elastic


def leading_moment(contact: Contact) -> float:
    """Moment (N m) about the long axis of the pressure on the half of the ellipse that comes into contact."""
    a, b = contact.semi_major, contact.semi_minor

    def moment(x: float, y: float) -> float:
        return contact.peak_pressure * sqrt(max(1.0 - (x / b) ** 2 - (y / a) ** 2, 0.0)) * x

    half, _ = dblquad(
        moment, -a, a, 0.0, lambda y: b * sqrt(max(1.0 - (y / a) ** 2, 0.0)), epsabs=0.0, epsrel=1e-7
    )
    return half


def shared_loss(first: tuple[float, float, float], second: tuple[float, float, float]) -> float:
    """Share of the elastic work of two bodies that is lost; of each: loss, Young's modulus (Pa), Poisson.

    Both carry the same pressure, so each stores work as its surface yields.
    """
    loss, modulus, poisson = np.transpose([first, second])
    compliance = (1.0 - poisson**2) / modulus
    return float(loss @ compliance / compliance.sum())


def film_heat(viscosity: float, slide: float, gap: float, conductivity: float, points: int = 2001) -> float:
    """Mean rise (K) of a film that a speed (m/s) shears between cold walls: conduction by differences.

    Viscosity (Pa s) and conductivity (W/(m K)) are constant. ``points`` places across the gap (m).
    """
    step = gap / (points - 1)
    heat = viscosity * (slide / gap) ** 2
    inside = points - 2
    bands = np.array([np.full(inside, -1.0), np.full(inside, 2.0), np.full(inside, -1.0)])
    rise = np.zeros(points)
    rise[1:-1] = solve_banded((1, 1), bands, np.full(inside, heat * step**2 / conductivity))
    return float(np.trapezoid(rise, dx=step) / gap)


def sheared_viscosity(law, temperature: float, slide: float, conductivity: float) -> float:
    """Viscosity (Pa s) of a film heated by its own shear; ``law`` gives it over temperature (K), falling.

    Root of eta = law(T + eta v^2 / (12 k)).
    """

    def excess(eta: float) -> float:
        return law(temperature + eta * slide**2 / (12.0 * conductivity)) - eta

    return float(brentq(excess, 0.0, law(temperature), xtol=1e-18, rtol=1e-14))


def petroff_moment(viscosity: float, radius: float, length: float, clearance: float, rate: float) -> float:
    """Moment (N m) of a concentric film between cylinders; ``rate`` (rad/s) of one against the other."""
    return 2.0 * pi * viscosity * radius**3 * length * rate / clearance


def flash(flux: float, half_width: float, speed: float, effusivity: float, points: int = 4000) -> float:
    """Mean rise (K) of a surface that crosses a strip 2 b wide of steady ``flux`` (W/m2) at ``speed`` (m/s).

    A half-space without conduction along its surface, by implicit differences (Crank and Nicolson) of unit
    conductivity and heat capacity times ``effusivity``, its depth stretched away from the surface.
    """
    time = 2.0 * half_width / speed
    depth = 8.0 * sqrt(time)  # where diffusivity is 1, heat reaches sqrt(time)
    edges = depth * np.linspace(0.0, 1.0, 401) ** 2
    width, middle = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    flow = effusivity / np.diff(middle)  # W/(m2 K) between neighbouring cells
    # times that grow as squares: the rise starts as the root of time
    moments = time * np.linspace(0.0, 1.0, points + 1) ** 2
    rise = np.zeros(len(width))
    surface = [0.0]
    out = np.concatenate((flow, [0.0])) + np.concatenate(([0.0], flow))
    for step in np.diff(moments):
        capacity = effusivity * width / step
        source = capacity * rise
        source[0] += flux
        # each half of the step: implicit Euler's conduction at its end, explicit at its start
        exchange = np.zeros_like(rise)
        exchange[:-1] += flow * np.diff(rise)
        exchange[1:] -= flow * np.diff(rise)
        bands = np.zeros((3, len(rise)))
        bands[0, 1:], bands[2, :-1] = -0.5 * flow, -0.5 * flow
        bands[1] = capacity + 0.5 * out
        rise = solve_banded((1, 1), bands, source + 0.5 * exchange)
        # half a cell below the surface the flux still lowers the temperature
        surface.append(rise[0] + flux * middle[0] / effusivity)
    return float(np.trapezoid(surface, moments) / time)


def slid_share(flux: float, rise: float, fall: float) -> float:
    """Share of the friction that is left where friction itself heats the oil: 1/sqrt(1 + beta dT).

    ``flux`` (W/m2) is that of the whole friction, ``rise`` K per W/m2, ``fall`` beta in 1/K. Root in the
    share, since what is left is what heats.
    """

    def excess(share: float) -> float:
        return 1.0 / sqrt(1.0 + fall * rise * share * flux) - share

    return float(brentq(excess, 0.0, 1.0 + 1e-12, xtol=1e-15))
