"""Interference fits of a bearing's rings: pressure, growth of the races, hoop stress, speed of loss.

Plane stress after Lame: a ring on a shaft, or in a housing, with rotation, and warmth without gradients
inside a part. A ring counts as a plain rectangle from its seat to its effective diameter, which gives its
mass; elements of the grooved section agree with that (tests/formulas/test_fit_elements.py). A partner longer
than the ring is stiffer than one as wide as it, by a factor of its compliance: a band load on a long tube
(the differential equation of beams on elastic foundation), with a part for thick walls fitted to elements.

Units are SI, angles rad. Interference is on the *radius* here, half of the one on diameter; + is tight.
Hoop stress: + is tension.
"""

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

Kind = Literal["inner", "outer"]

REFERENCE = 293.15  # K: drawn dimensions and interference are those at 20 degC
_SHEAR_OF_WALL = 0.3  # fitted to elements with walls from 0.1 of the mean radius to solid shafts
_BAR = 3e-3 * 4e-3 * 30e-3  # m3: bar of the bending test, height, width and span between the outer rollers
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(48)
_LARGEST = 700.0  # exponent: beyond it exp() has no number, and the chance is 1 anyway


class Solid(NamedTuple):
    """Material of a ring or a partner: Young's modulus (Pa), Poisson's ratio, kg/m3, expansion (1/K)."""

    youngs_modulus: float
    poisson_ratio: float
    density: float
    expansion: float


class State(NamedTuple):
    """A seat at a state: interference (m on radius; negative: a gap), pressure and hoop (Pa), race (m).

    ``hoop`` is the stress at the bore of the inner ring, or inside the outer one; ``race`` is the radial
    motion of the race where the ball touches it, beyond the ring's thermal growth.
    """

    interference: float
    pressure: float
    hoop: float
    race: float


class Fit(NamedTuple):
    """Linear coefficients of one seat.

    Attributes
    ----------
    kind : {"inner", "outer"}
        Ring: inner one on a shaft, outer one in a housing.
    ring, partner : float
        Interference per kelvin of the ring, and of the partner, above 20 degC (m/K).
    spin : float
        Interference per square of the speed (m s2); 0 for the outer ring, which is at rest.
    pressure : float
        Pressure over interference (Pa/m).
    share : float
        Motion of the race over interference, from 0 to 1 for the inner ring, from -1 to 0 for the outer one.
    race_spin : float
        Motion of the race of the free ring per square of the speed (m s2).
    hoop : float
        Hoop stress over pressure, at the bore of the inner ring or inside the outer one.
    hoop_spin : float
        Hoop stress at the bore of the free ring per square of the speed (Pa s2).
    partner_hoop : float
        Hoop stress of the partner at its seat over pressure; of a shaft negative.
    seat_radius, effective_radius, width : float
        The ring's rectangle: seat, other surface, width (m).
    partner_radius : float
        Other radius of the partner (m): bore of a shaft, outside of a housing.
    length_factor : float
        Compliance of the partner over that of one as wide as the ring.
    solid : Solid
        Material of the ring.
    """

    kind: Kind
    ring: float
    partner: float
    spin: float
    pressure: float
    share: float
    race_spin: float
    hoop: float
    hoop_spin: float
    partner_hoop: float
    seat_radius: float
    effective_radius: float
    width: float
    partner_radius: float
    length_factor: float
    solid: Solid

    def at(self, d_0: float, speed: float, ring_temperature_K: float, partner_temperature_K: float) -> State:
        """Return the state of a seat.

        Parameters
        ----------
        d_0 : float
            Interference on the radius at 20 degC and standstill (m), after loss by roughness.
        speed : float
            Speed of the shaft (rad/s), of either sign.
        ring_temperature_K, partner_temperature_K : float
            Temperatures of the ring and of the shaft or housing (K).

        Returns
        -------
        State
            A gap carries no pressure: the ring is centred and grows alone.
        """
        square = speed**2
        left = self._still(d_0, ring_temperature_K, partner_temperature_K) + self.spin * square
        remaining = max(0.0, left)
        pressure = self.pressure * remaining
        return State(
            interference=left,
            pressure=pressure,
            hoop=self.hoop * pressure + self.hoop_spin * square,
            race=self.share * remaining + self.race_spin * square,
        )

    def loss_speed(self, d_0: float, ring_temperature_K: float, partner_temperature_K: float) -> float | None:
        """Return the speed (rad/s) at which the fit lets go, at given temperatures.

        Returns
        -------
        float or None
            0 where it is loose at standstill; None where no speed loosens it: a housing, or a shaft that
            grows faster than the ring.
        """
        left = self._still(d_0, ring_temperature_K, partner_temperature_K)
        if left <= 0.0:
            return 0.0
        return math.sqrt(left / -self.spin) if self.spin < 0.0 else None

    def _still(self, d_0: float, ring_temperature_K: float, partner_temperature_K: float) -> float:
        """Interference at standstill, m."""
        warm = self.ring * (ring_temperature_K - REFERENCE)
        return d_0 + warm + self.partner * (partner_temperature_K - REFERENCE)


