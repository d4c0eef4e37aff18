"""Parts of all pages: verdict, tables of values, slopes and statements, Markdown and CSV."""

import math
import pathlib
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from examples.papers.identification import Answer
from examples.papers.statements import HOLDS, Classed
from examples.papers.values import CHECK, FIT, Interval, Met, rms, rms_by_seed, slope
from fmu_bearing.results.table import markdown, write_csv

GOAL_DB = 3.0  # rms of checked values on each page
SLOPE_GOAL_DB = 3.0  # per decade
_FARTHEST = 3  # values named that are farthest off


def printed(value: Interval) -> str:
    """Return a value as the paper gives it: one number, or the interval it lies in."""
    if value.low == value.high:
        return f"{value.low:.2f}"
    if math.isinf(value.high):
        return f"at least {value.low:.1f}"
    return f"{value.low:.1f} to {value.high:.1f}"


def spread(numbers: Sequence[float]) -> str:
    """Smallest and largest of the seeds' values."""
    return f"{min(numbers):.1f} to {max(numbers):.1f}"


@dataclass(frozen=True)
class Slope:
    """Levels of one place over speed, in the paper and here.

    Attributes
    ----------
    name : str
    levels : tuple of Met
        At two speeds or more.
    """

    name: str
    levels: tuple[Met, ...]

    @property
    def fitted(self) -> int:
        """How many of its levels were fitted."""
        return sum(one.value.role == FIT for one in self.levels)

    @property
    def checked(self) -> bool:
        """Whether it says anything: two fitted levels draw a line of their own."""
        return self.fitted <= 1

    @property
    def paper(self) -> float:
        """The paper's slope (dB per decade), through the middles of intervals."""
        return slope(self._speeds, [one.value.paper.middle for one in self.levels])

    @property
    def ours(self) -> float:
        """Our slope (dB per decade)."""
        return slope(self._speeds, [one.level for one in self.levels])

    @property
    def by_seed(self) -> list[float]:
        """Our slope for each seed."""
        return [slope(self._speeds, one) for one in zip(*(m.by_seed for m in self.levels), strict=True)]

    @property
    def _speeds(self) -> list[float]:
        return [one.value.rpm for one in self.levels]

    @property
    def verdict(self) -> str:
        """Goal met or not; of a slope that is not checked, why."""
        if not self.checked:
            return "not counted: fitted"
        return _met(abs(self.ours - self.paper) <= SLOPE_GOAL_DB)


def near(number: float, goal: float) -> str:
    """Return a number with one decimal, or two where one would hide on which side of the goal it is."""
    return f"{number:.1f}" if abs(round(number, 1) - goal) > 0.01 else f"{number:.2f}"


def slopes(name: str, levels: Sequence[Met]) -> list[Slope]:
    """Return the slope through levels, and the one without those that are marked; none of a single speed."""
    unmarked = [one for one in levels if not one.value.marked]
    found = [Slope(name, tuple(levels))]
    if len(unmarked) < len(levels):
        marks = ", ".join(f"{one.value.rpm:,.0f}" for one in levels if one.value.marked)
        found.append(Slope(f"{name}, without {marks}", tuple(unmarked)))
    return [one for one in found if len({level.value.rpm for level in one.levels}) > 1]


def slope_table(found: Sequence[Slope]) -> str:
    """Slopes with speed, in the paper and here."""
    rows = [
        [
            one.name, f"{len(one.levels)}", f"{one.fitted}", f"{one.paper:.1f}", f"{one.ours:.1f}",
            spread(one.by_seed), f"{one.ours - one.paper:+.1f}", one.verdict,
        ]
        for one in found
    ]  # fmt: skip
    columns = [
        "slope, dB per decade of speed", "levels", "fitted", "paper", "ours", "seeds", "difference",
        f"goal: within {SLOPE_GOAL_DB:.0f}",
    ]  # fmt: skip
    return markdown(columns, rows) if rows else "Not run.\n"


def verdict_part(
    answer: Answer, found: Sequence[Met], lines: Sequence[Slope], judged: Sequence[Classed], unknown: str,
    missed: str = "",
) -> str:  # fmt: skip
    """Say what was fitted, what was predicted, how far off, what was missed, and what nobody could know."""
    fitted = "; ".join(
        f"{one.number.name}, {one.after:.3g}{' ' * bool(one.number.unit)}{one.number.unit} (start: "
        f"{one.before:.3g}), from {one.number.value}"
        for one in answer.found
    )
    checked = [one for one in found if one.value.role == CHECK and not one.value.without]
    points = {
        "In short": _count(answer, found, judged),
        "Fitted": f"{fitted}. Nothing else.",
        "Predicted": _predicted(checked, lines),
        "Farthest off": _farthest([one for one in found if one.value.role == CHECK]),
        "Missed": missed,
        "Nobody could know": unknown,
    }
    return "".join(wrapped(f"* **{head}:** {words}") for head, words in points.items() if words)


def _count(answer: Answer, found: Sequence[Met], judged: Sequence[Classed]) -> str:
    """How many numbers were identified, how many values and statements predicted, how many hold."""
    checked = [one for one in found if one.value.role == CHECK]
    near_ = sum(abs(one.residual) <= GOAL_DB for one in checked)
    refutable = [one for one in judged if one.refutable]
    held = sum(one.kind == HOLDS for one in refutable)
    many = len(answer.found)
    return (
        f"{many} number{'s' * (many > 1)} identified, each from one value; {len(checked)} values predicted, "
        f"{near_} within {GOAL_DB:.0f} dB; {len(refutable)} statements predicted, {held} hold."
    )


