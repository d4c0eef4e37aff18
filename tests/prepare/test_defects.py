"""Tables of local defects: shapes, loads of the specification, and tables beside contacts that are solved."""

import functools
import math

import numpy as np
import pytest

from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.prepare import defects
from fmu_bearing.prepare.defect_contact import BallOverDefect
from fmu_bearing.prepare.defect_shapes import Shape
from fmu_bearing.prepare.defects import computed, defect_table, effective, eta

MODULUS = effective_modulus(208e9, 0.3, 208e9, 0.3)
OUTER = (4.777423e-3, 70.136667e-3, MODULUS)  # of a steel 6205, conformity 0.53
HERTZ = point_contact(*OUTER)
LOAD = 180.0
APPROACH = (LOAD / HERTZ.stiffness) ** (2.0 / 3.0)
EDGE = 1e-5


def pit(size, depth=2e-4, edge=EDGE, **more):
    return Shape("ellipse", size, size, depth, edge, **more)


GROOVE = Shape("rectangle", 0.533e-3, math.inf, 2e-4, EDGE)
DENT = Shape("dent", 0.4e-3, 0.4e-3, 5e-6, rim=1e-6)
SCRATCH = Shape("rectangle", 0.1e-3, math.inf, 1e-5, EDGE, turn=math.radians(30.0))
SHAPES = {"pit": pit(0.5e-3), "spall": Shape("rectangle", 1.2e-3, 3e-3, 1e-4, EDGE), "dent": DENT}


@functools.cache
def table(name):
    """Coarse table: 8 approaches, at most 33 places, 48 x 48 cells."""
    return computed(SHAPES[name], *OUTER, approaches=8, places=33, cells=(48, 48))


@functools.cache
def ball(name):
    return BallOverDefect(SHAPES[name], *OUTER, cells=(48, 48))


@pytest.mark.parametrize(
    "size, left, drops",
    [
        (0.178e-3, 0.98, (0.053, 0.075, 0.092)),
        (0.356e-3, 0.86, (0.364, 0.357, 0.323)),
        (0.533e-3, 0.71, (0.795, 0.717, 0.621)),
        (0.711e-3, 0.54, (1.302, 1.135, 0.937)),
    ],
)
def test_loads_left_over_round_pits_are_those_of_the_specification(size, left, drops):
    over = BallOverDefect(pit(size, edge=0.0), *OUTER)
    assert over.carried(APPROACH, 0.0).load / LOAD == pytest.approx(left, abs=0.02)
    for part, drop in zip((1.0, 0.5, 0.25), drops, strict=True):
        approach = part * APPROACH
        load = HERTZ.stiffness * approach**1.5
        wanted = (1.0 - min(1e-6 * drop / approach, 1.0)) ** 1.5
        assert over.carried(approach, 0.0).load / load == pytest.approx(wanted, abs=0.02)


@pytest.mark.parametrize("place, left", [(-0.45, 0.758), (-0.30, 0.363), (-0.15, 0.003)])
def test_loads_left_over_a_groove_are_those_of_the_specification(place, left):
    over = BallOverDefect(GROOVE._replace(edge=0.0), *OUTER)
    assert over.carried(APPROACH, place * GROOVE.length).load / LOAD == pytest.approx(left, abs=0.02)


def test_a_ball_over_the_middle_of_a_wide_groove_touches_where_both_edges_meet_it():
    wide = GROOVE._replace(length=0.8e-3)
    assert wide.length > 6.0 * HERTZ.half_width * APPROACH**0.5
    over, first = BallOverDefect(wide, *OUTER), wide.length**2 / (8.0 * OUTER[0])
    assert over.touch(0.0) == pytest.approx(first, rel=0.03)
    assert over.carried(0.97 * first, 0.0).load == 0.0
    assert over.carried(1.03 * first, 0.0).load > 0.0


