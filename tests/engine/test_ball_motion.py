"""Balls' form in `rings` and `response`: rings and balls move as the linearised equations of `full` do."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fmu_bearing import record
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.fidelities.condensed.ball_motion import rate_weights
from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.layout import STRIDE, C, L, P, Q, S, U, W, Y
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.equations.plain import Plain
from fmu_bearing.prepare.sound_block import Block, sound_block
from fmu_bearing.scene.read import with_fidelity
from tests.engine.condensed import block
from tests.engine.helpers import RPM, quiet, wavy_balls

FORM = np.full(10, 1e-9)  # m: all orders equal, small enough to be linear
AXIAL = [Q.INNER, Q.OUTER]
MEAN_BALL = [0, 1]  # of the balls' states: x and r


def of_full(scene, rpm, tau):
    """Rate of the balls' turning (rad/s) and complex places along the axis by order of it.

    Of inner ring, outer ring, and the mean of the balls, x and r: shape (orders, 4). Linear, about the steady
    state, excited by what the form does there to every acceleration.
    """
    damped = scene.replace({"bearing.contact_damping_us": 1e6 * tau})
    found = linearised(quiet(damped), {U.SPEED: rpm * RPM}).bearings[0]
    arrays, at = found.arrays, found.coordinates
    matrix = Plain(arrays, at).derivatives()
    wavy = SimpleNamespace(p=wavy_balls(arrays.p, FORM), s=arrays.s.copy(), u=arrays.u, w=arrays.w)
    wavy.s[S.C + C.OVERSIZE_SCALE] = 1.0
    plain = Plain(wavy, at)
    spin = np.array([plain.y[Y.WX] - plain.y[Y.OM], plain.y[Y.WR], plain.y[Y.WT]])
    rate = np.linalg.norm(spin)
    axes = wavy.p[int(wavy.p[P.AT_AXES]) :][: 3 * STRIDE].reshape(3, STRIDE)
    driven = []
    for turn in np.linspace(0.0, 2.0 * np.pi, 4 * FORM.size, endpoint=False):
        turned = Rotation.from_rotvec(turn * spin / rate).apply(axes.T).T
        plain._w[W.AXES : W.AXES + 3 * STRIDE] = turned.ravel()
        driven.append(plain.rates().copy())
    orders = 2.0 * np.fft.fft(driven, axis=0) / len(driven)
    places = []
    for m in range(1, FORM.size + 1):
        x = np.linalg.solve(1j * m * rate * np.eye(at.size) - matrix, orders[m])
        balls = [x[at.ball_state(kind)].mean() for kind in MEAN_BALL]
        places.append([*x[at.rings + np.array(AXIAL)], *balls])
    return rate, np.array(places)


def bearing_with_form(scene, rpm, fidelity, sound=False, **parameters):
    """A bearing with wavy balls alone: no cage, no weight."""
    one = with_fidelity(scene, model=fidelity)
    # samples show each ball across its track; response makes its sound of lines else, and shows balls at rest
    block_of_sound = sound_block(one, Block()) if sound else np.empty(0)
    even = Arrays.of(one.model_copy(update={"imperfections": None}), block_of_sound)
    even.at({U.SPEED: rpm * RPM})
    run = even.with_parameters(CAGE=0.0, GRAVITY=0.0, IMPERFECTION_SCALE=1.0, **parameters)
    run = Arrays(wavy_balls(run.p, FORM), run.u)
    run.u[U.OIL_T : U.OUTER_T + 1] = 313.15
    run.init()
    return run


def mean_ball(run, row):
    """Mean over the balls of a row of the published state."""
    return run.s[S.Y + row : S.Y + row + int(run.p[P.BALLS])].mean()


def lines_of_response(run):
    """Complex places along the axis of both rings, by order of the balls' turning alone."""
    count = int(block(run)[L.COUNT])
    table = run.s[line_table(run.p) :][: count * L.LINE_SIZE].reshape(count, -1)
    found = np.zeros((FORM.size, len(AXIAL)), dtype=complex)
    for row in table[(table[:, L.LINE_BALL] == 0.0) & (table[:, L.LINE_ROLLED] > 0.0)]:
        place = row[[L.LINE_REAL + k for k in AXIAL]] + 1j * row[[L.LINE_IMAGINARY + k for k in AXIAL]]
        found[int(row[L.LINE_ROLLED]) - 1] = place
    return found


