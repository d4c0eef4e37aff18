"""A local defect in an FMU: its outputs, and its scale, stepped from 0 to 1 by FMPy between two steps."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi.description import FLAVOURS, description_xml
from fmu_bearing.fmi.documentation import pages
from fmu_bearing.fmi.package import build
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.deep_groove import deep_groove
from tests.engine.defects import groove
from tests.engine.test_defect_outputs import NONE
from tests.native_builds import no_native_fmu

STEP, COUNT = 1e-4, 400
SPALL = {"on": "outer", "shape": "spall", "length_mm": 0.3, "width_mm": 5.0, "depth_um": 50.0}
NAMES = ("defect[1].passages", "defect[1].load", "defect[1].entry", "outer_ring.velocity.z")


@pytest.fixture(scope="module")
def model():
    def table(shape, radius_x, radius_y, modulus):
        made = groove(shape.length, radius_x, shape.depth)
        return made._replace(touch=0.1 * made.touch, touch_x=0.1 * made.touch_x)

    # the Python build prepares its scene again, in this process
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("fmu_bearing.prepare.defect_blocks.defect_table", table)
        yield prepare(deep_groove(300.0, 1797.0, 12.0, {"imperfections": NONE | {"defect": [SPALL]}}))


def test_description_and_page_name_the_type_of_the_bearing(model):
    """A 6205 without microphones is no angular contact bearing, and has no sound."""
    root = etree.fromstring(description_xml(model, "native"))
    words = "Deep groove ball bearing 6205 on its mounting: vibration, friction torque and heat"
    assert root.get("description") == words
    page = pages(model)["index.html"].decode("utf-8")
    assert "<h1>Deep groove ball bearing 6205</h1>" in page and "angular contact" not in page
    assert "no sound is computed" in page and "the sound at the microphones" not in page


def scale_at(k):
    return 0.0 if k < COUNT // 2 else 1.0


@pytest.fixture(scope="module")
def expected(model):
    """What the library computes."""
    bearing, rows = Instance(model), []
    bearing.set("defect[1].scale", 0.0)
    bearing.initialise()
    for k in range(COUNT):
        bearing.set("defect[1].scale", scale_at(k))
        bearing.step(STEP)
        rows.append([bearing.get(name) for name in NAMES])
    return np.array(rows)


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_fmpy_steps_the_scale_and_gets_the_bits_of_the_library(model, expected, flavour, tmp_path):
    try:
        path = build(model, tmp_path / "6205.fmu", flavour).path
    except BuildError as problem:
        no_native_fmu(str(problem))
    assert validate_fmu(str(path)) == []
    description = fmpy.read_model_description(str(path))
    by_name = {variable.name: variable for variable in description.modelVariables}
    scale = by_name["defect[1].scale"]
    assert (scale.causality, scale.variability, scale.initial) == ("parameter", "tunable", "exact")
    assert (float(scale.min), float(scale.max), float(scale.start)) == (0.0, 100.0, 1.0)
    passed = by_name["defect[1].passages"]
    assert (passed.type, passed.causality, passed.variability) == ("Integer", "output", "discrete")
    folder = tmp_path / "fmu"
    fmpy.extract(str(path), str(folder))
    fmu = FMU2Slave(
        guid=description.guid, unzipDirectory=str(folder), instanceName="a",
        modelIdentifier=description.coSimulation.modelIdentifier,
    )  # fmt: skip
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.setReal([scale.valueReference], [0.0])
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    real = [by_name[name].valueReference for name in NAMES[1:]]
    rows = []
    for k in range(COUNT):
        fmu.setReal([scale.valueReference], [scale_at(k)])
        fmu.doStep(k * STEP, STEP)
        rows.append([*fmu.getInteger([passed.valueReference]), *fmu.getReal(real)])
    assert fmu.getReal([scale.valueReference]) == [1.0]
    fmu.terminate()
    fmu.freeInstance()
    found = np.array(rows, dtype=float)
    # the same kernels on the same machine; the first sums of the time differ by rounding alone
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12)
    assert found[-1, 0] >= 4
    half = COUNT // 2
    assert found[half:, 3].std() > 3.0 * found[half // 2 : half, 3].std()


def test_a_description_has_outputs_and_scale(model):
    tree = etree.fromstring(description_xml(model))
    shown = {one.get("name"): one for one in tree.find("ModelVariables")}
    assert [name for name in shown if "defect" in name] == [
        f"defect[1].{name}" for name in ("passages", "load", "time", "entry", "impact", "scale")
    ]
    assert shown["defect[1].time"][0].get("unit") == "s"
