"""Where figures of fidelities rings and response are in doubt: a ring that whirls by itself, weak damping.

Both hold friction and the cage's speed, and condense the balls about the steady state. Where a mode of the
rings grows there, `full` leaves that state, and torque, heat and levels of the other two belong to a point
that does not last. Where little damping is left, or a line lies within the peak of such a mode, a small error
of damping or frequency is one of decibels, and motions that grow large are limited by effects that they leave
out.

All places that print figures call `doubt`, and print what it returns.
"""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from fmu_bearing.interface.table import inputs_of
from fmu_bearing.modal.campbell.diagram import can_move, is_of_rings
from fmu_bearing.modal.campbell.excitation_lines import lines, rates, unbalance
from fmu_bearing.modal.equations.remarks import UNSTEADY
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.modal.modes.natural_modes import Modes, self_excited
from fmu_bearing.modal.modes.points import modes
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import read_scene_text, with_fidelity

# Damping ratios, chosen: the 7009C with steel balls has 0.008 at 11,000 r/min, where both fidelities miss by
# 6 dB(A), and 0.016 at 10,000 r/min; the 7003C in its spindle, which they follow within 1 dB(A), 0.015.
LEAST = 0.01
NARROW = 0.015  # of modes on which a line counts
HIGHEST = 20e3  # Hz: what sound is computed to
_LEVELS = "levels"


def doubt(scene: Scene, inputs: Mapping[str, float] | None = None) -> str:
    """Return why figures by a scene's own fidelity are in doubt; empty: they are not, or it is full.

    Where a ring whirls by itself, and where no steady state was found, all figures are in doubt, else levels
    alone.

    Parameters
    ----------
    scene : Scene
    inputs : mapping, optional
        Inputs by name, SI units, in place of the scene's; parameters among them are ignored.
    """
    model = scene.fidelity.model
    if model in ("full", "auto"):
        return ""
    if unsteady(scene, inputs):
        return f"fidelity {model}: {UNSTEADY}"
    if whirls := whirl(scene, inputs):
        return f"fidelity {model}: {whirls}"
    reason = weakness(scene, inputs)
    return reason and (
        f"{_LEVELS} of fidelity {model} are in doubt here: {reason}, and a small error of "
        "damping or frequency is one of several dB; take fidelity full"
    )


def is_of_levels(text: str) -> bool:
    """Whether what `doubt` returned is about levels alone, not about torque, heat and vibration too."""
    return text.startswith(_LEVELS)


def unsteady(scene: Scene, inputs: Mapping[str, float] | None = None) -> bool:
    """Whether there is an equilibrium but no steady state: then no growth is judged."""
    found = _at(scene, inputs)
    return found is not None and not found.linearised.steady


def whirl(scene: Scene, inputs: Mapping[str, float] | None = None) -> str:
    """Return that a ring, or a set, whirls by itself at the steady state, what that means, and what stops it.

    Empty where no mode of the rings grows (`modes.self_excited`), and where there is no equilibrium: runs
    report that themselves. The cage is left out and rings are rigid.
    """
    found = _at(scene, inputs)
    if found is None or (mode := _grows(found)) is None:
        return ""
    return whirl_words(mode.frequency, mode.growth, found.on_shaft)


def whirl_words(frequency: float, growth: float, of_set: bool) -> str:
    """Return the words about a motion that grows (1/s) by itself at a frequency (Hz)."""
    body, way = (
        "the ring whirls by itself",
        "more preload or a support against tilting (mounting.tilt_support) stops it",
    )
    if of_set:
        body, way = "the set whirls by itself", "more preload or a stiffer shaft stops it"
    # no number among the first words, by which repeated warnings are recognised
    return (
        f"{body}, figures are of the unstable point, and only fidelity full shows the whirl: its motion "
        f"grows by {growth:.0f} 1/s at {frequency:.0f} Hz (linearised equations, no standard); {way}"
    )


def weakness(scene: Scene, inputs: Mapping[str, float] | None = None) -> str:
    """Return the mode for which fidelities rings and response cannot be trusted with a level, or "".

    A mode of the rings, with the cage left out and rings rigid, grows by itself or has a damping ratio below
    `LEAST`; or a line that the scene contains and that can move a mode with one below `NARROW` lies within
    the width of its peak at half power. Where there is no equilibrium the result is empty: runs report
    that themselves. Of a set growth alone counts: its modes are modes of the shaft, mostly with damping
    ratios about these bounds, and were not compared.
    """
    found = _at(scene, inputs)
    if found is None:
        return ""
    if (grows := _grows(found)) is not None:
        return (
            f"the {found.body} whirls by itself at {grows.frequency:.0f} Hz (growth {grows.growth:.0f} 1/s)"
        )
    if found.on_shaft:
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
                return _words(
                    mode, f"{mode.damping:.4f}, and {line.name} of {line.source} lies within its peak"
                )
    return ""


def _grows(found: Modes) -> Mode | None:
    """Return the mode that grows by itself; None where none does or the state is not steady."""
    return self_excited(found) if found.linearised.steady else None


def _at(scene: Scene, inputs: Mapping[str, float] | None) -> Modes | None:
    """Return the modes of a scene with rigid rings at its inputs; None where there is no equilibrium."""
    names = {variable.name for variable in inputs_of(scene)}
    given = tuple(sorted((name, float(x)) for name, x in (inputs or {}).items() if name in names))
    # what modes leave out is not part of the key
    bare = scene.with_rigid_rings().model_copy(update={"sound": None, "imperfections": None})
    return _modes(with_fidelity(bare, model="full").to_toml(), given)


@lru_cache(maxsize=64)
def _modes(text: str, inputs: tuple[tuple[str, float], ...]) -> Modes | None:
    """Return the modes of a scene, once for each text and inputs: about 0.1 s, of four bearings 0.8 s."""
    scene = read_scene_text(text)
    try:
        return modes(scene, dict(inputs))
    except ValueError:
        return None


def _words(mode: Mode, why: str) -> str:
    return f"the rings' mode '{mode.label}' at {mode.frequency:.0f} Hz is weakly damped ({why})"
