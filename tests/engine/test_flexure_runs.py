"""Runs with bending rings: integrators, energy, start, saved states, scenes, what refuses them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fmu_bearing.arrays import REASONS
from fmu_bearing.compiled import call
from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.engine.choices import METHODS
from fmu_bearing.engine.layout import PT, P, Q, S, U, W, Y, Z
from fmu_bearing.engine.status import OK, RIGID_ONLY
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.flexure import groove_centre, mode_table
from fmu_bearing.prepare.model import pack, prepare
from fmu_bearing.run.choose import CANDIDATES
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.read import with_fidelity
from tests.engine.flexible import MODES, SCENE, FirstOrder, Flexure, bending
from tests.engine.helpers import Run, quiet


@pytest.mark.parametrize(("method", "error"), [("esdirk4", 2e-3), ("trbdf2", 1e-2), ("rk4", 2e-4)])
def test_engine_follows_another_integrator(scene, method, error):
    """SciPy's DOP853 on the same right-hand side, balls, bodies and modes in one vector, over 0.2 ms."""
    run = Run(
        scene(SCENE), 20000, modes=MODES, METHOD=METHODS[method], TOLERANCE=1e-5,
        MODE_STEP=2e-6,
    ).init()  # fmt: skip
    run.run(1e-3, 1e-4)
    problem = FirstOrder(run)
    assert run.step(2e-4) == OK
    exact = solve_ivp(problem, (0.0, 2e-4), problem.start, method="DOP853", rtol=1e-8, atol=1e-11).y[:, -1]
    ended = FirstOrder(run).start
    k = problem.modes_at
    q, v = exact[k:].reshape(2, -1)
    found_q, found_v = ended[k:].reshape(2, -1)
    assert np.abs(v).max() > 1e-4  # they do move
    np.testing.assert_allclose(found_v, v, atol=error * np.abs(v).max())
    np.testing.assert_allclose(found_q, q, atol=error * np.abs(q).max())
    rings = slice(9 * problem.balls + 17, 9 * problem.balls + 17 + 8)
    np.testing.assert_allclose(ended[rings], exact[rings], atol=error * np.abs(exact[rings]).max())


@pytest.mark.parametrize("method", ["esdirk4", "trbdf2", "rk4"])
def test_energy_over_a_run(scene, method):
    """Work less heat less stored energy closes to 1e-3 of the heat with all imperfections."""
    duration = 2e-3 if method == "rk4" else 0.02
    run = Run(scene(SCENE), 20000, modes=MODES, METHOD=METHODS[method]).init()
    run.run(duration, 1e-3)
    assert abs(run.imbalance) <= 1e-3 * run.heat
    # what the modes dissipate is more than the gate lets pass
    flexure = Flexure(run.p, run.w)
    assert np.abs(flexure.state(run.s)[1]).max() > 1e-4


def test_modes_above_hearing_need_no_steps_of_their_own(scene):
    """7003C with waves to 10 kHz, outer n = 2, 3, 4 (6.6, 18.4, 34.5 kHz): what is below 10 kHz.

    Steps for 18.4 kHz, 13.5 us, against such that resolve every mode fourteen times (2 us).
    """
    flexible = bending(scene(SCENE), outer=(2, 3, 4))
    spectra, steps = [], []
    for more in ({}, {"MODE_STEP": 2e-6}):
        run = Run(flexible, 20000, bends=True, **more).init()
        run.run(2e-3, 1e-3)
        flexure, before, values = Flexure(run.p, run.w), run.s[S.STEPS], []
        for _ in range(800):
            assert run.step(2.5e-5) == OK
            values.append(
                [*run.s[S.Y + Y.V0 :][[Q.Y, Q.Z, Q.OUTER + Q.Y, Q.OUTER + Q.Z]], *flexure.state(run.s)[1]]
            )
        steps.append(run.s[S.STEPS] - before)
        spectra.append(np.fft.rfft(np.array(values) * np.hanning(800)[:, None], axis=0))
    frequency = np.fft.rfftfreq(800, 2.5e-5)
    found, exact = (spectrum[(frequency > 200.0) & (frequency < 10e3)] for spectrum in spectra)
    assert steps[0] < 0.2 * steps[1]
    # found 3e-4 at n = 4 and 1e-4 elsewhere; levels then agree within 0.01 dB
    missed = np.linalg.norm(found - exact, axis=0) / np.linalg.norm(exact, axis=0)
    assert np.all(missed < 1e-3)


