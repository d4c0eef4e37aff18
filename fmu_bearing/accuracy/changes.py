"""Sensitivity of level, life and friction torque to a designer's choices, one at a time.

Life, torque and stiffness are those of a perfect bearing at its operating point. Levels come
from short runs with the same seeds before and after a change, so that a difference is that of the change. Its
range over seeds is given with it: a change that makes one draw of the surfaces quieter and another louder is
no finding.
"""

import math
from dataclasses import replace

import numpy as np

from fmu_bearing.accuracy.alternatives import Alternative, alternatives
from fmu_bearing.accuracy.change_levels import ChangeLevels, change_levels
from fmu_bearing.accuracy.changed import Change, Changes, LevelBasis, Point
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.rating import unrated
from fmu_bearing.modal.campbell.doubts import whirl_words
from fmu_bearing.progress import Tell, keeping, silent
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require

SEEDS = 5


def changes(
    source: SceneSource,
    *,
    seeds: int = SEEDS,
    levels: bool = True,
    radiation_model: str | None = None,
    tell: Tell = silent,
) -> Changes:
    """Change one choice of a designer at a time, and compare level, life and friction torque.

    Parameters
    ----------
    source : Scene or path
    seeds : int
        How many draws of the surfaces each level is compared with, the scene's own first; with rings that
        bend 3 at most, because they need fidelity full.
    levels : bool
        Whether levels are computed. They take nearly all of the time.
    radiation_model : str, optional
        In place of the scene's.
    tell : callable
        Takes a line of text before each piece of work.

    Returns
    -------
    Changes

    Raises
    ------
    ValueError
        Where the unchanged scene has no equilibrium (`EngineError`) or no figure to compare, or for
        ``seeds`` below 1.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with what is finished as ``study``.

    Examples
    --------
    >>> from fmu_bearing import changes
    >>> found = changes("examples/scenes/7003C-bare.toml", levels=False)
    >>> best = found.ranked("life")[0]
    >>> best.choice.words, best.ratio('life') > 10
    ('preload 500 -> 29.8 N light', True)
    """
    if seeds < 1:
        raise ValueError(f"seeds = {seeds}: give 1 or more")
    scene = scene_of(source)
    require(scene, "changes")
    tell("operating point of the unchanged scene")
    before = point(scene)
    ear, reason = change_levels(scene, radiation_model) if levels else (None, "they were not requested")
    if ear is not None:
        tell("levels of the unchanged scene")
        try:
            ear.begin(scene, seeds)
        except ValueError as problem:
            ear, reason = None, str(problem)
    basis = LevelBasis() if ear is None else LevelBasis(
        ear.level, ear.microphone, ear.fidelity, ear.estimator.radiation_model, ear.estimator.settle,
        ear.estimator.duration, ear.seeds, ear.doubt,
    )  # fmt: skip
    study = Changes(scene, before, basis, (), reason, _no_life(scene))
    if not study.figures:
        raise ValueError(f"{scene.name} has nothing to compare. {study.conditions()}")
    rows: list[Change] = []
    with keeping(rows, lambda: replace(study, changes=tuple(rows))):
        for choice in alternatives(scene):
            tell(choice.words)
            rows.append(_changed(scene, choice, before, ear))
    return replace(study, changes=tuple(rows))


def point(scene: Scene) -> Point:
    """Return friction torque, life and stiffness at the operating point, without sound, waviness and bending.

    Raises
    ------
    EngineError
        Where there is no equilibrium.
    """
    cautions: list[str] = []
    operating = operating_point(scene, cautions.append)
    cautions += operating.remarks
    if operating.whirl is not None:
        cautions.append(whirl_words(*operating.whirl, scene))
    torque = 1e3 * sum(bearing.friction_torque for bearing in operating.bearings)
    torque *= math.copysign(1.0, scene.operation.speed_rpm)
    if not scene.assembly.joined:
        (one,) = operating.bearings
        life, stiffness = one.life, 0.5 * float(one.stiffness[1, 1] + one.stiffness[2, 2])
    else:
        life, stiffness = operating.life, operating.statics.nose_stiffness
    return Point(torque, math.nan if life is None else life, 1e-6 * stiffness, tuple(cautions))


def _no_life(scene: Scene) -> str:
    """Return why a scene has no life; empty: it has one."""
    return unrated(scene) or ("the shaft does not turn" if scene.operation.speed_rpm == 0.0 else "")


def _changed(scene: Scene, choice: Alternative, before: Point, ear: ChangeLevels | None) -> Change:
    """Return what one choice changes, or why it cannot be made."""
    try:
        other = scene.replace(choice.values)
        after = point(other)
        levels = np.empty(0) if ear is None else ear.levels(other) - ear.before
    except ValueError as problem:
        reason = "; ".join(line.removeprefix(f"{scene.name}: ") for line in str(problem).splitlines())
        return Change(choice, before, reason=reason)
    return Change(choice, before, after, levels)