def fit(
    kind: Kind,
    seat_radius: float,
    effective_radius: float,
    contact_radius: float,
    width: float,
    ring: Solid,
    partner: Solid,
    partner_radius: float,
    long: bool = True,
) -> Fit:
    """Return the coefficients of a seat.

    Parameters
    ----------
    kind : {"inner", "outer"}
        Inner ring on a shaft, or outer ring in a housing.
    seat_radius, effective_radius : float
        Radii of the ring's seat and of its other surface, half of the effective diameter (m).
    contact_radius : float
        Radius at which the unloaded ball touches the groove (m).
    width : float
        Width of the ring (m).
    ring, partner : Solid
        Materials of the ring and of the shaft or housing.
    partner_radius : float
        Bore of the shaft (0: solid) or outside of the housing, as a radius (m).
    long : bool
        The partner is longer than the ring on both sides; otherwise it is as wide as the ring.

    Returns
    -------
    Fit

    Raises
    ------
    ValueError
        When a wall has no thickness: the message names the radius and its range.
    """
    a, c, o = seat_radius, effective_radius, partner_radius
    inner = kind == "inner"
    side = 1.0 if inner else -1.0
    if not (a < c if inner else 0.0 < c < a):
        allowed = f"more than {a:.6g}" if inner else f"0 to {a:.6g}"
        raise ValueError(f"the {kind} ring has no wall: effective_radius = {c:.6g} m; give {allowed} m")
    if not (0.0 <= o < a if inner else a < o):
        name, allowed = ("shaft", f"0 (solid) to {a:.6g}") if inner else ("housing", f"more than {a:.6g}")
        raise ValueError(f"the {name} has no wall: partner_radius = {o:.6g} m; give {allowed} m")
    factor = length_factor(a, o, width, partner.poisson_ratio) if long else 1.0
    compliance = _compliance(a, c, ring) + factor * _compliance(a, o, partner)
    free = _growth(a, a, c, ring) if inner else 0.0
    return Fit(
        kind=kind,
        ring=-side * a * ring.expansion,
        partner=side * a * partner.expansion,
        spin=_growth(a, o, a, partner) - free if inner else 0.0,
        pressure=1.0 / compliance,
        share=_displacement(contact_radius, a, c, ring) / compliance,
        race_spin=_growth(contact_radius, a, c, ring) if inner else 0.0,
        hoop=float(_hoop(np.array(a if inner else c), a, c)),
        hoop_spin=float(_hoop_spin(np.array(a), a, c, ring)) if inner else 0.0,
        partner_hoop=float(_hoop(np.array(a), a, o)),
        seat_radius=a,
        effective_radius=c,
        width=width,
        partner_radius=o,
        length_factor=factor,
        solid=ring,
    )


