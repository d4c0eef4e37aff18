"""Bearings of a set that differ: statics, runs, modes and sound of each with its own size and balls.

A 7002C with steel balls (9 of them, or as many as the catalogue has) behind 7003C with ceramic ones.
"""

import math
import warnings

import numpy as np
import pytest

from fmu_bearing import campbell, modes, operating_point, read_scene, record, report, simulate, statics
from fmu_bearing.engine.layout import SP, F, P, U
from fmu_bearing.engine.status import BAD_INPUT
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.recording.measurements.measure import known_lines
from fmu_bearing.reports.sections.arrangement import pressure_centres
from fmu_bearing.scene import Scene
from fmu_bearing.scene.mounting import Mounting
from tests.conftest import ROOT
from tests.engine.condensed import FIDELITIES
from tests.marks import heavy_but
from tests.modal.test_set_modes import decays
from tests.oracles import Bearing
from tests.oracles.jones_harris import JonesHarris
from tests.oracles.shaft import shaft
from tests.spindle.rest import oracle as rest
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene
from tests.spindle.test_dynamics_oracle import SEATS, bent
from tests.spindle.test_rings import LOAD, compared, wavy
from tests.spindle.test_runs import answers_as_the_dense_system, beam, follows_the_oracle, loaded
from tests.spindle.test_sound import MicrophoneSignals, pair as sounding_pair, sound

MOTOR = ROOT / "examples" / "spindle_set" / "7003C-7002C.toml"
SMALL = {"spindle.bearing[2].bearing": "NSK-7002C", "spindle.bearing[2].materials.balls": "GCr15"}
NO_CAGE = {"bearing.cage": None, "spindle.bearing[2].bearing.cage": None}
#: Waves small enough for the linear answer, see test_response.
TENTH = {
    "imperfections.inner_race_amplitude_um": 0.005,
    "imperfections.outer_race_amplitude_um": 0.005,
    "imperfections.ball_diameter_spread_nm": 2.5,
}
SPRUNG = {
    "spindle.bearing[2].seat": "sliding",
    "spindle.preload": {"kind": "spring", "force_N": 200.0, "stiffness_N_m": 0.0},
}


def pair(rpm=0.0, preload=300.0, changes=None, **spindle):
    """A 7003C and the small one behind it, back to back."""
    return scene("+-", (40.0, 70.0), preload, rpm, **spindle).replace(SMALL | (changes or {}))


def of_oracle(one):
    """The oracle's numbers of a bearing's own scene."""
    b, of = one.bearing, one.materials
    return Bearing(
        ball_diameter=1e-3 * b.ball_diameter_mm, pitch_diameter=1e-3 * b.pitch_diameter_mm,
        ball_count=b.ball_count, ring_modulus=1e9 * of.inner_ring.youngs_modulus_GPa,
        ring_poisson=of.inner_ring.poisson_ratio, inner_conformity=b.inner_conformity,
        outer_conformity=b.outer_conformity, contact_angle=math.radians(b.contact_angle_deg),
        ball_modulus=1e9 * of.balls.youngs_modulus_GPa, ball_poisson=of.balls.poisson_ratio,
        ball_density=of.balls.density_kg_m3,
    )  # fmt: skip


def alone(given, number, **mounting):
    """The scene of one bearing of a set, from 0, on a mounting of its own."""
    one = given.bearings()[number].scene
    mounted = Mounting(pedestal_stiffness_N_m=1e8, **mounting)
    return Scene.from_dict(one.model_dump(exclude={"mounting"}) | {"mounting": mounted.model_dump()})


def test_the_bearings_differ_in_all_that_matters():
    """Number of balls and lanes, sizes, masses: what a test of equal parts would not see."""
    given = pair()
    first, second = given.geometries
    assert first.ball_count != second.ball_count and first.pitch_diameter_mm != second.pitch_diameter_mm
    run = SetRun(given)
    assert [int(run.of(run.p, b, "P")[P.BALLS]) for b in range(2)] == [12, second.ball_count]


