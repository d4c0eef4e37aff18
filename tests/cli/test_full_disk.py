"""A place without room: what was computed is printed first or kept elsewhere; the error names the place."""

import errno
import os
import zipfile

import pytest

from fmu_bearing import Recording, Run, files
from tests.marks import heavy_but

NO_ROOM = os.strerror(errno.ENOSPC).lower()


@pytest.fixture
def full(tmp_path, monkeypatch):
    """A folder on a full disk; that of temporary files is not."""
    folder = tmp_path / "full"
    folder.mkdir()
    whole = files.os.replace

    def refusing(source, target):
        if str(target).startswith(str(folder)):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(target))
        whole(source, target)

    monkeypatch.setattr(files.os, "replace", refusing)
    return folder


def test_a_run_is_not_lost(run, silent_file, full):
    done = run("simulate", silent_file, "-t", "0.002", "-o", full / "a.csv")
    assert done.exit_code == 2 and done.stdout == ""
    (line,) = done.stderr.splitlines()
    assert line.startswith(f"error: {full}/a.csv: {NO_ROOM}; what was computed is in ")
    assert len(Run.load(line.rpartition(" ")[2]).time) == 3


def test_a_recording_and_a_picture_that_were_there_stay(run, rings_file, full):
    out = full / "sound"
    out.mkdir()
    for name in ("recording.npz", "spectrum.png"):
        (out / name).write_text("old")
    quick = ("-t", "0.03", "--settle", "0.01", "--no-spread", "--no-directivity")
    done = run("sound", rings_file, *quick, "-o", out, "--force")
    assert done.exit_code == 2 and "recording.npz" in done.stderr.splitlines()[-1]
    assert (out / "recording.npz").read_text() == "old"


@pytest.mark.heavy
def test_the_run_of_a_report_is_kept_where_there_is_no_room_for_the_page(run, rings_file, full, tmp_path):
    kept = tmp_path / "kept.npz"
    done = run(
        "report", rings_file, "--duration", 0.05, "--settle", 0.01, "--no-changes", "-o", full / "a.html",
        "--keep", kept,
    )  # fmt: skip
    assert done.exit_code == 2 and "a.html" in done.stderr.splitlines()[-1]
    assert Recording.load(kept).size > 0


def test_an_fmu_is_not_lost(run, silent_file, full):
    """Neither the new one nor the one that it was to replace."""
    (full / "a.fmu").write_text("old")
    done = run("build", silent_file, "--flavour", "python", "-o", full / "a.fmu", "--force")
    assert done.exit_code == 2
    line = done.stderr.splitlines()[-1]
    assert line.startswith(f"error: cannot write {full}/a.fmu: {NO_ROOM}; what was computed is in ")
    assert line.endswith(" MB: make room, or name another file to write")
    kept = line.partition("what was computed is in ")[2].partition(";")[0]
    assert "modelDescription.xml" in zipfile.ZipFile(kept).namelist()
    assert [(path.name, path.read_text()) for path in full.iterdir()] == [("a.fmu", "old")]


def test_no_room_anywhere(tmp_path, monkeypatch):
    """No folder stays behind among the temporary files, and the first place is named."""
    monkeypatch.setattr(files.tempfile, "tempdir", str(tmp_path))

    def write(path):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    with pytest.raises(OSError, match=f"a: {NO_ROOM}, and as little room among the temporary files"):
        files.rescued(write, tmp_path / "a")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("words", "name", "said"),
    heavy_but([
        (("stiffness", "{scene}", "--frequencies", "100"), "k.csv", "K radial"),
        (("modes", "{scene}"), "", "what moves most"),
        (("fits", "{fitted}"), "f.csv", "preload, N, at speed"),
        (("realtime", "{scene}", "--fidelity", "response", "--duration", "0.01"), "r.csv", "mean, us"),
        (("error-motion", "{scene}", "--revolutions", "20"), "", "largest lines"),
        (("sensitivity", "{scene}", "--quick"), "", "what rests on assumed values"),
    ], 0, 3),
    ids=lambda words: words[0] if isinstance(words, tuple) else "",
)  # fmt: skip
@pytest.mark.parametrize("as_json", [(), ("--json",)], ids=["table", "json"])
def test_tables_are_printed_before_the_error(run, silent_file, fitted_file, full, words, name, said, as_json):
    filled = [word.format(scene=silent_file, fitted=fitted_file) for word in words]
    done = run(*filled, "-o", full / name if name else full, *as_json)
    assert done.exit_code == 2
    assert done.data if as_json else said in done.stdout
    last = done.stderr.splitlines()[-1]
    assert last.startswith(f"error: {full}/") and last.endswith(f": {NO_ROOM}")
    assert "written:" not in done.output
