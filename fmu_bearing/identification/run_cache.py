"""Computed levels on disk: a line per run, so that an interrupted search goes on where it ended."""

import json
import math
import pathlib
import threading
import zlib

FILE = "runs.jsonl"


class RunCache:
    """Levels by key, in memory and, with a folder, in its file.

    A key identifies scene, places, quantities, settings and code. A line that cannot be read, or whose
    checksum differs, is ignored.
    """

    def __init__(self, folder: pathlib.Path | None) -> None:
        self.found: dict[str, tuple[float, ...]] = {}
        self.path = None if folder is None else folder / FILE
        self._lock = threading.Lock()
        if self.path is None:
            return
        self.path.parent.mkdir(parents=True, exist_ok=True)
        if self.path.exists():
            for line in self.path.read_text("utf-8", errors="replace").splitlines():
                self._read(line)

    def _read(self, line: str) -> None:
        try:
            data = json.loads(line)
            if data["check"] == _check(data["key"], data["levels"]):
                self.found[data["key"]] = tuple(math.nan if v is None else float(v) for v in data["levels"])
        except (ValueError, KeyError, TypeError, RecursionError):
            return

    def get(self, key: str) -> tuple[float, ...] | None:
        """Return kept levels, or None."""
        return self.found.get(key)

    def put(self, key: str, levels: tuple[float, ...]) -> None:
        """Keep levels; NaN: the run was refused."""
        plain = [value if math.isfinite(value) else None for value in levels]
        with self._lock:
            self.found[key] = levels
            if self.path is not None:
                text = json.dumps({"check": _check(key, plain), "key": key, "levels": plain})
                with self.path.open("a", encoding="utf-8") as file:
                    file.write(f"{text}\n")


def _check(key: str, levels: list[float | None]) -> int:
    return zlib.crc32(json.dumps([key, levels]).encode())
