"""The Campbell diagram as a chart, and the tables of modes and crossings."""

from typing import Any

import numpy as np

from fmu_bearing.modal.campbell.diagram import Branch, Crossing
from fmu_bearing.modal.campbell.diagram_style import (
    DASHES,
    UNSTABLE,
    WIDTHS,
    Content,
    colour,
    content,
    counted,
    dot_area,
    end_of,
    level_band,
    names_beside,
    quality_words,
    runs,
)
from fmu_bearing.modal.campbell.over_speed import Campbell
from fmu_bearing.modal.modes.mode import MARGIN, Mode
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Chart, Table, small
from fmu_bearing.results.base import table

KEY = "campbell"
_HEIGHT, _TOP, _BOTTOM, _RIGHT = 580, 40, 56, 178  # px: figure, and the margins of its axes
_NAME = 15.0  # px between the middles of names
_LEAST = 0.05  # of the kinetic energy: smaller shares are left out
_MOST = 4  # shares named
_LONG = 30  # rows of an open table


def campbell_chart(chart: Campbell) -> Chart:
    """Return the diagram; the pointer shows what is under it, and points have their branch and speed."""
    shown = content(chart)
    drawn = look.figure(
        height=_HEIGHT, margin={"l": 66, "r": _RIGHT, "t": _TOP, "b": _BOTTOM}, showlegend=False,
    )  # fmt: skip
    for line, curve, dark in shown.lines:
        drawn.add_scatter(
            x=small(shown.speeds), y=small(curve), mode="lines", meta={"part": "line"},
            name=f"{line.name} ({line.source})", opacity=0.3 + 0.6 * dark,
            line={"color": look.colour("grey"), "width": 1},
            hovertemplate="%{x:,.0f} r/min, %{y:,.0f} Hz<extra>%{fullData.name}</extra>",
        )  # fmt: skip
    for k, branch in enumerate(chart.branches):
        _draw_branch(drawn, branch, k)
    _draw_crossings(drawn, chart, shown)
    texts = _draw_operation(drawn, chart, shown) + _names(chart, shown.highest)
    shapes = []
    band = level_band(chart)
    if band is not None:
        shapes.append({
            "type": "rect", "layer": "below", "xref": "paper", "x0": 0, "x1": 1, "y0": band[0], "y1": band[1],
            "fillcolor": look.faint("inner", 0.06), "line": {"width": 0},
        })  # fmt: skip
    drawn.update_layout(
        xaxis=look.axis("speed, r/min", range=shown.speeds[[0, -1]].tolist(), tickformat=",.0f"),
        yaxis=look.axis("frequency, Hz", range=[0.0, shown.highest], tickformat=",.0f"),
        annotations=texts, shapes=shapes, meta={"narrow": {"annotations": []}},
    )  # fmt: skip
    return Chart(
        KEY, "Natural frequencies over speed, and what excites them", drawn,
        f"Frequencies of {len(chart.branches)} modes over the speed, {len(shown.lines)} lines of "
        f"excitation, {len(shown.crossings)} crossings. {chart.verdict()}",
        note=_note(chart),
    )  # fmt: skip


def _note(diagram: Campbell) -> str:
    text = (
        "Solid: forward; dashed: backward; dotted: no direction. The thinner a branch, the less it is damped "
        "(limits at 0.2, 1, 3 and 10 %). Dots: speeds at which a line can excite the mode, larger for a "
        "larger Q. The bar is the operating speed, the ring the nearest crossing"
    )
    if any((branch.damping < MARGIN).any() for branch in diagram.branches):
        text += ". Red: a damping ratio below 0.2 %, at the limit of stability"
    if diagram.scene.imperfections is None:
        text += ". The scene has no imperfections, so the lines are the lowest that its parts could make"
    band = level_band(diagram)
    if band is not None:
        text += f". Shaded: {band[0]:g} Hz to {1e-3 * band[1]:g} kHz, the band of the sound levels"
    return text + ". Drag to zoom, double-click to see all."


def _draw_branch(drawn: Any, branch: Branch, k: int) -> None:
    for run in runs(branch):
        common: dict[str, Any] = {
            "x": small(run.rpm), "y": small(run.frequency), "mode": "lines", "hoverinfo": "skip",
        }  # fmt: skip
        if run.weak == 0:
            drawn.add_scatter(
                **common, meta={"part": "unstable"}, opacity=0.4, line={"color": UNSTABLE, "width": 9}
            )
        drawn.add_scatter(
            **common, name=branch.label, meta={"part": "branch", "branch": k},
            line={"color": colour(branch.name), "width": 1.25 * WIDTHS[run.weak],
                  "dash": DASHES[branch.direction]},
        )  # fmt: skip
    drawn.add_scatter(
        x=small(np.abs(branch.rpm)), y=small(branch.frequency), mode="markers", name=branch.label,
        meta={"part": "points", "branch": k}, customdata=[[k, i] for i in range(branch.rpm.size)],
        text=[_mode_words(mode) for mode in branch.modes], marker={"color": colour(branch.name), "size": 5},
        hovertemplate="%{text}<br>at %{x:,.0f} r/min<extra></extra>",
    )  # fmt: skip


def _mode_words(mode: Mode) -> str:
    return (
        f"<b>{mode.label}</b><br>{mode.frequency:,.1f} Hz, damping ratio {mode.damping:.4f}"
        f"<br>{moving(mode.participation)}"
    )


