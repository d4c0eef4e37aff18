"""Reference results inside the FMU: repeated by the FMU itself, as an importer would."""

import csv
import io

import pytest
from lxml import etree

from fmu_bearing.fmi import reference
from fmu_bearing.fmi.package import build
from fmu_bearing.instance import EngineError, Instance

from .conftest import OK

MANIFEST = "{http://fmi-standard.org/fmi-ls-manifest}"


@pytest.fixture
def folder(unpacked):
    return unpacked / reference.FOLDER


def test_fmu_reproduces_its_reference_results(master, folder):
    experiment = etree.parse(folder / "reference.exp").find("Experiment")
    times = {name: float(experiment.get(name)) for name in ("startTime", "stopTime", "stepSize")}
    table = (folder / experiment.find("References").get("source")).read_text(encoding="ascii")
    names, *rows = csv.reader(io.StringIO(table))
    assert names[0] == "time"
    assert len(names) == 10
    bearing = master().start(time=times["startTime"])
    for i, row in enumerate(rows):
        time = times["startTime"] + i * times["stepSize"]
        if i:
            assert bearing.step(time - times["stepSize"], times["stepSize"]) == OK
        # written with nine digits
        values = [f"{value:.9g}" for value in (time, *bearing.read(*names[1:])[1])]
        assert values == row, time
    assert time == pytest.approx(times["stopTime"], rel=1e-12)
    assert any(float(value) != 0.0 for value in rows[-1])


def test_manifest_names_what_is_there(folder):
    root = etree.parse(folder / "fmi-ls-manifest.xml").getroot()
    assert root.tag == "fmiReferences"
    assert root.get(f"{MANIFEST}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    assert root.get(f"{MANIFEST}fmi-ls-version") == "1.0.0-alpha.1"
    roles = {related.get("role"): folder / related.get("source") for related in root.findall("Related")}
    assert set(roles) == {"experiment/smoke-test", "result"}
    assert all(path.is_file() for path in roles.values())


def test_both_builds_have_the_same_results(unpack):
    inside = [(unpack(one) / reference.FOLDER / "reference.csv").read_bytes() for one in ("native", "python")]
    assert inside[0] == inside[1]


def test_model_that_does_not_run_is_built_without_results(model, tmp_path, monkeypatch):
    def stuck(self, h):
        raise EngineError("the equations could not be solved")

    monkeypatch.setattr(Instance, "step", stuck)
    built = build(model, tmp_path / "b.fmu", "python")
    assert built.path.is_file()
    assert built.remarks == ("reference results: the equations could not be solved",)
