"""The trial state of a step in fidelity `rings`: predictor, corrections, and what they leave.

``vectors``: place in ``own`` of the march's vectors (`members.history`), whose numbers are ``SP.MARCHED``
places before. Other arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.fidelities.condensed.balls import accelerations, set_angles
from fmu_bearing.engine.fidelities.condensed.patterns import add_patterns, begin_step, correct_patterns
from fmu_bearing.engine.fidelities.condensed.rows import angles_at
from fmu_bearing.engine.fidelities.rings import equations, predictor
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SP, C, H, L, P, Q, S, T, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.shaft import shaft_forces

_ITERATIONS = 6


@kernel
def set_angles_ahead(p, s, h, w):
    """Put balls and race heights to the end of a step ``h`` (s), with the rings at their trial places."""
    theta, rolled, angle, speed = angles_at(s, h)
    outer = w[W.STAGE + Y.Q0 + L.TURN]
    set_angles(p, s[S.C : S.C + C.SIZE], members.condensed(s), theta, rolled, angle, outer, speed, w)


@kernel
def size_of(x, levers, n, w, at):
    """Largest of the ``n`` numbers at ``w[at:]``, each times its lever at ``x[levers:]``."""
    size = 0.0
    for i in range(n):
        size = max(size, x[levers + i] * abs(w[at + i]))
    # a comparison drops what is not a number, a sum does not
    total = 0.0
    for i in range(n):
        total += w[at + i]
    return size + 0.0 * total


@kernel
def judge_correction(contraction, size, before, worst, n, probe, tolerance):
    """Return what correction ``n`` of ``size`` (m/s) leaves, and the worst contraction.

    Negative where another is needed, not a number where it is given up; ``before``: size of the last one.
    """
    if not (size < 1e6):
        return math.nan, worst
    if n > 0:
        contraction = size / (before + 1e-300)
        # the ratio of smaller corrections is that of the balls' first-order forces
        if before > tolerance:
            worst = max(worst, contraction)
        if contraction > 0.9 and size > tolerance:
            return math.nan, worst
    if (n > 0 or not probe) and size * contraction <= tolerance:
        return size * contraction, worst
    return -1.0, worst


@kernel
def displace(p, own, ws, vectors, n, lanes, h):
    """Add to the trial places what the change ``SP.INCREMENT`` of the accelerations moves them by.

    Modes above 2.45 radians per step make Newmark's method with the first two terms of beta unstable (see
    `predictor.displaced`), and the modes of a shaft that bends go up to 100 kHz. There a third term is added,
    (omega h)^4 / 3200: with 1 / 3900 no frequency is unstable, the rest is room for stiffness that varies.
    Slow modes are off by no more than without, as the series goes on with 1 / 6048.
    """
    turned = members.vector_at(lanes, SP.FORCE)
    d = members.vector_at(lanes, SP.INCREMENT)
    place = members.vector_at(lanes, SP.PLACE)
    squares = members.squares_at(vectors, lanes)
    equations.multiply(p, own, ws, squares, d, turned)
    predictor.displaced(ws, d, turned, place, lanes, h)
    if equations.bends(p):
        again = members.vector_at(lanes, SP.RATE)
        equations.multiply(p, own, ws, squares, turned, again)
        for i in range(n):
            ws[place + i] += equations.THIRD * h**6 * ws[again + i]


@kernel
def predict(p, s, w, own, ws, vectors, n, lanes, h):
    """Trial state at the end of a step ``h`` (s): coordinates, balls' places, race heights under them."""
    predictor.guess(
        own, vectors - SP.MARCHED, vectors, lanes, h, ws, members.vector_at(lanes, SP.ACCELERATION),
        members.vector_at(lanes, SP.INCREMENT), members.vector_at(lanes, SP.PLACE),
        members.vector_at(lanes, SP.NEWMARK),
    )  # fmt: skip
    displace(p, own, ws, vectors, n, lanes, h)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        equations.follow_trial(p, b, own, ws, wb, lanes, h)
        predictor.continue_places(lv, int(pb[P.LANES]), wb)
        begin_step(lv, wb)
        set_angles_ahead(pb, sb, h, wb)


