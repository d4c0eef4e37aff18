"""What natural motions say about fidelities rings and response, for what resolves and builds models.

The one arrow that points up: `modal` linearises the arrays of this package, so it lies above it, and fidelity
``auto`` needs its answer before there is a run. It is asked when called, and `.importlinter` names it.
"""

from fmu_bearing.scene import Scene


def doubt(scene: Scene) -> str:
    """Return what `modal.weak.doubt` does; of a scene without sound nothing about its levels."""
    from fmu_bearing.modal import weak

    found = weak.doubt(scene)
    return "" if scene.sound is None and weak.is_of_levels(found) else found


def reason_against(scene: Scene, speed: float) -> str:
    """Return why fidelities rings and response are no candidates at a speed (rad/s); "": they are.

    A mode of the rings grows by itself or is weakly damped, or no steady state was found: what a window of
    some hundredths of a second shows then means little.
    """
    from fmu_bearing.modal import weak

    at = {"shaft_speed": speed}
    return "no steady state was found" if weak.unsteady(scene, at) else weak.weakness(scene, at)
