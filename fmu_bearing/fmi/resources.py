"""The numbers inside an FMU: the scene, the parameter array, and the fingerprint that binds them."""

import functools
import hashlib
import io
from pathlib import Path

import numpy as np

from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.fmi.fmu_model import as_fmu_model
from fmu_bearing.interface import variables
from fmu_bearing.prepare.bodies import rings_at_port, rotor_inertia
from fmu_bearing.prepare.model import Model
from fmu_bearing.scene import read_scene

__all__ = ["PARAMETERS", "SCENE", "fingerprint", "load", "parameter_bytes"]

SCENE = "scene.toml"
PARAMETERS = "parameters.npy"


def parameter_bytes(model: Model) -> bytes:
    """Return the file of the parameter array."""
    buffer = io.BytesIO()
    np.save(buffer, np.ascontiguousarray(model.parameters, dtype="<f8"), allow_pickle=False)
    return buffer.getvalue()


def fingerprint(model: Model) -> str:
    """Return a hash of all that determines the meaning of the numbers: variables, engine, the numbers.

    Wording is left out, so an FMU goes on working under a later package as long as the engine, the
    variables and their places are the same.
    """
    digest = hashlib.sha256()
    for variable in model.variables:
        face = (
            variable.name,
            variable.causality,
            variable.variability,
            variable.type,
            variable.unit,
            variable.min,
            variable.max,
            variable.start,
            variable.value,
            variable.array,
            variable.index,
        )
        digest.update(repr(face).encode("utf-8"))
    digest.update(engine_digest())
    digest.update(np.ascontiguousarray(model.parameters, dtype="<f8").tobytes())
    return digest.hexdigest()


@functools.lru_cache(maxsize=16)
def load(folder: Path, expected: str) -> Model:
    """Read a model back without preparing it again.

    Raises
    ------
    ValueError
        If the numbers are damaged, or the installed package lays them out in another way than the one
        that built the FMU.
    """
    scene = read_scene(folder / SCENE)
    parameters = np.load(folder / PARAMETERS, allow_pickle=False)
    parameters.setflags(write=False)
    table = variables(scene, rotor_inertia(scene), rings_at_port(scene))
    model = as_fmu_model(Model(scene, parameters, table))
    if fingerprint(model) != expected:
        raise ValueError(
            f"the model in {folder} is damaged, or was built by another version of fmu-bearing than the one "
            "installed here: install that one (see documentation/externalDependencies.txt) or rebuild the FMU"
        )
    return model
