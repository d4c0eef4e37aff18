"""The motion by which a ring, or a set, whirls by itself: with its cage as it runs."""

from collections.abc import Mapping

import numpy as np

from fmu_bearing.arrays import EngineError
from fmu_bearing.modal.equations.quick import engine_growth, operator_matrix, quick_run
from fmu_bearing.modal.modes.mode import GROWS, LOWEST
from fmu_bearing.modal.modes.natural_modes import Modes, self_excited
from fmu_bearing.modal.modes.points import given
from fmu_bearing.scene import Scene

_BESIDE = 0.02  # of the orbits' speed, chosen
_HELD = 0.003  # damping ratio, chosen: with less, a cage hardly holds what grows without it


def self_excitation(
    scene: Scene, modes: Modes, inputs: Mapping[str, float] | None = None
) -> tuple[float, float] | None:
    """Return frequency (Hz) and growth (1/s) of the motion that grows fastest by itself; None: none grows.

    By the operator of the quick fidelities, which holds the cages whirling in their lands and pressing on
    their balls: a pair of 7008AC at 30,000 r/min and 100 N grows by 370 1/s without its cages, and decays
    with them (fidelity full: 34 and 0.07 mm/s). It is what their runs give as ``solver.growth``. Where cages
    hardly hold what grows without them it is named, too: their whirl changes with surfaces and loads (7009C
    in full ceramic, 18,000 r/min: damping ratio 0.0004 with its cage, and `full` whirls at 20 mm/s).

    Parameters
    ----------
    scene : Scene
        With rigid rings.
    found : Modes
        The modes there, without cages.
    inputs : mapping, optional
        Inputs by name, SI units, in place of the scene's.
    """
    alone = self_excited(modes)
    if alone is None and scene.assembly.joined:
        return None
    without = None if alone is None else (alone.frequency, alone.growth)
    try:
        run = quick_run(scene, given(scene, inputs))
    except EngineError:  # no equilibrium
        return without
    frequency, growth = engine_growth(run)
    if growth > GROWS:
        return frequency, growth
    if without is None:
        return None
    rates = np.linalg.eigvals(operator_matrix(run))
    orbit = abs(modes.linearised.orbit)
    # balls that drift along their orbits with the cage move no ring
    rates = rates[(rates.imag > 2.0 * np.pi * LOWEST) & (np.abs(rates.imag - orbit) > _BESIDE * orbit)]
    hardly = bool(rates.size and np.any(rates.real > -_HELD * rates.imag))
    return without if hardly else None
