"""Tables, sentences and pictures of the sound-field paper's page that compare no value with the paper."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from examples.papers import charts, page
from examples.papers.case import SEEDS
from examples.papers.circles import Circle, falls
from examples.papers.hearing import NAMES
from examples.papers.medians import by_seed
from examples.papers.page import Output
from examples.papers.reduced import ANGLES, PLACES, RADII, WHOLE, L, R
from examples.papers.runs import Results
from examples.papers.values import Value
from fmu_bearing.results.table import markdown

SPINDLE, BARE, CONTACTS = "spindle", "bare bearing", "bare bearing, paper_contacts"


@dataclass(frozen=True)
class Variants:
    """Results of all runs of one mounting: the ceramic bearing, its steel twin; empty where not run."""

    ceramic: Results
    steel: Results


def over(found: Results, read: Callable[[dict[str, Any]], float], rpm: float = WHOLE) -> list[float]:
    """Median of one number over the runs at a speed, then that of each seed."""
    by: dict[int, list[float]] = {}
    for one, result in found.items():
        if one.rpm == rpm:
            by.setdefault(one.seed, []).append(read(result))
    return [float(np.median(np.concatenate(list(by.values())))), *(float(np.median(x)) for x in by.values())]


def each(found: Results, read: Callable[[dict[str, Any]], float], rpm: float) -> list[float]:
    """One number of all runs at a speed."""
    return [read(result) for one, result in found.items() if one.rpm == rpm]


def angles_sentence(ceramic: Results) -> str:
    """Directions of the loudest point for all seeds."""
    found = [f"{Circle(results[WHOLE]).angle()}" for results in by_seed(ceramic.items()).values()]
    return (
        f"DA of the whole circle at 18,000 r/min is {', '.join(found)} deg for the {len(found)} seeds: it "
        "describes the draw and not the bearing.\n"
    )


def sizes_sentence(paper_values: Sequence[Value], ceramic: Results) -> str:
    """Growth of DV over r and its fall over l, in the paper and here."""
    paper = {one.place: one.paper.middle for one in paper_values if one.quantity == "dv"}

    def change(ends: Sequence[tuple[int, int]]) -> str:
        first, last = ends
        found = over(ceramic, lambda result: Circle(result, *last).dv - Circle(result, *first).dv)
        wanted = paper[f"{last[0]},{last[1]}"] - paper[f"{first[0]},{first[1]}"]
        return f"{found[0]:+.1f} dB ({page.spread(found[1:])} over the seeds), paper {wanted:+.2f}"

    near, far = (RADII[0], RADII[-1]), (PLACES[0], PLACES[-1])
    over_r = [f"at l {x} {change([(r, x) for r in near])}" for x in far]
    over_l = [f"at r {r} {change([(r, x) for x in far])}" for r in near]
    return (
        f"DV changes from r {near[0]} to {near[1]} mm {'; '.join(over_r)}. From l {far[0]} to {far[1]} mm it "
        f"changes {'; '.join(over_l)}.\n"
    )


def _point(near: tuple[float, float], far: tuple[float, float]) -> float:
    """Fall (dB) of a point source at the bearing's centre between two places (r, l)."""
    return 20.0 * math.log10(math.hypot(*far) / math.hypot(*near))


def falls_part(paper_values: Sequence[Value], *variants: Results) -> str:
    """Falls over r at every l, and over l at every r: in the spindle, bare, by the paper's own model."""
    paper = {one.place: one.paper.middle for one in paper_values if one.quantity == "fall"}
    by_r, by_l = paper[f"{RADII[0]},{L};{RADII[-1]},{L}"], paper[f"{RADII[0]},20;{RADII[0]},200"]
    rows, fits = [], []
    for k, (words, at, names, wanted) in enumerate((
        (f"r {RADII[0]} to {RADII[-1]}", "l", PLACES, by_r),
        (f"l {PLACES[0]} to {PLACES[-1]}", "r", RADII, by_l),
    )):  # fmt: skip
        both = [
            [over(found, lambda result, k=k, i=i: falls(result)[k][i]) for i in range(len(names))]
            for found in variants
            if found
        ]
        for i, name in enumerate(names):
            ends = [(r, name) for r in RADII] if k == 0 else [(name, x) for x in PLACES]
            cells = [f"{one[i][0]:.1f} ({page.spread(one[i][1:])})" for one in both]
            cells += [""] * (len(variants) - len(cells))
            rows.append(
                [f"{words}, {at} {name}", f"{wanted:.2f}", *cells, f"{_point(ends[0], ends[-1]):.1f}"]
            )
        fits.append(f"{wanted:g} dB fit {at} {_where(names, [one[0] for one in both[0]], wanted)}")
    columns = ["mm", "paper", *(f"{name} (seeds)" for name in (SPINDLE, BARE, CONTACTS)), "point source"]
    return f"{markdown(columns, rows)}\nBy the spindle, {' and '.join(fits)}.\n"


