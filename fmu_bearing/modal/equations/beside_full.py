"""A short run of fidelity rings or response beside full: how far rings agree, and what balls do.

Both are linear about one steady state but for the contacts. What they leave out, full has: balls that strike
the pockets of the cage where loads across the axis spread the speeds of their orbits, a whirl that only a
larger motion starts, the force of a whirling cage. No bound of theirs says how much of it a scene has; some
hundredths of a second do.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import RINGS, Arrays
from fmu_bearing.engine.layout import SP, P, Q, S, U, Y
from fmu_bearing.modal.equations.shaft import rows_of
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

_TURN = 2.0 * np.pi
# All chosen. s of simulated time: the start is left out; a slow cage is followed for three turns, or as long
_SAMPLE, _START, _SHORTEST, _LONGEST = 2.5e-5, 0.01, 0.04, 0.1
_TURNS = 3
_ORBIT = 0.4  # of the shaft's speed, about
_OF_PLACES = 8  # samples of velocities to one of the balls' places
_SEEN = 0.1  # of the largest rms: a smaller one does not count
_LEAST = 1e-5  # m/s: with less in full nothing moves
_SPREAD = 0.005  # of the room: with less at the steady state all balls lean on their pockets, waves move them


@dataclass(frozen=True)
class BesideFull:
    """What a short run of a scene shows.

    Attributes
    ----------
    seconds : float
        Simulated.
    ratio : float
        Rms velocity or acceleration of a ring over that in full, the one farthest from 1; 1 where nothing
        moves, and of perfect surfaces, where full shows the whirl of the cage alone.
    what : str
        Which one.
    play : tuple of float, length (bearings)
        Share of the room in their pockets that a ball swings through in full; 0 without a cage, and where
        all balls lean on their pockets at the steady state: there surfaces alone move them.
    """

    seconds: float
    ratio: float
    what: str
    play: tuple[float, ...]


def beside_full(scene: Scene, model: str, inputs: Mapping[int, float] | None = None) -> BesideFull:
    """Run fidelity ``model`` and full for some hundredths of a second, without sound.

    Parameters
    ----------
    scene : Scene
        With rigid rings.
    model : {"rings", "response"}
    inputs : mapping, optional
        Values by their places in ``u`` in place of the scene's, SI units.

    Raises
    ------
    EngineError
        Where there is no equilibrium, or a run has no step to go on with.
    """
    full, quick = (_begun(scene, one, inputs or {}) for one in ("full", model))
    speed = abs(float(full.u[U.SPEED]))
    turns = _TURNS * _TURN / (_ORBIT * speed) if speed > 0.0 else 0.0
    count = math.ceil(min(max(turns, _SHORTEST), _LONGEST) / _SAMPLE)
    play, moved = _followed(full, count)
    ratio, what = 1.0, ""
    if scene.imperfections is not None:
        ratio, what = _farthest(quick.rings(count * _SAMPLE, _SAMPLE), moved, scene)
    return BesideFull(count * _SAMPLE, ratio, what, play)


def _begun(scene: Scene, model: str, inputs: Mapping[int, float]) -> Arrays:
    return Arrays.of(with_fidelity(scene, model=model).model_copy(update={"sound": None})).at(inputs).init()


def _followed(run: Arrays, count: int) -> tuple[tuple[float, ...], NDArray[np.float64]]:
    """Return the balls' play in the pockets of each bearing, and velocities of rings, shape (samples, n)."""
    leaning = [float(np.ptp(one)) < _SPREAD for one in _places(run)]
    velocities, places = [], []
    for _ in range(max(count // _OF_PLACES, 1)):
        velocities.append(run.rings(_OF_PLACES * _SAMPLE, _SAMPLE))
        places.append(_places(run))
    last = places[-max(len(places) // _TURNS, 1) :]
    swings = [float(np.ptp(np.array(one), axis=0).max()) for one in zip(*last, strict=True)]
    play = tuple(0.0 if leans else swing for leans, swing in zip(leaning, swings, strict=True))
    return play, np.concatenate(velocities)


def _farthest(quick: NDArray[np.float64], full: NDArray[np.float64], scene: Scene) -> tuple[float, str]:
    """Return the ratio farthest from 1 of rms velocities and accelerations that count, and which it is."""
    first = round(_START / _SAMPLE)
    ratio, what = 1.0, ""
    for kind, order in (("velocity", 0), ("acceleration", 1)):
        ours, theirs = (np.diff(one[first : len(full)], order, axis=0).std(axis=0) for one in (quick, full))
        least = max(_SEEN * float(theirs.max()), _LEAST / _SAMPLE**order)
        for k in np.flatnonzero(theirs >= least):
            quotient = float(ours[k] / theirs[k])
            if abs(math.log(max(quotient, 1e-12))) > abs(math.log(max(ratio, 1e-12))):
                ring = "inner" if k % RINGS.size < RINGS.size // 2 else "outer"
                bearing = (
                    f" of {scene.assembly.name(int(k) // RINGS.size + 1)}" if scene.assembly.joined else ""
                )
                ratio, what = quotient, f"{kind} of the {ring} ring{bearing} along {'xyz'[k % 3]}"
    return ratio, what


def _places(run: Arrays) -> list[NDArray[np.float64]]:
    """Return the balls' places in their pockets, over the room there, of each bearing; 0 without a cage."""
    rows = rows_of(run.p)
    return [_in_pockets(run.p[int(row[SP.ROW_P]) :], run.s[int(row[SP.ROW_S]) :]) for row in rows]


def _in_pockets(p: NDArray[np.float64], state: NDArray[np.float64]) -> NDArray[np.float64]:
    if p[P.CAGE] == 0.0:
        return np.zeros(1)
    y = state[S.Y : S.Y + Y.SIZE]
    count = int(p[P.BALLS])
    angle = y[Y.TH : Y.TH + count]
    cage = Y.Q0 + Q.CAGE
    ahead = angle - y[cage + Q.TURN] - _TURN * np.arange(count) / count
    ahead = (ahead + np.pi) % _TURN - np.pi
    # pockets go with the cage's centre; at the angle 0 a ball orbits towards -y
    place = p[P.PITCH_RADIUS] * ahead + np.cos(angle) * y[cage + Q.Y] + np.sin(angle) * y[cage + Q.Z]
    return np.asarray(place / (2.0 * p[P.POCKET_CLEARANCE]))
