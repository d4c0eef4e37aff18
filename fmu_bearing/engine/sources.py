"""What the numbers come from: a hash of source files, for caches and for what must fit together."""

import functools
import hashlib
import pathlib


def digest(*folders: pathlib.Path, suffixes: tuple[str, ...] = (".py",)) -> bytes:
    """Hash (32 bytes) of all sources in folders, by name and content; order of the folders counts."""
    hashed = hashlib.sha256()
    for folder in folders:
        for path in sorted(one for one in folder.rglob("*") if one.suffix in suffixes):
            hashed.update(path.relative_to(folder.parent).as_posix().encode() + b"\0")
            hashed.update(path.read_bytes() + b"\0")
    return hashed.digest()


@functools.cache
def engine_digest() -> bytes:
    """Hash of the engine's sources.

    The kernels trust the offsets in the parameter array: read by another version of them, an old array
    would not give an error but a damaged process.
    """
    return digest(pathlib.Path(__file__).parent)


def source_hash() -> str:
    """Hash (16 hex digits) of every source file of the engine."""
    return engine_digest().hex()[:16]


def rooms_digest(*rooms: str) -> str:
    """Hash (64 hex digits) of packages of the project, by their names."""
    root = pathlib.Path(__file__).parents[1]
    return digest(*(root / room for room in rooms)).hex()
