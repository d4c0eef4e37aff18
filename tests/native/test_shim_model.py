"""The file of the model: found wherever the host says it is, and refused where it is not whole."""

import hashlib
import shutil
import struct
from dataclasses import replace
from urllib.parse import quote

import numpy as np
import pytest

from fmu_bearing.fmi.native.model_file import Contents, contents_bytes

from . import toy
from .master import ERROR, OK

FOLDERS = "plain;with blank;grün-è-日本;a#b;a+b;100%;a%20b;a%zz;q?x=1&y;b,c=d@e!".split(";")


@pytest.mark.parametrize("folder", FOLDERS)
def test_folders_of_any_name(master, resources, tmp_path, folder):
    place = tmp_path / folder / "resources"
    shutil.copytree(resources, place)
    encoded = quote(str(place))
    locations = [f"file://{encoded}", f"file:{encoded}", f"file://localhost{encoded}", f"FILE://{encoded}/"]
    locations += [str(place), f"{place}/", f"file://{place}", f"file:{place}"]
    for location in locations:
        one = master(location)
        assert one.instance, (location, one.messages)
        one.start().run(1)


def test_relative_folder(master, resources, tmp_path, monkeypatch):
    shutil.copytree(resources, tmp_path / "here" / "resources")
    monkeypatch.chdir(tmp_path / "here")
    assert master("resources").start().step(0.0) == OK
    assert master("file:resources").start().step(0.0) == OK


@pytest.mark.parametrize(
    ("location", "words"),
    [
        (None, "no resource location"),
        ("", "no resource location"),
        ("http://example.org/resources", "http://example.org/resources is neither a file: URI nor a path"),
        ("file:///no/such/place", "cannot open /no/such/place/model.bin (resource location file:///no/such"),
        ("file:///a%00b", "cannot open"),
        ("file:", "cannot open model.bin"),
        ("%", "cannot open %/model.bin"),
        ("file:///%s%n%d", "%s%n%d/model.bin"),
        ("a#b##c", "cannot open a#b##c/model.bin"),
        ("file:///" + "x" * 100_000, "x" * 100_000 + "/model.bin"),
    ],
    ids=lambda value: str(value)[:30],
)
def test_location_that_leads_nowhere_is_named(master, location, words):
    one = master(location)
    assert one.instance is None
    assert one.log[-1][:2] == (ERROR, "logStatusError")
    # a message is a format, in which # begins a reference to a variable: both are given twice
    assert words.replace("%", "%%").replace("#", "##") in one.messages


def test_reason_is_said_even_with_logging_off(master):
    assert "cannot instantiate" in master("file:///no/such/place", logging=False).messages


def written(tmp_path, data):
    (tmp_path / "model.bin").write_bytes(data)
    return tmp_path


def sealed(data):
    """The same file with the right checksum."""
    body = data[48:]
    return data[:16] + hashlib.blake2b(body, digest_size=32).digest() + body


GOOD = contents_bytes(toy.CONTENTS)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "too short"),
        (GOOD[:100], "too short"),
        (GOOD[:-8], "damaged or cut off"),
        (GOOD + b"\0" * 8, "damaged or cut off"),
        (b"x" + GOOD[1:], "not a model file"),
        (GOOD[:8] + struct.pack("<Q", 2) + GOOD[16:], "another version"),
        (sealed(GOOD + b"\0" * 8), "do not fit together"),
        (contents_bytes(replace(toy.CONTENTS, kernels="ab" * 32)), "other equations"),
    ],
)
def test_file_that_is_not_whole_is_refused(master, tmp_path, data, words):
    one = master(written(tmp_path, data))
    assert one.instance is None
    assert f"{tmp_path}/model.bin cannot be used: " in one.messages
    assert words in one.messages


def test_folder_in_place_of_the_file(master, tmp_path):
    (tmp_path / "model.bin").mkdir()
    one = master(tmp_path)
    assert one.instance is None
    assert "model.bin" in one.messages


