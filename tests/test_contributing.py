"""CONTRIBUTING.md names what is there."""

import re

import pytest

from tests.pages import ROOT

pytestmark = pytest.mark.pages

TEXT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


def test_links_files_and_targets_are_there():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert set(re.findall(r"\bmake ([a-z]+(?:-[a-z]+)*)", TEXT)) <= targets
    paths = re.findall(r"\]\(([^)#]+)\)", TEXT) + re.findall(r"`([\w./]+/[\w./]*|\.?\w+\.\w{2,})`", TEXT)
    assert len(paths) > 10
    for path in paths:
        # folders of the package are named from there, as they are in the code
        places = (ROOT / path, ROOT / "fmu_bearing" / path, ROOT / "fmu_bearing" / "engine" / path)
        built = path in ("fidelity.model", "fidelity.method") or path.startswith("out/")
        assert built or any(place.exists() for place in places), path
