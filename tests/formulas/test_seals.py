"""SKF's torque of seals by hand at single bearings, and where its table ends."""

import math

import pytest

from fmu_bearing.formulas import seals


def of(kind, deep_groove, outside, lip, sides=2):
    return seals.torque(seals.row(kind, deep_groove, outside), lip, sides)


def test_by_hand():
    """K_S1 d_s^beta + K_S2 with the d_1 and d_2 that SKF prints; powers by their logarithms to base 10."""
    # 6205-2RSH: lg 31.8 = 1.502427, times 2.25 3.380461, 2401.4; times 0.028 67.24
    assert of("RSH", True, 52.0, 31.8) == pytest.approx(67.24 + 2.0, abs=0.01)
    # 6305-2RS1, 62 mm: lg 36.6 = 1.563481, times 2.25 3.517832, 3294.8; times 0.023 75.78
    assert of("RS1", True, 62.0, 36.6) == pytest.approx(75.78 + 2.0, abs=0.01)
    # 6306-2RS1, 72 mm: lg 44.6 = 1.649335, times 2.25 3.711004, 5140.5; times 0.018 92.53
    assert of("RS1", True, 72.0, 44.6) == pytest.approx(92.53 + 20.0, abs=0.01)
    # 7205 with RS1: 36.1 squared 1303.21, times 0.014 18.245
    assert of("RS1", False, 52.0, 36.1) == pytest.approx(28.245, abs=1e-3)
    # 6205-2RSL: 2401.4 times 0.0018
    assert of("RSL", True, 52.0, 31.8) == pytest.approx(4.3225, abs=1e-3)
    # 6205-2RZ, 7205 with RZ and 608-2RSL do not touch
    assert of("RZ", True, 52.0, 31.8) == of("RZ", False, 52.0, 36.1) == of("RSL", True, 22.0, 10.0) == 0.0


def test_one_seal_has_half_but_for_rsl():
    assert of("RSH", True, 52.0, 31.8, 1) == 0.5 * of("RSH", True, 52.0, 31.8)
    assert of("RSL", True, 52.0, 31.8, 1) == of("RSL", True, 52.0, 31.8)


@pytest.mark.parametrize(
    ("kind", "deep_groove", "inside", "outside"),
    [
        ("RZ", True, (10.0, 175.0), (175.1, 300.0)), ("RSL", True, (19.0, 52.0), (52.1,)),
        ("RSH", True, (19.0, 52.0), (52.1, 62.0)), ("RS1", True, (19.0, 300.0), ()),
        ("RS1", False, (30.1, 120.0), (30.0, 120.1)), ("RSH", False, (), (26.0, 52.0)),
        ("RSL", False, (), (26.0, 52.0)),
    ],
)  # fmt: skip
def test_where_the_table_ends(kind, deep_groove, inside, outside):
    assert all(seals.row(kind, deep_groove, one) is not None for one in inside)
    assert all(seals.row(kind, deep_groove, one) is None for one in outside)


def test_rows_of_a_seal_follow_each_other():
    for kind in seals.KINDS:
        for deep_groove in (True, False):
            found = seals.rows(kind, deep_groove)
            assert [one.to for one in found[:-1]] == [one.over for one in found[1:]]


def test_the_lip_where_it_is_not_given():
    """Within the scatter of printed diameters: 2 % of them, 5 % of the torque."""
    printed = [
        ("RSH", True, 15, 35, 19.4), ("RSH", True, 17, 40, 22.2), ("RSH", True, 20, 47, 26.3),
        ("RSH", True, 25, 52, 31.8), ("RSH", True, 20, 52, 27.2), ("RSH", True, 25, 47, 29.7),
        ("RS1", True, 30, 55, 38.2), ("RS1", True, 25, 62, 36.6), ("RS1", True, 30, 62, 40.4),
        ("RS1", False, 25, 52, 36.1), ("RS1", False, 25, 62, 39.8), ("RS1", False, 17, 40, 26.3),
    ]  # fmt: skip
    for kind, deep_groove, bore, outside, lip in printed:
        one = seals.row(kind, deep_groove, float(outside))
        assert seals.lip_diameter(one, bore, outside) == pytest.approx(lip, rel=0.02)


def test_speeds_that_skf_prints_are_near_the_limit_of_the_lip():
    """Limiting speeds, r/min, and d_2 of RSH, d_1 of RS1, mm: 13.2 to 16.0 m/s."""
    printed = [
        (14e3, 18.7), (13e3, 19.4), (12e3, 21.1), (13e3, 20.7), (12e3, 22.2), (11e3, 24.0), (11e3, 24.9),
        (10e3, 26.3), (9.5e3, 27.2), (9.5e3, 29.7), (8.5e3, 31.8), (8.5e3, 34.4), (7.5e3, 36.6),
        (8e3, 38.2), (7.5e3, 40.4), (6.3e3, 44.6),
    ]  # fmt: skip
    speeds = [rpm * math.pi / 30.0 * lip / 2e3 for rpm, lip in printed]
    assert 0.94 * seals.LIP_SPEED < min(speeds)
    assert max(speeds) == pytest.approx(seals.MOST_LIP_SPEED, abs=0.05)  # as it is rounded
