"""Flexural modes of a scene's rings, as the equations of motion and the sound need them."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.fourier import Elastic, Solid, solid
from fmu_bearing.elastic.section import FINENESS, INNER, OUTER, RACES, Section, grid, ring_section
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.material import Material

Array = NDArray[np.float64]

_X, _R, _T = range(3)
_SEARCHED = 6  # modes of one order among which the first in-plane one is; it is the first or the second
#: Half-angle (rad) of the groove around the contact whose turn counts as its tilt: wider than any contact
#: ellipse that stays on the race, narrow beside the groove.
_TILT_REACH = np.deg2rad(15.0)
#: Spacing of points on the skin, m: 57 to a wavelength of 17 mm in air at 20 kHz.
_SKIN_SPACING = 0.3e-3


@dataclass(frozen=True, eq=False)
class RingMode:
    """One mode family of a free ring at rest: coordinates a, b (m) of one shape, a quarter wave apart.

    With theta from 12 o'clock about +X and u_t along increasing theta::

        u_x, u_r = psi_x, psi_r (a cos n theta + b sin n theta)
        u_t      = psi_t        (a sin n theta - b cos n theta)

    In-plane families are scaled to psi_r = 1 at the contact.

    Attributes
    ----------
    body : int
        0 inner, 1 outer ring.
    order : int
        Circumferential order n.
    family : str
        ``in-plane``.
    frequency : float
        Natural frequency, Hz.
    modal_mass : float
        Mass of ONE coordinate, kg: the kinetic energy is modal_mass (a'^2 + b'^2) / 2.
    gyroscopic : float
        g, twice the integral of psi_r psi_t over that of psi^2, both weighted with density: on a ring that
        spins at Omega, in its own frame, a'' + 2 Omega g b' + w0^2 a = 0 and b'' - 2 Omega g a' + w0^2 b =
        0, so that z = a - i b obeys z'' + 2 i Omega g z' + w0^2 z = 0; seen from the frame that does not
        spin, n + g means g. -1 for translation, 2 (1 + g) = I_p / I_t for tilt.
    groove : ndarray (3,)
        psi (x, r, t) where the unloaded ball touches the groove.
    groove_tilt : float
        Turn of the groove about t there, from x towards r, rad per m of a or b.
    seat : float
        Mean of psi_r^2 over the width of the seat. A seat that would hold the rigid ring with the radial
        stiffness K (N/m) holds each coordinate with K times this.
    skin_points : ndarray (k, 2)
        Places (x, r) in m along the section's boundary, anticlockwise with x to the right and r up, from the
        lower corner at -x. Closed: the last point is the first.
    skin_shape : ndarray (k, 3)
        psi (x, r, t) at these.
    """

    body: int
    order: int
    family: str
    frequency: float
    modal_mass: float
    gyroscopic: float
    groove: Array
    groove_tilt: float
    seat: float
    skin_points: Array
    skin_shape: Array


def ring_modes(scene: Scene) -> tuple[RingMode, ...]:
    """Modes of the scene's rings in the order of the engine's coordinates; none without a table ``flexure``.

    Inner ring before outer ring, orders rising; each mode has two coordinates, a before b. Per ring
    and order it is the lowest mode that moves mostly in the plane of the ring.

    Raises
    ------
    ValueError
        When a ring's dimensions leave no groove, or it has no such mode among its lowest.
    MissingExtra
        Without scikit-fem (extra ``elastic``), where a ring bends.
    """
    flexure = scene.mounted.flexure
    if flexure is None:
        return ()
    modes = []
    rings = (
        (INNER, flexure.inner_ring, scene.materials.inner_ring),
        (OUTER, flexure.outer_ring, scene.materials.outer_ring),
    )
    for body, orders, material in rings:
        if orders:
            try:
                section = ring_section(scene, body)
            except ValueError as problem:
                raise ValueError(f"{problem}, or leave the ring out of the table flexure") from None
            constants = elastic(material)
            modes += [in_plane_mode(section, constants, order) for order in orders]
    return tuple(modes)


def elastic(material: Material) -> Elastic:
    """Return what the rings' solid needs of a scene's material."""
    values = si(material)
    return Elastic(values.youngs_modulus, values.poisson_ratio, values.density)


@lru_cache(maxsize=64)
def in_plane_mode(section: Section, material: Elastic, order: int, fineness: int = FINENESS) -> RingMode:
    """Lowest mode of one order (2 or more) that moves mostly in the plane of the ring.

    Raises
    ------
    ValueError
        When a ring of odd proportions has other motions first.
    """
    ring = meshed(section, material, fineness)
    frequencies, shapes = ring.modes(order, _SEARCHED)
    inside = [i for i in range(_SEARCHED) if family(ring, order, shapes[:, i]) == "in-plane"]
    if not inside:
        raise ValueError(
            f"the {RACES[section.body]} ring has no in-plane mode of order {order} among its {_SEARCHED} "
            "lowest: leave this order out of the table flexure"
        )
    pick = inside[0]
    shape = shapes[:, pick]
    contact = ring.nodes[ring.grid.contact, ring.grid.race_row]
    shape = shape / shape[contact[_R]]
    points, skin = _skin(ring, shape)
    return RingMode(
        body=section.body,
        order=order,
        family="in-plane",
        frequency=float(frequencies[pick]),
        modal_mass=float(np.pi * (shape @ ring.mass @ shape)),
        gyroscopic=gyroscopic(ring, shape),
        groove=_fixed(shape[contact]),
        groove_tilt=_tilt(ring, section, shape),
        seat=_seat(ring, shape),
        skin_points=_fixed(points),
        skin_shape=_fixed(skin),
    )


def gyroscopic(ring: Solid, shape: Array) -> float:
    """Return g of a shape; see `RingMode`."""
    return float((shape @ ring.coriolis @ shape) / (shape @ ring.mass @ shape))


def family(ring: Solid, order: int, shape: Array) -> str:
    """Name the family of an elastic shape by the rigid motions of the section that carry most of its energy.

    A section symmetric about x = 0 parts them strictly; a groove towards one side mixes them a little.
    """
    energy = shape @ ring.mass @ shape
    if order == 0:
        tangential = np.zeros_like(shape)
        tangential[ring.nodes[..., _T]] = shape[ring.nodes[..., _T]]
        if tangential @ ring.mass @ tangential > 0.5 * energy:
            return "torsion"
    x, r = ring.points[..., 0], ring.points[..., 1]
    one, height = np.ones_like(x), r - r.mean()
    inside = _share(ring, shape, [{_R: one}, {_T: one}, {_T: height}])
    outside = _share(ring, shape, [{_X: one}, {_X: -height, _R: x}, {_T: x}])
    if order == 0:
        return "breathing" if inside > outside else "roll"
    return "in-plane" if inside > outside else "out-of-plane"


def _share(ring: Solid, shape: Array, motions: list[dict[int, Array]]) -> float:
    """Energy of a shape's part that the given motions of the section span."""
    base = np.zeros((len(shape), len(motions)))
    for column, motion in enumerate(motions):
        for component, values in motion.items():
            base[ring.nodes[..., component], column] = values
    weighted = ring.mass @ base
    projected = weighted.T @ shape
    return float(projected @ np.linalg.solve(base.T @ weighted, projected))


