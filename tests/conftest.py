"""Shared by all tests: the example scenes, prepared once per process."""

import pathlib

import pytest

ROOT = pathlib.Path(__file__).parents[1]
SCENES = ROOT / "examples" / "scenes"


@pytest.fixture(scope="session")
def scene():
    """Read an example scene by name, with compact sound.

    Boundary elements take up to a minute per geometry; rung bem has tests of its own.
    """
    from fmu_bearing.scene import read_scene

    def read(name):
        found = read_scene(SCENES / f"{name}.toml")
        return found.model_copy(update={"sound": found.sound.model_copy(update={"rung": "compact"})})

    return read