@pytest.mark.heavy
def test_loads_are_those_of_independent_bearings_on_one_shaft():
    """Newton's method of the engine against a general root finder over two bearings of its own."""
    given = pair()
    found = statics(given, force=(100.0, 0.0, -150.0), at=0.0)
    each = [of_oracle(one.scene) for one in given.bearings()]
    places = [JonesHarris(one).static_axial(300.0)[2] for one in each]
    assert abs(places[0] / places[1] - 1.0) > 0.02
    q, carried = shaft(each, (0.04, 0.07), (1, -1), places, (100.0, 0.0, -150.0), 0.0)
    largest = np.abs(carried[:, :3]).max()
    for one, expected in zip(found.bearings, carried, strict=True):
        # other equations and solver; across, balls that creep at the start have 2e-4 of traction (test_rest)
        np.testing.assert_allclose(one.force, expected[:3], rtol=0, atol=2e-4 * largest)
        np.testing.assert_allclose(one.moment, expected[3:], rtol=0, atol=1e-4)
    np.testing.assert_allclose(found.displacement, q, rtol=0, atol=1e-5 * np.abs(q).max())


@pytest.mark.parametrize("seat", ["fixed", "pedestal", "sliding"])
def test_a_set_rests_where_the_oracle_does(seat):
    given = loaded(seat, rpm=0.0).replace(SMALL)
    found, wanted = statics(given), rest(given)
    for one, held in zip(found.bearings, wanted.held, strict=True):
        mirrored = -held.force * np.array([one.sign, 1.0, 1.0, one.sign, one.sign])
        assert np.abs(one.force - mirrored[:3]).max() < 2e-4 * np.abs(mirrored).max()


def test_each_carries_its_preload_by_displacements_of_its_own():
    found = statics(pair(), force=(0, 0, 0))
    # places are found within 1e-13 m, of 10 um
    assert found.preloads["cold"] == pytest.approx([300.0, 300.0], rel=1e-7)
    each = [of_oracle(one.scene) for one in pair().bearings()]
    for one, model in zip(found.bearings, each, strict=True):
        assert one.displacement[0] == pytest.approx(JonesHarris(model).static_axial(300.0)[2], rel=1e-6)
    # the softer one gives way when the other is unloaded: loads at both ends of the joint displacement
    reach = sum(one.displacement[0] for one in found.bearings)
    for way, k in (("-x", 1), ("+x", 0)):
        load = JonesHarris(each[k])
        assert load.static_axial(abs(found.lift_off[way].load))[2] == pytest.approx(reach, rel=1e-4)


@pytest.mark.parametrize("rpm", [0.0, 12e3])
def test_each_bearing_is_the_single_bearing_of_its_own_scene(rpm):
    """A spring of constant force pushes both through a shaft that is free along its axis: each carries it."""
    given = pair(rpm, None, SPRUNG | {"fidelity.tolerance": 1e-5}).replace(NO_CAGE)
    of_set = Instance(prepare(given, fidelity="full"))
    of_set.initialise()
    of_set.step(2e-3)
    for k, bearing in enumerate(given.bearings()):
        one = Instance(prepare(alone(given, k, preload_N=200.0), fidelity="full"))
        one.initialise()
        one.step(2e-3)
        assert of_set.get(f"{bearing.prefix}force.x") == pytest.approx(bearing.sign * 200.0, rel=1e-6)
        for name in ("contact.inner.load_mean", "contact.outer.load_mean", "contact.inner.angle_mean"):
            assert of_set.get(bearing.prefix + name) == pytest.approx(one.get(name), rel=1e-6)
        if rpm:
            assert of_set.get(f"{bearing.prefix}friction_torque") == pytest.approx(
                one.get("friction_torque"), rel=1e-5
            )


@pytest.mark.parametrize("own", [None, bent], ids=["rigid", "bent"])
@pytest.mark.parametrize("seat", heavy_but(SEATS, "sliding in housing"))
def test_elimination_is_the_dense_answer(seat, own):
    given = loaded(seat).replace(SMALL)
    shaft_of = None if own is None else own(given)
    run = SetRun(given, shaft=shaft_of).init()
    answers_as_the_dense_system(given, shaft_of, run, slice(F.BODY, F.WORK))


RUNS = {"fixed": None, "sliding": None, "pedestal": bent, "housing": beam}


@pytest.mark.parametrize("seat", heavy_but(RUNS, "fixed"))
def test_runs_are_those_of_the_oracle(seat):
    given, own = loaded(seat, **{"fidelity.tolerance": 1e-6}).replace(SMALL), RUNS[seat]
    follows_the_oracle(given, None if own is None else own(given))


