"""The picture of an identification: ticks that can be read off, and the unit of the levels."""

import math
from dataclasses import replace

import pytest

from fmu_bearing.identification.data import Datum
from fmu_bearing.identification.picture import identified_picture
from fmu_bearing.identification.quantities import parse_quantity
from fmu_bearing.identification.result import Compared
from tests.identification.test_files import TEXT, found_in
from tests.marks import heavy_but


def drawn(ratio, deviation, quantities):
    """Axes of the picture, with one value that is so many times its start."""
    key = "imperfections.unbalance_um"
    (start,) = found_in(TEXT, {key: 1.0}).estimates
    found = found_in(TEXT, {key: ratio * start.free.start})
    compared = tuple(
        Compared(Datum(parse_quantity(text), "P", (1.0, 0.0, 0.0), (), 50.0 + k, 1.0), 48.0, 50.5, 0.5)
        for k, text in enumerate(quantities)
    )
    estimates = tuple(replace(one, std=deviation) for one in found.estimates)
    figure = identified_picture(replace(found, compared=compared, estimates=estimates))
    figure.draw_without_rendering()
    return figure.axes


@pytest.mark.parametrize("ratio", [1.0, 1.05, 1.4, 0.3, 4.0, 20.0])
@pytest.mark.parametrize("deviation", heavy_but([0.005, 0.02, 0.2, 1.0, 3.0], 2))
def test_the_axis_of_values_has_ticks_to_read_off(ratio, deviation):
    _, ax = drawn(ratio, deviation, ["leq"])
    low, high = ax.get_xlim()
    inside = [place for place in ax.get_xticks() if low <= place <= high]
    texts = [
        text
        for text, place in zip(ax.get_xticklabels(), ax.get_xticks(), strict=True)
        if low <= place <= high
    ]
    assert 3 <= len(inside) <= 12
    boxes = [text.get_window_extent() for text in texts]
    assert all(a.x1 < b.x0 for a, b in zip(boxes, boxes[1:], strict=False))
    assert all(math.isclose(float(text.get_text()), place) for text, place in zip(texts, inside, strict=True))


@pytest.mark.parametrize(
    ("quantities", "unit"),
    [(["leq_a"], "dB(A)"), (["leq", "line[f_r]"], "dB"), (["leq_a", "line[f_r]"], "dB, dB(A)")],
)
def test_weighted_levels_say_so(quantities, unit):
    ax, _ = drawn(1.1, 0.1, quantities)
    assert (ax.get_xlabel(), ax.get_ylabel()) == (f"measured, {unit}", f"computed, {unit}")
