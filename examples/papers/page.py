"""Parts of all pages: tables of values, slopes and statements, Markdown and CSV."""

import pathlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from examples.papers.statements import HOLDS, Classed
from examples.papers.values import CHECK, FIT, Interval, Met, rms, slope
from fmu_bearing.results.table import markdown, write_csv

GOAL_DB = 3.0  # rms of checked values on each page


def printed(value: Interval) -> str:
    """Return a value as the paper gives it: one number, or the interval it lies in."""
    if value.low == value.high:
        return f"{value.low:.2f}"
    return f"{value.low:.1f} to {value.high:.1f}"


def spread(numbers: Sequence[float]) -> str:
    """Smallest and largest of the seeds' values."""
    return f"{min(numbers):.1f} to {max(numbers):.1f}"


def values_table(found: Sequence[Met]) -> str:
    """Paper and ours over the seeds, distance to the paper's interval, and difference from its middle."""
    rows = [
        [
            one.value.name, one.value.source, printed(one.value.paper), f"{one.mean:.1f}",
            spread(one.ours), f"{one.residual:+.1f}", f"{one.from_middle:+.1f}",
        ]
        for one in found
    ]  # fmt: skip
    columns = ["value", "read from", "paper", "ours", "seeds", "residual, dB", "from the middle, dB"]
    return markdown(columns, rows)


def values_part(found: Sequence[Met], before: Sequence[Met], unit: str = "dB") -> str:
    """Fitted and checked values apart, and the rms of what is checked, group by group.

    ``before`` holds the same values with the scene's own numbers, before anything is identified.
    """
    fitted = [one for one in found if one.value.role == FIT]
    checked = [one for one in found if one.value.role == CHECK]
    old = {one.value.name: one for one in before}
    rows = []
    for group in dict.fromkeys(one.value.group for one in checked):
        if own := [one for one in checked if one.value.group == group and not one.value.without]:
            rows.append(_rms_row(group, own, old))
    if len(rows) > 1:
        rows.append(_rms_row("all checked", [one for one in checked if not one.value.without], old))
    left = [one for one in checked if one.value.without]
    words = "".join(
        f"Not in these averages: {one.value.name}, because it {one.value.without} "
        f"({one.residual:+.1f} dB off).\n"
        for one in left
    )
    columns = [
        "checked", "values", f"rms, {unit}", f"goal: within {GOAL_DB:.0f}", "before identification",
        "from the middles",
    ]  # fmt: skip
    return (
        f"Fitted:\n\n{values_table(fitted)}\n"
        f"Checked, nothing was fitted to them:\n\n{values_table(checked)}\n{markdown(columns, rows)}\n{words}"
    )


def _rms_row(name: str, own: Sequence[Met], old: Mapping[str, Met]) -> list[str]:
    """Row of the table of rms values."""
    before = [old[one.value.name] for one in own if one.value.name in old]
    return [
        name, f"{len(own)}", f"{rms(own):.1f}", "met" if rms(own) <= GOAL_DB else "**not met**",
        f"{rms(before):.1f}" if len(before) == len(own) else "",
        f"{rms(own, middle=True):.1f}",
    ]  # fmt: skip


SLOPE_GOAL_DB = 5.0  # per decade


def slope_table(found: Sequence[Met]) -> str:
    """Slope with speed through measured levels and through ours at the same speeds and places."""
    speeds = [one.value.rpm for one in found]
    if len(set(speeds)) < 2:
        return "Not run.\n"
    measured = slope(speeds, [one.value.paper.middle for one in found])
    mean = slope(speeds, [one.mean for one in found])
    by_seed = [slope(speeds, levels) for levels in zip(*(one.ours for one in found), strict=True)]
    met = "met" if abs(mean - measured) <= SLOPE_GOAL_DB else "**not met**"
    row = [
        f"{len(found)}", f"{min(speeds):,.0f} to {max(speeds):,.0f}", f"{measured:.1f}", f"{mean:.1f}",
        spread(by_seed), f"{mean - measured:+.1f}", met,
    ]  # fmt: skip
    columns = [
        "levels", "r/min", "measured, dB per decade", "ours", "seeds", "difference",
        f"goal: within {SLOPE_GOAL_DB:.0f}",
    ]  # fmt: skip
    return markdown(columns, [row])


def statements_table(found: Sequence[Classed]) -> str:
    """Statements down: class, for how many seeds each holds, share of comparisons, figures, reason."""
    rows = [
        [
            f"{number}. {one.statement}",
            one.kind if one.kind == HOLDS else f"**{one.kind}**",
            f"{one.holds} of {one.seeds}", f"{100.0 * one.share:.0f} %", one.figures, one.reason,
        ]
        for number, one in enumerate(found, 1)
    ]  # fmt: skip
    columns = ["what the paper states", "class", "seeds", "comparisons", "figures, first seed", "why"]
    return markdown(columns, rows)


@dataclass(frozen=True)
class Output:
    """Folders below ``root`` (the repository, or where a trial writes) that pages, CSV and pictures go to."""

    root: pathlib.Path

    @property
    def pages(self) -> pathlib.Path:
        """Folder of the pages."""
        return self.root / "docs" / "papers"

    @property
    def results(self) -> pathlib.Path:
        """Folder of the CSV files."""
        return self.root / "docs" / "results" / "papers"

    @property
    def images(self) -> pathlib.Path:
        """Folder of the pictures."""
        return self.root / "docs" / "images" / "papers"

    def make(self) -> None:
        """Create the folders."""
        for folder in (self.pages, self.results, self.images):
            folder.mkdir(parents=True, exist_ok=True)

    def csv(self, name: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """Write one CSV file."""
        write_csv(self.results / f"{name}.csv", columns, rows)

    def records(self, name: str, rows: Sequence[Mapping[str, object]]) -> None:
        """Write rows of one set of columns as a CSV file."""
        self.csv(name, list(rows[0]), [[str(cell) for cell in row.values()] for row in rows])

    def write(self, name: str, text: str) -> pathlib.Path:
        """Write one page."""
        path = self.pages / f"{name}.md"
        path.write_text(text.strip() + "\n", encoding="utf-8")
        return path


def template(name: str) -> str:
    """Return the words of a page, with names in braces where results go."""
    return (pathlib.Path(__file__).parent / "text" / f"{name}.md").read_text("utf-8")


def timing(settle: float, duration: float) -> str:
    """Say how long runs are (s)."""
    return f"{1e3 * settle:.0f} ms left out, {1e3 * duration:.0f} ms measured"


def caution(radiation_model: str) -> str:
    """Limits of the radiation model, to be read before any figure."""
    if radiation_model == "compact":
        return (
            "> Radiation model `compact` has no scattering between rings, balls and housing. In the\n"
            "> bearing's plane it differs from boundary elements by 1 dB at 2 kHz (7003C) and at 1 kHz\n"
            "> (7009C), and by far more above. Use it for trends with speed and for components, not for\n"
            "> the directivity of the 7009C.\n"
        )
    return ""
