"""Motions of a ring on which an assembly is built: rigid ones and elastic modes of every order."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from examples.papers.assembly.free import check_reach, modes_below
from fmu_bearing.elastic.fourier import Elastic, Solid
from fmu_bearing.elastic.modes import family, meshed
from fmu_bearing.elastic.section import OUTER, RACES, Section

Array = NDArray[np.float64]

_X, _R, _T = range(3)
#: Highest circumferential order: half a wave of it is 3.4 mm at a pitch diameter of 26 mm.
ORDERS = 12
_COS, _SIN = 0, 1


@dataclass(frozen=True, eq=False)
class RingBasis:
    """Motions of a ring, one column each, with the package's signs: a before b of one shape.

    Attributes
    ----------
    section : Section
        Of the ring.
    parts : tuple of str, length c
        ``inner axial``, ``inner spin``, ``inner radial``, ``inner tilt`` or ``inner flexure n = 2``...
    order, phase : ndarray of int, shape (c,)
        Circumferential order n; 0 for the coordinate a, 1 for b.
    frequency, mass : ndarray, shape (c,)
        Hz, 0 for rigid motion; modal mass in kg (rotations: kg m2).
    race_points : ndarray, shape (nodes, 2)
        Nodes (x, r) in m of the surface with the groove.
    race : ndarray, shape (c, nodes, 3)
        Shapes psi (x, r, t) there.
    """

    section: Section
    parts: tuple[str, ...]
    order: NDArray[np.int64]
    phase: NDArray[np.int64]
    frequency: Array
    mass: Array
    race_points: Array
    race: Array

    def at(self, across: float, along: float, azimuth: float) -> tuple[Array, Array]:
        """Return a point of the groove and its motion, in the axes x, r, t of an azimuth.

        Parameters
        ----------
        across, along : float
            Distance (m) from where the unloaded ball touches: on the groove's circle towards +x, and
            along the race.
        azimuth : float
            Angle theta (rad) of the ball.

        Returns
        -------
        place : ndarray (3,)
            x, r, t in m, from the bearing's centre.
        motion : ndarray (3, c)
            Displacement in m for each coordinate.
        """
        groove = self.section.groove
        assert groove is not None
        x = groove.x + groove.radius * math.sin(groove.angle + across / groove.radius)
        nodes = self.race_points[:, 0]
        first = 2 * min(max(int(np.searchsorted(nodes[::2], x)) - 1, 0), len(nodes) // 2 - 1)
        share = _lagrange(nodes[first : first + 3], x)
        x, r = share @ self.race_points[first : first + 3]
        ahead = along / r
        psi = np.einsum("k,ckd->dc", share, self.race[:, first : first + 3])
        wave = self.order * (azimuth + ahead)
        cosine, sine = np.cos(wave), np.sin(wave)
        level = np.where(self.phase == _COS, cosine, sine)
        swing = np.where(self.phase == _COS, sine, -cosine)
        local = np.vstack((psi[:2] * level, psi[_T] * swing))
        c, s = math.cos(ahead), math.sin(ahead)
        turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        return turn @ np.array([x, r, 0.0]), turn @ local


def _lagrange(nodes: Array, x: float) -> Array:
    """Weights of three nodes for the quadratic through them."""
    a, b, c = nodes
    return np.array(
        [
            (x - b) * (x - c) / ((a - b) * (a - c)),
            (x - a) * (x - c) / ((b - a) * (b - c)),
            (x - a) * (x - b) / ((c - a) * (c - b)),
        ]
    )


def wall_limit(section: Section, material: Elastic) -> float:
    """Frequency (Hz) at which half a shear wave is as long as the ring's mean wall is thick.

    The springs of a patch already carry what yields near a contact, as in half spaces; a ring's modes have to
    carry what its wall of finite thickness adds. The mean wall has the grooved ring's volume.
    """
    seat, sign = (section.high, 1.0) if section.body == OUTER else (section.low, -1.0)
    wall = sign * (seat - math.sqrt(seat**2 - sign * 2.0 * section.moment / section.width))
    return math.sqrt(material.shear_modulus / material.density) / (2.0 * wall)


@lru_cache(maxsize=32)
def ring_basis(
    section: Section, material: Elastic, held: bool = False, highest: float | None = None
) -> RingBasis:
    """Motions of a ring up to a frequency (Hz) and the order `ORDERS`.

    Parameters
    ----------
    held : bool
        Whether the seat's cylinder is fixed in all directions; the ring then has no rigid motion.
    highest : float, optional
        By default `wall_limit`; 0 leaves rigid motions alone.

    Raises
    ------
    ValueError
        When the frequency is negative or beyond the mesh's reach.
    MissingExtra
        Without scikit-fem (extra ``elastic``).
    """
    if highest is None:
        highest = wall_limit(section, material)
    if highest != 0.0:
        check_reach(section, material, highest)
    ring = meshed(section, material)
    found = [] if held else _rigid(ring)
    name = RACES[section.body]
    for n in range(ORDERS + 1 if highest else 0):
        for frequency, shape in zip(*_columns(ring, n, highest, held), strict=True):
            for phase in _phases(ring, n, shape):
                found.append((f"flexure n = {n}", n, phase, float(frequency), shape))
    line = ring.nodes[:, ring.grid.race_row]
    shapes = np.array([entry[4] for entry in found]).reshape(-1, ring.mass.shape[0])
    order = np.array([entry[1] for entry in found], dtype=np.int64)
    mass = np.einsum("cu,cu->c", shapes, (ring.mass @ shapes.T).T) * np.pi * np.where(order == 0, 2.0, 1.0)
    return RingBasis(
        section=section,
        parts=tuple(f"{name} {entry[0]}" for entry in found),
        order=order,
        phase=np.array([entry[2] for entry in found], dtype=np.int64),
        frequency=np.array([entry[3] for entry in found]),
        mass=mass,
        race_points=ring.points[:, ring.grid.race_row],
        race=shapes[:, line],
    )


def _columns(ring: Solid, order: int, highest: float, held: bool) -> tuple[Array, Array]:
    """Elastic modes of one order: frequencies, and shapes in rows."""
    frequencies, shapes = modes_below(ring, order, highest, held)
    elastic = frequencies > 0.0
    return frequencies[elastic], shapes.T[elastic]


def _phases(ring: Solid, order: int, shape: Array) -> tuple[int, ...]:
    """Coordinates of a shape: both of order 1 and above; of order 0 the one that moves anything."""
    if order:
        return _COS, _SIN
    return (_SIN,) if family(ring, 0, shape) == "torsion" else (_COS,)


def _rigid(ring: Solid) -> list[tuple[str, int, int, float, Array]]:
    """Six rigid motions about the centre of mass, so that no two share mass."""
    x, r = ring.points[..., 0], ring.points[..., 1]
    one = np.ones_like(x)

    def shape(**components: Array) -> Array:
        made = np.zeros(ring.mass.shape[0])
        for index, key in enumerate("xrt"):
            made[ring.nodes[..., index]] = components.get(key, 0.0 * x)
        return made

    axial, radial = shape(x=one), shape(r=one, t=-one)
    middle = float(axial @ ring.mass @ shape(x=x)) / float(axial @ ring.mass @ axial)
    tilt = shape(x=r, r=middle - x, t=x - middle)
    return [
        ("axial", 0, _COS, 0.0, axial),
        ("spin", 0, _SIN, 0.0, shape(t=r)),
        *(("radial", 1, phase, 0.0, radial) for phase in (_COS, _SIN)),
        *(("tilt", 1, phase, 0.0, tilt) for phase in (_COS, _SIN)),
    ]