def test_changed_byte_is_noticed(master, tmp_path):
    for place in range(0, len(GOOD), 7):
        changed = bytearray(GOOD)
        changed[place] ^= 0x10
        one = master(written(tmp_path, bytes(changed)))
        assert one.instance is None, place
        assert "cannot be used" in one.messages, place


def head(**fields):
    """The file with fields of the head changed, and the right checksum."""
    names = "p u s z w tunables time tolerance ramped journal span".split()
    names += "variables reasons cautions categories text guid".split()
    changed = bytearray(GOOD)
    for name, value in fields.items():
        struct.pack_into("<Q", changed, 112 + 8 * names.index(name), value)
    return sealed(bytes(changed))


@pytest.mark.parametrize(
    "field",
    "p u s z w tunables time tolerance journal variables reasons cautions categories text guid".split(),
)
@pytest.mark.parametrize("value", [2**20, 2**32, 2**61, 2**63, 2**64 - 2])
def test_numbers_of_the_head_are_not_believed(master, tmp_path, field, value):
    if field in ("s", "z", "w") and value == 2**20:
        pytest.skip("such an array would be possible")
    one = master(written(tmp_path, head(**{field: value})))
    assert one.instance is None
    assert "do not fit together" in one.messages


@pytest.mark.parametrize("field", "p u journal variables reasons cautions categories text".split())
def test_counts_that_leave_something_over_are_refused(master, tmp_path, field):
    one = master(written(tmp_path, head(**{field: 0})))
    assert one.instance is None


VARIABLES = 112 + 19 * 8 + 8 * (3 + 4)


@pytest.mark.parametrize("place", range(8))
def test_places_of_variables_are_not_believed(master, tmp_path, place):
    changed = bytearray(GOOD)
    struct.pack_into("<I", changed, VARIABLES + 56 * 4 + 4 * place, 100_000)
    one = master(written(tmp_path, sealed(bytes(changed))))
    assert one.instance is None
    assert "do not fit together" in one.messages


def test_inputs_stand_among_the_inputs(master, tmp_path):
    # rates of inputs have places for those only
    changed = bytearray(GOOD)
    struct.pack_into("<I", changed, VARIABLES + 4 * 3, 2)
    assert master(written(tmp_path, sealed(bytes(changed)))).instance is None


@pytest.mark.parametrize("count", range(34))
def test_files_of_every_length(master, tmp_path, count):
    # the checksum works in blocks of 128 bytes
    parameters = [1e-3, 1.0, *np.linspace(0.0, 1.0, count)]
    one = master(toy.write_model(tmp_path, parameters=parameters))
    assert one.start().get("sizes") == count + 2 + 4 + 5 + 7 + 2


def test_model_without_anything(master, tmp_path):
    nothing = Contents(
        guid="x",
        kernels=toy.KERNELS,
        fingerprint="00" * 32,
        parameters=[1e-3, 1.0],
        inputs=[0.0] * 4,
        state_size=5,
        output_size=7,
        work_size=1,
        time=1,
        tunables=0,
        variables=(),
    )
    (tmp_path / "model.bin").write_bytes(contents_bytes(nothing))
    one = master(tmp_path, guid="x", references={})
    assert one.setup(tolerance=5.0) == one.enter() == one.exit() == one.step(0.0) == OK
    assert one.read(0)[0] == ERROR


@pytest.mark.parametrize("value", ["00", "zz" * 32, "0" * 63])
def test_writer_wants_whole_hashes(value):
    with pytest.raises(ValueError):
        contents_bytes(replace(toy.CONTENTS, kernels=value))


def test_writer_refuses_a_zero_character():
    with pytest.raises(ValueError, match="zero character"):
        contents_bytes(replace(toy.CONTENTS, guid="a\0b"))


def test_same_contents_give_the_same_bytes():
    assert contents_bytes(toy.CONTENTS) == GOOD
    assert len(GOOD) % 8 == 0
