"""One operating point of a scene, and its recording on disk."""

import hashlib
import json
import os
import pathlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from examples.papers.hearing import LISTENING, sources_hash
from fmu_bearing.engine.sources import rooms_digest, source_hash
from fmu_bearing.recording.record import OUTPUTS, Recording, record
from fmu_bearing.scene import Scene, read_scene

ROOT = pathlib.Path(__file__).parents[2]
_ROOMS = ("elastic", "prepare", "recording", "scene")  # of the package, beside the engine
SCENES = ROOT / "examples" / "scenes"
#: Seeds of phases, ball sizes and axes: every figure of a page is run with all of them.
SEEDS = (1, 2, 3, 4, 5, 6, 7, 8)
QUICK_SEEDS = (1, 2)
#: Keys of a scene, dotted, with other values than the file's; None takes the key out.
Changes = tuple[tuple[str, Any], ...]


@dataclass(frozen=True)
class Case:
    """One operating point with one seed.

    Attributes
    ----------
    scene : str
        File name in ``examples/scenes``, without its suffix.
    rpm : float
    changes : tuple of (str, value)
        Keys of the scene, dotted, with other values than the file's; later ones count.
    seed : int
    settle, duration : float
        Time (s) left out at the beginning, and recorded after it.
    label : str
        What tables call the variant; empty for the scene as it is.
    """

    scene: str
    rpm: float
    changes: Changes = ()
    seed: int = SEEDS[0]
    settle: float = 0.05
    duration: float = 0.16
    label: str = ""

    def build(self) -> Scene:
        """Return the scene at this point; ``SceneError`` where a value is refused."""
        changes = (
            *self.changes,
            ("imperfections.seed", self.seed),
            ("operation.speed_rpm", float(self.rpm)),
        )
        return changed(self.scene, changes)

    def key(self, radiation_model: str) -> str:
        """Hash (16 hex digits) of all that the recording depends on."""
        kind = "paper" if radiation_model == "paper" else "vector"
        code = f"{source_hash()} {rooms_digest(*_ROOMS)}"
        text = f"{json.dumps(_motion(self.build()))} {self.settle} {self.duration} {kind} {code}"
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def recording(self, radiation_model: str, cache: pathlib.Path) -> Recording:
        """Return the recording for a radiation model: taken from ``cache``, or run and put there.

        All radiation models but ``paper`` take accelerations and share one recording. Recordings of the first
        seed alone are kept: a run costs no more than reading it again, and eight seeds fill the disk.
        """
        path = cache / f"{self.key(radiation_model)}.npz"
        if path.exists():
            return Recording.load(path)
        # microphones are chosen afterwards: the cheapest radiation model with these channels serves
        scene = self.build()
        made = record(
            scene, self.duration, settle=self.settle, progress=False,
            outputs=(*OUTPUTS, *(["cage.speed_ratio"] if scene.bearing.cage is not None else [])),
            radiation_model="paper" if radiation_model == "paper" else "compact",
        )  # fmt: skip
        if self.seed == SEEDS[0]:
            cache.mkdir(parents=True, exist_ok=True)
            part = path.with_suffix(f".{os.getpid()}")  # an interrupted write leaves no half recording
            made.save(part)
            part.replace(path)
        return made


def changed(name: str, changes: Changes) -> Scene:
    """Return an example scene with other values; ``SceneError`` where one is refused."""
    return read_scene(SCENES / f"{name}.toml").replace(dict(changes))


def kept(path: pathlib.Path, compute: Callable[[], dict[str, Any]]) -> dict[str, Any]:
    """Return what ``path`` (JSON) holds, or compute it and put it there."""
    if path.exists():
        return json.loads(path.read_text("utf-8"))
    found = compute()
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(f".{os.getpid()}")
    part.write_text(json.dumps(found), "utf-8")
    part.replace(path)
    return json.loads(path.read_text("utf-8"))  # what a later run will see


def code_hash(*modules: str) -> str:
    """Hash (12 hex digits) of the sound's sources and of modules of this folder: results follow the code."""
    digest = hashlib.sha256(sources_hash().encode())
    for name in modules:
        digest.update(pathlib.Path(__file__).with_name(f"{name}.py").read_bytes())
    return digest.hexdigest()[:12]


def _motion(scene: Scene) -> dict[str, Any]:
    """Return the scene without the keys of ``sound`` that do not affect the motion."""
    data = scene.model_dump(mode="json", exclude_none=True)
    sound = data.get("sound", {})
    for key in LISTENING:
        sound.pop(key, None)
    return data
