"""Terminals: which variables of the FMU belong to one connection (``terminalsAndIcons.xml``).

FMI 2.0 takes them over from FMI 3.0 (FMI 2.0.4, section 2.3; FMI 3.0, section 2.4.9). A torque or a heat that
a connection balances is an *inflow* where the bearing takes it and an *outflow* where it gives it; all else
is a *signal*.
"""

import re
from collections.abc import Iterable, Iterator
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fmu_bearing.fmi.fmu_model import FmuModel
from fmu_bearing.interface import flat
from fmu_bearing.scene import Scene

__all__ = ["TERMINALS_FILE", "terminals_xml"]

TERMINALS_FILE = "terminalsAndIcons/terminalsAndIcons.xml"

#: Terminal, its kind and rule, what it is, what it does, and its members: name, variable, kind. A plug fits
#: where all its members do; of a bus those are connected that both sides have. What a terminal does is said
#: of the members that it has: a clause needs one of its quantities.
Member = tuple[str, str, str]
Clause = tuple[str, str]
Terminal = tuple[str, str, str, str, tuple[Clause, ...], tuple[Member, ...]]
_FLANGE, _HEAT, _SOUND, _POINT = "rotational-flange", "heat-port", "microphone", "shaft-point"
_SHAFT: Terminal = (
    "shaft",
    _FLANGE,
    "plug",
    "Shaft: the bearing",
    (("w", "is given the speed w"), ("tau", "takes the torque tau")),
    (("w", "shaft_speed", "signal"), ("tau", "friction_torque", "inflow")),
)
_NOSE: Terminal = (
    "nose",
    _POINT,
    "bus",
    "Nose of the shaft: it",
    (("f", "takes a force"), ("m", "takes a moment"), ("s phi v", "gives its place, tilt and velocity")),
    tuple(
        (f"{short}_{axis}", f"{name}.{axis}", "signal")
        for short, name, axes in (
            ("f", "nose.force", "xyz"),
            ("m", "nose.moment", "yz"),
            ("s", "shaft.nose.displacement", "xyz"),
            ("phi", "shaft.nose.tilt", "yz"),
            ("v", "shaft.nose.velocity", "xyz"),
        )
        for axis in axes
    ),
)
_RIGID: Terminal = (
    "port",
    _POINT,
    "bus",
    "Shaft of another model: it",
    (("s phi v w", "gives its motion at X = 0"), ("f m", "takes force and moment of the bearings")),
    tuple(
        (f"{short}_{axis}", f"port.{name}.{axis}", role)
        for short, name, axes, role in (
            ("s", "displacement", "xyz", "signal"),
            ("phi", "tilt", "yz", "signal"),
            ("v", "velocity", "xyz", "signal"),
            ("w", "tilt_rate", "yz", "signal"),
            ("f", "force", "xyz", "signal"),
            ("m", "moment", "yz", "signal"),
        )
        for axis in axes
    ),
)
_AXIS = re.compile("_[xyz]$")
_PORTS = (("inner_ring", "inner ring"), ("outer_ring", "outer ring"), ("oil", "oil"))
_LEVELS = ("pressure", "spl", "spl_a", "leq", "leq_a")


def terminals_xml(model: FmuModel) -> bytes:
    """Return ``terminalsAndIcons.xml`` of a model; members that are no inputs or outputs are left out.

    Terminals of flat names have flat names, too.
    """
    names = {variable.name for variable in model.variables if variable.causality in ("input", "output")}
    root = Element("fmiTerminalsAndIcons", {"fmiVersion": "3.0"})
    parent = SubElement(root, "Terminals")
    for name, kind, rule, subject, clauses, members in _terminals(model.scene):
        if model.is_flat:
            name = flat(name)
            members = tuple((member, flat(variable), role) for member, variable, role in members)
        present = [member for member in members if member[1] in names]
        if present:
            there = {_AXIS.sub("", member) for member, _, _ in present}
            words = _sentence(subject, [text for some, text in clauses if not there.isdisjoint(some.split())])
            attributes = {"name": name, "matchingRule": rule, "terminalKind": kind, "description": words}
            _members(SubElement(parent, "Terminal", attributes), present)
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True)


def _terminals(scene: Scene) -> Iterator[Terminal]:
    yield _SHAFT
    if scene.assembly.joined:
        yield _RIGID if scene.on_other_shaft else _NOSE
    for prefix in (bearing.prefix for bearing in scene.bearings()):
        for name, words in _PORTS:
            heat = (
                ("T", f"{prefix}{name}_temperature", "signal"),
                ("Q_flow", f"{prefix}heat.{name}", "outflow"),
            )
            clauses = (("Q_flow", "gives the heat Q_flow"), ("T", "is given the temperature T"))
            yield prefix + name, _HEAT, "plug", f"Heat to the {words}: the bearing", clauses, heat
    for k in range(1, len(scene.microphones) + 1):
        levels = tuple((level, f"mic[{k}].{level}", "signal") for level in _LEVELS)
        yield f"mic[{k}]", _SOUND, "bus", f"Sound at microphone {k}", (), levels


def _sentence(subject: str, clauses: list[str]) -> str:
    """Return a subject with what it does, as a list in words."""
    *first, last = clauses or [""]
    return f"{subject} {' and '.join([', '.join(first), last] if first else [last])}".rstrip()


def _members(parent: Element, members: Iterable[Member]) -> None:
    for member, variable, kind in members:
        SubElement(
            parent,
            "TerminalMemberVariable",
            {"variableName": variable, "memberName": member, "variableKind": kind},
        )
