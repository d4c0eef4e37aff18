"""What is read of a run at equal parts of a revolution: the axis of rotation at a point, the balls' rates."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.instance import Instance
from fmu_bearing.metrology.axis_watch import frequencies, outer_tilt
from fmu_bearing.prepare.model import prepare
from fmu_bearing.results.rates import RatesWatch
from fmu_bearing.run.march import begin, march, to_points, underway
from fmu_bearing.scene import Scene

#: Points per revolution: with 128 in place of 256 the width of the plot read 13 % less (7003C, 2000 r/min).
PER_REVOLUTION = 256
LEFT_OUT = 12  # revolutions at the beginning, in which the start-up dies away
#: Of revolutions that are taken where none are given; a width over fewer than 20 is no asynchronous value.
FEWEST, MOST = 20, 120
_ROUNDING = 1e-6  # revolutions
_AXES = "xyz"


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
        Of each bearing, as its balls ran (Hz); none where that was not read.
    """

    scene: Scene
    revolutions: int
    motion: NDArray[np.float64]
    rates: tuple[KinematicFrequencies, ...]


def nose_of_run(
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
    instance = begin(Instance(prepare(scene.replace({"sound": None}))), inputs or {})
    turn = 60.0 / abs(scene.operation.speed_rpm)
    axis, watch = _axis(scene, instance, at, outer_ring), RatesWatch()
    motion: list[NDArray[np.float64]] = []

    def read() -> float:
        watch(instance)
        motion.append(axis())
        return len(motion) / PER_REVOLUTION

    def follow(turns: int) -> None:
        points = range(len(motion) + 1, len(motion) + turns * PER_REVOLUTION + 1)
        times = (point * turn / PER_REVOLUTION for point in points)
        march(instance, to_points(instance, times), read, proceed)

    what = f"{scene.name}, {scene.operation.speed_rpm:g} r/min"
    with underway(what, LEFT_OUT + (revolutions or MOST), "revolutions", stops=False) as proceed:
        follow(LEFT_OUT)
        count = revolutions or whole_turns(_cage_ratios(scene, watch.rates))
        follow(count)
    first = LEFT_OUT * PER_REVOLUTION
    return Nose(scene, count, np.array(motion[first:]), frequencies(watch.rates[first:], scene))


def resampled(
    scene: Scene, time: NDArray[np.float64], motion: NDArray[np.float64],
    rates: NDArray[np.float64] | None = None,
) -> Nose:  # fmt: skip
    """Return the axis over the last whole revolutions of a run that was read at other times.

    Parameters
    ----------
    scene : Scene
        With the speed of the run, which is constant and not 0.
    time : ndarray, shape (points,)
        Rising (s), from the start of the run, where the shaft's angle is 0: revolutions begin there, as those
        of `nose_of_run` do. Cubic splines lie between; what moves faster than half their rate folds back.
    motion : ndarray, shape (points, 5)
        As of `Nose`.
    rates : ndarray, shape (points, bearings, 2), optional
        As `AxisWatch.rates`: of as many revolutions as there are those are taken in which the cages turn most
        wholly. Without, all are, and the rates of `Nose` are left out.

    Raises
    ------
    ValueError
        For a run of fewer revolutions than an asynchronous value needs.
    """
    turn = 60.0 / abs(scene.operation.speed_rpm)
    ended = int(time[-1] / turn + _ROUNDING)
    count = min(int(ended - time[0] / turn + _ROUNDING), MOST)
    if count < FEWEST:
        raise ValueError(
            f"{count} whole revolutions were kept, and error motion needs {FEWEST}: run for "
            f"{FEWEST * turn:.3g} s or longer"
        )
    if rates is not None:
        count = whole_turns(_cage_ratios(scene, rates), count)
    points = count * PER_REVOLUTION
    wanted = ended * turn - turn / PER_REVOLUTION * np.arange(points - 1, -1, -1)
    within = (time >= wanted[0]) & (time <= wanted[-1])
    found = () if rates is None else frequencies(rates[within], scene)
    return Nose(scene, count, CubicSpline(time, motion)(wanted), found)


def whole_turns(ratios: list[float], most: int = MOST) -> int:
    """Return the revolutions, 20 to ``most``, in which cages of these speeds over the shaft's turn wholly.

    As nearly as any number does: an average over them holds least of what the races make. Of several bearings
    the worst counts.
    """
    counts = np.arange(FEWEST, most + 1)
    turns = counts[:, None] * np.array(ratios)
    off = np.abs(turns - np.rint(turns)).max(axis=1)
    # an average divides what is left by the revolutions
    return int(counts[np.argmin(off / counts)])


def _cage_ratios(scene: Scene, rates: NDArray[np.float64]) -> list[float]:
    """Return the speed of each cage over the shaft's."""
    return [one.f_c / one.f_r for one in frequencies(rates, scene)]


def _axis(scene: Scene, instance: Instance, at: float, outer_ring: bool) -> Callable[[], NDArray[np.float64]]:
    """Return what reads displacement (m) and tilt (rad) of the axis at a point."""
    body = scene.assembly.moving
    names = [f"{body}.displacement.{axis}" for axis in _AXES] + [f"{body}.tilt.{axis}" for axis in _AXES[1:]]
    outer = [f"outer_ring.displacement.{axis}" for axis in _AXES] if outer_ring else []

    take = instance.reader([*names, *outer])

    def read() -> NDArray[np.float64]:
        both = take()
        axis = both[: len(names)]
        if outer:
            axis[:3] -= both[len(names) :]
            axis[3:] -= outer_tilt(instance)
        # a tilt about z carries a point ahead of the middle towards y, one about y away from z
        axis[1] += at * axis[4]
        axis[2] -= at * axis[3]
        return axis

    return read