def length_factor(seat_radius: float, other_radius: float, width: float, poisson_ratio: float) -> float:
    """Return the compliance of a long tube under a band of pressure over that of a tube of the band's width.

    Parameters
    ----------
    seat_radius, other_radius : float
        Radii of the tube (m), loaded and free surface; 0: a solid shaft.
    width : float
        Width of the band (m).
    poisson_ratio : float
        Of the tube.

    Notes
    -----
    Mean radial displacement under a band on a thin tube without end, on its own elastic foundation; for
    thick walls, which shear, 0.3 t/m of the rest is added (t wall, m mean radius; fitted to elements).
    """
    mean, wall = 0.5 * (seat_radius + other_radius), abs(seat_radius - other_radius)
    b = (3.0 * (1.0 - poisson_ratio**2)) ** 0.25 * width / math.sqrt(mean * wall)
    thin = 1.0 - (1.0 + math.exp(-b) * (math.sin(b) - math.cos(b))) / (2.0 * b)
    return thin + _SHEAR_OF_WALL * (1.0 - thin) * wall / mean


def _displacement(r: float, seat: float, other: float, solid: Solid) -> float:
    """Radial displacement at ``r`` over the pressure on a tube's seat (m/Pa), by Lame."""
    nu = solid.poisson_ratio
    shape = (1.0 - nu) * r + ((1.0 + nu) * other**2 / r if other else 0.0)
    return seat**2 / (solid.youngs_modulus * (other**2 - seat**2)) * shape


def _compliance(seat: float, other: float, solid: Solid) -> float:
    """How far a tube's seat gives way over the pressure on it (m/Pa), inside or outside."""
    return abs(_displacement(seat, seat, other, solid))


def _growth(r: float, low: float, high: float, solid: Solid) -> float:
    """Radial displacement at ``r`` of a turning annulus over the square of its speed (m s2)."""
    nu = solid.poisson_ratio
    hole = (1.0 + nu) * (low * high) ** 2 / r if low else 0.0
    shape = (3.0 + nu) / 8.0 * ((low**2 + high**2) * (1.0 - nu) * r + hole) - (1.0 - nu**2) / 8.0 * r**3
    return solid.density / solid.youngs_modulus * shape


def _hoop(r: NDArray[np.float64], seat: float, other: float) -> NDArray[np.float64]:
    """Hoop stress at ``r`` over the pressure on a tube's seat, by Lame."""
    return seat**2 / (other**2 - seat**2) * (1.0 + (other / r) ** 2)


def _hoop_spin(r: NDArray[np.float64], low: float, high: float, solid: Solid) -> NDArray[np.float64]:
    """Hoop stress at ``r`` of a turning annulus over the square of its speed (Pa s2)."""
    nu = solid.poisson_ratio
    shape = low**2 + high**2 + (low * high / r) ** 2 - (1.0 + 3.0 * nu) / (3.0 + nu) * r**2
    return (3.0 + nu) / 8.0 * solid.density * shape


def breaking_chance(seat: Fit, state: State, speed: float, strength: float, weibull_modulus: float) -> float:
    """Return the chance that a ceramic ring breaks at once under the hoop stress of a state.

    Weibull's weakest link over the ring's volume, without slow growth of cracks. Hoop stress is taken as
    constant over the width; the outer ring of a fit is under compression and has no chance.

    Parameters
    ----------
    seat : Fit
    state : State
        A state of that seat; its pressure counts.
    speed : float
        Speed of the shaft (rad/s) of that state.
    strength : float
        Mean strength of bars of 3 x 4 mm in 3-point bending on a span of 30 mm (Pa).
    weibull_modulus : float
        Of that strength.

    Returns
    -------
    float
        0 to 1.
    """
    if seat.kind == "outer":
        return 0.0
    a, c, m = seat.seat_radius, seat.effective_radius, weibull_modulus
    r = 0.5 * (a + c) + 0.5 * (c - a) * _NODES
    stress = state.pressure * _hoop(r, a, c) + speed**2 * _hoop_spin(r, a, c, seat.solid)
    volume = math.pi * seat.width * (c - a) * _WEIGHTS * r  # shares of the ring's, m3
    scale = strength / math.gamma(1.0 + 1.0 / m)  # breaks 63 % of the bars
    bar = _BAR / (2.0 * (m + 1.0) ** 2)  # effective volume: a bar under tension of that strength
    logs = [m * math.log(s / scale) + math.log(v / bar) for s, v in zip(stress, volume, strict=True) if s > 0]
    return -math.expm1(-math.fsum(math.exp(min(log, _LARGEST)) for log in logs))


