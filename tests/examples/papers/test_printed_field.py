"""Eqs. 1 to 3 of the sound-field paper: corrected they are the other paper's, each fault is what it is."""

import numpy as np
import pytest

from examples.papers import printed_field
from examples.papers.printed_equations import Corrections, Equations
from examples.papers.printed_field import ALONE, EQUATIONS, PAPER, RIGHT, FieldCorrections, FieldEquations
from examples.papers.printed_forces import OM, R
from examples.papers.printed_runs import all_round, bearing_at, equations, growth, start
from fmu_bearing.engine.constants import RPM


def without(*names):
    return equations(ALONE, FieldCorrections.all().changed(off=names), even=False, paper=PAPER)


@pytest.fixture(scope="module")
def state():
    """Seventeen balls round the axis, the inner ring aside by 1 um, everything a little off: (size, 1)."""
    system = without()
    found = all_round(system, start(equations(ALONE, FieldCorrections.all(), paper=PAPER)))[:, None]
    draw = np.random.default_rng(4)
    balls, places, rates = system.split(found)
    balls[:2] += 1e-7 * draw.normal(size=balls[:2].shape)
    balls[2] += 1e-3 * draw.normal(size=balls[2].shape)
    places[1:3] += 1e-6
    rates += 1e-3 * draw.normal(size=rates.shape)
    return found


def test_each_correction_belongs_to_an_equation():
    assert set(FieldCorrections.names()) == set(EQUATIONS) and not set(RIGHT) & set(EQUATIONS)
    none = FieldCorrections.none()
    assert all(getattr(none, name) for name in RIGHT) and not any(getattr(none, name) for name in EQUATIONS)


def test_corrected_they_are_the_multi_source_papers_corrected_equations(state):
    other = Equations(bearing_at(ALONE, PAPER), ALONE * RPM, Corrections.all())
    assert without()(0.0, state) == pytest.approx(other(0.0, state), rel=1e-12)


@pytest.mark.heavy
def test_row_x_of_eq_3_pushes_the_inner_ring_the_way_it_moves(state):
    """Aside by 1 um in both directions across, the ring is driven back along Z and on along Y."""
    (_, _, right), (_, _, wrong) = (without(*names).split(without(*names)(0.0, state))
                                    for names in ((), ("inner_side",)))  # fmt: skip
    assert right[1, 0] < 0.0 and right[2, 0] < 0.0
    assert wrong[1, 0] > 0.0 and wrong[2, 0] == pytest.approx(right[2, 0], rel=1e-12)
    rate, frequency = growth(ALONE, FieldCorrections.all().changed(off=("inner_side",)), PAPER)
    assert rate > 1e4 and frequency == 0.0


def test_normal_pocket_forces_of_equal_balls_do_not_turn_the_printed_cage():
    """x Q_cy + y Q_cx of one push all round is a sum over cos 2 phi: nothing; the moment is 17 Q d_m / 2."""
    angle = 2.0 * np.pi / 17 * np.arange(17)[:, None]
    force = np.stack([0.0 * angle, 0.0 * angle, -1.0 + 0.0 * angle])  # on the balls; the cage is pushed on
    moment = 0.0 * force

    class Seen:
        q = np.stack([0.0 * angle, 0.026 + 0.0 * angle, 0.0 * angle])
        n = np.stack([1.0 + 0.0 * angle, 0.0 * angle, 0.0 * angle])

    right, printed = (without(*names).on_cage(angle, Seen, force, moment)[3, 0]
                      for names in ((), ("cage_rotation",)))  # fmt: skip
    assert right == pytest.approx(17 * 0.026) and printed == pytest.approx(0.0, abs=1e-12)


def test_drag_with_the_printed_sign_drives(state):
    b = bearing_at(ALONE, PAPER)
    right, printed = (
        without(*names).split(without(*names)(0.0, state))[0][OM] for names in ((), ("drag_sign",))
    )
    balls, _, _ = without().split(state)
    radius = b.pitch_radius + balls[R]
    drag = b.drag_factor * (radius * balls[OM]) ** 2
    assert printed - right == pytest.approx(2.0 * drag / (b.ball_mass * radius), rel=1e-9)
    assert drag.min() > 0.0


def test_a_fixed_outer_ring_has_no_acceleration(state):
    _, _, rates = without("outer_free").split(without("outer_free")(0.0, state))
    assert not rates[5:11].any() and rates[:5].all()


@pytest.mark.heavy
def test_the_page_says_what_the_runs_give():
    found = printed_field.results((ALONE,), ("orbit_terms", "inner_side"), 1.0)
    one = found["speeds"][str(ALONE)]
    assert one["corrected"]["load"] == pytest.approx(one["ours"]["load"], abs=0.1)  # N: still settling
    assert one["carried"]["load"][0] == pytest.approx(
        one["carried"]["load"][1], abs=0.1
    )  # no centrifugal force
    text = printed_field.page_of(found)
    assert "the inner ring has left by 1 mm" in text and "| `orbit_terms` | 1 |" in text
    assert isinstance(equations(ALONE, FieldCorrections.all(), paper=PAPER), FieldEquations)
