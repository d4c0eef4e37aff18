"""A short run beside full: rings that move otherwise, balls that strike pockets, and what is said of it."""

import numpy as np
import pytest

from fmu_bearing import new_scene, read_scene, simulate
from fmu_bearing.arrays import Arrays
from fmu_bearing.interface.table import variables
from fmu_bearing.modal.campbell.doubts import (
    FAR,
    QUIETER,
    doubt,
    is_of_levels,
    is_of_motion,
    moves_far_more,
    pockets_struck,
    rings_depart,
)
from fmu_bearing.modal.equations.beside_full import beside_full
from fmu_bearing.modal.equations.cage_sound import loss_without_cage
from fmu_bearing.prepare.sound_block import silenced, sound_blocks
from fmu_bearing.scene.read import read_scene_text, with_fidelity
from tests.conftest import EXAMPLES
from tests.marks import heavy_but


def fresh(bearing, rpm, preload, kind="hybrid", **options):
    text = new_scene(
        "fresh", bearing, speed_rpm=float(rpm), preload_N=preload, sound=False, kind=kind, **options
    )
    return with_fidelity(read_scene_text(text), model="rings")


@pytest.fixture(scope="module")
def scene():
    return fresh("NSK-7014C", 9000, 386.0)


def play(scene):
    return beside_full(scene.replace({"imperfections": None}).with_rigid_rings(), "rings").play


# (N across, share of the room): levels of rings are 1, 1, 9 and 21 dB(A) low at the worst microphone
@pytest.mark.heavy
@pytest.mark.parametrize(
    ("load", "low", "high"), [(0.0, 0.0, 0.01), (100.0, 0.0, 0.1), (200.0, 0.3, 0.7), (386.0, 0.98, 1.02)]
)
def test_balls_use_the_room_in_pockets_as_the_load_across_grows(scene, load, low, high):
    loaded = scene.replace({"mounting.radial_load_y_N": load})
    assert low <= max(play(loaded)) <= high
    said = doubt(loaded)
    assert ("strike the pockets" in said) == (load > 150.0)
    if said:
        assert is_of_levels(said) and said.endswith("take fidelity full") and "damping" not in said
    # the direction does not matter
    turned = scene.replace({"mounting.radial_load_z_N": -load})
    assert max(play(turned)) == pytest.approx(max(play(loaded)), abs=0.05)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("arrangement", "loads"), [("DB", {1.0: False, 200.0: True}), ("QBC", {150.0: True})]
)
def test_the_cages_of_a_set_are_looked_at_too(arrangement, loads):
    """A DB set of 7008C, 10,000 r/min, 150 N across: inner rings move by 0.69 to 0.88 of full."""
    pair = fresh("NSK-7008C", 10_000, None, arrangement=arrangement)
    for load, expected in loads.items():
        said = pockets_struck(pair.replace({"spindle.load.force_y_N": load}), "rings")
        assert ("strike the pockets of the cage of bearing" in said) == expected


def test_inputs_count_and_a_bearing_without_a_cage_has_no_pockets(scene):
    assert "strike the pockets" in doubt(scene, {"radial_load.y": 300.0})
    bare = scene.model_copy(update={"bearing": scene.bearing.model_copy(update={"cage": None})})
    assert play(bare.replace({"mounting.radial_load_y_N": 386.0})) == (0.0,)


