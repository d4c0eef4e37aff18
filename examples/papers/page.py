"""Parts of all pages: verdicts, comparisons, tables in Markdown and CSV."""

import pathlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fmu_bearing.run.table import markdown, write_csv

HOLDS, NOT, UNSEEN = "holds", "does not hold", "not judged"
_NAMED = 3  # cases named that a statement fails in


@dataclass(frozen=True)
class Ordering:
    """A statement of a paper that needs no absolute level, its verdict, and the figures it rests on."""

    statement: str
    verdict: str
    figures: str


@dataclass(frozen=True)
class Value:
    """A value readable from a paper and ours.

    ``role`` says whether it was calibrated, predicted, or compared without a level; ``since`` holds the pair
    (paper, ours) from which its change is compared.
    """

    what: str
    paper: float
    ours: float
    role: str = "predicted"
    unit: str = "dB"
    source: str = ""
    since: tuple[float, float] | None = None

    @property
    def trend(self) -> str:
        """Changes in the paper and here, and whether they have one direction."""
        if self.since is None:
            return ""
        theirs, ours = self.paper - self.since[0], self.ours - self.since[1]
        same = "holds" if theirs * ours > 0.0 else "does not hold"
        return f"{theirs:+.1f} / {ours:+.1f}: {same}"


def verdict(statement: str, margins: Sequence[tuple[str, float]], unit: str = "dB") -> Ordering:
    """Judge a statement that holds where every margin is positive; margins go by the name of their case."""
    if not margins:
        return Ordering(statement, UNSEEN, "")
    bad = [f"{name} ({margin:+.1f})" for name, margin in margins if not margin > 0.0]
    low, high = min(m for _, m in margins), max(m for _, m in margins)
    spread = f"{low:+.1f} to {high:+.1f} {unit}" if len(margins) > 1 else f"{low:+.1f} {unit}"
    if not bad:
        return Ordering(statement, HOLDS, spread)
    if len(bad) == len(margins):
        return Ordering(statement, NOT, spread if len(bad) == 1 else f"nowhere: {spread}")
    shown = ", ".join(bad[:_NAMED]) + (f" and {len(bad) - _NAMED} more" if len(bad) > _NAMED else "")
    share = f"in {len(margins) - len(bad)} of {len(margins)}"
    return Ordering(statement, NOT, f"{share}: {spread}; not at {shown}")


def orderings_table(models: Sequence[str], found: Sequence[Sequence[Ordering]]) -> str:
    """Statements down, one pair of columns per radiation model."""
    columns = ["what the paper states"]
    for radiation_model in models:
        columns += [f"`{radiation_model}`", "figures"]
    rows = []
    for number, same in enumerate(zip(*found, strict=True)):
        row = [f"{number + 1}. {same[0].statement}"]
        for ordering in same:
            mark = f"**{ordering.verdict}**" if ordering.verdict == NOT else ordering.verdict
            row += [mark, ordering.figures]
        rows.append(row)
    return markdown(columns, rows)


def values_table(values: Iterable[Value]) -> str:
    """Paper, ours, the difference, and the change from a reference in both."""
    rows = [
        [
            v.what,
            v.source,
            f"{v.paper:.2f}",
            f"{v.ours:.2f}",
            f"{v.ours - v.paper:+.2f} {v.unit}",
            v.role,
            v.trend,
        ]
        for v in values
    ]
    return markdown(["quantity", "read from", "paper", "ours", "difference", "", "trend: paper / ours"], rows)


def counted(found: Sequence[Ordering]) -> str:
    """How many statements hold."""
    seen = [ordering for ordering in found if ordering.verdict != UNSEEN]
    return f"{sum(ordering.verdict == HOLDS for ordering in seen)} of {len(seen)}"


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
