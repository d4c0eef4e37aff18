"""A set of one bearing on its own pedestal is the single bearing: every public figure, every fidelity."""

import math

import pytest

from fmu_bearing.instance import Instance
from fmu_bearing.interface import variables
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import Scene
from tests.spindle.one import MIDDLE, set_of_one

RPM = 20e3
BALLS = 11.4  # m/s: speed of the balls
TIGHT = {"fidelity.tolerance": 1e-6}
#: Of a value, by fidelity: `full` settles the set's bearing about its ring's centre, the single one about the
#: fixed axis, where a slope between balls keeps the ring's 0.5 um to 1e-3 (1.7e-6 of the torque, 1e-5 of a
#: tilt). In rings and response a set has its losses where quasi-static forces put its rings across the
#: axis: 3.6e-5 of the torque, 1.2e-4 of the contacts' share, 7e-3 of the little that they slip.
CLOSE = {"full": 4e-6, "rings": 2e-4, "response": 2e-4}
SLIP = {"full": 4e-6, "rings": 1e-2, "response": 1e-2}
#: What is nothing, by unit: a millionth of the balls' speed, of the load; 1e-5 of approach and tilt.
NOTHING = {"m/s": 1e-6 * BALLS, "N": 5e-4, "N.m": 1e-7, "W": 2e-5, "m": 3e-11, "rad": 5e-9}


def run_of(scene, fidelity):
    run = Instance(prepare(scene, fidelity=fidelity))
    run.initialise()
    return run


def outputs_of(single):
    """Names and units of what a single bearing gives, but counts of steps and the error of the balance."""
    return [
        (one.name, one.unit or "")
        for one in variables(single, 0.0)
        if one.causality in ("output", "local") and not one.name.startswith(("solver.", "energy."))
    ]


def value(run, name):
    """Return a figure of the bearing, or where the set alone has it, of the set."""
    names = {one.name for one in run.model.variables}
    prefixed = f"bearing[1].{name}"
    return run.get(prefixed if prefixed in names else name)


@pytest.mark.parametrize("radial", [0.0, -50.0])
@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_every_output_of_a_run_without_cage(fidelity, radial):
    """At the start and after 3 ms with a jump of the speed."""
    several, single = set_of_one(RPM, radial, cage=False, changes=TIGHT)
    ours, theirs = run_of(several, fidelity), run_of(single, fidelity)
    names = outputs_of(single)
    assert len(names) > 80
    for steps in (0, 15, 15):
        for _ in range(steps):
            ours.step(1e-4)
            theirs.step(1e-4)
        for name, unit in names:
            wanted = theirs.get(name)
            slips = name.endswith(("slip", "spin_to_roll"))
            close = (SLIP if slips else CLOSE)[fidelity] * abs(wanted) + NOTHING.get(unit, 0.0)
            assert value(ours, name) == pytest.approx(wanted, abs=close, nan_ok=True), (name, steps)
        ours.set("shaft_speed", 0.98 * RPM * math.pi / 30.0)
        theirs.set("shaft_speed", 0.98 * RPM * math.pi / 30.0)


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_torque_and_levels_with_a_cage(fidelity):
    """Over 60 ms; cages are chaotic in `full`."""
    microphones = [{"name": "side", "x_mm": 0.0, "y_mm": 105.0, "z_mm": 0.0}]
    sound = {"radiation_model": "compact", "metering_start_s": 0.01}
    several, single = set_of_one(RPM, -50.0)
    place = [one | {"x_mm": MIDDLE} for one in microphones]
    several = Scene.from_dict(several.model_dump() | {"sound": sound | {"microphone": place}})
    single = Scene.from_dict(single.model_dump() | {"sound": sound | {"microphone": microphones}})
    ours, theirs = run_of(several, fidelity), run_of(single, fidelity)
    torques = [], []
    for _ in range(600):
        for run, torque in zip((ours, theirs), torques, strict=True):
            run.step(1e-4)
            torque.append(run.get("friction_torque"))
    assert sum(torques[0]) == pytest.approx(sum(torques[1]), rel=0.01)
    assert value(ours, "mic[1].leq") == pytest.approx(theirs.get("mic[1].leq"), abs=0.3)
