"""What moves in a mode: kinetic energy by component and pattern, order round the bearing, direction."""

import math
from typing import NamedTuple

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

    name: str
    order: int
    forward: float  # J: kinetic energy of the wave with the shaft's direction; all of it for order 0
    backward: float


class Wave(NamedTuple):
    """The pattern round the bearing that carries most of a mode."""

    order: int
    direction: str


def _circular(a: complex, b: complex, mass: float) -> tuple[float, float]:
    """Mean kinetic energies of the forward and the backward wave of a pair of rates."""
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
    found = list(_of_rings(at, shape)) + list(_of_flexure(at, shape)) + list(_of_balls(at, shape))
    if turning < 0.0:
        found = [
            part._replace(forward=part.backward, backward=part.forward) if part.order else part
            for part in found
        ]
    return found


def _of_rings(at: Coordinates, shape: NDArray[np.complex128]) -> list[Part]:
    rates, masses = shape[at.ring_rates : at.flexure], at.masses[at.ring_rates : at.flexure]
    found = []
    for name, first, tilt in zip(
        _RINGS, (Q.INNER, Q.OUTER), (Q.INNER + Q.INNER_BY, Q.OUTER + Q.BY), strict=True
    ):
        found.append(Part(f"{name} axial", 0, 0.25 * masses[first] * abs(rates[first]) ** 2, 0.0))
        for kind, pair in (("radial", first + Q.Y), ("tilt", tilt)):
            found.append(Part(f"{name} {kind}", 1, *_circular(rates[pair], rates[pair + 1], masses[pair])))
    spin = Q.OUTER + Q.TURN
    found.append(Part("outer spin", 0, 0.25 * masses[spin] * abs(rates[spin]) ** 2, 0.0))
    return found


def _of_flexure(at: Coordinates, shape: NDArray[np.complex128]) -> list[Part]:
    rates, masses = shape[at.flexure_rates :], at.masses[at.flexure_rates :]
    return [
        Part(f"{_RINGS[body]} flexure", n, *_circular(rates[2 * k], rates[2 * k + 1], masses[2 * k]))
        for k, (n, body) in enumerate(zip(at.orders, at.bodies, strict=True))
    ]


def _of_balls(at: Coordinates, shape: NDArray[np.complex128]) -> list[Part]:
    found = []
    for name, kinds in _BALL_STATES.items():
        for first in range(0, at.balls, 2):
            forward = backward = 0.0
            for kind in kinds:
                own = at.ball_state(kind)
                rates, masses = shape[own], at.masses[own]
                if first:
                    ahead, behind = _circular(rates[first - 1], rates[first], masses[first])
                    forward, backward = forward + ahead, backward + behind
                else:
                    forward += 0.25 * masses[0] * abs(rates[0]) ** 2
            found.append(Part(name, first // 2, float(forward), float(backward)))
        if at.balls % 2 == 0:
            last = sum(
                0.25 * at.masses[at.ball_state(kind)][-1] * abs(shape[at.ball_state(kind)][-1]) ** 2
                for kind in kinds
            )
            # it alternates in the orbiting axes, without direction
            found.append(Part(name, at.balls // 2, 0.5 * float(last), 0.5 * float(last)))
    return found


def wave(found: list[Part]) -> Wave:
    """Return the order that carries most energy, and its direction where one whirl dominates."""
    by_order: dict[int, list[float]] = {}
    for part in found:
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


def participation(found: list[Part]) -> dict[str, float]:
    """Return the shares of the kinetic energy by component, the largest first."""
    total = sum(part.forward + part.backward for part in found) or 1.0
    shares: dict[str, float] = {}
    for part in found:
        name = f"{part.name} n = {part.order}" if _is_numbered(part) else part.name
        shares[name] = shares.get(name, 0.0) + float((part.forward + part.backward) / total)
    return dict(sorted(shares.items(), key=lambda item: -item[1]))


def _is_numbered(part: Part) -> bool:
    """Whether a component's order is not told by its name."""
    return part.name.startswith("ball") or part.name.endswith("flexure")
