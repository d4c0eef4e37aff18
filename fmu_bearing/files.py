"""Writing files in one step, because other processes may read them, and where what is kept lies."""

import os
import tempfile
from pathlib import Path

__all__ = ["cache_root", "write_whole"]


def cache_root() -> Path:
    """Folder of all that is kept: ``FMU_BEARING_CACHE``, else ``fmu-bearing`` in the user's cache folder."""
    named = os.environ.get("FMU_BEARING_CACHE")
    if named:
        return Path(named)
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return Path(base or os.path.expanduser("~/.cache")) / "fmu-bearing"


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
