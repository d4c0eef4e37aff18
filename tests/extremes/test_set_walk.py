"""Random walks of a set's inputs: each step ends, or is refused and can be gone on from."""

import time

import numpy as np
import pytest

from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from tests.extremes.test_random_walk import REFUSALS
from tests.marks import heavy_but
from tests.spindle.sets import scene

BODY = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 160.0, "pedestal_stiffness_N_m": 1e8}
SLIDING = {
    "spindle.bearing[2].seat": "sliding",
    "spindle.preload": {"kind": "spring", "force_N": 300.0, "stiffness_N_m": 1e5},
}
FLAWS = {"imperfections": {"grade": "P4", "seed": 3}}
PEDESTALS = {"housing": {"pedestal_stiffness_N_m": 1e8}, "bearings": [{"seat": "pedestal"}] * 2}
PLACES = (40.0, 70.0)
SETS = {
    "DB": lambda: scene("+-", PLACES, 500.0, 10e3, changes=FLAWS),
    "DF on a beam": lambda: scene("-+", PLACES, 300.0, 10e3, changes={"spindle.shaft.flexible": True}),
    "sliding": lambda: scene("+-", PLACES, None, 10e3, changes=SLIDING | FLAWS),
    "housing": lambda: scene("+-", PLACES, 500.0, 10e3, changes={"spindle.housing": BODY}),
    "pedestals": lambda: scene("+-", PLACES, 500.0, 10e3, **PEDESTALS),
    "QBC": lambda: scene("++--", (40.0, 55.0, 120.0, 135.0), 300.0, 10e3, changes=FLAWS),
}
# what a spindle meets and some ten times more; the ranges of the variables reach to forces of 100 kN, which
# take steps of nanoseconds until the shaft has gone
RANGES = {
    "shaft_speed": (-4000.0, 4000.0),
    "nose.force.x": (-1e4, 1e4),
    "nose.force.y": (-5e3, 5e3),
    "nose.force.z": (-5e3, 5e3),
    "nose.moment.y": (-100.0, 100.0),
    "nose.moment.z": (-100.0, 100.0),
    "preload": (0.0, 5e3),
    "shaft_temperature": (253.0, 373.0),
    "housing_temperature": (253.0, 373.0),
    "pedestal_stiffness": (1e6, 1e10),
}


def bounds(name):
    """Range of an input; those of a bearing are temperatures."""
    return RANGES.get(name, (253.0, 373.0))


@pytest.mark.parametrize(
    ("fidelity", "seed"),
    heavy_but([("full", 0), ("full", 1), ("full", 2), ("rings", 0), ("response", 0)], "full-0", "rings-0"),
)
@pytest.mark.parametrize("name", heavy_but(SETS, "sliding", "DF on a beam"))
def test_a_walk_goes_on_or_is_refused(name, fidelity, seed):
    rng = np.random.default_rng(seed)
    run = Instance(prepare(SETS[name](), fidelity=fidelity), tell=lambda text: None)
    run.initialise()
    inputs = [one.name for one in run.model.variables if one.causality == "input"]
    refused = 0
    for _ in range(25):
        before, kept = run.u.copy(), run.s.copy()
        which = inputs[rng.integers(len(inputs))]
        run.set(which, rng.uniform(*bounds(which)))
        try:
            run.step(float(rng.choice([1e-5, 5e-5, 2e-4])))
        except EngineError as reason:
            refused += 1
            assert REFUSALS.search(str(reason))
            np.testing.assert_array_equal(run.s, kept)
            run.u[:] = before
            try:
                run.step(1e-6)
            except EngineError:  # a shaft on its way out of its bearings may be refused at any time
                run.reset()
                run.initialise()
        assert np.isfinite(run.z).all()
    # most of what a walk asks for can be computed
    assert refused < 8


@pytest.mark.heavy
@pytest.mark.parametrize("name", SETS)
def test_a_start_at_drawn_inputs_ends_or_is_refused(name):
    rng = np.random.default_rng(7)
    run = Instance(prepare(SETS[name]()), tell=lambda text: None)
    inputs = [one.name for one in run.model.variables if one.causality == "input"]
    for _ in range(3):  # of each of six sets
        run.reset()
        for which in inputs:
            low, high = bounds(which)
            run.set(which, low + 0.5 * (high - low) * (1.0 + 0.3 * rng.uniform(-1.0, 1.0)))
        try:
            run.initialise()
        except EngineError as reason:
            assert REFUSALS.search(str(reason))
            continue
        run.step(1e-5)
        assert np.isfinite(run.z).all()


@pytest.mark.heavy
@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_no_step_of_four_bearings_takes_long(fidelity):
    """Steps of 1 ms over the whole ranges of the inputs, and moments from one end to the other.

    Found: 0.7 s of the processor in full, 0.2 s in the others. The bounds keep away what once was: tries
    that went on for 0.5 and 2.5 s, and for 67 s after a jump of the moment.
    """
    rng = np.random.default_rng(101)
    run = Instance(prepare(SETS["QBC"](), fidelity=fidelity), tell=lambda text: None)
    run.initialise()
    inputs = [one for one in run.model.variables if one.causality == "input"]
    moves = [(one, rng.uniform(one.min, one.max)) for one in rng.choice(inputs, 40)]
    (moment,) = [one for one in inputs if one.name == "nose.moment.z"]
    moves += [(moment, end) for end in (moment.min, moment.max, 0.0)]
    for one, value in moves:
        before = run.u.copy()
        run.set(one.name, value)
        begun = time.process_time()
        try:
            run.step(1e-3)
        except EngineError as reason:
            assert REFUSALS.search(str(reason))
            run.u[:] = before
        assert time.process_time() - begun < (2.5 if fidelity == "full" else 1.2), f"{one.name} = {value}"
