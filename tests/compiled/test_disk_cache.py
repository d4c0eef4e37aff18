"""The user's cache: damaged files, no room, no right to write, two processes at once."""

import errno
import os
import subprocess
import sys

import pytest

from fmu_bearing import files
from fmu_bearing.compiled import disk_cache, make
from fmu_bearing.compiled.platforms import own

DATA = b"machine code" * 100
_COMPILE = """
import pathlib, sys, time
from fmu_bearing.compiled import make
from fmu_bearing.compiled.platforms import own
log = pathlib.Path(sys.argv[1])

def run(due, codes, display):
    with log.open("a") as file:
        file.write("compiled\\n")
    time.sleep(1.5)
    return {f"step-{own().name}-v0.o": b"made once"}

make._run = run
print(make.objects(own(), ["step"], ["v0"])["step", "v0"].decode())
"""


@pytest.fixture
def reported():
    return []


def test_what_was_written_is_read(tmp_path, reported):
    path = tmp_path / "new folder" / "step.o"
    assert disk_cache.read(path, reported.append) is None
    assert disk_cache.write(path, DATA, reported.append)
    assert disk_cache.read(path, reported.append) == DATA
    assert not reported


def beside(path):
    return path.with_name(path.name + ".sha256")


@pytest.mark.parametrize(
    "damage",
    [
        lambda path: path.write_bytes(DATA[:-1]),
        lambda path: path.write_bytes(DATA[:7] + b"X" + DATA[8:]),
        lambda path: path.write_bytes(b""),
        lambda path: beside(path).write_bytes(b"\xff\xfe"),
        lambda path: beside(path).unlink(),
    ],
    ids=["cut short", "one byte", "empty", "checksum", "no checksum"],
)
def test_a_damaged_file_is_reported_and_never_used(tmp_path, reported, damage):
    path = tmp_path / "step.o"
    disk_cache.write(path, DATA, reported.append)
    damage(path)
    assert disk_cache.read(path, reported.append) is None
    (line,) = reported
    assert str(path) in line
    assert "damaged" in line
    assert disk_cache.write(path, DATA, reported.append)  # made again in its place
    assert disk_cache.read(path, reported.append) == DATA
    assert len(reported) == 1


def test_a_file_that_cannot_be_read_is_reported(tmp_path, reported):
    path = tmp_path / "step.o"
    path.mkdir()  # refused for the super-user too
    assert disk_cache.read(path, reported.append) is None
    assert reported == [
        f"the kept file {path} cannot be read ({os.strerror(errno.EISDIR)}): it is made again"
    ]


def test_who_reads_while_a_file_is_written_sees_no_damage(tmp_path, reported, monkeypatch):
    path, found = tmp_path / "step.o", []

    def write_and_read(one, data):
        files.write_whole(one, data)
        found.append(disk_cache.read(path, reported.append))

    monkeypatch.setattr(disk_cache, "write_whole", write_and_read)
    disk_cache.write(path, DATA, reported.append)
    assert found == [None, DATA]
    assert not reported


class _NoLocks(disk_cache.FileLock):
    """A lock on a file system that has none, as earlier versions of `FileLock` meet it."""

    def acquire(self, *arguments, **named):
        raise NotImplementedError("FileSystem does not appear to support flock")


def test_a_folder_without_locks_is_used_without_one(tmp_path, reported, monkeypatch):
    monkeypatch.setattr(disk_cache, "FileLock", _NoLocks)
    with pytest.raises(KeyError) as found, disk_cache.alone(tmp_path / "new", reported.append):
        raise KeyError("of the work done there")
    assert found.value.__context__ is None  # the missing lock is no part of that failure
    assert not reported


def test_what_fails_beside_the_lock_is_not_taken_for_a_missing_lock(tmp_path):
    def broken(text):
        raise BrokenPipeError

    with disk_cache.FileLock(tmp_path / "lock"), pytest.raises(BrokenPipeError):
        with disk_cache.alone(tmp_path, broken):
            pytest.fail("went on without the lock that another holds")


def test_a_full_disk_is_reported_and_nothing_half_remains(tmp_path, reported, monkeypatch):
    def no_room(descriptor, *arguments, **named):
        os.close(descriptor)
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(files.os, "fdopen", no_room)
    assert not disk_cache.write(tmp_path / "step.o", DATA, reported.append)
    (line,) = reported
    assert "step.o" in line
    assert os.strerror(errno.ENOSPC) in line
    assert "FMU_BEARING_CACHE" in line
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written_kernels_are_used_all_the_same(tmp_path, monkeypatch, capfd):
    """No folder can be made below a file: like a read-only home, also for the super-user."""
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path / "file" / "cache"))
    name = f"step-{own().name}-v0.o"
    monkeypatch.setattr(make, "_run", lambda due, codes, display: {name: DATA})
    assert make.objects(own(), ["step"], ["v0"]) == {("step", "v0"): DATA}
    assert f"{name} cannot be kept in {tmp_path}" in capfd.readouterr().err


def test_two_processes_compile_once(tmp_path):
    """The second waits for the first, says so, and reads what that one made."""
    log = tmp_path / "log"
    environment = {**os.environ, "FMU_BEARING_CACHE": str(tmp_path / "cache")}
    running = [
        subprocess.Popen(
            [sys.executable, "-c", _COMPILE, str(log)], env=environment, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )
        for _ in range(2)
    ]  # fmt: skip
    answers = [process.communicate(timeout=60) for process in running]
    assert [process.returncode for process in running] == [0, 0], answers
    assert [out.strip() for out, _ in answers] == ["made once"] * 2
    assert log.read_text().splitlines() == ["compiled"]


def test_objects_of_other_sources_or_compilers_lie_elsewhere(monkeypatch):
    here = make.folder()
    monkeypatch.setattr(make, "version", lambda name: f"{name} of tomorrow")
    assert make.folder() != here
    monkeypatch.undo()
    monkeypatch.setattr(make, "sources_key", lambda: "0" * 64)
    assert make.folder() != here


def test_the_key_does_not_know_the_place_of_the_installation(tmp_path):
    """A copy elsewhere, as in a wheel, finds what this one compiled."""
    import shutil

    from fmu_bearing import __file__ as package

    shutil.copytree(
        os.path.dirname(package), tmp_path / "fmu_bearing", ignore=shutil.ignore_patterns("__pycache__")
    )
    code = "import fmu_bearing.compiled.make as m; print(m.__file__); print(m.folder().name)"
    ran = subprocess.run(
        [sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(tmp_path)}, cwd=tmp_path,
        capture_output=True, text=True, check=True, timeout=600,
    )  # fmt: skip
    place, name = ran.stdout.split()
    assert place.startswith(str(tmp_path))
    assert name == make.folder().name