# rms velocity of the inner ring along y, over full, of a longer run than that of the remark
@pytest.mark.heavy
@pytest.mark.parametrize(
    ("bearing", "rpm", "preload", "kind", "expected"),
    [
        ("NSK-7010C", 10_000, 280.0, "hybrid", (0.9, 1.1)),
        # a whirl that P4 surfaces start, and surfaces of a tenth do not: no growth in the linear equations
        ("NSK-7008AC", 20_000, 200.0, "steel", (0.0, 0.1)),
        ("NSK-7904AC", 37_900, 120.0, "steel", (0.0, 0.2)),
    ],
)
def test_rings_that_depart_from_full_are_named(bearing, rpm, preload, kind, expected):
    scene = fresh(bearing, rpm, preload, kind)
    name = "inner_ring.velocity.y"
    found = [
        simulate(with_fidelity(scene, model=model), 0.15, step=5e-5, outputs=[name], progress=False)[name]
        for model in ("rings", "full")
    ]
    ratio = found[0][1000:].std() / found[1][1000:].std()
    assert expected[0] <= ratio <= expected[1]
    for model in ("rings", "response"):
        said = rings_depart(scene, model)
        assert bool(said) == (ratio < 1.0 / FAR)
        text = doubt(with_fidelity(scene, model=model))
        assert is_of_motion(text) == bool(said)
    assert doubt(with_fidelity(scene, model="full")) == ""


@pytest.mark.heavy
def test_loads_are_in_doubt_where_rings_move_far_more_than_in_full(scene):
    """A linear answer to waves on a pedestal so soft that the load sinks the ring by 1 mm."""
    mounting = {"mounting.pedestal_stiffness_N_m": 6e5, "mounting.radial_load_z_N": -600.0}
    soft = fresh("NSK-7014AC", 9_000, 500.0, "steel").replace(mounting)
    soft = with_fidelity(soft, model="response")
    assert moves_far_more(soft, "response")
    text = doubt(soft)
    assert text.startswith("contact loads, levels and velocities of fidelity response are in doubt here")
    assert not is_of_motion(text) and not is_of_levels(text)


def test_a_perfect_bearing_is_not_compared(scene):
    """What moves in full there is the whirl of the cage."""
    perfect = scene.replace({"imperfections": None})
    run = beside_full(perfect.with_rigid_rings(), "response")
    assert (run.ratio, run.what) == (1.0, "") and doubt(perfect) == ""
    assert run.seconds == pytest.approx(0.05, abs=1e-3)  # three turns of the cage
    assert np.isfinite(run.play).all()


@pytest.mark.parametrize(
    ("radiation", "low", "high"), heavy_but([("compact", 8.0, 10.0), ("bem", 0.0, 0.5)], 0)
)
def test_a_loud_cage_is_named(radiation, low, high):
    """The rings shield it in bem alone: the 7009C in its spindle, with and without the cage's sound."""
    scene = read_scene(EXAMPLES / "7009C-spindle.toml").replace({"sound.radiation_model": radiation})
    loss = loss_without_cage(scene)
    assert low <= loss <= high
    said = doubt(with_fidelity(scene, model="rings"))
    assert ("the cage's own sound is left out" in said) == (loss > QUIETER)
    assert is_of_levels(said) == bool(said)


@pytest.mark.heavy
@pytest.mark.parametrize("arrangement", [None, "DB"])
@pytest.mark.parametrize("radiation", ["compact", "paper", "paper_vector"])
def test_a_silenced_cage_makes_no_sound_and_nothing_else_changes(arrangement, radiation):
    text = new_scene("one", "NSK-7008C", speed_rpm=10_000.0, arrangement=arrangement)
    scene = with_fidelity(read_scene_text(text), model="full").replace({"sound.radiation_model": radiation})
    runs = []
    for change in (lambda block: block, lambda block: silenced(block, "cage")):
        run = Arrays.of(scene, *map(change, sound_blocks(scene)))
        run.init()
        run.run(0.03, 1e-3)
        runs.append(run)
    (whole, rest), table = runs, {one.name: one.index for one in variables(scene, 0.0)}
    cage = table["mic[1].spl_cage"]
    assert rest.z[cage] < -106.0 < whole.z[cage] - 50.0  # -106 dB is silence
    for part in ("inner_ring", "outer_ring", "balls"):
        place = table[f"mic[1].spl_{part}"]
        assert rest.z[place] == whole.z[place]
