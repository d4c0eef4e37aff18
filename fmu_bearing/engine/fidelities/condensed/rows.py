"""The rings' coordinates and the balls' force components; the balls' places between ``lv`` and ``w``."""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, L, P, S, T
from fmu_bearing.engine.mechanics.trigonometry import wrap


@kernel
def coordinate(i):
    """Coordinate of the rings that component ``i`` of the balls' forces acts on: see ``L.FORCES``."""
    return i if i < L.TURN else i + 1


@kernel
def component(i):
    """Component of the balls' forces that acts on coordinate ``i`` of the rings, which is not ``L.TURN``."""
    return i if i < L.TURN else i - 1


@kernel
def show_balls(lv, at, w):
    """Copy the balls' places from row ``at`` of ``lv`` and the next to the trial rows."""
    for i in range(2 * STRIDE):
        w[T.X + i] = lv[at + i]


@kernel
def keep_balls(w, lv, at):
    """Copy the balls' places from the trial rows to row ``at`` of ``lv`` and the next."""
    for i in range(2 * STRIDE):
        lv[at + i] = w[T.X + i]


@kernel
def from_equilibrium(p, lv, theta, w):
    """Balls' places between those at the equilibrium, for ball 0 at ``theta`` (rad): linear in the angle."""
    balls = int(p[P.BALLS])
    turned = theta * balls / (2.0 * PI)
    whole = math.floor(turned)
    part = turned - whole
    for j in range(STRIDE):  # spare lanes, too: leftovers of the work space must not get into the state
        near = int((j + whole) % balls)
        next_one = (near + 1) % balls
        for i in range(2):
            row = L.EVEN + i * STRIDE
            w[T.X + i * STRIDE + j] = (1.0 - part) * lv[row + near] + part * lv[row + next_one]


@kernel
def turn_balls(s, h):
    """Orbit and own turning after the time ``h`` (s), within one turn, where their rounding does not grow."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    theta, rolled, _, _ = angles_at(s, h)
    lv[L.THETA] = wrap(theta)
    lv[L.ROLLED] = wrap(rolled)


@kernel
def angles_at(s, ahead):
    """Angles (rad) of ball 0, of the balls' turning and of the shaft at ``ahead`` (s), and its speed."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    turned = ahead * (s[S.SPEED] + 0.5 * ahead * s[S.SPEED_RATE])
    theta = lv[L.THETA] + lv[L.RATIO] * turned
    rolled = lv[L.ROLLED] + lv[L.ROLL] * turned
    return theta, rolled, s[S.ANGLE] + turned, s[S.SPEED] + ahead * s[S.SPEED_RATE]
