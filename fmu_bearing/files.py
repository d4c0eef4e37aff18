"""Reading files that a user names, writing files in one step, and where what is kept lies."""

import contextlib
import errno
import os
import re
import shutil
import stat
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, BinaryIO

__all__ = [
    "CacheError",
    "cache_root",
    "check_file",
    "check_folder",
    "who_else_writes",
    "naming",
    "no_room",
    "own_folder",
    "plain_file",
    "read_arrays",
    "read_own",
    "read_text",
    "real_path",
    "rescued",
    "taking_place",
    "whole",
    "write_whole",
]

_ENDING = re.compile(r"\.[A-Za-z][A-Za-z0-9]{1,4}")  # of files: .uff, .csv, .html
_WAY_OUT = "name a folder of your own in FMU_BEARING_CACHE, which is made where it is not there"
#: Of the place that is written to: it is full, or may not be written.
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM)


def plain_file(path: str | os.PathLike[str], most: float = float("inf")) -> Path:
    """Return the path of a file that is going to be read, of ``most`` bytes or fewer.

    Pipes and devices are refused: they may never end, and a file is often read twice.

    Raises
    ------
    OSError
        Where there is none (`FileNotFoundError`), and for what is no such file.
    """
    if "\0" in os.fspath(path):
        raise OSError("its name holds NUL, as no file's name does")
    status = os.stat(path)
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError("it is a folder: name a file in it")
    if not stat.S_ISREG(status.st_mode):
        raise OSError("it is a pipe or a device: write its output to a file, and name that file")
    if status.st_size > most:
        raise OSError(f"it has {1e-6 * status.st_size:.3g} MB; allowed: up to {1e-6 * most:g} MB")
    return Path(path)


def real_path(path: str | os.PathLike[str]) -> Path:
    """Return the whole path of a file, links followed; a name with NUL, which no file has, stays as it is."""
    return Path(path) if "\0" in os.fspath(path) else Path(os.path.realpath(path))


def read_text(path: str | os.PathLike[str], most: float = 1e9) -> str:
    """Return text in UTF-8 with or without byte order mark, which some editors put in front.

    Raises
    ------
    OSError
        As `plain_file`.
    UnicodeDecodeError
        For what is no such text.
    """
    return plain_file(path, most).read_text("utf-8-sig")


def read_arrays(path: str | os.PathLike[str], names: Iterable[str] | None = None) -> dict[str, Any]:
    """Return arrays of a NumPy archive (``numpy.savez``), of ``names`` the ones that it has; default: all.

    Nothing is unpickled.

    Raises
    ------
    OSError
        As `plain_file`.
    ValueError
        For a file that is not an archive of plain arrays, or damaged.
    """
    import numpy as np

    file = plain_file(path)
    try:
        with np.load(file, allow_pickle=False) as archive:
            return {name: archive[name] for name in (names or archive.files) if name in archive.files}
    except Exception:  # NumPy, zipfile, zlib and tokenize raise what they come upon in damaged files
        raise ValueError("it is not a NumPy archive of plain arrays, or damaged") from None


class CacheError(OSError):
    """A folder or file of the cache that others can write to: what is kept there is run as code."""


def cache_root() -> Path:
    """Folder of all that is kept, this user's own (`own_folder`).

    ``FMU_BEARING_CACHE``, else ``fmu-bearing`` in the user's cache folder, else one per user among the
    temporary files: without HOME and without an entry in the user table there is no better one. Variables
    of the surroundings that are empty or no whole paths do not count, but for the first.

    Raises
    ------
    CacheError
        As `own_folder`.
    """
    if named := os.environ.get("FMU_BEARING_CACHE"):
        return own_folder(Path(named))
    # one that counts from the current folder is none: who fills that folder would give the code that is run
    names = ("XDG_CACHE_HOME", "LOCALAPPDATA")
    base = next((place for name in names if os.path.isabs(place := os.environ.get(name, ""))), "")
    if not base and (home := _home()):
        base = os.path.join(home, ".cache")
    if not base:
        user = "" if sys.platform == "win32" else f"-{os.geteuid()}"
        return own_folder(Path(tempfile.gettempdir()) / f"fmu-bearing{user}")
    return own_folder(Path(base) / "fmu-bearing")


