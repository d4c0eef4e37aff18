"""`modes`: natural motions of a scene's bearing, or of its set, at an operating point."""

from collections.abc import Mapping

from fmu_bearing.instance import check, number
from fmu_bearing.interface.inputs import inputs_of
from fmu_bearing.interface.names import known
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.modal.modes.solve import solved
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.threads import one_thread


def modes(scene: SceneSource, inputs: Mapping[str, float] | None = None, *, friction: bool = True) -> Modes:
    """Return the natural motions of a scene's mounted bearing, or of its set on the shaft, without a run.

    Fidelity `full` linearised about its steady state: rings with rotor and housing on their supports,
    every ball with its place, orbit and spin, rings that bend where the scene says so. Cage, imperfections
    and sound are left out.

    Parameters
    ----------
    scene : Scene or path
    inputs : mapping, optional
        Inputs of the model by name, SI units (``shaft_speed`` in rad/s, ``preload`` in N), in place of the
        scene's.
    friction : bool, optional
        False: contacts without traction. At standstill contacts stick; modes of a turning bearing
        lie between both.

    Raises
    ------
    ValueError
        For an input that is refused, or where there is no equilibrium.

    Examples
    --------
    >>> from fmu_bearing import modes
    >>> found = modes("examples/scenes/7003C-spindle.toml")
    >>> round(found.named("inner axial").frequency, -1)
    1200.0
    """
    scene = scene_of(scene)
    return at_point(scene, given(scene, inputs), friction)


@one_thread
def at_point(scene: Scene, inputs: dict[int, float], friction: bool = True) -> Modes:
    """Return the modes of a bearing, or of a set, at inputs by their places in the engine's ``u``."""
    return solved(scene, linearised(scene, inputs, friction), friction)


def given(scene: Scene, values: Mapping[str, float] | None) -> dict[int, float]:
    """Return inputs by their places in ``layout.U``.

    Raises
    ------
    ValueError
        For an unknown name, what is not a number, and a value outside its range.
    """
    table = {variable.name: variable for variable in inputs_of(scene)}
    inputs = {}
    for name, value in (values or {}).items():
        variable = table[known(name, list(table), "input")]
        inputs[variable.index] = number(name, value)
        check(variable, inputs[variable.index])
    return inputs
