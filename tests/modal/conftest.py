"""Frozen scenes of the modal tests: no weight, so that all balls carry equal loads."""

import pytest

from fmu_bearing.scene import read_scene
from tests.conftest import GATES


@pytest.fixture(scope="session")
def gate():
    """Scene of `tests/scenes/gates` without weight, with keys changed."""

    def read(name, **changes):
        scene = read_scene(GATES / f"{name}.toml").replace({"fidelity.terms.gravity": False})
        return scene.replace(changes) if changes else scene

    return read