def test_what_bearings_and_loads_give_moves_the_shaft():
    """Newton's third law along the axis, in 2 ms of waves at a tight tolerance, and the energy balance."""
    flaws = {"imperfections": {"grade": "P4", "seed": 1}, "fidelity.tolerance": 1e-5}
    run = SetRun(loaded("fixed").replace(SMALL | flaws)).init()
    mass = 1.0 / run.p[run.block + int(run.p[run.block + SP.AT_INVERSE])]
    moved = []
    for _ in range(20):
        run.run(1e-4)
        left = 100.0 - sum(run.value("force.x", b) for b in range(2))
        moved.append((left, mass * run.vector(2)[0]))
    forces, inertia = np.array(moved).T
    assert np.abs(inertia).max() > 0.1
    # the acceleration of the last stage has what Newton's method leaves, the forces are of the end
    assert np.abs(forces - inertia).max() < 1e-3 * np.abs(inertia).max()
    assert abs(run.value("energy.residual")) < 1e-5


def test_a_speed_that_the_larger_bearing_cannot_have_is_refused_by_the_engine():
    """143 m/s of the balls' circle, were it a wheel: the larger one is behind."""
    large = {
        "spindle.bearing[2].bearing": "NSK-7010C", "spindle.bearing[2].position_mm": 120.0,
        "operation.speed_rpm": 10e3,
    }  # fmt: skip
    run = SetRun(scene("+-", (40.0, 70.0), changes=large))
    pitch = run.of(run.p, 1, "P")[P.PITCH_RADIUS]
    for share, refused in ((0.98, False), (1.02, True)):
        run.u[U.SPEED] = share * max(1.1e4, 143.0 / pitch)
        assert (run.try_init() == BAD_INPUT) is refused


@pytest.mark.parametrize(("way", "push"), [(0, 2.0), (1, 1.0)], ids=["axial", "radial"])
def test_the_engine_rings_at_the_frequencies_of_the_modes(way, push):
    """0.5 %, as of equal bearings: the amplitude is finite and the cage is out of both."""
    given = pair(10e3, 500.0)
    found, order = modes(given), min(way, 1)
    lowest = min((mode for mode in found.modes if mode.order == order), key=lambda mode: mode.frequency)
    poles = decays(given, way, push, lowest.frequency)
    assert abs(abs(poles.imag) / (2.0 * np.pi) - lowest.frequency).min() < 0.005 * lowest.frequency
    # across it is the shaft that swings; along with two of either bearing it is elsewhere
    for one in ("7003C", "NSK-7002C") if way == 0 else ():
        equal = scene("+-", (40.0, 70.0), 500.0, 10e3).replace({"bearing.catalogue": one})
        others = [mode.frequency for mode in modes(equal).modes if mode.order == order]
        assert abs(min(others) / lowest.frequency - 1.0) > 0.005


@pytest.mark.parametrize(
    ("fidelity", "settle", "most"),
    [("rings", 0.02, 0.05), ("response", 0.05, 0.1)],
    ids=["rings", "response"],
)
def test_vibration_is_that_of_full(fidelity, settle, most):
    """Bounds as of equal bearings (test_rings, test_response), of a pair with waves and weight."""
    load = {"force_z_N": -50.0, "position_mm": 0.0}
    given = wavy(pair(10e3, 500.0, {"fidelity.terms.gravity": True}, load=load)).replace(TENTH)
    ratio = compared(given, settle=settle, duration=0.03, fidelity=FIDELITIES[fidelity])
    assert np.abs(ratio - 1.0).max() < most


@pytest.mark.parametrize("seat", ["pedestal", "sliding in housing"])
def test_vibration_on_other_seats_is_that_of_full(seat):
    preload = None if "sliding" in seat else 500.0
    changes = {"fidelity.terms.gravity": True} | SEATS[seat]
    given = scene("+-", (40.0, 70.0), preload, 15e3, changes=changes, load=LOAD)
    ratio = compared(wavy(given.replace(SMALL)), duration=0.02, fidelity=FIDELITIES["rings"])
    assert np.abs(ratio - 1.0).max() < 0.05


