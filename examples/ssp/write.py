"""Write motor, bearing and thermal network as one system: ``python write.py out/Bearing7003C.fmu``.

The file is an SSP 1.0 archive (System Structure and Parameterization): three FMUs, their parameters
(``.ssv``) and a description of what is connected with what (``.ssd``). The bearing's FMU goes in as it is.
Motor and thermal network are built here, with the starts that fit it: in C where there is a compiler, so that
with a native bearing nothing in the archive needs Python.

Simulation tools treat the beginning in different ways. Some pass outputs on while the FMUs initialise,
FMPy does not; some apply the parameters of the archive, FMPy does not. So every input's start value is
made what the connected output has at time 0, every parameter is also a start value inside its FMU, and all
tools begin at the same point.

For OMSimulator, which could not be run here, the description follows what its source reads: the README says
which rules these are.
"""

import math
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated
from xml.etree import ElementTree

import typer
from fmpy import read_model_description
from run import EXACT_STEP

from fmu_bearing.cli.build import Platforms, named
from fmu_bearing.compiled import BuildError
from fmu_bearing.fmi.package import ChoiceError, check_choice

SPINDLE = Path(__file__).resolve().parents[1] / "spindle_cosimulation"
sys.path.insert(0, str(SPINDLE))  # that example's modules know each other by their bare names

from build import UNITS, best_flavour, build, pack  # noqa: E402
from coupling import HEATS, TEMPERATURES, Fmu, SimulationError  # noqa: E402

RPM = 30.0 / math.pi

#: Output to input, as (component, variable, component, variable).
CONNECTIONS = (
    ("motor", "shaft_speed", "bearing", "shaft_speed"),
    ("bearing", "friction_torque", "motor", "load_torque"),
    *(("thermal", name, "bearing", name) for name in TEMPERATURES),
    *(("bearing", name, "thermal", name) for name in HEATS),
)
#: Unit of each variable by (component, variable).
Units = dict[tuple[str, str], str]
PARAMETER_SET = "operation"  # ecos applies a set of parameters only by its name

NAMESPACES = {
    part: f"http://ssp-standard.org/SSP1/SystemStructure{name}"
    for part, name in (("ssd", "Description"), ("ssc", "Common"), ("ssv", "ParameterValues"))
}
NAMESPACES["oms"] = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"
for prefix, address in NAMESPACES.items():  # OMSimulator and ecos look for these very prefixes
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


def build_with_starts(
    model: str, values: dict[str, float], folder: Path, flavour: str, platforms: Sequence[str] = ()
) -> Path:
    """Build the FMU of ``motor`` or ``thermal`` with other start values than its source has."""
    source = (SPINDLE / f"{model}.py").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as place:
        script = Path(place) / f"{model}.py"
        extra = _STARTS.format(name=f"Spindle{model.capitalize()}", starts=values)
        script.write_text(source + extra, encoding="utf-8")
        return build(script, folder, flavour, platforms)


def structure(sources: dict[str, str], sets: dict[str, str], units: Units, stop_time: float) -> bytes:
    """``SystemStructure.ssd`` of the system.

    Parameters
    ----------
    sources : dict
        Component to the path of its FMU inside the archive.
    sets : dict
        Component to the path of its parameters (``.ssv``) inside the archive, where it has some.
    units : dict
        Unit of each variable by (component, variable).
    stop_time : float
        s.
    """
    root = _element(None, "ssd:SystemStructureDescription", version="1.0", name="spindle")
    system = _element(root, "ssd:System", name="spindle")
    elements = _element(system, "ssd:Elements")
    for name, source in sources.items():
        kind = {"type": "application/x-fmu-sharedlibrary", "implementation": "CoSimulation"}
        component = _element(elements, "ssd:Component", name=name, source=source, **kind)
        connectors = _element(component, "ssd:Connectors")
        for one, output, other, given in CONNECTIONS:
            for owner, variable, direction in ((one, output, "output"), (other, given, "input")):
                if owner == name:
                    connector = _element(connectors, "ssd:Connector", name=variable, kind=direction)
                    _element(connector, "ssc:Real", unit=units[owner, variable])
        if name in sets:
            bind(component, sets[name])
    # No connectors of the system itself: FMPy cannot follow a connection to them.
    connections = _element(system, "ssd:Connections")
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    for connection in CONNECTIONS:
        _element(connections, "ssd:Connection", **dict(zip(ends, connection, strict=True)))
    master = _element(_annotate(system), "oms:FixedStepMaster", description="oms-ma")
    master.attrib |= {
        "stepSize": repr(EXACT_STEP),
        "absoluteTolerance": "0.0001",
        "relativeTolerance": "0.0001",
    }
    _define(root, "ssd:Units", {units[c, v] for one in CONNECTIONS for c, v in (one[:2], one[2:])})
    experiment = _element(root, "ssd:DefaultExperiment", startTime="0.0", stopTime=repr(stop_time))
    results = {
        "resultFile": "spindle_res.csv",
        "loggingInterval": "0.0",
        "bufferSize": "1",
        "signalFilter": ".*",
    }
    _annotate(experiment).attrib |= results
    return _text(root)


