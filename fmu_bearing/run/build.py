"""The FMU of a scene in one call: fidelity ``auto`` resolved, model prepared, file written."""

import os
from collections.abc import Sequence

from fmu_bearing.files import check_file, check_folder
from fmu_bearing.fmi.package import BuiltFmu, build, check_choice
from fmu_bearing.modal.campbell import doubts
from fmu_bearing.prepare.model import Model, prepare
from fmu_bearing.progress import Tell, silent
from fmu_bearing.run.choose import resolve
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.words import is_loose, loose_words


def model_of(source: SceneSource, tell: Tell = silent) -> Model:
    """Return the model of a scene. Fidelity ``auto`` is resolved; the choice is noted in the model.

    So is why figures of fidelities rings and response are in doubt: an FMU cannot say it at run time.

    Raises
    ------
    SceneError
        For a scene that is refused.
    """
    scene = scene_of(source)
    if scene.fidelity.model == "auto":
        tell("fidelity auto: probing the scene against fidelity full (kept for the next time)")
    resolved, choice = resolve(scene)
    if is_loose(resolved):
        tell(f"caution: {loose_words(resolved.fidelity.model)}")
    notes = []
    if doubted := _doubt(resolved):
        tell(f"caution: {doubted}")
        notes.append(f"{doubted[0].upper()}{doubted[1:]}")
    if choice is not None:
        tell(choice.words())
        notes.append(choice.words())
    return prepare(resolved, note=". ".join(notes))


def build_fmu(
    source: SceneSource | Model,
    output: str | os.PathLike[str] | None = None,
    flavour: str | None = None,
    platforms: Sequence[str] | None = None,
    tell: Tell = silent,
    only_here: bool = False,
) -> BuiltFmu:
    """Write the FMU of a scene.

    Parameters
    ----------
    source : Scene, Model or path
        Scene file (TOML) or scene in memory.
    output, flavour, platforms
        As for :func:`fmu_bearing.fmi.package.build`.
    tell : callable, optional
        Takes a line of text before work that takes minutes, and the choice of fidelity ``auto``.
    only_here : bool
        As for :func:`fmu_bearing.fmi.package.build`.

    Returns
    -------
    BuiltFmu
        ``path`` of the file, its GUID, the platforms built, and remarks on parts that were not built.

    Raises
    ------
    ValueError, OSError, BuildError
        As :func:`fmu_bearing.fmi.package.build`, and for a scene that is refused.

    Examples
    --------
    >>> from fmu_bearing import build_fmu, read_scene
    >>> scene = read_scene("examples/scenes/7003C-bare.toml").replace({"sound": None})
    >>> build_fmu(scene, "bearing.fmu", flavour="python").variables["input"]
    8
    """
    check_choice(flavour, platforms, only_here)
    # refused before minutes of compiling
    if output is None:
        check_folder(".")
    else:
        check_file(output, ".fmu", "an FMU")
    model = source if isinstance(source, Model) else model_of(source, tell)
    return build(model, None if output is None else os.fspath(output), flavour, platforms, tell, only_here)


def _doubt(scene: Scene) -> str:
    """Return why figures of a scene are in doubt; of one without sound nothing about its levels."""
    reason = doubts.doubt(scene)
    return "" if scene.sound is None and doubts.is_of_levels(reason) else reason