# Worst of ten orders, amplitude and phase together. Measured 4.2 % at all three dampings; odd orders lack the
# moments of the slopes. With slopes advanced by the damping time, too, order 7 was 18 % off at 2.5 us.
@pytest.mark.parametrize("tau", [0.5e-6, 2.5e-6, 10e-6])
def test_rings_answer_to_form_as_in_full(example, tau):
    scene = example("7003C-spindle").with_rigid_rings()
    _, exact = of_full(scene, 30000, tau)
    run = bearing_with_form(scene, 30000, "response", CONTACT_DAMPING=tau)
    off = np.abs(lines_of_response(run) - exact[:, :2]) / np.abs(exact[:, :2])
    assert off.max() < 0.05


# Velocities of the mean ball in ten lines up to 14 kHz (7003C) and 7 kHz (7009C), along x and r together.
# Measured 3.4 and 12 %: on the 7009C friction counts more, and is that of one ball with steady spin. Places
# of rest, as they once were shown, are off by a factor of 2.5 at 14 kHz.
@pytest.mark.parametrize("fidelity", ["rings", "response"])
@pytest.mark.parametrize(
    ("name", "rpm", "share"), [("7003C-spindle", 30000, 0.05), ("7009C-steel", 12000, 0.15)]
)
def test_balls_move_as_in_full(example, name, rpm, share, fidelity):
    scene, tau, h = example(name).with_rigid_rings(), 2.5e-6, 5e-6
    rate, exact = of_full(scene, rpm, tau)
    run = bearing_with_form(scene, rpm, fidelity, sound=True, CONTACT_DAMPING=tau, MAX_STEP=h)
    run.run(0.01, h)
    rows = []
    for _ in range(8000):
        run.step(h)
        rows.append([mean_ball(run, row) for row in (Y.VX, Y.VR)])
    window = np.hanning(len(rows))[:, None]
    times = h * np.arange(len(rows))[:, None]
    turn = block(run)[L.ROLL] * rpm * RPM
    for m, places in enumerate(exact[:, 2:], start=1):
        turned = np.exp(-1j * m * turn * times)
        found = 2.0 * np.abs((window * rows * turned).sum(0)) / window.sum()
        true = np.abs(m * rate * places)
        assert np.linalg.norm(found - true) < share * np.linalg.norm(true), m


def test_without_sound_balls_are_shown_where_they_rest(example):
    """Nothing marches them there, and nothing is added to their places."""
    scene = example("7003C-spindle").with_rigid_rings()
    for fidelity in ("rings", "response"):
        run = bearing_with_form(scene, 30000, fidelity)
        run.run(1e-3, 1e-4)
        lv, balls = block(run), int(run.p[P.BALLS])
        np.testing.assert_array_equal(run.s[S.Y + Y.X :][:balls], lv[L.X :][:balls])
        np.testing.assert_array_equal(run.s[S.Y + Y.R :][:balls], lv[L.R :][:balls])


@pytest.mark.parametrize("known", range(5))
def test_rates_of_polynomials_are_exact(known):
    """Through as many places as are known, at any time before the last one."""
    for ahead in (0.0, 0.15, 1.3):
        weights = np.array(rate_weights(float(known), ahead))
        for degree in range(known + 1):
            places = (-np.arange(5.0)) ** degree
            rate = degree * (-ahead) ** (degree - 1) if degree else 0.0
            assert weights @ places == pytest.approx(rate if known else 0.0, abs=1e-12)


def alone(scene, rpm, **flaws):
    """The scene at a speed with other imperfections."""
    changes = {f"imperfections.{name}": value for name, value in flaws.items()}
    return scene.replace(changes | {"operation.speed_rpm": rpm})