@pytest.mark.parametrize("depth", [1e-6, 3e-5])
def test_first_touch_follows_the_edge_then_the_bottom(depth):
    over = BallOverDefect(Shape("rectangle", 6e-3, math.inf, depth), *OUTER)
    for x in (0.0, -2.2e-3, -2.7e-3, -2.95e-3, 2.99e-3, -3.01e-3):
        inside = max(3e-3 - abs(x), 0.0)
        # the first touch is looked for on points 1e-3 of the ball's reach apart
        assert over.touch(x) == pytest.approx(min(depth, inside**2 / (2.0 * OUTER[0])), rel=2e-3, abs=1e-9)


def test_force_along_the_track_is_the_slope_of_the_energy():
    over, step = BallOverDefect(GROOVE, *OUTER), 5e-6
    for x in (-0.28e-3, -0.2e-3, -0.1e-3):
        ends = [over.carried(2.0 * APPROACH, x + sign * step).energy for sign in (1.0, -1.0)]
        # of energies on two grids, whose cells differ
        assert (ends[0] - ends[1]) / (2.0 * step) == pytest.approx(
            over.carried(2.0 * APPROACH, x).slope, rel=0.03
        )


@pytest.mark.parametrize("shape", [SHAPES["pit"], SCRATCH, DENT, SHAPES["spall"]._replace(offset=1.2e-3)])
def test_both_sides_of_a_shape_are_equal(shape):
    over = BallOverDefect(shape, *OUTER, cells=(48, 48))
    one, other = over.carried(8e-6, -0.07e-3), over.carried(8e-6, 0.07e-3)
    # cells do not lie symmetrically
    assert one.load == pytest.approx(other.load, rel=5e-3)
    assert one.slope == pytest.approx(-other.slope, rel=0.1, abs=1e-4 * one.load)


def test_a_rim_raises_the_load():
    loads = [
        BallOverDefect(DENT._replace(rim=rim), *OUTER).carried(APPROACH, 0.25e-3).load for rim in (0.0, 1e-6)
    ]
    assert loads[1] > 1.03 * loads[0]  # a rim of a quarter of the approach
    assert BallOverDefect(DENT, *OUTER).touch(0.25e-3) < -0.8e-6  # on the rim


def test_a_defect_across_the_track_out_of_the_contact_changes_nothing():
    over = BallOverDefect(pit(0.3e-3, offset=3e-3), *OUTER)
    assert effective(over, APPROACH, 0.0) == pytest.approx((APPROACH, 1.0, 0.0), rel=1e-12)


@pytest.mark.parametrize("name", SHAPES)
def test_load_and_force_of_a_table_are_slopes_of_its_energy(name):
    found, rng = table(name), np.random.default_rng(3)
    top = found.approaches[-1]
    for _ in range(60):
        x, delta = rng.uniform(found.places[0], found.places[-1]), top * rng.uniform(0.1, 1.2) ** 2
        left, rate, along = eta(found, delta, x)
        if left <= 0.01 * top:
            continue
        step = 1e-5 * delta
        ends = [eta(found, delta + sign * step, x)[0] for sign in (1.0, -1.0)]
        assert (ends[0] - ends[1]) / (2.0 * step) == pytest.approx(rate, abs=1e-4)
        ends = [eta(found, delta, x + sign * 1e-9)[0] for sign in (1.0, -1.0)]
        assert (ends[0] - ends[1]) / 2e-9 == pytest.approx(along, abs=1e-5)


@pytest.mark.parametrize("name", SHAPES)
def test_a_table_has_the_loads_of_contacts_between_its_nodes(name):
    found, over, rng = table(name), ball(name), np.random.default_rng(4)
    assert len(found.places) <= 33
    stiffness, top = HERTZ.stiffness, found.approaches[-1]
    for _ in range(20):
        x, delta = rng.uniform(found.places[0], found.places[-1]), top * rng.uniform(0.2, 0.9) ** 2
        left, rate, along = eta(found, delta, x)
        there, load = over.carried(delta, x), stiffness * delta**1.5
        # within 2 % of the undamaged load, and forces along the track of the largest of them, 0.03 of it
        assert stiffness * left**1.5 * rate == pytest.approx(there.load, abs=0.02 * load)
        assert stiffness * left**1.5 * along == pytest.approx(there.slope, abs=1.5e-3 * load)


