"""Shared by all tests: the example scenes, prepared once per process."""

import pathlib

import pytest

ROOT = pathlib.Path(__file__).parents[1]
SCENES = ROOT / "examples" / "scenes"


@pytest.fixture(scope="session")
def scene():
    """Read an example scene by name."""
    from fmu_bearing.scene import read_scene

    return lambda name: read_scene(SCENES / f"{name}.toml")
