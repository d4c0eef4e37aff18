"""The one-evaluation path: its order, its use when settled, and its retreat when driven out of range."""

import numpy as np
import pytest

from fmu_bearing.engine.choices import METHODS
from fmu_bearing.engine.fidelities.full.fast import newmark
from fmu_bearing.engine.layout import A, F, J, Q, S, U, W, Y
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.explicit import Motion
from tests.engine.helpers import Run, quiet

RATES = [*range(Y.V0, Y.V0 + 3), *range(Y.V0 + Q.OUTER, Y.V0 + Q.OUTER + 3)]
FAST = METHODS.index("fast")
TIGHT = {"TOLERANCE": 1e-5, "MAX_STEP": 4e-6}


def smooth(scene):
    """A settled bearing with unbalance alone: everything it does is smooth on the scale of a step."""
    found = scene("7003C-spindle")
    flaws = found.imperfections.model_copy(
        update={
            "inner_race_amplitude_um": 0.0,
            "outer_race_amplitude_um": 0.0,
            "ball_diameter_spread_nm": 0.0,
            "unbalance_um": 5.0,
        }
    )
    run = Run(found.model_copy(update={"imperfections": flaws, "sound": None}), 20000)
    run.init().run(0.02, 1e-3)
    return run


@pytest.mark.heavy
def test_newmark_converges_with_its_order(scene):
    run = smooth(scene)
    motion = Motion(run)
    begin, end, steps = 16e-6, 96e-6, (8e-6, 4e-6, 2e-6)
    exact = motion.exact({begin, end, *(begin - k * h for h in steps for k in (1, 2))}, 4e-8)
    jac, w = np.zeros(J.SIZE), np.zeros(W.size(run.p))
    start = exact[begin]
    angle = motion.angle + motion.speed * begin
    jacobian(run.p, motion.c, start.copy(), angle, motion.speed, 0.0, w, jac)
    errors = []
    for h in steps:
        fac = np.zeros(A.SIZE)
        # 1/4 for the balls: at 4 us their 140 kHz are beyond the range of 1/12
        square = h * h
        assert factor(run.p, jac, 0.5 * h, newmark.BETA * square, newmark.BETA_BALL * square, fac, w)
        history = [motion.f(begin - k * h, exact[begin - k * h]) for k in (2, 1)]
        history.append(motion.f(begin, start))
        y = np.zeros(Y.SIZE)
        newmark.true_rates(start, -h, history[2], history[1], history[0], y)
        for n in range(round((end - begin) / h)):
            new, a = np.zeros(Y.SIZE), np.zeros(F.SIZE)
            newmark.predict(y, history[-1], h, new, a)
            t = begin + (n + 1) * h
            for _ in range(6):  # iterated to the end: the order is the method's, not Newton's
                newmark.iterate(
                    run.p, motion.c, motion.angle + motion.speed * t, motion.speed, 0.0, h,
                    newmark.BETA_BALL, fac, 1.0, 0.0, new, a, w,
                )  # fmt: skip
            y = new
            history.append(a)
        read = np.zeros(Y.SIZE)
        newmark.true_rates(y, h, history[-1], history[-2], history[-3], read)
        errors.append(np.abs(read - exact[end])[RATES].max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    # fourth order for the rings' own vibration; the balls' inertia with beta = 1/4 leaves second
    assert (orders > 1.8).all(), (errors, orders)


def drive(run, duration, **inputs):
    for place, value in inputs.items():
        run.u[getattr(U, place)] = value
    return run.run(duration, 1e-4)[:, :6]


def bearing(scene, **parameters):
    return Run(scene, 20000, **parameters).init()


def test_it_serves_a_settled_bearing(scene):
    """Most of a settled run is made of its steps, and follows the tight run as the tolerance says."""
    silent = scene("7003C-spindle").model_copy(update={"sound": None})
    run = bearing(silent, METHOD=FAST)
    rows = drive(run, 0.03)
    exact = drive(bearing(silent, **TIGHT), 0.03)
    # a step of the path is 4 to 10 us, one of ESDIRK4 20 us
    assert run.s[S.STEPS] > 0.03 / 12e-6
    late = slice(150, None)
    error = np.sqrt(np.mean((rows - exact)[late] ** 2)) / exact[late].std()
    # tolerance 1e-3 of 10 mm/s, rings move by 8 mm/s; two runs drift apart in the balls' places
    assert error < 1e-2


@pytest.mark.parametrize("inputs", [{"LOAD_Y": 1000.0}, {"PRELOAD": 50.0}])
def test_it_retreats_when_driven_out_of_range(scene, inputs):
    """A jump of the load sets everything ringing: the path is left, counted, and the result stays right."""
    silent = scene("7003C-spindle").model_copy(update={"sound": None})
    run = bearing(silent, METHOD=FAST)
    drive(run, 0.02)
    before = run.s[S.FALLBACKS]
    rows = drive(run, 5e-3, **inputs)
    assert run.s[S.FALLBACKS] > before
    assert run.value("solver.fallbacks") == run.s[S.FALLBACKS]
    assert np.isfinite(rows).all()
    reference = bearing(silent, **TIGHT)
    drive(reference, 0.02)
    exact = drive(reference, 5e-3, **inputs)
    error = np.sqrt(np.mean((rows - exact) ** 2)) / exact.std()
    assert error < 2e-2


def test_it_waits_until_the_start_has_died_away(scene):
    run = bearing(quiet(scene("7003C-bare")), METHOD=FAST)
    run.run(3e-3, 1e-3)
    # ESDIRK4's steps of up to 20 us, not the path's of 10 and less
    assert run.s[S.STEPS] < 3e-3 / 12e-6
    assert run.s[S.FALLBACKS] == 0.0


def test_the_balls_sound_as_they_do_by_the_default_method(scene):
    """Their angles pass from pi to -pi inside blocks; the sound must not see that."""
    levels = []
    for method in ("esdirk4", "fast"):
        found = scene("7009C-full-ceramic").with_rigid_rings()
        found = found.model_copy(update={"fidelity": found.fidelity.model_copy(update={"ball_harmonics": 4})})
        run = Instance(prepare(found, method=method))
        run.initialise()
        for _ in range(40):
            run.step(1e-3)
        levels.append(run.get("mic[1].spl_balls"))
    # both follow the same balls within 1e-3; a ball that swings through a turn within one step is decibels
    assert levels[1] == pytest.approx(levels[0], abs=0.05)
