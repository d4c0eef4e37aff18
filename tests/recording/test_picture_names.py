"""Names, dashes, units and dashes for silence in pictures."""

import itertools
import math

import numpy as np
import pytest
from matplotlib.colors import to_hex

from fmu_bearing.acoustics.analysis.lines import Line, kinematic_lines, nearest_line, strongest_lines
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.recording.measurements import pictures, tables
from fmu_bearing.recording.measurements.measure import Round, Sweep
from fmu_bearing.recording.measurements.sound_analysis import SoundAnalysis, _loudest
from fmu_bearing.results.levels import SILENCE
from fmu_bearing.results.picture_parts import OTHERS, coincident, free_heights, series
from fmu_bearing.results.spectra import MICROPHONE, Spectrum

KINEMATIC = KinematicFrequencies(333.3, 140.0, 1000.0, 2320.0, 1680.0)
FREQUENCY = np.arange(0.0, 10_000.0, 5.0)


def boxes(figure, gid):
    """Boxes (pixels) of the texts of a kind."""
    figure.draw_without_rendering()
    (ax,) = figure.axes
    return {t.get_text(): t.get_window_extent() for t in ax.texts if t.get_gid() == gid}


def overlap(one, other):
    return one.x0 < other.x1 and other.x0 < one.x1 and one.y0 < other.y1 and other.y0 < one.y1


def lined(*frequencies):
    """A spectrum with lines there, of falling level, and these lines."""
    levels = np.full(len(FREQUENCY), 10.0)
    for k, frequency in enumerate(frequencies):
        levels[round(frequency / 5.0)] = 70.0 - 3.0 * k
    return levels, strongest_lines(FREQUENCY, levels, 12, kinematic_lines(KINEMATIC, 10_000.0))


def test_lines_are_named_without_one_name_on_another():
    close = (1680.0, 1820.0, 1960.0, 1985.0, 2320.0, 2655.0, 3360.0, 5040.0)
    levels, lines = lined(*close)
    figure = pictures.spectrum_picture(FREQUENCY, {"total": levels}, KINEMATIC, lines=lines)
    named = boxes(figure, "line-name")
    assert set(named) <= {line.explanation for line in lines} and len(named) >= 7
    assert lines[0].explanation in named
    marks = boxes(figure, "mark")
    (ax,) = figure.axes
    inside = ax.get_window_extent()
    every = [*named.values(), *marks.values()]
    assert not any(overlap(a, b) for a, b in itertools.combinations(every, 2))
    assert all(box.x0 >= inside.x0 - 1.0 and box.x1 <= inside.x1 + 1.0 for box in named.values())
    assert all(box.x0 >= inside.x0 and box.x1 <= inside.x1 for box in marks.values())
    assert len(marks) >= 9  # of 15 frequencies; lines of all are drawn
    peaks = ax.transData.transform([(line.frequency, line.level) for line in lines])
    assert not any(box.contains(x, y) for box in named.values() for x, y in peaks)
    (leaders,) = (one for one in ax.collections if one.get_gid() == "line-leader")
    begun = {tuple(way.vertices[0]) for way in leaders.get_paths()}
    assert len(begun) == len(named) and begun <= {(line.frequency, line.level) for line in lines}


def test_words_at_the_end_of_the_excitation_lie_on_no_bar():
    centres = 1000.0 * 10.0 ** (0.1 * np.arange(14))
    loud = {"P": np.full(14, 60.0)}
    (ax,) = pictures.third_octave_picture(centres, loud, excitation_end={"A": 16e3, "B": 16e3}).axes
    ax.get_figure().draw_without_rendering()
    (words,) = ax.texts  # one where both end
    assert words.get_text().startswith("end of the excitation of A and B")
    assert not any(overlap(words.get_window_extent(), bar.get_window_extent()) for bar in ax.patches)


