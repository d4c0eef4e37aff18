"""docs/analysis.md runs as it stands, and states figures that come out."""

import re

import numpy as np
import pytest

from tests.pages import DOCS, blocks, run_page

pytestmark = pytest.mark.pages


@pytest.mark.heavy  # circles, planes and spheres by boundary elements: 45 s
def test_the_page_runs(tmp_path, monkeypatch):
    page = DOCS / "analysis.md"
    assert sum(language == "python" for language, _, _ in blocks(page)) == 14
    names = run_page(page, tmp_path, monkeypatch)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written >= set(re.findall(r'out / "([^"]+)"', page.read_text(encoding="utf-8")))
    # the figures the page states
    above = names["motion"].levels["total"] - names["sphere"].level
    assert f"{above:.1f} dB too high. For a housing" in " ".join(page.read_text(encoding="utf-8").split())
    rms = [np.sqrt(np.mean(signal**2)) for signal in (names["back"], names["pressure"])]
    assert abs(rms[0] / rms[1] - 1.0) < 0.01
    assert names["from_fmu"].levels()[0] > 60.0
    sure = names["sure"]
    stated = re.search(
        r"reads (\d+) to\s+(\d+) dB\(A\), of which seeds make (\d) dB", page.read_text("utf-8")
    )
    assert [round(float(x)) for x in (sure.low[0], sure.high[0], sure.seeds[0])] == [
        int(x) for x in stated.groups()
    ]
