"""Runs of sets: the table of variables, forces against statics, sums, signs, warnings, refusals."""

import re
import warnings

import numpy as np
import pytest

from fmu_bearing import Bearing, read_scene, simulate, statics, sweep, with_fidelity
from fmu_bearing.engine.layout import SP, P, U, Z
from fmu_bearing.instance import EngineError
from fmu_bearing.interface import variables
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare.model import prepare
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.run.choose import CANDIDATES, choose
from fmu_bearing.run.metrics import measure, of_kind
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import one_of
from tests.conftest import EXAMPLES
from tests.spindle.rest import oracle
from tests.spindle.sets import scene, tables
from tests.spindle.test_dynamics_oracle import NO_CAGE

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
QBC = EXAMPLES.parent / "spindle_set" / "7003C-QBC.toml"
SPRING = {"kind": "spring", "force_N": 300.0, "stiffness_N_m": 1e5}
HOUSING = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 120.0, "pedestal_stiffness_N_m": 1e8}


def spring():
    data = tables(preload=None, bearings=[{}, {"seat": "sliding"}])
    data["spindle"]["preload"] = SPRING
    return Scene.from_dict(data)


def table(found):
    return {variable.name: variable for variable in variables(found, 1e-5)}


def inputs(found):
    return [name for name, variable in table(found).items() if variable.causality == "input"]


def test_inputs_are_those_that_the_scene_reads():
    of_bearings = [f"bearing[{b}].{name}" for b in (1, 2) for name in U.BEARING_INPUTS]
    always = [
        "shaft_speed", "nose.force.x", "nose.force.y", "nose.force.z", "nose.moment.y", "nose.moment.z",
        "shaft_temperature", "housing_temperature",
    ]  # fmt: skip
    assert inputs(scene()) == [*always, *of_bearings]
    assert set(inputs(spring())) == {*always, "preload", *of_bearings}
    assert set(inputs(scene(housing=HOUSING))) == {*always, "pedestal_stiffness", *of_bearings}
    pedestals = scene(bearings=[{"seat": "pedestal"}, {}], housing={"pedestal_stiffness_N_m": 1e8})
    assert "pedestal_stiffness" in inputs(pedestals)


def test_starts_of_inputs_are_the_scenes_and_in_range():
    found = scene(load={"force_z_N": -300.0, "position_mm": -40.0}, rpm=9000.0)
    start = input_values(found)
    for variable in variables(found, 1e-5):
        if variable.causality == "input":
            assert variable.array == "u" and variable.min <= variable.start <= variable.max
            assert variable.start == start[variable.index]
    known = table(found)
    assert known["shaft_speed"].start == pytest.approx(9000.0 * np.pi / 30.0, rel=1e-15)
    # -300 N at 40 mm ahead of the nose: X F turned about +Y is -X F_z
    assert known["nose.force.z"].start == -300.0
    assert known["nose.moment.y"].start == pytest.approx(-12.0, rel=1e-15)


@pytest.mark.parametrize(
    "found",
    [scene(), scene("++--", (40.0, 52.0, 150.0, 162.0)), spring(), scene(housing=HOUSING)],
    ids=["DB", "QBC", "spring", "housing"],
)
def test_places_are_those_of_the_parameters(found):
    model = prepare(found)
    p, block = model.parameters, int(model.parameters[P.SET])
    assert model.lengths.inputs == len(model.inputs) == U.BEARINGS + len(found.bearings()) * U.ROW
    outputs = [(v.index, v.name) for v in model.variables if v.array == "z"]
    assert len(dict(outputs)) == len(outputs)  # no two at one place
    assert max(dict(outputs)) < model.lengths.outputs
    own = int(p[block + SP.AT_Z])
    for place, name in outputs:
        if not name.startswith("bearing["):
            assert SP.OUTPUTS[place - own] == name
            continue
        b, rest = re.fullmatch(r"bearing\[(\d+)\]\.(.*)", name).groups()
        if rest in SP.BEARING_OUTPUTS:
            first = own + SP.Z_FORCES + (int(b) - 1) * SP.Z_FORCE
            assert SP.BEARING_OUTPUTS[place - first] == rest
        elif not rest.startswith("ball["):
            first = p[SP.first(p, SP.AT_ROWS) + (int(b) - 1) * SP.ROW + SP.ROW_Z]
            assert Z.BEARING_OUTPUTS[int(place - first)] == rest


