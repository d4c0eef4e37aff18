"""The spindle scene with mistakes in it: the lines that report them."""

import pytest

from fmu_bearing.scene import SceneError, read_scene_text
from tests.conftest import GATES

TEXT = (GATES / "7003C-spindle.toml").read_text(encoding="utf-8")


def problems(*changes, text=TEXT):
    """Messages about the spindle scene after ``(old, new)`` replacements, the file name taken off."""
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    with pytest.raises(SceneError) as caught:
        read_scene_text(text, "a.toml")
    error = caught.value
    assert error.__cause__ is None and error.__suppress_context__
    assert "pydantic" not in str(error) and "validation error" not in str(error)
    lines = error.problems
    assert lines == tuple(str(error).split("\n"))
    assert all(line.startswith("a.toml: ") and line.isprintable() for line in lines)
    return [line.removeprefix("a.toml: ") for line in lines]