@pytest.mark.parametrize("fidelity", heavy_but(["full", "rings"], "rings"))
def test_pressures_add_sample_by_sample(fidelity):
    """The same motion with one bearing muted, then the other."""
    places = [(40.0, 105.0, 0.0), (-60.0, 3.0, 4.0), (100.0, 105.0, 0.0)]
    given = sounding_pair(sound("compact", *places), flaws=True)
    given = given.replace(SMALL | {"fidelity.model": fidelity})
    given = given.replace({"spindle.bearing[2].bearing.ball_count": 9})
    both, first, second = (MicrophoneSignals(given, silent) for silent in ((), (1,), (0,)))
    size = np.abs(both.pressures).max()
    assert size > 1e-5
    # the motion is the same to the last bit; sums in another order
    assert np.abs(both.pressures - first.pressures - second.pressures).max() < 1e-13 * size + 1e-17
    for mic in range(3):
        assert both.alone(mic, 0) == pytest.approx(first.of(mic, "spl"), abs=1e-9)
        assert both.alone(mic, 1) == pytest.approx(second.of(mic, "spl"), abs=1e-9)


def test_each_sounds_as_a_bearing_of_its_own_size():
    """Filters of the second block are those of a set of its kind alone, for the same places."""
    given = sounding_pair(sound("compact", (40.0, 105.0, 0.0)), flaws=True)
    of_both = sound_blocks(given.replace(SMALL))
    of_small = sound_blocks(given.replace({"bearing.catalogue": "NSK-7002C", "materials.balls": "GCr15"}))
    of_large = sound_blocks(given)
    assert np.array_equal(of_both[0], of_large[0]) and np.array_equal(of_both[1], of_small[1])
    assert not np.array_equal(of_both[1], of_large[1])


@pytest.mark.heavy
@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_sound_is_that_of_full(fidelity):
    """Without cages, whose rattle rings leave out; what the start sets ringing has died away by 0.4 s."""
    given = sounding_pair(sound("compact", (55.0, 0.0, 1000.0)), flaws=True).replace(SMALL | TENTH)
    given = given.replace(NO_CAGE | {"fidelity.tolerance": 1e-3})
    names = ["mic[1].spl_slow", "mic[1].spl_bearing[1]", "mic[1].spl_bearing[2]"]
    full, other = (
        simulate(given.replace({"fidelity.model": one}), 0.4, step=1e-3, outputs=names, progress=False)
        for one in ("full", fidelity)
    )
    for name in names:
        assert other[name][-1] == pytest.approx(full[name][-1], abs=1.0)


def test_each_point_has_its_own_ratings_frequencies_and_film():
    given = pair(12e3, 300.0)
    found = operating_point(given)
    for k, one in enumerate(found.bearings):
        single = operating_point(alone(given, k, preload_N=one.axial))
        (own,) = single.bearings
        assert one.rating.dynamic == own.rating.dynamic and one.speed_number == own.speed_number
        # under the same axial load, on a shaft that does not tilt
        assert one.frequencies.f_o == pytest.approx(own.frequencies.f_o, rel=1e-5)
        assert one.friction_torque == pytest.approx(own.friction_torque, rel=1e-3)
        assert one.film == pytest.approx(own.film, rel=1e-4)
    first, second = found.bearings
    assert abs(first.rating.dynamic / second.rating.dynamic - 1.0) > 0.04
    shares = [one.life ** (-10.0 / 9.0) for one in found.bearings]
    assert found.life == pytest.approx(sum(shares) ** -0.9, rel=1e-12)
    ranges = found.torque_range
    for one, ends in zip(found.bearings, ranges.bearings, strict=True):
        assert ends.low < one.friction_torque < ends.high


@pytest.fixture(scope="module")
def heard():
    given = read_scene(MOTOR).replace({"fidelity.model": "response"})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return record(given, 0.03, progress=False)


