"""The table of variables as ``modelDescription.xml`` (FMI 2.0, co-simulation).

The value reference of a variable is its place in the table, its index in ``ModelStructure`` one more.
Everything written follows from the model; nothing from the clock or the machine, so the same scene gives
the same bytes.
"""

import hashlib
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any
from uuid import UUID
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fmu_bearing import __version__
from fmu_bearing.engine.choices import FIDELITIES, METHODS
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.fmi.fmu_model import as_fmu_model
from fmu_bearing.fmi.units import NO_UNIT, UNITS
from fmu_bearing.interface import Variable
from fmu_bearing.interface.inputs import led_inputs
from fmu_bearing.interface.parameters import RADIATORS
from fmu_bearing.scene.designation import ascii_word
from fmu_bearing.scene.words import designation_words, type_words

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model
    from fmu_bearing.scene import Scene

__all__ = [
    "CAPABILITIES",
    "ENUMERATIONS",
    "FLAVOURS",
    "LOG_CATEGORIES",
    "description_element",
    "description_xml",
    "fmi_type",
    "identifier",
    "interface_guid",
    "items",
]

GENERATION_TOOL = "fmu-bearing"
AUTHOR = "fmu-bearing authors"
COPYRIGHT = "Copyright (c) 2026, fmu-bearing authors"
LICENSE = "BSD-3-Clause"

#: The two builds: compiled ahead of time, and run by Python.
FLAVOURS = ("native", "python")

#: What a build can do; pythonfmu 0.7.0 answers fmi2Error to derivatives, directional or in time.
CAPABILITIES = {
    "native": {
        "needsExecutionTool": "false",
        "canInterpolateInputs": "true",
        "maxOutputDerivativeOrder": "1",
    },
    "python": {
        "needsExecutionTool": "true",
        "canInterpolateInputs": "false",
        "maxOutputDerivativeOrder": "0",
    },
}
_BOTH_CAN = {
    "canHandleVariableCommunicationStepSize": "true",
    "canRunAsynchronuously": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}

LOG_CATEGORIES = {
    "logStatusWarning": "Accepted, but outside the range the model was validated for.",
    "logStatusDiscard": "A value or a step that was not taken, and why.",
    "logStatusError": "A call out of order, or a failure inside the model.",
    "logAll": "All messages.",
}

_FIDELITIES = {
    "full": "Six degrees of freedom for every ball, the rings and the cage.",
    "rings": "Rings are dynamic; balls and cage move kinematically.",
    "response": "Linear response around the steady state.",
}
_METHODS = {
    "esdirk4": "ESDIRK4(3), implicit, with error control.",
    "trbdf2": "TR-BDF2, implicit, with error control.",
    "rk4": "Classical Runge-Kutta, explicit.",
}
_RADIATORS = {
    "none": "Nothing: the scene has no sound.",
    "bare": "The bare bearing.",
    "housing": "The housing.",
    "baffle": "The bearing's face flush in a rigid plane.",
}
#: Integers of the table that read better by name: type name, then (item, value, what it means).
ENUMERATIONS: dict[str, tuple[str, tuple[tuple[str, int, str], ...]]] = {
    "fidelity": ("Fidelity", tuple((name, k, _FIDELITIES[name]) for k, name in enumerate(FIDELITIES))),
    # an integrator that a user adds (docs/architecture.md) needs no sentence here
    "method": ("Method", tuple((name, k, _METHODS.get(name, "Added.")) for name, k in METHODS.items())),
    "radiator": ("Radiator", tuple((name, k, _RADIATORS[name]) for name, k in RADIATORS.items())),
}

# Default experiment, assumed: long enough for Slow levels, at a communication step that resolves the shaft
# order.
STOP_TIME = 1.0  # s
STEP_SIZE = 1e-4  # s


def identifier(scene: "Scene") -> str:
    """Return the name of the FMU's shared library: ``Bearing`` and the designation as a C identifier.

    That of a set begins with ``Spindle``.
    """
    what = "Spindle" if scene.assembly.joined else "Bearing"
    return what + ascii_word(designation_words(scene))