def free_angle(
    pitch_diameter: float,
    ball_diameter: float,
    inner_conformity: float,
    outer_conformity: float,
    contact_angle: float,
    growths: tuple[float, float, float] = (1.0, 1.0, 1.0),
    races: tuple[float, float] = (0.0, 0.0),
) -> float:
    """Return the free contact angle (rad) with races that moved; 0 where the bearing is radially tight.

    Parameters
    ----------
    pitch_diameter, ball_diameter : float
        As drawn (m).
    inner_conformity, outer_conformity : float
        Groove radius over ball diameter.
    contact_angle : float
        Free contact angle as drawn (rad).
    growths : tuple of float
        Thermal growth of the inner ring, the outer ring and the balls: 1 + expansion times rise.
    races : tuple of float
        Radial motion of the inner and the outer race beyond that (m), as `State.race` gives it.
    """
    warm_inner, warm_outer, warm_ball = growths
    cosine = math.cos(contact_angle)
    inner_reach, outer_reach = ((f - 0.5) * ball_diameter for f in (inner_conformity, outer_conformity))
    inner = (0.5 * pitch_diameter + inner_reach * cosine) * warm_inner + races[0]
    outer = (0.5 * pitch_diameter - outer_reach * cosine) * warm_outer + races[1]
    grooves = ball_diameter * (inner_conformity * warm_inner + outer_conformity * warm_outer)
    return math.acos(min(1.0, (inner - outer) / (grooves - ball_diameter * warm_ball)))


def clearance(
    grooves: tuple[float, float],
    ball_diameter: float,
    inner_conformity: float,
    outer_conformity: float,
    growths: tuple[float, float, float] = (1.0, 1.0, 1.0),
    races: tuple[float, float] = (0.0, 0.0),
) -> tuple[float, float]:
    """Return the radial clearance (m) with races that moved, negative where tight, and the free angle (rad).

    Parameters
    ----------
    grooves : tuple of float
        Radii of both circles of groove centres as drawn (m), inner and outer.
    ball_diameter, inner_conformity, outer_conformity, growths, races
        As of `free_angle`.
    """
    warm_inner, warm_outer, warm_ball = growths
    apart = grooves[0] * warm_inner + races[0] - grooves[1] * warm_outer - races[1]
    free = ball_diameter * (inner_conformity * warm_inner + outer_conformity * warm_outer - warm_ball)
    return 2.0 * (free - apart), math.acos(min(1.0, apart / free))


def mounting_kelvin(interference: float, seat_radius: float, expansion: float) -> float:
    """Return how many kelvins part ring and partner (K), to slip them on without force.

    Parameters
    ----------
    interference, seat_radius : float
        On the radius (m).
    expansion : float
        Of the part that is warmed or cooled (1/K).
    """
    return max(0.0, interference) / (expansion * seat_radius)


def creep_interference(seat_radius: float, width: float, radial_load: float) -> float:
    """Return the interference on the radius (m) below which a radial load (N) lets the inner ring creep.

    0.08 sqrt(d F / B) um on diameter, with bore d and width B (mm) and F (N), is what the load takes off the
    interference: a maker's catalogue, 9 Fits and Internal Clearances, equation 9.1 (studylib.net/doc/8266084,
    as text: its root sign is lost, but the factor 0.25 for kgf, which it gives too, is that of a root). NTN
    prints the same (7 Bearing fits, equation 7.1) up to F = 0.3 C0, and 0.02 F / B beyond, which is not used
    here. The specification of fits names NSK's technical report E728g, 3.2, which was not read.
    """
    return 0.5 * 0.08e-6 * math.sqrt(2.0 * seat_radius * radial_load / width)


def creep_torque(pressure: float, seat_radius: float, width: float, friction: float) -> float:
    """Return the torque (N m) at which a ring slips on its seat, for a coefficient of friction."""
    return 2.0 * math.pi * friction * pressure * width * seat_radius**2
