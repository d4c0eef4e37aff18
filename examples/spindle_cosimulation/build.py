"""Build the FMUs of motor and thermal network: ``python build.py --output-dir out``.

``native`` FMUs are C (``native/``) and run in any program; ``python`` ones run in Python. Names,
units and start values of both builds come from the slaves in ``motor.py`` and ``thermal.py``.

pythonfmu 0.7 writes no units, no initial unknowns, no ability to keep states, 16 digits of a start value and
a random GUID, and Python keeps modules by name for the life of a process, so that two FMUs with a module of
the same name would share the first one's code. This file adds the former and names each module after a hash
of its source. It also adds to the module what keeps pythonfmu's library from using freed memory at exit
(`fmu_bearing.fmi.host.release_at_exit`): the FMUs run where this package is not installed.
"""

import hashlib
import inspect
import logging
import re
import sys
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated
from uuid import UUID
from xml.etree import ElementTree

import typer
from pythonfmu import Fmi2Slave
from pythonfmu.builder import FmuBuilder

from fmu_bearing.cli.build import Flavour, Platforms, named
from fmu_bearing.compiled import BuildError
from fmu_bearing.compiled.platforms import PLATFORMS, host
from fmu_bearing.fmi.host import release_at_exit
from fmu_bearing.fmi.native.link import compiler_for, link
from fmu_bearing.fmi.package import ChoiceError, check_choice

HERE = Path(__file__).resolve().parent
NATIVE = HERE / "native"
MODELS = ("thermal", "motor")
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date of a zip: the clock stays out of the FMU
UNIX = 3

#: End of each slave's module, whose body runs once per instance with the FMU's resources first in sys.path.
ENDING = f"""

import atexit
import ctypes
import os
import sys
from pathlib import Path


{inspect.getsource(release_at_exit)}

for library in Path(sys.path[0]).parent.glob("binaries/linux64/*.so"):
    release_at_exit(library)
"""

#: Base units of FMI 2.0 for each unit used here, and what tools may show instead (name, factor, offset).
UNITS = {
    "s": ({"s": 1}, None),
    "rad/s": ({"rad": 1, "s": -1}, ("r/min", 9.549296585513721, 0.0)),
    "N.m": ({"kg": 1, "m": 2, "s": -2}, None),
    "N.m/A": ({"kg": 1, "m": 2, "s": -2, "A": -1}, None),
    "Ohm": ({"kg": 1, "m": 2, "s": -3, "A": -2}, None),
    "kg.m2": ({"kg": 1, "m": 2}, None),
    "W": ({"kg": 1, "m": 2, "s": -3}, None),
    "J": ({"kg": 1, "m": 2, "s": -2}, None),
    "J/K": ({"kg": 1, "m": 2, "s": -2, "K": -1}, None),
    "W/K": ({"kg": 1, "m": 2, "s": -3, "K": -1}, None),
    "K": ({"K": 1}, ("degC", 1.0, -273.15)),
}


def best_flavour() -> str:
    """Return ``native`` where there is a C compiler for this machine, else ``python``."""
    own = host()
    try:
        if own is not None:
            compiler_for(own)
            return "native"
    except BuildError:
        pass
    return "python"


