"""Shared by all tests: the example scenes, prepared once per process."""

import pathlib

import pytest

ROOT = pathlib.Path(__file__).parents[1]
SCENES = ROOT / "examples" / "scenes"
#: Gates of all kinds run on these: every value is written out, so that a better default moves no gate.
GATES = ROOT / "tests" / "scenes" / "gates"


@pytest.fixture(scope="session")
def scene():
    """Read an example scene by name, with compact sound.

    Boundary elements take up to a minute per geometry; radiation model bem has tests of its own.
    """
    from fmu_bearing.scene import read_scene

    def read(name):
        found = read_scene(SCENES / f"{name}.toml")
        return found.model_copy(
            update={"sound": found.sound.model_copy(update={"radiation_model": "compact"})}
        )

    return read


@pytest.fixture(scope="session")
def scene_file(tmp_path_factory):
    """File of the default scene with compact sound: its housing takes boundary elements over a minute."""
    text = (SCENES / "7003C-spindle.toml").read_text(encoding="utf-8")
    file = tmp_path_factory.mktemp("scene") / "7003C-spindle.toml"
    file.write_text(text.replace('radiation_model = "bem"', 'radiation_model = "compact"'), encoding="utf-8")
    return file


@pytest.fixture(scope="session")
def silent(scene):
    """The 7003C in its spindle without microphones."""
    return scene("7003C-spindle").model_copy(update={"sound": None})


@pytest.fixture(scope="session")
def automatic(silent):
    """Return the silent scene with fidelity auto and an accuracy."""

    from fmu_bearing.scene.read import with_fidelity

    def make(level_dB, relative):
        return with_fidelity(silent, model="auto", accuracy={"level_dB": level_dB, "relative": relative})

    return make
