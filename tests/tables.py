"""The tables under docs/results: rows, numbers as pages show them, lines of the benchmark."""

import csv
import functools
import math
import pathlib
import re
from typing import NamedTuple

DOCS = pathlib.Path(__file__).parents[1] / "docs"
RESULTS = DOCS / "results"


@functools.cache
def table(name, heading=""):
    """Rows of a table as dictionaries: of ``name.csv``, or the one below a heading of ``name.md``."""
    if not heading:
        with (RESULTS / f"{name}.csv").open(encoding="utf-8", newline="") as file:
            return tuple(csv.DictReader(file))
    text = (RESULTS / f"{name}.md").read_text("utf-8").split(f"## {heading}\n", 1)[1]
    lines = [line for line in re.split(r"\n## ", text)[0].splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return tuple(dict(zip(cells[0], row, strict=True)) for row in cells[2:])


def row(name, heading="", **wanted):
    """Return the one row of a table whose columns have the given texts; ``_`` in a name may be a space."""
    rows = table(name, heading)
    keys = {key if key in rows[0] else key.replace("_", " "): value for key, value in wanted.items()}
    found = [one for one in rows if all(one[key] == value for key, value in keys.items())]
    assert len(found) == 1, (name, heading, wanted, len(found))
    return found[0]


def rounded(text, digits=2):
    """A number with so many significant digits, without an exponent where it needs none."""
    value = float(text.replace(",", "").rstrip(" %"))
    if value == 0.0 or 1e-3 <= abs(value) < 1e5:
        return f"{float(f'{value:.{digits}g}'):.10g}"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def percent(text, digits=2):
    """A share as per cent."""
    return f"{rounded(str(100.0 * float(text)), digits)} %"


def signed(text, decimals=1):
    """A number of decibels with its sign."""
    return f"{float(text):+.{decimals}f}" if float(f"{float(text):.{decimals}f}") else "0.0"


def scene_line(name, rpm, fidelity, load="0"):
    return row("scenes", scene=name, fidelity=fidelity, **{"r/min": rpm, "radial,_N": load})


#: Names of the benchmark's cases on the page.
CASES = {
    "7003C-bare 1,000 r/min": "7003C bare, 1,000 r/min",
    "7003C-bare 10,000 r/min": "7003C bare, 10,000 r/min",
    "7003C-spindle 20,000 r/min": "7003C spindle, 20,000 r/min",
    "7003C-bare 28,000 r/min": "7003C bare, 28,000 r/min",
    "7009C-full-ceramic 3,000 r/min": "7009C, 3,000 r/min",
    "7009C-full-ceramic 18,000 r/min": "7009C, 18,000 r/min",
    "7003C-spindle 20,000 r/min, 300 N radial": "spindle, 300 N radial",
    "7003C-spindle 20,000 r/min, 1000 N radial": "spindle, 1000 N radial",
    "7003C-bare 10,000 r/min, 300 N radial": "bare, 10,000 r/min, 300 N",
    "7003C-bare 10,000 r/min, 1000 N radial": "bare, 10,000 r/min, 1000 N",
    "7003C-spindle 20,000 r/min, first 4 ms": "spindle, first 4 ms",
    "7009C-full-ceramic 18,000 r/min, first 4 ms": "7009C, 18,000 r/min, first 4 ms",
    "example 7003C-bare 20,000 r/min": "example 7003C bare, 20,000 r/min",
    "example 7003C-spindle 20,000 r/min": "example 7003C spindle, 20,000 r/min",
    "example 7009C-full-ceramic 18,000 r/min": "example 7009C, 18,000 r/min",
}


def usual(case):
    """Lines of full, rings and response of a case at their usual setting."""
    lines = [one for one in table("benchmark") if one["case"] == case]
    full = [one for one in lines if one["solver"] == "full / esdirk4" and one["setting"].startswith("usual")]
    others = [[one for one in lines if one["solver"] == name] for name in ("rings", "response")]
    return [one[0] if one else None for one in (full, *others)]


def fastest(case):
    """Line of the fastest setting of full within 1e-3 of a case."""
    (found,) = (
        one
        for one in table("benchmark")
        if one["case"] == case and one["solver"] == "full / esdirk4" and one["setting"].startswith("fastest")
    )
    return found


def moved(parameter, to, column):
    """What a figure of the sensitivity study changes by, as a number."""
    return float(row("sensitivity", parameter=parameter, **{"moved to": to})[column])


def up(value):
    """A bound with one decimal: not below the value."""
    return f"{math.ceil(10.0 * value - 1e-9) / 10.0:.1f}"


def critical_speed():
    """Critical speed of the scene's pedestal, r/min."""
    found = float(row("sweep", **{"pedestal, N/m": "7.1e+07"})["mode, r/min"])
    return f"{100 * round(found / 100):,}"


class Rows(NamedTuple):
    """All rows of a table of a page, below ``<!-- rows: name -->``; they are written, whatever was there."""

    name: str
    lines: tuple[str, ...]

    def place(self, text):
        """Where a page has them."""
        found = re.search(rf"<!-- rows: {self.name} -->\n\n(?:\|.*\n){{2}}((?:\|.*\n)*)", text)
        assert found is not None, f"the page has no mark of the rows {self.name}"
        return found

    def text(self):
        """Lines of the page."""
        return "".join(f"{line}\n" for line in self.lines)


def rows(name, lines):
    """Rows of lists of cells."""
    return Rows(name, tuple(f"| {' | '.join(cells)} |".replace("|  |", "| |") for cells in lines))


def missing(page, parts):
    """Return those of the sentences and `Rows` that a page lacks; line breaks of sentences do not count."""
    text = (DOCS / page).read_text("utf-8")
    flat = " ".join(text.split())
    return [
        one
        for one in parts
        if (one.place(text)[1] != one.text() if isinstance(one, Rows) else " ".join(one.split()) not in flat)
    ]


def settings_of(found):
    """Tolerance and longest step (us) of a row of the benchmark, as it has them."""
    return re.search(r"tol (\S+), h <= (\S+) us", found["setting"]).groups()


_FIGURE = r"(?<![\w.])[-+]?\d+(?:[.,]\d+)*(?:e[-+]?\d+)?"


def write(page, parts):
    """Write `Rows`, and figures of sentences whose words are the same, into a page; return what it lacks."""
    path = DOCS / page
    text = path.read_text("utf-8")
    lacking = missing(page, parts)
    for one in list(lacking):
        if isinstance(one, Rows):
            first, last = one.place(text).span(1)
            text = text[:first] + one.text() + text[last:]
            lacking.remove(one)
            continue
        words, figures = re.split(_FIGURE, one), re.findall(_FIGURE, one)
        blank = [r"\s+".join(map(re.escape, re.split(r"\s+", part))) for part in words]
        # of several places the one that has most of the figures already
        places = sorted(
            re.finditer(f"({_FIGURE})".join(blank), text),
            key=lambda place, wanted=figures: -sum(map(str.__eq__, place.groups(), wanted)),
        )
        if places:
            for k in range(len(figures), 0, -1):
                first, last = places[0].span(k)
                text = text[:first] + figures[k - 1] + text[last:]
            lacking.remove(one)
    path.write_text(text, "utf-8")
    return lacking