def parameter_set(values: dict[str, float], units: dict[str, str]) -> bytes:
    """Return an ``.ssv``: values of the parameters of one component, and units where they have some."""
    root = _element(None, "ssv:ParameterSet", version="1.0", name=PARAMETER_SET)
    listed = _element(root, "ssv:Parameters")
    for name, value in values.items():
        parameter = _element(listed, "ssv:Parameter", name=name)
        unit = {"unit": units[name]} if name in units else {}
        _element(parameter, "ssv:Real", value=repr(value), **unit)
    if units:
        _define(root, "ssv:Units", set(units.values()))
    return _text(root)


def bind(component: ElementTree.Element, source: str) -> None:
    """Give a component the parameters of an ``.ssv``; ecos and libcosim read none bound to the system."""
    _element(_element(component, "ssd:ParameterBindings"), "ssd:ParameterBinding", source=source)


def _annotate(parent: ElementTree.Element) -> ElementTree.Element:
    """Return a new place for what OMSimulator is to know."""
    annotation = _element(_element(parent, "ssd:Annotations"), "ssc:Annotation", type="org.openmodelica")
    return _element(_element(annotation, "oms:Annotations"), "oms:SimulationInformation")


def _define(parent: ElementTree.Element, tag: str, names: set[str]) -> None:
    """Add the definitions of units."""
    definitions = _element(parent, tag)
    for name in sorted(names):
        base, _ = UNITS[name]
        powers = {unit: str(power) for unit, power in base.items()}
        _element(_element(definitions, "ssc:Unit", name=name), "ssc:BaseUnit", **powers)


def _element(parent: ElementTree.Element | None, tag: str, **attributes: str) -> ElementTree.Element:
    prefix, _, name = tag.partition(":")
    element = ElementTree.Element(f"{{{NAMESPACES[prefix]}}}{name}", attributes)
    if parent is not None:
        parent.append(element)
    return element


def _text(root: ElementTree.Element) -> bytes:
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)


def write(
    bearing: Path,
    output: Path,
    target_speed: float,
    ramp_time: float,
    stop_time: float,
    partners: str | None = None,
    platforms: Sequence[str] = (),
) -> Path:
    """Write the archive of a bearing FMU with motor and thermal network; return its path.

    Speed in rad/s, times in s. The same FMU gives the same bytes.

    Parameters
    ----------
    partners : str, optional
        Build of motor and thermal network, ``native`` or ``python``; default: native if it can be made.
    platforms : sequence of str
        Platforms of native partners; default: this machine's.
    """
    flavour = partners or ("native" if platforms else best_flavour())
    point = operating_point(bearing)
    values = parameters(point, target_speed, ramp_time)
    with tempfile.TemporaryDirectory() as place:
        fmus = {
            model: build_with_starts(model, starts(point, values, model), Path(place), flavour, platforms)
            for model in ("motor", "thermal")
        }
        fmus = {"motor": fmus["motor"], "bearing": bearing, "thermal": fmus["thermal"]}
        units = {
            (name, variable.name): variable.unit
            for name, path in fmus.items()
            for variable in read_model_description(str(path)).modelVariables
        }
        inside = {f"resources/{path.name}": path.read_bytes() for path in fmus.values()}
    sets = {}
    for name in fmus:
        own = {key.removeprefix(f"{name}."): v for key, v in values.items() if key.startswith(f"{name}.")}
        if own:
            sets[name] = f"resources/{name}.ssv"
            inside[sets[name]] = parameter_set(own, {key: units[name, key] for key in own})
    sources = {name: f"resources/{path.name}" for name, path in fmus.items()}
    files = {"SystemStructure.ssd": structure(sources, sets, units, stop_time)} | inside
    output.parent.mkdir(parents=True, exist_ok=True)
    return pack(output, files, zipfile.ZIP_STORED)


def main(
    bearing: Annotated[Path, typer.Argument(help="FMU of a scene, native or Python build.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Archive to write.")] = Path(
        "out/spindle.ssp"
    ),
    target_rpm: Annotated[float, typer.Option(min=0.0, max=40e3, help="Speed to go to, in r/min.")] = 2.2e4,
    ramp_time: Annotated[float, typer.Option(min=0.0, help="Duration of the change of speed in s.")] = 0.05,
    stop_time: Annotated[float, typer.Option(min=1e-3, help="Simulated time in s.")] = 0.1,
    partners: Annotated[
        str | None,
        typer.Option(
            metavar="native|python",
            help="Build of motor and thermal network; default: native where there is a C compiler.",
        ),
    ] = None,
    platforms: Platforms = None,
) -> None:
    """Write an .ssp archive of motor, bearing and thermal network."""
    try:
        check_choice(partners, named(platforms))
        written = write(bearing, output, target_rpm / RPM, ramp_time, stop_time, partners, named(platforms))
        typer.echo(f"wrote {written}")
    except (OSError, BuildError, ChoiceError, SimulationError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None


if __name__ == "__main__":
    typer.run(main)
