"""What copies of a state leave out is not read by later steps, and refused steps leave no trace."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.test_response_sound import PLACES
from tests.spindle.test_sound import pair, sound

_SHORT, _LONG = 1e-4, 1e-3  # s
_SINKS = {"radial_load.y": 3e3, "pedestal_stiffness": 1e4}  # N, N/m: 0.3 m of way, which is refused
_RAMP, _HELD = 160, 240  # steps: a run-up, then the speed held until no renewal goes on


def _instance(scene, bearings, fidelity, sounding):
    given = scene("7003C-spindle") if bearings == 1 else pair(sound("compact", *PLACES), flaws=True)
    if not sounding:
        given = given.model_copy(update={"sound": None})
    run = Instance(prepare(given, fidelity=fidelity), tell=lambda _: None)
    run.initialise()
    return run


def _live(run):
    """Copy of the state with NaN for what is left out."""
    kept = np.full(run.s.size, np.nan)
    assert call("copy", run.p, run.s, kept) == 0
    return kept


def _run_up(run, first):
    """Go through a run-up and a time at rest; yields after every step."""
    for number in range(_RAMP + _HELD):
        run.set("shaft_speed", first * (1.0 + 5e-4 * min(number, _RAMP)))
        run.step(_SHORT if number < _RAMP else _LONG)
        yield number


@pytest.mark.parametrize(
    ("fidelity", "bearings", "sounding", "share"),
    [
        # of the state, at the end: measured 0.32, 0.32, 0.50, 0.20, 0.08, 0.06, 0.07; with sound most of a
        # state of rings is filters
        ("full", 1, False, 0.4),
        ("full", 2, False, 0.4),
        ("rings", 1, True, 0.6),
        ("rings", 2, False, 0.25),
        ("response", 1, False, 0.1),
        ("response", 1, True, 0.1),
        ("response", 2, True, 0.1),
    ],
)
def test_what_is_left_out_is_not_read(scene, fidelity, bearings, sounding, share):
    whole = _instance(scene, bearings, fidelity, sounding)
    poisoned = _instance(scene, bearings, fidelity, sounding)
    first = whole.get("shaft_speed")
    held = 10 if fidelity == "full" else _HELD
    for number, _ in zip(_run_up(whole, first), _run_up(poisoned, first), strict=True):
        assert np.array_equal(whole.z, poisoned.z), number
        poisoned.s[:] = _live(poisoned)
        if number == _RAMP + held:
            break
    one, other = _live(whole), _live(poisoned)
    read = np.isfinite(other)
    assert np.array_equal(one[read], other[read])
    assert 0.0 < read.mean() < share


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_refused_step_leaves_no_trace(scene, fidelity):
    """At every tenth step of a run-up, in which renewals go on, one is refused in between."""
    plain, refused = (_instance(scene, 1, fidelity, True) for _ in range(2))
    first = plain.get("shaft_speed")
    for number, _ in zip(_run_up(plain, first), _run_up(refused, first), strict=True):
        assert np.array_equal(plain.z, refused.z), number
        if number % 10 == 3:
            time, given = refused.time, {name: refused.get(name) for name in _SINKS}
            for name, value in _SINKS.items():
                refused.set(name, value)
            with pytest.raises(EngineError, match="push the outer ring sideways"):
                refused.step(_LONG)
            for name, value in given.items():
                refused.set(name, value)
            assert refused.time == time
