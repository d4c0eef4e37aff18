"""Writing files in one step, because other processes may read them, and where what is kept lies."""

import os
import tempfile
from pathlib import Path

__all__ = ["cache_root", "check_file", "check_folder", "write_whole"]


def cache_root() -> Path:
    """Folder of all that is kept: ``FMU_BEARING_CACHE``, else ``fmu-bearing`` in the user's cache folder."""
    named = os.environ.get("FMU_BEARING_CACHE")
    if named:
        return Path(named)
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return Path(base or os.path.expanduser("~/.cache")) / "fmu-bearing"


def check_file(path: str | os.PathLike[str]) -> Path:
    """Return the path of a file that is going to be written; called before a long computation.

    Nothing is made, so that a refusal for another reason leaves no trace.

    Raises
    ------
    OSError
        Where a folder has this name, or the folder cannot be made or written to.
    """
    target = Path(path)
    if target.is_dir():
        raise IsADirectoryError(f"{target} is a folder: name the file to write")
    check_folder(target.parent)
    return target


def check_folder(path: str | os.PathLike[str]) -> Path:
    """Return the path of a folder that results are going to be written to, as `check_file`.

    Raises
    ------
    OSError
        Where it is a file, or cannot be made or written to.
    """
    folder = Path(path)
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


def write_whole(path: Path, data: bytes) -> Path:
    """Write all of a file or none of it, and return its path; folders on the way are made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
    return path
