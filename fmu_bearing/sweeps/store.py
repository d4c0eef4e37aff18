"""Finished points on disk, each in a file of its own that is written whole."""

import hashlib
import json
import math
import pathlib

from fmu_bearing.files import write_whole
from fmu_bearing.sweeps.point import Outcome, Task

FOLDER = "points"


class Store:
    """Outcomes by key under a folder.

    A key identifies scene, settings and code, so points of other versions or settings have other keys. A file
    that cannot be read, or whose checksum differs, is ignored.
    """

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder / FOLDER
        self.folder.mkdir(parents=True, exist_ok=True)

    def load(self, task: Task) -> Outcome | None:
        """Return the kept outcome of a point, or None."""
        try:
            data = json.loads(self._path(task).read_text("utf-8"))
            point = data["point"]
            if data["check"] != _check(point) or point["key"] != task.key:
                return None
            figures = tuple(math.nan if v is None else float(v) for v in point["figures"].values())
            if tuple(point["figures"]) != task.figures:
                return None
            return Outcome(figures, str(point["reason"]), float(point["wall_s"]))
        except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
            return None

    def keep(self, task: Task, outcome: Outcome) -> Outcome:
        """Write a point, unless another try may give another result; return it."""
        if not outcome.lasting:
            return outcome
        figures = zip(task.figures, outcome.figures, strict=True)
        point = {
            "key": task.key,
            "code": task.code,
            "figures": {name: value if math.isfinite(value) else None for name, value in figures},
            "reason": outcome.reason,
            "wall_s": outcome.wall,
        }
        text = json.dumps({"check": _check(point), "point": point}, indent=1)
        write_whole(self._path(task), text.encode("utf-8"))
        return outcome

    def _path(self, task: Task) -> pathlib.Path:
        return self.folder / f"{task.key}.json"


def _check(point: dict[str, object]) -> str:
    return hashlib.sha256(json.dumps(point, sort_keys=True).encode()).hexdigest()[:16]
