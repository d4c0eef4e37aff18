"""The state of an instance: complete, portable, bound to its model, refused where it is not whole."""

import ctypes
import hashlib
import subprocess

import pytest

from tests.messages import says

from . import toy
from .master import ERROR, OK

HEAD = 16 + 3 * 32  # magic, hash of the kernels, fingerprint, checksum


def test_continuing_after_restore_gives_the_same_bits(master):
    one, fresh = master(), master()
    assert one.set("gain", 2.0) == OK
    one.start(load=60.0).run(2)
    assert one.set("speed", 9.0) == one.rate("load", 3.0) == OK
    state = one.keep()
    expected = one.run(3, 0.2)
    assert one.put_back(state) == OK
    assert one.run(3, 0.2) == expected
    status, copy = fresh.from_bytes(one.to_bytes(state))
    assert status == fresh.put_back(copy) == OK
    assert fresh.get("gain") == 2.0
    assert fresh.run(3, 0.2) == expected
    assert one.release(state) == fresh.release(copy) == OK
    assert state.value is None


@pytest.mark.parametrize("settled", [False, True])
def test_state_in_initialisation(master, settled):
    one, other = master(), master().start(load=80.0)
    assert one.setup() == one.enter() == one.set("load", 80.0) == OK
    if settled:
        assert one.get("load_held") == 80.0
    state = one.keep()
    assert one.set("load", 10.0) == one.exit() == OK
    one.run(1)
    assert one.put_back(state) == OK
    assert one.exit() == OK
    assert one.run(2) == other.run(2)
    one.release(state)


def test_block_is_used_again(master):
    one = master().start()
    state = one.keep()
    place = state.value
    one.run(2)
    expected = one.everything()
    assert one.call("GetFMUstate", ctypes.byref(state)) == OK
    assert state.value == place
    one.run(1, 0.2)
    assert one.put_back(state) == OK
    assert one.everything() == expected
    one.release(state)


def test_same_state_gives_the_same_bytes(master):
    one, other = master().start(), master().start()
    one.run(3), other.run(3)
    assert one.to_bytes(one.keep()) == other.to_bytes(other.keep())


@pytest.mark.parametrize(
    "damage", ["flip", "phase", "short", "tiny", "empty", "long", "twice", "version", "kernels", "model"]
)
def test_foreign_or_damaged_state_is_refused(master, damage):
    one = master().start()
    one.run(1)
    data = bytearray(one.to_bytes(one.keep()))
    reason = "checksum does not hold"
    if damage == "flip":
        data[-3] ^= 1
    elif damage == "phase":
        data[HEAD + 8] = 77
        data[HEAD - 32 : HEAD] = hashlib.blake2b(data[HEAD:], digest_size=32).digest()
        reason = "no phase"
    elif damage in ("short", "tiny", "empty"):
        del data[{"short": -8, "tiny": 20, "empty": 0}[damage] :]
        reason = "cut off"
    elif damage in ("long", "twice"):
        data += bytes(64 if damage == "long" else data)
        reason = "it has more bytes than this model's"
    elif damage == "version":
        data[14] ^= 3
        reason = "not a state that this version"
    elif damage == "kernels":
        data[16] ^= 1
        reason = f"another version of the engine, {data[16:24].hex()} ... {toy.KERNELS[:16]} ... set it in"
    else:
        data[48] ^= 1
        reason = f"another model, {data[48:56].hex()} ... {toy.CONTENTS.fingerprint[:16]} ... set it in"
    before = one.everything()
    status, state = one.from_bytes(bytes(data))
    assert status == ERROR
    assert state.value is None
    assert "state not taken" in one.messages
    assert says(one.messages, reason)
    assert one.everything() == before
    assert one.step(0.1) == OK


def test_every_flipped_bit_is_noticed(master):
    one = master().start()
    data = one.to_bytes(one.keep())
    for place in range(len(data)):
        changed = bytearray(data)
        changed[place] ^= 1 << place % 8
        assert one.from_bytes(bytes(changed))[0] == ERROR, place


def test_state_of_another_model_is_refused(master, tmp_path):
    mark = hashlib.sha256(b"other").hexdigest()
    one, other = master().start(), master(toy.write_model(tmp_path, fingerprint=mark)).start()
    state = one.keep()
    assert other.put_back(state) == ERROR
    assert "another model" in other.messages
    assert other.call("GetFMUstate", ctypes.byref(state)) == ERROR
    assert other.step(0.0) == OK
    one.release(state)


def test_room_too_small_for_the_bytes(master):
    one = master().start()
    state = one.keep()
    buffer = ctypes.create_string_buffer(1000)
    assert one.call("SerializeFMUstate", state, buffer, len(one.to_bytes(state)) - 1) == ERROR
    assert "not enough room" in one.messages
    assert buffer.raw == bytes(1000)
    assert one.step(0.0) == OK


def test_another_process_continues_with_the_same_bits(host, library, resources, tmp_path):
    command = [str(host), str(library), toy.GUID, resources.as_uri()]
    file, shown = str(tmp_path / "state.bin"), "get:4,5,9"
    first = [*command, "start:1.5", "set:0:7.25", "step:0.1:3", f"save:{file}", "step:0.1:2", shown]
    second = [*command, f"load:{file}", "time:1.8", "step:0.1:2", shown]
    answers = [subprocess.run(one, capture_output=True, text=True, timeout=600) for one in (first, second)]
    assert [answer.returncode for answer in answers] == [0, 0], answers
    assert answers[0].stdout == answers[1].stdout
    assert len(answers[0].stdout.split()) == 3
