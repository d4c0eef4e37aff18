"""One operating point of a scene: its run, its key, and what is kept of it on disk."""

import functools
import hashlib
import json
import math
import os
import pathlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from examples.papers.hearing import LISTENING, sources_hash
from fmu_bearing import modes
from fmu_bearing.acoustics.analysis.field import form_of
from fmu_bearing.engine.sources import rooms_digest, source_hash
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.modal.modes.natural_modes import self_excited
from fmu_bearing.recording.record import OUTPUTS, Recording, record
from fmu_bearing.scene import Scene, read_scene

ROOT = pathlib.Path(__file__).parents[2]
_ROOMS = ("elastic", "prepare", "recording", "scene")  # of the package, beside the engine
SCENES = ROOT / "examples" / "scenes"
#: Seeds of phases, ball sizes and axes.
SEEDS = (1, 2, 3, 4)
#: Speeds over the speed that a paper names. Where one line of a race meets one mode, the level at a single
#: speed is 4 to 10 dB above those 1 % beside it. No seed averages that, so neighbouring speeds are run, too.
AROUND = (0.96, 0.97, 0.98, 0.99, 1.0, 1.01, 1.02, 1.03, 1.04)
#: The same for figures over a whole range of speeds.
FEW_SEEDS, FEW_AROUND = SEEDS[:2], AROUND[::2]
_JUMP = 2e-5  # s: one communication step, over which an input rises
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
        Speed that the paper names.
    changes : tuple of (str, value)
        Keys of the scene, dotted, with other values than the file's; later ones count.
    seed : int
    settle, duration : float
        Time (s) left out at the beginning, and recorded after it.
    label : str
        What tables call the variant; empty for the scene as it is.
    around : float
        Speed that is run, over ``rpm``.
    jump_from : float, optional
        Speed (r/min) at which the bearing starts in equilibrium, before its ring jumps to the speed.
    """

    scene: str
    rpm: float
    changes: Changes = ()
    seed: int = SEEDS[0]
    settle: float = 0.05
    duration: float = 0.16
    label: str = ""
    around: float = 1.0
    jump_from: float | None = None

    def build(self) -> Scene:
        """Return the scene at this point; ``SceneError`` where a value is refused."""
        changes = (
            *self.changes,
            ("imperfections.seed", self.seed),
            ("operation.speed_rpm", float(self.rpm) * self.around),
        )
        return changed(self.scene, changes)

    def key(self, radiation_model: str) -> str:
        """Hash (16 hex digits) of all that the recording depends on."""
        code = f"{source_hash()} {rooms_digest(*_ROOMS)}"
        form = form_of(radiation_model)
        run = f"{self.settle} {self.duration} {self.jump_from}"
        text = f"{json.dumps(_motion(self.build()))} {run} {form} {code}"
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def recording(self, radiation_model: str) -> Recording:
        """Run the case for a radiation model; all but those of the papers share their channels.

        Raises
        ------
        ValueError
            Where a mode of the scene grows: the sound is a whirl's, and no value of a paper comes from it.
        """
        scene = self.build()
        if (mode := growing(scene)) is not None:
            raise ValueError(
                f"{self.scene} at {scene.operation.speed_rpm:,.0f} r/min: '{mode.name}' at "
                f"{mode.frequency:,.0f} Hz grows by {mode.growth:,.0f} 1/s, so no value of a paper is read "
                "from it: hold it by a tilt support, more damping or less speed"
            )
        jump = {}
        if self.jump_from is not None:
            ends = (self.jump_from, scene.operation.speed_rpm)
            jump = {"speed": lambda t: ends[t > 0.0] * math.pi / 30.0, "step": _JUMP}
        return record(
            scene, self.duration, settle=self.settle, progress=False, **jump,
            outputs=(*OUTPUTS, *(["cage.speed_ratio"] if scene.bearing.cage is not None else [])),
            # microphones are chosen afterwards: the cheapest radiation model with these channels serves
            radiation_model=radiation_model if form_of(radiation_model) != "vectors" else "compact",
        )  # fmt: skip


def growing(scene: Scene) -> Mode | None:
    """Return the mode of rings that grows fastest by itself at the scene's speed; None where none does."""
    # waves and unbalance change no mode: seeds and amplitudes share one answer
    return _growing(json.dumps(scene.replace({"imperfections": None, "sound": None}).model_dump(mode="json")))


@functools.lru_cache(maxsize=4096)
def _growing(text: str) -> Mode | None:
    return self_excited(modes(Scene.model_validate(json.loads(text))))


def around(
    cases: Iterable[Case], seeds: Sequence[int] = SEEDS, factors: Sequence[float] = AROUND
) -> list[Case]:
    """Return each case with all seeds at all speeds around its own."""
    return [replace(case, seed=seed, around=at) for case in cases for seed in seeds for at in factors]


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
