"""Where figures of fidelities rings and response are in doubt: a ring that whirls by itself, weak damping.

Both hold friction and the cage's speed, and condense the balls about the steady state. Where a mode of the
rings grows there, `full` leaves that state, and torque, heat and levels of the other two belong to a point
that does not last. Where little damping is left, or a line lies within the peak of such a mode, a small error
of damping or frequency is one of decibels, and motions that grow large are limited by effects that they leave
out.

A load across the axis makes balls strike the pockets of the cage, which moves the rings, and a whirl may
start from a larger motion alone; both are left out. A short run beside full shows them. The cage's own sound
is left out, too: two short runs of full, with it and without, show what it does to levels.

All places that print figures call `doubt`, and print what it returns.
"""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from fmu_bearing.arrays import EngineError
from fmu_bearing.interface.inputs import inputs_of
from fmu_bearing.modal.campbell.diagram import can_move, is_of_rings
from fmu_bearing.modal.campbell.excitation_lines import lines, rates, unbalance
from fmu_bearing.modal.equations.beside_full import BesideFull, beside_full
from fmu_bearing.modal.equations.cage_sound import loss_without_cage
from fmu_bearing.modal.equations.remarks import LOOSE, UNSTEADY
from fmu_bearing.modal.modes.growth import self_excitation
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.modal.modes.points import given, modes
from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import exclusion
from fmu_bearing.scene.read import read_scene_text, with_fidelity

# Damping ratios, chosen: the 7009C with steel balls has 0.008 at 11,000 r/min, where both fidelities miss by
# 6 dB(A), and 0.016 at 10,000 r/min; the 7003C in its spindle, which they follow within 1 dB(A), 0.015.
LEAST = 0.01
NARROW = 0.015  # of modes on which a line counts
HIGHEST = 20e3  # Hz: what sound is computed to
# Rms of a ring over that in full, or its inverse, chosen: of 90 scenes drawn at random those without a whirl
# or strikes in pockets lie within 0.83 and 1.2.
FAR = 1.25
LOUD = 3.0  # chosen: with as many times the motion contact loads are in doubt, too
# Share of the room in pockets, chosen: NSK-7014C, 9,000 r/min, 386 N and 100, 150, 200, 386, 700 N across:
# 0.08, 0.26, 0.54, 1, 1. There levels of rings are 1, 7, 9, 21 and 26 dB(A) low at the worst of four
# microphones, where the cage is loud.
PLAY = 0.2
QUIETER = 0.9  # dB(A), chosen: levels are promised to be within 1 dB(A) of full, a tenth is left for the rest
_LEVELS = "levels"


def doubt(scene: Scene, inputs: Mapping[str, float] | None = None, radiation_model: str | None = None) -> str:
    """Return why figures by a scene's own fidelity are in doubt; empty: they are not, or it is full.

    Where a ring whirls by itself, and where no steady state was found, all figures are in doubt; where the
    cage carries loose balls, and where rings depart from full in a short run, levels and velocities are, and
    contact loads where they move `LOUD` times as much; else levels alone.

    Parameters
    ----------
    scene : Scene
    inputs : mapping, optional
        Inputs by name, SI units, in place of the scene's; parameters among them are ignored.
    radiation_model : str, optional
        Of the levels, in the place of the scene's.
    """
    model = scene.fidelity.model
    if model in ("full", "auto"):
        return ""
    if (at := _at(scene, inputs)) is not None and not at.linearised.steady:
        if not at.linearised.carried:
            return f"fidelity {model}: {UNSTEADY}"
        return f"{_LEVELS} and velocities of fidelity {model} are in doubt here: {LOOSE}; take fidelity full"
    if whirls := whirl(scene, inputs):
        return f"fidelity {model}: {whirls}"
    if far := rings_depart(scene, model, inputs):
        why = pockets_struck(scene, model, inputs) or weakly_damped(scene, inputs)
        reason = ", and ".join(filter(None, (far, why)))
        what = f"{_LEVELS} and velocities"
        if moves_far_more(scene, model, inputs):
            what = "contact loads, levels and velocities"
        return f"{what} of fidelity {model} are in doubt here: {reason}; take fidelity full"
    reason = pockets_struck(scene, model, inputs) or loud_cage(scene, inputs, radiation_model)
    if not reason and (reason := weakly_damped(scene, inputs)):
        reason += ", and a small error of damping or frequency is one of several dB"
    return reason and f"{_LEVELS} of fidelity {model} are in doubt here: {reason}; take fidelity full"


