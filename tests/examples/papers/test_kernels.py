"""The page from equation to kernel: every equation of the papers is listed, every name on it exists."""

import re

import pytest

from examples.papers.case import ROOT

pytestmark = pytest.mark.pages

PAGE = (ROOT / "docs" / "papers" / "kernels.md").read_text("utf-8")
#: Numbered equations of each paper.
LAST = {"Multi-source": 47, "Sound-field": 16, "Impact-noise": 13}


@pytest.mark.parametrize("paper", LAST)
def test_every_equation_is_listed_once(paper):
    part = next(one for one in PAGE.split("\n## ")[1:] if one.startswith(paper))
    listed = []
    for row in [line for line in part.splitlines() if re.match(r"\| \d", line)]:
        for word in row.split(" | ")[0].strip("| ").split(", "):
            first, *last = (int(number) for number in word.split(" to "))
            listed += range(first, (last or [first])[0] + 1)
    assert sorted(listed) == list(range(1, LAST[paper] + 1))


def test_every_name_exists():
    names = re.findall(r"`([\w/]+\.py)::(\w+)`", PAGE)
    assert len(names) > 60
    for path, name in names:
        place = next(p for p in (ROOT / "fmu_bearing" / path, ROOT / path) if p.exists())
        assert re.search(rf"^\s*(def|class) {name}\b", place.read_text("utf-8"), re.MULTILINE), (path, name)
