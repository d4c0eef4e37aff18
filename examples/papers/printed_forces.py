"""Forces between balls, rings and cage for :mod:`examples.papers.printed_equations`, in plain NumPy.

The multi-source paper leaves them to its references. Here they have the product's forms (docs/theory.md),
written again without its engine; the printed traction, eta V S / h, is here too.

Arrays of balls have the shape (balls, k), vectors (3, balls, k) with components (x, r, theta): ``k`` states
are evaluated at once.
"""

import math
from dataclasses import dataclass
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import C, P, Q

Array = NDArray[np.float64]

INNER, OUTER, CAGE = range(3)
#: Rows of the state per ball.
X, R, LAG, VX, VR, OM, WX, WR, WT = range(9)
#: First coordinate of each body: x, y, z, the turn (not of the inner ring), tilts about y and z.
FIRST = (0, 5, 11)
_CENTRES = np.add.outer((0, 1, 2), FIRST)
_TURNS = np.array([0, 8, 14])  # the first one's place is taken by the prescribed speed
_TILTS = np.add.outer((0, 1), (3, 9, 15))
_STILL_2 = 1e-8  # m2/s2: entrainment is rounded over 0.1 mm/s
_CALM = 0.01  # 1/s: a land's film turns its pressing side round over this rate


class Bearing:
    """Numbers of a prepared scene, SI: attributes have the names of the package's layouts in lower case.

    Parameters
    ----------
    p, c : ndarray
        Parameters and conditions of a bearing. ``ball_mass`` is ``p[P.BALL_MASS]``, ``pedestal_axial`` is
        ``c[C.PEDESTAL_AXIAL]``. Where both have a name, the condition counts.
    """

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> float: ...

    def __init__(self, p: Array, c: Array) -> None:
        self.__dict__.update({name.lower(): float(p[at]) for name, at in _places(P, p)})
        self.__dict__.update({name.lower(): float(c[at]) for name, at in _places(C, c)})
        #: Of the springs and dampers to ground that hold the inner ring against tilting.
        self.tilt_stiffness = float(p[P.SUPPORT_STIFFNESS + Q.INNER_BY])
        self.tilt_damping = float(p[P.SUPPORT_DAMPING + Q.INNER_BY])
        both = []
        for race in (INNER, OUTER):
            own, held = p[P.RACES + race * P.RACE_SIZE :], c[C.RACES + race * C.RACE_SIZE :]
            numbers = {name[5:].lower(): own[at] for name, at in _places(P, own) if name[:5] == "RACE_"}
            of_step = ("GROOVE_X", "GROOVE_RADIUS", "FREE", "ROLLING")
            numbers |= {name.lower(): held[getattr(C, name)] for name in of_step}
            # k of eqs. 4 and 6: groove radius over ball diameter
            numbers["curvature"] = numbers["groove"] / self.diameter
            both.append(numbers)
        #: Numbers of inner and outer race, each of shape (2, 1, 1).
        self.races = SimpleNamespace(**{key: np.array([[[race[key]]] for race in both]) for key in both[0]})
        first, count = int(p[P.AT_STRIPS]), int(p[P.STRIPS])
        #: Places on a contact's major axis over its half length, and their shares of the load.
        self.nodes, self.shares = p[first : first + 2 * count].reshape(2, count, 1, 1, 1)


def _places(layout: ModuleType, values: Array) -> list[tuple[str, int]]:
    """Names of a layout that are places within the values."""
    found = [(name, at) for name, at in vars(layout).items() if name.isupper() and isinstance(at, int)]
    return [(name, at) for name, at in found if 0 <= at < values.size]


@dataclass(frozen=True)
class Pose:
    """Balls seen from bodies, in their own axes (x, r, theta): shape (bodies, balls, k), vectors (3, ...).

    Place ``q`` from a body's centre, its axis ``n``, radial and tangential directions ``h`` and ``t``; axial
    and radial distance; velocity ``dv`` and spin ``dw`` against the body's material.
    """

    q: Array
    n: Array
    h: Array
    t: Array
    axial: Array
    radial: Array
    dv: Array
    dw: Array

    def of(self, bodies: int | slice) -> "Pose":
        """Seen from one body, or some."""
        q, n, h, t, dv, dw = (one[:, bodies] for one in (self.q, self.n, self.h, self.t, self.dv, self.dw))
        return Pose(q, n, h, t, self.axial[bodies], self.radial[bodies], dv, dw)