def is_of_levels(text: str) -> bool:
    """Whether what `doubt` returned is about levels alone, not about torque, heat and vibration too."""
    return text.startswith(f"{_LEVELS} of")


def is_of_motion(text: str) -> bool:
    """Whether what `doubt` returned is about levels and velocities, not about torque and heat too."""
    return text.startswith(f"{_LEVELS} and")


def unsteady(scene: Scene, inputs: Mapping[str, float] | None = None) -> bool:
    """Whether there is an equilibrium but no steady state: then no growth is judged."""
    modes = _at(scene, inputs)
    return modes is not None and not modes.linearised.steady


def whirl(scene: Scene, inputs: Mapping[str, float] | None = None) -> str:
    """Return that a ring, or a set, whirls by itself at the steady state, what that means, and what stops it.

    Empty where no motion of rings and cage grows (`modes.growth`), and where there is no equilibrium: runs
    report that themselves. Rings are rigid.
    """
    whirls = _whirls(scene, inputs)
    return "" if whirls is None else whirl_words(*whirls, scene)


def whirl_words(frequency: float, growth: float, scene: Scene) -> str:
    """Return the words about a motion that grows (1/s) by itself at a frequency (Hz)."""
    body, way = (
        "the ring whirls by itself",
        "more preload or a support against tilting (mounting.tilt_support) stops it",
    )
    if scene.assembly.joined:
        body, way = "the set whirls by itself", "more preload or a stiffer shaft stops it"
    # no number among the first words, by which repeated warnings are recognised
    return (
        f"{body}, figures are of the unstable point, and only fidelity full shows the whirl: its motion "
        f"grows by {growth:.0f} 1/s at {frequency:.0f} Hz (linearised equations, no standard); {way}"
    )


def reason_for_doubt(
    scene: Scene, inputs: Mapping[str, float] | None = None, radiation_model: str | None = None
) -> str:
    """Return why fidelities rings and response cannot be trusted with a level, or "".

    A motion of rings and cage grows by itself, rings depart from full in a short run, balls strike the
    pockets of a cage, the cage is loud, or a mode is weakly damped. Where there is no equilibrium the result
    is empty: runs report that themselves. ``radiation_model``: of the levels, in the place of the scene's.
    """
    if (modes := _at(scene, inputs)) is None:
        return ""
    if (whirls := _whirls(scene, inputs)) is not None:
        return f"the {modes.body} whirls by itself at {whirls[0]:.0f} Hz (growth {whirls[1]:.0f} 1/s)"
    own = scene.fidelity.model
    # the linear one is refused where contacts lose load over local defects
    other = "response" if exclusion(scene, "response") is None else "rings"
    model = own if own in ("rings", "response") else other
    return (
        rings_depart(scene, model, inputs)
        or pockets_struck(scene, model, inputs)
        or loud_cage(scene, inputs, radiation_model)
        or weakly_damped(scene, inputs)
    )


def rings_depart(scene: Scene, model: str, inputs: Mapping[str, float] | None = None) -> str:
    """Return how far rings of fidelity rings or response depart from full in a short run, or ""."""
    run = _beside(*_key(scene, inputs, flaws=True), model)
    if run is None or 1.0 / FAR < run.ratio < FAR:
        return ""
    return f"in {1e3 * run.seconds:.0f} ms the rms {run.what} is {run.ratio:.2f} of what it is in full"


def moves_far_more(scene: Scene, model: str, inputs: Mapping[str, float] | None = None) -> bool:
    """Whether rings of fidelity rings or response move more than `LOUD` times as much as in full."""
    run = _beside(*_key(scene, inputs, flaws=True), model)
    return run is not None and run.ratio > LOUD


def pockets_struck(scene: Scene, model: str, inputs: Mapping[str, float] | None = None) -> str:
    """Return that balls strike the pockets of a cage in a short run, which rings and response leave out."""
    run = _beside(*_key(scene, inputs, flaws=True), model)
    if run is None or max(run.play) <= PLAY:
        return ""
    worst = int(np.argmax(run.play))
    return (
        f"balls strike the pockets of the cage of {scene.assembly.name(worst + 1)}, which a load across "
        "their orbits makes them leave and strike "
        f"(they use {100.0 * min(run.play[worst], 1.0):.0f} % of the room there), and the sound and the "
        "motion by that are left out"
    )


