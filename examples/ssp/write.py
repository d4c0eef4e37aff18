"""Write motor, bearing and thermal network as one system: ``python write.py out/Bearing7003C.fmu``.

The file is an SSP 1.0 archive (System Structure and Parameterization): three FMUs and a description of what
is connected with what. The bearing's FMU goes in as it is; motor and thermal network are built here, with
the starts that fit it.

Simulation tools treat the beginning in different ways. Some pass outputs on while the FMUs initialise,
FMPy does not; some apply the parameters of the description, FMPy does not. So every input's start value is
made what the connected output has at time 0, every parameter is also a start value inside its FMU, and all
tools begin at the same point.
"""

import math
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Annotated
from xml.etree import ElementTree

import typer

SPINDLE = Path(__file__).resolve().parents[1] / "spindle_cosimulation"
sys.path.insert(0, str(SPINDLE))  # that example's modules know each other by their bare names

from build import EPOCH, build  # noqa: E402
from coupling import HEATS, TEMPERATURES, Fmu, SimulationError  # noqa: E402

RPM = 30.0 / math.pi

#: Output to input, as (component, variable, component, variable).
CONNECTIONS = (
    ("motor", "shaft_speed", "bearing", "shaft_speed"),
    ("bearing", "friction_torque", "motor", "load_torque"),
    *(("thermal", name, "bearing", name) for name in TEMPERATURES),
    *(("bearing", name, "thermal", name) for name in HEATS),
)
PARAMETER_SET = "operation"  # ecos applies a set of parameters only when told its name

NAMESPACES = {
    part: f"http://ssp-standard.org/SSP1/SystemStructure{name}"
    for part, name in (("ssd", "Description"), ("ssc", "Common"), ("ssv", "ParameterValues"))
}
for prefix, address in NAMESPACES.items():
    ElementTree.register_namespace(prefix, address)

# Appended to a slave's source: pythonfmu writes start values into the description and into the instance
# from what the slave holds after its constructor.
_STARTS = """

def _with_starts(slave, construct={name}.__init__, **kwargs):
    construct(slave, **kwargs)
    for variable in slave.vars.values():
        if variable.name in STARTS:
            variable.setter(STARTS[variable.name])


STARTS = {starts!r}
{name}.__init__ = _with_starts
"""


def operating_point(bearing: Path) -> dict[str, float]:
    """Values of the bearing at its scene's operating point, initialised at its start values.

    Raises
    ------
    SimulationError
        If the temperatures differ: the thermal network has one initial temperature.
    """
    names = ("shaft_speed", "rotor.inertia", "friction_torque", *TEMPERATURES, *HEATS)
    with Fmu(bearing, "bearing") as fmu:
        fmu.enter_initialization()
        fmu.exit_initialization()
        point = dict(zip(names, fmu.get(names), strict=True))
    if len({point[name] for name in TEMPERATURES}) > 1:
        found = ", ".join(f"{name} {point[name]:g} K" for name in TEMPERATURES)
        raise SimulationError(
            f"{bearing}: starts with {found}, but the thermal network has one initial temperature: "
            "give the scene's [operation] equal temperatures"
        )
    return point


def parameters(point: dict[str, float], target_speed: float, ramp_time: float) -> dict[str, float]:
    """Parameters of the system by ``component.variable``; speeds in rad/s, time in s."""
    return {
        "motor.start_speed": point["shaft_speed"],
        "motor.target_speed": target_speed,
        "motor.ramp_time": ramp_time,
        "motor.rotor_inertia": point["rotor.inertia"],
        "thermal.initial_temperature": point[TEMPERATURES[0]],
    }


def starts(point: dict[str, float], values: dict[str, float], component: str) -> dict[str, float]:
    """Start values of motor or thermal network: its parameters, and what it is given and shows at time 0."""
    mine = {name.partition(".")[2]: value for name, value in values.items() if name.startswith(component)}
    if component == "motor":
        speed = point["shaft_speed"]
        shown = {"load_torque": point["friction_torque"], "shaft_speed": speed, "speed_setpoint": speed}
    else:
        lumps = (*TEMPERATURES, "balls_temperature", "housing_temperature")
        shown = {name: point[name] for name in HEATS} | {name: point[TEMPERATURES[0]] for name in lumps}
    return mine | shown


