"""Curves of `fits` over speed and temperature, for pictures."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.design.fits import TAKES, Fits
from fmu_bearing.design.mounted import Mounted
from fmu_bearing.instance import EngineError
from fmu_bearing.scene.fit import Take
from fmu_bearing.steady.rest import carried, started, unloaded
from fmu_bearing.threads import one_thread

_SPEEDS = np.linspace(0.0, 1.25, 6)  # shares of the scene's
_WARMTHS = np.linspace(0.0, 1.5, 6)  # shares of its temperatures above 20 degC
_FINE = 41  # points of what is known in closed form
_COLD = 20.0  # degC


@dataclass(frozen=True)
class Axis:
    """Curves of one bearing along one axis, SI units; the first axis of all is the take.

    Attributes
    ----------
    fine, coarse : ndarray
        Places of closed forms, and of what is computed in full: r/min, or degC of the inner ring.
    free_angle : ndarray, shape (5, fine)
        rad.
    held : ndarray, shape (5, coarse)
        Preload (N) without other loads; of a bearing under a constant force its contact angle at the inner
        race (rad).
    interference, hoop : ndarray, shape (5, fine)
        Of the inner ring: m on diameter, Pa; empty without a seat.
    """

    fine: NDArray[np.float64]
    coarse: NDArray[np.float64]
    free_angle: NDArray[np.float64]
    held: NDArray[np.float64]
    interference: NDArray[np.float64]
    hoop: NDArray[np.float64]


@dataclass(frozen=True)
class Curves:
    """Curves of one bearing.

    Attributes
    ----------
    number : int
        From 1.
    held_by_force : bool
        Whether a constant force holds it.
    speed, temperature : Axis
        At the scene's temperatures; at its speed, all parts warm in proportion. None where the inner ring
        of the scene has 20 degC.
    """

    number: int
    held_by_force: bool
    speed: Axis
    temperature: Axis | None


@one_thread
def curves(study: Fits, track: Callable[[Sequence[Take]], Iterable[Take]] = iter) -> tuple[Curves, ...]:
    """Return the curves of each bearing; preloads are computed in full at six places of each axis.

    Raises
    ------
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    """
    if len(study.columns) < len(TAKES):
        raise EngineError(next(remark for remark in study.remarks if remark.startswith("no column: ")))
    count = len(study.columns[0].bearings)
    forced = not study.columns[0].bearings[0].preloads
    over_speed, over_warmth = (np.zeros((len(TAKES), len(_SPEEDS), count)) for _ in range(2))
    for k, take in enumerate(track(TAKES)):
        run = started(study.column(take).point.scene)
        names = [bearing.prefix + "contact.inner.angle_mean" for bearing in study.scene.bearings()]
        for carried_values, shares in (
            (over_speed, [(share, 1.0) for share in _SPEEDS]),
            (over_warmth, [(1.0, share) for share in _WARMTHS]),
        ):
            for i, (speed, warmth) in enumerate(shares):
                at = unloaded(run, float(speed), float(warmth))
                carried_values[k, i] = [at.get(name) for name in names] if forced else carried(at)
    warm = [
        bearing.point.scene.operation.inner_ring_temperature_degC != _COLD
        for bearing in study.columns[0].bearings
    ]
    return tuple(
        Curves(
            number + 1,
            forced,
            _along(study, number, over_speed[:, :, number], _SPEEDS, by_speed=True),
            _along(study, number, over_warmth[:, :, number], _WARMTHS, by_speed=False)
            if warm[number]
            else None,
        )
        for number in range(count)
    )


def _along(
    study: Fits, number: int, carried_values: NDArray[np.float64], shares: NDArray[np.float64], by_speed: bool
) -> Axis:
    """Return the curves of one bearing, from 0, over speed or warmth."""
    fine = np.linspace(shares[0], shares[-1], _FINE)
    own = [column.bearings[number].together for column in study.columns]
    apart = [column.bearings[number].apart for column in study.columns]
    warm = own[0].scene.operation.inner_ring_temperature_degC - _COLD

    def scaled(share: NDArray[np.float64]) -> NDArray[np.float64]:
        return share * own[0].scene.operation.speed_rpm if by_speed else _COLD + share * warm

    def states(one: Mounted) -> list[tuple[float, float]]:
        return [(float(s) * one.speed, 1.0) if by_speed else (one.speed, float(s)) for s in fine]

    angles = [[one.free_angle(*state) for state in states(one)] for one in own]
    seats = [[one.at("inner", *state) for state in states(one)] for one in apart if "inner" in one.seats]
    return Axis(
        scaled(fine),
        scaled(shares),
        np.array(angles),
        carried_values,
        np.array([[2.0 * at.interference for at in row] for row in seats]),
        np.array([[at.hoop for at in row] for row in seats]),
    )
