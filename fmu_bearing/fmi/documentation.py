"""Pages inside the FMU: the bearing, ranges of validity, variables, requirements."""

import sys
from collections.abc import Iterator
from html import escape
from importlib.metadata import PackageNotFoundError, distribution, version
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any

from fmu_bearing.fmi.description import FLAVOURS, interface_guid, items
from fmu_bearing.fmi.units import UNITS
from fmu_bearing.interface import Variable
from fmu_bearing.scene.words import designation_words, type_words

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model
    from fmu_bearing.scene import Scene

__all__ = ["pages", "templates"]

_BEARING = """\
The bearing sits between a shaft, which the importer turns, and a pedestal. Its inputs are speed, preload,
radial load, pedestal stiffness and temperatures. It computes the motion of its {balls} balls, rings and
cage, the friction torque on the shaft, {sound}and the heat it gives off."""
_OF_BEARING = """\
X is the bearing axis, Y horizontal, Z vertical up; gravity acts along -Z. Positive speed is right-handed
about +X; the preload pushes the inner ring towards +X."""
_SET = """\
A shaft, which the importer turns, runs on {count} bearings, {arrangement}; places of their ball planes from
the nose, and the direction of the force on the shaft that each carries: {places}. Inputs are speed, loads on
the nose and temperatures. The FMU computes the motion of the shaft and of the {balls} balls, rings and cage
of each bearing, the friction torque on the shaft, {sound}and the heat of each bearing."""
_AT_PORT = """\
{count} bearings, {arrangement}, carry a rotor that another model owns. It leads their inner rings from X = 0,
the mechanical port: set place and rate at the end of each step, and read force and moment on the rotor there
and as mean over the step. The rotor has mass, inertia and weight of the inner rings:
<code>port.mass</code>, <code>port.static_moment</code>, <code>port.inertia.transverse</code> and
<code>port.inertia.polar</code> hold them. Places of the ball planes from the port, and the direction of the
force on the rotor that each bearing carries: {places}. Inputs besides are speed and temperatures. The FMU
computes the motion of the {balls} balls, rings and cage of each bearing, the friction torque on the rotor,
and the heat of each bearing."""
_OF_SET = """\
X is the shaft's axis, from its front to its rear, Y horizontal, Z vertical up; gravity acts along -Z. Values
of a bearing have the prefix <code>bearing[1].</code>, <code>bearing[2].</code> and so on from the nose, and
are given in these axes. Positive speed is right-handed about +X. Friction torque and heats without a prefix
are sums over the bearings."""
_NEEDS = """This FMU runs its model in Python and needs on the machine that simulates it:

- Python {python} or a later 3.x, as the host process or loaded into it;
- the package fmu-bearing {package}, the version that built the FMU, with its dependencies in that Python;
  another version is refused where its equations or its variables differ;
- linux64 or win64.
"""


def templates() -> Path:
    """Return the folder of templates, licences and icon: package data, or the repository's own."""
    packaged = Path(__file__).parent / "data"
    return packaged if packaged.is_dir() else Path(__file__).parents[2] / "modelDescription"


def pages(model: "Model", flavour: str = FLAVOURS[0]) -> dict[str, bytes]:
    """Return the files of the ``documentation`` folder of an FMU of a flavour, by path below it."""
    folder = templates() / "documentation"
    files: dict[str, bytes] = {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and not path.name.startswith(".")
    }
    page = Template(files["index.html"].decode("utf-8")).substitute(_fields(model, flavour))
    files["index.html"] = page.encode("utf-8")
    if flavour == "python":
        needs = _NEEDS.format(python="3.11", package=_package_version())
        files["externalDependencies.txt"] = needs.encode("utf-8")
        files["licenses/pythonfmu.txt"] = _pythonfmu_licence()
    return files


