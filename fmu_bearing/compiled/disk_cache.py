"""Files of the user's cache: whole or absent, checked when read, and never needed.

A file is beside its checksum, which is written first. A file that was cut short or changed, or whose
checksum is missing or cannot be read, is reported, removed and made again. The checksum finds damage, no
intent: who can write the file can write the checksum. So the folder is this user's own
(`files.own_folder`), and a file that others can write to is not used either. Where nothing can be written (a
full disk, a read-only home) the caller goes on with what it holds in memory.
"""

import contextlib
import hashlib
from collections.abc import Iterator
from pathlib import Path

from filelock import FileLock, Timeout

from fmu_bearing.files import CacheError, read_own, write_whole
from fmu_bearing.progress import Tell

__all__ = ["alone", "read", "write"]

_CHECKSUM = ".sha256"
#: Where no lock can be made: the folder or its file cannot be written, or the file system has no locks, for
#: which versions of FileLock raise NotImplementedError.
_NO_LOCK = (OSError, NotImplementedError)


def read(path: Path, tell: Tell) -> bytes | None:
    """Return the content of a kept file, or ``None``; a damaged file is reported and removed."""
    try:
        data = read_own(path)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except CacheError as problem:
        _remove(path, f"the kept file {problem}: it is not used but made again", tell)
        return None
    except OSError as problem:
        tell(f"the kept file {path} cannot be read ({problem.strerror}): it is made again")
        return None
    with contextlib.suppress(OSError, UnicodeDecodeError):
        if hashlib.sha256(data).hexdigest() == read_own(_beside(path)).decode("ascii").strip():
            return data
    _remove(path, f"the kept file {path} is damaged: it is made again", tell)
    return None


def _remove(path: Path, why: str, tell: Tell) -> None:
    tell(why)
    with contextlib.suppress(OSError):
        path.unlink()


def write(path: Path, data: bytes, tell: Tell) -> bool:
    """Keep a file with its checksum; where that fails, say so and return ``False``."""
    try:
        # the checksum first: who reads meanwhile finds no file rather than one without its checksum
        write_whole(_beside(path), f"{hashlib.sha256(data).hexdigest()}\n".encode("ascii"))
        write_whole(path, data)
    except OSError as problem:
        tell(
            f"{path.name} cannot be kept in {path.parent} ({problem.strerror}): the next process compiles it "
            "again; make room there, or name another folder in FMU_BEARING_CACHE"
        )
        return False
    return True


@contextlib.contextmanager
def alone(folder: Path, tell: Tell) -> Iterator[None]:
    """Hold a folder's lock, so that of two processes one compiles and the other reads.

    A folder in which no lock can be made is used without one.
    """
    lock = FileLock(folder / "lock")
    held_elsewhere = False
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock.acquire(timeout=0)
    except Timeout:
        held_elsewhere = True
    except _NO_LOCK:
        pass
    if held_elsewhere:
        tell("another process is compiling the kernels: waiting for it")
        with contextlib.suppress(*_NO_LOCK):
            lock.acquire()
    try:
        yield
    finally:
        lock.release()  # does nothing where none was made


def _beside(path: Path) -> Path:
    return path.with_name(path.name + _CHECKSUM)
