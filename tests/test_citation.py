"""CITATION.cff: what the format asks for is there, and agrees with the package."""

import pathlib
import tomllib

import pytest

pytestmark = pytest.mark.pages

ROOT = pathlib.Path(__file__).parents[1]


@pytest.fixture(scope="module")
def citation():
    yaml = pytest.importorskip("yaml", reason="PyYAML is not installed: extra docs")
    return yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))


def test_the_package_and_its_citation_agree(citation):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert "version" not in citation  # it has one place (tests/test_release.py)
    assert citation["license"] == project["license"]
    assert citation["authors"] == project["authors"]
    assert citation["keywords"] == project["keywords"]


def test_required_fields_are_there(citation):
    assert citation["cff-version"] == "1.2.0"
    for work in (citation, *citation["references"]):
        assert work["title"] and work["authors"]
        for author in work["authors"]:
            # CFF 1.2: a person has names, an entity one name; nothing else is given here
            assert set(author) in ({"name"}, {"family-names", "given-names"})
    assert citation["message"] and {work["type"] for work in citation["references"]} == {"article"}


def test_the_three_papers_are_cited(citation):
    pages = "multi-source", "sound-field", "impact-noise"
    assert [next(page for page in pages if page in work["notes"]) for work in citation["references"]] == list(
        pages
    )
