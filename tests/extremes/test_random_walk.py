"""A random walk of the inputs over all they may be: it goes on, or is refused and can go on from before."""

import math
import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from fmu_bearing.instance import EngineError
from tests.extremes.bearings import MOST_BALLS, bearing, work
from tests.extremes.cases import COMPUTED, FULL, JET, WORK

# The Runge-Kutta methods may try at most this many steps per largest internal step of a call, and so many
# besides: the engine's own limit, which a refusal must not exceed either.
_PER_STEP, _BESIDES = 101.0, 2001.0
REFUSALS = re.compile("could not be solved|no quasi-static equilibrium|stiffer pedestal")
SANE = {
    "shaft_speed": 2000.0,
    "preload": 500.0,
    "pedestal_stiffness": 1e8,
    "radial_load.y": 0.0,
    "radial_load.z": 0.0,
    "oil_temperature": 293.15,
    "inner_ring_temperature": 293.15,
    "outer_ring_temperature": 293.15,
}


def values(name: str):
    """Values of one input over its whole range, the ends among them, and a few beyond it."""
    speed, load = st.floats(-10472.0, 10472.0), st.floats(-3e3, 3e3)
    ranges = {
        "shaft_speed": st.one_of(speed, st.sampled_from([0.0, 0.1, -10472.0, 10472.0])),
        "preload": st.one_of(st.floats(0.0, 1e4), st.sampled_from([0.0, 1.0, 1e4])),
        "pedestal_stiffness": st.floats(4.0, 12.0).map(lambda lg: min(max(10.0**lg, 1e4), 1e12)),
        "radial_load.y": st.one_of(load, st.sampled_from([0.0, 3e3])),
        "radial_load.z": st.one_of(load, st.sampled_from([0.0, -3e3])),
    }
    inside = ranges.get(name, st.floats(233.0, 473.0))
    return st.one_of(inside, inside, inside, inside, st.sampled_from([math.nan, -1e13, 1e13]))


MOVES = st.sampled_from(sorted(SANE)).flatmap(
    lambda name: st.tuples(st.just(name), values(name), st.sampled_from([1e-5, 5e-5, 2e-4]))
)
STARTS = st.fixed_dictionaries({}, optional={name: values(name) for name in SANE})


def put(run, name, value):
    """Set an input; a value that is refused leaves the one before."""
    before = run.get(name)
    try:
        run.set(name, value)
    except ValueError as reason:
        assert "is refused: allowed are" in str(reason)
        assert run.get(name) == before


def astray(run):
    """Whether the bearing has left what equations for small displacements cover: 1 mm across the axis.

    3 kN on a pedestal of 1e4 N/m ask for 300 mm; such a run may be refused at any time.
    """
    across = math.hypot(run.get("outer_ring.displacement.y"), run.get("outer_ring.displacement.z"))
    wanted = math.hypot(run.get("radial_load.y"), run.get("radial_load.z")) / run.get("pedestal_stiffness")
    return max(across, wanted) > 1e-3


def walk(scene, start, moves, fidelity, method, changes=None):
    """Initialise, then one input and one step after the other; every refusal is undone and gone on from."""
    run = bearing(scene, {"sound": None} | (changes or {}), {}, fidelity, method)
    for name, value in start.items():
        put(run, name, value)
    try:
        run.initialise()
    except EngineError as reason:
        assert REFUSALS.search(str(reason))
        run.reset()
        run.initialise()
    assert np.isfinite(run.z).all() and np.isfinite(run.s).all()
    for name, value, h in moves:
        inputs = run.u.copy()
        put(run, name, value)
        kept, shown, before = run.s.copy(), run.z.copy(), work(run)
        wave = run.get("solver.wave_time")
        try:
            run.step(h)
        except EngineError as reason:
            assert REFUSALS.search(str(reason))
            np.testing.assert_array_equal(run.s, kept)
            np.testing.assert_array_equal(run.z, shown)
            # with the inputs under which the state was reached the bearing goes on
            run.u[:] = inputs
            if astray(run):
                run.reset()
                run.initialise()
            run.step(1e-6)
        # internal steps follow the waves of balls and races at the faster of both speeds
        longest = min(run.get("max_internal_step"), wave, run.get("solver.wave_time"))
        most = _BESIDES + _PER_STEP * math.ceil(h / longest)
        assert work(run) - before <= most * WORK[fidelity, method]
        assert np.isfinite(run.z).all() and np.isfinite(run.s).all()
        for side in ("inner", "outer"):
            assert run.get(f"contact.{side}.load_mean") >= 0.0
    run.reset()
    for name, value in SANE.items():
        run.set(name, value)
    run.initialise()
    run.step(1e-4)
    assert np.isfinite(run.z).all()


HEALTH = {"suppress_health_check": list(HealthCheck)}
# every change of an input makes them look for a new equilibrium
CONDENSED = [pair for pair in COMPUTED if pair not in FULL]


@pytest.mark.parametrize(("fidelity", "method"), FULL)
@settings(max_examples=10, **HEALTH)  # three times as many, and longer ones, are heavy
@given(start=STARTS, moves=st.lists(MOVES, min_size=1, max_size=12))
def test_a_short_walk(fidelity, method, start, moves):
    walk("7003C-bare", start, moves, fidelity, method)


@pytest.mark.parametrize(("fidelity", "method"), CONDENSED)
@settings(max_examples=10, **HEALTH)
@given(start=STARTS, moves=st.lists(MOVES, min_size=1, max_size=6))
def test_a_short_walk_of_condensed_fidelities(fidelity, method, start, moves):
    walk("7003C-bare", start, moves, fidelity, method)


