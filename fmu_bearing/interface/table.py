"""All variables of a scene in one table, and the values of its inputs."""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import U
from fmu_bearing.interface.inputs import inputs
from fmu_bearing.interface.outputs import internals, outputs
from fmu_bearing.interface.parameters import constants, parameters
from fmu_bearing.interface.set_inputs import inputs_of_set, set_inputs
from fmu_bearing.interface.set_outputs import internals_of_set, outputs_of_set
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
        *(internals(scene) if scene.assembly.shaft is None else internals_of_set(scene)),
        *parameters(scene),
        *constants(scene, rotor_inertia, rings),
    ]
    names = [variable.name for variable in table]
    assert len(set(names)) == len(names), "a variable name is given twice"
    return tuple(table)


def inputs_of(scene: Scene) -> list[Variable]:
    """Return the inputs of a scene, of its single bearing or of its set."""
    return inputs(scene) if scene.assembly.shaft is None else inputs_of_set(scene)


def outputs_of(scene: Scene) -> list[Variable]:
    """Return the outputs of a scene, of its single bearing or of its set."""
    return outputs(scene) if scene.assembly.shaft is None else outputs_of_set(scene)


def input_values(scene: Scene) -> NDArray[np.float64]:
    """Return the engine's inputs ``u`` at the scene's operating point, SI units.

    Inputs of a set that are no variables are included.
    """
    if scene.assembly.shaft is not None:
        return set_inputs(scene)
    values = {variable.index: variable.start for variable in inputs(scene)}
    # a partner without a temperature of its own has its ring's
    values = {U.SHAFT_T: values[U.INNER_T], U.HOUSING_T: values[U.OUTER_T]} | values
    return np.array([values[place] for place in range(U.SIZE)])
