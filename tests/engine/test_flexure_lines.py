"""Frequencies of bending rings: free, between their balls, and driven by waviness."""

import numpy as np
import pytest

from fmu_bearing.engine.choices import METHODS
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, TABLEAUX
from fmu_bearing.engine.layout import STRIDE, TAB, P, S
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.flexure import longest_step
from tests.engine.flexible import FRICTIONLESS, SCENE, FirstOrder, Flexure, bending, thin_ring, untouched
from tests.engine.helpers import Run, quiet


def peak(values, step, low, high):
    """Frequency (Hz) of the largest line between two frequencies, by a parabola over a Hann window's peak."""
    n = values.size
    spectrum = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(n), 8 * n))
    frequencies = np.fft.rfftfreq(8 * n, step)
    inside = np.flatnonzero((frequencies > low) & (frequencies < high))
    k = inside[np.argmax(spectrum[inside])]
    a, b, c = np.log(spectrum[k - 1 : k + 2])
    return frequencies[k] + 0.5 * (a - c) / (a - 2 * b + c) * frequencies[1]


def linear_modes(problem):
    """Frequencies (Hz) of the linearised problem and how much of each is the modes' motion."""
    x0 = problem.start
    matrix = np.empty((x0.size, x0.size))
    for k in range(x0.size):
        step = 1e-10 if np.abs(x0[k]) < 1e-3 else 1e-7
        ahead, behind = x0.copy(), x0.copy()
        ahead[k] += step
        behind[k] -= step
        matrix[:, k] = (problem(0.0, ahead) - problem(0.0, behind)) / (2 * step)
    values, vectors = np.linalg.eig(matrix)
    v = np.abs(vectors[problem.modes_at + (x0.size - problem.modes_at) // 2 :]) ** 2
    masses = v.sum(0)
    balls = np.abs(vectors[3 * problem.balls : 5 * problem.balls]) ** 2
    rings = np.abs(vectors[9 * problem.balls + 17 : 9 * problem.balls + 25]) ** 2
    share = masses / (masses + 0.05 * balls.sum(0) + rings.sum(0) + 1e-300)
    return values.imag / (2 * np.pi), share


def loose(run):
    """Frequencies (Hz) of the run's linearised bearing in which its rings bend."""
    frequencies, share = linear_modes(FirstOrder(run))
    return np.sort(frequencies[(frequencies > 5e3) & (share > 0.5)])


@pytest.mark.parametrize(("method", "bent"), [("esdirk4", 5e-3), ("trbdf2", 1.2e-2), ("rk4", 1e-3)])
def test_free_mode_rings_at_its_frequency(scene, method, bent):
    """No contact: the engine's frequency and decay, within what the longest step does to them."""
    row = untouched(thin_ring(1, 2, 6640.0, 0.022, damping=0.01))
    step = longest_step(row, method)
    run = Run(scene(SCENE), 20000, modes=[row], METHOD=METHODS[method], MODE_STEP=step).init()
    flexure = Flexure(run.p, run.w)
    flexure.state(run.s)[0] = 1e-6, 0.0
    flexure.state(run.s)[2] = -row[P.MODE_STIFFNESS] / row[P.MODE_MASS] * 1e-6, 0.0
    h = 1.25e-5
    values = []
    for _ in range(160):
        assert run.step(h) == OK
        values.append(flexure.state(run.s)[0].copy())
    values = np.array(values)
    assert peak(values[:, 0], h, 2e3, 12e3) == pytest.approx(6640.0, rel=bent)
    # the outer ring hardly turns on its pedestal: nothing couples the two
    assert np.abs(values[:, 1]).max() < 1e-4 * 1e-6
    envelope = np.abs(values[:16, 0]).max() / np.abs(values[-16:, 0]).max()
    # damping ratio 0.01; the methods add up to 5e-4
    assert np.log(envelope) / (2 * np.pi * 6640.0 * 144 * h) == pytest.approx(0.01, rel=0.12)


def factor_per_step(scene, row, size, step):
    """Factor by which ``step`` (s) multiplies a free mode's q - i v / w0, over e^(i w0 h), as a logarithm.

    The mode is let go at ``size`` (m) once the bearing has come to rest. With it the internal steps per step.
    """
    run = Run(quiet(scene(SCENE)), 20000, modes=[row], MODE_STEP=np.inf, MAX_STEP=1.01 * step).init()
    run.run(0.02, 1e-3)
    flexure = Flexure(run.p, run.w)
    free = np.sqrt(row[P.MODE_STIFFNESS] / row[P.MODE_MASS])
    flexure.state(run.s)[:] = [[size, 0.0], [0.0, 0.0], [-(free**2) * size, 0.0]]
    before, z = run.s[S.STEPS], [size]
    for _ in range(160):
        assert run.step(step) == OK
        q, v, _ = flexure.state(run.s)
        z.append(q[0] - 1j * v[0] / free)
    logarithms = np.log(np.array(z[1:]) / z[:-1] * np.exp(-1j * free * step))
    return logarithms.mean(), (run.s[S.STEPS] - before) / 160


def test_a_mode_above_hearing_is_resolved_where_it_rings_loud(scene):
    """Two steps over its period: as the method's stability function says, unless the error estimate objects.

    R(z) of esdirk4 on the imaginary axis, from its Butcher tableau.
    """
    row, step = untouched(thin_ring(1, 4, 40e3, 0.022)), 1.25e-5
    begin, count = AT_ESDIRK4 + TAB.A, int(TABLEAUX[AT_ESDIRK4 + TAB.COUNT])
    stages = np.diag([0.0] + [TABLEAUX[AT_ESDIRK4 + TAB.GAMMA]] * (count - 1))
    stages[:, : TAB.ROW] += TABLEAUX[begin : begin + count * TAB.ROW].reshape(count, TAB.ROW)
    z = 2j * np.pi * 40e3 * step
    wanted = np.log(
        (1.0 + z * stages[-1] @ np.linalg.solve(np.eye(count) - z * stages, np.ones(count))) / np.exp(z)
    )
    found, steps = factor_per_step(scene, row, 1e-11, step)
    assert steps == 1.0
    # the outer ring hardly turns on its pedestal: nothing else moves the pattern
    assert found == pytest.approx(wanted, rel=1e-4)
    low, ratio = -found.imag / abs(z), -found.real / abs(z)
    assert (low, ratio) == pytest.approx((0.049, 1.11e-3), rel=0.01)  # as the theory page says
    # 1 um at 40 kHz is 0.25 m/s, far above what rings do
    found, steps = factor_per_step(scene, row, 1e-6, step)
    assert steps > 5.0
    assert abs(found) < 1e-4 * abs(z)


def test_steps_resolve_what_is_heard():
    """A quarter of the period of the highest mode up to 20 kHz; modes above hearing ask for no step."""
    rows = [thin_ring(1, n, f, 0.022) for n, f in ((2, 6640.0), (3, 18450.0), (4, 34460.0))]
    assert longest_step(np.ravel(rows), "esdirk4") == pytest.approx(0.25 / 18450.0)
    assert longest_step(np.ravel(rows[:1]), "rk4") == pytest.approx(1.0 / (14.0 * 6640.0))
    assert longest_step(np.ravel(rows[2:]), "esdirk4") == np.inf
    assert longest_step(np.ravel(rows), "rk4") == pytest.approx(1.0 / (14.0 * 34460.0))


def test_contacts_stiffen_the_outer_ring(scene):
    """7003C, 500 N at standstill: between balls on a round inner ring, in closed form.

    Twelve light balls, two springs in series each at the loaded angle: N/2 cos^2 a k_i k_o/(k_i + k_o).
    """
    flexible = bending(quiet(scene(SCENE)), outer=(2,))
    run = Run(flexible, 0, preload=500.0, bends=True, **FRICTIONLESS, DRAG=0.0, GRAVITY=0.0).init()
    row = run.p[int(run.p[P.AT_MODES]) :]
    load = run.value("contact.outer.load_mean")
    springs = [
        1.5 * run.p[P.RACES + k * P.RACE_SIZE + P.RACE_STIFFNESS] ** (2 / 3) * load ** (1 / 3)
        for k in range(2)
    ]
    angle = run.value("contact.outer.angle_mean")
    contacts = 6.0 * np.cos(angle) ** 2 / (1 / springs[0] + 1 / springs[1])
    wanted = np.sqrt((row[P.MODE_STIFFNESS] + contacts) / row[P.MODE_MASS]) / (2 * np.pi)
    # the balls' mass, 1 % of the ring's, and the turn of the contact angle are left out
    np.testing.assert_allclose(loose(run), wanted, rtol=0.01)
    assert np.abs(Flexure(run.p, run.w).state(run.s)[0]).max() < 1e-11  # twelve equal balls bend no n = 2


def test_both_rings_bend_together(scene):
    """7003C, 500 N at standstill: the outer ring's n = 2 goes from 6.6 to about 10.8 kHz.

    So an independent prototype, whose section and shape differ in detail (assumed 6 %); with the inner ring
    round it would go to 18.4 kHz.
    """
    flexible = bending(quiet(scene(SCENE)), inner=(2,), outer=(2,))
    run = Run(flexible, 0, preload=500.0, bends=True, **FRICTIONLESS, DRAG=0.0, GRAVITY=0.0).init()
    found = loose(run)
    assert found[0] == pytest.approx(10.8e3, rel=0.06)
    # the same out of the engine's own motion
    flexure = Flexure(run.p, run.w)
    flexure.state(run.s)[1] += 0.0, 0.0, 1e-4, 0.0
    h, values = 1e-5, []
    for _ in range(300):
        assert run.step(h) == OK
        values.append(flexure.state(run.s)[1, 2])
    assert peak(np.array(values), h, 5e3, 2e4) == pytest.approx(found[0], rel=0.01)


@pytest.mark.parametrize(("race", "order"), [(0, 10), (0, 14), (1, 14), (1, 22)])
def test_selection_rule(scene, race, order):
    """Inner-race order m N +- n drives n at m f_i +- n f_r; outer-race order m N +- n at m f_o."""
    modes = [thin_ring(1, 2, 6640.0, 0.022, damping=0.05)]
    run = Run(quiet(scene(SCENE)), 12000, modes=modes, GRAVITY=0.0)
    p, balls, n = run.p.copy(), 12, 2
    count = int(p[P.WAVE_INTERVALS])
    grid = 2.0 * np.pi * np.arange(count) / count
    table = np.zeros((2, count, 2))
    table[race, :, 0] = 2e-8 * np.cos(order * grid)
    table[race, :, 1] = -2e-8 * order * np.sin(order * grid) * grid[1]
    run.p = np.concatenate([p, table.ravel()])
    run.p[P.WAVINESS], run.p[P.AT_WAVES] = 1.0, p.size
    run.p.setflags(write=False)
    run.init()
    run.run(0.02, 1e-3)
    begin, h = run.s[S.Y + 2 * STRIDE], 5e-5
    flexure = Flexure(run.p, run.w)
    values, turned = [], 0.0
    for _ in range(600):
        assert run.step(h) == OK
        values.append(flexure.state(run.s)[0].copy())
        now = run.s[S.Y + 2 * STRIDE]
        turned += (now - begin + np.pi) % (2 * np.pi) - np.pi
        begin = now
    shaft, cage = 200.0, turned / (600 * h * 2 * np.pi)
    m, side = round(order / balls), np.sign(order - balls * round(order / balls))
    wanted = m * balls * (shaft - cage) + side * n * shaft if race == 0 else m * balls * cage
    z = np.array(values) @ [1.0, -1j]
    spectrum = np.abs(np.fft.fft((z - z.mean()) * np.hanning(600), 4800))
    frequencies = np.abs(np.fft.fftfreq(4800, h))
    line = frequencies[np.argmax(spectrum)]
    assert line == pytest.approx(wanted, abs=5.0)
    assert spectrum.max() > 1e-10 * 300  # more than 0.1 nm
    away = np.abs(frequencies - wanted) > 150.0
    assert spectrum[away].max() < 0.1 * spectrum.max()
