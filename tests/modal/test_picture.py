"""What the picture of a Campbell diagram holds, and that its names can be read."""

import dataclasses
import math

import numpy as np
import pytest

from fmu_bearing import campbell
from fmu_bearing.modal.campbell.diagram_picture import _DASHES, _put, spaced
from fmu_bearing.modal.campbell.diagram_style import (
    WIDTHS,
    colour,
    counted,
    dot_area,
    drawn_lines,
    runs,
    top,
    width_class,
)
from fmu_bearing.modal.modes.mode import MARGIN
from fmu_bearing.results.picture_parts import single

SPEEDS = np.linspace(4_000, 28_000, 7)


@pytest.fixture(scope="module")
def spindle(gate):
    return campbell(gate("7003C-spindle"), SPEEDS)


@pytest.fixture(scope="module")
def ceramic(gate):
    """Rings that bend, many modes, one of them unstable at the end."""
    return campbell(gate("7009C-full-ceramic"), np.linspace(3_000, 25_000, 6))


def parts(figure, gid):
    (ax,) = figure.axes
    return [part for part in (*ax.lines, *ax.collections, *ax.patches, *ax.texts) if part.get_gid() == gid]


@pytest.mark.parametrize("which", ["spindle", "ceramic"])
def test_every_branch_in_range_is_drawn(which, request):
    found = request.getfixturevalue(which)
    highest = top(found, counted(found))
    figure = found.picture()
    for k, branch in enumerate(found.branches):
        drawn = parts(figure, f"branch-{k}")
        assert bool(drawn) == (branch.frequency.min() < highest), branch.label
        if drawn:
            x = np.concatenate([line.get_xdata() for line in drawn])
            assert (x.min(), x.max()) == pytest.approx((branch.rpm.min(), branch.rpm.max()))
            y = np.concatenate([line.get_ydata() for line in drawn])
            assert np.interp(branch.rpm, *np.unique([x, y], axis=1)) == pytest.approx(branch.frequency)


def test_width_tells_damping_and_dashes_the_direction(ceramic):
    figure = ceramic.picture()
    seen = set()
    for k, branch in enumerate(ceramic.branches):
        for line in parts(figure, f"branch-{k}"):
            middle = float(np.median(line.get_xdata()))
            damping = float(np.interp(middle, branch.rpm, branch.damping))
            seen.add((damping, line.get_linewidth()))
            dash = line.get_linestyle()
            assert (dash == "-") == (branch.direction == "forward")
            assert line.get_color() == colour(branch.name)
            (_, pattern) = line._unscaled_dash_pattern
            wanted = _DASHES[branch.direction]
            assert pattern == (None if wanted == "-" else wanted[1])
    dampings, widths = np.array(sorted(seen)).T
    # between computed speeds curves of damping and straight lines differ, so neighbours may swap
    assert len(set(widths)) >= 4 and np.corrcoef(np.argsort(np.argsort(dampings)), widths)[0, 1] > 0.85
    assert widths[dampings < MARGIN].size and (widths[dampings < 0.5 * MARGIN] == min(WIDTHS)).all()


def test_width_classes_rise_with_damping():
    classes = [width_class(zeta) for zeta in (-0.02, 0.0019, 0.005, 0.02, 0.05, 0.2)]
    assert classes == [0, 0, 1, 2, 3, 4] and list(WIDTHS) == sorted(WIDTHS)


def test_runs_cover_a_branch_without_gaps(ceramic):
    for branch in ceramic.branches:
        pieces = list(runs(branch))
        for one, other in zip(pieces, pieces[1:], strict=False):
            assert one.rpm[-1] == other.rpm[0] and one.weak != other.weak
        assert (pieces[0].rpm[0], pieces[-1].rpm[-1]) == (branch.rpm[0], branch.rpm[-1])


