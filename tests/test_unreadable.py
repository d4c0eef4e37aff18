"""Paths that are no plain files are refused with a line that names them, by all that reads a user's files."""

import os
import signal

import pytest

from fmu_bearing import Recording, audio, identify, read_scene, report, simulate
from fmu_bearing.acoustics.radiation.table import read_table
from fmu_bearing.results.result import Run
from fmu_bearing.run.input_file import read_inputs
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.entries import using
from fmu_bearing.sweeps.description import read_description
from fmu_bearing.validation.run import validate
from tests.conftest import EXAMPLES

SCENE = EXAMPLES / "7003C-bare.toml"


def from_catalogue(path):
    with using([path]):
        read_scene(SCENE)


READERS = {
    "scene": (read_scene, ".toml"),
    "catalogue": (from_catalogue, ".toml"),
    "sweep": (read_description, ".toml"),
    "table": (read_table, ".npz"),
    "recording": (Recording.load, ".npz"),
    "report": (lambda path: report(path, path.with_name("page.html")), ".npz"),
    "inputs": (lambda path: read_inputs(path, {}), ".csv"),
    "data": (lambda path: identify(SCENE, path, ["mounting.preload_N"]), ".csv"),
    "result": (Run.load, ".csv"),
    "netcdf": (Run.load, ".nc"),
    "fmu": (lambda path: simulate(path, 1e-3), ".fmu"),
    "validate": (validate, ".fmu"),
    "sound": (audio.read_wav, ".wav"),
}


@pytest.fixture
def in_time():
    """Who waits for a pipe is woken, and fails."""

    def wake(*_):
        raise TimeoutError("it hangs")

    before = signal.signal(signal.SIGALRM, wake)
    signal.alarm(20)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.fixture
def place(tmp_path, request):
    """A path that is no plain file, with an ending of its reader."""

    def made(kind, suffix):
        path = tmp_path / f"it{suffix}"
        if kind == "pipe":
            os.mkfifo(path)
        elif kind == "device":
            path.symlink_to("/dev/zero")
        elif kind == "folder":
            path.mkdir()
        elif kind == "circle":
            path.symlink_to(path)
        elif kind == "long":
            path = tmp_path / ("x" * 300 + suffix)
        elif kind == "NUL":
            path = tmp_path / f"it\0{suffix}"
        return path

    return made


@pytest.mark.parametrize("kind", ["pipe", "device", "folder", "circle", "long", "NUL", "none"])
@pytest.mark.parametrize("reader", READERS)
@pytest.mark.usefixtures("in_time")
def test_what_is_no_plain_file_is_refused_by_name(reader, kind, place):
    read, suffix = READERS[reader]
    path = place(kind, suffix)
    with pytest.raises(ValueError) as refusal:
        read(path)
    said = str(refusal.value)
    # a link to a catalogue is followed first: one that is named twice is read once
    assert (str(path) if (reader, kind) != ("catalogue", "device") else "/dev/zero") in said
    words = {
        "pipe": "pipe or a device",
        "device": "pipe or a device",
        "folder": "folder",
        "circle": "levels of symbolic links",
        "long": "name too long",
        "NUL": "NUL",
        "none": "o such",
    }
    assert words[kind] in said


@pytest.mark.parametrize("reader", ["scene", "catalogue", "sweep", "inputs", "data"])
@pytest.mark.usefixtures("in_time")
def test_endless_text_is_not_read(reader, tmp_path):
    read, suffix = READERS[reader]
    path = tmp_path / f"it{suffix}"
    with path.open("wb") as file:
        file.truncate(1 << 40)  # takes no room on the disk
    with pytest.raises(ValueError, match=rf"it{suffix}.*1.1e\+06 MB; allowed: up to 1"):
        read(path)


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        (
            'name = "7003C-bare"',
            'name = "a"\ncatalogues = ["a\\u0000b"]',
            r"catalogues: 'a\\x00b' is refused",
        ),
        ("[sound]", '[sound]\ntable_file = "a\\u0000b"', r"sound.table_file = 'a\\x00b' is refused"),
        (
            'name = "7003C-bare"',
            'name = "a"\ncatalogues = ["/dev/zero"]',
            "/dev/zero: cannot be read as a cat",
        ),
    ],
)
@pytest.mark.usefixtures("in_time")
def test_names_in_a_scene(before, after, said, tmp_path):
    text = SCENE.read_text("utf-8")
    assert before in text
    (tmp_path / "scene.toml").write_text(text.replace(before, after, 1))
    with pytest.raises(SceneError, match=said):
        read_scene(tmp_path / "scene.toml")
