"""Meridian section of a ring: a rectangle with the groove of the race, and its mesh."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from fmu_bearing.extras import BENDING, need
from fmu_bearing.scene import Scene, si

if TYPE_CHECKING:
    from skfem import MeshQuad2

INNER, OUTER = 0, 1  # bodies, as the engine counts them
RACES = ("inner", "outer")

#: Elements over the longer side of the section. With 16, frequencies of the first modes below 60 kHz are
#: within 0.01 % of those on a mesh twice as fine; a mode's skin is smooth on the scale of sound anyway.
FINENESS = 16
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)  # the integrand is smooth: exact to rounding


@dataclass(frozen=True)
class Groove:
    """Circular groove of a race; lengths in m, angle in rad.

    ``x`` and ``r`` are the centre of the circle; ``angle`` is the place of the contact on it, from the
    bottom of the groove towards +X.
    """

    x: float
    r: float
    radius: float
    angle: float


@dataclass(frozen=True)
class Section:
    """Meridian section of a ring; lengths in m.

    The rectangle reaches from ``low`` to ``high`` in r and half of ``width`` to both sides of x = 0. The
    groove, if any, cuts into the outer surface of an inner ring and into the inner surface of an outer one.
    """

    body: int
    low: float
    high: float
    width: float
    groove: Groove | None = None

    @property
    def depth_sign(self) -> float:
        """+1 where the groove opens towards smaller r (outer ring), -1 where towards larger r."""
        return 1.0 if self.body == OUTER else -1.0

    def race(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Radius of the surface that carries the race, at axial places ``x`` (m)."""
        shoulder = self.low if self.body == OUTER else self.high
        if self.groove is None:
            return np.full_like(x, shoulder)
        groove, sign = self.groove, self.depth_sign
        inside = np.maximum(groove.radius**2 - (x - groove.x) ** 2, 0.0)
        return sign * np.maximum(sign * shoulder, sign * groove.r + np.sqrt(inside))

    def angles(self) -> tuple[float, float]:
        """Angles (rad) on the groove's circle at which it leaves the section: shoulders, or end faces."""
        groove = self.groove
        assert groove is not None
        shoulder = self.low if self.body == OUTER else self.high
        edge = math.acos(min(max(self.depth_sign * (shoulder - groove.r) / groove.radius, -1.0), 1.0))
        faces = [math.asin(min(max((x - groove.x) / groove.radius, -1.0), 1.0)) for x in self.faces]
        return max(-edge, faces[0]), min(edge, faces[1])

    @property
    def moment(self) -> float:
        """Integral of r over the section, m3: the volume of the ring per radian."""
        whole = 0.5 * self.width * (self.high**2 - self.low**2)
        if self.groove is None:
            return whole
        first, last = self.angles()
        angle = 0.5 * (first + last) + 0.5 * (last - first) * _NODES
        shoulder = self.low if self.body == OUTER else self.high
        race = self.groove.r + self.depth_sign * self.groove.radius * np.cos(angle)
        cut = 0.5 * np.abs(race**2 - shoulder**2) * self.groove.radius * np.cos(angle)
        return whole - float(0.5 * (last - first) * (_WEIGHTS @ cut))

    @property
    def faces(self) -> tuple[float, float]:
        """Axial places of the end faces, m."""
        return -self.width / 2.0, self.width / 2.0

    @property
    def contact(self) -> tuple[float, float]:
        """Place (x, r) in m where the unloaded ball touches the groove; mid-race without a groove."""
        groove = self.groove
        if groove is None:
            return 0.0, self.low if self.body == OUTER else self.high
        return (
            groove.x + groove.radius * math.sin(groove.angle),
            groove.r + self.depth_sign * groove.radius * math.cos(groove.angle),
        )


@dataclass(frozen=True, eq=False)
class Grid:
    """Mesh of a section in rows and columns of quadratic quadrilaterals.

    ``reference`` is the same mesh with whole numbers as coordinates: (column, row). ``contact`` is the
    place of the contact in half columns; ``race_row`` and ``seat_row`` are the surfaces in half rows.
    """

    mesh: "MeshQuad2"
    reference: "MeshQuad2"
    columns: int
    rows: int
    contact: int
    race_row: int
    seat_row: int


def groove_circle(scene: Scene, body: int) -> tuple[float, float]:
    """Return place along the axis and radius (m) of the circle of groove centres of a ring.

    Balls on the pitch circle touch both grooves of an angular contact bearing at its contact angle. Both
    circles of a deep groove bearing lie in its middle plane, nearer to each other by the radial clearance.
    """
    b = si(scene.bearing)
    side = -1.0 if body == INNER else 1.0
    reach = ((b.inner_conformity if body == INNER else b.outer_conformity) - 0.5) * b.ball_diameter
    if scene.bearing.is_deep_groove:
        return 0.0, b.pitch_diameter / 2 - side * (reach - 0.25 * scene.bearing.radial_clearance)
    angle = scene.bearing.nominal_angle
    return -side * reach * math.sin(angle), b.pitch_diameter / 2 - side * reach * math.cos(angle)


