"""Bearings in which nothing asks for short steps: without waves, local defects, sound and cage."""

import math

from fmu_bearing.engine.constants import LONGEST_STEP, PER_STEP, RPM, USUAL_STEP
from fmu_bearing.prepare.imperfections import ball_waves, frequencies, race_harmonics
from fmu_bearing.scene import Scene, si

_ROUNDING = 1e-9  # of the default step


def turn_rate(scene: Scene, silent: bool) -> float:
    """Fastest whirl (rad per rad of the shaft) to follow where nothing else asks for short steps.

    ``silent``: neither microphones nor accelerometers follow it.

    It is twice the balls' turning about their axes and about the shaft. Rings that whirl by themselves are
    driven by the friction of turning balls, and of 170 bearings none was found that whirls faster (1.98
    of this sum at most). 0: something else asks for short steps, or the method is not the default.
    """
    wavy = any(race.amplitudes.any() for race in race_harmonics(scene)) or ball_waves(scene)[0].size > 0
    if scene.imperfections is not None and scene.imperfections.defect:
        return 0.0
    guided = scene.bearing.cage is not None or scene.bearing.ball_springs is not None
    if not silent or wavy or guided or scene.fidelity.method != "esdirk4":
        return 0.0
    rates = frequencies(scene, 2.0 * math.pi)  # at one turn per second
    return 2.0 * float(rates.f_b + rates.f_c)


def longest_internal_step(scene: Scene) -> float:
    """Longest internal step (s) at the scene's own speed, where waves and bending rings do not bound it."""
    given = si(scene.fidelity).max_internal_step
    changed = abs(given - USUAL_STEP) > _ROUNDING * USUAL_STEP
    silent = scene.sound is None and not scene.accelerometers
    rates = [turn_rate(bearing.scene, silent) for bearing in scene.bearings()]
    if changed or scene.fidelity.model != "full" or scene.on_other_shaft or min(rates) == 0.0:
        return given
    rate = max(rates)
    turning = rate * abs(scene.operation.speed_rpm) * RPM
    return max(USUAL_STEP, min(LONGEST_STEP, PER_STEP / max(turning, PER_STEP / LONGEST_STEP)))
