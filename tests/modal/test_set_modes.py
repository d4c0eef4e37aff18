"""Modes of a set against the single bearing, against statics and against the engine's own free decay."""

import numpy as np
import pytest
from scipy.linalg import eigh

from fmu_bearing import campbell, modes, statics
from fmu_bearing.engine.layout import S, U, Y
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.scene import Scene
from fmu_bearing.steady.impedance import at_rest
from tests.spindle.one import set_of_one
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene, tables

_LENGTH, _DIAMETER = 180.0, 15.0  # mm: of a shaft that is the single bearing's rotor


BENT = {"outer_ring": [2, 3], "inner_ring": [2]}
SEATS = {"outer_seat_stiffness_N_m": 1e7, "inner_seat_stiffness_N_m": 1e7}


@pytest.mark.parametrize("flexure", [None, BENT | SEATS], ids=["rigid", "bending"])
@pytest.mark.parametrize("rpm", [10_000.0, 40_000.0])
@pytest.mark.parametrize("radial", [0.0, -50.0])
def test_a_set_of_one_is_the_mounted_bearing(rpm, radial, flexure):
    """Both are steady: at 40,000 r/min that moves modes by 1 %."""
    several, one = set_of_one(rpm, radial, mount={"flexure": flexure})
    alone, system = linearised(one), linearised(several)
    assert alone.steady and system.steady
    wanted = [value for value in np.linalg.eigvals(alone.matrix) if abs(value.imag) > 1e4]
    found = np.linalg.eigvals(system.matrix)
    # 6e-8 and 5e-7 under a radial load, 4e-10 and 1e-9 without
    assert max(abs(found - value).min() / abs(value) for value in wanted) < 1e-6
    stiff = at_rest(alone.bearings[0])
    atol = 1e-6 * np.abs(stiff).max()
    np.testing.assert_allclose(at_rest(system.bearings[0]), stiff, rtol=0.0, atol=atol)


@pytest.mark.parametrize("rpm", [20_000.0, -20_000.0])
def test_rings_of_a_set_bend_as_those_of_the_mounted_bearing(rpm):
    """Names with the bearing's number, the same waves round the ring and the same damping."""
    several, one = set_of_one(rpm, mount={"flexure": BENT | SEATS})
    wanted, found = (
        [mode for mode in modes(given).modes if "flexure" in mode.name] for given in (one, several)
    )
    assert {mode.name for mode in found} == {
        f"{name} of bearing 1"
        for name in ("outer flexure n = 2", "outer flexure n = 3", "inner flexure n = 2")
    }
    for mode, other in zip(found, wanted, strict=True):
        assert mode.name == f"{other.name} of bearing 1"
        assert (mode.order, mode.direction) == (other.order, other.direction) and mode.direction
        assert mode.frequency == pytest.approx(other.frequency, rel=1e-6)
        assert mode.damping == pytest.approx(other.damping, rel=1e-4)
    branches = campbell(several, [rpm, 1.1 * rpm, 1.2 * rpm], highest=40e3).branches
    assert {mode.name for mode in found} <= {branch.name for branch in branches}


@pytest.mark.parametrize("kind", ["spacer", "spring", "housed"])
def test_runs_of_a_set_settle_where_its_modes_stand(kind):
    """Orbit and spin of the balls after 50 ms of fidelity full without cage, as for one bearing."""
    several = housed() if kind == "housed" else scene("+-", (40.0, 70.0), rpm=40_000.0)
    if kind == "spring":
        several = several.replace(
            {"spindle.preload": {"kind": "spring", "force_N": 300.0}, "spindle.bearing[2].seat": "sliding"}
        )
    several = several.replace({"operation.speed_rpm": 40_000.0, "fidelity.terms.gravity": False})
    level = several.spindle.shaft.model_copy(update={"unbalance": ()})
    several = several.model_copy(update={"spindle": several.spindle.model_copy(update={"shaft": level})})
    run, system = SetRun(several, CAGE=0.0), linearised(several)
    assert system.steady
    run.init()
    start = run.s.copy()
    for _ in range(50):
        assert run.step(1e-3) == 0
    for k, one in enumerate(system.bearings):
        balls = one.coordinates.balls
        for row in (Y.R, Y.OM, Y.WX, Y.WR):
            own = slice(S.Y + row, S.Y + row + balls)
            states = run.state(k), one.arrays.s, run.of(start, k, "S")
            reached, found, first = (s[own].mean() for s in states)
            # a hundredth of the way that the run has gone, or rounding
            assert found == pytest.approx(reached, abs=0.01 * abs(reached - first) + 1e-6 * abs(reached)), row