def test_each_bearing_has_the_variables_of_a_single_one():
    found = scene(rpm=9e3, housing=HOUSING, changes={"imperfections": {"grade": "P4", "seed": 1}})
    names, single = set(table(found)), table(one_of(found))
    shared = {f"solver.{name}" for name in ("steps", "rejected", "restarts", "growth", "wave_time")}
    shared.add("energy.residual")
    for name, variable in single.items():
        if variable.array == "z" and name not in shared:
            for b in (1, 2):
                mine = table(found)[f"bearing[{b}].{name}"]
                assert (mine.causality, mine.unit) == (variable.causality, variable.unit)
    parameters = {name for name, variable in single.items() if variable.causality == "parameter"}
    at_a_port = {name for name in SP.OUTPUTS if name.startswith("port.")}
    assert parameters | shared | set(SP.OUTPUTS) - at_a_port <= names
    assert not at_a_port & names
    assert not {f"bearing[1].{name}" for name in shared} & names
    held = {name for name in table(scene()) if name.startswith("housing.")}
    assert held == set() and "housing.velocity.x" in names


# friction along the tracks, which the oracle leaves out, is 0.6e-3 of the loads of the one, 1.2e-3 of the
# other; friction across them, which it shares by assumption, 0.8e-3 more of the other. The balls of QBC,
# loaded across the axis, settle while the rings stay where quasi-static bearings hold them: 1.7 %
@pytest.mark.parametrize(("file", "friction"), [(DB, 1e-3), (QBC, 2e-2)], ids=["DB", "QBC"])
def test_forces_at_the_start_are_those_of_statics(file, friction):
    perfect = read_scene(file).replace({"imperfections": None, "spindle.shaft.unbalance": ()})
    found, known = statics(perfect), oracle(perfect)
    bearing = Bearing(perfect)
    bearing.init()
    wanted = [-held.force * (one.sign, 1, 1, one.sign, one.sign)
              for one, held in zip(found.bearings, known.held, strict=True)]  # fmt: skip
    largest = max(np.linalg.norm(one[3:]) for one in wanted)
    for one, held in zip(found.bearings, wanted, strict=True):
        force = [bearing[f"bearing[{one.number}].force.{axis}"] for axis in "xyz"]
        moment = [bearing[f"bearing[{one.number}].moment.{axis}"] for axis in "yz"]
        assert force == pytest.approx(one.force) and moment == pytest.approx(one.moment)
        assert force == pytest.approx(held[:3], abs=friction * np.linalg.norm(held[:3]))
        assert moment == pytest.approx(held[3:], abs=2.0 * friction * largest)
    # 5e-3: the nose leans on the same stiffness, preload and friction come off
    nose = [bearing[f"shaft.nose.displacement.{axis}"] for axis in "xyz"]
    assert nose == pytest.approx(known.shaft[:3], abs=5e-3 * np.linalg.norm(known.shaft[:3]))
    assert nose == pytest.approx(found.displacement[:3])
    for _ in range(40):
        bearing.step(1e-3)
    for one, held in zip(found.bearings, wanted, strict=True):
        force = [bearing[f"bearing[{one.number}].force.{axis}"] for axis in "xyz"]
        # what the start set ringing is still 2e-3 to 4e-3
        assert force == pytest.approx(held[:3], abs=6e-3 * np.linalg.norm(held[:3]))
        assert force == pytest.approx(one.force, abs=(6e-3 + friction) * np.linalg.norm(one.force))


def test_sums_are_sums_and_lost_power_is_heat():
    run = simulate(DB, 5e-3, step=1e-3, outputs=["*"])
    for name in ("friction_torque", "friction_torque_mean", "heat.inner_ring", "heat.outer_ring", "heat.oil"):
        parts = [run[f"bearing[{b}].{name}"] for b in (1, 2)]
        # the same numbers added
        assert run[name] == pytest.approx(sum(parts), rel=1e-14)
        assert all((part > 0.0).all() for part in parts)
    heat = sum(run[f"heat.{where}"] for where in ("inner_ring", "outer_ring", "oil"))
    power = run["friction_torque_mean"] * run["shaft_speed"]
    # 0.1 J in 5 ms; what rings, balls and cages store meanwhile is in the residual
    assert np.sum(heat[1:]) == pytest.approx(np.sum(power[1:]), rel=1e-2)
    # five times what the internal tolerance of 1e-3 leaves in 5 ms
    assert abs(run["energy.residual"][-1]) < 1e-5


@pytest.mark.parametrize("signs", ["+-", "-+"])
def test_without_load_both_bearings_push_against_each_other(signs):
    run = simulate(scene(signs, rpm=10000.0), 3e-3, step=1e-3)
    first, second = (run[f"bearing[{b}].force.x"] for b in (1, 2))
    # of the 500 N what the shaft's mass takes is below 1e-4: it stands still
    assert first == pytest.approx(-second, rel=1e-4)
    assert np.sign(first[0]) == (1.0 if signs == "+-" else -1.0)
    assert np.abs(first) == pytest.approx(500.0, rel=5e-3)  # centrifugal forces and spin change it a little
    for axis, sign in (("x", -1.0), ("y", 1.0), ("z", 1.0)):
        balls = [run[f"bearing[{b}].ball[1].velocity.{axis}"][0] for b in (1, 2)]
        assert balls[0] == pytest.approx(sign * balls[1], rel=1e-6, abs=1e-9)  # m/s, of 10 and more