@pytest.mark.parametrize(("fidelity", "method"), COMPUTED)
@settings(max_examples=5, **HEALTH)
@given(start=STARTS, moves=st.lists(MOVES, min_size=1, max_size=6))
def test_a_short_walk_with_a_jet(fidelity, method, start, moves):
    walk("7003C-bare", start, moves, fidelity, method, JET)


@pytest.mark.heavy
@pytest.mark.parametrize(("fidelity", "method"), COMPUTED)
@settings(max_examples=5, **HEALTH)
@given(start=STARTS, moves=st.lists(MOVES, min_size=1, max_size=6))
def test_a_short_walk_of_32_balls(fidelity, method, start, moves):
    walk("7009C-full-ceramic", start, moves, fidelity, method, MOST_BALLS)


#: The gate scene's balls and rings as those of a deep groove bearing, by its clearance (um).
DEEP_GROOVE = {"bearing.kind": "deep-groove", "bearing.contact_angle_deg": None}


@pytest.mark.heavy
@pytest.mark.parametrize("clearance", [12.0, -2.0])
@pytest.mark.parametrize(("fidelity", "method"), COMPUTED)
@settings(max_examples=5, **HEALTH)
@given(start=STARTS, moves=st.lists(MOVES, min_size=1, max_size=6), towards=st.sampled_from([1.0, -1.0]))
def test_a_short_walk_of_a_deep_groove_bearing(fidelity, method, clearance, start, moves, towards):
    """Axial loads point both ways, from one step to the next, too."""
    start = {name: towards * value if name == "preload" else value for name, value in start.items()}
    signs = [towards * (-1.0) ** k if name == "preload" else 1.0 for k, (name, _, _) in enumerate(moves)]
    moves = [(name, sign * value, h) for sign, (name, value, h) in zip(signs, moves, strict=True)]
    changes = DEEP_GROOVE | {"bearing.radial_clearance_um": clearance}
    walk("7003C-bare", start, moves, fidelity, method, changes)


#: Walks that take balls off the inner race: a ring that is 118 K colder at once, no preload at full speed.
OFF_THE_RACE = {
    "7009C-full-ceramic": (
        {"preload": 4244.0, "inner_ring_temperature": 378.0, "shaft_speed": 7841.0},
        [("inner_ring_temperature", 260.0, 1e-5)] * 2,
    ),
    "7003C-bare": (
        {"preload": 8.0},
        [
            ("oil_temperature", math.nan, 1e-5), ("shaft_speed", 10472.0, 5e-5), ("preload", 0.0, 5e-5),
            ("oil_temperature", math.nan, 1e-5),
        ],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("fidelity", "method"), CONDENSED)
@pytest.mark.parametrize("scene", OFF_THE_RACE)
def test_balls_off_the_inner_race(scene, fidelity, method):
    walk(scene, *OFF_THE_RACE[scene], fidelity, method)


@pytest.mark.parametrize(("fidelity", "method"), FULL)
def test_a_cage_flung_through_its_film(fidelity, method):
    """A pedestal that stiffens 3000 times throws the outer ring at 10 m/s, which turns the inner ring.

    The lands' film then changes sides within 0.3 ns: steps of 0.1 ns are too long for it.
    """
    start = {
        "shaft_speed": 0.0, "preload": 233.0, "pedestal_stiffness": 10**6.5, "radial_load.y": 349.0,
        "radial_load.z": 234.0, "outer_ring_temperature": 233.0,
    }  # fmt: skip
    before = [("preload", 233.0, 2.5e-4), ("oil_temperature", 233.0, 1e-5)]
    inner = ("inner_ring_temperature", 233.0, 1e-5)
    after = [("inner_ring_temperature", 233.0, 2e-4), ("pedestal_stiffness", 1e10, 1e-5), *4 * [inner]]
    walk("7009C-full-ceramic", start, [*before, *5 * [inner], *after], fidelity, method)


def test_loose_balls_in_a_stop_from_full_speed():
    """3027 internal steps in 0.2 ms: more than the longest step asks for, fewer than the waves do."""
    cold = ("inner_ring_temperature", 233.0, 1e-5)
    moves = [
        cold,
        ("radial_load.y", 2982.0, 1e-5),
        *8 * [cold],
        ("inner_ring_temperature", 233.0, 2e-4),
        cold,
    ]
    moves += [("pedestal_stiffness", 1e9, 1e-5), ("shaft_speed", -9061.0, 1e-5), ("shaft_speed", 0.0, 2e-4)]
    walk("7003C-spindle", {"preload": 0.0}, moves, "full", "esdirk4")


@pytest.mark.heavy
@pytest.mark.parametrize(("fidelity", "method"), FULL)
@pytest.mark.parametrize("scene", ["7003C-bare", "7003C-spindle", "7009C-full-ceramic"])
@settings(max_examples=8, **HEALTH)
@given(start=STARTS, moves=st.lists(MOVES, min_size=10, max_size=30))
def test_a_long_walk(scene, fidelity, method, start, moves):
    walk(scene, start, moves, fidelity, method)


@pytest.mark.heavy
@pytest.mark.parametrize(("fidelity", "method"), CONDENSED)
@pytest.mark.parametrize("scene", ["7003C-spindle", "7009C-full-ceramic"])
@settings(max_examples=5, **HEALTH)
@given(start=STARTS, moves=st.lists(MOVES, min_size=5, max_size=12))
def test_a_long_walk_of_condensed_fidelities(scene, fidelity, method, start, moves):
    walk(scene, start, moves, fidelity, method)
