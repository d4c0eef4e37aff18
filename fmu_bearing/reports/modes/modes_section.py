"""Modes: the section of a report, and a page of its own with moving shapes."""

import os
import pathlib

import numpy as np

from fmu_bearing.engine.constants import RPM
from fmu_bearing.files import check_file, write_whole
from fmu_bearing.modal.campbell.over_speed import Campbell, campbell
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.modal.modes.points import modes
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.modes.campbell_chart import campbell_chart, crossing_table, mode_table
from fmu_bearing.reports.modes.moving_shapes import moving_shapes
from fmu_bearing.reports.page.blocks import Absent, Block, Section, Table, Words
from fmu_bearing.reports.page.render import render
from fmu_bearing.results.base import table
from fmu_bearing.scene import Scene
from fmu_bearing.scene.words import designation_words

HIGHEST = 20e3  # Hz: modes that the section lists
#: Speeds of its diagram over the shaft's own: fewer than on a page of its own, closer together near it.
_SHARES = (0.1, 0.3, 0.5, 0.7, 0.85, 1.0, 1.15, 1.3, 1.4)
_STILL = 1.0  # r/min: slower, the shaft counts as at rest
_LINEAR = (
    "Fidelity full linearised about its steady state: perfect surfaces, no cage. A run at one speed "
    "has its peaks at the lines, not at the modes; a run-up passes both."
)


def section(subject: Subject) -> Section:
    """Return the section of a report, at the mean speed of its run.

    Raises
    ------
    Absent
        Without a scene, or where there is no equilibrium at that speed.
    """
    scene, rpm = subject.at_speed, subject.speed / RPM
    try:
        blocks = _at_rest(scene) if abs(rpm) < _STILL else _over_speed(scene, rpm)
    except ValueError as problem:
        raise Absent(str(problem)) from None
    return Section("modes", "Modes", [*blocks, Words(_LINEAR, "note")])


def _at_rest(scene: Scene) -> list[Block]:
    """Return modes at standstill: contacts stick there, until they slide."""
    stuck, sliding = modes(scene), modes(scene, friction=False)
    return [
        Words("No Campbell diagram: the shaft does not turn, so nothing excites a mode."),
        *_said(stuck.cautions()),
        mode_table(stuck, HIGHEST, ", contacts stick"),
        mode_table(sliding, HIGHEST, ", without friction"),
    ]


def _over_speed(scene: Scene, rpm: float) -> list[Block]:
    try:
        diagram = campbell(scene, [share * rpm for share in _SHARES], highest=HIGHEST)
    except ValueError as problem:
        point = modes(scene)
        reason = Words(f"No Campbell diagram: {problem}.", "absent")
        return [reason, *_said(point.cautions()), mode_table(point, HIGHEST)]
    # the shaft's own speed may be one of those without equilibrium
    point = nearest_point(diagram, rpm)
    blocks: list[Block] = [Words(diagram.verdict()), *_said(_cautions(diagram, point))]
    blocks += [campbell_chart(diagram), mode_table(point, HIGHEST)]
    crossings = crossing_table(diagram, folded=True)
    return blocks if crossings is None else [*blocks, crossings]


def nearest_point(diagram: Campbell, rpm: float) -> Modes:
    """Return the modes at the computed speed nearest to one (r/min)."""
    return min(diagram.points, key=lambda point: abs(abs(point.rpm) - abs(rpm)))


def _cautions(diagram: Campbell, point: Modes) -> list[str]:
    """Return what limits modes at the operating point, then over speed; the note below names the cage."""
    own = [words for words in point.cautions() if not words.startswith("the cage")]
    return own + diagram.cautions()


def _said(cautions: list[str]) -> list[Words]:
    return [Words(f"{words[0].upper()}{words[1:]}.", "warning") for words in cautions]


def modes_page(chart: Campbell, path: str | os.PathLike[str], point: Modes | None = None) -> pathlib.Path:
    """Write a page about natural motions that needs a browser and no network, and return its path.

    Beside the Campbell diagram the chosen mode moves: a click on a branch or a crossing chooses one.

    Parameters
    ----------
    found : Campbell
    path : path
        HTML file; its folder is made.
    point : Modes, optional
        Whose table is shown; default: the computed speed nearest to the operating speed.

    Raises
    ------
    MissingExtra
        Without the extra ``report`` (plotly, jinja2).
    OSError
        When the page cannot be written.

    Examples
    --------
    >>> from fmu_bearing import campbell
    >>> from fmu_bearing.reports.modes.modes_section import modes_page
    >>> found = campbell("examples/scenes/7003C-spindle.toml", [10e3, 15e3, 20e3, 25e3])
    >>> modes_page(found, "modes.html").name
    'modes.html'
    """
    target = check_file(path, ".html", "a page")
    scene, own = chart.scene, chart.scene.operation.speed_rpm
    point = point or nearest_point(chart, own)
    diagram: list[Block] = [campbell_chart(chart), moving_shapes(chart)]
    tables: list[Block] = [mode_table(point, chart.highest), *_apart(point, chart.highest)]
    crossings = crossing_table(chart)
    sections = [
        Section(
            "diagram", "Campbell diagram",
            [*diagram, Words("Click a branch or a crossing, and its mode moves beside the diagram.", "note")],
        ),
        Section("modes", "Modes", [*tables, Words(_LINEAR, "note")]),
        Section("crossings", "Crossings", [crossings])
        if crossings is not None
        else Section("crossings", "Crossings", (), "no line meets a mode at these speeds"),
    ]  # fmt: skip
    speeds = np.abs(chart.rpm)
    text = render(
        scene.name, f"{designation_words(scene)}, {speeds.min():,.0f} to {speeds.max():,.0f} r/min",
        f"scene {scene.name}, {len(chart.points)} speeds", sections, _tiles(chart, point), [chart.verdict()],
        [f"{words[0].upper()}{words[1:]}." for words in _cautions(chart, point)], kind="Modes of a bearing",
    )  # fmt: skip
    write_whole(target, text.encode("utf-8"))
    return target


def _apart(point: Modes, highest: float) -> list[Table]:
    """Return the table of motions that do not ring."""
    rows = point.records(highest, apart=True)
    words = "Neutral and overdamped motions: they make no peak"
    heads = ("what moves most", "whirl", "Hz", "damping, %")
    return [Table(words, *table(Mode, rows, heads), folded=True)] if rows else []


def _tiles(diagram: Campbell, point: Modes) -> list[dict[str, object]]:
    """Return the figures at the top: speed, number of modes, least damping, nearest crossing."""
    own = abs(diagram.scene.operation.speed_rpm)
    tiles: list[dict[str, object]] = [
        {"label": "operating speed", "text": f"{own:,.0f}", "unit": "r/min"},
        {"label": f"modes of rings below {1e-3 * diagram.highest:g} kHz", "text": str(len(diagram.branches)),
         "unit": ""},
    ]  # fmt: skip
    rings = [mode for mode in point.modes if mode.frequency <= diagram.highest and mode.ring_share > 0.5]
    if rings:
        least = min(rings, key=lambda mode: mode.damping)
        text = f"{100.0 * least.damping:.2g}"
        tiles.append({"label": f"least damping ratio, {least.label}", "text": text, "unit": "%"})
    near = diagram.nearest()
    if near is not None:
        text = f"{100.0 * (abs(near.rpm) / own - 1.0):+.1f}"
        tiles.append({"label": f"to {near.line.name} with {near.branch.label}", "text": text, "unit": "%"})
    return tiles
