"""The table of variables as the FMU of a scene has it: ``[fmu]`` of the scene."""

import re
from collections.abc import Sequence
from dataclasses import replace

from fmu_bearing.interface.names import UnknownName, chosen_names
from fmu_bearing.interface.variable import Variable
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.fmu import Fmu

__all__ = ["flat", "fmu_variables"]

_NO_IDENTIFIER = re.compile(r"[.\[]")


def flat(name: str) -> str:
    """Return a name as an identifier: ``ball_3_velocity_y`` for ``ball[3].velocity.y``."""
    return _NO_IDENTIFIER.sub("_", name).replace("]", "")


def fmu_variables(scene: Scene, variables: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return the variables with the names and causalities that the FMU gives them, in the same order.

    Raises
    ------
    SceneError
        If ``fmu.outputs`` or ``fmu.inputs`` names no such variable, or one that can be neither.
    """
    choice = scene.fmu or Fmu()
    inputs = [variable.name for variable in variables if variable.causality == "input"]
    promotable = [variable.name for variable in variables if variable.causality in ("local", "output")]
    outputs = set(_chosen("outputs", choice.outputs, promotable, inputs))
    kept = set(inputs if choice.inputs is None else _chosen("inputs", choice.inputs, inputs, promotable))
    table = []
    for variable in variables:
        if variable.name in outputs:
            variable = replace(variable, causality="output")
        elif variable.causality == "input" and variable.name not in kept:
            variable = replace(variable, causality="parameter", variability="tunable")
        if choice.naming == "flat":
            variable = replace(variable, name=flat(variable.name))
        table.append(variable)
    names = {variable.name for variable in table}
    assert len(names) == len(table), "two variables have one flat name"
    return tuple(table)


def _chosen(key: str, patterns: Sequence[str], names: list[str], others: list[str]) -> list[str]:
    """Return the names that match; a name of the other kind is refused as such."""
    for pattern in patterns:
        if pattern in others:
            what = "an input" if key == "outputs" else "not an input: it is computed"
            raise SceneError(f"fmu.{key}: '{pattern}' is {what}; leave it out")
    try:
        return chosen_names(patterns, names, [])
    except UnknownName as problem:
        raise SceneError(f"fmu.{key}: {problem}") from None
