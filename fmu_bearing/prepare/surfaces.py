"""Surfaces of races and balls: power law, contact filter, highest orders, form of the balls.

Amplitudes of turned and ground surfaces fall with the order n about as A_1 n^-p: machined steel has a power
spectral density of k^-2, p = 1 (Majumdar and Tien 1990). A ball does not follow waves that are shorter than
its contact, which averages them over its width with the weight of the Hertzian pressure.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, kinematic_frequencies
from fmu_bearing.engine.layout import P
from fmu_bearing.engine.layout.sizes import BALL_ORDERS
from fmu_bearing.prepare import bodies
from fmu_bearing.prepare.contacts import race_contacts
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.imperfections import HIGHEST_ORDER, Imperfections

#: Highest zonal order of a ball, a bound on cost: on the 7003C it sounds at 10 kHz at 2,700 r/min.
HIGHEST_BALL_ORDER = BALL_ORDERS
_LOWEST_BALL_ORDER = 2  # order 1 moves the ball's middle
#: Mean load of all balls over radial load per ball, without clearance: the means over the angle of cos^1.5
#: and cos^2.5 in the loaded half (point contact, Harris 2006, ch. 7).
_MEAN_OF_RADIAL = 0.2782 / 0.2288
_PROFILE = 20_001  # places at which the profile of a ball is searched for its extremes


class Patch(NamedTuple):
    """Mean contact with a race: half-width along rolling and distance of its middle from the axis (m)."""

    half_width: float
    radius: float


class Orders(NamedTuple):
    """Highest orders of waviness of inner race, outer race and balls."""

    inner: int
    outer: int
    balls: int


def contact_filter(u: ArrayLike) -> NDArray[np.float64]:
    """Share of a wave that a Hertzian contact follows, W(u) = sin(u)/u.

    ``u``: half-width of the contact times the wave number; W(0) = 1. Exact for small amplitudes: by
    reciprocity a gap dg changes the load by the integral of -dp/d(approach) dg, and dp/d(approach) of an
    elliptic contact is the pressure of a flat punch on the ellipse of now (Johnson 1985, section 3.5), whose
    integral across the track is uniform over the width.
    """
    return np.asarray(np.sinc(np.asarray(u, dtype=float) / np.pi))


def law(first: float, exponent: float, orders: ArrayLike, wave_length: float) -> NDArray[np.float64]:
    """Amplitudes A_1 n^-p W(n) of the ``orders`` n, in the unit of ``first`` (A_1).

    ``wave_length``: half-width of the contact over the radius of its track, so that u = n times it; 0: no
    filter.
    """
    n = np.asarray(orders, dtype=float)
    return first * n**-exponent * contact_filter(n * wave_length)


def mean_patches(scene: Scene) -> tuple[Patch, Patch]:
    """Mean contacts with inner and outer race at the scene's speed.

    Balance of one ball under an equal share of the preload and its centrifugal force at the kinematic orbit
    speed (Harris 2006, ch. 3, without gyroscopic moment). Radial loads, temperatures and what rigid preload
    gains with speed are left out: the width goes with the cube root of the load. Deep groove bearings live by
    radial loads: there the mean over the balls of what these put on them is added.
    """
    b = si(scene.bearing)
    contacts = race_contacts(scene)
    mass, _ = bodies.ball(scene)
    orbit = 2.0 * math.pi * frequencies(scene, si(scene.operation).speed).f_c
    pull = mass * 0.5 * b.pitch_diameter * orbit**2
    axial = abs(scene.mounted.preload_N) / b.ball_count
    across, free = 0.0, scene.bearing.free_angle
    if scene.bearing.is_deep_groove:
        across = _MEAN_OF_RADIAL * math.hypot(scene.mounted.radial_load_y_N, scene.mounted.radial_load_z_N)
        across /= b.ball_count
    reach = [(conformity - 0.5) * b.ball_diameter for conformity in (b.inner_conformity, b.outer_conformity)]

    def loads(angle: float) -> tuple[float, float, float]:
        inner = axial / math.sin(angle)
        outer_radial = inner * math.cos(angle) + pull
        return inner, math.hypot(axial, outer_radial), math.atan2(axial, outer_radial)

    def closes(angle: float) -> float:
        inner, outer, outer_angle = loads(angle)
        lengths = [
            r + (load / contact.stiffness) ** (2.0 / 3.0)
            for r, load, contact in zip(reach, (inner, outer), contacts, strict=True)
        ]
        apart = lengths[0] * math.cos(angle) + lengths[1] * math.cos(outer_angle)
        return apart - sum(reach) * math.cos(free)

    if axial <= 0.0:
        contact_loads, angles = (across, across + pull), (0.0 if across else free, 0.0)
    else:
        low, high = 1e-3, 0.5 * math.pi - 1e-6
        meets = closes(low) > 0.0 > closes(high)
        inner_angle = float(brentq(closes, low, high, xtol=1e-12)) if meets else high
        inner, outer, outer_angle = loads(inner_angle)
        contact_loads, angles = (inner + across, outer + across), (inner_angle, outer_angle)
    patches = []
    for side, load, angle, contact in zip((-1.0, 1.0), contact_loads, angles, contacts, strict=True):
        root = math.sqrt((load / contact.stiffness) ** (2.0 / 3.0))
        radius = 0.5 * (b.pitch_diameter + side * b.ball_diameter * math.cos(angle))
        patches.append(Patch(contact.half_width * root, radius))
    return patches[0], patches[1]


def highest_orders(scene: Scene) -> Orders:
    """Highest orders by the law: ``highest_order``, or what sounds at ``highest_frequency_kHz``.

    A race's wave of order n passes the balls n times as often as they pass one place of the race; a ball's
    zonal wave passes its contacts at n times the ball's spin.
    """
    flaws = scene.imperfections
    if flaws is None:
        return Orders(0, 0, 0)
    slowest = scene.operation.lowest_speed_rpm or abs(scene.operation.speed_rpm)
    rates = frequencies(scene, slowest * math.pi / 30.0)
    highest = 1e3 * flaws.highest_frequency_kHz

    def order(rate: float, limit: int, lowest: int) -> int:
        highest_order = limit if rate * limit <= highest else int(highest / rate * (1.0 + 1e-12))
        return max(highest_order, lowest)

    races = (rates.f_r - rates.f_c, rates.f_c)
    inner, outer = (flaws.highest_order or order(rate, HIGHEST_ORDER, flaws.lowest_order) for rate in races)
    return Orders(inner, outer, order(rates.f_b, HIGHEST_BALL_ORDER, _LOWEST_BALL_ORDER))


def ball_profile(flaws: Imperfections, highest: int, wave_length: float) -> NDArray[np.float64]:
    """Zonal amplitudes (m) of the orders 1 .. ``highest`` of a ball with a deviation from spherical form.

    Orders from 2 on follow the race's law with signs drawn from the seed; their sum reaches from lowest to
    highest by the deviation (ISO 3290-2), before the contact filter acts. One profile serves all balls.
    """
    orders = np.arange(1, highest + 1)
    signs = np.random.default_rng([flaws.seed, 4]).choice((-1.0, 1.0), HIGHEST_BALL_ORDER)[:highest]
    # the scene has checked that a law has its exponent
    assert flaws.waviness_exponent is not None
    amplitudes = signs * law(1.0, flaws.waviness_exponent, orders, 0.0)
    amplitudes[: _LOWEST_BALL_ORDER - 1] = 0.0
    x = np.cos(np.linspace(0.0, math.pi, _PROFILE))
    heights = legendre.legval(x, np.concatenate([[0.0], amplitudes]))
    amplitudes *= si(flaws).ball_form / float(np.ptp(heights))
    return amplitudes * contact_filter(orders * wave_length)


def form_rows(amplitudes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Numbers of the engine per zonal order from 0 on, ``P.FORM_ROW`` each, for ``amplitudes`` (m) from 1 on.

    Legendre series of the height and its derivative by the cosine, times the polynomials' leading
    coefficients (2n)! / (2^n n!^2), and what the recurrence takes of the order before.
    """
    height = np.concatenate([[0.0], amplitudes])
    n = np.arange(height.size)
    leading = np.concatenate([[1.0], np.cumprod((2.0 * n[1:] - 1.0) / n[1:])])
    rows = np.zeros((height.size, P.FORM_ROW))
    for place, order in ((P.FORM_HEIGHT, 0), (P.FORM_RISE, 1)):
        series = legendre.legder(height, order)
        rows[: series.size, place] = series * leading[: series.size]
    rows[:, P.FORM_BACK] = n**2 / (4.0 * n**2 - 1.0)
    return rows.ravel()


def frequencies(scene: Scene, speed: float) -> KinematicFrequencies:
    """Kinematic frequencies (Hz) at a shaft speed (rad/s)."""
    b = si(scene.bearing)
    angle = scene.bearing.nominal_angle
    return kinematic_frequencies(speed, b.ball_count, b.ball_diameter, b.pitch_diameter, angle)
