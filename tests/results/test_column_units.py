"""Units in titles of columns: g is that of an acceleration, and of a mass where the title names one."""

import numpy as np
import pytest

from fmu_bearing.results.column_units import Title, unit_of_title


@pytest.mark.parametrize(
    ("title", "value", "si"),
    [
        ("acceleration (g)", 9.80665, "m/s2"),
        ("Drive end [g]", 9.80665, "m/s2"),
        ("mass (g)", 1e-3, "kg"),
        ("Weight of oil [g]", 1e-3, "kg"),
        ("acceleration (mm/s2)", 1e-3, "m/s2"),
    ],
)
def test_a_value_of_one_in_si_units(title, value, si):
    unit = unit_of_title(Title(title))
    assert unit.si == si and unit.to_si(np.ones(1))[0] == value


@pytest.mark.parametrize("title", ["acceleration", "acceleration (V)"])
def test_without_a_known_unit_there_is_none(title):
    assert unit_of_title(Title(title)) is None
