"""The state of an FMU instance: complete, bound to its model; ``test_equality`` sends it to a new process."""

import hashlib
import zipfile
from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.fmi import resources
from fmu_bearing.fmi.package import build
from fmu_bearing.fmi.session import Session
from fmu_bearing.fmi.state import State, StateError
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene
from tests.conftest import GATES
from tests.native_builds import no_native_fmu

from .conftest import DISCARD, ERROR, OK, STEP, Master

_BODY = 20 + 3 * 32  # magic, hash of the engine, fingerprint, checksum


def test_continuing_after_restore_gives_the_same_bits(master):
    bearing, fresh = master(), master()
    assert bearing.set("imperfection.scale", 0.5) == OK
    bearing.start(preload=300.0)
    bearing.run(2)
    assert bearing.set("shaft_speed", 1500.0) == OK
    state = bearing.keep()
    after = bearing.run(3, 2 * STEP)
    assert bearing.put_back(state) == OK
    assert bearing.get("preload") == 300.0
    assert bearing.run(3, 2 * STEP) == after
    # and in an instance that was never initialised
    status, copy = fresh.from_bytes(bearing.to_bytes(state))
    assert status == fresh.put_back(copy) == OK
    assert fresh.get("imperfection.scale") == 0.5
    assert fresh.run(3, 2 * STEP) == after
    assert bearing.release(state) == fresh.release(copy) == OK


def test_going_back_200_steps_gives_the_same_bits(master):
    """Of motion, work space and sound filters: nothing is left over from the steps that were taken back."""
    bearing = master().start(preload=300.0)
    bearing.run(2)
    state = bearing.keep()
    after = bearing.run(200, 2 * STEP)
    assert bearing.put_back(state) == OK
    assert bearing.run(200, 2 * STEP) == after
    assert bearing.release(state) == OK


def test_state_before_initialisation_can_be_kept(master):
    bearing, other = master(), master().start(preload=300.0)
    assert bearing.set("preload", 300.0) == OK
    state = bearing.keep()
    bearing.start(preload=100.0).run(1)
    assert bearing.put_back(state) == OK
    assert bearing.start().run(2) == other.run(2)
    bearing.release(state)


def test_state_in_initialisation_can_be_kept(master):
    bearing, other = master(), master().start(preload=300.0)
    assert bearing.setup() == bearing.enter() == bearing.set("preload", 300.0) == OK
    assert bearing.get("contact.inner.load_mean") > 0.0
    state = bearing.keep()
    assert bearing.set("preload", 100.0) == bearing.exit() == OK
    bearing.run(1)
    assert bearing.put_back(state) == bearing.exit() == OK
    assert bearing.run(2) == other.run(2)
    bearing.release(state)


def test_refusals_belong_to_the_state(master, expected):
    bearing = master().start()
    good = bearing.keep()
    next_step = expected["call out of order"][1]
    assert (bearing.enter(), bearing.step(0.0)) == expected["call out of order"]
    bad = bearing.keep()
    assert bearing.put_back(good) == OK
    assert bearing.step(0.0) == OK
    assert bearing.put_back(bad) == OK
    assert bearing.step(0.0) == next_step
    assert bearing.release(good) == bearing.release(bad) == OK


@pytest.mark.parametrize("damage", ["flip", "short", "empty", "long", "version", "engine", "model"])
def test_foreign_or_damaged_state_is_refused(master, expected, damage, model):
    bearing = master().start()
    good = bearing.keep()
    data = bytearray(bearing.to_bytes(good))
    reason = "the state is damaged: its checksum does not hold"
    if damage == "flip":
        data[-9] ^= 1
    elif damage == "short":
        del data[-8:]
        reason = "the state is"  # cut off, or damaged
    elif damage == "empty":
        data, reason = bytearray(b"x"), "the"  # cut off, or no state at all
    elif damage == "long":
        data += bytes(64)
        reason = "the state is damaged"
    elif damage == "version":
        data[:9] = b"something"
        reason = "these bytes are not a state that this version of fmu-bearing can read"
    else:  # the same words of both builds, whose magic has 20 and 16 bytes
        start = (20 if data.startswith(b"fmu-bearing state") else 16) + (0 if damage == "engine" else 32)
        data[start] ^= 1
        reason = {
            "engine": "the state was made by another version of the engine, {has}, and this FMU has {own}: "
            "set it in the FMU that made it, or take a new one here",
            "model": "the state belongs to another model, {has}, and this is {own}: its scene is another, or "
            "was prepared by another version of fmu-bearing; set it in an FMU of that model, or take a new "
            "one here",
        }[damage]
        own = {"engine": engine_digest().hex(), "model": resources.fingerprint(model)}[damage]
        reason = reason.format(has=data[start : start + 8].hex(), own=own[:16])
    before = bearing.everything()
    answer, state = bearing.from_bytes(bytes(data))
    assert (state.value is None) == (answer == ERROR)
    if answer == OK:  # what is wrong comes out when the state is set
        assert bearing.put_back(state) == OK
        bearing.release(state)
    assert (answer, bearing.step(0.0)) == expected["damaged state"]
    assert f"state not taken: {reason}" in bearing.messages
    if answer == OK:
        assert bearing.everything() == before
    assert bearing.put_back(good) == OK
    assert bearing.everything() == before
    assert bearing.step(0.0) == OK
    bearing.release(good)