def test_many_microphones_leave_a_spectrum_room():
    rows = {f"microphone at {k} deg": np.full(len(FREQUENCY), 40.0 + 0.1 * k) for k in range(60)}
    figure = pictures.spectrum_picture(FREQUENCY, rows)
    figure.draw_without_rendering()
    (ax,) = figure.axes
    box, page = ax.get_legend().get_window_extent(), figure.bbox
    assert box.x0 >= ax.get_window_extent().x1 and box.x1 <= page.x1 and 0.0 <= box.y0 < box.y1 <= page.y1
    assert (
        ax.get_window_extent().width > 0.5 * page.width and ax.get_window_extent().height > 0.7 * page.height
    )


def test_what_nothing_explains_has_the_nearest_line_and_its_distance():
    known = kinematic_lines(KINEMATIC, 10_000.0)
    gaps = [abs(nearest_line(f, known).frequency - f) for f in FREQUENCY]
    place = 100 + int(np.argmax(gaps[100:1000]))
    levels, (line,) = lined(FREQUENCY[place])
    assert line.name == "" and math.isnan(line.off)
    best = min(known, key=lambda one: abs(one.frequency - line.frequency))
    assert abs(line.nearest_off) == pytest.approx(abs(best.frequency - line.frequency), abs=1e-9)
    assert abs(line.nearest_off) == pytest.approx(gaps[place], abs=0.1) and gaps[place] > 10.0
    assert line.explanation == f"{line.nearest}? {line.nearest_off:+.0f} Hz"
    ((_, _, words, off),) = tables.lines_table([line])[1]
    assert words == f"none; nearest {line.nearest}" and float(off) == pytest.approx(
        line.nearest_off, abs=0.06
    )
    # without kinematics there is nothing to be near
    assert tables.lines_table([Line(100.0, 50.0)])[1] == [["100.0", "50.0", "none", ""]]


def test_labels_that_have_no_room_are_left_out():
    """Forty at one place: as many heights as there are, and the most important one lowest."""
    heights = free_heights([[50.0]] * 40, [10.0] * 40, [30.0] * 40, 10.0, 100.0)
    assert heights == [10.0 * k for k in range(1, 10)] + [None] * 31
    # beside each other there is room; on a second axis they may meet all the same
    assert free_heights([[50.0], [90.0]], [10.0] * 2, [30.0] * 2, 10.0, 100.0) == [10.0, 10.0]
    assert free_heights([[50.0, 50.0], [90.0, 60.0]], [10.0] * 2, [30.0] * 2, 10.0, 100.0) == [10.0, 20.0]


def test_more_series_than_colours_get_dashes():
    count = 4 * len(OTHERS)
    assert len({(style["color"], style["linestyle"]) for style in map(series, range(count))}) == count
    assert {series(k)["linestyle"] for k in range(len(OTHERS))} == {"-"}
    names = tuple(f"v{k}" for k in range(9))
    values = np.arange(9.0)[:, None] + np.ones((9, len(FREQUENCY)))
    (ax,) = Spectrum(names, FREQUENCY, values, ("m",) * 9).plot().axes
    drawn = [(to_hex(line.get_color()), line.get_linestyle()) for line in ax.lines]
    assert len(set(drawn)) == 9 and drawn[7] == (OTHERS[0].lower(), "--")
    over = [Round(np.zeros(1), np.zeros(1), Sized(k)) for k in range(9)]
    sweep = Sweep(np.array([0.1]), np.arange(9.0), (tuple(over),), (), ())
    lines = pictures.sweep_picture(sweep).axes[0].lines
    assert len({(line.get_color(), line.get_linestyle()) for line in lines}) == 9


class Sized:
    """A directivity with the three figures of a sweep."""

    def __init__(self, k):
        self.highest = self.dl = self.dv = float(k)
        self.da = 0.0