INNER_7003C = (1.873846e-3, 77.25e-3, 270.9e9)  # with ceramic balls and rings
OUTER_7010C = (4.935e-3, 113.503e-3, MODULUS)


@pytest.mark.heavy
@pytest.mark.parametrize(
    "shape, radii",
    [
        (pit(0.178e-3), INNER_7003C),
        (pit(0.711e-3), OUTER),
        (SHAPES["spall"], OUTER_7010C),
        (SHAPES["spall"], INNER_7003C),
        (GROOVE, INNER_7003C),
        (DENT, OUTER),
        (SCRATCH, OUTER_7010C),
        (Shape("rectangle", 20e-3, 20e-3, 1e-3, EDGE), OUTER),
        (Shape("ellipse", 1e-3, 3e-3, 5e-5, EDGE, offset=1e-3, turn=0.3), OUTER),
    ],
)
def test_full_tables_have_the_loads_of_contacts_between_their_nodes(shape, radii):
    found, over, rng = computed(shape, *radii), BallOverDefect(shape, *radii), np.random.default_rng(7)
    stiffness, top = over.hertz.stiffness, found.approaches[-1]
    assert len(found.places) < defects.PLACES  # all are as exact as asked for
    for _ in range(40):
        x, delta = rng.uniform(found.places[0], found.places[-1]), top * rng.uniform(0.1, 0.95) ** 2
        touch = over.touch(x)
        delta += rng.integers(2) * max(touch, 0.0)
        left, rate, along = eta(found, delta, x)
        there, load = over.carried(delta, x), stiffness * (delta - min(touch, 0.0)) ** 1.5
        # the largest of 480 other draws: 0.013 of the undamaged load; along the track 0.002
        assert stiffness * left**1.5 * rate == pytest.approx(there.load, abs=0.02 * load)
        assert stiffness * left**1.5 * along == pytest.approx(there.slope, abs=3e-3 * load)


def test_a_table_joins_the_undamaged_race_at_its_ends():
    found = table("pit")
    for x in (found.places[0] - 1e-9, found.places[-1] + 1e-9, 1.0):
        assert eta(found, 5e-6, x) == (5e-6, 1.0, 0.0)
    assert eta(found, 5e-6, found.places[0] + 1e-9) == pytest.approx((5e-6, 1.0, 0.0), rel=1e-6, abs=1e-6)
    assert eta(found, -1e-9, 1.0) == eta(found, -1e-9, 0.0) == (0.0, 0.0, 0.0)
    # beyond the last approach the loss stays
    far, nearer = eta(found, 1e-4, 0.0), eta(found, 9e-5, 0.0)
    assert far[0] - nearer[0] == pytest.approx(1e-5, rel=1e-9) and far[1] == 1.0


def test_a_defect_of_another_scale_is_similar():
    found, delta, x = table("spall"), 4e-6, -0.5e-3
    half = eta(found, 0.5 * delta, x, 0.5)
    assert half == pytest.approx(tuple(np.multiply(eta(found, delta, x), (0.5, 1.0, 0.5))), rel=1e-12)
    assert eta(found, delta, x, 0.0) == (delta, 1.0, 0.0)
    shallow = eta(found, delta, x, 1e-6)
    assert shallow[0] == pytest.approx(delta, rel=1e-5)


def test_a_defect_without_depth_is_none():
    flat = computed(pit(0.3e-3, depth=0.0), *OUTER, approaches=6, cells=(16, 16))
    assert flat.touch == pytest.approx(0.0, abs=1e-18)
    assert flat.drop == pytest.approx(0.0, abs=1e-18) and flat.drop_e == pytest.approx(0.0, abs=1e-14)


