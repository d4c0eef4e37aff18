"""Writing the FMU: the same model gives the same bytes, whenever and wherever it is built."""

import io
import re
import zipfile
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_bearing.compiled import BuildError
from fmu_bearing.compiled.platforms import PLATFORMS, host, narrowed, platform_named
from fmu_bearing.engine.layout import P
from fmu_bearing.engine.sources import engine_digest
from fmu_bearing.file_words import why
from fmu_bearing.files import rescued, write_whole
from fmu_bearing.fmi import documentation, resources
from fmu_bearing.fmi.description import FLAVOURS, description_xml, identifier, interface_guid
from fmu_bearing.fmi.fmu_model import as_fmu_model
from fmu_bearing.fmi.native.link import library
from fmu_bearing.fmi.native.model_file import MODEL_FILE, model_bytes
from fmu_bearing.fmi.reference import NoReference, reference_files, run_instance, run_library
from fmu_bearing.fmi.terminals import TERMINALS_FILE, terminals_xml
from fmu_bearing.progress import Tell, silent, work

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model

__all__ = ["BuiltFmu", "ChoiceError", "build", "check_choice", "contents"]

_EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date a zip can hold: the clock stays out of the FMU
_UNIX = 3

_STUB = '''"""The slave of this FMU; the model is in the installed package fmu_bearing."""

from fmu_bearing.fmi import host, python_slave

host.keep(globals())


class {identifier}(python_slave.BearingSlave):
    fingerprint = "{fingerprint}"
'''


@dataclass(frozen=True)
class BuiltFmu:
    """An FMU that was written.

    Attributes
    ----------
    path : Path
    guid : str
    identifier : str
        Name of the shared libraries inside.
    size : int
        Bytes.
    variables : dict of str to int
        Number of variables of each causality.
    flavour : str
        ``native`` or ``python``.
    platforms : tuple of str
        Folders of the libraries inside.
    remarks : tuple of str
        Parts that were not built, and why.
    """

    path: Path
    guid: str
    identifier: str
    size: int
    variables: dict[str, int]
    flavour: str
    platforms: tuple[str, ...]
    remarks: tuple[str, ...] = ()

    def __str__(self) -> str:
        """Return one line about what was built, and one for each part that was not."""
        counts = ", ".join(f"{count} {causality}" for causality, count in self.variables.items())
        line = (
            f"{self.path}: {self.flavour} build for {', '.join(self.platforms)}; "
            f"{sum(self.variables.values())} variables ({counts}), {self.size / 1024:.0f} KiB, "
            f"GUID {self.guid}"
        )
        return "\n".join((line, *(f"not built: {remark}" for remark in self.remarks)))


def build(
    model: "Model",
    output: str | Path | None = None,
    flavour: str | None = None,
    platforms: Sequence[str] | None = None,
    tell: Tell = silent,
    only_here: bool = False,
) -> BuiltFmu:
    """Write the FMU of a model.

    Parameters
    ----------
    model : Model
        Prepared scene.
    output : str or Path, optional
        File to write; folders on the way are made. Default: the identifier with ``.fmu`` in the current
        folder. An existing file is replaced only once the new one is complete.
    flavour : str, optional
        ``native``: equations compiled, no Python at run time. ``python``: equations run by the installed
        package, through pythonfmu. Default: native where a library can be made or is kept for at least one
        platform, else python; the remarks of the result say why.
    platforms : sequence of str, optional
        Platforms of a native FMU (names as in ``compiled.platforms.PLATFORMS``). Default: this machine's.
    tell : callable, optional
        Takes a line of text before work that takes minutes.
    only_here : bool
        A native FMU for this machine's instruction set, with no more equations than the scene needs: less to
        compile. Results have the same bits.

    Returns
    -------
    BuiltFmu

    Raises
    ------
    OSError
        If the file cannot be written: the FMU is among the temporary files then, where these take it.
    ChoiceError
        If there is no such flavour or platform, or platforms are named for a Python build or one only for
        here.
    BuildError
        If a library that was asked for cannot be made.
    """
    path = Path(output) if output is not None else Path(f"{identifier(model.scene)}.fmu")
    if path.is_dir():
        raise IsADirectoryError(f"{path} is a folder: name the file to write")
    check_choice(flavour, platforms, only_here)
    model = as_fmu_model(model)
    remarks: tuple[str, ...] = ()
    binaries: dict[str, bytes] = {}
    if flavour != "python":
        try:
            binaries = _library_here(model, tell) if only_here else _libraries(platforms, tell)
            flavour = "native"
        except BuildError as problem:
            if flavour == "native" or platforms:
                raise
            flavour, remarks = "python", (f"native FMU: {problem}",)
    with work("reference results") as display:
        inside = contents(model, flavour, binaries)
        try:
            inside |= _reference(model, flavour, binaries, inside)
        except NoReference as problem:
            remarks = (*remarks, f"reference results: {problem}")
        display.named(f"packing {path.name}")
        data = _zip(inside)
    try:
        rescued(partial(write_whole, data=data), path)
    except OSError as error:
        size = f"it has {1e-6 * len(data):.2g} MB: make room, or name another file to write"
        raise OSError(f"cannot write {why(error)}; {size}") from error
    counts = Counter("constant" if v.variability == "constant" else v.causality for v in model.variables)
    return BuiltFmu(
        path,
        interface_guid(model, flavour),
        identifier(model.scene),
        len(data),
        dict(sorted(counts.items())),
        flavour,
        tuple(sorted({name.split("/")[1] for name in inside if name.startswith("binaries/")})),
        remarks,
    )


