"""From a quasi-static state to the steady one that a search from it has found: see ``point``."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, P, Q, W, Y
from fmu_bearing.engine.mechanics.bodies import guiding_ring
from fmu_bearing.engine.steady.point import CARRIED, EVEN_BALLS, NOT_FOUND, REST


@kernel
def shift_to_even(p, y, even):
    """Shift orbit and spins of the state ``y`` by what their means differ from the ``even`` state.

    Places stay: means of unequal loads differ from equal ones. The balls lag in their pockets.
    """
    for row in (Y.OM, Y.WX, Y.WR, Y.WT):
        mean = 0.0
        for j in range(int(p[P.BALLS])):
            mean += y[row + j] / p[P.BALLS]
        for j in range(int(p[P.LANES])):
            y[row + j] += even[row + j] - mean
    if p[P.CAGE] != 0.0:
        y[Y.V0 + Q.CAGE + Q.TURN] = even[Y.OM]
        for j in range(int(p[P.LANES])):
            y[Y.TH + j] += even[Y.TH]


@kernel
def move_to_steady(p, y, outcome, w):
    """Move the quasi-static state ``y`` to the steady one by the ``outcome`` of `point.settle` from it."""
    if outcome == NOT_FOUND or outcome == CARRIED:
        return
    even = w[W.PATTERN + PT.EVEN_STATE : W.PATTERN + PT.REST_STATE]
    if outcome == EVEN_BALLS:
        shift_to_even(p, y, even)
        return
    rest = w[W.PATTERN + PT.REST_STATE : W.PATTERN + PT.WHIRL_STATE]
    if outcome == REST:
        for i in range(Y.SIZE):
            y[i] = rest[i]
        return
    # what whirls does so about where small loads put rings and balls
    whirl = w[W.PATTERN + PT.WHIRL_STATE : W.PATTERN + PT.SIZE]
    for i in range(Y.SIZE):
        y[i] = whirl[i]
    for row in (Y.X, Y.R, Y.VX, Y.VR):
        for j in range(int(p[P.LANES])):
            y[row + j] += rest[row + j] - even[row + j]
    for i in range(Q.CAGE):
        y[Y.Q0 + i] += rest[Y.Q0 + i] - even[Y.Q0 + i]
    k = Y.Q0 + Q.CAGE
    ring, tilt = guiding_ring(p)
    for i in (Q.Y, Q.Z):
        y[k + i] += rest[Y.Q0 + ring + i] - even[Y.Q0 + ring + i]
    for i in range(2):
        y[k + Q.BY + i] += rest[Y.Q0 + tilt + i] - even[Y.Q0 + tilt + i]
