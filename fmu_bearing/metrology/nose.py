"""What is read of a run at equal parts of a revolution: the axis of rotation at a point, the balls' rates."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.layout import P, Q, S, Y
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.lengths import parts_of
from fmu_bearing.prepare.model import prepare
from fmu_bearing.progress import work
from fmu_bearing.scene import Scene

#: Points per revolution: with 128 in place of 256 the width of the plot read 13 % less (7003C, 2000 r/min).
PER_REVOLUTION = 256
LEFT_OUT = 12  # revolutions at the beginning, in which the start-up dies away
#: Of revolutions that are taken where none are given; a width over fewer than 20 is no asynchronous value.
FEWEST, MOST = 20, 120
_AXES = "xyz"
_OUTER = S.Y + Y.Q0 + Q.OUTER
_AT_TILT = _OUTER + Q.BY  # rad, about y and z


@dataclass(frozen=True)
class Nose:
    """The axis of rotation over whole revolutions at constant speed.

    Attributes
    ----------
    scene : Scene
        With the speed of the run.
    revolutions : int
    motion : ndarray, shape (revolutions * PER_REVOLUTION, 5)
        Displacement (m) along x, y and z at the point, and tilt (rad) about y and z.
    rates : tuple of KinematicFrequencies
        Of each bearing, as its balls ran (Hz).
    """

    scene: Scene
    revolutions: int
    motion: NDArray[np.float64]
    rates: tuple[KinematicFrequencies, ...]


def followed(
    scene: Scene, at: float, revolutions: int | None, outer_ring: bool,
    inputs: Mapping[str, float] | None = None,
) -> Nose:  # fmt: skip
    """Run a scene at its speed from its steady state and read the axis at a point.

    Parameters
    ----------
    scene : Scene
        Its fidelity is not ``auto``, its speed not 0.
    at : float
        Place of the point along X (m): from the middle of a single bearing, from the nose of a set.
    revolutions : int, optional
        Default: `whole_turns` of the cages.
    outer_ring : bool
        Whether motion counts from the outer ring of a single bearing; else from the ground.
    inputs : mapping, optional
        Inputs in place of the scene's, SI units.

    Raises
    ------
    EngineError
        Where there is no equilibrium, or a step is refused.
    """
    instance = Instance(prepare(scene.replace({"sound": None})))
    for name, value in (inputs or {}).items():
        instance.set(name, float(value))
    instance.initialise()
    turn = 60.0 / abs(scene.operation.speed_rpm)
    read = _axis(scene, instance, at, outer_ring)
    balls = _Balls(instance)
    what = f"{scene.name}, {scene.operation.speed_rpm:g} r/min"
    with work(what, float(LEFT_OUT + (revolutions or MOST)), "revolutions") as bar:
        for done in range(LEFT_OUT * PER_REVOLUTION):
            instance.step((done + 1) * turn / PER_REVOLUTION - instance.time)
            balls.read()
            bar.at(done / PER_REVOLUTION)
        count = revolutions or whole_turns([cage for cage, _ in balls.ratios()])
        balls = _Balls(instance)
        motion = np.empty((count * PER_REVOLUTION, 5))
        for done in range(len(motion)):
            now = LEFT_OUT * PER_REVOLUTION + done + 1
            instance.step(now * turn / PER_REVOLUTION - instance.time)
            motion[done] = read()
            balls.read()
            bar.at(now / PER_REVOLUTION)
    return Nose(scene, count, motion, balls.rates(1.0 / turn))


def resampled(scene: Scene, time: NDArray[np.float64], motion: NDArray[np.float64]) -> Nose:
    """Return the axis over the last whole revolutions of a run that was read at other times.

    Parameters
    ----------
    scene : Scene
        With the speed of the run, which is constant and not 0.
    time : ndarray, shape (points,)
        Rising (s); cubic splines lie between. What moves faster than half their rate folds back.
    motion : ndarray, shape (points, 5)
        As of `Nose`, whose rates are left out.

    Raises
    ------
    ValueError
        For a run of fewer revolutions than an asynchronous value needs.
    """
    turn = 60.0 / abs(scene.operation.speed_rpm)
    count = min(int((time[-1] - time[0]) / turn), MOST)
    if count < FEWEST:
        raise ValueError(
            f"{count} whole revolutions were kept, and error motion needs {FEWEST}: run for "
            f"{FEWEST * turn:.3g} s or longer"
        )
    points = count * PER_REVOLUTION
    wanted = time[-1] - turn / PER_REVOLUTION * np.arange(points - 1, -1, -1)
    return Nose(scene, count, CubicSpline(time, motion)(wanted), ())


def whole_turns(ratios: list[float]) -> int:
    """Return the revolutions, 20 to 120, in which cages of these speeds over the shaft's turn most wholly.

    An average over them holds least of what the races make. Of several bearings the worst counts.
    """
    counts = np.arange(FEWEST, MOST + 1)
    turns = counts[:, None] * np.array(ratios)
    off = np.abs(turns - np.rint(turns)).max(axis=1)
    # an average divides what is left by the revolutions
    return int(counts[np.argmin(off / counts)])


def _axis(scene: Scene, instance: Instance, at: float, outer_ring: bool) -> Callable[[], NDArray[np.float64]]:
    """Return what reads displacement (m) and tilt (rad) of the axis at a point."""
    single = scene.spindle is None
    body = "inner_ring" if single else "shaft.nose"
    names = [f"{body}.displacement.{axis}" for axis in _AXES] + [f"{body}.tilt.{axis}" for axis in _AXES[1:]]
    outer = [f"outer_ring.displacement.{axis}" for axis in _AXES] if single and outer_ring else []

    def read() -> NDArray[np.float64]:
        found = np.array([instance.get(name) for name in names])
        if outer:
            found[:3] -= [instance.get(name) for name in outer]
            found[3:] -= instance.s[_AT_TILT : _AT_TILT + 2]
        # a tilt about z carries a point ahead of the middle towards y, one about y away from z
        found[1] += at * found[4]
        found[2] -= at * found[3]
        return found

    return read


class _Balls:
    """Mean orbit and spin of the balls of each bearing, over the points that were read."""

    def __init__(self, instance: Instance) -> None:
        self._instance = instance
        self._parts = [(instance.p[at_p], at_s) for at_p, at_s in parts_of(instance.p)]
        self._sums = np.zeros((len(self._parts), 2))
        self._count = 0

    def read(self) -> None:
        """Read the present rates."""
        for sums, (p, part) in zip(self._sums, self._parts, strict=True):
            rows = self._instance.s[part]
            count = int(p[P.BALLS])
            orbit, about_x, about_r, about_t = (
                rows[S.Y + row : S.Y + row + count] for row in (Y.OM, Y.WX, Y.WR, Y.WT)
            )
            # spins are absolute: a wave of a ball passes a race by the spin in the axes that orbit
            spin = np.sqrt((about_x - orbit) ** 2 + about_r**2 + about_t**2)
            sums += np.abs(orbit.mean()), spin.mean()
        self._count += 1

    def ratios(self) -> list[tuple[float, float]]:
        """Return orbit and spin over the shaft's speed of each bearing."""
        speed = abs(float(self._instance.s[S.SPEED]))
        return [(float(cage) / speed, float(spin) / speed) for cage, spin in self._sums / self._count]

    def rates(self, shaft: float) -> tuple[KinematicFrequencies, ...]:
        """Return the frequencies (Hz) of each bearing at ``shaft`` turns per second."""
        return tuple(
            KinematicFrequencies(
                shaft, cage * shaft, spin * shaft, int(p[P.BALLS]) * (1.0 - cage) * shaft,
                int(p[P.BALLS]) * cage * shaft,
            )
            for (cage, spin), (p, _) in zip(self.ratios(), self._parts, strict=True)
        )  # fmt: skip
