"""docs/analysis.md runs as it stands, and states figures that come out."""

import re

import numpy as np
import pytest

from tests.pages import DOCS, blocks, run_page


@pytest.mark.heavy  # circles, planes and spheres by boundary elements: 45 s
def test_the_page_runs(tmp_path, monkeypatch):
    page = DOCS / "analysis.md"
    assert sum(language == "python" for language, _, _ in blocks(page)) == 8
    names = run_page(page, tmp_path, monkeypatch)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written >= set(re.findall(r'out / "([^"]+)"', page.read_text(encoding="utf-8")))
    # the figures the page states
    assert abs(names["sphere"].level - names["motion"].levels["total"]) < 1.0
    rms = [np.sqrt(np.mean(signal**2)) for signal in (names["back"], names["pressure"])]
    assert abs(rms[0] / rms[1] - 1.0) < 0.01
    assert names["heard"].levels()[0] > 60.0
