"""Inputs that are wrong for a while: what they leave behind, and that every refusal has a way back."""

import numpy as np
import pytest

from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from tests.extremes.bearings import SILENT, edited


def started(name, fidelity, **changes):
    """Return a gate scene's bearing without sound at its start."""
    given = edited(name, SILENT)
    if changes:
        given = given.model_copy(update={"mounting": given.mounting.model_copy(update=changes)})
    run = Instance(prepare(given, fidelity=fidelity), tell=lambda _: None)
    run.initialise()
    return run


@pytest.mark.parametrize(("name", "value"), [("preload", 0.1), ("radial_load.y", -3000.0)])
def test_one_bad_sample_leaves_nothing_in_response(name, value):
    """Its inputs are those in use again before a renewal for the bad one is complete."""
    glitched, plain = (started("7003C-spindle", "response") for _ in range(2))
    for run in (glitched, plain):
        for _ in range(50):
            run.step(1e-3)
    good = plain.get(name)
    for step in range(300):
        if step == 0:
            glitched.set(name, value)
        for run in (glitched, plain):
            run.step(9e-5 if step == 0 else 1e-3)
        glitched.set(name, good)
        if step:
            assert np.array_equal(glitched.z, plain.z), step


@pytest.mark.parametrize("hold", [1, 20, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 40])
@pytest.mark.parametrize(("name", "value"), [("preload", 900.0), ("inner_ring_temperature", 310.0)])
def test_inputs_that_come_back_are_those_in_use(name, value, hold):
    """However long others were there, a renewal for these begins: holds of 25 to 29 ms once lost it."""
    run = Instance(prepare(edited("7003C-spindle", SILENT), fidelity="response"), tell=lambda _: None)
    run.set("imperfection.scale", 0.0)
    run.initialise()
    good, right = run.get(name), run.get("contact.inner.load_mean")
    for inputs, count in ((good, 10), (value, hold), (good, 120)):
        run.set(name, inputs)
        for _ in range(count):
            run.step(1e-3)
    assert run.get("contact.inner.load_mean") == pytest.approx(right, rel=0.01)


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_a_load_that_sinks_the_ring_is_refused_before_it_does(fidelity):
    """300 N on a pedestal of 1e4 N/m ask for 30 mm: the step says so as the start does, and one goes on."""
    run = started("7003C-bare", fidelity)
    run.step(2e-3)
    run.set("radial_load.z", 300.0)
    run.step(2e-3)
    stiffness = run.get("pedestal_stiffness")
    run.set("pedestal_stiffness", 1e4)
    for h in (1e-9, 1e-3):
        with pytest.raises(EngineError, match="push the outer ring sideways by more than 0.3"):
            run.step(h)
    run.set("pedestal_stiffness", stiffness)
    for _ in range(5):
        run.step(1e-3)
    assert abs(run.get("outer_ring.displacement.z")) < 2e-5


def test_a_state_that_nothing_leads_on_from_names_the_way_back():
    """A ring that hangs 2.5 mm aside on a soft pedestal is flung by a stiff one."""
    run = started("7003C-bare", "full", pedestal_stiffness_N_m=1.2e5, radial_load_z_N=-300.0)
    run.step(1e-3)
    before = run.s.copy()
    run.set("pedestal_stiffness", 1e11)
    with pytest.raises(EngineError, match=r"put an earlier one back \(fmi2SetFMUstate\), or begin again"):
        run.step(1e-3)
    run.s[:] = before
    run.set("pedestal_stiffness", 1.2e5)
    run.step(1e-3)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_rigid_preload_on_another_pedestal_is_that_of_full(fidelity):
    """Its place stays as the pedestal changes under it: loads and torque are those of that place.

    1 N/um on 500 N gives way by 0.5 mm; ten times as stiff, it asks for 5 kN there.
    """
    found = {}
    for one in ("full", fidelity):
        run = started("7003C-spindle", one, preload_mode="rigid")
        run.set("pedestal_stiffness", 1e6)
        run.set("preload", 520.0)
        for _ in range(30):
            run.step(1e-3)
        run.set("pedestal_stiffness", 3e6)
        for _ in range(200):
            run.step(1e-3)
        found[one] = [run.get("contact.inner.load_mean"), run.get("friction_torque_mean")]
    # full's ring still swings by a per cent; the load of one instant has the surfaces in it
    assert found[fidelity][0] == pytest.approx(found["full"][0], rel=0.03)
    assert found[fidelity][1] == pytest.approx(found["full"][1], rel=0.01)