@pytest.mark.parametrize(
    "shape",
    [
        Shape("rectangle", 20e-3, 20e-3, 1e-3, EDGE),
        Shape("rectangle", 0.05e-3, 0.05e-3, 1e-3, EDGE),
        Shape("rectangle", 20e-3, 0.3e-3, 1e-6, EDGE),
        Shape("rectangle", 0.05e-3, math.inf, 1e-6, EDGE, turn=math.radians(-80.0)),
        Shape("ellipse", 1e-3, 3e-3, 5e-5, EDGE, offset=1e-3, turn=0.3),
        Shape("dent", 0.05e-3, 0.05e-3, 1e-5, rim=5e-6),
    ],
    ids=["long", "small", "narrow", "steep", "aside", "indent"],
)
def test_shapes_of_all_sizes_have_tables(shape):
    found = computed(shape, *OUTER, approaches=5, places=17, cells=(24, 24))
    assert len(found.places) <= 17 and (np.diff(found.places) > 0.0).all()
    assert all(np.isfinite(one).all() for one in found[:-1])
    assert found.touch.max() <= shape.depth and found.touch.min() >= -shape.rim
    middle = eta(found, found.touch.max() + found.approaches[-2], 0.0)
    assert middle[0] > 0.0 and middle[1] > 0.0


def test_a_table_is_computed_once(tmp_path, monkeypatch):
    calls = []

    def coarse(*given, **more):
        calls.append(given)
        return computed(*given, approaches=4, places=9, cells=(16, 16), **more)

    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(defects, "computed", coarse)
    defect_table.cache_clear()
    first = defect_table(SHAPES["pit"], *OUTER)
    assert defect_table(SHAPES["pit"], *OUTER) is first
    defect_table.cache_clear()
    again = defect_table(SHAPES["pit"], *OUTER)
    assert len(calls) == 1
    assert all(np.array_equal(one, other) for one, other in zip(first, again, strict=True))
    (file,) = (tmp_path / "cache" / "defects").iterdir()
    file.write_bytes(file.read_bytes()[:100])
    defect_table.cache_clear()
    defect_table(SHAPES["pit"], *OUTER)
    assert len(calls) == 2
    defect_table(pit(0.4e-3), *OUTER)
    assert len(calls) == 3
    defect_table.cache_clear()


def test_edges_are_rounded_by_a_quarter_of_a_circle():
    shape = pit(1e-3, depth=1e-4, edge=2e-5)
    x = np.array([0.0, 0.47e-3, 0.49e-3, 0.5e-3, 0.6e-3])
    wanted = [1e-4, 1e-4, 2e-5 * (1.0 - math.sqrt(0.75)), 0.0, 0.0]
    assert shape.pit(x, np.zeros(5)) == pytest.approx(wanted, abs=1e-15)


def test_a_shape_is_turned_and_moved():
    shape = Shape("rectangle", 0.2e-3, 2e-3, 1e-5, offset=1e-3, turn=math.radians(90.0))
    x, y = np.array([0.9e-3, 0.0, 0.0]), np.array([1.05e-3, 1.15e-3, 0.0])
    assert shape.pit(x, y).tolist() == [1e-5, 0.0, 0.0]
    assert shape.extent(5e-3) == pytest.approx((1e-3, 0.1e-3))


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"kind": "star"}, "shape 'star': one of rectangle, ellipse, dent"),
        ({"length": 0.0}, "length 0.0 m of a defect: give more than 0"),
        ({"depth": -1e-6}, "depth -1e-06 m of a defect: give 0 or more"),
        ({"rim": 1e-6}, "rim 1e-06 m of a ellipse: only a dent has one; give 0"),
        ({"width": math.inf}, "width of a ellipse without end: only a rectangle can have it"),
        ({"offset": math.nan}, "length, offset and turn of a defect: give finite numbers"),
        ({"kind": "rectangle", "width": math.inf, "turn": 1.5}, "turn 86 deg .* give -80 to 80 deg"),
    ],
)
def test_shapes_that_there_are_not_are_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        defect_table(pit(1e-3)._replace(**changes), *OUTER)
