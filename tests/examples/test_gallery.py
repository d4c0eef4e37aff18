"""The gallery: its script draws, what it says of resonances is so, and every picture has a command."""

import importlib.util
import re
import subprocess
import sys

import pytest

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.scene import read_scene
from tests.conftest import EXAMPLES, ROOT
from tests.pages import DOCS, commands

SCRIPT = ROOT / "examples" / "gallery" / "gallery.py"


@pytest.mark.heavy
def test_the_script_draws(tmp_path):
    command = [sys.executable, str(SCRIPT), "--quick", "--output", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    for name in ("preload", "spectrum", "orders"):
        assert (tmp_path / f"{name}.png").stat().st_size > 20_000
        assert (DOCS / "images" / f"{name}.png").exists()


@pytest.mark.parametrize(
    "preload, line",
    [(150.0, lambda f: f.f_o), (190.0, lambda f: 2.0 * f.f_b - f.f_c), (500.0, lambda f: f.f_i - f.f_r)],
)
def test_where_the_resonance_meets_a_line(preload, line):
    """The preloads of the script's docstring and of the picture's dotted lines, read from the picture."""
    spec = importlib.util.spec_from_file_location("gallery", SCRIPT)
    gallery = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(gallery)
    scene = read_scene(EXAMPLES / "7003C-spindle.toml").replace({"mounting.preload_N": preload})
    (point,) = operating_point(scene).bearings
    # 10 N beside the place: the resonance goes with the cube root of that
    assert gallery.resonance(point) == pytest.approx(line(point.frequencies), rel=0.01)


@pytest.mark.pages
def test_every_picture_has_a_command():
    page = (DOCS / "gallery.md").read_text(encoding="utf-8")
    sections = re.split(r"^## ", page, flags=re.MULTILINE)[1:]
    assert len(sections) == len(re.findall(r"^!\[", page, flags=re.MULTILINE)) >= 10
    known = ""
    for section in sections:
        scripts = re.findall(r"```sh\n(.*?)```", section, flags=re.DOTALL)
        known = scripts[0] if scripts else known  # a script may draw the pictures of sections that follow
        (words,) = commands(known)
        assert words[0] in ("python", "fmu-bearing", "make")
        if words[0] == "python":
            assert (ROOT / words[1]).is_file(), words
