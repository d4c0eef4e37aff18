"""Scenes with fits for the tests: one bearing and a pair, their fits, the line of a refusal."""

import pytest

from fmu_bearing.scene import SceneError, read_scene_text
from fmu_bearing.scene.template import new_scene
from tests.conftest import EXAMPLES

SINGLE = new_scene("a", "7003C", kind="steel", sound=False, preload_N=150.0)
RIGID = SINGLE.replace("preload_N = 150.0", 'preload_N = 150.0\npreload_mode = "rigid"')
PAIR = (EXAMPLES.parent / "spindle_set" / "7003C-DB.toml").read_text("utf-8")
PORT = """
[spindle.shaft]
external = true
"""
JS4 = '\n[mounting.fit.shaft]\nshaft_class = "js4"\n'
HOUSING = """
[mounting.fit.housing]
housing_class = "M4"
outside_diameter_mm = 60
material = "aluminium"
"""
#: A fit of the pair without a seat.
SET = '\n[spindle.fit]\nbearing_class = "P4"\npreload = "unmounted"\n'
SET_JS4 = f'{SET}[spindle.fit.shaft]\nshaft_class = "js4"\n'


def seat(lines, where="mounting.fit.shaft"):
    return f"\n[{where}]\n{lines}\n"


def read(fit, text=SINGLE):
    return read_scene_text(text + fit, "a")


def refused(fit, text=SINGLE):
    """The one line about a scene, without the name of the file."""
    with pytest.raises(SceneError) as caught:
        read(fit, text)
    (line,) = caught.value.problems
    return line.removeprefix("a: ")


def ported(text=PAIR):
    """The pair on another model's shaft."""
    begin, end = text.index("[spindle.shaft]"), text.index("[spindle.housing]")
    return text[:begin] + PORT + text[end : text.index("[spindle.load]")]
