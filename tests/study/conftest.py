"""Scenes for the studies: short, silent, as little as shows the point."""

import pytest

from fmu_bearing.scene.read import with_fidelity


@pytest.fixture(scope="session")
def silent(scene):
    """The 7003C in its spindle without microphones."""
    return scene("7003C-spindle").model_copy(update={"sound": None})


@pytest.fixture(scope="session")
def automatic(silent):
    """Return the silent scene with level auto and an accuracy."""

    def make(level_dB, relative):
        return with_fidelity(silent, level="auto", accuracy={"level_dB": level_dB, "relative": relative})

    return make
