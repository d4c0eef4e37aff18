"""FMUs of five scenes in every master: all outputs, every bit."""

import numpy as np
import pytest

from fmu_bearing import read_scene
from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene.read import with_fidelity

from . import masters
from .conftest import CSV_ERROR, ROOT, STEPS, alone, extracted, needs_linux64

pytestmark = [pytest.mark.heavy, needs_linux64]

#: What a scene has that the others lack: rings that bend, two bearings and a shaft, a defect under
#: accelerometers in a deep groove bearing, balls in equilibrium, forced lines.
SCENES = {
    "7009C-full-ceramic": "scenes/7009C-full-ceramic.toml",
    "7003C-DB": "spindle_set/7003C-DB.toml",
    "6205-outer-spall": "scenes/6205-outer-spall.toml",
    "7003C-spindle, rings": "scenes/7003C-spindle.toml",
    "7009C-spindle, response": "scenes/7009C-spindle.toml",
}


@pytest.fixture(scope="module", params=SCENES, ids=lambda name: name.replace(", ", "-"))
def built(request, tmp_path_factory):
    """FMU of a scene, names of all its real outputs, and what the library computes of them."""
    scene = read_scene(ROOT / "examples" / SCENES[request.param]).replace(
        {
            "sound.radiation_model": "compact",
            "sound.microphone": [{"name": "far", "x_mm": 0.0, "y_mm": 300.0, "z_mm": 400.0}],
        }
    )
    _, _, fidelity = request.param.partition(", ")
    model = prepare(with_fidelity(scene, model=fidelity) if fidelity else scene)
    names = [each.name for each in model.variables if each.causality == "output" and each.type == "Real"]
    assert len(names) > 40
    fmu = build(model, tmp_path_factory.mktemp("scenes") / "Bearing.fmu").path
    return fmu, names, alone(model, STEPS, names)


def test_fmpy(built):
    fmu, names, expected = built
    assert np.array_equal(masters.in_fmpy(fmu, names), expected)


def test_ecospy(built):
    fmu, names, expected = built
    assert np.array_equal(masters.in_ecospy(fmu, names), expected)


def test_libcosim(built):
    fmu, names, expected = built
    assert np.array_equal(masters.in_libcosim(fmu, names), expected[1:])


def test_c_host(built, host, clean_environment, tmp_path):
    fmu, names, expected = built
    rows, _ = masters.in_c(host, extracted(fmu, tmp_path), names, clean_environment)
    assert np.array_equal(rows, expected)


def test_ecos_simulate(built, ecos, tmp_path):
    fmu, names, expected = built
    assert masters.in_ecos(ecos, fmu, names, tmp_path) == pytest.approx(expected, abs=CSV_ERROR)