def fmi_type(variable: Variable) -> str:
    """Return the FMI type of a variable: its own, or ``Enumeration`` where the values have names."""
    return "Enumeration" if variable.name in ENUMERATIONS else variable.type


def interface_guid(model: "Model", flavour: str = FLAVOURS[0]) -> str:
    """Return the GUID: a hash of the description with its version, of the scene and of the equations.

    Two FMUs of one version with the same GUID have the same variables, the same model and the same abilities.
    It is equal on all machines: numbers computed from the scene, whose last bits differ between processors,
    are left out.
    """
    digest = hashlib.sha256(_serialise(_root(model, flavour, guid="")))
    digest.update(model.scene.to_toml().encode("utf-8"))
    digest.update(engine_digest())
    return f"{{{UUID(bytes=digest.digest()[:16])}}}"


def description_xml(model: "Model", flavour: str = FLAVOURS[0]) -> bytes:
    """Return ``modelDescription.xml`` of a model in one of :data:`FLAVOURS`, UTF-8, with its GUID.

    Raises
    ------
    KeyError
        If a variable has a unit or a display unit that :data:`fmu_bearing.fmi.units.UNITS` does not know.
    """
    return _serialise(description_element(model, flavour))


def description_element(model: "Model", flavour: str = FLAVOURS[0]) -> Element:
    """Return the same as :func:`description_xml`, as a tree."""
    return _root(model, flavour, interface_guid(model, flavour))


def _serialise(root: Element) -> bytes:
    indent(root, "  ")
    text = tostring(root, encoding="unicode", short_empty_elements=True)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'.encode()


def _root(model: "Model", flavour: str, guid: str) -> Element:
    shown = as_fmu_model(model)
    scene = shown.scene
    root = Element(
        "fmiModelDescription",
        {
            "fmiVersion": "2.0",
            "modelName": scene.name,
            "guid": guid,
            "description": _about(scene),
            "author": AUTHOR,
            "version": __version__,
            "copyright": COPYRIGHT,
            "license": LICENSE,
            "generationTool": f"{GENERATION_TOOL} {__version__}",
            "variableNamingConvention": "flat" if shown.is_flat else "structured",
        },
    )
    derivatives = flavour == "native" and len(led_inputs(scene)) > 0
    can = {
        "modelIdentifier": identifier(shown.scene),
        **CAPABILITIES[flavour],
        **_BOTH_CAN,
        "providesDirectionalDerivative": str(derivatives).lower(),
    }
    SubElement(root, "CoSimulation", can)
    _units(SubElement(root, "UnitDefinitions"), shown.variables)
    named = [variable for variable in shown.variables if variable.name in ENUMERATIONS]
    if named:
        _types(SubElement(root, "TypeDefinitions"), named)
    categories = SubElement(root, "LogCategories")
    for name, sentence in LOG_CATEGORIES.items():
        SubElement(categories, "Category", {"name": name, "description": sentence})
    SubElement(
        root,
        "DefaultExperiment",
        {
            "startTime": "0.0",
            "stopTime": repr(STOP_TIME),
            "tolerance": _number(scene.fidelity.tolerance),
            "stepSize": repr(STEP_SIZE),
        },
    )
    variables = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(shown.variables):
        _variable(variables, reference, variable)
    _structure(SubElement(root, "ModelStructure"), shown.variables)
    return root


def _about(scene: "Scene") -> str:
    designation, assembly = designation_words(scene), scene.assembly
    kind = type_words(scene)
    more = "friction torque, heat and sound" if scene.sound is not None else "friction torque and heat"
    if not assembly.joined:
        return f"{kind.capitalize()} {designation} on its mounting: vibration, {more}"
    count = len(assembly.members)
    bearings = f"{count} {kind}{'s' * (count > 1)} {designation}, {assembly.arrangement}"
    if scene.on_other_shaft:
        return f"{bearings}, for a shaft of another model: vibration, {more}"
    return f"Shaft on {bearings}: vibration, {more}"