def loud_cage(
    scene: Scene, inputs: Mapping[str, float] | None = None, radiation_model: str | None = None
) -> str:
    """Return that the cage's own sound, which rings and response leave out, makes out a level, or ""."""
    if scene.sound is None:
        return ""
    if radiation_model is not None:
        sound = scene.sound.model_copy(update={"radiation_model": radiation_model})
        scene = scene.model_copy(update={"sound": sound})
    text = with_fidelity(scene, model="full").to_toml()
    loss = _loss_without_cage(text, _known(scene, inputs))
    if loss <= QUIETER:
        return ""
    return (
        f"the cage's own sound is left out, without which a level of full is {loss:.1f} dB(A) lower at the "
        "worst microphone"
    )


def weakly_damped(scene: Scene, inputs: Mapping[str, float] | None = None) -> str:
    """Return which mode of the rings has too little damping for a level to be trusted, or "".

    A mode of the rings, with the cage left out and rings rigid, has a damping ratio below `LEAST`; or a line
    that the scene contains and that can move a mode with one below `NARROW` lies within the width of its peak
    at half power. Of a set growth alone counts: its modes are modes of the shaft, mostly with damping ratios
    about these bounds, and were not compared.
    """
    modes = _at(scene, inputs)
    if modes is None or modes.on_shaft:
        return ""
    own = [mode for mode in modes.modes if mode.frequency <= HIGHEST and is_of_rings(mode)]
    weakest = min(own, key=lambda mode: mode.damping, default=None)
    if weakest is None:
        return ""
    if weakest.damping < LEAST:
        return _words(weakest, f"damping ratio {weakest.damping:.4f}, below {LEAST:g}")
    system = modes.linearised
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


def _whirls(scene: Scene, inputs: Mapping[str, float] | None) -> tuple[float, float] | None:
    """Return frequency and growth of what grows by itself; None where nothing does or no state is steady."""
    modes = _at(scene, inputs)
    return None if modes is None or not modes.linearised.steady else _growth(*_key(scene, inputs))


def _at(scene: Scene, inputs: Mapping[str, float] | None) -> Modes | None:
    """Return the modes of a scene with rigid rings at its inputs; None where there is no equilibrium."""
    return _modes(*_key(scene, inputs))


def _key(
    scene: Scene, inputs: Mapping[str, float] | None, flaws: bool = False
) -> tuple[str, tuple[tuple[str, float], ...]]:
    """Return the text of a scene without what modes leave out, and its inputs by name.

    ``flaws``: with its imperfections.
    """
    bare = scene.with_rigid_rings().model_copy(update={"sound": None})
    if not flaws:
        bare = bare.model_copy(update={"imperfections": None})
    return with_fidelity(bare, model="full").to_toml(), _known(scene, inputs)


def _known(scene: Scene, inputs: Mapping[str, float] | None) -> tuple[tuple[str, float], ...]:
    """Return the inputs of a scene by name, in order; parameters among them are left out."""
    names = {variable.name for variable in inputs_of(scene)}
    return tuple(sorted((name, float(x)) for name, x in (inputs or {}).items() if name in names))


@lru_cache(maxsize=64)
def _growth(text: str, inputs: tuple[tuple[str, float], ...]) -> tuple[float, float] | None:
    """Return what grows by itself, once for each text and inputs, as `_modes`."""
    modes = _modes(text, inputs)
    assert modes is not None
    return self_excitation(read_scene_text(text), modes, dict(inputs))


@lru_cache(maxsize=64)
def _modes(text: str, inputs: tuple[tuple[str, float], ...]) -> Modes | None:
    """Return the modes of a scene, once for each text and inputs: about 0.1 s, of four bearings 0.8 s."""
    scene = read_scene_text(text)
    try:
        return modes(scene, dict(inputs))
    except ValueError:
        return None


@lru_cache(maxsize=64)
def _beside(text: str, inputs: tuple[tuple[str, float], ...], model: str) -> BesideFull | None:
    """Return a short run beside full, as `_modes`: 0.2 to 1 s, of four bearings 3 s; None: none goes."""
    scene = read_scene_text(text)
    try:
        return beside_full(scene, model, given(scene, dict(inputs)))
    except EngineError:
        return None


@lru_cache(maxsize=64)
def _loss_without_cage(text: str, inputs: tuple[tuple[str, float], ...]) -> float:
    """Return what `loss_without_cage` finds, as `_modes`: 0.2 to 0.5 s with known filters; 0: no run goes."""
    scene = read_scene_text(text)
    try:
        return loss_without_cage(scene, given(scene, dict(inputs)))
    except ValueError:
        return 0.0


def _words(mode: Mode, why: str) -> str:
    return f"the rings' mode '{mode.label}' at {mode.frequency:.0f} Hz is weakly damped ({why})"
