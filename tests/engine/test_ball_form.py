"""Form of the balls in fidelities `rings` and `response`: heights, lines, and the same in fidelity full."""

import numpy as np
import pytest
from numpy.polynomial.legendre import legder, legval
from scipy.spatial.transform import Rotation

from fmu_bearing.engine.fidelities.condensed.balls import set_angles
from fmu_bearing.engine.fidelities.response.ball_orders import form_of, form_orders, form_over_turning
from fmu_bearing.engine.layout import FOUR, LN, STRIDE, C, L, P, S, T
from tests.engine.condensed import FIDELITIES, block, silent, vibration
from tests.engine.helpers import RPM, Run, quiet
from tests.engine.test_ball_waves import lines

FORM = np.array([0.0, 20e-9, -4e-9, 8e-9, 0.0, 3e-9])


def touch(lv):
    """Directions into inner and outer race, and across both tracks."""
    return lv[L.CONTACT_AXES : L.CONTACT_AXES + L.VECTOR * FOUR].reshape(L.VECTOR, FOUR).T


def slow_form(run, rolled, speed, tau=0.0):
    """Height, its second rate and slope across the track of every ball, rows of inner and outer race.

    ``tau`` (s): contact damping adds so much times the rate to the height.
    """
    lv, p = block(run), run.p
    series = [0.0, *FORM]
    first = int(p[P.AT_AXES])
    axes = p[first : first + 3 * STRIDE].reshape(3, STRIDE)[:, : int(p[P.BALLS])].copy()
    about = lv[L.ROLL_AXIS : L.ROLL_AXIS + 3]
    a = Rotation.from_rotvec(rolled * about).apply(axes.T)
    rate = np.cross(lv[L.ROLL] * speed * about, a)
    found = []
    for e, m in zip(touch(lv)[:2], touch(lv)[2:], strict=True):
        rise = legval(a @ e, legder(series))
        height = legval(a @ e, series) + tau * rise * (rate @ e)
        found.append((height, rise * (a @ m)))
    return np.array(found).transpose(1, 0, 2)


@pytest.mark.heavy
@pytest.mark.parametrize("rolled", [-3.0, 0.0, 1e-9, 2.7])
def test_heights_are_those_of_turned_balls(scene, rolled):
    run = Run(quiet(scene("7009C-full-ceramic")), 18000, ball_waves=FORM, FIDELITY=1.0).init()
    speed, balls = 1885.0, int(run.p[P.BALLS])
    set_angles(run.p, run.s[S.C : S.C + C.SIZE], block(run), 0.3, rolled, 2.2, 0.0, speed, run.w)
    found = [run.w[at : at + 2 * STRIDE].reshape(2, STRIDE)[:, :balls] for at in (T.INNER, T.FORM_SLOPE)]
    tau = run.p[P.CONTACT_DAMPING]
    assert tau > 0.0
    for one, other in zip(found, slow_form(run, rolled, speed, tau), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-13 * np.abs(other).max())


def test_balls_roll_as_the_quasi_static_point_has_it(scene):
    """Contacts lie at its angles; the spin's rate is that of rolling on the outer race."""
    run = Run(quiet(scene("7003C-bare")), 10000, ball_waves=FORM, FIDELITY=1.0, GRAVITY=0.0).init()
    lv = block(run)
    for race, side, way in ((0, "inner", -1.0), (1, "outer", 1.0)):
        angle = run.value(f"contact.{side}.angle_mean")
        expected = way * np.array([np.sin(angle), np.cos(angle), 0.0])
        # the rings' own equilibrium stands some 10 nm beside the quasi-static one: 7e-5 rad on 0.15 mm
        np.testing.assert_allclose(touch(lv)[race], expected, atol=2e-4)
        across = touch(lv)[2 + race]
        assert abs(across @ touch(lv)[race]) < 1e-9
        assert across @ across == pytest.approx(1.0)
    # the contact of the outer race passes over the ball as fast as over the race, but for creep of 1e-3
    c, p = run.s[S.C : S.C + C.SIZE], run.p
    outer = touch(lv)[1]
    swept = np.linalg.norm(np.cross(lv[L.ROLL_AXIS : L.ROLL_AXIS + 3], outer)) * lv[L.ROLL]
    path = p[P.PITCH_RADIUS] + lv[L.R] + c[C.BALL_RADIUS] * outer[1]
    assert swept * c[C.BALL_RADIUS] == pytest.approx(lv[L.RATIO] * path, rel=2e-3)


