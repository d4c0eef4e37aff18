"""Readings of the 7003C: values and sensitivities of the test, against those of a prototype of its own.

The prototype read (um/s; hybrid, P4, soft piece) 43.6, 103.8, 56.6 with seed 1 and 40.2, 59.3, 54.7 with seed
2. Part of the difference is the line 2 f_o at 300.8 Hz: it counted for L there, and here a bin on the edge of
L and M counts for both by halves. It weighed waves over a contact with the pressure of Hertz, and so do the
tests that repeat its values.
"""

import numpy as np
import pytest

from fmu_bearing import with_fidelity
from fmu_bearing.prepare import surfaces
from fmu_bearing.vibration_test.reading import levels, reading
from fmu_bearing.vibration_test.rig import rig
from fmu_bearing.vibration_test.subject import subject

# L and H within 3 %, M, which one resonance rules, within 10 %: what runs of 0.25 to 2 s differ by
CLOSE = {"L": 0.03, "M": 0.10, "H": 0.03}
SMOOTH = {
    "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "seed": 1,
}  # fmt: skip


def read(scene, **given):
    tested = rig(scene, **given)
    return levels(tested, reading(tested))


@pytest.fixture(scope="module")
def bearing():
    return subject("7003C", "hybrid", "P4")


@pytest.fixture(scope="module")
def usual(bearing):
    return read(bearing)


@pytest.fixture
def prototype(monkeypatch):
    """Its filter of waves over a contact in place of the exact one: 3 (sin u - u cos u)/u^3."""

    def by_pressure(u):
        x = np.where(np.abs(u) < 1e-2, 1e-2, u)
        return 3.0 * (np.sin(x) - x * np.cos(x)) / x**3

    monkeypatch.setattr(surfaces, "contact_filter", by_pressure)


def close(found, wanted, names="LMH"):
    for name in names:
        assert found[name] == pytest.approx(wanted[name], rel=CLOSE[name]), (name, found)


@pytest.mark.heavy
@pytest.mark.usefixtures("prototype")
def test_two_seeds_read_as_the_prototype(bearing):
    close(read(bearing), {"L": 43.6, "M": 103.8, "H": 56.6})
    close(read(bearing.replace({"imperfections.seed": 2})), {"L": 40.2, "M": 59.3, "H": 54.7})


@pytest.mark.parametrize(
    ("model", "wanted"),
    [
        pytest.param("full", (26.3, 97.0, 43.6), marks=pytest.mark.heavy),
        ("rings", (26.0, 77.0, 43.7)),
        ("response", (25.8, 79.0, 43.4)),
    ],
)
@pytest.mark.usefixtures("prototype")
def test_rigid_rings_read_too_little(bearing, model, wanted):
    found = read(with_fidelity(bearing, model=model), rigid=True)
    close(found, dict(zip("LMH", wanted, strict=True)))


def test_the_exact_filter_takes_a_tenth_of_the_high_band(bearing, request):
    """H 55.7 to 50.6 um/s over four seeds by another program (0.908), M -1.5 %, L as it was."""
    rigid = with_fidelity(bearing, model="rings")
    exact = read(rigid, rigid=True)
    request.getfixturevalue("prototype")
    before = read(rigid, rigid=True)
    ratio = {name: exact[name] / before[name] for name in "LMH"}
    for name, (wanted, within) in {"L": (1.0, 0.005), "M": (0.985, 0.02), "H": (0.908, 0.02)}.items():
        assert ratio[name] == pytest.approx(wanted, abs=within), name


@pytest.mark.heavy
def test_twice_the_surfaces_read_twice_as_much(bearing, usual):
    flaws = bearing.imperfections
    keys = ("inner_race_amplitude_um", "outer_race_amplitude_um", "ball_form_nm", "ball_diameter_spread_nm")
    found = read(bearing.replace({f"imperfections.{key}": 2.0 * getattr(flaws, key) for key in keys}))
    # 2.00 and 2.01; the contacts are not linear, of which the rocking mode in M has most: 1.91
    ratio = {name: found[name] / usual[name] for name in "LMH"}
    assert ratio == pytest.approx({"L": 2.0, "M": 1.91, "H": 2.0}, rel=0.03)


@pytest.mark.heavy
@pytest.mark.parametrize(
    "given", [{"load_N": 90.0}, {"load_N": 110.0}, {"speed_rpm": 1764.0}, {"speed_rpm": 1818.0}]
)
def test_tolerances_of_load_and_speed_move_the_reading_little(bearing, usual, given):
    # -1 to 1.5 % in L, -3.01 to 1.8 % in H
    found = read(bearing, **given)
    assert found["L"] == pytest.approx(usual["L"], rel=0.03)
    assert found["H"] == pytest.approx(usual["H"], rel=0.04)


@pytest.mark.heavy
def test_shorter_steps_read_the_same(bearing, usual):
    found = read(bearing.replace({"fidelity.max_internal_step_us": 6.25}))  # a quarter
    assert found == pytest.approx(usual, rel=0.002)


@pytest.mark.heavy
def test_smooth_surfaces_leave_the_cage_and_without_it_nothing(bearing):
    smooth = bearing.replace({"imperfections": SMOOTH})
    found = read(smooth)
    # the cage drives the ring's rocking mode in M with 9.4, and is 0.27 in H
    assert found["L"] < 0.01 and 8.0 < found["M"] < 11.0 and found["H"] < 0.5
    assert max(read(smooth.replace({"bearing.cage": None})).values()) < 1e-3


@pytest.mark.heavy
def test_the_high_band_of_a_large_bearing_is_one_of_the_contacts_damping():
    large = subject("7009C")
    assert large.bearing.contact_damping_us == 2.5
    found = [read(large.replace({"bearing.contact_damping_us": damping}))["H"] for damping in (2.5, 10.0)]
    # the program's own values, of one seed; a mode of the outer ring at 7 kHz rules the band
    # (116 and 68 with waves weighted by the pressure)
    assert found == pytest.approx([109.6, 65.2], rel=0.03)