def wrapped(text: str) -> str:
    """Return one point of a list in lines of a page's width."""
    return (
        textwrap.fill(text, 110, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
        + "\n"
    )


def _predicted(checked: Sequence[Met], lines: Sequence[Slope]) -> str:
    """Rms of checked values and checked slopes, with their ranges over seeds."""
    if not checked:
        return "nothing was run."
    words = [
        f"{_values(checked)} {near(rms(checked), GOAL_DB)} dB rms off{_over_seeds(checked)}, "
        f"{_goal(checked)}."
    ]
    unmarked = [one for one in checked if not one.value.marked]
    if 0 < len(unmarked) < len(checked):
        marks = "; ".join(f"{one.value.name}, {one.value.marked}" for one in checked if one.value.marked)
        words.append(f"Without {marks}: {near(rms(unmarked), GOAL_DB)} dB, {_goal(unmarked)}.")
    for one in lines:
        if one.checked:
            met = "met" if abs(one.ours - one.paper) <= SLOPE_GOAL_DB else "**missed**"
            words.append(
                f"Slope, {one.name}: {one.ours:.1f} dB per decade (seeds {spread(one.by_seed)}), paper "
                f"{one.paper:.1f}: goal of {SLOPE_GOAL_DB:.0f} {met}."
            )
    return " ".join(words)


def _values(checked: Sequence[Met]) -> str:
    return "one value is" if len(checked) == 1 else f"{len(checked)} values are"


def _over_seeds(found: Sequence[Met]) -> str:
    by_seed = rms_by_seed(found)
    return f" (seeds {spread(by_seed)})" if len(by_seed) > 1 else ""


def _goal(found: Sequence[Met]) -> str:
    return f"goal of {GOAL_DB:.0f} {'met' if rms(found) <= GOAL_DB else '**missed**'}"


def _farthest(checked: Sequence[Met]) -> str:
    """Name the checked values that are farthest off."""
    worst = sorted(checked, key=lambda one: -abs(one.residual))[:_FARTHEST]
    return "; ".join(f"{one.value.name} {one.residual:+.1f} dB" for one in worst) + "."


def values_table(found: Sequence[Met]) -> str:
    """Paper and ours over speeds and seeds, and the distance to the paper's interval."""
    rows = [
        [
            one.value.name + (f" ({one.value.marked})" if one.value.marked else ""), one.value.source,
            printed(one.value.paper), f"{one.level:.1f}", spread(one.by_seed), f"{one.residual:+.1f}",
        ]
        for one in found
    ]  # fmt: skip
    return markdown(["value", "read from", "paper", "ours", "seeds", "residual, dB"], rows)


def values_part(found: Sequence[Met], unit: str = "dB") -> str:
    """Fitted and checked values apart, and the rms of what is checked, group by group."""
    fitted = [one for one in found if one.value.role == FIT]
    checked = [one for one in found if one.value.role == CHECK]
    counted = [one for one in checked if not one.value.without]
    groups = {
        group: [one for one in counted if one.value.group == group]
        for group in dict.fromkeys(one.value.group for one in counted)
    }
    if len(groups) > 1:
        groups["all checked"] = counted
    rows = []
    for name, own in groups.items():
        unmarked = [one for one in own if not one.value.marked]
        rows.append(_rms_row(name, own))
        if 0 < len(unmarked) < len(own):
            rows.append(_rms_row(f"{name}, without what is marked", unmarked))
    left = [one for one in checked if one.value.without]
    words = "".join(
        f"\nNot in these averages: {one.value.name}, because it {one.value.without} "
        f"({one.residual:+.1f} dB off).\n"
        for one in left
    )
    columns = [
        "checked",
        "values",
        f"rms, {unit}",
        "seeds",
        "from the middles",
        f"goal: within {GOAL_DB:.0f}",
    ]
    return (
        f"Fitted:\n\n{values_table(fitted)}\n"
        f"Checked, nothing was fitted to them:\n\n{values_table(checked)}\n{markdown(columns, rows)}{words}"
    )


def _rms_row(name: str, own: Sequence[Met]) -> list[str]:
    """Row of the table of rms values."""
    return [
        name, f"{len(own)}", near(rms(own), GOAL_DB), spread(rms_by_seed(own)) if rms_by_seed(own) else "",
        f"{rms(own, middle=True):.1f}", _met(rms(own) <= GOAL_DB),
    ]  # fmt: skip


def _met(good: bool) -> str:
    return "met" if good else "**not met**"


def statements_table(found: Sequence[Classed]) -> str:
    """Statements down: class, for how many seeds each holds, share of comparisons, figures, reason."""
    rows = [
        [
            f"{number}. {one.statement}",
            one.kind if one.kind == HOLDS else f"**{one.kind}**",
            f"{one.holds} of {one.seeds}", f"{100.0 * one.share:.0f} %", one.figures, one.remark,
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
        """Folder of the CSV files and of the pages of statements."""
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

    def write(self, name: str, text: str, folder: pathlib.Path | None = None) -> pathlib.Path:
        """Write one page; default: beside the other pages."""
        path = (folder or self.pages) / f"{name}.md"
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