@pytest.mark.heavy
def test_orders_over_the_turning_add_up_to_the_form(scene):
    run = Run(quiet(scene("7003C-bare")), 10000, ball_waves=FORM, FIDELITY=2.0).init()
    assert LN.SIZE <= S.CONDENSED - S.JAC
    x, balls, rolled = np.zeros(LN.SIZE), int(run.p[P.BALLS]), 0.7
    form_orders(run.p, block(run), FORM.size, x)
    sums = np.zeros((LN.FORMS, balls))
    for form in range(LN.FORMS):
        for m in range(1, FORM.size + 1):
            at = form_of(form, m)
            sums[form] += 2.0 * x[at : at + balls] * np.cos(m * rolled)
            sums[form] -= 2.0 * x[at + STRIDE : at + STRIDE + balls] * np.sin(m * rolled)
    # the mean over a turn is no vibration: it is left out, and taken away here
    turns = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    every = np.array([slow_form(run, turn, 1.0).reshape(LN.FORMS, balls) for turn in turns])
    exact = slow_form(run, rolled, 1.0).reshape(LN.FORMS, balls) - every.mean(0)
    np.testing.assert_allclose(sums, exact, atol=1e-12 * np.abs(exact).max())
    count = 16
    form_over_turning(run.p, block(run), 1, count, LN.TURNED, x)
    rows = x[LN.TURNED :][: count * LN.FORMS].reshape(count, LN.FORMS).T
    np.testing.assert_allclose(rows, every[::4, :, 1].T, atol=1e-13 * np.abs(every).max())


@pytest.mark.heavy
@pytest.mark.parametrize(("name", "rpm"), [("7003C-spindle", 20000), ("7003C-bare", 20000)])
def test_wavy_balls_sound_as_in_full(scene, name, rpm):
    """Balls' form alone, without gravity: velocities of both rings within 5 %, and the axial line 2 f_b."""
    figures, tones = [], []
    for fidelity in (0.0, 1.0, 2.0):
        run = Run(quiet(scene(name)), rpm, ball_waves=FORM, FIDELITY=fidelity, GRAVITY=0.0)
        run.init()
        run.run(0.03)
        rows = run.run(0.08, 2e-5)
        figures.append(vibration(rows))
        if fidelity == FIDELITIES["rings"]:
            tone = 2.0 * block(run)[L.ROLL] * rpm * RPM / (2.0 * np.pi)
        tones.append(rows)
    heard = [lines(rows, "inner_ring.velocity.x", 2e-5, tone) for rows in tones]
    np.testing.assert_allclose(figures[1], figures[0], rtol=0.05)
    np.testing.assert_allclose(figures[2], figures[1], rtol=0.05)
    np.testing.assert_allclose(heard, heard[0], rtol=0.03)


def below(rows, h, highest):
    """Velocities with the spectrum above ``highest`` (Hz) taken away."""
    spectrum = np.fft.rfft(rows[:, :6], axis=0)
    spectrum[np.fft.rfftfreq(len(rows), h) > highest] = 0.0
    return np.fft.irfft(spectrum, len(rows), axis=0)


# 7003C-bare at 10,000: above 3 kHz order 9 of the balls meets the mode in which a free inner ring tilts,
# which lies at 3.95 and 4.13 kHz here and at 4.10 and 4.31 kHz in full. Measured 1.00 and 0.90 below it.
@pytest.mark.heavy
@pytest.mark.parametrize(
    ("name", "rpm", "highest", "share"),
    [
        ("7003C-bare", 10000, 3e3, 0.15),
        ("7003C-bare", 20000, 3e4, 0.04),
        ("7003C-spindle", 12000, 3e4, 0.02),
    ],
)
def test_example_scenes_vibrate_as_in_full(example, name, rpm, highest, share):
    figures = []
    for fidelity in (0.0, 1.0, 2.0):
        run = Run(silent(example(name)), rpm, FIDELITY=fidelity).init()
        run.run(0.03)
        figures.append(vibration(below(run.run(0.08, 2e-5), 2e-5, highest)))
    np.testing.assert_allclose(figures[1], figures[0], rtol=share)
    np.testing.assert_allclose(figures[2], figures[1], rtol=0.02)
