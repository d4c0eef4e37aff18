"""Writing the FMU: the same model gives the same bytes, whenever and wherever it is built."""

import io
import os
import re
import tempfile
import zipfile
from collections import Counter
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_bearing.fmi import documentation, resources
from fmu_bearing.fmi.description import description_xml, identifier, interface_guid

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model

__all__ = ["BuiltFmu", "build", "contents"]

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
    """

    path: Path
    guid: str
    identifier: str
    size: int
    variables: dict[str, int]

    def __str__(self) -> str:
        """Return one line that says what was built."""
        counts = ", ".join(f"{count} {causality}" for causality, count in self.variables.items())
        return (
            f"{self.path}: {sum(self.variables.values())} variables ({counts}), "
            f"{self.size / 1024:.0f} KiB, GUID {self.guid}"
        )


def build(model: "Model", output: str | Path | None = None) -> BuiltFmu:
    """Write the FMU of a model.

    Parameters
    ----------
    model : Model
        Prepared scene.
    output : str or Path, optional
        File to write; folders on the way are made. Default: the identifier with ``.fmu`` in the current
        folder. An existing file is replaced only once the new one is complete.

    Returns
    -------
    BuiltFmu

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    path = Path(output) if output is not None else Path(f"{identifier(model)}.fmu")
    if path.is_dir():
        raise IsADirectoryError(f"{path} is a folder: name the file to write")
    data = _zip(contents(model))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        _write_whole(path, data)
    except OSError as error:
        raise OSError(f"cannot write {path}: {error.strerror or error}") from error
    counts = Counter("constant" if v.variability == "constant" else v.causality for v in model.variables)
    return BuiltFmu(path, interface_guid(model), identifier(model), len(data), dict(sorted(counts.items())))


def contents(model: "Model") -> dict[str, bytes]:
    """Return all files of the FMU of a model, by path inside the zip."""
    name = identifier(model)
    fingerprint = resources.fingerprint(model)
    # Python keeps modules by name for the life of the process: two FMUs must not share one.
    module = f"{re.sub('[^a-z0-9]', '_', name.lower())}_{fingerprint[:16]}"
    stub = _STUB.format(identifier=name, fingerprint=fingerprint)
    inside = {
        "modelDescription.xml": description_xml(model),
        "model.png": (documentation.templates() / "model.png").read_bytes(),
        f"resources/{module}.py": stub.encode("utf-8"),
        "resources/slavemodule.txt": module.encode("ascii"),
    }
    inside |= {f"resources/{file}": data for file, data in resources.contents(model).items()}
    inside |= {f"documentation/{file}": data for file, data in documentation.pages(model).items()}
    inside |= _binaries(name)
    return inside


def _binaries(name: str) -> dict[str, bytes]:
    """Return pythonfmu's libraries under the name FMI wants."""
    found = {}
    for platform in (files("pythonfmu") / "resources" / "binaries").iterdir():
        if platform.is_dir():
            for library in platform.iterdir():
                suffix = Path(library.name).suffix
                if suffix in (".so", ".dll", ".dylib"):
                    found[f"binaries/{platform.name}/{name}{suffix}"] = library.read_bytes()
    return found


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


def _write_whole(path: Path, data: bytes) -> None:
    """Write all of a file or none of it."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
