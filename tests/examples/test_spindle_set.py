"""The motor spindle on four bearings in co-simulation: energy, forces, torque, statics, its nose."""

import sys

import fmpy
import numpy as np
import pytest

from fmu_bearing import read_scene, statics
from tests.conftest import ROOT

SET = ROOT / "examples" / "spindle_set"
BEARINGS = 4
HEATS = ("heat.inner_ring", "heat.outer_ring", "heat.oil")


@pytest.fixture(scope="module")
def example():
    """The example's modules, imported as its scripts import them."""
    sys.path.insert(0, str(SET))
    import cosimulate  # this folder's; the other example's module of that name is run as a script alone
    import run_up

    yield cosimulate, run_up
    sys.path.remove(str(SET))
    del sys.modules["cosimulate"], sys.modules["run_up"]


@pytest.fixture(scope="module")
def short(example, tmp_path_factory):
    """Scene, plan, table and constants of the short run."""
    cosimulate, _ = example
    scene = read_scene(cosimulate.SCENE)
    folder = tmp_path_factory.mktemp("set")
    table, constants = cosimulate.cosimulate(scene, folder, cosimulate.SHORT)
    return scene, cosimulate.SHORT, table, constants


@pytest.fixture(scope="module")
def rows(example, short):
    """The short run beside statics."""
    return example[0].compare(short[0], short[2])


@pytest.mark.heavy
def test_the_network_gets_every_joule_of_the_bearings(short):
    _, _, table, constants = short
    each = sum(table[f"bearing[{b}].{name}"] for b in range(1, BEARINGS + 1) for name in HEATS)
    beside = (
        sum(table[name] for name in HEATS) - each
    )  # what the bending shaft damps, in the set's heat alone
    assert -1e-9 < beside.min() and beside.max() < 1e-3 * each.max()
    supplied = float(each[1:] @ np.diff(table["thermal_time"]))
    assert constants["energy.supplied"] == pytest.approx(supplied, rel=1e-12)
    kept = constants["energy.stored"] + constants["energy.given_off"]
    assert kept == pytest.approx(supplied, rel=1e-9)


@pytest.mark.heavy
def test_heat_is_the_power_of_the_friction_torque(short):
    """At constant speed; what balls and cages store is small against the heat of 20 ms."""
    _, plan, table, _ = short
    hold = table[table["time"] > plan.end_time - 0.1]
    heat = sum(hold[name] for name in HEATS).mean()
    power = (hold["friction_torque_mean"] * hold["shaft_speed"]).mean()
    assert heat == pytest.approx(power, rel=5e-3)


@pytest.mark.heavy
def test_the_torque_of_the_motor_turns_the_spindle_up(short):
    """Work of the motor: kinetic energy of shaft and rings, and the work done on the bearings."""
    _, plan, table, constants = short
    ramp = table[table["time"] <= plan.ramp_time]
    angle = np.diff(ramp["time"]) * 0.5 * (ramp["shaft_speed"][1:] + ramp["shaft_speed"][:-1])
    # the motor takes the torque of the last communication point over each step
    load = float(ramp["friction_torque"][:-1] @ angle)
    kinetic = 0.5 * constants["rotor.inertia"] * ramp["shaft_speed"][-1] ** 2
    # the controller renews its torque ten times a step, and only the last is reported
    assert float(ramp["motor_torque"][1:] @ angle) == pytest.approx(load + kinetic, rel=5e-3)
    assert table["shaft_speed"][-1] == pytest.approx(plan.target_speed, rel=1e-3)


@pytest.mark.heavy
def test_forces_of_the_bearings_carry_load_and_weight(short):
    scene, plan, table, _ = short
    hold = table[table["time"] > plan.end_time - 0.1]
    load = statics(scene).load  # the tool's and the weight, moved to the nose
    for axis, wanted in zip("xyz", load, strict=False):
        carried = sum(hold[f"bearing[{b}].force.{axis}"] for b in range(1, BEARINGS + 1)).mean()
        # the rest is the shaft's acceleration: its mean is the change of velocity over 0.1 s. At 20,000 r/min
        # three orders of the shaft are 1 kHz, so that rows 1 ms apart fold every third one into the mean; the
        # waves' forces scatter by 3.5 N rms
        assert carried == pytest.approx(wanted, abs=2.0), axis


@pytest.mark.heavy
def test_axial_loads_are_those_of_statics_at_the_temperatures(rows):
    for row in rows:
        for b in range(1, BEARINGS + 1):
            # waves of class P4, means over 20 ms; the largest found is 0.8 N, of 145 N
            assert row[f"run_{b}_N"] == pytest.approx(row[f"statics_{b}_N"], abs=1.5), (row, b)
    first, last = rows[0], rows[-1]
    assert last["spacers_N"] < 0.9 * first["spacers_N"]  # beyond the neutral spacing warmth takes preload
    assert last["closer_N"] > 1.05 * first["closer_N"]  # below it warmth adds preload
    assert last["springs_N"] == pytest.approx(first["springs_N"], rel=1e-6) == 120.0


@pytest.mark.heavy
def test_temperatures_are_those_of_each_bearing(short):
    """The front pair carries the tool, so it is warmer; the inner rings have no way out but the shaft."""
    _, _, table, _ = short
    last = table[-1]
    inner, outer = (
        np.array([last[f"bearing[{b}].{ring}_ring_temperature"] for b in range(1, BEARINGS + 1)])
        for ring in ("inner", "outer")
    )
    assert inner[:2].min() > inner[2:].max() and outer[:2].min() > outer[2:].max()
    assert inner.min() > last["shaft_temperature"] > last["housing_temperature"] > 295.15


