"""What moves in a mode: kinetic energy by component and pattern, order round the bearing, direction."""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import Q
from fmu_bearing.modal.equations.coordinates import Coordinates

FORWARD, BACKWARD, NEITHER = "forward", "backward", ""
_DOMINATES = 3.0  # ratio of the amplitudes of forward and backward whirl that names a direction
_RINGS = ("inner", "outer")
_BALL_STATES = {"ball": (3, 4), "ball orbit": (5,), "ball spin": (6, 7, 8)}


class Part(NamedTuple):
    """A component that moves in one pattern round the bearing."""

    name: str  # with the order where a component moves in several
    order: int
    forward: float  # J: kinetic energy of the wave with the shaft's direction; all of it for order 0
    backward: float


class Wave(NamedTuple):
    """The pattern round the bearing that carries most of a mode."""

    order: int
    direction: str


def _circular(a: Any, b: Any, mass: Any) -> tuple[Any, Any]:
    """Mean kinetic energies of the forward and the backward wave of a pair of rates, or of arrays of them."""
    # cos(k theta - w t): a = 1, b = -i
    return 0.125 * mass * abs(a + 1j * b) ** 2, 0.125 * mass * abs(a - 1j * b) ** 2


def parts(at: Coordinates, shape: NDArray[np.complex128], turning: float) -> list[Part]:
    """Return the parts of a mode in fixed axes, with their mean kinetic energy.

    Parameters
    ----------
    shape : ndarray
        Eigenvector, complex, for a positive frequency.
    turning : float
        Sign of the shaft's speed: forward is its direction.
    """
    moving = [*_of_rings(at, shape), *_of_flexure(at, shape), *_of_balls(at, shape)]
    if turning < 0.0:
        moving = [
            part._replace(forward=part.backward, backward=part.forward) if part.order else part
            for part in moving
        ]
    return moving


def _of_rings(at: Coordinates, shape: NDArray[np.complex128]) -> Iterator[Part]:
    rates, masses = shape[at.ring_rates : at.flexure], at.masses[at.ring_rates : at.flexure]
    for name, first, tilt in (("inner", Q.INNER, Q.INNER_BY), ("outer", Q.OUTER, Q.OUTER + Q.BY)):
        yield Part(f"{name} axial", 0, 0.25 * masses[first] * abs(rates[first]) ** 2, 0.0)
        for kind, pair in (("radial", first + Q.Y), ("tilt", tilt)):
            yield Part(f"{name} {kind}", 1, *_circular(rates[pair], rates[pair + 1], masses[pair]))
    spin = Q.OUTER + Q.TURN
    yield Part("outer spin", 0, 0.25 * masses[spin] * abs(rates[spin]) ** 2, 0.0)


def _of_flexure(at: Coordinates, shape: NDArray[np.complex128]) -> Iterator[Part]:
    rates, masses = shape[at.flexure_rates :], at.masses[at.flexure_rates :]
    for k, (n, body) in enumerate(zip(at.orders, at.bodies, strict=True)):
        waves = _circular(rates[2 * k], rates[2 * k + 1], masses[2 * k])
        yield _numbered(f"{_RINGS[body]} flexure", n, *waves)


def _numbered(name: str, order: int, forward: float, backward: float) -> Part:
    """Return a part of a component that moves in several orders."""
    return Part(f"{name} n = {order}", order, forward, backward)


def _of_balls(at: Coordinates, shape: NDArray[np.complex128]) -> Iterator[Part]:
    pairs = slice(1, 2 * ((at.balls - 1) // 2), 2), slice(2, at.balls, 2)  # cosine and sine of each order
    for name, kinds in _BALL_STATES.items():
        rates, masses = (np.array([x[at.ball_state(kind)] for kind in kinds]) for x in (shape, at.masses))
        squares = (0.25 * masses * abs(rates) ** 2).sum(axis=0).tolist()
        yield _numbered(name, 0, squares[0], 0.0)
        waves = _circular(rates[:, pairs[0]], rates[:, pairs[1]], masses[:, pairs[1]])
        for k, (ahead, behind) in enumerate(np.sum(waves, axis=1).T.tolist(), start=1):
            yield _numbered(name, k, ahead, behind)
        if at.balls % 2 == 0:
            # it alternates in the orbiting axes, without direction
            yield _numbered(name, at.balls // 2, 0.5 * squares[-1], 0.5 * squares[-1])


def wave(parts: list[Part]) -> Wave:
    """Return the order that carries most energy, and its direction where one whirl dominates."""
    by_order: dict[int, list[float]] = {}
    for part in parts:
        sums = by_order.setdefault(part.order, [0.0, 0.0])
        sums[0] += part.forward
        sums[1] += part.backward
    order = max(by_order, key=lambda n: sum(by_order[n]))
    ahead, behind = (math.sqrt(value) for value in by_order[order])
    if order == 0:
        return Wave(0, NEITHER)
    return Wave(order, whirl(ahead, behind))


def whirl(ahead: float, behind: float) -> str:
    """Return the direction that dominates, by the amplitudes of forward and backward whirl."""
    if ahead > _DOMINATES * behind:
        return FORWARD
    return BACKWARD if behind > _DOMINATES * ahead else NEITHER


def participation(parts: list[Part]) -> dict[str, float]:
    """Return the shares of the kinetic energy by component, the largest first."""
    total = sum(part.forward + part.backward for part in parts) or 1.0
    shares = {part.name: float((part.forward + part.backward) / total) for part in parts}
    return dict(sorted(shares.items(), key=lambda item: -item[1]))


def modal_assurance(
    one: NDArray[np.complex128], other: NDArray[np.complex128], masses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Modal assurance criterion of the rates of each column of ``one`` against each of ``other``.

    Allemang (2003): squared product over the product of squares, here weighed by inertia, ``masses`` of
    shape (n, n), so that the products are energies.
    """
    moving = masses.any(axis=0)  # places have no inertia
    a, b, weights = one[moving], other[moving], masses[np.ix_(moving, moving)]
    moved = weights @ b
    squares = [np.einsum("ik,ik->k", x.conj(), y).real for x, y in ((a, weights @ a), (b, moved))]
    return np.asarray(abs(a.conj().T @ moved) ** 2 / np.maximum(np.outer(*squares), 1e-300))
