"""The page `Measured by others`, the page of its tables and the table of all values."""

import math
import textwrap
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from benchmarks.measured import friction, parts, stiffness
from benchmarks.measured.compared import Compared
from benchmarks.measured.findings import Finding, findings, rms
from benchmarks.measured.pictures import drawable, group
from benchmarks.measured.sources import of, sources, values
from fmu_bearing.results.table import machine, markdown

COLUMNS = (
    "source", "kind", "work", "place", "repository", "quantity", "bearing", "balls", "contact angle, deg",
    "class", "load, N", "measuring load, N", "r/min", "mm2/s", "shaft, Hz", "unit", "theirs", "theirs to",
    "ours", "ours from", "ours to", "ours over theirs", "ours less theirs", "counts", "assumed", "remark",
)  # fmt: skip

_SAID = ("", "source", "what", "values", "goal", "found")
_TEXT = tomllib.loads(Path(__file__).with_name("text.toml").read_text("utf-8"))
TITLES: dict[str, str] = _TEXT["titles"]


def all_rows(found: Mapping[str, list[Compared]]) -> Iterator[list[str]]:
    """Yield the rows of the table of all values."""
    known = sources()
    for key, rows in found.items():
        source = known[key]
        for one in rows:
            v = one.value
            remark = "balls not known" if key == "tpi" and not one.counts else v.remark
            yield [
                key, source.kind, source.work, v.place, source.repository, v.quantity, v.bearing, v.balls,
                _plain(v.angle_deg), v.grade, *map(_plain, (
                    v.load_N, v.measuring_load_N, v.speed_rpm, v.viscosity_mm2_s, v.shaft_Hz
                )), v.unit, _plain(v.published), _plain(v.published_to),
                *map(_four, (one.ours, one.low, one.high)),
                "" if one.difference else _four(one.found), _four(one.found) if one.difference else "",
                "yes" if one.counts else "no", source.assumed, remark,
            ]  # fmt: skip


def page(found: Mapping[str, list[Compared]]) -> str:
    """Return the page."""
    said = findings(found)
    sections = (_section(key, found[key]) for key in _order(said))
    return _joined([_head(found, said), *sections, _folded(_TEXT["closing"])])


def tables(found: Mapping[str, list[Compared]]) -> str:
    """Return the page of the tables: provenance and values of each source, sensitivity, what moved."""
    parts = [
        f"# Measured by others: tables\n\n{machine()}\n\n{_folded(_TEXT['tables'])}",
        *(_listed(key, found[key]) for key in _order(findings(found))),
        _sensitivity(),
        _moved(found),
    ]
    return _joined(parts)


def _order(said: Sequence[Finding]) -> list[str]:
    """Return the sources in the order of the findings, misses first."""
    return list(dict.fromkeys(one.source for one in said))


def _joined(parts: Sequence[str]) -> str:
    return "\n\n".join(part.strip() for part in parts) + "\n"


def _head(found: Mapping[str, list[Compared]], said: Sequence[Finding]) -> str:
    rows = [
        [f"**{one.status}**" if one.status == "missed" else one.status,
         f"[{TITLES[one.source].split(':')[0]}](#{_anchor(TITLES[one.source])})", one.what, str(one.count),
         one.goal, one.found]
        for one in said
    ]  # fmt: skip
    numbers = {
        "values": len(values()), "sources": len(sources()),
        "computed": sum(not math.isnan(one.ours) for every in found.values() for one in every),
        "missed": sum(one.status == "missed" for one in said),
        "goals": sum(one.status != "beside" for one in said),
    }  # fmt: skip
    head = _folded(_TEXT["head"].format(**numbers))
    return f"# Measured by others\n\n{head}\n\n{markdown(_SAID, rows)}"