@pytest.mark.heavy
def test_the_picture_is_drawn(example, short, rows, tmp_path):
    cosimulate, _ = example
    scene, plan, table, _ = short
    cosimulate.draw(table, rows, scene, plan, tmp_path / "set.png")
    assert (tmp_path / "set.png").stat().st_size > 20_000


@pytest.mark.parametrize("flavour", ["python", "native"])
def test_steady_temperatures_of_the_set_are_those_of_its_conductances(builder, tmp_path, flavour):
    """Against a balance written by hand: what flows into each lump, zero in the steady state."""
    if flavour == "native" and builder.best_flavour() != "native":
        pytest.skip("no C compiler")
    path = builder.build(builder.HERE / "thermal.py", tmp_path, flavour, bearings=2)
    start = {v.name: float(v.start) for v in fmpy.read_model_description(str(path)).modelVariables if v.start}
    g = {name.partition(".")[2]: value for name, value in start.items() if name.startswith("conductance.")}
    heats = {"bearing[1].heat.inner_ring": 6.0, "bearing[2].heat.outer_ring": 5.0, "bearing[2].heat.oil": 9.0}
    light = {name: 0.05 for name in start if name.startswith("capacity.")}
    kinds = ("inner_ring", "outer_ring", "balls", "oil")
    names = [f"bearing[{b}].{kind}_temperature" for b in (1, 2) for kind in kinds]
    names += ["shaft_temperature", "housing_temperature"]
    last = fmpy.simulate_fmu(
        str(path), stop_time=10.0, step_size=0.1, output_interval=0.1, output=names,
        start_values={**heats, **light},
    )[-1]  # fmt: skip
    rise = {name.removesuffix("_temperature"): float(last[name]) - 295.15 for name in names}
    for b in ("bearing[1].", "bearing[2]."):
        inner, outer, balls, oil = (rise[b + kind] for kind in kinds)
        shaft, housing = rise["shaft"], rise["housing"]
        into = {
            "inner_ring": g["inner_ring_balls"] * (balls - inner) + g["inner_ring_oil"] * (oil - inner)
            + g["inner_ring_shaft"] * (shaft - inner),
            "outer_ring": g["outer_ring_balls"] * (balls - outer) + g["outer_ring_oil"] * (oil - outer)
            + g["outer_ring_housing"] * (housing - outer),
            "balls": g["inner_ring_balls"] * (inner - balls) + g["outer_ring_balls"] * (outer - balls)
            + g["balls_oil"] * (oil - balls),
            "oil": g["balls_oil"] * (balls - oil) + g["inner_ring_oil"] * (inner - oil)
            + g["outer_ring_oil"] * (outer - oil) - g["oil_ambient"] * oil,
        }  # fmt: skip
        for kind, flow in into.items():
            assert flow + heats.get(f"{b}heat.{kind}", 0.0) == pytest.approx(0.0, abs=1e-9), (b, kind)
    to_shaft = sum(rise[f"bearing[{b}].inner_ring"] - rise["shaft"] for b in (1, 2)) * g["inner_ring_shaft"]
    assert to_shaft == pytest.approx(g["shaft_ambient"] * rise["shaft"], rel=1e-9)
    to_housing = sum(rise[f"bearing[{b}].outer_ring"] - rise["housing"] for b in (1, 2))
    given_off = g["housing_ambient"] * rise["housing"]
    assert to_housing * g["outer_ring_housing"] == pytest.approx(given_off, rel=1e-9)


def test_both_builds_of_the_network_give_the_same_doubles(builder, tmp_path):
    if builder.best_flavour() != "native":
        pytest.skip("no C compiler")
    found = []
    for flavour in ("python", "native"):
        path = builder.build(builder.HERE / "thermal.py", tmp_path / flavour, flavour, bearings=BEARINGS)
        names = [v.name for v in fmpy.read_model_description(str(path)).modelVariables]
        outputs = [name for name in names if name.endswith("_temperature") or name.startswith("energy.")]
        heats = {name: 1.0 + 0.1 * k for k, name in enumerate(names) if "heat." in name}
        found.append(
            fmpy.simulate_fmu(
                str(path),
                stop_time=1.0,
                step_size=0.0173,
                output_interval=0.0173,
                output=outputs,
                start_values=heats,
            )  # fmt: skip
        )
    assert (found[0] == found[1]).all()


def test_a_motor_has_no_number_of_bearings(builder, tmp_path):
    with pytest.raises(builder.BuildError, match=r"motor\.py has no number of bearings"):
        builder.build(builder.HERE / "motor.py", tmp_path, bearings=2)


@pytest.mark.heavy
def test_the_nose_rings_where_linear_algebra_puts_the_bending_shaft(example):
    """Its loudest line up to 5 kHz, while waves go by, is the frequency of the shaft in its bearings."""
    _, run_up = example
    scene = read_scene(run_up.SCENE)
    found = run_up.run(scene, 0.2)
    frequencies, _, values = run_up.over_speed(found)
    loudest = frequencies[np.argmax((values**2).mean(axis=1))]
    # two bending modes, 14 Hz apart; lines are 20 Hz apart, and a ramp of 150,000 r/min per second widens
    # those of the waves by f_o's 650 Hz in a window, of which the mode keeps what is near it
    assert loudest == pytest.approx(run_up.shaft_frequencies(scene)[1], abs=60.0)
    run_up_rigid = run_up.run(scene.replace({"spindle.shaft.flexible": False}), 0.2)
    assert run_up.rms(found).max() > 2.0 * run_up.rms(run_up_rigid).max()