def build(
    script: Path,
    folder: Path,
    flavour: str = "python",
    platforms: Sequence[str] = (),
    bearings: int = 1,
    shaft: bool = False,
) -> Path:
    """Build the FMU of a pythonfmu slave, or of the C model of the same name, and return its path.

    Parameters
    ----------
    script : Path
        Module with one slave class that has dictionaries ``units`` (variable name to unit) and, if it can say
        so, ``initial_dependencies`` (output to the names that its start depends on).
    folder : Path
        Where the FMU goes; its file name is the class name.
    flavour : str
        ``python``, or ``native``: the equations in ``native/NAME.c`` with the variables of the module NAME.
    platforms : sequence of str
        Platforms of a native FMU; default: this machine's.
    bearings : int
        How many bearings a thermal network has; more than one are the bearings of a set.
    shaft : bool
        Whether the thermal network of a single bearing has a shaft, too.

    Raises
    ------
    BuildError
        If a library cannot be made, or bearings or a shaft are asked of a model that has no such choice.
    """
    source = script.read_bytes()
    for usual, asked, words in (
        (b"BEARINGS = 1", b"BEARINGS = %d" % bearings, "number of bearings"),
        (b"SHAFT = False", b"SHAFT = %r" % shaft, "choice of a shaft"),
    ):
        if asked != usual:
            source, found = re.subn(rb"^%s$" % usual, asked, source, flags=re.M)
            if found != 1:
                raise BuildError(f"{script.name} has no {words}")
    files, slave = _python_parts(script.stem, source)
    root = _complete(files["modelDescription.xml"], slave, flavour)
    if flavour == "native":
        files = _native_parts(script.stem, slave, root.get("guid", ""), platforms)
    ElementTree.indent(root)
    files["modelDescription.xml"] = ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)
    folder.mkdir(parents=True, exist_ok=True)
    return pack(folder / f"{type(slave).__name__}.fmu", files, zipfile.ZIP_DEFLATED)


def pack(target: Path, files: dict[str, bytes], compression: int) -> Path:
    """Write files into a zip that is the same whenever and wherever it is written."""
    with zipfile.ZipFile(target, "w", compression) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = compression
            entry.create_system = UNIX
            entry.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
            archive.writestr(entry, data)
    return target


def _python_parts(name: str, source: bytes) -> tuple[dict[str, bytes], Fmi2Slave]:
    """Return the files of pythonfmu's FMU in name order, and a fresh instance of its slave."""
    source += ENDING.encode()
    module = f"spindle_{name}_{hashlib.sha256(source).hexdigest()[:12]}"
    # pythonfmu logs the same line about its binary folder for every build
    logging.getLogger("pythonfmu").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory() as place:
        script = Path(place) / f"{module}.py"
        script.write_bytes(source)
        try:
            raw = FmuBuilder.build_FMU(script, dest=place)
            made = next(
                value
                for value in vars(sys.modules[module]).values()
                if hasattr(value, "units") and getattr(value, "__module__", "") == module
            )
            slave = made(instance_name="starts")
        finally:
            sys.modules.pop(module, None)
            sys.path[:] = [entry for entry in sys.path if Path(entry) != Path(place)]
        with zipfile.ZipFile(raw) as archive:
            return {name: archive.read(name) for name in sorted(archive.namelist())}, slave


def _native_parts(model: str, slave: Fmi2Slave, guid: str, platforms: Sequence[str]) -> dict[str, bytes]:
    """Return the compiled library of each platform, by its path inside the FMU."""
    own = host()
    if not platforms and own is None:
        raise BuildError("this machine is none of " + ", ".join(PLATFORMS) + ": name the platforms")
    prefer = "portable" if platforms else "auto"  # named ones are for other machines too
    files = {}
    for name in sorted(set(platforms) or {own.name if own else ""}):
        platform = PLATFORMS[name]
        with tempfile.TemporaryDirectory() as place:
            # a C file looks for its headers beside itself first
            for file in ("partner.h", "partner.c", f"{model}.c"):
                (Path(place) / file).write_bytes((NATIVE / file).read_bytes())
            (Path(place) / "variables.h").write_text(variables_header(slave, guid), encoding="ascii")
            sources = [Path(place) / "partner.c", Path(place) / f"{model}.c"]
            # no kernels: neither objects nor their hash
            data = link(compiler_for(platform, prefer), platform, sources, kernels=(), digest="")
        files[f"binaries/{name}/{type(slave).__name__}{platform.suffix}"] = data
    return files


