"""Closed forms of fits against elements of the grooved section."""

import math

import pytest

from tests.formulas.fit_elements import pair, state
from tests.formulas.seats import CASES, CERAMIC, HOUSED, LARGE, RPM, STEEL, Load, Seat

#: What the closed form leaves out: groove and shoulders, bending of the wall, uneven pressure.
WITHIN, HOOP_WITHIN = 0.04, 0.08
#: Quadratic elements of a rectangle under even pressure: 4 to 18 of them across a wall.
EXACT = 1e-4


@pytest.mark.parametrize("name", CASES)
def test_closed_form_is_near_the_grooved_section(name):
    seat, load = CASES[name]
    found, wanted = load.of(seat.fit()), state(pair(seat), load)
    assert found.pressure == pytest.approx(wanted.pressure, rel=WITHIN)
    assert found.race == pytest.approx(wanted.race, rel=WITHIN)
    assert found.hoop == pytest.approx(wanted.hoop, rel=HOOP_WITHIN)


@pytest.mark.parametrize("seat", [STEEL, CERAMIC, LARGE])
def test_growth_by_rotation_and_speed_of_loss_are_those_of_the_grooved_section(seat):
    """Growth is the difference of two: the shaft's, and that of a ring whose shoulders are heavier."""
    wanted = pair(seat).spin
    assert seat.fit().spin == pytest.approx(wanted, rel=0.02)
    speed = Load(2.0).loss(seat.fit())
    assert speed == pytest.approx(math.sqrt(2e-6 / -wanted) / RPM, rel=0.01)


@pytest.mark.parametrize("seat", [STEEL, CERAMIC, HOUSED])
def test_rectangle_on_a_partner_as_wide_is_exact(seat):
    """Even pressure over the whole width of both: plane stress, which Lame solved."""
    made = pair(seat, fineness=18, reach=0.0, grooved=False)
    found, wanted = Load(2.0).of(seat.fit(long=False)), made.at(2e-6, 0.0)
    assert found.pressure == pytest.approx(wanted.pressure, rel=EXACT)
    assert found.hoop == pytest.approx(wanted.hoop, rel=10 * EXACT)  # a derivative


@pytest.mark.parametrize(("seat", "within"), [(STEEL, 0.01), (CERAMIC, 0.01), (LARGE, 0.01), (HOUSED, 0.02)])
def test_partner_longer_than_the_ring_is_stiffer(seat, within):
    """The factor of its compliance alone, in the pressure of a rectangle; without it far off."""
    wanted = pair(seat, grooved=False).at(2e-6, 0.0).pressure
    assert Load(2.0).of(seat.fit()).pressure == pytest.approx(wanted, rel=within)
    assert abs(Load(2.0).of(seat.fit(long=False)).pressure / wanted - 1.0) > 2.0 * within


@pytest.mark.parametrize("ring", ["GCr15", "Si3N4"])
@pytest.mark.parametrize("bore", [0.0, 8.0])
def test_a_soft_shaft_takes_more_of_the_ring_than_the_closed_form_says(ring, bore):
    """Aluminium gives way beside the ring's faces: the bounds of the page on fits."""
    seat = Seat("7003C", "inner", ring, "aluminium", bore)
    found, wanted = Load(2.0).of(seat.fit()), pair(seat).at(2e-6, 0.0)
    assert -0.025 < found.pressure / wanted.pressure - 1.0 < -0.01
    assert 0.0 < found.race / wanted.race - 1.0 < 0.07
    assert -0.135 < found.hoop / wanted.hoop - 1.0 < -0.08