def ring_section(scene: Scene, body: int) -> Section:
    """Section of the inner (0) or outer (1) ring of a scene.

    The groove's circle is the one the contacts use: the ball touches it at the nominal contact angle. The
    scene's effective diameter gives the ring's mass as a plain rectangle; the shoulders are where the
    grooved ring has that mass. Both have the same diameter, although an angular contact bearing has one of
    them relieved: the scene knows no better (assumed).

    Raises
    ------
    ValueError
        When the contact lies beyond the end faces, the groove leaves no wall, or no shoulder between the
        contact and the middle of the groove's circle gives that mass.
    """
    b = si(scene.bearing)
    side = -1.0 if body == INNER else 1.0
    conformity = b.inner_conformity if body == INNER else b.outer_conformity
    angle = side * scene.bearing.nominal_angle
    groove = Groove(*groove_circle(scene, body), radius=conformity * b.ball_diameter, angle=angle)
    seat, effective = b.bore / 2.0, b.inner_ring_outer_diameter / 2.0
    if body == OUTER:
        seat, effective = b.outside_diameter / 2.0, b.outer_ring_inner_diameter / 2.0
    whole = _section(body, seat, effective, b.width).moment
    contact = _section(body, seat, effective, b.width, groove).contact
    # at the contact's own height the groove would end there; beyond the circle's middle it would close again
    ends = [_section(body, seat, height, b.width, groove).moment for height in (contact[1], groove.r)]
    problem = None
    if abs(contact[0]) >= b.width / 2.0:
        problem = (
            f"width_mm = {1e3 * b.width:.4g} does not reach the contact; give a smaller contact_angle_deg"
        )
    elif side * (seat - groove.r) <= groove.radius:
        problem = f"groove leaves no wall at the seat; give a smaller {RACES[body]}_conformity or ball"
    elif not ends[0] < whole < ends[1]:
        problem = _no_shoulder(body, seat, b.width, ends)
    if problem is not None:
        raise ValueError(f"the {RACES[body]} ring's {problem}")
    shoulder = brentq(
        lambda height: _section(body, seat, height, b.width, groove).moment - whole,
        contact[1],
        groove.r,
        xtol=1e-12,
    )
    return _section(body, seat, shoulder, b.width, groove)


def _section(body: int, seat: float, shoulder: float, width: float, groove: Groove | None = None) -> Section:
    low, high = sorted((seat, shoulder))
    return Section(body, low, high, width, groove)


def _no_shoulder(body: int, seat: float, width: float, moments: list[float]) -> str:
    """Say which effective diameters the groove allows: values for rectangles with the extreme volumes."""
    sign = 1.0 if body == INNER else -1.0
    limits = [2e3 * math.sqrt(max(seat**2 + sign * 2.0 * moment / width, 0.0)) for moment in moments]
    key = "inner_ring_outer_diameter_mm" if body == INNER else "outer_ring_inner_diameter_mm"
    return (
        f"groove fits no ring of the mass that bearing.{key} gives; allowed for this ball, conformity and "
        f"contact angle: {min(limits):.4g} to {max(limits):.4g}; correct it"
    )


def grid(section: Section, fineness: int = FINENESS) -> Grid:
    """Mesh of a section with about ``fineness`` elements over its longer side.

    Rows run from the lower to the upper surface, columns from end face to end face; the contact and the
    groove's edges lie between columns, and curved sides follow the circle to third order.

    Raises
    ------
    MissingExtra
        Without scikit-fem (extra ``elastic``).
    """
    skfem = need("skfem", BENDING)
    size = max(section.width, section.high - section.low) / fineness
    stations, contact = _stations(section, size)
    columns = (len(stations) - 1) // 2
    rows = max(2, math.ceil((section.high - section.low) / size))
    squares = skfem.MeshQuad.init_tensor(np.arange(columns + 1.0), np.arange(rows + 1.0))
    reference = skfem.MeshQuad2.from_mesh(squares)
    half = np.rint(2.0 * reference.doflocs).astype(int)
    x, share = stations[half[0]], half[1] / (2.0 * rows)
    race = section.race(x)
    low, high = (race, section.high) if section.body == OUTER else (section.low, race)
    mesh = skfem.MeshQuad2(np.vstack((x, low + share * (high - low))), reference.t)
    race_row, seat_row = (0, 2 * rows) if section.body == OUTER else (2 * rows, 0)
    return Grid(mesh, reference, columns, rows, contact, race_row, seat_row)


def _stations(section: Section, size: float) -> tuple[NDArray[np.float64], int]:
    """Axial places of element edges and middles, and the index of the contact among them."""
    groove, (left, right) = section.groove, section.faces

    def straight(start: float, end: float) -> NDArray[np.float64]:
        count = math.ceil((end - start) / size - 1e-9)
        return np.linspace(start, end, 2 * count + 1) if count > 0 else np.array([start])

    if groove is None:
        halves = [straight(left, 0.0), straight(0.0, right)]
        return np.concatenate((halves[0], halves[1][1:])), len(halves[0]) - 1
    first, last = section.angles()

    def arc(start: float, end: float) -> NDArray[np.float64]:
        count = max(2, math.ceil(groove.radius * (end - start) / size))
        return groove.x + groove.radius * np.sin(np.linspace(start, end, 2 * count + 1))

    before, after = arc(first, groove.angle), arc(groove.angle, last)
    ahead, behind = straight(left, before[0]), straight(after[-1], right)
    stations = np.concatenate((ahead[:-1], before[:-1], after, behind[1:]))
    return stations, len(ahead) + len(before) - 2