def variables_header(slave: Fmi2Slave, guid: str) -> str:
    """Return ``variables.h``: what ``native/partner.h`` says of it, with the slave's values as starts."""
    variables = slave.vars.values()  # in the order of their value references
    rows = [
        (f'"{variable.name}"', variable.causality.name.upper(), float(variable.getter()).hex())
        for variable in variables
    ]
    # a table's strings are names of variables; an empty one is none
    tables = {
        name: [[_identifier(cell) if isinstance(cell, str) else str(cell) for cell in row] for row in table]
        for name, table in getattr(slave, "tables", {}).items()
    }
    lines = [f'#define PARTNER_GUID "{guid}"', ""]
    lines += [f"enum {{ {', '.join(_identifier(variable.name) for variable in variables)}, N_VARIABLES }};"]
    lines += [f"enum {{ N_HIDDEN = {getattr(slave, 'remembered', 32)} }};"]
    for name, table in {"VARIABLES": rows, **tables}.items():
        lines += ["", f"#define PARTNER_{name} \\"]
        lines += [", \\\n".join(f"    {{{', '.join(row)}}}" for row in table)]
    return "\n".join(lines) + "\n"


def _identifier(name: str) -> str:
    """Name of a variable in C, ``BEARING_1_HEAT_OIL`` for ``bearing[1].heat.oil``; -1 for none."""
    return re.sub(r"\W+", "_", name).upper() if name else "-1"


def _complete(description: bytes, slave: Fmi2Slave, flavour: str) -> ElementTree.Element:
    """Add units, initial unknowns, abilities and a GUID that follows from the interface."""
    root = ElementTree.fromstring(description)
    root.attrib.pop("generationDateAndTime", None)
    root.set("guid", "")
    abilities = {"canGetAndSetFMUstate": "true", "canSerializeFMUstate": "true"}
    if flavour == "native":
        root.set("generationTool", "fmu-bearing, examples/spindle_cosimulation/build.py")
        abilities["needsExecutionTool"] = "false"
    root.find("CoSimulation").attrib.update(abilities)
    definitions = ElementTree.Element("UnitDefinitions")
    for name in sorted(set(slave.units.values())):
        unit = ElementTree.SubElement(definitions, "Unit", name=name)
        base, display = UNITS[name]
        ElementTree.SubElement(unit, "BaseUnit", {key: str(power) for key, power in base.items()})
        if display:
            shown, factor, offset = display
            attributes = {"name": shown, "factor": repr(factor), "offset": repr(offset)}
            ElementTree.SubElement(unit, "DisplayUnit", attributes)
    root.insert([child.tag for child in root].index("CoSimulation") + 1, definitions)
    for variable, description in zip(slave.vars.values(), root.iter("ScalarVariable"), strict=True):
        real = description.find("Real")
        unit = slave.units[variable.name]
        real.set("unit", unit)
        if UNITS[unit][1]:
            real.set("displayUnit", UNITS[unit][1][0])
        if "start" in real.attrib:
            real.set("start", repr(float(variable.getter())))
    _add_unknowns(root.find("ModelStructure"), slave)
    root.set("guid", f"{{{UUID(bytes=hashlib.sha256(ElementTree.tostring(root)).digest()[:16])}}}")
    return root


def _add_unknowns(structure: ElementTree.Element, slave: Fmi2Slave) -> None:
    """Add the initial unknowns, and say what outputs depend on, so that masters see no loop where none is."""
    index = {variable.name: number for number, variable in enumerate(slave.vars.values(), 1)}
    known = getattr(slave, "initial_dependencies", {})
    unknowns = ElementTree.SubElement(structure, "InitialUnknowns")
    for output in structure.find("Outputs"):
        output.set("dependencies", "")  # between two steps a new input changes no output
        unknown = ElementTree.SubElement(unknowns, "Unknown", index=output.get("index"))
        name = slave.vars[int(output.get("index")) - 1].name
        if name in known:
            unknown.set("dependencies", " ".join(map(str, sorted(index[one] for one in known[name]))))


def main(
    output_dir: Annotated[Path, typer.Option(help="Folder for the FMUs.")] = Path("out"),
    flavour: Flavour = None,
    platforms: Platforms = None,
) -> None:
    """Build SpindleThermal.fmu and SpindleMotor.fmu."""
    try:
        check_choice(flavour, named(platforms))
        flavour = flavour or ("native" if platforms else best_flavour())
        for model in MODELS:
            built = build(HERE / f"{model}.py", output_dir, flavour, named(platforms))
            typer.echo(f"built {built}: {flavour}")
    except (OSError, BuildError, ChoiceError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None


if __name__ == "__main__":
    typer.run(main)
