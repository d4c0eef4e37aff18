"""Writing files in one step, because other processes may read them; digests of source files."""

import hashlib
import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

__all__ = ["sources_digest", "write_whole"]


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


def sources_digest(rooms: Iterable[str]) -> str:
    """Return a digest (64 hex digits) of all Python sources of some subpackages: names and bytes."""
    root = Path(__file__).parent
    digest = hashlib.sha256()
    for room in rooms:
        for path in sorted((root / room).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()
