"""Sliding and losses, taken from the rows of the last right-hand side.

Costs nothing inside a step: once per communication point, from what the evaluation there left in ``w``.
"""

import math

from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, F, P, Q, R, S, W, Y
from fmu_bearing.engine.mechanics.seals import seal_moment

_TURNING_2 = 1.0  # rad2/s2: rolling rounded over 1 rad/s, as in the rolling resistance
_ENTRAINED_2 = 1e-8  # m2/s2: entrainment rounded over 1e-4 m/s, likewise


@kernel
def sliding(p, race, w):
    """Spin over rolling and slip at the contact's middle over entrainment, means of the loaded contacts."""
    row = W.RACE + race * R.SIZE
    spin = 0.0
    slip = 0.0
    loaded = 0.0
    for j in range(int(p[P.BALLS])):
        if w[row + R.LOAD + j] > 0.0:
            an = w[row + R.AN + j]
            am = w[row + R.AM + j]
            ut = w[row + R.UT + j]
            um = w[row + R.UM + j]
            u = w[row + R.ENTRAIN + j]
            spin += abs(an) / math.sqrt(am * am + _TURNING_2)
            slip += math.sqrt((ut * ut + um * um) / (u * u + _ENTRAINED_2))
            loaded += 1.0
    per = 1.0 / max(loaded, 1.0)
    return spin * per, slip * per


@kernel
def drag_loss(p, s):
    """Power (W) that the oil-air mixture takes from the orbiting balls."""
    if p[P.DRAG] == 0.0:
        return 0.0
    total = 0.0
    for j in range(int(p[P.BALLS])):
        around = (p[P.PITCH_RADIUS] + s[S.Y + Y.R + j]) * s[S.Y + Y.OM + j]
        total += p[P.DRAG_FACTOR] * abs(around) * around * around
    return total


@kernel
def seal_loss(p, s):
    """Power (W) that the seals lose; only fidelity full counts how the outer ring turns."""
    slide = s[S.SPEED]
    if p[P.FIDELITY] == FULL:
        slide -= s[S.Y + Y.V0 + Q.OUTER + Q.TURN]
    return seal_moment(p, slide) * slide


@kernel
def summarise(p, s, w):
    """Sliding of the contacts and losses (W) by source into ``s``.

    ``w`` and the right-hand side in ``s`` must belong to the state in ``s``. Contacts: sliding and contact
    damping; rolling: inlet resistance and hysteresis; cage: pockets and lands, or the dampers between the
    balls. The cage's share is what of the oil's heat is neither half the contacts' nor drag.
    """
    contacts = 0.0
    rolling = 0.0
    for race in range(2):
        row = W.RACE + race * R.SIZE
        spin, slip = sliding(p, race, w)
        s[S.SPIN_TO_ROLL + race] = spin
        s[S.SLIP + race] = slip
        for j in range(int(p[P.BALLS])):
            contacts += w[W.LOSS + race * STRIDE + j]
            rolling -= w[row + R.ROLL + j] * w[row + R.AM + j]
    drag = drag_loss(p, s)
    s[S.LOSS_CONTACTS] = contacts - rolling
    s[S.LOSS_ROLLING] = rolling
    s[S.LOSS_CAGE] = s[S.F + F.HEAT_OIL] - 0.5 * contacts - drag
    s[S.LOSS_DRAG] = drag