def _section(key: str, rows: list[Compared]) -> str:
    """Return what a source says of the package, and its picture."""
    title = TITLES[key]
    each = f"[Values and provenance](results/measured.md#{_anchor(title)})."
    file = f"images/measured/{key}.png"
    picture = f"\n\n![{title}, ours beside theirs]({file})" if len(drawable(rows)) > 1 else ""
    return f"## {title}\n\n{_folded(_TEXT['meaning'][key])}{picture}\n\n{each}"


def _listed(key: str, rows: list[Compared]) -> str:
    """Return the tables of a source."""
    source = sources()[key]
    about = [
        ["kind", source.kind], ["work", source.work], ["read in", f"`{source.repository}`"],
        ["given", source.given], ["assumed", source.assumed],
    ]  # fmt: skip
    table = _groups(key) if key in ("nsk", "tpi") else _each(rows)
    return f"## {TITLES[key]}\n\n{markdown(('provenance', ''), about)}\n{table}{_parts(key)}"


def _parts(key: str) -> str:
    """Return what each part of the friction is worth, where a source is of friction."""
    tables = {"skf": parts.table_7210b, "tp2275": parts.table_35}
    if key not in tables:
        return ""
    head, rows = tables[key]()
    return (
        f"\n### {_TEXT['parts'][key + '_title']}\n\n{_folded(_TEXT['parts'][key])}\n\n{markdown(head, rows)}"
    )


def _groups(key: str) -> str:
    """Return the table of a maker's pairs: median and rms by conformities, angle and balls."""
    kept = stiffness.kept(key, "pair axial stiffness")
    names = [group(Compared(one, 1.0, 1.0, 1.0)) for one in kept]
    kinds = list(dict.fromkeys(names))
    rows = []
    for grooves, where in stiffness.CHOICES.items():
        ratios = stiffness.ratios(key, grooves)
        cells = []
        for name in kinds:
            some = ratios[[one == name for one in names]]
            cells.append(f"{np.median(some):.3f}, {100 * rms(some - 1.0):.1f} %")
        both = f"{np.median(ratios):.3f}, {100 * rms(ratios - 1.0):.1f} %"
        rows.append([f"{grooves[0]:g}, {grooves[1]:g}", where, *cells, both])
    head = (
        "inner, outer",
        "where",
        *(f"{name} ({names.count(name)})" for name in kinds),
        f"all ({len(kept)})",
    )
    return "Stiffness, computed over printed: median, rms.\n\n" + markdown(head, rows)


def _each(rows: Sequence[Compared]) -> str:
    """Return the table of a source's values, one by one; of many the ends."""
    shown = list(rows)
    if len(shown) > 30:
        shown = sorted(shown, key=lambda one: one.found)
        shown = [*shown[:3], *shown[-3:]]
    lines = []
    for one in shown:
        v = one.value
        condition = [v.bearing, v.grade, *(f"{x:g} {unit}" for x, unit in (
            (v.angle_deg, "deg"), (v.speed_rpm, "r/min"), (v.load_N, "N"), (v.viscosity_mm2_s, "mm2/s"),
            (v.shaft_Hz, "Hz")) if not math.isnan(x)), v.remark]  # fmt: skip
        theirs = _plain(v.published) + ("" if math.isnan(v.published_to) else f" to {v.published_to:g}")
        ours = ["", "", "not computed"] if math.isnan(one.ours) else [
            _three(one.ours), f"{_three(one.low)} to {_three(one.high)}",
            f"{one.found:+.2f}" if one.difference else f"{one.found:.3f}",
        ]  # fmt: skip
        lines.append(
            [f"{v.quantity}, {v.unit}".removesuffix(", -"), ", ".join(filter(None, condition)), theirs, *ours]
        )
    kind = "ours less theirs" if rows[0].difference else "ours over theirs"
    few = "" if len(shown) == len(rows) else f"The three least and the three largest of {len(rows)}.\n\n"
    head = ("quantity", "condition", "theirs", "ours", "range of what is assumed", kind)
    return few + markdown(head, lines)


