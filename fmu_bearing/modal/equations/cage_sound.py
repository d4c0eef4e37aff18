"""How much of the levels of full is the cage's own sound, which fidelities rings and response leave out."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.interface.outputs import outputs_of
from fmu_bearing.prepare.sound_block import silenced, sound_blocks
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

# s, chosen: over 0.3 s the loss of levels of the 7003C and the 7009C-spindle is within 0.7 dB(A) of this
_START, _LONG = 0.01, 0.06
_STEP = 1e-3  # s
_INAUDIBLE = 0.0  # dB(A): quieter microphones are not counted


def loss_without_cage(scene: Scene, inputs: Mapping[int, float] | None = None) -> float:
    """Return by how much (dB) the A-weighted level of full falls without its cage's sound, 0 or more.

    The largest over the microphones, over `_LONG` from a start in equilibrium: two runs of the same motion.
    They need the filters of the scene's own radiation model, which a run of the scene needs, too.

    Parameters
    ----------
    scene : Scene
        With sound.
    inputs : mapping, optional
        Values by their places in ``u`` in place of the scene's, SI units.

    Raises
    ------
    EngineError
        Where there is no equilibrium, or a run has no step to go on with.
    ValueError
        As `sound_blocks`.
    """
    metered = {"metering_start_s": _START, "third_octaves": False, "details": False}
    assert scene.sound is not None
    full = with_fidelity(scene, model="full").model_copy(
        update={"sound": scene.sound.model_copy(update=metered)}
    )
    blocks = sound_blocks(full)
    quiet = [silenced(block, "cage") for block in blocks]
    if all(np.array_equal(block, other) for block, other in zip(blocks, quiet, strict=True)):
        return 0.0
    whole, rest = (_levels(full, sounds, inputs or {}) for sounds in (blocks, quiet))
    audible = whole > _INAUDIBLE
    return float(np.max((whole - rest)[audible], initial=0.0))


def _levels(
    scene: Scene, sounds: Sequence[NDArray[np.float64]], inputs: Mapping[int, float]
) -> NDArray[np.float64]:
    """Return the mean A-weighted level (dB) at each microphone."""
    run = Arrays.of(scene, *sounds).at(inputs).init()
    run.run(_LONG, _STEP)
    return run.z[[variable.index for variable in outputs_of(scene) if variable.name.endswith(".leq_a")]]
