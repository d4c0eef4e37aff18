"""Dynamic stiffness in the axes of the orbiting balls: one ball, circular motions of the ring.

The oracle of `stiffness`. A forward circle of frequency w in fixed axes has w - w_c in axes that orbit with
the balls, a backward one w + w_c. There every ball does the same after its own time, so that one is enough.
The slopes are the engine's own, derived contact by contact; fixed axes and patterns of balls do not occur.
"""

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, J, P, Q, S, Y
from tests.engine.helpers import TILT_DAMPING, TILT_STIFFNESS

_PLACED = slice(0, J.PLACED)
_PAIR = ((Q.Y, Q.INNER_BY), (Q.Z, Q.INNER_BZ))


def blocks(system):
    """Slopes of ball 0's rates by its states and the inner ring's, and of the ring's rates by both."""
    arrays = system.arrays
    p, c = arrays.p, arrays.s[S.C : S.C + C.SIZE].copy()
    y, jac = arrays.s[S.Y : S.Y + Y.SIZE].copy(), np.zeros(J.SIZE)
    assert abs(y[Y.TH]) < 1e-9  # at 12 o'clock its axes are the axes of the rings
    call("jacobian", p, c, y, np.zeros(arrays.w.size), jac, 0.0, system.speed, 0.0)

    def block(first, rows, columns):
        return jac[first : first + rows * columns * STRIDE].reshape(rows, columns, STRIDE)[:, :, 0]

    ball = np.zeros((J.STATES, J.STATES))
    ball[_PLACED, J.PLACED : 2 * J.PLACED] = np.eye(J.PLACED)
    ball[J.PLACED :] = block(J.B, J.BALL, J.STATES)
    by_ring = np.zeros((J.STATES, J.BODIES))
    by_ring[J.PLACED :] = block(J.C, J.BALL, J.BODIES)
    on_ring = block(J.D, Q.SIZE, J.STATES)
    ring = jac[J.E : J.E + Q.SIZE * J.BODIES].reshape(Q.SIZE, J.BODIES)
    return ball, by_ring, on_ring, ring


def circling(system, w, way, spacing="held"):
    """Stiffness against a circle at w (rad/s), +1 forward or -1 backward: radial and tilt, shape (2, 2)."""
    p, masses = system.arrays.p, system.coordinates.masses[system.coordinates.ring_rates :]
    ball, by_ring, on_ring, ring = blocks(system)
    if spacing == "held":
        ball[J.PLACED :, 2] = on_ring[:, 2] = 0.0
    s = 1j * (w - way * system.orbit)
    found = np.empty((2, 2), dtype=complex)
    for k in range(2):
        move = np.zeros(J.BODIES, dtype=complex)
        move[_PAIR[0][k]], move[_PAIR[1][k]] = 1.0, -1j * way
        move[Q.SIZE :] = 1j * w * move[: Q.SIZE]
        answer = np.linalg.solve(s * np.eye(J.STATES) - ball, by_ring @ move)
        # of what one ball does the circle of this way alone is left of all of them
        one, all_of_them = on_ring @ answer, ring @ move
        for i in range(2):
            first, second = _PAIR[0][i], _PAIR[1][i]
            through = 0.5 * p[P.BALLS] * (one[first] + 1j * way * one[second])
            direct = 0.5 * (all_of_them[first] + 1j * way * all_of_them[second])
            found[i, k] = -masses[first] * (through + direct)
    support = p[TILT_STIFFNESS][0] + 1j * w * p[TILT_DAMPING][0]
    found[1, 1] -= support + way * w * p[P.INNER_POLAR] * system.speed
    return found


def along(system, w):
    """Axial dynamic stiffness (N/m) at w (rad/s)."""
    ball, by_ring, on_ring, ring = blocks(system)
    move = np.zeros(J.BODIES, dtype=complex)
    move[Q.X], move[Q.SIZE + Q.X] = 1.0, 1j * w
    answer = np.linalg.solve(1j * w * np.eye(J.STATES) - ball, by_ring @ move)
    mass = system.arrays.p[P.INNER_MASS]
    return -mass * (system.arrays.p[P.BALLS] * (on_ring @ answer)[Q.X] + (ring @ move)[Q.X])
