"""The table of variables as the FMU of a scene has it: ``[fmu]`` of the scene."""

import re
from collections.abc import Sequence
from dataclasses import replace

from fmu_bearing.interface.names import UnknownName, chosen_names, matching
from fmu_bearing.interface.variable import Variable
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.fmu import Fmu

__all__ = ["GROUPS", "USUAL", "flat", "fmu_variables"]

#: What is an output where the scene names none.
USUAL = "usual"
#: Words for outputs that belong together, of a bearing and of each of a set.
GROUPS = {
    "velocities": ("*_ring.velocity.*", "*_ring.flexure.*", "*cage.velocity.*", "shaft.nose.velocity.*",
                   "housing.velocity.*"),
    "balls": ("*ball[*].velocity.*",),
    "displacements": ("*_ring.displacement.*", "*_ring.tilt.*", "shaft.nose.displacement.*",
                      "shaft.nose.tilt.*", "housing.displacement.*"),
    "contacts": ("*contact.*", "*film.lambda_min"),
    "stiffness": ("*stiffness.*",),
    "levels": ("mic[*].spl*", "mic[*].leq*", "mic[*].third_octave[*]"),
    "energy": ("*heat.*", "*friction_torque*", "energy.residual"),
    "defects": ("*defect[*].*",),
    "forces": ("bearing[*].force.*", "bearing[*].moment.*", "port.force*", "port.moment*"),
}  # fmt: skip
_ALWAYS = "friction_torque"  # a shaft cannot be driven without it

_NO_IDENTIFIER = re.compile(r"[.\[]")


def flat(name: str) -> str:
    """Return a name as an identifier: ``ball_3_velocity_y`` for ``ball[3].velocity.y``."""
    return _NO_IDENTIFIER.sub("_", name).replace("]", "")


def fmu_variables(scene: Scene, variables: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return the variables with the names and causalities that the FMU gives them, in the same order.

    Where ``fmu.outputs`` names what is output, all else that is computed is left out.

    Raises
    ------
    SceneError
        If ``fmu.outputs`` or ``fmu.inputs`` names no such variable, or one that can be neither.
    """
    choice = scene.fmu or Fmu()
    inputs = [variable.name for variable in variables if variable.causality == "input"]
    promotable = [variable.name for variable in variables if variable.causality in ("local", "output")]
    usual = [variable.name for variable in variables if variable.causality == "output"]
    outputs = set(usual if choice.outputs is None else _outputs(choice.outputs, promotable, usual, inputs))
    kept = set(inputs if choice.inputs is None else _chosen("inputs", choice.inputs, inputs, promotable))
    table = []
    for variable in variables:
        if variable.name in outputs:
            variable = replace(variable, causality="output")
        elif choice.outputs is not None and variable.array == "z":
            continue
        elif variable.causality == "input" and variable.name not in kept:
            variable = replace(variable, causality="parameter", variability="tunable")
        if choice.naming == "flat":
            variable = replace(variable, name=flat(variable.name))
        table.append(variable)
    names = {variable.name for variable in table}
    assert len(names) == len(table), "two variables have one flat name"
    return tuple(table)


def _outputs(asked: Sequence[str], names: list[str], usual: list[str], inputs: list[str]) -> list[str]:
    """Return the names of the outputs that names, patterns and words for groups ask for."""
    outputs = [_ALWAYS]
    for word in asked:
        group = [name for pattern in GROUPS.get(word, ()) for name in matching(pattern, names)]
        if word == USUAL:
            outputs += usual
        elif word not in GROUPS:
            outputs += _chosen("outputs", [word], names, inputs)
        elif group:
            outputs += group
        else:
            missing = ", ".join(GROUPS[word])
            raise SceneError(f"fmu.outputs: this scene has nothing of '{word}' ({missing}); leave it out")
    return outputs


def _chosen(key: str, patterns: Sequence[str], names: list[str], others: list[str]) -> list[str]:
    """Return the names that match; a name of the other kind is refused as such."""
    for pattern in patterns:
        if pattern in others:
            what = "an input" if key == "outputs" else "not an input: it is computed"
            raise SceneError(f"fmu.{key}: '{pattern}' is {what}; leave it out")
    try:
        return chosen_names(patterns, names, [], (USUAL, *GROUPS) if key == "outputs" else ())
    except UnknownName as problem:
        raise SceneError(f"fmu.{key}: {problem}") from None
