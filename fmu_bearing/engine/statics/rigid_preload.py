"""Rigid preload: the inner ring's axial place is prescribed instead of its axial force.

The place is where the ring is at standstill and reference temperature under the preload, with its fits or
without them (``P.UNMOUNTED``): the static curve of the bearing plus the pedestal's deflection. Speed and
temperature then change the contact loads, not the place. A new preload moves the ring to its new place at
constant speed over one communication step. Offsets of a set's bearings are such places, too.
"""

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import ST, C, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions, take_fit_growth_out
from fmu_bearing.engine.statics.axial import quasistatic
from fmu_bearing.engine.status import OK


@kernel
def place_under(p, c, speed, eq):
    """Axial place (m) of the inner ring under the preload in ``c``, pedestal included; second: status."""
    status = quasistatic(p, c, speed, eq)
    place = eq[ST.AXIAL_SHIFT]
    if c[C.PEDESTAL_AXIAL] != 0.0:  # a seat in the housing gives no way
        place += c[C.PRELOAD] / c[C.PEDESTAL_AXIAL]
    return place, status


@kernel
def cold_place(p, u, load, w):
    """Axial place (m) of the inner ring under a ``load`` (N) at standstill and reference temperature; status.

    ``u``: inputs of this bearing, for what does not depend on either.
    """
    still = w[W.STILL_INPUTS : W.STILL_CONDITIONS]
    c = w[W.STILL_CONDITIONS : W.STILL_EQUILIBRIUM]
    eq = w[W.STILL_EQUILIBRIUM : W.STILL_END]
    for i in range(U.SIZE):
        still[i] = u[i]
    still[U.SPEED] = 0.0
    for i in range(U.SHAFT_T, U.SIZE):
        still[i] = REFERENCE_TEMPERATURE
    conditions(p, still, 0.0, c)
    take_fit_growth_out(p, c)
    c[C.PRELOAD] = load
    return place_under(p, c, 0.0, eq)


@kernel
def axial_speed(p, u, fresh, s, w, h):
    """Axial speed (m/s) of the inner ring over the communication step ``h`` (s) that now begins.

    ``fresh``: the new conditions; the old ones in ``s`` show whether the preload has changed. Where the
    static equilibrium is not found the ring stays.
    """
    if fresh[C.PRELOAD] != s[S.C + C.PRELOAD]:
        place, status = cold_place(p, u, u[U.PRELOAD], w)
        if status == OK:
            s[S.PLACE] = place
    away = s[S.PLACE] - s[S.Y + Y.Q0]
    # rounding of the place is not worth a new speed, which would cost an evaluation each step
    if abs(away) < 1e-15:
        return 0.0
    return away / h