def _fields(model: "Model", flavour: str) -> dict[str, str]:
    scene = model.scene
    ranges = (
        f"<tr><td>{escape(v.name)}: {escape(v.description)}</td><td>{range_of(v)}</td></tr>"
        for v in model.variables
        if v.causality in ("input", "parameter") and v.type == "Real"
    )
    if scene.sound is None:
        sound = "This scene has no microphones, so no sound is computed."
    else:
        sound = (
            f"The sound of the radiator &quot;{escape(scene.sound.radiator)}&quot; is computed with "
            f"radiation model &quot;{escape(scene.sound.radiation_model)}&quot; in a free field: no room, "
            "no floor, no other machine. Levels are re 20 &micro;Pa."
        )
    return {
        "model_name": escape(scene.name),
        **_subject(scene),
        "guid": escape(interface_guid(model, flavour)),
        "behaviour": (templates() / "behaviour" / f"{flavour}.html").read_text("utf-8"),
        "ranges": "\n".join(ranges),
        "sound": sound,
        "note": f"<p>{escape(model.note)}.</p>\n" if model.note else "",
        "variables": "\n".join(_rows(model)),
        "scene": escape(scene.to_toml()),
    }


def _subject(scene: "Scene") -> dict[str, str]:
    """Return what is modelled: heading, a paragraph about it, and its axes."""
    designation, balls = escape(designation_words(scene)), str(scene.bearing.ball_count)
    sound = "" if scene.sound is None else "the sound at the microphones "
    assembly = scene.assembly
    if not assembly.joined:
        about = _BEARING.format(balls=balls, sound=sound)
        heading = f"{type_words(scene).capitalize()} {designation}"
        return {"heading": heading, "about": about, "axes": _OF_BEARING}
    count = len(assembly.members)
    places = ", ".join(f"{member.position_mm:g} mm ({member.carries})" for member in assembly.members)
    arrangement = escape(assembly.arrangement)
    if scene.differing:
        balls = ", ".join(str(one.ball_count) for one in scene.geometries)
    words = {"count": str(count), "balls": balls, "arrangement": arrangement, "places": places}
    if scene.on_other_shaft:
        heading = f"{count} x {designation} at a mechanical port"
        return {"heading": heading, "about": _AT_PORT.format(**words), "axes": _OF_SET}
    about = _SET.format(**words, sound=sound)
    return {"heading": f"Shaft on {count} x {designation}", "about": about, "axes": _OF_SET}


def _rows(model: "Model") -> Iterator[str]:
    for variable in model.variables:
        value = variable.start if variable.value is None else variable.value
        settable = variable.causality in ("input", "parameter") or variable.variability == "constant"
        cells = (
            f"<code>{escape(variable.name)}</code>",
            _role(variable),
            escape(variable.unit or ""),
            range_of(variable),
            _shown(variable, value) if settable and value is not None else "",
            escape(variable.description),
        )
        yield "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _role(variable: Variable) -> str:
    if variable.variability == "constant":
        return "constant" if variable.causality == "local" else "output, constant"
    return "parameter, tunable" if variable.variability == "tunable" else variable.causality


def range_of(variable: Variable) -> str:
    """Return the range of a variable in words (HTML), in its unit and its display unit."""
    if items(variable):
        return ", ".join(f"{value} = {name}" for name, value, _ in items(variable))
    low, high = variable.min, variable.max
    if low is None and high is None:
        return ""
    if low is None:
        return f"at most {_shown(variable, high)}"
    if high is None:
        return f"at least {_shown(variable, low)}"
    return f"{_shown(variable, low)} to {_shown(variable, high)}"


def _shown(variable: Variable, value: Any) -> str:
    """Return a value in its unit, and in the display unit where there is one."""
    if variable.type != "Real":
        return escape(str(value))
    text = f"{value:.6g}" + (f" {variable.unit}" if variable.unit else "")
    if variable.display_unit:
        display = UNITS[variable.unit].display(variable.display_unit)
        text += f" ({display.shown(value):.6g} {display.name})"
    return escape(text)


def _package_version() -> str:
    try:
        return version("fmu-bearing")
    except PackageNotFoundError:
        return "(the source tree this FMU was built from)"


def _pythonfmu_licence() -> bytes:
    """Return the licence of the binaries, which come from pythonfmu."""
    for file in distribution("pythonfmu").files or ():
        if file.name == "LICENSE":
            return Path(str(file.locate())).read_bytes()
    raise FileNotFoundError(f"pythonfmu's licence is not installed in {sys.prefix}")
