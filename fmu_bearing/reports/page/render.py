"""The page from its sections: one self-contained HTML file."""

import datetime
import platform
import re
from collections.abc import Sequence
from importlib import metadata, resources
from typing import Any

from fmu_bearing.extras import need
from fmu_bearing.reports.page import packing
from fmu_bearing.reports.page.blocks import Card, Chart, Overall, Section, Shapes, Table, packed
from fmu_bearing.reports.page.look import styles

#: Content security policy: the page loads nothing from outside. Plotly generates code for its 3-D drawing.
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src data: blob:; media-src data:; font-src data:"
)


def version() -> str:
    """Version of the package; empty where it runs without being installed."""
    try:
        return metadata.version("fmu-bearing")
    except metadata.PackageNotFoundError:
        return ""


def render(
    title: str, subtitle: str, source: str, sections: list[Section], tiles: list[dict[str, Any]],
    sentences: list[str], warnings: list[str], verdicts: Table | None = None,
    made: datetime.datetime | None = None, kind: str = "Bearing report", overall: Overall | None = None,
    cards: Sequence[Card] = (),
) -> str:  # fmt: skip
    """Return the page as text.

    Parameters
    ----------
    title, subtitle, source : str
        Heading, the line under it, and where the run came from.
    sections : list of Section
    tiles, sentences, warnings
        As ``summary`` makes them.
    verdicts : Table, optional
        As `judged` makes it.
    made : datetime, optional
        Default: now.
    kind : str
        Text above the title.
    overall : Overall, optional
        As `overall_of` makes it: the first thing on the page.
    cards : sequence of Card
        One for each bearing of a set.

    Raises
    ------
    MissingExtra
        Without jinja2 or plotly.
    """
    jinja2 = need("jinja2", "a report")
    library = need("plotly.offline", "a report").get_plotlyjs()
    files = resources.files("fmu_bearing.reports.page")
    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    environment.filters["code"] = _code
    template = environment.from_string(files.joinpath("page.html.j2").read_text("utf-8"))
    made = made or datetime.datetime.now(datetime.UTC)
    blocks = [block for section in sections for block in section.blocks]
    charts = {block.key: block.figure for block in blocks if isinstance(block, Chart)}
    versions = f"fmu-bearing {version()}, Python {platform.python_version()}".replace(" ,", ",")
    return str(
        template.render(
            title=title, subtitle=subtitle, source=source, sections=sections, tiles=tiles,
            overall=overall, cards=cards, sentences=sentences, warnings=warnings, verdicts=verdicts,
            policy=POLICY,
            made=f"{made:%d %B %Y, %H:%M} UTC", versions=versions,
            figures=packing.text_of(packing.figures(charts)) if charts else "", kind=kind,
            shapes=[block for block in blocks if isinstance(block, Shapes)],
            styles=packed(styles()),
            css=files.joinpath("page.css").read_text("utf-8"),
            script=files.joinpath("page.js").read_text("utf-8"),
            shapes_script=files.joinpath("shapes.js").read_text("utf-8"),
            library=packing.text_of(library.encode("utf-8")) if charts else "",
        )
    )  # fmt: skip


def _code(text: str) -> Any:
    """Return a text with the words between backticks set as code, for a page."""
    safe = need("jinja2.utils", "a report").markupsafe
    return safe.Markup(re.sub("`([^`]+)`", r"<code>\1</code>", str(safe.escape(text))))