def _units(parent: Element, variables: Iterable[Variable]) -> None:
    used: dict[str, set[str]] = {}
    for variable in variables:
        if variable.type == "Real":
            name = variable.unit or NO_UNIT
            if name not in UNITS:
                raise KeyError(f"{variable.name}: unknown unit {name!r}")
            shown = used.setdefault(name, set())
            if variable.display_unit:
                shown.add(variable.display_unit)
    for name in sorted(used):
        element = SubElement(parent, "Unit", {"name": name})
        if UNITS[name].converts:
            SubElement(element, "BaseUnit", {base: str(power) for base, power in UNITS[name].base.items()})
        for display in map(UNITS[name].display, sorted(used[name])):
            attributes = {"name": display.name, "factor": repr(display.factor)}
            if display.offset:
                attributes["offset"] = repr(display.offset)
            SubElement(element, "DisplayUnit", attributes)


def _types(parent: Element, named: Iterable[Variable]) -> None:
    for variable in named:
        type_name, _ = ENUMERATIONS[variable.name]
        simple = SubElement(parent, "SimpleType", {"name": type_name})
        enumeration = SubElement(simple, "Enumeration")
        for item, value, sentence in items(variable):
            attributes = {"name": item, "value": str(value), "description": sentence}
            SubElement(enumeration, "Item", attributes)


def items(variable: Variable) -> list[tuple[str, int, str]]:
    """Return name, value and meaning of what an enumeration may be set to, empty for other variables."""
    low = -math.inf if variable.min is None else variable.min
    high = math.inf if variable.max is None else variable.max
    return [item for item in ENUMERATIONS.get(variable.name, ("", ()))[1] if low <= item[1] <= high]


def _variable(parent: Element, reference: int, variable: Variable) -> None:
    causality, initial, start = _initial(variable)
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": causality,
        "variability": variable.variability,
    }
    if initial:
        attributes["initial"] = initial
    element = SubElement(parent, "ScalarVariable", attributes)
    kind = fmi_type(variable)
    details: dict[str, Any] = {}
    if kind == "Enumeration":
        details["declaredType"] = ENUMERATIONS[variable.name][0]
    if kind == "Real":
        details["quantity"] = variable.quantity or None
        details["unit"] = variable.unit or NO_UNIT
        details["displayUnit"] = variable.display_unit or None
    if kind != "String":
        details["min"] = variable.min
        details["max"] = variable.max
    if kind == "Real":
        details["nominal"] = variable.nominal
    details["start"] = start
    given = {key: _text(value, kind) for key, value in details.items() if value is not None}
    SubElement(element, kind, given)


def _initial(variable: Variable) -> tuple[str, str, Any]:
    """Return causality, ``initial`` and start value as FMI has them; a constant is a local with a value."""
    if variable.variability == "constant" or variable.causality == "constant":
        value = variable.value if variable.value is not None else variable.start
        causality = "local" if variable.causality == "constant" else variable.causality
        return causality, "exact", value
    if variable.causality == "input":
        return "input", "", variable.start
    if variable.causality == "parameter":
        return "parameter", "exact", variable.start
    return variable.causality, "calculated", None


def _text(value: Any, kind: str) -> str:
    if isinstance(value, str):
        return value
    return _number(value) if kind == "Real" else str(int(value))


def _number(value: float) -> str:
    """Return the shortest text that reads back as the same double."""
    return repr(float(value))


def _structure(parent: Element, variables: Iterable[Variable]) -> None:
    variables = tuple(variables)
    shown = {i + 1: variable for i, variable in enumerate(variables) if variable.causality == "output"}
    # dependencies="": between two steps a set input changes no output, so importers must see no
    # algebraic loop. While initialising, every output follows from all that can be set.
    settable = ("input", "parameter")
    known = " ".join(str(i + 1) for i, variable in enumerate(variables) if variable.causality in settable)
    outputs = SubElement(parent, "Outputs")
    unknowns = SubElement(parent, "InitialUnknowns")
    for place, variable in shown.items():
        SubElement(outputs, "Unknown", {"index": str(place), "dependencies": ""})
        if variable.variability == "constant":
            continue  # its value is exact from the start
        SubElement(unknowns, "Unknown", {"index": str(place), "dependencies": known})
