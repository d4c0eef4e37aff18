"""Build the FMUs of motor and thermal network with pythonfmu: ``python build.py --output-dir out``.

pythonfmu 0.7 writes no units, no initial unknowns, no ability to keep states and a random GUID, and Python
keeps modules by name for the life of a process, so that two FMUs with a module of the same name would share
the first one's code. This file adds the former and names each module after a hash of its source.
"""

import hashlib
import logging
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Annotated
from uuid import UUID
from xml.etree import ElementTree

import typer
from pythonfmu.builder import FmuBuilder

HERE = Path(__file__).resolve().parent
MODELS = ("thermal", "motor")
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date of a zip: the clock stays out of the FMU

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


def build(script: Path, folder: Path) -> Path:
    """Build the FMU of a pythonfmu slave and return its path.

    Parameters
    ----------
    script : Path
        Module with one slave class that has a dictionary ``units`` (variable name to unit).
    folder : Path
        Where the FMU goes; its file name is the class name.
    """
    source = script.read_bytes()
    module = f"spindle_{script.stem}_{hashlib.sha256(source).hexdigest()[:12]}"
    # pythonfmu logs the same line about its binary folder for every build
    logging.getLogger("pythonfmu").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory() as place:
        named = Path(place) / f"{module}.py"
        named.write_bytes(source)
        try:
            raw = FmuBuilder.build_FMU(named, dest=place)
            units = next(
                value.units
                for value in vars(sys.modules[module]).values()
                if hasattr(value, "units") and getattr(value, "__module__", "") == module
            )
        finally:
            sys.modules.pop(module, None)
            sys.path[:] = [entry for entry in sys.path if Path(entry) != Path(place)]
        folder.mkdir(parents=True, exist_ok=True)
        return _rewrite(raw, folder / raw.name, units)


def _rewrite(raw: Path, target: Path, units: dict[str, str]) -> Path:
    """Copy an FMU with a completed description, and without dates."""
    with zipfile.ZipFile(raw) as old:
        files = {name: old.read(name) for name in old.namelist()}
    files["modelDescription.xml"] = _complete(files["modelDescription.xml"], units)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as new:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            new.writestr(entry, files[name])
    return target


def _complete(description: bytes, units: dict[str, str]) -> bytes:
    """Add units, initial unknowns, abilities and a GUID that follows from the interface."""
    root = ElementTree.fromstring(description)
    root.attrib.pop("generationDateAndTime", None)
    root.set("guid", "")
    for ability in ("canGetAndSetFMUstate", "canSerializeFMUstate"):
        root.find("CoSimulation").set(ability, "true")
    definitions = ElementTree.Element("UnitDefinitions")
    for name in sorted(set(units.values())):
        base, display = UNITS[name]
        unit = ElementTree.SubElement(definitions, "Unit", name=name)
        ElementTree.SubElement(unit, "BaseUnit", {key: str(power) for key, power in base.items()})
        if display:
            shown, factor, offset = display
            attributes = {"name": shown, "factor": repr(factor), "offset": repr(offset)}
            ElementTree.SubElement(unit, "DisplayUnit", attributes)
    root.insert([child.tag for child in root].index("CoSimulation") + 1, definitions)
    for variable in root.iter("ScalarVariable"):
        real = variable.find("Real")
        unit = units[variable.get("name", "")]
        real.set("unit", unit)
        if UNITS[unit][1]:
            real.set("displayUnit", UNITS[unit][1][0])
    structure = root.find("ModelStructure")
    unknowns = ElementTree.SubElement(structure, "InitialUnknowns")
    for output in structure.find("Outputs"):
        # Between two steps a new input changes no output: masters need see no algebraic loop.
        output.set("dependencies", "")
        ElementTree.SubElement(unknowns, "Unknown", index=output.get("index"))
    root.set("guid", f"{{{UUID(bytes=hashlib.sha256(ElementTree.tostring(root)).digest()[:16])}}}")
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)


def main(output_dir: Annotated[Path, typer.Option(help="Folder for the FMUs.")] = Path("out")) -> None:
    """Build SpindleThermal.fmu and SpindleMotor.fmu."""
    try:
        for model in MODELS:
            typer.echo(f"built {build(HERE / f'{model}.py', output_dir)}")
    except OSError as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None


if __name__ == "__main__":
    typer.run(main)