def test_what_may_whirl_is_marked(spindle, ceramic):
    assert not parts(spindle.picture(), "unstable")
    marked = parts(ceramic.picture(), "unstable")
    weak = [branch for branch in ceramic.branches if (branch.damping < MARGIN).any()]
    assert weak and {branch.label for branch in weak} == {"inner tilt forward"}
    assert marked[0].get_xdata().max() == weak[0].rpm.max()
    (words,) = [text.get_text() for text in ceramic.picture().texts if text.get_gid() == "verdict"]
    assert "inner tilt forward" in words and words.startswith("Nearest: ")


@pytest.mark.parametrize(("which", "least"), [("spindle", 2), ("ceramic", 10)])
def test_dots_are_the_crossings_sized_by_their_sharpness(which, least, request):
    found = request.getfixturevalue(which)
    (dots,) = parts(found.picture(), "crossings")
    wanted = sorted((one.rpm, one.frequency, dot_area(one.quality)) for one in found.crossings(True))
    places = np.asarray(dots.get_offsets())
    assert len(wanted) >= least
    assert np.array(sorted(zip(*places.T, dots.get_sizes(), strict=True))) == pytest.approx(np.array(wanted))
    by_quality = sorted(found.crossings(True), key=lambda one: one.quality)
    assert dot_area(by_quality[0].quality) < dot_area(by_quality[-1].quality)
    assert math.isfinite(dot_area(math.inf))


def test_lines_are_those_that_meet_a_mode(spindle):
    figure = spindle.picture()
    names = {line.get_gid().removeprefix("line-") for line in figure.axes[0].lines
             if (line.get_gid() or "").startswith("line-")}  # fmt: skip
    assert names == {one.line.name for one in spindle.crossings(in_scene=True)}
    assert names < {line.name for line in spindle.lines}


def test_a_scene_without_imperfections_shows_the_lowest_lines_faintly(gate):
    scene = gate("7003C-bare").model_copy(update={"imperfections": None})
    found = campbell(scene, SPEEDS[::2])
    crossings = counted(found)
    assert crossings and not any(one.velocity for one in crossings)
    assert set(drawn_lines(crossings)) <= {
        "f_r", "f_c", "f_i", "f_i + f_r", "f_i - f_r", "f_o", "2 f_i", "2 f_i + f_r", "2 f_i - f_r", "2 f_o",
        "2 f_b", "2 f_b + f_c", "2 f_b - f_c",
    }  # fmt: skip
    figure = found.picture()
    (dots,) = parts(figure, "crossings")
    assert (np.asarray(dots.get_facecolors())[:, :3] == 1.0).all()
    assert not parts(figure, "nearest")


def test_the_bar_stands_at_the_operating_speed_and_tells_the_margin(spindle):
    figure = spindle.picture()
    (bar,) = parts(figure, "operation")
    assert bar.get_x() + 0.5 * bar.get_width() == pytest.approx(20_000.0)
    (ring,) = parts(figure, "nearest")
    near = spindle.nearest()
    assert np.asarray(ring.get_offsets())[0] == pytest.approx([near.rpm, near.frequency])
    (words,) = parts(figure, "margin")
    share = 100.0 * (near.rpm / 20_000.0 - 1.0)
    assert f"{share:+.1f} % to {near.line.name} with {near.branch.name}" in words.get_text()
    away = dataclasses.replace(spindle, scene=spindle.scene.replace({"operation.speed_rpm": 90_000.0}))
    assert not parts(away.picture(), "operation")


def test_the_band_of_the_sound_is_shaded(spindle):
    (band,) = parts(spindle.picture(), "band")
    assert (band.get_y(), band.get_y() + band.get_height()) == (20.0, 20_000.0)
    mute = dataclasses.replace(spindle, scene=spindle.scene.model_copy(update={"sound": None}))
    assert not parts(mute.picture(), "band")


