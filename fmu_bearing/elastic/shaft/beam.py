"""Stepped shaft as a chain of Timoshenko beam elements, in one plane.

A round shaft bends in the same way in both planes through its axis: one set of matrices serves both.
Coordinates are deflection w (m) and slope of the section t (rad) of each node, in turn: y and bz in one
plane, z and -by in the other. Elements follow Friedman and Kosmatka (Computers & Structures 47, 1993,
473-481): their shape functions fulfil the static equations of a beam that shears, so loads at nodes bend a
chain of cylinders exactly. Shear coefficients are Cowper's of hollow circles (Journal of Applied Mechanics
33, 1966, 335-340). Sections bend as cylinders up to their ends: the softer corner of a step is not in it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from fmu_bearing.elastic.shaft.sections import Section

SAME = 1e-7  # m: planes closer than this are one node
_PER_LENGTH = 96  # elements along the shaft at least: free modes 1 to 3 within 0.01 %, mode 8 within 0.2 %
_PER_SPAN = 2  # elements at least between two nodes that are asked for
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for products of cubics


@dataclass(frozen=True)
class Beam:
    """Matrices of a free shaft in one plane, at standstill, SI units.

    Attributes
    ----------
    nodes : ndarray, shape (N,)
        Places from the nose, m.
    mass, stiffness : ndarray, shape (2 N, 2 N)
    spin : ndarray, shape (2 N, 2 N)
        What couples the planes at 1 rad/s: + spin times the rates of the plane (z, -by) in the equations of
        (y, bz), - spin the other way.
    sections : tuple of Section
        The cylinder of each element.
    """

    nodes: NDArray[np.float64]
    mass: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    spin: NDArray[np.float64]
    sections: tuple[Section, ...]

    def node(self, position: float) -> int:
        """Return the number of the node at a place (m), which must be one."""
        nearest = int(np.argmin(np.abs(self.nodes - position)))
        if abs(self.nodes[nearest] - position) > SAME:
            raise ValueError(f"there is no node at {position:g} m")
        return nearest

    def motion(self, position: float) -> NDArray[np.float64]:
        """Return deflection and slope at a place (m) per coordinate, shape (2, 2 N); ends go on rigidly."""
        inside = min(max(position, self.nodes[0]), self.nodes[-1])
        k = min(int(np.searchsorted(self.nodes, inside, side="right")) - 1, len(self.nodes) - 2)
        length = float(self.nodes[k + 1] - self.nodes[k])
        rows = np.zeros((2, 2 * len(self.nodes)))
        rows[:, 2 * k : 2 * k + 4] = shapes((inside - self.nodes[k]) / length, length, self.sections[k])
        rows[0] += (position - inside) * rows[1]
        return rows

    def free_frequency(self) -> float:
        """Return the lowest bending frequency without supports, rad/s."""
        # two motions of a rigid body come first
        return math.sqrt(float(eigh(self.stiffness, self.mass, eigvals_only=True)[2]))


def beam(sections: Sequence[Section], planes: Sequence[float] = (), finer: int = 1) -> Beam:
    """Return the chain of a shaft's sections, with nodes at their ends and at planes (m from the nose).

    ``finer``: elements per element; 2 halves them, which shows how much their length matters.
    """
    ends = [sections[0].start, *(one.start + one.length for one in sections)]
    nodes = _nodes([*ends, *planes], ends[-1] / (_PER_LENGTH * finer), _PER_SPAN * finer)
    size = 2 * len(nodes)
    mass, stiffness, spin = (np.zeros((size, size)) for _ in range(3))
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    of = tuple(next(one for one in sections if at <= one.start + one.length) for at in middles)
    for k, section in enumerate(of):
        here = slice(2 * k, 2 * k + 4)
        m, s, p = element(float(nodes[k + 1] - nodes[k]), section)
        mass[here, here] += m
        stiffness[here, here] += s
        spin[here, here] += p
    return Beam(nodes, mass, stiffness, spin, of)


def _nodes(places: Sequence[float], longest: float, fewest: int) -> NDArray[np.float64]:
    """Return places in order, each once, with more between them so that no element is too long."""
    stations: list[float] = []
    for place in sorted(places):
        if not stations or place - stations[-1] > SAME:
            stations.append(place)
    nodes = [stations[0]]
    for start, end in pairwise(stations):
        count = max(fewest, math.ceil((end - start) / longest))
        nodes.extend(start + (end - start) * k / count for k in range(1, count))
        nodes.append(end)
    return np.array(nodes)


def shear_coefficient(bore_ratio: float, poisson_ratio: float) -> float:
    """Return Cowper's shear coefficient of a hollow circle; ``bore_ratio``: inner over outer radius."""
    square = bore_ratio**2
    top = 6.0 * (1.0 + poisson_ratio) * (1.0 + square) ** 2
    return top / ((7.0 + 6.0 * poisson_ratio) * (1.0 + square) ** 2 + (20.0 + 12.0 * poisson_ratio) * square)


def _area(section: Section) -> tuple[float, float]:
    """Return area (m2) and its moment about a diameter (m4)."""
    area = math.pi * (section.radius**2 - section.bore**2)
    return area, 0.25 * area * (section.radius**2 + section.bore**2)


def _shear(length: float, section: Section) -> float:
    """Return how much an element shears against its bending, 12 E I / (k G A L^2)."""
    area, moment = _area(section)
    k = shear_coefficient(section.bore / section.radius, section.poisson_ratio)
    return 24.0 * (1.0 + section.poisson_ratio) * moment / (k * area * length**2)


def shapes(place: float, length: float, section: Section) -> NDArray[np.float64]:
    """Return deflection and slope at a place (0 to 1) of an element per w, t of both nodes, shape (2, 4)."""
    f, x = _shear(length, section), place
    deflection = [
        2 * x**3 - 3 * x**2 - f * x + 1 + f,
        length * (x**3 - (2 + f / 2) * x**2 + (1 + f / 2) * x),
        -2 * x**3 + 3 * x**2 + f * x,
        length * (x**3 - (1 - f / 2) * x**2 - f / 2 * x),
    ]
    slope = [
        6 * (x**2 - x) / length,
        3 * x**2 - (4 + f) * x + 1 + f,
        -6 * (x**2 - x) / length,
        3 * x**2 - (2 - f) * x,
    ]
    return np.array([deflection, slope]) / (1 + f)


def element(
    length: float, section: Section
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return mass, stiffness and spin matrix of an element, each of shape (4, 4)."""
    area, moment = _area(section)
    mass, turning = np.zeros((4, 4)), np.zeros((4, 4))
    for point, weight in zip(_POINTS, _WEIGHTS, strict=True):
        deflection, slope = shapes(0.5 * (1.0 + point), length, section)
        share = 0.5 * weight * length * section.density
        mass += share * (area * np.outer(deflection, deflection) + moment * np.outer(slope, slope))
        turning += share * moment * np.outer(slope, slope)
    f, l = _shear(length, section), length  # noqa: E741
    bending = section.youngs_modulus * moment / ((1.0 + f) * l**3)
    stiffness = bending * np.array(
        [
            [12, 6 * l, -12, 6 * l],
            [6 * l, (4 + f) * l**2, -6 * l, (2 - f) * l**2],
            [-12, -6 * l, 12, -6 * l],
            [6 * l, (2 - f) * l**2, -6 * l, (4 + f) * l**2],
        ]
    )
    return mass, stiffness, 2.0 * turning
