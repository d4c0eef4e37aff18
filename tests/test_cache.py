"""The cache holds code: it is this user's own, or refused with the reason and the way out."""

import os
import pwd
import stat
import subprocess
import sys
import tempfile

import pytest

from fmu_bearing import files
from fmu_bearing.compiled import disk_cache, make
from fmu_bearing.compiled.platforms import own
from fmu_bearing.files import CacheError, cache_root, own_folder, read_own

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there the rights of the profile hold")

WAY_OUT = "name a folder of your own in FMU_BEARING_CACHE"


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder that the environment names."""
    made = tmp_path / "cache"
    made.mkdir(0o700)
    monkeypatch.setenv("FMU_BEARING_CACHE", str(made))
    return made


@pytest.fixture
def somebody_else(monkeypatch):
    """All files are another user's."""
    number = os.geteuid()
    monkeypatch.setattr(files.os, "geteuid", lambda: number + 54321)


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


@pytest.mark.parametrize("rights", [0o777, 0o1777, 0o775, 0o702])
def test_a_place_that_others_can_write_to_is_refused(place, rights):
    place.chmod(rights)
    with pytest.raises(CacheError) as refusal:
        cache_root()
    said = str(refusal.value)
    assert f"{place} is refused" in said and f"(mode {rights:o})" in said and WAY_OUT in said
    place.chmod(0o755)  # others may read
    assert cache_root() == place


@pytest.mark.usefixtures("somebody_else")
def test_a_place_of_another_user_is_refused(place):
    owner = pwd.getpwuid(place.stat().st_uid).pw_name
    with pytest.raises(CacheError, match=f"{place} is refused, .*: user {owner} owns it, .*; {WAY_OUT}"):
        cache_root()


def test_a_place_that_everybody_can_replace_is_refused(tmp_path, monkeypatch):
    shared = tmp_path / "shared"
    shared.mkdir()
    monkeypatch.setenv("FMU_BEARING_CACHE", str(shared / "mine"))
    shared.chmod(0o777)
    with pytest.raises(CacheError, match=f"mine is refused: everybody can replace it in {shared}; {WAY_OUT}"):
        cache_root()
    shared.chmod(0o1777)  # as /tmp: the sticky bit leaves renaming to the owner
    assert cache_root() == shared / "mine"


def test_what_is_made_is_this_user_s_alone_whatever_the_mask(tmp_path, monkeypatch):
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path / "a" / "cache"))
    before = os.umask(0)
    try:
        folder = make.folder()
        assert disk_cache.write(folder / "step.o", b"code", pytest.fail)
    finally:
        os.umask(before)
    assert {mode(one) for one in (tmp_path / "a", tmp_path / "a" / "cache", folder)} == {0o700}
    assert mode(folder / "step.o") == 0o644
    assert disk_cache.read(folder / "step.o", pytest.fail) == b"code"


def test_without_a_home_the_cache_is_a_private_temporary_folder(tmp_path, monkeypatch):
    def nobody(number):
        raise KeyError(number)

    for name in ("FMU_BEARING_CACHE", "XDG_CACHE_HOME", "LOCALAPPDATA", "HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(pwd, "getpwuid", nobody)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    wanted = tmp_path / f"fmu-bearing-{os.geteuid()}"
    assert cache_root() == wanted and mode(wanted) == 0o700
    assert [one.name for one in tmp_path.iterdir()] == [wanted.name]  # no folder named ~
    wanted.chmod(0o777)  # somebody was there before
    with pytest.raises(CacheError, match=f"{wanted} is refused"):
        cache_root()


@pytest.mark.parametrize("value", ["", ".", "cache"])
@pytest.mark.parametrize("name", ["HOME", "XDG_CACHE_HOME"])
def test_a_home_that_is_no_whole_path_does_not_count(name, value, tmp_path, monkeypatch):
    """The cache would be in the root's folder, or in the current one, whoever filled that."""
    for one in ("FMU_BEARING_CACHE", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(one, raising=False)
    home = tmp_path / "home"
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv(name, value)
    entry = pwd.struct_passwd(("me", "x", os.geteuid(), 0, "", str(home), ""))
    monkeypatch.setattr(pwd, "getpwuid", lambda _: entry)
    monkeypatch.chdir(tmp_path)
    assert cache_root() == home / ".cache" / "fmu-bearing"
    assert [one.name for one in tmp_path.iterdir()] == ["home"]


@pytest.mark.parametrize("which", ["step.o", "step.o.sha256"])
@pytest.mark.parametrize("rights", [0o666, 0o664, None])
def test_a_file_that_others_can_write_to_is_made_again(place, which, rights, request):
    """Its checksum holds: whoever changed the file can have changed the checksum with it."""
    reported = []
    assert disk_cache.write(place / "step.o", b"code", reported.append)
    if rights is None:
        request.getfixturevalue("somebody_else")
    else:
        (place / which).chmod(rights)
    assert disk_cache.read(place / "step.o", reported.append) is None
    (line,) = reported
    assert f"{place / 'step.o'}" in line and "made again" in line
    if which == "step.o":
        assert ("owns it" if rights is None else f"others can write to it (mode {rights:o})") in line
    assert not (place / "step.o").exists()


def test_kernels_are_neither_read_nor_kept_where_others_can_write(place, monkeypatch):
    name = f"step-{own().name}-v0.o"
    monkeypatch.setattr(
        make, "_run", lambda due, codes, display: pytest.fail("compiled for a folder that is refused")
    )
    folder = make.folder()
    assert disk_cache.write(folder / name, b"code", pytest.fail)
    folder.chmod(0o777)
    with pytest.raises(CacheError, match=f"{folder} is refused"):
        make.objects(own(), ["step"], ["v0"])
    folder.chmod(0o700)
    assert make.objects(own(), ["step"], ["v0"]) == {("step", "v0"): b"code"}


@pytest.mark.heavy
def test_the_command_line_says_so_in_one_line(place):
    place.chmod(0o777)
    command = [sys.executable, "-m", "fmu_bearing", "warm-up"]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert ran.returncode == 2
    assert ran.stderr.startswith(f"error: {place} is refused") and len(ran.stderr.splitlines()) == 1


def test_only_own_files_are_read(tmp_path):
    file = own_folder(tmp_path / "paths") / "a.pickle"
    file.write_bytes(b"x")
    file.chmod(0o600)
    assert read_own(file) == b"x"
    file.chmod(0o606)
    with pytest.raises(CacheError, match=r"a.pickle: others can write to it \(mode 606\)"):
        read_own(file)