def test_tunable_parameters_hold_for_all_bearings():
    thin, thick = (Bearing(scene(rpm=10000.0)) for _ in range(2))
    thin.init()
    thick.set({"lubricant.viscosity_ref": 2.0 * thin["lubricant.viscosity_ref"]}).init()
    ratios = [thick[f"bearing[{b}].film.lambda_min"] / thin[f"bearing[{b}].film.lambda_min"] for b in (1, 2)]
    # Hamrock and Dowson: a film as viscosity to the power 0.68
    assert ratios == pytest.approx([2.0**0.68] * 2, rel=1e-6)


def test_imperfections_of_bearings_differ_and_grades_bring_no_unbalance():
    found = scene(rpm=10000.0, changes={"imperfections": {"grade": "P4", "seed": 1}})
    assert found.imperfections.unbalance_um == 0.0
    assert [one_of(found, k).imperfections.seed for k in range(2)] == [1, 2]
    # waves are as wide as the contacts under the preload are
    assert one_of(found, 1).mounting.preload_N == 500.0
    run = simulate(found, 2e-3, step=1e-4, outputs=["bearing[*].contact.inner.load_max"])
    first, second = (run[f"bearing[{b}].contact.inner.load_max"] for b in (1, 2))
    assert np.max(np.abs(first - second)) > 0.1  # N; without waves they are mirror images
    still = simulate(scene(rpm=10000.0), 2e-3, step=1e-4, outputs=["bearing[*].contact.inner.load_max"])
    assert np.max(np.abs(np.subtract(*(still[name] for name in still.names)))) < 1e-3


def test_a_spring_keeps_its_force():
    run = simulate(spring(), 2e-3, step=1e-3, inputs={"preload": 250.0, "shaft_speed": 1000.0})
    # the spring of 1e5 N/m gives up 0.1 N per um
    assert run["bearing[2].force.x"] == pytest.approx(-250.0, abs=0.5)


def test_a_housing_on_its_pedestal_sinks_under_the_load():
    bearing = Bearing(scene(housing=HOUSING))
    bearing.init({"nose.force.z": -400.0, "nose.force.x": 100.0})
    # 55 mm ahead of it the load also tilts the housing; its middle moves by force over stiffness
    assert bearing["housing.displacement.z"] == pytest.approx(-400.0 / 1e8, rel=1e-6)
    assert bearing["housing.displacement.x"] == pytest.approx(100.0 / 1e8, rel=1e-6)
    bearing.init({"pedestal_stiffness": 2e8})
    assert bearing["housing.displacement.z"] == pytest.approx(-400.0 / 2e8, rel=1e-6)


def test_an_unloaded_bearing_is_warned_of_by_its_number():
    bearing = Bearing(scene(rpm=10000.0))
    with warnings.catch_warnings(record=True) as reported:
        warnings.simplefilter("always")
        bearing.init({"nose.force.x": 3000.0})  # lift-off of the rear one: 2194 N
        bearing.step(1e-4)
    texts = [str(one.message) for one in reported]
    assert sum("is unloaded" in text for text in texts) == 1  # once
    assert any(text.startswith("bearing 2: its inner race carries 0.2 N per ball") for text in texts)
    assert any(text.startswith("bearing 1: the ellipse of the most loaded contact") for text in texts)


def test_refusals_name_the_inputs_of_the_set():
    bearing = Bearing(scene(rpm=10000.0))
    with pytest.raises(ValueError, match=r"bearing\[2\].oil_temperature = 1000.0 is refused"):
        bearing.set({"bearing[2].oil_temperature": 1000.0})
    with pytest.raises(ValueError, match="there is no input or parameter 'radial_load.z'"):
        bearing.set({"radial_load.z": 1.0})
    bearing.init()
    before = bearing.read("*")
    with pytest.raises(EngineError) as reported:
        bearing.step(-1.0)
    assert "inputs were shaft_speed = 1047.2, nose.force.x = 0, " in str(reported.value)
    assert str(reported.value).endswith("bearing[2].outer_ring_temperature = 293.15")
    assert bearing.read("*") == before


