"""modelDescription.xml: no findings of checkers, and what importers rely on."""

import dataclasses
import importlib.util
import logging
import math
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_bearing import __version__
from fmu_bearing.fmi import description
from fmu_bearing.fmi.description import ENUMERATIONS, LOG_CATEGORIES, description_xml, interface_guid
from fmu_bearing.fmi.units import UNITS
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

from .conftest import OK, ROOT

DEFAULT_SCENE = ROOT / "examples" / "scenes" / "7003C-spindle.toml"

# What a display unit shows for 1 and for 0 of the unit, written down apart from the package's table.
SHOWN = {
    "mm": (1e3, 0.0),
    "um": (1e6, 0.0),
    "nm": (1e9, 0.0),
    "ms": (1e3, 0.0),
    "us": (1e6, 0.0),
    "mm/s": (1e3, 0.0),
    "deg": (360.0 / (2.0 * math.pi), 0.0),
    "r/min": (60.0 / (2.0 * math.pi), 0.0),
    "degC": (-272.15, -273.15),
    "kg.mm2": (1e6, 0.0),
    "g.mm2": (1e9, 0.0),
    "N/um": (1e-6, 0.0),
    "N.mm": (1e3, 0.0),
    "MPa": (1e-6, 0.0),
    "GPa": (1e-9, 0.0),
    "mPa.s": (1e3, 0.0),
}