def test_lines_are_named_by_the_bearing_that_makes_them(heard):
    """Balls pass at 2,005 Hz in the pair and at 1,776 Hz behind: no mean of both is a line of either."""
    first, _, third = heard.bearing_kinematics()
    assert third.f_o == pytest.approx(11 * third.f_c, rel=1e-9) and third.f_o < 0.9 * first.f_o
    lines = {line.name: line.frequency for line in known_lines(heard, 5e3)}
    assert lines["f_o of bearing 3"] == pytest.approx(third.f_o, rel=1e-9)
    assert lines["f_o - f_r of bearing 1"] == pytest.approx(first.f_o - first.f_r, rel=1e-9)
    assert lines["2 f_r"] == pytest.approx(800.0, rel=1e-9)
    with pytest.raises(ValueError, match=r"7003C-7002C: its bearings differ.*bearing_kinematics"):
        heard.kinematics()
    assert list(heard.kinematics_by_name()) == ["bearing 1", "bearing 2", "bearing 3"]


def test_a_report_draws_each_in_its_own_size():
    given = read_scene(MOTOR)
    places = pressure_centres(given)
    b = given.geometries[2]
    reach = 0.5 * b.pitch_diameter_mm * math.tan(math.radians(b.contact_angle_deg))
    assert places[2] == pytest.approx(141.0 + reach, rel=1e-12)
    assert places[2] - 141.0 < 47.0 - places[1]


@pytest.mark.heavy
def test_a_campbell_diagram_names_the_bearing_of_a_line():
    """The pair at the nose has 12 balls, the bearing behind 11; the unbalance is one of all."""
    given = read_scene(MOTOR)
    found = campbell(given, [20e3, 24e3, 28e3], highest=5e3)
    names = [line.name for line in found.lines]
    assert names.count("f_r") == 1 and not any(name.startswith("f_r of") for name in names)
    lines = {line.name: line for line in found.lines}
    first, _, third = (one.frequencies for one in operating_point(given).bearings)
    # at 24,000 r/min, the second speed; the pair's two bearings turn alike within 0.03 %
    assert lines["f_o of bearing 3"].frequency[1] == pytest.approx(third.f_o, rel=1e-4)
    assert lines["f_o of bearings 1, 2"].frequency[1] == pytest.approx(first.f_o, rel=1e-3)
    # waves of a race move a ring by the order by which theirs differs from the number of balls
    for name, balls in (("f_o of bearing 3", 11), ("f_o of bearings 1, 2", 12)):
        same = [line for line in found.lines if line.name == name]
        assert {abs(line.surface_order - balls) - line.order for line in same} == {0}
    assert found.rates.f_o[1] == pytest.approx(first.f_o, rel=1e-3)


@pytest.mark.heavy
@pytest.mark.parametrize("seal", [{}, {"kind": "RSH"}])
def test_a_deep_groove_bearing_floats_behind(seal):
    """Its spring presses it; each fidelity has the torque of `full`, with seals on this bearing alone."""
    given = read_scene(MOTOR).replace({"spindle.bearing[3].bearing": "6002"})
    given = given.replace({"imperfections": None, "sound": None})
    if seal:
        given = given.replace({"spindle.bearing[3].bearing.seal": seal})
    rear = given.geometries[2]
    assert rear.is_deep_groove and (rear.seal_torque > 5.0) == bool(seal)
    point = operating_point(given)
    # 150 N of the spring, less what the shaft's own place takes of it: 5e4 N/m over some micrometres
    assert point.bearings[2].load.axial == pytest.approx(150.0, abs=0.5)
    assert any(one.name == "seals" for one in point.torque_range.inputs) == bool(seal)
    torques = {}
    for fidelity in ("full", "rings", "response"):
        run = Instance(prepare(given, fidelity=fidelity))
        run.initialise()
        means = []
        for _ in range(40):
            run.step(5e-4)
            means.append([run.get(f"bearing[{k}].friction_torque") for k in (1, 2, 3)])
        torques[fidelity] = np.mean(means, axis=0)
        assert run.get("bearing[3].clearance") > 0.0
    for fidelity in ("rings", "response"):
        np.testing.assert_allclose(torques[fidelity], torques["full"], rtol=0.01)


@pytest.mark.heavy
def test_a_report_of_bearings_that_differ(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made = report(read_scene(MOTOR).replace({"fidelity.model": "response"}), tmp_path / "a.html")
    page = made.read_text("utf-8")
    for words in ("2 x 7003C + 1 x NSK-7002C", "of bearing 3", "and what excites them", "15 x 32 x 9 mm"):
        assert words in page, words
