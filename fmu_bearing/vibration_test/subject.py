"""The bearing under test: by its name in the catalogue, or of a scene."""

import os
import re
from pathlib import Path

from fmu_bearing.scene import Scene, SceneError, SceneSource, read_scene_text, scene_of
from fmu_bearing.scene.designation import suggestion
from fmu_bearing.scene.entries import entries
from fmu_bearing.scene.template import new_scene

_SEED = 1


def subject(source: SceneSource, kind: str | None = None, grade: str | None = None) -> Scene:
    """Return the scene of the bearing that is tested.

    Parameters
    ----------
    source : Scene, path or str
        A scene, its file (``.toml``), or a bearing of the catalogue by name.
    kind : str, optional
        Materials of a bearing by name, as `new_scene` has them; default: by its
        designation.
    grade : str, optional
        Tolerance class of the imperfections; default: the scene's own, of a bearing by name
        what the designation says, else P4.

    Raises
    ------
    SceneError
        For what is neither a scene nor a bearing, a kind beside a scene, and a scene without imperfections.
    """
    if isinstance(source, str) and not _is_file(source):
        return _by_name(source, kind, grade)
    if kind is not None:
        raise SceneError(f"--kind {kind} (kind=) is of a bearing by name: a scene has its own materials")
    scene = scene_of(source)
    if grade is None:
        if scene.imperfections is None:
            raise SceneError(
                f"{scene.name}: has no [imperfections], and smooth surfaces make no vibration: give a "
                "tolerance class (--grade, grade=), as P4"
            )
        return scene
    if scene.imperfections is None:
        return scene.replace({"imperfections": {"grade": grade, "seed": _SEED, **_unbalance(scene)}})
    return scene.replace({"imperfections.grade": grade, **{
        f"imperfections.{key}": value for key, value in _unbalance(scene).items()
    }})  # fmt: skip


def _unbalance(scene: Scene) -> dict[str, float]:
    """Return the unbalance beside a grade, whose own is one of a rotor that a set does not have."""
    return {"unbalance_um": 0.0} if scene.assembly.joined else {}


def _is_file(source: str) -> bool:
    return Path(source).suffix == ".toml" or os.path.exists(source)


def _by_name(name: str, kind: str | None, grade: str | None) -> Scene:
    known = entries("bearings")
    if name not in known:
        raise SceneError(
            f"{name} is neither a scene file (.toml) nor a bearing of the catalogue; "
            f"{suggestion(name, known)}`fmu-bearing scene catalogue` lists them"
        )
    of_scene = re.sub(r"[^A-Za-z0-9._-]+", "-", name).strip("-.")
    text = new_scene(of_scene, name, kind=kind, grade=grade, sound=False)
    return read_scene_text(text, name)