class ChoiceError(ValueError):
    """An unknown flavour or platform."""


def check_choice(flavour: str | None, platforms: Sequence[str] | None, only_here: bool = False) -> None:
    """Raise :class:`ChoiceError` unless an FMU of that flavour can be built for those platforms."""
    if flavour not in (None, *FLAVOURS):
        raise ChoiceError(f"there is no flavour '{flavour}': choose {' or '.join(FLAVOURS)}")
    for name in platforms or ():
        try:
            platform_named(name)
        except BuildError as unknown:
            raise ChoiceError(str(unknown)) from None
    if flavour == "python" and platforms:
        raise ChoiceError("platforms cannot be chosen for a python build: it holds pythonfmu's libraries")
    if platforms and only_here:
        raise ChoiceError(
            "an FMU only for here is for this machine: name no platforms, or leave out --only-here"
        )


def _library_here(model: "Model", tell: Tell) -> dict[str, bytes]:
    """Return this machine's library that holds what a model needs."""
    own = host()
    if own is None:
        raise BuildError("this machine is none of " + ", ".join(PLATFORMS))
    units = "single" if model.parameters[P.ALONE] != 0.0 else "all"
    return {own.name: library(narrowed(own), "auto", tell, units)}


def _libraries(platforms: Sequence[str] | None, tell: Tell) -> dict[str, bytes]:
    """Return the library of each platform, this machine's if none is named."""
    own = host()
    if not platforms and own is None:
        raise BuildError(
            "this machine is none of " + ", ".join(PLATFORMS) + ": name the platforms to build for"
        )
    names = list(dict.fromkeys(platforms or ())) or [own.name if own else ""]
    prefer = "portable" if platforms else "auto"  # named ones are for other machines too
    return {name: library(PLATFORMS[name], prefer, tell) for name in names}


def _reference(
    model: "Model", flavour: str, libraries: Mapping[str, bytes], inside: Mapping[str, bytes]
) -> dict[str, bytes]:
    """Return the files of the reference results, run by this machine's library if it is inside."""
    own = host()
    if own is None or own.name not in libraries:
        return reference_files(model, run_instance)
    guid, numbers = interface_guid(model, flavour), inside[f"resources/{MODEL_FILE}"]
    return reference_files(model, partial(run_library, libraries[own.name], guid, numbers))


def contents(model: "Model", flavour: str, libraries: Mapping[str, bytes] | None = None) -> dict[str, bytes]:
    """Return all files of the FMU of a model but its reference results, by path inside the zip.

    ``libraries``: by platform, for a native build.
    """
    model = as_fmu_model(model)
    inside = {
        "modelDescription.xml": description_xml(model, flavour),
        "model.png": (documentation.templates() / "model.png").read_bytes(),
        f"resources/{resources.SCENE}": model.scene.to_toml().encode("utf-8"),
    }
    inside |= {f"documentation/{file}": data for file, data in documentation.pages(model, flavour).items()}
    if model.scene.fmu is not None and model.scene.fmu.terminals:
        inside[TERMINALS_FILE] = terminals_xml(as_fmu_model(model))
    if flavour == "python":
        return inside | _python_parts(model)
    name = identifier(model.scene)
    for platform, data in (libraries or {}).items():
        inside[f"binaries/{platform}/{name}{PLATFORMS[platform].suffix}"] = data
    guid = interface_guid(model, flavour)
    inside[f"resources/{MODEL_FILE}"] = model_bytes(model, guid, engine_digest().hex())
    return inside


def _python_parts(model: "Model") -> dict[str, bytes]:
    """Return the files of the Python build only: stub, parameters, pythonfmu's libraries."""
    name = identifier(model.scene)
    fingerprint = resources.fingerprint(model)
    # Python keeps modules by name for the life of the process: two FMUs must not share one.
    module = f"{re.sub('[^a-z0-9]', '_', name.lower())}_{fingerprint[:16]}"
    stub = _STUB.format(identifier=name, fingerprint=fingerprint)
    return {
        f"resources/{module}.py": stub.encode("utf-8"),
        "resources/slavemodule.txt": module.encode("ascii"),
        f"resources/{resources.PARAMETERS}": resources.parameter_bytes(model),
        **_binaries(name),
    }


def _binaries(name: str) -> dict[str, bytes]:
    """Return pythonfmu's libraries under the name FMI wants."""
    libraries = {}
    for platform in (files("pythonfmu") / "resources" / "binaries").iterdir():
        if platform.is_dir():
            for file in platform.iterdir():
                suffix = Path(file.name).suffix
                if suffix in (".so", ".dll", ".dylib"):
                    libraries[f"binaries/{platform.name}/{name}{suffix}"] = file.read_bytes()
    return libraries


def _zip(inside: dict[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in sorted(inside):
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = _UNIX
            entry.external_attr = (0o755 if name.startswith("binaries/") else 0o644) << 16
            archive.writestr(entry, inside[name])
    return buffer.getvalue()