def _home() -> str:
    """Return the user's own folder; empty where there is none, or none that is a whole path."""
    if sys.platform != "win32" and not os.path.isabs(os.environ.get("HOME", "")):
        import pwd

        with contextlib.suppress(KeyError):
            folder = pwd.getpwuid(os.geteuid()).pw_dir
            return folder if os.path.isabs(folder) else ""
        return ""
    folder = os.path.expanduser("~")
    return folder if os.path.isabs(folder) else ""


def own_folder(folder: Path) -> Path:
    """Return a folder that this user alone can write to; made, where it can be, with these rights.

    One that is not there and cannot be made is returned as well: who writes there says so. On Windows the
    rights of the user's profile hold, and nothing is looked at.

    Raises
    ------
    CacheError
        Where another user owns it, or others can write to it, or replace it in a folder above it.
    """
    with contextlib.suppress(OSError):
        for one in (*reversed(folder.parents), folder):
            if not one.is_dir():
                one.mkdir(0o700)
    if why := who_else_writes(folder):
        mend = f"; `chmod go-w {folder}` does, too, if all that it holds is yours"
        mend = mend if "(mode" in why and not folder.stat().st_mode & stat.S_ISVTX else ""
        raise CacheError(
            f"{folder} is refused, as what is kept there is run as code: {why}; {_WAY_OUT}{mend}"
        )
    for above in Path(os.path.realpath(folder)).parents:
        if _anybody_replaces(above):
            raise CacheError(f"{folder} is refused: everybody can replace it in {above}; {_WAY_OUT}")
    return folder


def read_own(path: Path) -> bytes:
    """Return the content of a file that this user alone can write to.

    Raises
    ------
    CacheError
        Where another user owns it, or others can write to it.
    OSError
        Where it cannot be read.
    """
    with path.open("rb") as file:
        if why := who_else_writes(file.fileno()):
            raise CacheError(f"{path}: {why}")
        return file.read()


def who_else_writes(path: Path | int) -> str:
    """Say who else may have written to a file or folder, by path or open; empty: nobody, or none is there."""
    if sys.platform == "win32":
        return ""
    try:
        status = os.stat(path)
    except OSError:
        return ""
    if status.st_uid != os.geteuid():
        return f"{_user(status.st_uid)} owns it, and {_user(os.geteuid())} uses it"
    if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        return f"others can write to it (mode {stat.S_IMODE(status.st_mode):o})"
    return ""


def _user(number: int) -> str:
    import pwd

    with contextlib.suppress(KeyError):
        return f"user {pwd.getpwuid(number).pw_name}"
    return f"user {number}"


def _anybody_replaces(folder: Path) -> bool:
    """Whether everybody can rename what lies in a folder: all can write to it, and it has no sticky bit."""
    with contextlib.suppress(OSError):
        mode = folder.stat().st_mode
        return sys.platform != "win32" and bool(mode & stat.S_IWOTH) and not mode & stat.S_ISVTX
    return False


def check_file(
    path: str | os.PathLike[str], ending: str | tuple[str, ...] = "", what: str = "a file"
) -> Path:  # fmt: skip
    """Return the path of a file that is going to be written; called before a long computation.

    Nothing is made, so that a refusal for another reason leaves no trace. ``ending``, as ".html", or several
    of them: of files that ``what`` is written to.

    Raises
    ------
    ValueError
        For another ending.
    OSError
        Where a folder has this name, or the folder cannot be made or written to.
    """
    target = Path(path)
    if target.is_dir():
        raise IsADirectoryError(f"{target} is a folder: name the file to write")
    *others, last = (ending,) if isinstance(ending, str) else ending
    if ending and target.suffix not in (*others, last):
        words = f"{', '.join(others)} or {last}" if others else last
        small = ", in small letters" if target.suffix.lower() in (*others, last) else ""
        raise ValueError(f"{target}: {what} is written as {words}{small}")
    if target.exists() and not target.is_file():
        raise OSError(
            f"{target} is a pipe or a device, which a file would replace: name another file to write"
        )
    _writable(target.parent)
    return target


