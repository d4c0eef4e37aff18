"""A state put back into the instance that went on from it continues with equal bits."""

import numpy as np
import pytest

from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.test_response_sound import PLACES
from tests.marks import heavy_but
from tests.spindle.test_sound import pair, sound

_STEP = 1e-4
_STEPS = 220


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
@pytest.mark.parametrize("bearings", heavy_but([1, 2], 0))
def test_going_back_on_one_instance(scene, bearings, fidelity):
    """In a run-up with microphones, back by 1 to 200 steps: pieces of renewals go on where they were."""
    given = scene("7003C-spindle") if bearings == 1 else pair(sound("compact", *PLACES), flaws=True)
    run = Instance(prepare(given, fidelity=fidelity), tell=lambda _: None)
    run.initialise()
    first = run.get("shaft_speed")

    def step(number):
        run.set("shaft_speed", first * (1.0 + 5e-4 * number))
        run.step(_STEP)
        return run.z.copy()

    states, once = [], []
    for number in range(_STEPS):
        states.append(run.s.copy())
        once.append(step(number))
    for back in (1, 2, 7, 25, 60, 100, 200):
        begin = _STEPS - back
        run.s[:] = states[begin]
        again = [step(number) for number in range(begin, min(begin + 40, _STEPS))]
        assert all(np.array_equal(z, once[begin + k]) for k, z in enumerate(again)), back
        # from there the instance goes on to the end, as a host does that refines a step
        for number in range(begin + len(again), _STEPS):
            assert np.array_equal(step(number), once[number])
