"""Names, sources and orders of lines, against sums of the frequencies written out."""

import numpy as np
import pytest

from fmu_bearing.acoustics.analysis.origins import (
    BALL_FORM,
    BALL_SIZES,
    INNER,
    OUTER,
    bearing_origins,
)
from fmu_bearing.acoustics.analysis.spectrum import kinematic_frequencies

#: Of a 7003C at 3600 r/min: f_r = 60 Hz.
RATES = kinematic_frequencies(2.0 * np.pi * 60.0, 12, 4.5e-3, 26e-3, np.radians(15.0))


def named(lines):
    return {one.name: one for one in lines}


def test_orders_and_sources_of_one_bearing():
    found = named(bearing_origins(RATES, 20.0))
    r, c, b, i, o = RATES
    for name, hertz, source, terms in (
        ("f_c", c, BALL_SIZES, 1),
        ("3 f_c", 3 * c, BALL_SIZES, 3),
        ("f_o", o, OUTER, 1),
        ("3 f_o - 2 f_r", 3 * o - 2 * r, OUTER, 5),
        ("2 f_i + f_r", 2 * i + r, INNER, 3),
        ("2 f_b - f_c", 2 * b - c, BALL_FORM, 3),
        ("2 f_b", 2 * b, BALL_FORM, 2),
    ):
        assert found[name].order == pytest.approx(hertz / r, rel=1e-12), name
        assert (found[name].source, found[name].bearing, found[name].terms) == (source, 1, terms)
    assert "12 f_c" not in found, "it is f_o"
    orders = [one.order for one in bearing_origins(RATES, 20.0)]
    assert orders == sorted(orders)
    assert 0.0 < orders[0] < orders[-1] <= 20.0


def test_a_shaft_at_rest_has_no_orders():
    with pytest.raises(ValueError, match="f_r = 0 Hz"):
        bearing_origins(kinematic_frequencies(0.0, 12, 4.5e-3, 26e-3, 0.26), 20.0)


def test_a_line_knows_the_order_of_its_waves():
    found = named(bearing_origins(RATES, 60.0, sidebands=4, ball_sidebands=4))
    for name, wave, beside in (
        ("f_i - f_r", 11, -1), ("2 f_i + 4 f_r", 28, 4), ("2 f_o", 24, 0), ("2 f_o - f_r", 24, -1),
        ("5 f_b + 3 f_c", 5, 3), ("2 f_c", 0, 0),
    ):  # fmt: skip
        assert (found[name].wave, found[name].beside) == (wave, beside), name
    # of the inner race: n waves turn with the shaft, and balls pass with f_c
    for one in (one for one in found.values() if one.source == INNER):
        passes = one.wave - one.beside  # whole balls
        assert one.order * RATES.f_r == pytest.approx(one.wave * RATES.f_r - passes * RATES.f_c, rel=1e-12)
    assert "2 f_b + 2 f_c" not in named(bearing_origins(RATES, 60.0)), "a rigid ring takes no lobes"