@pytest.mark.heavy
def test_auto_measures_all_bearings_of_a_set():
    """A pair with flaws: what is measured are the rings of both, loads, torque and what microphones hear."""
    flaws = {
        "seed": 1,
        "waviness_exponent": 0.5,
        "lowest_order": 2,
        "highest_order": 20,
        "inner_race_amplitude_um": 0.1, "outer_race_amplitude_um": 0.1, "ball_diameter_spread_nm": 50.0,
    }  # fmt: skip
    received = {"microphone": [{"name": "above", "x_mm": 55.0, "y_mm": 0.0, "z_mm": 1000.0}]}
    data = tables(rpm=20e3) | {"imperfections": flaws, "sound": received}
    given = Scene.from_dict(data).replace(NO_CAGE)  # whose rattle only full has
    short = {"warm_up": 0.02, "window": 0.02, "budget": 0.01}
    found = choose(with_fidelity(given, model="auto"), CANDIDATES[:3], **short)
    blocks = sound_blocks(given)
    sizes = measure(with_fidelity(given, model="response"), blocks, 0.02, 0.02).figures
    assert len(of_kind(sizes, "_ring.velocity")) == len(of_kind(sizes, ".load_mean")) == 4
    assert len(of_kind(sizes, ".leq_a")) == 1
    assert min(of_kind(sizes, "inner_ring.velocity")) > 1e-5
    assert sizes["friction_torque"] == pytest.approx(
        simulate(with_fidelity(given, model="response"), 1e-3, step=1e-3)["friction_torque"][-1], rel=1e-2
    )
    response, rings, _, truth = found.probes
    assert max(response.worst.ring_level, rings.worst.ring_level) < 1.0
    assert 0.0 < rings.worst.level < 1.0
    assert truth.worst.ring_level == 0.0
    assert found.probed == ("20,000 r/min", "10,000 r/min", "19,600 to 20,000 r/min in 20 ms")
    assert found.apply(given).fidelity.model == found.probe.fidelity


def test_rings_run_where_a_ring_is_on_its_own_pedestal():
    seats = {"bearings": [{"seat": "pedestal"}, {}], "housing": {"pedestal_stiffness_N_m": 1e8}}
    given = with_fidelity(scene(rpm=10000.0, **seats), model="rings")
    run = simulate(given, 2e-3, step=1e-3, outputs=["bearing[1].force.x"])
    assert run["bearing[1].force.x"][-1] == pytest.approx(500.0, rel=0.01)


@pytest.mark.parametrize("method", ["trbdf2", "rk4"])
def test_methods_agree(method):
    waves = {"imperfections": {"grade": "P4", "seed": 1}}
    names = ["bearing[*].force.x", "bearing[*].inner_ring.velocity.z"]
    runs = [
        simulate(with_fidelity(scene(rpm=10000.0, changes=waves), method=one), 2e-3, step=1e-3, outputs=names)
        for one in ("esdirk4", method)
    ]
    for name in runs[0].names:
        # each errs by the tolerance of 2e-3 of what is usual at this speed: 5 mm/s, some N
        scale = 5e-3 if name.endswith("velocity.z") else 500.0
        assert runs[1][name] == pytest.approx(runs[0][name], abs=1e-2 * scale)


def test_a_sweep_over_the_preload_of_spacers():
    axes = {"spindle.preload.preload_N": [100.0, 400.0]}
    found = sweep(DB, axes, settle=0.0, window=2e-3, workers=1)
    assert list(found["reason"].values) == ["", ""]
    for b, sign in ((1, 1.0), (2, -1.0)):
        preloads = sign * found[f"bearing[{b}].force.x"].values
        assert preloads[1] - preloads[0] > 200.0
    assert (found["shaft.nose.velocity"].values >= 0.0).all()


def test_a_single_bearing_on_a_shaft():
    found = scene("+", (40.0,), None, rpm=10000.0, load={"force_x_N": 300.0})
    run = simulate(found, 1e-3, step=1e-3)
    # the start leaves out the friction of the contacts along the axis, some thousandths of the load
    assert run["bearing[1].force.x"] == pytest.approx([300.0, 300.0], rel=2e-3)
    assert run["friction_torque"] == pytest.approx(run["bearing[1].friction_torque"], rel=1e-15)


def test_rotor_inertia_is_that_of_shaft_and_rings():
    one, two = (
        prepare(scene(changes={"spindle.shaft.sections_mm": [[length, 17.0, 0.0]]}))
        for length in (400.0, 800.0)
    )
    of = [next(v.value for v in model.variables if v.name == "rotor.inertia") for model in (one, two)]
    rho = one.scene.materials.inner_ring.density_kg_m3
    assert of[1] - of[0] == pytest.approx(rho * np.pi * 0.4 * 0.0085**4 / 2.0, rel=1e-12)
    rings = of[0] - rho * np.pi * 0.4 * 0.0085**4 / 2.0
    assert rings == pytest.approx(2.0 * one.parameters[P.INNER_POLAR], rel=1e-9)
    assert read_scene(DB).spindle.arrangement == "DB (O)"