@lru_cache(maxsize=8)
def meshed(section: Section, material: Elastic, fineness: int = FINENESS) -> Solid:
    """Return matrices of a ring, made once."""
    return solid(grid(section, fineness), material)


def _tilt(ring: Solid, section: Section, shape: Array) -> float:
    """Turn about t of the groove around the contact: that of the rigid motion nearest to the surface's."""
    race = ring.grid.race_row
    x, r = ring.points[:, race].T
    groove = section.groove
    if groove is None:
        near = np.abs(x - x[ring.grid.contact]) <= section.width / 8.0
    else:
        angle = np.arctan2(x - groove.x, section.depth_sign * (r - groove.r))
        near = np.abs(angle - groove.angle) <= max(_TILT_REACH, 2.0 * np.abs(np.diff(angle)).min())
    x, r = x[near] - x[ring.grid.contact], r[near] - r[ring.grid.contact]
    unknowns = ring.nodes[near, race]
    zero, one = np.zeros_like(x), np.ones_like(x)
    motions = np.vstack((np.column_stack((one, zero, -r)), np.column_stack((zero, one, x))))
    moved = np.concatenate((shape[unknowns[:, _X]], shape[unknowns[:, _R]]))
    return float(np.linalg.lstsq(motions, moved, rcond=None)[0][2])


def _seat(ring: Solid, shape: Array) -> float:
    """Mean over the width of the radial shape squared on the seat."""
    row = ring.grid.seat_row
    x, radial = ring.points[:, row, 0], shape[ring.nodes[:, row, _R]]
    start, middle, end = radial[:-2:2], radial[1::2], radial[2::2]
    # exact for the square of a quadratic: its mass matrix on the element
    squares = 4.0 * start**2 + 16.0 * middle**2 + 4.0 * end**2
    products = 4.0 * start * middle + 4.0 * middle * end - 2.0 * start * end
    return float(np.sum((x[2::2] - x[:-2:2]) * (squares + products)) / 30.0 / (x[-1] - x[0]))


def _skin(ring: Solid, shape: Array) -> tuple[Array, Array]:
    """Points and shape along the boundary, between the nodes by the elements' own polynomials."""
    table = np.concatenate((ring.points, shape[ring.nodes]), axis=2)
    sides = (table[:, 0], table[-1], table[::-1, -1], table[0, ::-1])
    nodes = np.concatenate([side[:-1] for side in sides] + [table[:1, 0]])
    steps = np.linalg.norm(np.diff(nodes[:, :2], axis=0), axis=1)
    parts = int(np.ceil(steps.max() / _SKIN_SPACING - 1e-9))
    t = np.arange(2 * parts) / parts - 1.0  # an element's local coordinate, its end left to the next one
    shapes = np.column_stack((t * (t - 1.0) / 2.0, 1.0 - t**2, t * (t + 1.0) / 2.0))
    elements = np.stack((nodes[:-2:2], nodes[1::2], nodes[2::2]), axis=1)
    along = np.einsum("pk,ekc->epc", shapes, elements).reshape(-1, table.shape[2])
    along = np.concatenate((along, nodes[-1:]))
    return along[:, :2], along[:, 2:]


def _fixed(values: Array) -> Array:
    """Return an array that users of the cached mode cannot change."""
    values = np.array(values)
    values.setflags(write=False)
    return values