def test_state_of_one_build_is_not_that_of_the_other(unpack):
    # the numbers are the same, the layouts are not: said, not misread
    native, python = (Master(unpack(flavour)).start() for flavour in ("native", "python"))
    state = native.keep()
    answer, foreign = python.from_bytes(native.to_bytes(state))
    assert answer == python.put_back(foreign) == OK
    assert python.step(0.0) == DISCARD
    assert "not a state that this version of fmu-bearing can read" in python.messages
    own = python.keep()
    assert native.from_bytes(python.to_bytes(own))[0] == ERROR
    assert "not a state that this version of fmu-bearing can read" in native.messages
    assert native.release(state) == python.release(own) == OK
    native.free(), python.free()


def test_bytes_hold_every_bit(model):
    mark = resources.fingerprint(model)
    numbers = np.random.default_rng(1).standard_normal
    wrong = ((3, "preload = nan is refused: µ"), (-1, "x"))
    state = State(2, 0.1, numbers(8), numbers(7), numbers(50), numbers(1000), settled=True, wrong=wrong)
    back = State.from_bytes(state.to_bytes(mark), mark)
    assert (back.phase, back.time, back.settled, back.wrong) == (2, 0.1, True, wrong)
    for name in ("inputs", "tunables", "outputs", "engine"):
        assert np.array_equal(getattr(back, name), getattr(state, name))
    with pytest.raises(StateError, match="another model"):
        State.from_bytes(state.to_bytes(mark), mark[::-1])


@pytest.mark.parametrize("change", [64, -64, -8])
def test_state_of_another_length_is_refused_whatever_its_checksum(model, change):
    mark = resources.fingerprint(model)
    whole = Session(model, lambda *_: None).state().to_bytes(mark)
    body = whole[_BODY:] + bytes(change) if change > 0 else whole[_BODY:change]
    with pytest.raises(StateError, match=rf"it has {len(body)} bytes, its arrays take {len(whole) - _BODY}"):
        State.from_bytes(whole[: _BODY - 32] + hashlib.sha256(body).digest() + body, mark)
    short = hashlib.sha256(b"").digest()
    with pytest.raises(StateError, match="cut off"):
        State.from_bytes(whole[: _BODY - 32] + short, mark)


@pytest.mark.parametrize("part", ["inputs", "tunables", "outputs", "engine", "phase"])
def test_arrays_of_other_lengths_are_refused_and_nothing_is_taken(model, part):
    session = Session(model, lambda *_: None)
    before = session.state()
    # one number more in one array, and one changed in another, which must not arrive
    inputs = before.inputs + 1.0
    wrong = 77 if part == "phase" else np.append(inputs if part == "inputs" else getattr(before, part), 0.0)
    with pytest.raises(StateError, match="no phase" if part == "phase" else "other lengths"):
        session.restore(replace(before, **({"inputs": inputs} | {part: wrong})))
    mark = resources.fingerprint(model)
    assert session.state().to_bytes(mark) == before.to_bytes(mark)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_refused_step_deep_in_a_run_up_leaves_the_bits(fidelity, tmp_path):
    """Up to 31 steps of 1 ms are repeated from one copy of the state, with all renewals that they took."""
    scene = read_scene(GATES / "7003C-bare.toml").model_copy(update={"sound": None})
    try:
        path = build(prepare(scene, fidelity=fidelity), tmp_path / "bare.fmu", "native").path
    except BuildError as problem:
        no_native_fmu(problem)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path / "in")
    one, other = (Master(tmp_path / "in").start() for _ in range(2))
    stiffness = one.get("pedestal_stiffness")
    for i in range(40):
        for bearing in (one, other):
            assert bearing.set("shaft_speed", 1600.0 + 10.0 * i) == OK
        if i in (20, 21, 38):
            assert one.set("pedestal_stiffness", 1e4) == one.set("radial_load.z", 300.0) == OK
            assert one.step(1e-3 * i, 1e-3) == DISCARD, one.messages
            assert one.set("pedestal_stiffness", stiffness) == one.set("radial_load.z", 0.0) == OK
        for bearing in (one, other):
            assert bearing.step(1e-3 * i, 1e-3) == OK
        assert one.everything() == other.everything()
    for bearing in (one, other):
        bearing.free()