def test_microphones_on_one_curve_are_all_seen():
    """Each curve is narrower than the one below it, and dashed otherwise than its neighbours."""
    same = np.tile(20.0 + 10.0 * np.sin(FREQUENCY / 500.0), (4, 1))
    (ax,) = Spectrum(tuple("ABCD"), FREQUENCY, same, ("dB",) * 4, MICROPHONE).plot().axes
    widths = [line.get_linewidth() for line in ax.lines]
    assert widths == sorted(widths, reverse=True) and widths[0] >= 3.0 * widths[-1]
    assert [line.get_linestyle() for line in ax.lines] == ["-", "--", "-.", ":"]
    assert [line.get_zorder() for line in ax.lines] == [2] * 4  # later ones on top
    styles = [coincident(k, 6) for k in range(6)]
    assert len({(one["color"], one["linestyle"]) for one in styles}) == 6
    (ax,) = pictures.spectrum_picture(FREQUENCY, dict(zip("ABCD", same, strict=True))).axes
    assert [line.get_linestyle() for line in ax.lines] == ["-", "--", "-.", ":"]


@pytest.mark.parametrize(("weighting", "unit"), [("A", "dB(A)"), ("Z", "dB")])
def test_weighted_levels_say_so(weighting, unit):
    one = Round(np.linspace(0.0, 6.0, 12), np.full(12, 60.0), Sized(60), weighting)
    assert pictures.circle_picture({"r": one}, "t").axes[0].get_title() == f"t, {unit}"
    assert pictures.planes_picture({"YZ": one}).axes[0].get_title() == f"plane YZ, {unit}"
    sweep = Sweep(np.array([0.1]), np.array([0.0]), ((one,),), (), ())
    assert pictures.sweep_picture(sweep).axes[0].get_ylabel() == f"largest level, {unit}"


def test_silent_sources_are_a_dash():
    levels, quiet = lined(1680.0)[0], np.full(len(FREQUENCY), SILENCE)
    (ax,) = pictures.spectrum_picture(FREQUENCY, {"total": levels, "cage": quiet}).axes
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["total", "cage: -"]
    assert np.isnan(ax.lines[1].get_ydata()).all()
    (ax,) = pictures.third_octave_picture(
        [500.0, 1000.0], {"total": [60.0, 70.0], "cage": [SILENCE] * 2}
    ).axes
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["total", "cage: -"]
    table = tables.third_octave_table([500.0], {"total": [60.0], "cage": [SILENCE]})
    assert table[1] == [["500", "60.00", "-"]]
    found = SoundAnalysis(
        ("P",), np.array([[60.0, 55.0]]), {"cage": np.array([-99.2]), "balls": np.array([31.25])},
        FREQUENCY, {}, np.empty(0), np.empty((1, 0)), {}, [], ((0.0, 0.0, 0.0),),
    )  # fmt: skip
    assert found.rows()[1] == [["P", "60.0", "55.0", "-", "31.2"]]


def test_planes_have_one_scale_and_many_microphones_have_room():
    low, high = (Round(np.linspace(0.0, 6.0, 12), np.full(12, v), Sized(v), "A") for v in (40.0, 60.0))
    axes = pictures.planes_picture({"YZ": low, "XY": high}).axes
    assert len({ax.get_ylim() for ax in axes}) == 1 and axes[0].get_ylim() == (35.0, 65.0)
    names = tuple(f"m{k}" for k in range(60))
    levels = np.column_stack([np.arange(60.0), np.arange(60.0)])
    found = SoundAnalysis(
        names, levels, {}, FREQUENCY, {}, np.array([500.0]), np.empty((60, 1)), {}, [],
        ((0.0, 0.0, 0.0),) * 60,
    )  # fmt: skip
    shown, title = _loudest(found, {name: np.array([50.0]) for name in names})
    assert list(shown) == [f"m{k}" for k in range(52, 60)] and title == "the 8 loudest of 60 microphones"
    few = {name: np.array([50.0]) for name in names[:8]}
    assert _loudest(found, few) == (few, "")
