"""What people read of contacts and losses, taken from the rows of the last right-hand side.

Costs nothing inside a step: once per communication point, from what the evaluation there left in ``w``.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    F_HEAT,
    P_BALLS,
    P_DRAG,
    P_DRAG_FACTOR,
    P_PITCH_RADIUS,
    R_AM,
    R_AN,
    R_ENTRAIN,
    R_LOAD,
    R_ROLL,
    R_UM,
    R_UT,
    RACE_ROWS,
    S_F,
    S_LOSS,
    S_SLIP,
    S_SPIN_TO_ROLL,
    S_Y,
    STRIDE,
    W_LOSS,
    W_RACE,
)

_S = STRIDE
_TURNING_2 = 1.0  # rad2/s2: rolling rounded over 1 rad/s, as in the rolling resistance
_ENTRAINED_2 = 1e-8  # m2/s2: entrainment rounded over 1e-4 m/s, likewise


@kernel
def sliding(p, race, w):
    """Spin over rolling and slip at the contact's middle over entrainment, means of the loaded contacts."""
    row = (W_RACE + race * RACE_ROWS) * _S
    spin = 0.0
    slip = 0.0
    loaded = 0.0
    for j in range(int(p[P_BALLS])):
        if w[row + R_LOAD * _S + j] > 0.0:
            an = w[row + R_AN * _S + j]
            am = w[row + R_AM * _S + j]
            ut = w[row + R_UT * _S + j]
            um = w[row + R_UM * _S + j]
            u = w[row + R_ENTRAIN * _S + j]
            spin += abs(an) / math.sqrt(am * am + _TURNING_2)
            slip += math.sqrt((ut * ut + um * um) / (u * u + _ENTRAINED_2))
            loaded += 1.0
    per = 1.0 / max(loaded, 1.0)
    return spin * per, slip * per


@kernel
def drag_loss(p, s):
    """Power (W) that the oil-air mixture takes from the orbiting balls."""
    if p[P_DRAG] == 0.0:
        return 0.0
    total = 0.0
    for j in range(int(p[P_BALLS])):
        around = (p[P_PITCH_RADIUS] + s[S_Y + B_R * _S + j]) * s[S_Y + B_OM * _S + j]
        total += p[P_DRAG_FACTOR] * abs(around) * around * around
    return total


@kernel
def summarise(p, s, w):
    """Sliding of the contacts and losses (W) by source into ``s``.

    ``w`` and the right-hand side in ``s`` must belong to the state in ``s``. Contacts: sliding and contact
    damping; rolling: inlet resistance; cage: pockets and lands, or the dampers between the balls. The cage's
    share is what of the oil's heat is neither half the contacts' nor drag.
    """
    contacts = 0.0
    rolling = 0.0
    for race in range(2):
        row = (W_RACE + race * RACE_ROWS) * _S
        spin, slip = sliding(p, race, w)
        s[S_SPIN_TO_ROLL + race] = spin
        s[S_SLIP + race] = slip
        for j in range(int(p[P_BALLS])):
            contacts += w[(W_LOSS + race) * _S + j]
            rolling -= w[row + R_ROLL * _S + j] * w[row + R_AM * _S + j]
    drag = drag_loss(p, s)
    s[S_LOSS] = contacts - rolling
    s[S_LOSS + 1] = rolling
    s[S_LOSS + 2] = s[S_F + F_HEAT + 2] - 0.5 * contacts - drag
    s[S_LOSS + 3] = drag