def test_standstill_has_the_frequencies_of_statics():
    """What is left is the balls' inertia, some grams against the shaft's 0.7 kg."""
    pair = scene("+-", (40.0, 70.0))
    system = linearised(pair, friction=False)
    squares = eigh(statics(pair).stiffness, system.shaft.total)[0]
    found = np.linalg.eigvals(system.matrix).imag / (2.0 * np.pi)
    for wanted in np.sqrt(squares) / (2.0 * np.pi):
        assert abs(found - wanted).min() < 0.01 * wanted


def test_a_set_seen_from_its_rear_has_the_same_modes():
    """The shaft turns the other way then; loads are at the same bearings.

    Overdamped motions of the balls are left out: their eigenvalues lie close together, and rounding moves
    them by 4e-6.
    """
    load = {"force_x_N": 100.0, "force_z_N": -60.0, "position_mm": 190.0}
    front = scene("+-", (150.0, 210.0), rpm=12_000.0, load=load)
    turned = load | {"force_x_N": -100.0, "position_mm": 210.0}
    rear = scene("+-", (190.0, 250.0), rpm=-12_000.0, load=turned)
    wanted, found = (linearised(several) for several in (front, rear))
    assert found.orbits == pytest.approx(-wanted.orbits[::-1], rel=1e-9)
    values = np.linalg.eigvals(wanted.matrix)
    swings = values[(values.imag > 3e3) & (-values.real < 0.2 * abs(values))]
    others = np.linalg.eigvals(found.matrix)
    assert len(swings) >= 5  # one along the axis, two pairs across it
    assert max(abs(others - value).min() / abs(value) for value in swings) < 1e-8


_SAMPLES = 40  # per period of the mode looked for
_PERIODS = 10


