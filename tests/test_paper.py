"""The software paper: every figure is a table's, references are there, authors are CITATION.cff's."""

import re
import tomllib

import pytest

from tests.conftest import ROOT
from tests.figures_of_paper import paper
from tests.tables import missing

pytestmark = pytest.mark.pages

TEXT = (ROOT / "paper.md").read_text("utf-8")
_, HEAD, BODY = TEXT.split("---\n", 2)
BIB = (ROOT / "paper.bib").read_text("utf-8")
#: Names and conditions with digits that no table has.
NAMES = ("FMI 2.0", "CABA3D", "35 mm bore")


def test_every_figure_is_that_of_a_table():
    sentences = [" ".join(one.split()) for one in paper()]
    assert not missing("../paper.md", sentences)
    left = " ".join(BODY.split())
    for one in sorted((*sentences, *NAMES), key=len, reverse=True):
        left = left.replace(one, "")
    left = re.sub(r"\[@[^]]+\]", "", left)
    assert not re.findall(r"\S*\d\S*", left), "a figure that comes from no table"


def test_a_figure_that_the_tables_do_not_have_is_found():
    assert missing("../paper.md", ["718 values from 11 sources"])


def test_references_are_cited_and_there():
    cited = {key for group in re.findall(r"\[(@[^]]+)\]", BODY) for key in re.findall(r"@(\w+)", group)}
    assert cited == set(re.findall(r"^@\w+\{(\w+),", BIB, flags=re.MULTILINE))
    assert BIB.count("{") == BIB.count("}")


def test_head_agrees_with_the_citation():
    yaml = pytest.importorskip("yaml", reason="PyYAML is not installed: extra docs")
    head = yaml.safe_load(HEAD)
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert head["title"] == citation["title"] and head["tags"] == citation["keywords"]
    assert [one["name"] for one in head["authors"]] == [one["name"] for one in citation["authors"]]
    assert head["bibliography"] == "paper.bib"


def test_sections_and_length_are_those_of_the_journal():
    heads = re.findall(r"^# (.*)$", BODY, flags=re.MULTILINE)
    for one in ("Summary", "Statement of need", "State of the field", "Software design", "References"):
        assert one in heads
    # the journal asks for 750 to 1750 words
    assert 750 <= len(BODY.split()) <= 1750


def test_the_source_distribution_has_it():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    assert {"paper.md", "paper.bib"} <= set(project["tool"]["hatch"]["build"]["targets"]["sdist"]["include"])