# Exponents of the SI base units, written down apart from the package's table: 1 N = 1 kg m/s2.
EXPONENTS = {
    "1": {},
    "dB": {},
    "m": {"m": 1},
    "s": {"s": 1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "1/s": {"s": -1},
    "K": {"K": 1},
    "kg": {"kg": 1},
    "kg.m": {"kg": 1, "m": 1},
    "kg.m2": {"kg": 1, "m": 2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N/m": {"kg": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N.m/rad": {"kg": 1, "m": 2, "s": -2, "rad": -1},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Pa.s": {"kg": 1, "m": -1, "s": -1},
    "W": {"kg": 1, "m": 2, "s": -3},
}


@pytest.fixture(scope="module")
def tree(model, flavour):
    return etree.fromstring(description_xml(model, flavour))


def schemas():
    for package in ("fmpy", "fmu_manipulation_toolbox"):
        folder = Path(importlib.util.find_spec(package).origin).parent
        yield from folder.rglob("fmi2ModelDescription.xsd")


def test_schema(tree):
    found = list(schemas())
    assert found
    for path in found:
        schema = etree.XMLSchema(etree.parse(path))
        assert schema.validate(tree), schema.error_log


def test_fmpy_finds_nothing(fmu):
    assert validate_fmu(str(fmu)) == []


@pytest.mark.heavy
def test_fmutool_finds_nothing(fmu, caplog):
    checker = pytest.importorskip("fmu_manipulation_toolbox.checker")
    operations = pytest.importorskip("fmu_manipulation_toolbox.operations")
    with caplog.at_level(logging.WARNING), operations.FMU(str(fmu)) as opened:
        for check in checker.get_checkers():
            opened.apply_operation(check())
    assert [record.getMessage() for record in caplog.records] == []


def test_value_reference_is_the_place_in_the_table(model, tree):
    found = [(v.get("name"), v.get("valueReference")) for v in tree.find("ModelVariables")]
    assert found == [(variable.name, str(i)) for i, variable in enumerate(model.variables)]


def test_outputs_are_declared_free_of_direct_feedthrough(tree):
    variables = tree.find("ModelVariables")
    outputs = [i + 1 for i, v in enumerate(variables) if v.get("causality") == "output"]
    listed = tree.findall("ModelStructure/Outputs/Unknown")
    assert [int(unknown.get("index")) for unknown in listed] == outputs
    assert {unknown.get("dependencies") for unknown in listed} == {""}
    initial = tree.findall("ModelStructure/InitialUnknowns/Unknown")
    assert [int(unknown.get("index")) for unknown in initial] == outputs
    settable = [i + 1 for i, v in enumerate(variables) if v.get("causality") in ("input", "parameter")]
    assert {unknown.get("dependencies") for unknown in initial} == {" ".join(map(str, settable))}


def test_head(tree, expected):
    assert "generationDateAndTime" not in tree.attrib
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert tree.get("generationTool") == f"fmu-bearing {__version__}"
    assert (tree.get("version"), tree.get("license")) == (__version__, project["license"])
    assert tree.get("author") == project["authors"][0]["name"]
    assert tree.get("copyright") in (ROOT / "LICENSE").read_text("utf-8")
    assert tree.get("variableNamingConvention") == "structured"
    assert "time" not in [v.get("name") for v in tree.find("ModelVariables")]
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", tree.get("guid"))
    assert {c.get("name") for c in tree.find("LogCategories")} == set(LOG_CATEGORIES)
    experiment = tree.find("DefaultExperiment").attrib
    assert (experiment["stepSize"], experiment["stopTime"]) == ("0.0001", "1.0")
    can = dict(tree.find("CoSimulation").attrib)
    needs_python = expected["needs Python"]
    assert can.pop("modelIdentifier") == "Bearing7003C"
    assert can == {
        "needsExecutionTool": str(needs_python).lower(),
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": str(expected["input derivative"] == OK).lower(),
        "maxOutputDerivativeOrder": "1" if expected["output derivative"] == OK else "0",
        "canRunAsynchronuously": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "false",
    }


def test_every_variable_says_what_it_is(tree):
    for variable in tree.find("ModelVariables"):
        name, kind = variable.get("name"), variable[0]
        assert len(variable.get("description")) > 10, name
        if kind.tag == "Real":
            assert kind.get("unit"), name
            if variable.get("causality") in ("input", "parameter"):
                assert float(kind.get("min")) <= float(kind.get("start")) <= float(kind.get("max")), name
            if variable.get("causality") in ("input", "output"):
                assert float(kind.get("nominal")) > 0.0, name


def test_start_values_keep_every_bit(model, tree):
    for variable, element in zip(model.variables, tree.find("ModelVariables"), strict=True):
        if element[0].get("start") is not None and variable.type == "Real":
            value = variable.start if variable.value is None else variable.value
            assert float(element[0].get("start")) == value


def test_names_of_the_contract(tree):
    names = {v.get("name"): v.get("causality") for v in tree.find("ModelVariables")}
    inputs = "shaft_speed preload pedestal_stiffness radial_load.y radial_load.z oil_temperature"
    for name in (*inputs.split(), "inner_ring_temperature", "outer_ring_temperature"):
        assert names[name] == "input"
    outputs = "inner_ring.velocity.x ball[1].velocity.z friction_torque heat.oil cage.speed_ratio"
    for name in outputs.split():
        assert names[name] == "output"
    for name in "tolerance max_internal_step imperfection.scale lubricant.viscosity_ref".split():
        assert names[name] == "parameter"


def test_display_units_go_there_and_back(tree):
    displays = tree.findall("UnitDefinitions/Unit/DisplayUnit")
    assert {"r/min", "degC", "deg"} <= {display.get("name") for display in displays}
    for display in displays:
        factor, offset = float(display.get("factor")), float(display.get("offset", 0.0))
        one, zero = SHOWN[display.get("name")]
        assert factor + offset == pytest.approx(one, rel=1e-15)
        assert offset == zero
        for value in (-273.15, 0.0, 1e-9, 2094.3951):
            # one rounding each way, at the size of the larger of value and offset
            shown = factor * value + offset
            assert (shown - offset) / factor == pytest.approx(value, rel=4e-16, abs=1.2e-13)


def test_units_have_the_exponents_of_the_si():
    """All units, also those that the description of this scene does without."""
    assert {name: unit.base for name, unit in UNITS.items()} == EXPONENTS


def test_units_in_the_description_have_their_exponents(tree):
    described = {element.get("name") for element in tree.find("UnitDefinitions")}
    assert {"N", "N.m", "Pa.s", "rad/s", "K", "dB"} <= described
    for element in tree.find("UnitDefinitions"):
        base = element.find("BaseUnit")
        if element.get("name") == "dB":  # a tool that finds a base unit converts 60 dB to the number 60
            assert base is None
            continue
        assert {key: int(value) for key, value in base.attrib.items()} == EXPONENTS[element.get("name")]


def test_unknown_unit_is_named(model):
    odd = dataclasses.replace(model.variables[0], unit="furlong")
    with pytest.raises(KeyError, match="furlong"):
        description_xml(dataclasses.replace(model, variables=(odd,)))


def test_coded_numbers_have_names(model, tree):
    declared = {v.get("name"): v[0].get("declaredType") for v in tree.iter("ScalarVariable")}
    assert declared["fidelity"] == ENUMERATIONS["fidelity"][0]
    types = {found.get("name"): found.findall("Enumeration/Item") for found in tree.iter("SimpleType")}
    for variable in model.variables:
        if variable.type == "Integer" and re.search(r"\d [a-z]", variable.description):
            names = {item.get("name"): int(item.get("value")) for item in types[declared[variable.name]]}
            assert names and variable.value in names.values(), variable.name
            assert all(f"{number} " in variable.description for number in names.values()), variable.name
    assert {"Fidelity", "Method", "Radiator"} <= set(types)


def test_guid_names_the_model(model, flavour, scene_file, tmp_path, monkeypatch):
    def guid(one):
        return interface_guid(one, flavour)

    assert guid(prepare(read_scene(scene_file))) == guid(model)
    text = scene_file.read_text(encoding="utf-8")
    changed = re.sub(r"(?m)^preload_N *=.*$", "preload_N = 123.0", text)
    assert changed != text
    other = tmp_path / "other.toml"
    other.write_text(changed, encoding="utf-8")
    assert guid(prepare(read_scene(other))) != guid(model)
    own = guid(model)
    monkeypatch.setattr(description, "engine_digest", lambda: bytes(32))  # other equations
    assert guid(model) != own


def test_guid_is_equal_on_all_machines(model, flavour):
    """Filters and modes come out with other last bits on another processor: they are not in it."""
    other = np.nextafter(model.parameters, np.inf)
    assert (other != model.parameters).all()
    there = dataclasses.replace(model, parameters=other)
    assert interface_guid(there, flavour) == interface_guid(model, flavour)


def test_builds_of_one_model_have_guids_of_their_own(model):
    # they answer differently: a master must not take one for the other
    assert interface_guid(model, "native") != interface_guid(model, "python")


def test_builds_describe_the_same_variables(model):
    native, python = (etree.fromstring(description_xml(model, one)) for one in ("native", "python"))
    for part in ("UnitDefinitions", "TypeDefinitions", "LogCategories", "ModelVariables", "ModelStructure"):
        assert etree.tostring(native.find(part)) == etree.tostring(python.find(part))


def test_committed_description_is_that_of_the_default_scene(example_file):
    # Native, the default. The model of compact sound is quicker to make; of it the description shows nothing.
    model = dataclasses.replace(prepare(read_scene(example_file)), scene=read_scene(DEFAULT_SCENE))
    committed = (ROOT / "modelDescription" / "modelDescription.xml").read_text(encoding="utf-8")
    renew = "renew it with: python build_fmu.py --write-description"
    assert committed == description_xml(model, "native").decode("utf-8"), renew