@pytest.mark.parametrize("which", ["spindle", "ceramic"])
def test_names_do_not_overlap_and_stay_on_the_paper(which, request):
    figure = request.getfixturevalue(which).picture()
    renderer = figure.canvas.get_renderer()
    paper = figure.bbox
    texts = [*parts(figure, "name"), *parts(figure, "margin")]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts]
    assert len(boxes) >= 6
    for k, (name, box) in enumerate(boxes):
        assert paper.x0 <= box.x0 and box.x1 <= paper.x1 and paper.y0 <= box.y0 and box.y1 <= paper.y1, name
        for other, that in boxes[:k]:
            assert not box.overlaps(that), (name, other)
    (words,) = [text for text in figure.texts if text.get_gid() == "verdict"]
    (legend,) = figure.legends
    box, key = words.get_window_extent(renderer), legend.get_window_extent(renderer)
    assert not box.overlaps(key) and paper.y0 <= box.y0 and box.x1 <= paper.x1 and paper.y0 <= key.y0
    # slanted names keep their line spacing
    slanted = sorted(text.get_position()[0] for text in parts(figure, "line-name"))
    points = (
        72.0 / figure.dpi * np.diff(figure.axes[0].transData.transform([(x, 0.0) for x in slanted])[:, 0])
    )
    assert (points * math.sin(math.radians(50.0)) >= 8.0).all()


def test_every_drawn_branch_has_a_name(ceramic):
    figure = ceramic.picture()
    highest = top(ceramic, counted(ceramic))
    names = [text.get_text() for text in parts(figure, "name")]
    for branch in ceramic.branches:
        if branch.frequency.min() < highest:
            assert any(name.startswith(branch.name) for name in names), branch.label


def test_spaced_moves_what_is_too_close_and_no_more():
    places = spaced(np.array([0.0, 10.0, 11.0, 30.0]), 5.0, 0.0, 100.0)
    assert places == pytest.approx([0.0, 8.0, 13.0, 30.0])
    crowded = spaced(np.full(5, 99.0), 5.0, 0.0, 100.0)
    assert crowded == pytest.approx([80.0, 85.0, 90.0, 95.0, 100.0])
    assert spaced(np.array([]), 5.0, 0.0, 100.0).size == 0


def test_a_shaft_that_turns_backwards_has_the_same_picture(gate, spindle):
    found = campbell(gate("7003C-spindle").replace({"operation.speed_rpm": -20_000.0}), -SPEEDS)
    one, other = (
        sorted(tuple(place) for place in np.asarray(parts(each.picture(), "crossings")[0].get_offsets()))
        for each in (spindle, found)
    )
    # the mirrored state comes from its own search
    assert np.array(one) == pytest.approx(np.array(other), rel=1e-3)


def test_a_text_is_set_beside_the_edge_of_a_dot_too():
    """The middle of the dot is beside the first place, its edge is not; a point of a curve is less bad."""
    figure, ax = single((6.0, 4.0))
    figure.set_layout_engine("none")
    ax.set_xlim(0.0, 1.0)
    ax.set_ylim(0.0, 1.0)
    text = ax.annotate("operation", (0.5, 0.0), xytext=(0.0, 0.0), textcoords="offset points", va="center")
    first, second = (5.0, 40.0), (5.0, 120.0)
    text.set_position(first)
    figure.draw_without_rendering()
    box = text.get_window_extent()
    x, y = ax.transData.inverted().transform((0.5 * (box.x0 + box.x1), box.y1 + 6.0))
    ax.scatter([x], [y], s=dot_area(100.0), gid="crossings")
    text.set_position(second)
    box = text.get_window_extent()
    ax.plot(*ax.transData.inverted().transform((0.5 * (box.x0 + box.x1), box.y0 + 3.0)), zorder=3)
    _put(ax, text, [first, second])
    assert text.get_position() == second


def test_all_remarks_are_on_the_picture(ceramic, spindle):
    for found in (ceramic, spindle):
        figure = found.picture()
        figure.draw_without_rendering()
        (words,) = [text for text in figure.texts if text.get_gid() == "verdict"]
        assert words.get_window_extent().y0 >= 0.0
