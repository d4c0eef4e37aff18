"""Stiffness of a bearing at a state from the energy in its contacts: friction and centrifugal forces held."""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import C, P, Q, S, Y

_FREEDOMS = 5  # x y z (m), tilts about y and z (rad)
_BALL = _FREEDOMS  # places of a ball's axial and radial place behind them
# m, rad: step of the central differences of the slopes. These turn over the distance of the centres of ball
# and groove, 0.07 mm and more: the relative error of a difference is about (1e-7 / 0.07e-3)^2 = 2e-6, that of
# the stiffness 1e-7 (measured against smaller and larger steps, 7003C and 7009C).
_STEP = 1e-7


def stiffness(p: NDArray[np.float64], s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the stiffness (N/m, N/rad, N m/m, N m/rad) of a bearing at rest in its state, shape (5, 5).

    Rows are forces along x, y, z and moments about y, z on the inner ring, columns its displacements and
    tilts. Each ball is free in its axial plane; centrifugal and friction forces are held, as in
    ``engine.statics.stiffness``. The matrix is that of second derivatives of the energy in the contacts,
    with the motion of the balls eliminated.

    Parameters
    ----------
    p, s : ndarray
        Parameters and state of a perfect bearing with rigid rings, as ``Instance`` has them.
    """
    balls = int(p[P.BALLS])
    y, c = s[S.Y : S.Y + Y.SIZE], s[S.C : S.C + C.SIZE]
    body = y[Y.Q0 : Y.Q0 + Q.SIZE]
    ring = body[Q.INNER : Q.INNER + _FREEDOMS]
    outer = np.concatenate([body[Q.OUTER : Q.OUTER + 3], body[Q.OUTER + Q.BY : Q.OUTER + Q.BZ + 1]])
    angle = y[Y.TH : Y.TH + balls]
    at = np.zeros((balls, _FREEDOMS + 2))
    at[:, _BALL] = y[Y.X : Y.X + balls]
    at[:, _BALL + 1] = p[P.PITCH_RADIUS] + y[Y.R : Y.R + balls]
    curvature = np.zeros((balls, _FREEDOMS + 2, _FREEDOMS + 2))
    for race, pose in enumerate((ring, outer)):
        at[:, :_FREEDOMS] = pose
        second = _curvature(p, c, race, at, angle)
        if race == 1:  # the outer ring is held
            second[:, :_FREEDOMS] = second[:, :, :_FREEDOMS] = 0.0
        curvature += second
    own = curvature[:, _BALL:, _BALL:] + 1e-3 * np.eye(2)  # N/m: a ball that touches nothing stays
    across = curvature[:, :_BALL, _BALL:]
    left = across @ np.linalg.solve(own, np.swapaxes(across, 1, 2))
    return np.asarray((curvature[:, :_BALL, :_BALL] - left).sum(axis=0))


def _curvature(
    p: NDArray[np.float64], c: NDArray[np.float64], race: int, at: NDArray[np.float64],
    angle: NDArray[np.float64],
) -> NDArray[np.float64]:  # fmt: skip
    """Second derivatives of the energy of each ball's contact with a race, shape (balls, 7, 7).

    The energy is 2/5 K d^2.5 with the approach d: 3/2 K d^0.5 times the product of its slopes, and the load
    times its own second derivatives.
    """
    hertz = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    held = c[C.RACES + race * C.RACE_SIZE : C.RACES + (race + 1) * C.RACE_SIZE]
    approach = np.maximum(_approach(held, at, angle).real, 0.0)
    slope = _slopes(held, at, angle)
    bend = np.empty((*slope.shape, slope.shape[1]))
    for k in range(slope.shape[1]):
        step = np.zeros(slope.shape[1])
        step[k] = _STEP
        bend[:, :, k] = (_slopes(held, at + step, angle) - _slopes(held, at - step, angle)) / (2.0 * _STEP)
    load, spring = hertz * approach**1.5, 1.5 * hertz * np.sqrt(approach)
    found = spring[:, None, None] * slope[:, :, None] * slope[:, None, :] + load[:, None, None] * bend
    return np.asarray(found)


def _slopes(
    held: NDArray[np.float64], at: NDArray[np.float64], angle: NDArray[np.float64]
) -> NDArray[np.float64]:
    """First derivatives of the approaches by a complex step, exact to rounding, shape (balls, 7)."""
    steps = 1e-30j * np.eye(at.shape[1])
    return np.stack([_approach(held, at + step, angle).imag for step in steps], axis=1) / 1e-30


def _approach(held: NDArray[np.float64], at: NDArray, angle: NDArray[np.float64]) -> NDArray:  # type: ignore[type-arg]
    """Approach (m) of each ball and a race, negative where they are apart; shape (balls,).

    ``held``: block of the race in the conditions; ``at``: x y z and tilts of the ring, then axial place and
    radius of the ball, shape (balls, 7), real or complex.
    """
    x, radius = at[:, _BALL] - at[:, 0], at[:, _BALL + 1]
    across_y, across_z = -radius * np.sin(angle) - at[:, 1], radius * np.cos(angle) - at[:, 2]
    tilt_y, tilt_z = at[:, 3], at[:, 4]
    # the ring's axis, as engine.mechanics.pose has it
    axial = x * (1.0 - 0.5 * (tilt_y**2 + tilt_z**2)) + across_y * tilt_z - across_z * tilt_y
    apart = np.sqrt(x**2 + across_y**2 + across_z**2 - axial**2)
    distance = np.sqrt((axial - held[C.GROOVE_X]) ** 2 + (apart - held[C.GROOVE_RADIUS]) ** 2)
    return np.asarray(distance - held[C.FREE])