def test_rings_start_bent_by_their_loads(scene):
    """Under radial load the outer ring bends towards the loaded side, and hardly moves at first."""
    flexible = bending(quiet(scene(SCENE)), outer=(2, 3))
    run = Run(flexible, 10000, preload=300.0, bends=True, GRAVITY=0.0)
    run.u[U.LOAD_Z] = -400.0
    run.init()
    flexure = Flexure(run.p, run.w)
    start, _, accelerations = flexure.state(run.s).copy()
    assert start[0] > 1e-7  # n = 2 outwards at 6 o'clock, and at 12
    rows = run.p[int(run.p[P.AT_MODES]) :][: 2 * P.MODE_SIZE].reshape(2, -1)
    free = rows[:, P.MODE_STIFFNESS] / rows[:, P.MODE_MASS]
    # what a start without bending would begin with: 1e2 of what is left here
    assert np.abs(accelerations[::2]).max() < 0.02 * np.abs(free * start[::2]).max()
    values = run.run(2e-3, 2e-5)[:, Z.flexures(12, 0) :]
    still = np.abs(values[:, 0]).max() / np.sqrt(free[0])  # m
    # what is left is the passing of the balls, 0.2; from straight rings it would be 2
    assert still < 0.3 * start[0]


def test_bent_rings_start_at_rest(scene):
    """Under axial load alone rings bend from the steady state, so that nothing moves them."""
    flexible = bending(quiet(scene(SCENE)), inner=(2,), outer=(2, 3))
    run = Run(flexible, 20000, preload=300.0, bends=True, GRAVITY=0.0, CAGE=0.0).init()
    rings = run.s[S.Y + Y.V0 : S.Y + Y.V0 + Q.RINGS]
    fastest = 0.0
    for _ in range(50):
        run.step(1e-5)
        fastest = max(fastest, np.abs(rings[[Q.X, Q.OUTER + Q.X]]).max())
    assert fastest < 1e-9  # m/s; from the quasi-static state 4e-5


def test_state_saved_and_restored(scene):
    run = Run(scene(SCENE), 20000, modes=MODES).init()
    run.run(2e-3, 1e-3)
    kept = run.s.copy()
    first = run.run(1e-3, 1e-4)
    run.w[:] = 7.0  # scratch: nothing may survive in it
    run.s[:] = kept
    np.testing.assert_array_equal(run.run(1e-3, 1e-4), first)


def test_rigid_rings_carry_nothing(scene):
    """Empty lists of orders, and none: the same numbers, and no place for modes in any array."""
    rigid = quiet(scene(SCENE))
    empty = bending(rigid).mounting.flexure
    listed = rigid.model_copy(update={"mounting": rigid.mounting.model_copy(update={"flexure": empty})})
    without, with_empty = pack(rigid, np.empty(0)), pack(listed, np.empty(0))
    np.testing.assert_array_equal(without, with_empty)
    assert S.size(without) == S.SOUND
    unknowns = PT.BALL * int(without[P.BALLS]) + PT.TAIL  # of the steady state
    assert W.size(without) == W.SOUND + W.SPARE + PT.MATRICES * unknowns * (unknowns + 1)
    runs = [Run(one, 20000, bends=True).init() for one in (rigid, listed)]
    np.testing.assert_array_equal(*(run.run(2e-3, 1e-3) for run in runs))


