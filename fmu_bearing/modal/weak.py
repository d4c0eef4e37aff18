"""Where levels of fidelities rings and response are in doubt: weakly damped modes, and lines that meet one.

Both hold friction and the cage's speed, and condense the balls. Where little damping is left or a line stands
on a mode, a small error of damping or frequency is one of decibels, and motions that grow large are limited
by what they leave out.
"""

from functools import lru_cache

import numpy as np

from fmu_bearing.modal.campbell import can_move, is_of_rings
from fmu_bearing.modal.lines import lines, rates, unbalance
from fmu_bearing.modal.modes import Mode
from fmu_bearing.modal.points import modes
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import read_scene_text, with_fidelity

# Damping ratios, chosen: the 7009C with steel balls has 0.008 at 11,000 r/min, where both fidelities miss by
# 6 dB(A), and 0.016 at 10,000 r/min; the 7003C in its spindle, which they follow within 1 dB(A), 0.015.
LEAST = 0.01
NARROW = 0.015  # of modes on which a line counts
HIGHEST = 20e3  # Hz: what sound is computed to


def doubt(scene: Scene) -> str:
    """Return why levels by a scene's own fidelity are in doubt; empty: they are not, or it is full."""
    reason = "" if scene.fidelity.model == "full" else weakness(scene)
    return reason and (
        f"levels of fidelity {scene.fidelity.model} are in doubt here: {reason}, and a small error of "
        "damping or frequency is one of several dB; take fidelity full"
    )


def weakness(scene: Scene) -> str:
    """Return the mode for which fidelities rings and response cannot be trusted with a level, or "".

    A mode of the rings, with the cage left out and rings rigid, has a damping ratio below `LEAST`; or a line
    that the scene contains and that can move a mode with one below `NARROW` lies within the width of its peak
    at half power. Where there is no equilibrium nothing is said: runs say so themselves. Nor of a set: its
    modes are those of the shaft, mostly with damping ratios about these bounds, and were not compared.
    """
    if scene.spindle is not None:
        return ""
    bare = scene.with_rigid_rings().model_copy(update={"sound": None, "microphones": ()})
    return _weakness(with_fidelity(bare, model="full").to_toml())


@lru_cache(maxsize=64)
def _weakness(text: str) -> str:
    """Do what `weakness` does, once for each scene."""
    scene = read_scene_text(text)
    try:
        found = modes(scene)
    except ValueError:
        return ""
    own = [mode for mode in found.modes if mode.frequency <= HIGHEST and is_of_rings(mode)]
    weakest = min(own, key=lambda mode: mode.damping, default=None)
    if weakest is None:
        return ""
    if weakest.damping < LEAST:
        return _words(weakest, f"damping ratio {weakest.damping:.4f}, below {LEAST:g}")
    system = found.linearised
    at = rates(
        np.array([system.speed]), np.array([system.orbit]), np.array([system.spin]),
        scene.bearing.ball_count,
    )  # fmt: skip
    for line in lines(scene, at, {mode.order for mode in own}, HIGHEST, unbalance(scene)):
        for mode in own:
            apart = abs(float(line.frequency[0]) - mode.frequency)
            within = mode.damping < NARROW and apart <= 2.0 * mode.damping * mode.frequency
            if within and line.present and can_move(line, mode):
                return _words(mode, f"{mode.damping:.4f}, and {line.name} of {line.source} stands on it")
    return ""


def _words(mode: Mode, why: str) -> str:
    return f"the rings' mode '{mode.label}' at {mode.frequency:.0f} Hz is weakly damped ({why})"
