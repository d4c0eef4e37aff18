"""docs/analysis.md runs as it stands."""

import pathlib
import re

import numpy as np

ROOT = pathlib.Path(__file__).parents[2]


def test_the_page_runs(tmp_path, monkeypatch):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs" / "analysis.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    assert len(blocks) == 8
    names = {}
    for block in blocks:
        exec(compile(block, "docs/analysis.md", "exec"), names)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written >= set(re.findall(r'out / "([^"]+)"', page))
    # the figures the page states
    assert abs(names["sphere"].level - names["motion"].levels["total"]) < 1.0
    rms = [np.sqrt(np.mean(signal**2)) for signal in (names["back"], names["pressure"])]
    assert abs(rms[0] / rms[1] - 1.0) < 0.01
    assert names["heard"].levels()[0] > 60.0
