"""Names of variables of FMUs of any scene, and values given by name."""

import functools
import re
from collections.abc import Mapping
from dataclasses import replace

from fmu_bearing.interface import flat, variables
from fmu_bearing.scene import Scene, read_scene_text
from fmu_bearing.scene.problems import described
from fmu_bearing.scene.template import new_scene

_NUMBER = re.compile(r"_\d+(?=_|$)")


@functools.cache
def _usual_units() -> dict[str, str]:
    """Return units by flat name of the variables of scenes with all options, without indices."""
    scene = read_scene_text(new_scene("any", "7003C"))
    defects = [variable for variable in variables(spalled(scene), 0.0) if variable.name.startswith("defect[")]
    every = [
        *variables(scene, 0.0),
        *defects,
        *(replace(variable, name=f"bearing[1].{variable.name}") for variable in defects),
        *(variable for found in any_sets(scene) for variable in variables(found, 0.0)),
    ]
    return {_without_index(variable.name): variable.unit for variable in every}


def spalled(scene: Scene) -> Scene:
    """Return a scene of one bearing with a local defect."""
    return scene.replace({
        "imperfections.defect": [{"on": "outer", "shape": "spall", "length_mm": 0.1, "depth_um": 1.0}]
    })  # fmt: skip


def any_sets(scene: Scene) -> tuple[Scene, Scene]:
    """Return sets of a scene's bearing that together have all variables.

    One has springs, a moving housing and sound; the other a mechanical port.
    """
    pair = [
        {"position_mm": 10.0, "carries": "+x"},
        {"position_mm": 10.0 + 2.0 * scene.bearing.width_mm, "carries": "-x", "seat": "sliding"},
    ]
    housing = {"mass_kg": 1.0, "diameter_mm": 100.0, "length_mm": 100.0, "pedestal_stiffness_N_m": 1e8}
    spindle = {
        "shaft": {"sections_mm": [[500.0, scene.bearing.bore_mm, 0.0]]},
        "bearing": pair,
        "preload": {"kind": "spring", "force_N": 100.0},
        "housing": housing,
    }
    sound = {
        "radiation_model": "compact",
        "third_octaves": True,
        "circle": {"radius_mm": 10.0 * scene.bearing.outside_diameter_mm, "axial_mm": 0.0, "count": 1},
    }
    tables = scene.model_dump() | {"mounting": None, "sound": sound, "imperfections": None}
    at_port = {"shaft": {"external": True}, "bearing": pair[:1]}
    sensor = {"name": "sensor", "bearing": 1}
    return (
        Scene.from_dict(tables | {"spindle": spindle, "accelerometer": [sensor]}),
        Scene.from_dict(tables | {"spindle": at_port, "sound": None, "fidelity": {"model": "full"}}),
    )


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