def build_with_starts(model: str, values: dict[str, float], folder: Path) -> Path:
    """Build the FMU of ``motor`` or ``thermal`` with other start values than its source has."""
    source = (SPINDLE / f"{model}.py").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as place:
        script = Path(place) / f"{model}.py"
        extra = _STARTS.format(name=f"Spindle{model.capitalize()}", starts=values)
        script.write_text(source + extra, encoding="utf-8")
        return build(script, folder)


def structure(sources: dict[str, str], values: dict[str, float], stop_time: float) -> bytes:
    """``SystemStructure.ssd`` of the system.

    Parameters
    ----------
    sources : dict
        Component to path inside the archive.
    values : dict
        Parameters by ``component.variable``.
    stop_time : float
        s.
    """
    root = _element(None, "ssd:SystemStructureDescription", version="1.0", name="spindle")
    system = _element(root, "ssd:System", name="spindle")
    elements = _element(system, "ssd:Elements")
    for name, source in sources.items():
        kind = "application/x-fmu-sharedlibrary"
        component = _element(elements, "ssd:Component", name=name, type=kind, source=source)
        connectors = _element(component, "ssd:Connectors")
        for one, output, other, given in CONNECTIONS:
            for owner, variable, direction in ((one, output, "output"), (other, given, "input")):
                if owner == name:
                    connector = _element(connectors, "ssd:Connector", name=variable, kind=direction)
                    _element(connector, "ssc:Real")
        _bind(component, {n.partition(".")[2]: v for n, v in values.items() if n.startswith(f"{name}.")})
    # No connectors of the system itself: FMPy cannot follow a connection to them.
    connections = _element(system, "ssd:Connections")
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    for connection in CONNECTIONS:
        _element(connections, "ssd:Connection", **dict(zip(ends, connection, strict=True)))
    _element(root, "ssd:DefaultExperiment", startTime="0", stopTime=repr(stop_time))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)


def _element(parent: ElementTree.Element | None, tag: str, **attributes: str) -> ElementTree.Element:
    prefix, _, name = tag.partition(":")
    element = ElementTree.Element(f"{{{NAMESPACES[prefix]}}}{name}", attributes)
    if parent is not None:
        parent.append(element)
    return element


def _bind(component: ElementTree.Element, values: dict[str, float]) -> None:
    """Give a component its parameters."""
    if not values:
        return
    binding = _element(_element(component, "ssd:ParameterBindings"), "ssd:ParameterBinding")
    inside = _element(binding, "ssd:ParameterValues")
    chosen = _element(inside, "ssv:ParameterSet", version="1.0", name=PARAMETER_SET)
    listed = _element(chosen, "ssv:Parameters")
    for name, value in values.items():
        _element(_element(listed, "ssv:Parameter", name=name), "ssv:Real", value=repr(value))


def write(bearing: Path, output: Path, target_speed: float, ramp_time: float, stop_time: float) -> Path:
    """Write the archive of a bearing FMU with motor and thermal network; return its path.

    Speed in rad/s, times in s. The same FMU gives the same bytes.
    """
    point = operating_point(bearing)
    values = parameters(point, target_speed, ramp_time)
    with tempfile.TemporaryDirectory() as place:
        fmus = {
            "motor": build_with_starts("motor", starts(point, values, "motor"), Path(place)),
            "bearing": bearing,
            "thermal": build_with_starts("thermal", starts(point, values, "thermal"), Path(place)),
        }
        sources = {name: f"resources/{path.name}" for name, path in fmus.items()}
        inside = {"SystemStructure.ssd": structure(sources, values, stop_time)}
        inside |= {sources[name]: path.read_bytes() for name, path in fmus.items()}
    output.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(output, "w") as archive:
        for name, data in inside.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data)
    return output


def main(
    bearing: Annotated[Path, typer.Argument(help="FMU of a scene, native or Python build.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Archive to write.")] = Path(
        "out/spindle.ssp"
    ),
    target_rpm: Annotated[float, typer.Option(min=0.0, max=40e3, help="Speed to go to, in r/min.")] = 2.2e4,
    ramp_time: Annotated[float, typer.Option(min=0.0, help="Duration of the change of speed in s.")] = 0.05,
    stop_time: Annotated[float, typer.Option(min=1e-3, help="Simulated time in s.")] = 0.1,
) -> None:
    """Write an .ssp archive of motor, bearing and thermal network."""
    try:
        typer.echo(f"wrote {write(bearing, output, target_rpm / RPM, ramp_time, stop_time)}")
    except (OSError, SimulationError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None


if __name__ == "__main__":
    typer.run(main)
