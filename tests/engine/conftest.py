"""States of the gate scenes, as functions of what a test changes."""

import functools

import pytest

from tests.engine.flexible import MODES, SCENE, FirstOrder
from tests.engine.helpers import Run
from tests.engine.states import case_of


@pytest.fixture
def case(scene):
    """Make a random state of a gate scene, see `states.case_of`."""
    return functools.partial(case_of, scene)


@pytest.fixture
def problem(scene):
    """Make the first-order problem of a bearing with bending rings at its start."""

    def make(modes=MODES, rpm=20000, speed_rate=0.0, **parameters):
        run = Run(scene(SCENE), rpm, modes=modes, LAND=0.0, **parameters).init()
        return FirstOrder(run, speed_rate)

    return make