def decays(pair, way, push, frequency):
    """Eigenvalues in the nose's motion after a force on it ceases, from a run of the engine.

    ``way``: 0 axial, 1 horizontal, 2 vertical. By the matrix pencil: y_k = sum c_i e^(s_i k h).
    """
    moved, quiet = SetRun(pair, CAGE=0.0, TOLERANCE=1e-6), SetRun(pair, CAGE=0.0, TOLERANCE=1e-6)
    moved.u[U.NOSE + way] += push
    moved.init()
    quiet.init()
    moved.u[U.NOSE + way] -= push
    h = 1.0 / (_SAMPLES * frequency)
    apart = []
    for _ in range(_SAMPLES * _PERIODS):
        assert moved.step(h) == 0
        assert quiet.step(h) == 0
        apart.append(moved.vector(0)[way] - quiet.vector(0)[way])
    trace = np.array(apart)[:: _SAMPLES // 10]
    rows = len(trace) // 2
    hankel = np.array([trace[k : k + rows] for k in range(len(trace) - rows)])
    left, sizes, right = np.linalg.svd(hankel)
    rank = int(np.sum(sizes > 1e-4 * sizes[0]))
    base = right[:rank].T
    poles = np.linalg.eigvals(np.linalg.pinv(base[:-1]) @ base[1:])
    return np.log(poles) / (h * (_SAMPLES // 10))


@pytest.mark.heavy
@pytest.mark.parametrize(("way", "push"), [(0, 2.0), (1, 1.0)], ids=["axial", "radial"])
@pytest.mark.parametrize("which", ["pair", "four that bend"])
def test_the_engine_rings_at_these_frequencies(which, way, push):
    """0.5 %: the amplitude is finite and the cage is out of both."""
    rpm = 10_000.0
    if which == "pair":
        several = scene("+-", (40.0, 70.0), rpm=rpm)
    else:
        several = scene(
            "++--", (40.0, 60.0, 130.0, 150.0), rpm=rpm,
            shaft={"sections_mm": [[200.0, 17.0, 0.0]], "flexible": True},
        )  # fmt: skip
    found = modes(several)
    order = min(way, 1)
    lowest = min((mode for mode in found.modes if mode.order == order), key=lambda mode: mode.frequency)
    poles = decays(several, way, push, lowest.frequency)
    frequency = abs(poles.imag) / (2.0 * np.pi)
    assert abs(frequency - lowest.frequency).min() < 0.005 * lowest.frequency


@pytest.mark.parametrize("rpm", [20_000.0, -20_000.0])
def test_gyroscopic_effect_parts_the_whirls(rpm):
    """Forward goes up, backward down: a thick disc at the nose of a shaft that bends; -X turns the same."""
    several = scene(
        "+-", (60.0, 110.0), rpm=rpm,
        shaft={"sections_mm": [[15.0, 70.0, 0.0], [125.0, 17.0, 0.0]], "flexible": True},
    )  # fmt: skip
    found = [mode for mode in modes(several).modes if mode.order == 1]
    forward, backward = (
        min(mode.frequency for mode in found if mode.direction == way) for way in ("forward", "backward")
    )
    assert forward > 1.02 * backward


def housed():
    """A pair with a sliding ring in a housing of 2 kg on 1e7 N/m, with a heavy spot on its shaft."""
    data = tables(
        "+-", (40.0, 70.0), rpm=10_000.0, bearings=[{}, {"seat": "sliding"}],
        housing={"mass_kg": 2.0, "diameter_mm": 80.0, "length_mm": 100.0, "pedestal_stiffness_N_m": 1e7},
    )  # fmt: skip
    data["spindle"]["preload"] = {"kind": "spring", "force_N": 300.0, "stiffness_N_m": 1e5}
    data["spindle"]["shaft"]["unbalance"] = [{"position_mm": 10.0, "amount_g_mm": 0.7}]
    return Scene.from_dict(data)


def test_housing_and_sliding_rings_have_modes():
    """The housing turns about the axis by itself; along it goes all that the bearings hold."""
    found = modes(housed())
    total = np.diag(found.linearised.shaft.total)
    turning = found.named("housing spin")
    assert turning.frequency == pytest.approx(np.sqrt(1e7 * 200e-6 / total[8]) / (2.0 * np.pi), rel=3e-3)
    assert turning.damping == pytest.approx(0.05, rel=0.01)
    # balls, 0.7 % of the mass, and springs that give a little; damping counts what lies on the pedestal
    axial, moved = found.named("housing axial"), total[0] + total[5] + total[11]
    assert axial.frequency == pytest.approx(np.sqrt(1e7 / moved) / (2.0 * np.pi), rel=0.015)
    assert axial.damping == pytest.approx(0.05 * np.sqrt(total[6] / moved), rel=0.05)
    sliding = found.named("sliding rings")
    assert sliding.participation["sliding rings"] > 0.9
    assert all(mode.damping > 0.0 for mode in found.modes)


@pytest.mark.heavy
def test_campbell_leaves_turning_out_and_takes_heavy_spots():
    several = housed()
    found = campbell(several, [5e3, 10e3, 15e3])
    assert "housing spin" in {branch.name for branch in found.branches}
    assert not {one.branch.name for one in found.crossings()} & {"housing spin"}
    (turning,) = (line for line in found.lines if line.name == "f_r")
    rings = 2.0 * several.materials.inner_ring.density_kg_m3 * 1e-9  # kg over mm3
    b = several.bearing
    rings *= np.pi / 4.0 * (b.inner_ring_outer_diameter_mm**2 - b.bore_mm**2) * b.width_mm
    shaft = several.materials.inner_ring.density_kg_m3 * 1e-9 * np.pi / 4.0 * 17.0**2 * 400.0
    assert turning.amplitude == pytest.approx(0.7e-6 / (rings + shaft), rel=1e-9)
    level = several.model_copy(
        update={"spindle": several.spindle.model_copy(
            update={"shaft": several.spindle.shaft.model_copy(update={"unbalance": ()})}
        )}
    )  # fmt: skip
    (turning,) = (line for line in campbell(level, [5e3, 10e3, 15e3]).lines if line.name == "f_r")
    assert not turning.present


def test_campbell_follows_the_modes_of_a_set():
    several = scene("+-", (40.0, 70.0), rpm=10_000.0)
    found = campbell(several, [5e3, 10e3, 15e3])
    names = {branch.name for branch in found.branches}
    assert {"shaft axial", "shaft tilt"} <= names
    assert all(branch.rpm.size == 3 for branch in found.branches if branch.name == "shaft axial")


def test_line_of_the_shaft():
    found = modes(scene("+-", (40.0, 70.0), rpm=10_000.0))
    mode = next(mode for mode in found.modes if mode.order == 1)
    line = found.line(mode)
    assert line.shape == (2, 3)
    assert abs(line).max() == pytest.approx(1.0)
    # a rigid shaft stays straight: nose, then 40 and 70 mm
    (nose, front, rear), (x0, x1, x2) = line.T, (0.0, 0.04, 0.07)
    assert front == pytest.approx(nose + (rear - nose) * (x1 - x0) / (x2 - x0), rel=1e-9, abs=1e-12)
    own = found.linearised.shaft.nose[1:3] @ mode.vector[found.linearised.places :][:5]
    assert nose * own[0] == pytest.approx(own * nose[0], rel=1e-9)
    with pytest.raises(ValueError, match="`line` returns the motion of the shaft"):
        found.shape(mode)
