"""Eigenvalues and vectors of a linearised scene as modes: named, with direction, ringing or apart."""

import math

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.modes.bodies import Bodies
from fmu_bearing.modal.modes.energies import BACKWARD, FORWARD, NEITHER, modal_assurance, participation, wave
from fmu_bearing.modal.modes.mode import GROWS, LOWEST, MOVES, Mode
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.scene import Scene

_SLOW = 1.0  # rad/s: slower in the axes in which it is constant, a motion is neutral
_DAMPED = 0.5  # damping ratio beyond which a motion does not ring
_NEUTRAL = 0.02  # of the orbit: the balls' spins turn over so slowly at high speed
_ORDERS = 2  # of the balls' patterns by which a neutral motion turns in fixed axes where rings move most


def solved(scene: Scene, system: Linearised, friction: bool = True) -> Modes:
    """Return the modes of a linearised scene."""
    scale = _scale(system)
    values, vectors = _eigen(system.matrix, scale)
    spreads = _spreads(system, values, vectors, scale)
    bodies = Bodies(system)
    modes: list[Mode] = []
    apart: list[Mode] = []
    for value, vector, spread in zip(values, vectors.T, spreads, strict=True):
        mode = _mode(system, bodies, scale, value, vector, spread)
        (modes if _is_ringing(system, mode) else apart).append(mode)
    for some in (modes, apart):
        some.sort(key=lambda mode: mode.frequency)
    return Modes(scene, system.speed / RPM, tuple(modes), tuple(apart), system, friction)


def may_grow(matrix: NDArray[np.float64]) -> bool:
    """Whether a motion above 100 Hz grows by itself, from the eigenvalues alone."""
    values = np.linalg.eigvals(matrix)
    return bool(np.any((values.real > GROWS) & (values.imag > 2.0 * math.pi * LOWEST)))


def _scale(system: Linearised) -> NDArray[np.float64]:
    """Return roots of the inertia of rates, and for places of the inertia of their rates: as at 1 rad/s.

    Neutral motions, without rates, have a size by it.
    """
    weights = np.diag(system.masses).copy()
    places, rates = system.pairs
    weights[places] = weights[rates]
    return np.asarray(np.sqrt(weights))


def _eigen(
    matrix: NDArray[np.float64], scale: NDArray[np.float64]
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return eigenvalues with no negative imaginary part, and their vectors, of unit energy by ``scale``."""
    values, vectors = (part.astype(complex) for part in np.linalg.eig(matrix * scale[:, None] / scale))
    kept = values.imag >= 0.0
    return values[kept], vectors[:, kept] / scale[:, None]


def _spreads(
    system: Linearised, values: NDArray[np.complex128], vectors: NDArray[np.complex128],
    scale: NDArray[np.float64],
) -> NDArray[np.float64]:  # fmt: skip
    """Range of each frequency over the phases, over the frequency; modes are followed by their shapes."""
    if system.equal_loads:
        return np.zeros(values.size)
    low = high = values.imag
    for matrix in system.phases:
        others, shapes = _eigen(matrix, scale)
        frequencies = others.imag[modal_assurance(vectors, shapes, system.masses).argmax(axis=1)]
        low, high = np.minimum(low, frequencies), np.maximum(high, frequencies)
    return np.asarray((high - low) / np.maximum(values.imag, _SLOW))


def _mode(
    system: Linearised, bodies: Bodies, scale: NDArray[np.float64], value: complex,
    vector: NDArray[np.complex128], spread: float,
) -> Mode:  # fmt: skip
    """Return the mode of an eigenvalue."""
    moving = bodies.parts(vector)
    energy = sum(part.forward + part.backward for part in moving)
    if energy < 1e-12 * float(np.sum(abs(scale * vector) ** 2)):
        # nothing moves in the balls' own axes: named by the places
        places, rates = system.pairs
        vector = vector.copy()
        vector[rates] = vector[places]
        moving = bodies.parts(vector)
    share = participation(moving)
    order, direction = wave(moving)
    if order == 1 and system.shaft.count:
        direction = bodies.whirl(vector)
    if system.speed == 0.0:
        direction = NEITHER
    shift = {FORWARD: 1.0, BACKWARD: -1.0}.get(direction, 0.0) * order * abs(system.orbit)
    if order == 0.5 * system.bearings[0].coordinates.balls:
        shift = 0.0  # it alternates from ball to ball, in orbiting axes
    size = abs(value)
    damping = -value.real / size if size else 1.0
    return Mode(
        next(iter(share)), float(value.imag) / (2.0 * math.pi), float(damping), order, direction, share,
        float(spread), complex(value), complex(value - 1j * shift), vector,
    )  # fmt: skip


def _is_ringing(system: Linearised, mode: Mode) -> bool:
    """Whether a motion swings by itself, neither overdamped nor neutral in the axes where it is constant."""
    if mode.frequency <= 0.0 or mode.damping > _DAMPED:
        return False
    # what is overdamped for the balls swings in fixed axes at multiples of the cage's frequency
    own = mode.orbiting
    if mode.ring_share <= _DAMPED and -own.real > _DAMPED * abs(own):
        return False
    if mode.ring_share < MOVES and _are_free(system, mode):
        return False
    # Unequal loads mix the patterns, so a neutral motion of the balls is looked for at other orders, too: at
    # low ones where rings take most of the little that moves.
    for bearing in system.bearings:
        most = _ORDERS if mode.ring_share > _DAMPED else bearing.coordinates.balls // 2
        nearest = float(np.min(abs(mode.value - 1j * np.arange(-most, most + 1) * bearing.orbit)))
        if nearest < max(_SLOW, _NEUTRAL * abs(bearing.orbit)):
            return False
    return True


def without_needles(
    system: Linearised, values: NDArray[np.complex128], vectors: NDArray[np.complex128]
) -> NDArray[np.complex128]:
    """Return eigenvalues; those of nearly undamped motions of `Modes.apart` have a damping of `_DAMPED`.

    They are neutral motions of balls that turn with them: their spins turn over within seconds or never.
    """
    found, bodies, scale = values.astype(complex), Bodies(system), _scale(system)
    orbit = min(abs(bearing.orbit) for bearing in system.bearings)
    swings = (values.imag > 0.5 * orbit) & (abs(values.real) < max(_SLOW, _NEUTRAL * orbit))
    for k in np.flatnonzero(swings) if orbit else ():
        mode = _mode(system, bodies, scale, values[k], vectors[:, k], 0.0)
        if not _is_ringing(system, mode):
            calm = abs(values[k]) * complex(-_DAMPED, math.sqrt(1.0 - _DAMPED**2))
            found[values == values[k].conjugate()] = calm.conjugate()
            found[values == values[k]] = calm
    return found


def _are_free(system: Linearised, mode: Mode) -> bool:
    """Whether balls that move alone are put apart: all of a set, of a bearing motions along their orbits.

    Along the orbits the cage holds the balls, which is left out.
    """
    along = mode.name.startswith(("ball orbit", "ball spin"))
    return system.shaft.count > 0 or along and not system.bearings[0].arrays.p[P.SPRINGS]
