"""The classical method of Kutta (1901): explicit, and it knows the right-hand side only.

Its state is that of the engine, with the balls' body-fixed axes behind it: a' = (w - theta' e_x) x a. The
directions of local defects on balls follow, which turn the same way.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import DE, FOUR, MAX_DEFECTS, STRIDE, F, J, P, Q, W, Y
from fmu_bearing.engine.mechanics.ball_waves import turning
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.triples import cross, store_three, three

AXES = Y.SIZE  # the balls' body-fixed axes (3 rows) in the state
DIRECTIONS = AXES + 3 * STRIDE  # of the defects on balls, three numbers for each defect
SIZE = DIRECTIONS + DE.VECTOR * MAX_DEFECTS
# rows of scratch: rates at four places, the state at the next of them, right-hand side
_LAST, _NEW, _F, ROWS = 3, 4, 5, 6


@kernel
def _turn_directions(p, y, w, k):
    """Rates into ``k`` of the directions of defects on balls, which go to ``W.DEFECT_AXES``, too."""
    for i in range(DIRECTIONS, SIZE):
        k[i] = 0.0
    for n in range(int(p[P.DEFECTS])):
        head = int(p[P.AT_DEFECTS]) + n * DE.SIZE
        if p[head + DE.ON] == DE.BALL:
            j = int(p[head + DE.OF_BALL])
            at = DIRECTIONS + DE.VECTOR * n
            to = W.DEFECT_AXES + DE.VECTOR * n
            spin = (y[Y.WX + j] - y[Y.OM + j], y[Y.WR + j], y[Y.WT + j])
            x, r, t = cross(spin, (y[at], y[at + 1], y[at + 2]))
            k[at] = x
            k[at + 1] = r
            k[at + 2] = t
            for i in range(DE.VECTOR):
                w[to + i] = y[at + i]


@kernel
def _rates(p, c, y, angle, speed, w, f, k):
    """Rates of ``y`` into ``k``, both with the spare lanes of ``layout``."""
    lanes = int(p[P.LANES])
    for j in range(0, lanes, FOUR):
        axis = three(y, AXES + j)
        store_three(w, W.AXES + j, axis)
        store_three(k, AXES + j, cross(turning(y, j), axis))
    _turn_directions(p, y, w, k)
    right_hand_side(p, c, y, angle, speed, 0.0, w, f)
    for i in range(J.PLACED):
        for j in range(lanes):
            k[i * STRIDE + j] = y[Y.VX + i * STRIDE + j]
    for i in range(J.BALL):
        for j in range(lanes):
            k[Y.VX + i * STRIDE + j] = f[i * STRIDE + j]
    for i in range(Q.SIZE):
        k[Y.Q0 + i] = y[Y.V0 + i]
        k[Y.V0 + i] = f[F.BODY + i]


@kernel
def _moved(y, a, k, out):
    """``out = y + a k``."""
    for i in range(SIZE):
        out[i] = y[i] + a * k[i]


@kernel
def runge_kutta(p, c, y, angle, speed, h, steps, w, k):
    """Take ``steps`` steps of ``h`` (s) by the classical method of Kutta (1901), in place on ``y``.

    ``y``: ``SIZE`` numbers; ``angle`` (rad) of the shaft at the start, ``speed`` (rad/s) constant; ``k``:
    scratch, ``ROWS`` x ``SIZE``.
    """
    f = k[_F]
    new = k[_NEW]
    for n in range(steps):
        at_start = angle + speed * (n * h)
        at_middle = angle + speed * ((n + 0.5) * h)
        at_end = angle + speed * ((n + 1) * h)
        _rates(p, c, y, at_start, speed, w, f, k[0])
        _moved(y, 0.5 * h, k[0], new)
        _rates(p, c, new, at_middle, speed, w, f, k[1])
        _moved(y, 0.5 * h, k[1], new)
        _rates(p, c, new, at_middle, speed, w, f, k[2])
        _moved(y, h, k[2], new)
        _rates(p, c, new, at_end, speed, w, f, k[_LAST])
        for i in range(SIZE):
            y[i] += h / 6.0 * (k[0, i] + 2.0 * (k[1, i] + k[2, i]) + k[_LAST, i])
