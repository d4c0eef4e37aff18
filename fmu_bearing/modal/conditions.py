"""Operating points: inputs of the model by name, checked against their ranges."""

from collections.abc import Mapping

from fmu_bearing.instance import check, number
from fmu_bearing.interface.inputs import inputs
from fmu_bearing.interface.names import known
from fmu_bearing.interface.set_inputs import inputs_of_set
from fmu_bearing.scene import Scene


def given(scene: Scene, values: Mapping[str, float] | None) -> dict[int, float]:
    """Return inputs by their places in ``layout.U``, of a set by those in ``SP.INPUTS``.

    Raises
    ------
    ValueError
        For an unknown name, what is no number, and a value outside its range.
    """
    own = inputs(scene) if scene.spindle is None else inputs_of_set(scene)
    table = {variable.name: variable for variable in own}
    found = {}
    for name, value in (values or {}).items():
        variable = table[known(name, list(table), "input")]
        found[variable.index] = number(name, value)
        check(variable, found[variable.index])
    return found
