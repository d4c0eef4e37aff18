"""The Python build's session: failures inside the model are reported, contained, and it goes on."""

import pytest

from fmu_bearing.fmi.session import DISCARD, ERROR, Phase, Session
from fmu_bearing.instance import EngineError, Instance

from .conftest import DISCARD as DISCARDED, OK, STEP, Master


@pytest.fixture
def log():
    return []


@pytest.fixture
def session(model, log):
    return Session(model, lambda severity, message: log.append((severity, message)))


def begin(session):
    session.setup(0.0, None)
    session.enter_initialisation()
    session.exit_initialisation()
    return session


def reference(model, name):
    return [variable.name for variable in model.variables].index(name)


def test_step_that_does_not_converge_is_discarded_and_can_be_retried(session, log, monkeypatch):
    begin(session)
    with monkeypatch.context() as patch:

        def stuck(self, h):
            raise EngineError("the equations could not be solved")

        patch.setattr(Instance, "step", stuck)
        assert session.step(0.0, STEP) is False
    severity, message = log[-1]
    assert severity == DISCARD
    for part in ("could not be solved", "0.0 s", f"{STEP!r} s"):
        assert part in message
    assert session.time == 0.0
    assert session.step(0.0, 0.5 * STEP)
    assert session.time == 0.5 * STEP


def test_initialisation_that_fails_refuses_steps(session, log, model, monkeypatch):
    def lost(self, time=0.0):
        raise EngineError("no quasi-static equilibrium was found")

    with monkeypatch.context() as patch:
        patch.setattr(Instance, "initialise", lost)
        begin(session)
    assert session.phase is Phase.STEPPING
    assert log == [(ERROR, "no quasi-static equilibrium was found")]
    assert session.step(0.0, STEP) is False
    assert "no quasi-static equilibrium" in log[-1][1]


def test_initialisation_is_tried_again_with_other_inputs(session, model, monkeypatch):
    preload = reference(model, "preload")
    mean = reference(model, "contact.inner.load_mean")
    initialise = Instance.initialise

    def lost(self, time=0.0):
        if self.get("preload") == 0.0:
            raise EngineError("no quasi-static equilibrium was found")
        initialise(self, time)

    monkeypatch.setattr(Instance, "initialise", lost)
    session.setup(0.0, None)
    session.enter_initialisation()
    session.set([preload], [0.0], "Real")
    assert session.get([mean], "Real") == [0.0]
    session.set([preload], [400.0], "Real")
    assert session.get([mean], "Real")[0] > 0.0
    session.exit_initialisation()
    assert session.step(0.0, STEP)


def test_failure_inside_the_model_stays_inside(unpack, monkeypatch):
    # an exception that reached pythonfmu would be fmi2Fatal and free the slave twice; native has none
    bearing = Master(unpack("python")).start()

    def broken(self, h):
        raise ZeroDivisionError("division by zero")

    with monkeypatch.context() as patch:
        patch.setattr(Instance, "step", broken)
        assert bearing.step(0.0) == DISCARDED
    assert "ZeroDivisionError" in bearing.messages
    assert bearing.step(0.0) == DISCARDED
    assert bearing.reset() == OK
    assert bearing.start().step(0.0) == OK
    bearing.free()