def _sensitivity() -> str:
    at = of("tp2275")
    moves = {"as assumed": None} | friction.MOVES_35
    rows = [_line(words, moved) for words, moved in moves.items()]
    head = ("moved alone", *(f"heat, {one.speed_rpm:,.0f} r/min" for one in at),
            *(f"hybrid over steel, {one.speed_rpm:,.0f}" for one in at))  # fmt: skip
    return (
        f"## Sensitivity of heat to what is assumed\n\n{_folded(_TEXT['sensitivity'])}\n\n"
        f"{markdown(head, rows)}\n{_folded(_TEXT['sensitive'])}"
    )


def _line(words: str, moved: friction.Moved | None) -> list[str]:
    at = of("tp2275")
    heats = [f"{friction.heat_35(one, moved) / one.published:.2f}" for one in at]
    return [words, *heats, *(f"{friction.hybrid_over_steel(one, moved):.2f}" for one in at)]


def _moved(found: Mapping[str, list[Compared]]) -> str:
    """Return what moved since the values were first compared, before and after, each with its reason."""
    heat, light = found["tp2275"], found["asme"]
    (coefficient,) = found["ntn"]
    low, medium, high = (f"{one.ours:.0f}" for one in found["kyk"] if one.counts)
    now = {
        "ntn": f"{coefficient.low:.1f} to {coefficient.high:.1f}e-3",
        "kyk": f"{low}, {medium}, {high}",
        "rule": f"{np.median(stiffness.ratios('nsk', stiffness.RULE)):.2f}",
        "nsk": f"{np.median(stiffness.ratios('nsk', stiffness.CONFORMITIES)):.2f}",
        "skf": f"{np.median([one.found for one in found['skf']]):.2f}",
        "heat": ", ".join(f"{one.found:.2f}" for one in heat),
        "light": ", ".join(f"{one.ours:.2f}" for one in light),
        "exponent": f"{friction.exponent([x.value.speed_rpm for x in heat], [x.ours for x in heat]):.2f}",
    }
    rows = [[one["figure"], one["before"], now[one["now"]], one["why"]] for one in _TEXT["moved"]]
    table = markdown(("figure", "before", "now", "why"), rows)
    grown = [
        [name, *(f"{one:.2f}" for one in parts.radii_over_ellipticity(parts.fresh(name)))]
        for name in parts.FRESH
    ]
    forces = markdown(
        ("rolling force, ratio of the radii over ellipticity", "inner race", "outer race"), grown
    )
    fresh = markdown(*parts.table_fresh())
    return (
        f"## What moved\n\n{_folded(_TEXT['moving'])}\n\n{table}\n{_folded(_TEXT['radii'])}\n\n{forces}\n"
        f"{_folded(_TEXT['fresh'])}\n\n{fresh}\n{_folded(_TEXT['elsewhere'])}"
    )


def _folded(text: str) -> str:
    """Return paragraphs and lists with lines of one width; headings stay."""
    return "\n\n".join(map(_block, text.strip().split("\n\n")))


def _block(text: str) -> str:
    if text.startswith("#"):
        return text
    if text.startswith("* "):
        return "\n".join(_fold(f"* {item}", "  ") for item in text[2:].split("\n* "))
    return _fold(text)


def _fold(text: str, indent: str = "") -> str:
    flat = " ".join(text.split())
    return textwrap.fill(flat, 109, break_long_words=False, break_on_hyphens=False, subsequent_indent=indent)


def _anchor(title: str) -> str:
    kept = "".join(sign for sign in title.lower() if sign.isalnum() or sign in " -_")
    return "-".join(kept.split())


def _plain(value: float) -> str:
    return "" if math.isnan(value) else f"{value:g}"


def _four(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.4g}"


def _three(value: float) -> str:
    return f"{value:.3g}" if abs(value) < 1000.0 else f"{value:.0f}"
