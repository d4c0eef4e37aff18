"""Names of variables of FMUs of any scene, and values given by name."""

import functools
import re
from collections.abc import Mapping

from fmu_bearing.interface import flat, variables
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.problems import described
from fmu_bearing.scene.template import new_scene

_NUMBER = re.compile(r"_\d+(?=_|$)")


@functools.cache
def _usual_units() -> dict[str, str]:
    """Return units by flat name of the variables of a scene with all options, without indices."""
    scene = read_scene_text(new_scene("any", "7003C"))
    return {_without_index(variable.name): variable.unit for variable in variables(scene, 0.0)}


def _without_index(name: str) -> str:
    """Return the flat name, with a sign for any number: the same for ``mic[1].leq`` and ``mic_2_leq``."""
    return _NUMBER.sub("_#", flat(name))


def unit_of(name: str) -> str:
    """Return the unit that a variable of this name has in our FMUs; empty for others."""
    return _usual_units().get(_without_index(name), "")


def by_name(values: Mapping[str, float] | None) -> Mapping[str, float]:
    """Return values given by name, an empty mapping for None.

    Raises
    ------
    ValueError
        For what is no mapping of names.
    """
    if values is None:
        return {}
    if not isinstance(values, Mapping) or not all(isinstance(name, str) for name in values):
        raise ValueError(
            "inputs and parameters are given by name, as shaft_speed=2000.0 or {'radial_load.z': -1.0}, "
            f"not as {described(values)}"
        )
    return values
