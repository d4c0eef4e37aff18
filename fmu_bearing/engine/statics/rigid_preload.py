"""Rigid preload: the inner ring's axial place is prescribed instead of its axial force.

The place is where the ring is at standstill and reference temperature under the preload, with its fits or
without them (``P.UNMOUNTED``): the static curve of the bearing plus the pedestal's deflection. Speed and
temperature then change the contact loads, not the place. A new preload moves the ring to its new place at
constant speed over one communication step. Offsets of a set's bearings are such places, too.
"""

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import ST, C, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions, unmount
from fmu_bearing.engine.statics.axial import quasistatic
from fmu_bearing.engine.status import OK

_ROUNDS = 60
TOUCHING = 0.01  # N: without preload the ring is where the balls just touch, not anywhere free


@kernel
def place_under(p, c, speed, found):
    """Axial place (m) of the inner ring under the preload in ``c``, pedestal included; second: status."""
    status = quasistatic(p, c, speed, found)
    place = found[ST.AXIAL_SHIFT]
    if c[C.PEDESTAL_AXIAL] != 0.0:  # a seat in the housing gives no way
        place += c[C.PRELOAD] / c[C.PEDESTAL_AXIAL]
    return place, status


@kernel
def cold_place(p, u, load, w):
    """Axial place (m) of the inner ring under a ``load`` (N) at standstill and reference temperature; status.

    ``u``: inputs of this bearing, for what does not depend on either.
    """
    still = w[W.STILL_INPUTS : W.STILL_CONDITIONS]
    c = w[W.STILL_CONDITIONS : W.STILL_FOUND]
    found = w[W.STILL_FOUND : W.STILL_END]
    for i in range(U.SIZE):
        still[i] = u[i]
    still[U.SPEED] = 0.0
    for i in range(U.SHAFT_T, U.SIZE):
        still[i] = REFERENCE_TEMPERATURE
    conditions(p, still, 0.0, c)
    unmount(p, c)
    c[C.PRELOAD] = max(load, TOUCHING)
    return place_under(p, c, 0.0, found)


@kernel
def load_at_place(p, c, place, speed, found):
    """Axial load (N) under which the ring is at ``place`` (m) at ``speed`` (rad/s), left in ``c``; status.

    Bisection with secant steps on the increasing curve of place over load, the quasi-static equilibrium in
    ``found``. A place that asks for a pull ends at no load: the ring is then free of its balls.
    """
    high = max(c[C.PRELOAD], 1.0)
    low = 0.0
    c[C.PRELOAD] = low
    below, status = place_under(p, c, speed, found)
    if status != OK:
        # slow balls find no rest without a load: from the load downwards, as far as they find one
        low = high
        c[C.PRELOAD] = low
        below, status = place_under(p, c, speed, found)
        while status == OK and below >= place and low > TOUCHING:
            low *= 0.25
            c[C.PRELOAD] = low
            below, status = place_under(p, c, speed, found)
    if status != OK or below >= place:
        return status
    above = place
    for _ in range(_ROUNDS):
        c[C.PRELOAD] = high
        above, status = place_under(p, c, speed, found)
        if status != OK:
            return status
        if above >= place:
            break
        low = high
        below = above
        high *= 2.0
    for n in range(_ROUNDS):
        load = low + (high - low) * (place - below) / (above - below)
        margin = 0.02 * (high - low)
        if n % 3 == 2 or load <= low + 1e-3 * margin or load >= high - 1e-3 * margin:
            load = 0.5 * (low + high)
        c[C.PRELOAD] = load
        here, status = place_under(p, c, speed, found)
        if status != OK or abs(here - place) < 1e-15 or high - low < 1e-9 * (1.0 + high):
            return status
        if here < place:
            low = load
            below = here
        else:
            high = load
            above = here
    return OK


@kernel
def rigid_start(p, u, c, s, w, found):
    """Place at the start into ``s`` and, into ``c``, the axial load it means at speed and temperatures."""
    place, status = cold_place(p, u, u[U.PRELOAD], w)
    if status != OK:
        return status
    s[S.PLACE] = place
    return load_at_place(p, c, place, u[U.SPEED], found)


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
