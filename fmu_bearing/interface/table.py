"""All variables of a scene in one table."""

from fmu_bearing.interface.inputs import inputs_of
from fmu_bearing.interface.outputs import internals_of, outputs_of
from fmu_bearing.interface.parameters import constants, parameters
from fmu_bearing.interface.variable import Variable
from fmu_bearing.scene import Scene


def variables(
    scene: Scene, rotor_inertia: float, rings: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> tuple[Variable, ...]:
    """All variables of a scene, in the order of their value references.

    ``rotor_inertia`` is the polar inertia (kg m2) of what turns, for the variable of that name; ``rings`` are
    mass (kg), static moment (kg m) and transverse inertia (kg m2) of the inner rings at a mechanical port.
    Parts that the scene leaves out (cage, sound, imperfections) have no variables.
    """
    table = [
        *inputs_of(scene),
        *outputs_of(scene),
        *internals_of(scene),
        *parameters(scene),
        *constants(scene, rotor_inertia, rings),
    ]
    names = [variable.name for variable in table]
    assert len(set(names)) == len(names), "a variable name is given twice"
    return tuple(table)