@kernel
def true_rates(p, own, ws, vectors, n, lanes, h):
    """Put the rates that dampers and gyroscopic moments see to ``SP.RATE``: see `predictor.true_velocities`.

    The rate of acceleration that the trial itself counts in makes modes about 3 radians per step unstable
    from 5 % damping on. Where a shaft bends there are such modes: there it is that of the last step, which
    leaves all modes stable and shifts the frequency of a slow one by its damping ratio times (omega h)^3 / 8.
    """
    acc = members.vector_at(lanes, SP.ACCELERATION)
    newmark = members.vector_at(lanes, SP.NEWMARK)
    rate = members.vector_at(lanes, SP.RATE)
    numbers = vectors - SP.MARCHED
    if not equations.bends(p) or own[numbers + H.KNOWN] < 1.0:
        predictor.true_velocities(own, numbers, vectors, lanes, h, ws, acc, newmark, rate)
        return
    for i in range(n):
        change = own[vectors + H.A0 * lanes + i] - own[vectors + H.A1 * lanes + i]
        ws[rate + i] = ws[newmark + i] - h / 12.0 * change


@kernel
def residual_of(p, s, w, own, ws, vectors, n, lanes, h):
    """Put what is out of balance at the trial state to ``SP.RESIDUAL``; False where balls find no rest."""
    rate = s[S.SPEED_RATE]
    _, _, angle, speed = angles_at(s, h)
    acc = members.vector_at(lanes, SP.ACCELERATION)
    residual = members.vector_at(lanes, SP.RESIDUAL)
    together = members.has_shaft(p)
    true_rates(p, own, ws, vectors, n, lanes, h)
    if together:
        place = members.vector_at(lanes, SP.PLACE)
        moving = members.vector_at(lanes, SP.RATE)
        shaft_forces(p, own, ws, place, moving, angle, speed, rate, ws, residual)
        members.add_product(p, members.table(p, SP.AT_MASS), -1.0, ws, acc, ws, residual)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        equations.follow_trial(p, b, own, ws, wb, lanes, h)
        q = wb[T.Q : T.Q + L.COLUMN]
        fine = accelerations(pb, sb[S.C : S.C + C.SIZE], lv, angle, speed, rate, q, wb)
        if not fine:
            return False
        add_patterns(pb, lv, h, wb)
        if together:
            equations.pull_rings(p, b, wb, ws, residual)
        else:
            equations.rings_residual(pb, wb, ws, residual)
    return True


@kernel
def correct_once(p, s, w, own, ws, vectors, n, lanes, h):
    """Correct the trial state by the residual; the size (m/s) of the correction."""
    d = members.vector_at(lanes, SP.INCREMENT)
    acc = members.vector_at(lanes, SP.ACCELERATION)
    newmark = members.vector_at(lanes, SP.NEWMARK)
    residual = members.vector_at(lanes, SP.RESIDUAL)
    equations.multiply(p, own, ws, members.inverse_at(vectors, n, lanes), residual, d)
    if not members.has_shaft(p) and p[P.RIGID] != 0.0:
        ws[d + Q.X] = ws[residual + Q.X]
    for i in range(0, lanes, FOUR):
        change = load(ws, d + i)
        store(ws, acc + i, load(ws, acc + i) + change)
        store(ws, newmark + i, load(ws, newmark + i) + 0.5 * h * change)
    displace(p, own, ws, vectors, n, lanes, h)
    known = own[vectors - SP.MARCHED + H.KNOWN]
    counts = 0.0 if equations.bends(p) and known >= 1.0 else predictor.last_counts(known)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        members.driven_motion(p, b, ws, d, wb, T.D)
        correct_patterns(members.condensed(members.state(p, s, b)), h, counts, wb)
    return 0.5 * h * size_of(own, vectors + H.LEVERS * lanes, n, ws, d)


@kernel
def correct(p, s, w, h, tolerance, probe):
    """Trial state of a step by predictor and corrections; what the last leaves (m/s), or -1."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    vectors = members.history(p)
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    at = vectors - SP.MARCHED + H.CONTRACTION
    predict(p, s, w, own, ws, vectors, n, lanes, h)
    before = 0.0
    worst = 0.0
    for k in range(_ITERATIONS):
        if not residual_of(p, s, w, own, ws, vectors, n, lanes, h):
            return -1.0
        size = correct_once(p, s, w, own, ws, vectors, n, lanes, h)
        s[S.NEWTON] += 1.0
        left, worst = judge_correction(own[at], size, before, worst, k, probe, tolerance)
        if left >= 0.0:
            if worst > 0.0:
                own[at] = worst
            return left
        if left != left:
            return -1.0
        before = size
    return -1.0