@dataclass(frozen=True)
class Contact:
    """Contacts of all balls with both races, shape (2, balls, k), vectors (3, 2, balls, k).

    Unit vectors ``e`` from the ball into the race, ``t`` along the track, ``m`` across. ``load``, traction
    ``along`` (T_xi) and ``across`` (T_eta) on the ball in N, ``rolling`` moment (N m) about ``m``,
    ``couples`` (N m) about ``e``, ``t``, ``m``; sliding and entrainment in m/s.
    """

    e: Array
    t: Array
    m: Array
    load: Array
    along: Array
    across: Array
    rolling: Array
    couples: tuple[Array, Array, Array]
    slide_along: Array
    slide_across: Array
    entrainment: Array

    @property
    def force(self) -> Array:
        """On the balls, N."""
        return -self.load * self.e + self.along * self.t + self.across * self.m

    @property
    def angle(self) -> Array:
        """Contact angle, rad."""
        return np.asarray(np.arctan2(np.abs(self.e[0]), np.abs(self.e[1])))


def cross(a: Array, b: Array) -> Array:
    """Vector product over the first axis."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def dot(a: Array, b: Array) -> Array:
    """Scalar product over the first axis."""
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def pose(b: Bearing, speed: float, balls: Array, angle: Array, places: Array, rates: Array) -> Pose:
    """Where the balls are in the frames of inner ring, outer ring and cage; small tilts (docs/theory.md)."""
    c, s = np.cos(angle), np.sin(angle)
    ux, uy, uz = places[_CENTRES][:, :, None]
    vx, vy, vz = rates[_CENTRES][:, :, None]
    by, bz = places[_TILTS][:, :, None]
    dby, dbz = rates[_TILTS][:, :, None]
    spin = rates[_TURNS][:, None]
    spin[INNER] = speed
    nx = 1.0 - 0.5 * (by * by + bz * bz)
    radius = b.pitch_radius + balls[R]
    q = np.stack([balls[X] - ux, radius - (c * uz - s * uy), c * uy + s * uz])
    n = np.stack([nx + 0.0 * c, -s * bz - c * by, -c * bz + s * by])
    axial = dot(q, n)
    out = q - axial * n
    radial = np.sqrt(dot(out, out))
    h = out / radial
    wy, wz = spin * bz + dby, -spin * by + dbz
    turning = np.stack([spin * nx + 0.0 * c, c * wz - s * wy, -c * wy - s * wz])
    own = np.stack([balls[VX] - vx, balls[VR] - (c * vz - s * vy), radius * balls[OM] + c * vy + s * vz])
    return Pose(q, n, h, cross(n, h), axial, radial, own - cross(turning, q), balls[WX:, None] - turning)


def contact(b: Bearing, balls: Array, pose: Pose, printed_law: bool) -> Contact:
    """Load, traction and rolling resistance of all balls on both races, which ``pose`` is seen from."""
    race = b.races
    ball = b.ball_radius
    x, r = pose.axial - race.groove_x, pose.radial - race.groove_radius
    distance = np.sqrt(x * x + r * r)
    e = (x * pose.n + r * pose.h) / distance
    m = (r * pose.n - x * pose.h) / distance
    pressed = np.maximum(distance - race.free, 0.0)
    root = np.sqrt(pressed)
    stiffness = race.stiffness
    rate = dot(e, pose.dv)
    load = np.maximum(stiffness * root * (pressed + 1.5 * b.contact_damping * rate), 0.0)
    an, at, am = dot(e, pose.dw), dot(pose.t, pose.dw), dot(m, pose.dw)
    ut = dot(pose.t, pose.dv) + ball * am
    um = dot(m, pose.dv) - ball * at
    spin = balls[WX:, None].copy()
    spin[0] -= balls[OM]
    entrain = ball * dot(m, spin) - 0.5 * ut
    offset = b.nodes * race.half_length * root
    sag = offset * offset / (2.0 * race.profile_radius)
    along, across = ut - offset * an - sag * am, um + sag * at
    if printed_law:
        pull = printed_pull(b, entrain, load, root)
    else:
        still = b.slide_to_roll * np.sqrt(entrain * entrain + _STILL_2) + b.traction_floor
        pull = b.mu * b.shares * load / np.sqrt(along * along + across * across + still * still)
    ft, fm = -pull * along, -pull * across
    size = race.rolling if b.rolling else 0.0 * race.rolling
    moment = size * load * (entrain * entrain + _STILL_2) ** 0.33 * (load + 1e-9) ** -0.53
    couples = (-(offset * ft).sum(axis=0), (sag * fm).sum(axis=0), -(sag * ft).sum(axis=0))
    return Contact(
        e, pose.t, m, load, ft.sum(axis=0), fm.sum(axis=0), -moment * am / np.sqrt(am * am + 1.0),
        couples, ut, um, entrain,
    )  # fmt: skip


def printed_pull(b: Bearing, entrain: Array, load: Array, root: Array) -> Array:
    """Eta S / h of the strips (N s/m): ambient viscosity; central film of Hamrock and Dowson (1977)."""
    race = b.races
    flow = b.viscosity * np.sqrt(entrain * entrain + _STILL_2)
    film = 1e-9 + race.central_film * flow**0.67 * (load + 1e-3) ** -0.067
    ellipse = race.half_length * race.half_width * root * root
    area = 8.0 / 3.0 * ellipse * b.shares / np.sqrt(1.0 - b.nodes * b.nodes)
    return np.asarray(area * b.viscosity / film)


def pocket(b: Bearing, balls: Array, pose: Pose) -> tuple[Array, Array]:
    """Force (N) and moment (N m) of the pockets on the balls: radial bores with Hertzian walls."""
    ball = b.ball_radius
    # the bore is at the cage's azimuth, which the ball is ahead of by its lag
    co, si = np.cos(balls[LAG]), -np.sin(balls[LAG])
    lean = -(pose.n[1] * co + pose.n[2] * si) / pose.n[0]
    bore = np.stack([lean, co, si]) / np.sqrt(1.0 + lean * lean)
    t = cross(pose.n, bore)
    axial, around = pose.axial, dot(pose.q, t)
    apart = np.sqrt(axial * axial + around * around + 1e-30)
    g = axial / apart * pose.n + around / apart * t
    push = np.maximum(apart - b.pocket_clearance, 0.0)
    vn, vt = dot(pose.n, pose.dv), dot(t, pose.dv)
    rate = (axial * vn + around * vt) / apart
    load = np.maximum(b.pocket_stiffness * push**1.5 * (1.0 + b.pocket_damping * rate), 0.0)
    slip = pose.dv + ball * cross(pose.dw, g)
    slip = slip - dot(slip, g) * g
    rubbing = -b.pocket_friction * load / np.sqrt(dot(slip, slip) + b.pocket_slip**2) * slip
    force = rubbing - load * g - b.pocket_film * (vn * pose.n + vt * t)
    return force, ball * cross(g, rubbing)


def film(ratio: Array, closing: Array, carried: Array) -> tuple[Array, Array]:
    """Radial and tangential force of a short cavitating film over eta R L^3 / c^2, as in docs/theory.md."""
    root = np.sqrt(1.0 - ratio * ratio)
    size = np.sqrt(closing * closing + carried * carried + _CALM * _CALM)
    k, s = closing / size, carried / size
    flat = 1.0 - (ratio * s) ** 2
    half = 0.5 * math.pi + np.arctan(ratio * k / root)
    swing = ratio * k * root * (s * s - k * k - (ratio * s) ** 2) / flat**2
    cc = ((1.0 + 2.0 * ratio * ratio) * half + swing + 4.0 * ratio * k * root / flat) / root**5
    cs = 2.0 * ratio * s**3 / flat**2
    ss = (half - swing) / root**3
    return closing * cc + carried * cs, -(closing * cs + carried * ss)


def land(
    b: Bearing, apart: Array, moving: Array, journal: float, sleeve: Array
) -> tuple[Array, Array, Array]:
    """Return forces of lands on the cage (N) and their torques (N m) on the inner ring and on the cage.

    ``apart`` and ``moving``: place (m) and velocity (m/s) in y, z of the cage against the inner ring at each
    land, shape (2, lands, k); ``journal`` and ``sleeve``: spin of inner ring and cage, rad/s. Forces have the
    shape (2, lands, k), torques (lands, k).
    """
    clearance, radius, length = b.land_clearance, b.land_radius, b.land_length
    limit = b.land_stop_fraction * clearance
    distance = np.sqrt(apart[0] ** 2 + apart[1] ** 2)
    aside = distance > 1e-30
    e = np.where(aside, apart / np.where(aside, distance, 1.0), np.array([1.0, 0.0])[:, None, None])
    t = np.stack([-e[1], e[0]])
    ratio = np.minimum(distance, limit) / clearance
    within = np.minimum(1.0, limit / np.maximum(distance, 1e-30))
    across = (t * moving).sum(axis=0)
    back, on = film(
        ratio,
        (e * moving).sum(axis=0) / clearance,
        within * across / clearance - 0.5 * (journal + sleeve) * ratio,
    )
    factor = b.land_viscosity * radius * length**3 / clearance**2
    force = -factor * back * e + factor * on * t
    couple = 0.5 * (apart[0] * force[1] - apart[1] * force[0])
    shear = 2.0 * math.pi * b.land_viscosity * radius**3 * length / clearance * (journal - sleeve)
    shear = shear / np.sqrt(1.0 - ratio * ratio)
    stop = b.land_stop_stiffness * np.maximum(distance - limit, 0.0)
    rub = across + radius * journal - (radius + distance) * sleeve
    friction = -b.land_stop_friction * stop * rub / np.sqrt(rub * rub + b.land_stop_slip**2)
    force = force - stop * e + friction * t
    return force, -shear - couple + radius * friction, shear - couple - (radius + distance) * friction