def test_scene_with_flexible_rings(scene):
    """From the scene's table to outputs by name: the engine's coordinates in their order."""
    flexible = bending(quiet(scene(SCENE)), inner=(2,), outer=(2, 3), outer_seat_stiffness_N_m=1e7)
    model = prepare(flexible)
    assert model.n_modes == 3
    rows = model.parameters[int(model.parameters[P.AT_MODES]) :][: 3 * P.MODE_SIZE].reshape(3, -1)
    np.testing.assert_array_equal(rows[:, :2], [[0, 2], [1, 2], [1, 3]])
    found = ring_modes(flexible)
    free = found[1].modal_mass * (2 * np.pi * found[1].frequency) ** 2
    assert rows[1, P.MODE_STIFFNESS] == pytest.approx(free + 1e7 * found[1].seat, rel=1e-12)
    assert model.parameters[P.MODE_STEP] == pytest.approx(0.25 / found[2].frequency, rel=0.03)
    bearing = Instance(model)
    bearing.initialise()
    bearing.step(1e-3)
    names = [
        f"{ring}_ring.flexure.n{n}.{part}"
        for ring, n in (("inner", 2), ("outer", 2), ("outer", 3))
        for part in ("cosine", "sine")
    ]
    assert [v.name for v in model.variables if ".flexure." in v.name] == names
    flexure = Flexure(bearing.p, np.zeros(W.size(bearing.p)))
    np.testing.assert_array_equal([bearing.get(name) for name in names], flexure.state(bearing.s)[1])
    assert not any(".flexure." in v.name for v in prepare(quiet(scene(SCENE))).variables)


def test_shape_at_the_groove_centre(scene):
    """The section turns as a rigid body from the contact to the centre of the groove's circle."""
    flexible = bending(scene("7009C-full-ceramic"), inner=(2,), outer=(2,))
    for mode, conformity, side in zip(ring_modes(flexible), (0.515, 0.52), (1.0, -1.0), strict=True):
        b = flexible.bearing
        reach = side * conformity * 1e-3 * b.ball_diameter_mm
        angle = np.deg2rad(b.contact_angle_deg)
        arm = reach * np.array([np.sin(angle), np.cos(angle), 0.0])
        turned = mode.groove + np.cross([0.0, 0.0, mode.groove_tilt], arm)
        np.testing.assert_allclose(groove_centre(flexible, mode), turned, atol=1e-15)
    with pytest.raises(SceneError, match=r"17 modes; at most 16"):
        mode_table(flexible, [replace(mode)] * 17)


@pytest.mark.parametrize("model", ["rings", "response"])
def test_what_knows_rigid_rings_only_is_refused(scene, model):
    flexible = bending(quiet(scene(SCENE)), outer=(2,))
    with pytest.raises(
        SceneError, match=r"fidelity\.model.*rigid rings only.*leave out `\[mounting\.flexure\]`"
    ):
        with_fidelity(flexible, model=model)


def test_level_auto_leaves_out_what_cannot_bend(scene):
    rigid = quiet(scene(SCENE))
    flexible = bending(rigid, outer=(2,))
    assert all(c.carries(rigid) for c in CANDIDATES)
    left = [c for c in CANDIDATES if c.carries(flexible)]
    assert left
    assert {(c.fidelity, c.method) for c in left} == {("full", "esdirk4")}
    with_fidelity(flexible, model="auto")  # the candidates bring their own fidelities


@pytest.mark.parametrize("fidelity", [1.0, 2.0])
def test_the_engine_refuses_them_too(scene, fidelity):
    run = Run(scene(SCENE), 20000, modes=MODES, FIDELITY=fidelity)
    before = run.s.copy()
    assert call("init", run.p, run.u, run.s, run.z, run.w, 0.0) == RIGID_ONLY
    np.testing.assert_array_equal(run.s, before)
    assert RIGID_ONLY in REASONS