def moving(shares: dict[str, float]) -> str:
    """Shares of the kinetic energy in words, the largest first."""
    largest = [(name, share) for name, share in shares.items() if share >= _LEAST][:_MOST]
    return ", ".join(f"{100.0 * share:.0f} % {name}" for name, share in largest)


def crossing_words(one: Crossing) -> str:
    """Return what meets what, where."""
    words = (
        f"<b>{one.line.name} ({one.line.source}) meets {one.branch.label}</b>"
        f"<br>{abs(one.rpm):,.0f} r/min, {one.frequency:,.0f} Hz, damping ratio {one.damping:.4f}, "
        f"Q {quality_words(one.quality)}"
    )
    return words if one.velocity > 0.0 else f"{words}<br>not in the scene"


def _draw_crossings(drawn: Any, diagram: Campbell, shown: Content) -> None:
    places = {id(branch): k for k, branch in enumerate(diagram.branches)}
    ordered, near = shown.crossings, shown.near
    if near is not None:
        drawn.add_scatter(
            x=[abs(near.rpm)], y=[near.frequency], mode="markers", meta={"part": "nearest"}, hoverinfo="skip",
            marker={"symbol": "circle-open", "size": 20, "color": "#000000", "line": {"width": 2}},
        )  # fmt: skip
    tints = [colour(one.branch.name) for one in ordered]
    drawn.add_scatter(
        x=[abs(one.rpm) for one in ordered], y=[one.frequency for one in ordered], mode="markers",
        name="crossings", meta={"part": "crossings"},
        customdata=[
            [places[id(one.branch)], int(np.argmin(np.abs(np.abs(one.branch.rpm) - abs(one.rpm))))]
            for one in ordered
        ],
        text=[crossing_words(one) for one in ordered],
        marker={
            # diameter (px) of an area (pt2)
            "size": [1.33 * dot_area(one.quality) ** 0.5 for one in ordered],
            "symbol": ["circle" if one.velocity > 0.0 else "circle-open" for one in ordered],
            "color": tints, "opacity": 1.0, "line": {"width": 1, "color": "rgba(255,255,255,0.8)"},
        },
        hovertemplate="%{text}<extra></extra>",
    )  # fmt: skip


def _draw_operation(drawn: Any, diagram: Campbell, shown: Content) -> list[dict[str, Any]]:
    """Draw the bar at the operating speed; return its text."""
    if shown.operation is None:
        return []
    drawn.add_scatter(
        x=[shown.operation] * 2, y=[0.0, 1.5 * diagram.highest], mode="lines", meta={"part": "operation"},
        name="operation", line={"color": "#000000", "width": 4}, opacity=0.3, hoverinfo="skip",
    )  # fmt: skip
    own, margin = shown.words
    words = f"<b>{own}</b>" + (f": {margin}" if margin else "")
    return [{
        "text": words, "x": 0.0, "xref": "paper", "xanchor": "left", "y": 1.0, "yref": "paper",
        "yanchor": "bottom", "showarrow": False, "font": {"size": 12},
    }]  # fmt: skip


def _names(diagram: Campbell, highest: float) -> list[dict[str, Any]]:
    """Names of the branches beside the axes, apart from each other, in the order of their ends."""
    ends = [end for end in map(end_of, diagram.branches) if end.frequency <= highest]
    return [
        {
            "text": words, "x": 1.0, "xref": "paper", "xanchor": "left", "xshift": 6,
            "y": place / highest, "yref": "paper", "yanchor": "middle", "showarrow": False,
            "font": {"size": 12, "color": group[0].tint},
        }
        for place, words, group in names_beside(ends, highest, _HEIGHT - _TOP - _BOTTOM, _NAME)
    ]  # fmt: skip


def mode_table(point: Modes, highest: float, words: str = "") -> Table:
    """Return the modes at one operating point, each with its remark."""
    return Table(
        f"Modes at {abs(point.rpm):,.0f} r/min{words}", *table(Mode, point.records(highest)),
        note=f"Up to {1e-3 * highest:g} kHz, without neutral and overdamped motions. Balls that move alone "
        "show as no peak.",
    )  # fmt: skip


def crossing_table(diagram: Campbell, folded: bool | None = None) -> Table | None:
    """Return the crossings by their distance from the operating speed; None where there is none.

    ``folded``: whether it opens on request only; default: where it is long.
    """
    own, crossings = abs(diagram.scene.operation.speed_rpm), counted(diagram)
    if not crossings:
        return None
    if own > 0.0:
        crossings = sorted(crossings, key=lambda one: abs(np.log(abs(one.rpm) / own)))
    columns, cells = table(Crossing, crossings)
    apart = [f"{100.0 * (abs(one.rpm) / own - 1.0):+.1f}" if own > 0.0 else "" for one in crossings]
    return Table(
        "Crossings, the nearest to operation first", ["from operation, %", *columns],
        [[distance, *row] for distance, row in zip(apart, cells, strict=True)],
        note="Velocity: amplitude of the surface times angular frequency times Q, a number that ranks, not "
        "one to be measured. Crossings within 20 dB of the largest.",
        folded=len(cells) > _LONG if folded is None else folded,
    )  # fmt: skip