def _where(names: Sequence[int], found: Sequence[float], wanted: float) -> str:
    """Where numbers reach one, between neighbours by a straight line."""
    for a, b, x, y in zip(names, names[1:], found, found[1:], strict=False):
        if (x - wanted) * (y - wanted) <= 0.0 and x != y:
            return f"{a + (b - a) * (wanted - x) / (y - x):.0f} mm"
    far, name = min((abs(x - wanted), name) for x, name in zip(found, names, strict=True))
    return f"nowhere ({far:.1f} dB off at {name} mm)"


def field_table(ceramic: Results, directive: bool) -> str:
    """SPLmax and DV of all circles, medians over speeds and seeds."""
    rows = []
    for r in RADII:
        cells = []
        for place in PLACES:
            top = over(ceramic, lambda result, r=r, x=place: Circle(result, r, x).top)[0]
            dv = over(ceramic, lambda result, r=r, x=place: Circle(result, r, x).dv)[0]
            cells.append(f"{top:.1f} / {dv:.1f}" if directive else f"{top:.1f}")
        rows.append([f"{r}", *cells])
    return markdown(["r, mm", *(f"l {place} mm" for place in PLACES)], rows)


def part_table(ceramic: Results) -> str:
    """Levels of the components on the paper's circle, medians over speeds and seeds."""
    rows = []
    for rpm in sorted({one.rpm for one in ceramic}):
        levels = []
        for name in (*NAMES, "total"):
            level = over(ceramic, lambda result, name=name: _mean(result["parts"][name]), rpm)[0]
            levels.append(f"{level:.1f}")
        dv, dl = (over(ceramic, read, rpm)[0] for read in (lambda x: Circle(x).dv, lambda x: Circle(x).dl()))
        ratio = over(ceramic, lambda result: result["cage_ratio"], rpm)[0]
        rows.append([f"{rpm:,.0f}", *levels, f"{dv:.1f}", f"{dl:.3f}", f"{ratio:.4f}"])
    return markdown(["r/min", *NAMES.values(), "total", "DV, dB", "DL", "cage over shaft speed"], rows)


def _mean(levels: Sequence[float]) -> float:
    """Energy mean of levels (dB)."""
    return 10.0 * math.log10(sum(10.0 ** (x / 10.0) for x in levels) / len(levels))


def write_csv(page_name: str, variants: dict[str, Variants], output: Output) -> None:
    """Write medians over the speeds around each, seed by seed."""
    found = {
        f"{name}, {material}": getattr(one, material)
        for name, one in variants.items()
        for material in ("ceramic", "steel")
    }
    rows = []
    for name, results in found.items():
        for seed, by_speed in by_seed(results.items()).items():
            for rpm, result in by_speed.items():
                whole = len(result["field"]) > 1 and name == f"{SPINDLE}, ceramic"
                for r, place in [(r, x) for r in RADII for x in PLACES] if whole else [(R, L)]:
                    c = Circle(result, r, place)
                    figures = (f"{c.top:.2f}", f"{c.dv:.2f}", *(f"{c.dl(zone):.4f}" for zone in result["dl"]))
                    levels = (f"{level:.2f}" for level in c.levels)
                    rows.append([name, f"{seed}", f"{rpm}", f"{r}", f"{place}", *figures, *levels])
    columns = ["variant", "seed", "rpm", "r_mm", "l_mm", "SPLmax_dB", "DV_dB", "DL", "DL_0_60", "DL_180_240"]
    output.csv(page_name, [*columns, *(f"{a}_deg" for a in ANGLES)], rows)


def draw_pictures(page_name: str, all_: Variants, alone: Variants, output: Output) -> None:
    """Draw circles of the first seed about their own mean: all speeds, all radii, spindle, bare and steel."""
    drawn, axes = charts.figure(12.0, 8.6, 2, 3, polar=True)
    named = {"spindle": all_.ceramic, "bare bearing": alone.ceramic, "spindle, steel": all_.steel}
    first = {
        name: by_seed(found.items())[SEEDS[0]] if found else {}
        for name, found in named.items()
    }  # fmt: skip

    def draw(ax, circles, title):
        lines = {f"{name} ({c.mean:.1f} dB)": list(c.levels - c.mean) for name, c in circles.items()}
        if lines:
            charts.circle(ax, ANGLES, lines, title)

    for ax, (name, by_speed) in zip(axes, first.items(), strict=False):
        draw(ax, {f"{rpm:,} r/min": Circle(result) for rpm, result in by_speed.items()}, name)
    for ax, name in zip(axes[3:], (*named,)[:2], strict=False):
        if WHOLE in first[name]:
            result = first[name][WHOLE]
            draw(ax, {f"r {r} mm": Circle(result, r) for r in RADII}, f"{name}, 18,000 r/min, over r")
    result = first["spindle"][WHOLE]
    draw(axes[5], {f"l {x} mm": Circle(result, R, x) for x in PLACES}, "spindle, 18,000 r/min, over l")
    charts.save(drawn, output.images / f"{page_name}.png")