def level(pressure):
    """Sound pressure level (dB)."""
    return 20.0 * np.log10(np.sqrt(np.mean(pressure**2)) / 2e-5)


def levels_of_lines(made, pressure, lines):
    """Level (dB) of each line (Hz), in 20 Hz to both sides."""
    window = np.hanning(len(pressure))
    power = np.abs(np.fft.rfft(window * pressure)) ** 2
    frequency = np.fft.rfftfreq(len(pressure), 1.0 / made.rate)
    return np.array([10.0 * np.log10(power[np.abs(frequency - line) < 20.0].sum()) for line in lines])


# Ahead of the spindle, where its balls sound as loud as its housing. Measured 0.5 dB up to order 12, and
# for all lines of the balls' own sound 0.9. At their places of rest balls were 12 dB too loud, and lines
# off by 18 dB. Order 13 at 15,000 r/min is 3.6 dB off in rings (before balls and cage followed the
# linearised full, 1.5): it is 11 dB below any other line, a small difference of rings and balls. The
# scene's own radiation model bem has 0.7 dB at 15,000 and 0.4 dB at 30,000 r/min as the worst (not
# asserted: it takes two minutes).
@pytest.mark.heavy
@pytest.mark.parametrize(("rpm", "last"), [(15000, 4.0), (30000, 1.5)])
def test_lines_of_form_sound_as_in_full(example, rpm, last):
    """A tenth of the form alone, no cage: the tilt of the inner ring answers nonlinearly to more."""
    scene = alone(
        example("7003C-spindle"), rpm, ball_form_nm=8.0, ball_diameter_spread_nm=0.0, unbalance_um=0.0,
        inner_race_amplitude_um=0.0, outer_race_amplitude_um=0.0,
    ).replace({"fidelity.terms.gravity": False})  # fmt: skip
    scene = scene.model_copy(update={"bearing": scene.bearing.model_copy(update={"cage": None})})
    run = Arrays.of(with_fidelity(scene.model_copy(update={"sound": None}), model="rings"))
    run.init()
    turning = block(run)[L.ROLL] * rpm / 60.0
    lines = turning * np.arange(1, int(9250.0 / turning) + 1)
    sums, balls = [], []
    for fidelity in ("full", "rings", "response"):
        made = record(with_fidelity(scene, model=fidelity), 0.2, settle=0.03, progress=False, outputs=())
        sums.append(levels_of_lines(made, made.pressure(["P4"])[0], lines))
        balls.append(levels_of_lines(made, made.partial(["P4"])["balls"][0], lines))
    off = np.abs(np.array(sums[1:]) - sums[0])
    assert off[:, :-1].max() < 1.5
    assert off[:, -1].max() < last
    # order 1 at 15,000 r/min, 60 dB below the others, is what differences of places leave (5 dB off)
    counts = balls[0] > balls[0].max() - 40.0
    assert np.abs(np.array(balls[1:]) - balls[0])[:, counts].max() < 1.5


# Measured over eight seeds: levels within 0.16 dB(A), balls within 0.5 dB (3 dB too loud at places of rest at
# 30,000 r/min, 6.5 at 15,000). With radiation model bem P4 is within 0.1 dB(A) at 15,000 and 0.17 at 30,000
# r/min, one seed of eight at -0.4 (1.4 to 1.7 too loud at places of rest).
@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [15000, 30000])
def test_spindle_is_as_loud_ahead_as_in_full(example, rpm):
    scene = alone(example("7003C-spindle"), rpm)
    levels, balls = [], []
    for fidelity in ("full", "rings", "response"):
        made = record(with_fidelity(scene, model=fidelity), 0.3, settle=0.05, progress=False, outputs=())
        levels.append(made.levels(["P4"], weighting="A")[0])
        balls.append(level(made.partial(["P4"])["balls"][0]))
    np.testing.assert_allclose(levels[1:], levels[0], atol=0.5)
    np.testing.assert_allclose(balls[1:], balls[0], atol=1.0)