def check_folder(path: str | os.PathLike[str]) -> Path:
    """Return the path of a folder that results are going to be written to, as `check_file`.

    Raises
    ------
    ValueError
        For a name that ends as a file's does, where no such folder is: ``out.uff``.
    OSError
        Where it is a file, or cannot be made or written to.
    """
    folder = Path(path)
    if _ENDING.fullmatch(folder.suffix) and not os.path.lexists(folder):
        raise ValueError(
            f"{folder}: a folder is written here, and {folder.suffix} is the ending of a file: name a "
            f"folder, as {folder.with_suffix('')}"
        )
    return _writable(folder)


def _writable(folder: Path) -> Path:
    """Return a folder that can be made and written to; `OSError` for others."""
    there = folder.absolute()
    while not os.path.lexists(there) and there != there.parent:
        there = there.parent
    if not there.is_dir():
        words = "a file" if there.exists() else "a link to nothing"
        raise NotADirectoryError(f"{folder} cannot be written to: {there} is {words}; name another folder")
    try:
        with tempfile.TemporaryFile(dir=there):
            pass
    except OSError as problem:
        raise OSError(
            f"{folder} cannot be written to: {problem.strerror}: {there}; name another folder"
        ) from None
    return folder


@contextlib.contextmanager
def naming(path: str | os.PathLike[str]) -> Iterator[None]:
    """Give errors of the operating system the name of the file: writing to a full disk has none."""
    try:
        yield
    except OSError as problem:
        if problem.filename is None and problem.errno is not None:
            problem.filename = os.fspath(path)
        raise


def no_room(folder: str | os.PathLike[str], problem: Exception) -> str:
    """Say that a folder of temporary files takes nothing; empty: the problem is another."""
    if not isinstance(problem, OSError) or problem.errno not in _NO_ROOM:
        return ""
    return f"{os.strerror(problem.errno or 0).lower()} in {folder}: name a folder with room in TMPDIR"


def write_whole(path: Path, data: bytes) -> Path:
    """Write all of a file or none of it, and return its path; folders on the way are made; see `whole`."""
    with whole(path) as file:
        file.write(data)
    return path


@contextlib.contextmanager
def whole(path: Path) -> Iterator[BinaryIO]:
    """Give a file to write to, which takes its place when the block ends; where it fails, an old one stays.

    Folders on the way are made.

    Raises
    ------
    OSError
        Where it cannot be written, or is a pipe or a device, which the file would replace.
    """
    with taking_place(path) as temporary:
        # the user's mask may take rights away; more than these, none in the cache may have
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
        handle = os.open(temporary, flags, 0o644)
        with naming(path), os.fdopen(handle, "wb") as file:
            yield file


@contextlib.contextmanager
def taking_place(path: Path) -> Iterator[Path]:
    """Give the path of a file that is to be written, as `whole` gives a file, for what opens it itself."""
    if path.exists() and not path.is_file():
        raise OSError(f"{path} is not a plain file: name another one to write")
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.parent / f".{path.name}.{os.urandom(6).hex()}"
    try:
        yield temporary
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def rescued(write: Callable[[Path], Any], path: Path) -> None:
    """Write what took long to compute; where its place does not take it, among the temporary files.

    Raises
    ------
    OSError
        That names the other place.
    """
    try:
        write(path)
    except OSError as problem:
        reason, folder = problem.strerror or str(problem), ""
        words = f"{path}: {reason[:1].lower()}{reason[1:]}"
        try:
            folder = tempfile.mkdtemp(prefix="fmu-bearing-")
            other = Path(folder) / path.name
            write(other)
        except OSError:
            if folder:
                shutil.rmtree(folder, ignore_errors=True)
            raise OSError(f"{words}, and as little room among the temporary files") from None
        raise OSError(f"{words}; what was computed is in {other}") from None
