"""Figures of pages are those of the tables under docs/results, and those that the package computes."""

import pytest

from tests import computed, figures, tables

pytestmark = pytest.mark.pages


@pytest.mark.parametrize("page", figures.PAGES)
def test_a_page_has_the_figures_of_the_tables(page):
    assert not tables.missing(page, figures.PAGES[page]())


@pytest.mark.parametrize("page", computed.PAGES)
def test_a_page_has_the_figures_that_the_package_computes(page):
    assert not tables.missing(page, computed.PAGES[page]())


@pytest.mark.parametrize(
    ("text", "digits", "shown"),
    [("2.394", 2, "2.4"), ("226", 2, "230"), ("8.4e-05", 1, "8e-5"), ("1,234", 3, "1230"), ("0", 2, "0")],
)
def test_figures_are_rounded(text, digits, shown):
    assert tables.rounded(text, digits) == shown


def test_rows_and_figures_are_written(tmp_path, monkeypatch):
    """Rows whatever they were, figures where the words are the same; what is left is returned."""
    text = "Of 3 runs\n2 fail.\n\n<!-- rows: loads -->\n\n| a | b |\n|---|---|\n| old |\n\nEnd\n"
    (tmp_path / "page.md").write_text(text, "utf-8")
    monkeypatch.setattr(tables, "DOCS", tmp_path)
    parts = ["Of 5 runs 4 fail", tables.rows("loads", [("x", "1"), ("y", "2")]), "Of 5 walks"]
    assert tables.missing("page.md", parts) == parts
    assert tables.write("page.md", parts) == ["Of 5 walks"] == tables.missing("page.md", parts)
    assert (tmp_path / "page.md").read_text("utf-8") == (
        "Of 5 runs\n4 fail.\n\n<!-- rows: loads -->\n\n| a | b |\n|---|---|\n| x | 1 |\n| y | 2 |\n\nEnd\n"
    )
    with pytest.raises(AssertionError, match="no mark of the rows angles"):
        tables.missing("page.md", [tables.rows("angles", [])])


def test_a_figure_that_is_not_the_tables_is_found(monkeypatch):
    monkeypatch.setattr(figures, "_ratio", lambda found, key: "7.77")
    page = "fidelities/rings.md"
    assert any("7.77" in one for one in tables.missing(page, figures.PAGES[page]()))


def test_a_figure_that_the_package_does_not_compute_is_found(monkeypatch):
    monkeypatch.setattr(computed, "_rings_at", lambda point: "7.77")
    assert any("7.77" in one for one in tables.missing("gallery.md", computed.PAGES["gallery.md"]()))
