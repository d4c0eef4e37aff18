"""Paths that are no plain files are refused with a line that names them, by all that reads a user's files."""

import gc
import importlib.util
import os
import signal
import warnings

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import Recording, audio, cli, identify, read_scene, record, report, simulate
from fmu_bearing.acoustics.radiation.table import read_table
from fmu_bearing.dataset import read_plan
from fmu_bearing.results.result import Run
from fmu_bearing.run.input_file import read_inputs
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.entries import using
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.sweeps.description import read_description
from fmu_bearing.validation.run import validate
from tests.conftest import EXAMPLES
from tests.marks import heavy_but

SCENE = EXAMPLES / "7003C-bare.toml"


def from_catalogue(path):
    with using([path]):
        read_scene(SCENE)


READERS = {
    "scene": (read_scene, ".toml"),
    "catalogue": (from_catalogue, ".toml"),
    "sweep": (read_description, ".toml"),
    "data set": (read_plan, ".toml"),
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
            "/dev/zero: cannot be read: it is a pipe or a device",
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


@pytest.fixture(scope="module")
def sound_files(tmp_path_factory):
    """A good file of each kind that a library reads."""
    folder = tmp_path_factory.mktemp("good")
    scene = with_fidelity(read_scene(SCENE), model="rings")
    scene = scene.model_copy(update={"sound": scene.sound.model_copy(update={"radiation_model": "compact"})})
    run = simulate(scene, 4e-3, outputs=["outer_ring.velocity.*", "friction_torque"])
    run.save(folder / "it.csv")
    if importlib.util.find_spec("xarray") and importlib.util.find_spec("h5netcdf"):
        run.save(folder / "it.nc")
    record(scene, 0.01, settle=0.0).save(folder / "it.npz")
    audio.write_wav(folder / "it.wav", np.sin(np.arange(500.0)), 48000.0)
    count = 5
    np.savez(
        folder / "table.npz", frequencies=np.linspace(0.0, 2e4, count), inputs=["outer_ring.acceleration.z"],
        microphones=["P1"], positions=np.zeros((1, 3)), H=np.ones((1, 1, count), complex),
    )  # fmt: skip
    return folder


def damages(data, count):
    """Copies of a file with damages as of disks, transfers and editors; the same ones each time."""
    draw = np.random.default_rng(7)
    for k in range(count):
        made = bytearray(data)
        at = int(draw.integers(len(made)))
        # the heads of archives and of netCDF lie at the ends of the file, where damage does most
        near = at % min(len(made), 600)
        at = (near, len(made) - 1 - near, at)[k % 3]
        kind = k % 5
        if kind == 0:
            made[at] ^= int(draw.integers(1, 256))
        elif kind == 1:
            del made[at:]
        elif kind == 2:
            made[at : at + 64] = bytes(len(made[at : at + 64]))
        elif kind == 3:
            made[at:at] = draw.bytes(9)
        else:
            made[at : at + 40] = draw.bytes(len(made[at : at + 40]))
        yield k, bytes(made)


@pytest.mark.parametrize(
    ("file", "read"),
    heavy_but(
        [("it.csv", Run.load), ("it.nc", Run.load), ("it.npz", Recording.load), ("it.wav", audio.read_wav),
         ("table.npz", read_table)],
        2,
    ),
    ids=["csv", "netcdf", "recording", "wav", "table"],
)  # fmt: skip
@pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning")  # it would print a traceback
def test_damaged_files_are_refused_in_one_line(file, read, sound_files, tmp_path, few_objects):
    """Whatever a library raises; some damages change nothing that is read."""
    if not (sound_files / file).exists():
        pytest.skip("No module named 'xarray' or 'h5netcdf'")
    read(sound_files / file)
    refused = 0
    for number, data in damages((sound_files / file).read_bytes(), 100):
        path = tmp_path / f"{number}{path_suffix(file)}"
        path.write_bytes(data)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                read(path)
        except ValueError as refusal:
            refused += 1
            assert str(path) in str(refusal) and "\n" not in str(refusal), (number, refusal)
    assert refused >= 20  # of 100: bytes between numbers are many in CSV, and hold nothing in WAV


@pytest.fixture
def few_objects():
    """What other tests have left in memory is not searched at each refusal: a minute in a long run."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


def path_suffix(name):
    return name[name.index(".") :]


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"time,a\n", "holds no values"),
        ("time,a\n0,1\n".encode("utf-32"), "it is UTF-32: save it as UTF-8"),
        ("time,a\n0,1".encode("utf-16")[:-1], "it is UTF-16: save it as UTF-8"),
    ],
    ids=["head", "utf-32", "half a character"],
)
def test_tables_that_hold_nothing_readable(data, said, tmp_path):
    (tmp_path / "it.csv").write_bytes(data)
    for read in (Run.load, lambda path: read_inputs(path, {})):
        with pytest.raises(ValueError, match=said):
            read(tmp_path / "it.csv")


def test_the_command_refuses_a_damaged_file_with_its_code(tmp_path):
    (tmp_path / "it.nc").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(200))
    done = CliRunner().invoke(cli.app, ["plot", str(tmp_path / "it.nc"), "-o", str(tmp_path / "a.png")])
    assert done.exit_code == 2
    # a loaded machine shows the time that has passed on lines of their own
    (line,) = (one for one in done.stderr.splitlines() if ": after " not in one)
    assert line.startswith("error: ")
