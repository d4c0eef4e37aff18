"""Reference results inside the FMU: a short run that importers can repeat and compare.

The layout is that of the layered standard FMI-LS-REF 1.0.0-alpha.1 (Modelica Association): a manifest that
names an experiment of role ``experiment/smoke-test`` and the results it refers to.
"""

import ctypes
import tempfile
from collections.abc import Callable, Sequence
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from fmu_bearing.fmi.fmu_model import as_fmu_model
from fmu_bearing.fmi.native.model_file import MODEL_FILE
from fmu_bearing.instance import Instance
from fmu_bearing.interface import flat

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model

__all__ = ["FOLDER", "NoReference", "reference_files", "run_instance", "run_library"]

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"

# A start and the first milliseconds after it, in which every part of the model has moved; longer would
# show how small differences between C libraries grow, and delay the build.
STEP_SIZE = 1e-4  # s
STEPS = 50
_DIGITS = 9  # beyond what such differences reach in this time

_WANTED = (
    "friction_torque",
    "heat.inner_ring",
    "heat.outer_ring",
    "heat.oil",
    "cage.speed_ratio",
    "inner_ring.velocity.z",
    "outer_ring.velocity.z",
    "ball[1].velocity.x",
    "mic[1].pressure",
    # of a set
    "shaft.nose.velocity.z",
    "housing.velocity.z",
    "bearing[1].force.x",
    "bearing[1].cage.speed_ratio",
    "bearing[1].ball[1].velocity.x",
)
_MANIFEST = "http://fmi-standard.org/fmi-ls-manifest"
_NOTE = """Reference results

{folder} holds the results of one experiment, by the rules of FMI-LS-REF: all inputs and
parameters at their start values, from 0 s, {steps} communication steps of {size:g} s each; see
reference.exp and reference.csv there.

They were made by the model itself when this FMU was built, and are written with {digits} digits. On a machine
with another C library the last of them may differ.
"""

#: Values of some variables: row by row, the first at the start.
Run = Callable[["Model", Sequence[int]], list[list[float]]]


class NoReference(RuntimeError):
    """A model that cannot be run at its start values, or a library that does not run it."""


def reference_files(model: "Model", run: Run) -> dict[str, bytes]:
    """Return manifest, experiment, results and a note about them, by path in the FMU.

    Parameters
    ----------
    model : Model
    run : callable
        Steps the model and returns values by reference: :func:`run_instance`, or :func:`run_library` with
        its library bound.

    Raises
    ------
    NoReference
        If the model cannot be run.
    """
    wanted = [flat(name) for name in _WANTED] if as_fmu_model(model).is_flat else _WANTED
    places = {v.name: i for i, v in enumerate(model.variables) if v.name in wanted}
    names = [name for name in wanted if name in places]
    lines = [",".join(("time", *names))]
    for i, values in enumerate(run(model, [places[name] for name in names])):
        lines.append(",".join(f"{value:.{_DIGITS}g}" for value in (i * STEP_SIZE, *values)))
    note = _NOTE.format(folder=FOLDER, steps=STEPS, size=STEP_SIZE, digits=_DIGITS)
    return {
        f"{FOLDER}/fmi-ls-manifest.xml": _text(_manifest()),
        f"{FOLDER}/reference.exp": _text(_experiments()),
        f"{FOLDER}/reference.csv": ("\n".join(lines) + "\n").encode("ascii"),
        "documentation/fmi-ls-ref.txt": note.encode("ascii"),
    }


def _text(root: Element) -> bytes:
    indent(root, "  ")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="utf-8") + b"\n"


def _manifest() -> Element:
    named = {
        "name": "org.fmi-standard.fmi-ls-ref",
        "version": "1.0.0-alpha.1",
        "description": "Layered Standard providing information on related files included in an FMU.",
    }
    # the prefix is set by hand: ElementTree keeps one table of prefixes for the whole process
    attributes = {"xmlns:fmi-ls": _MANIFEST, **{f"fmi-ls:fmi-ls-{key}": text for key, text in named.items()}}
    root = Element("fmiReferences", attributes)
    related = (
        (
            "application/x-ma-ls-experiments",
            "reference.exp",
            "experiment/smoke-test",
            "How to repeat the run",
        ),
        ("text/csv", "reference.csv", "result", "What came out of it when this FMU was built"),
    )
    for kind, source, role, sentence in related:
        SubElement(root, "Related", {"type": kind, "source": source, "role": role, "description": sentence})
    return root


def _experiments() -> Element:
    root = Element("Experiments", {"name": "Reference", "description": "A run to compare with"})
    times = {"startTime": "0.0", "stopTime": repr(STEPS * STEP_SIZE), "stepSize": repr(STEP_SIZE)}
    about = {"name": "start", "description": "Start values throughout", **times}
    experiment = SubElement(root, "Experiment", about)
    SubElement(experiment, "References", {"source": "reference.csv", "type": "text/csv"})
    return root


def run_instance(model: "Model", references: Sequence[int]) -> list[list[float]]:
    """Step a model by the compiled kernels of this process."""
    names = [model.variables[reference].name for reference in references]
    instance = Instance(model)
    rows = []
    try:
        instance.initialise(0.0)
        for i in range(STEPS + 1):
            if i:
                instance.step(STEP_SIZE)
            rows.append([instance.get(name) for name in names])
    except ValueError as problem:
        raise NoReference(str(problem)) from problem
    return rows


_CO_SIMULATION = 1


def run_library(
    library: bytes, guid: str, contents: bytes, model: "Model", references: Sequence[int]
) -> list[list[float]]:
    """Step a model by its native library: no kernel need be compiled or loaded in this process.

    Parameters
    ----------
    library : bytes
        For this machine.
    guid : str
    contents : bytes
        Of ``model.bin``.
    model, references
        As for :func:`run_instance`.
    """
    # Windows does not remove a library that is loaded
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        (Path(folder) / MODEL_FILE).write_bytes(contents)
        file = Path(folder) / "library"
        file.write_bytes(library)
        try:
            loaded = ctypes.CDLL(str(file))
        except OSError as problem:
            raise NoReference(f"the library does not load: {problem}") from problem
        callbacks = (c_void_p * 5)()  # no logger, no memory functions: the library needs none
        loaded.fmi2Instantiate.restype = c_void_p
        loaded.fmi2Instantiate.argtypes = (c_char_p, c_int, c_char_p, c_char_p, c_void_p, c_int, c_int)
        location = Path(folder).as_uri().encode()
        made = loaded.fmi2Instantiate(
            b"reference", _CO_SIMULATION, guid.encode(), location, ctypes.byref(callbacks), 0, 0
        )
    if not made:
        raise NoReference("the library refuses the model")
    try:
        return _drive(loaded, c_void_p(made), references)
    finally:
        loaded.fmi2FreeInstance(c_void_p(made))


def _drive(loaded: ctypes.CDLL, made: c_void_p, references: Sequence[int]) -> list[list[float]]:
    loaded.fmi2SetupExperiment.argtypes = (c_void_p, c_int, c_double, c_double, c_int, c_double)
    loaded.fmi2DoStep.argtypes = (c_void_p, c_double, c_double, c_int)
    loaded.fmi2GetReal.argtypes = (c_void_p, POINTER(c_uint), c_size_t, POINTER(c_double))
    count = len(references)
    asked, values = (c_uint * count)(*references), (c_double * count)()
    statuses = [
        loaded.fmi2SetupExperiment(made, 0, 0.0, 0.0, 0, 0.0),
        loaded.fmi2EnterInitializationMode(made),
        loaded.fmi2ExitInitializationMode(made),
    ]
    rows = []
    for i in range(STEPS + 1):
        if i:
            statuses.append(loaded.fmi2DoStep(made, (i - 1) * STEP_SIZE, STEP_SIZE, 1))
        statuses.append(loaded.fmi2GetReal(made, asked, count, values))
        if any(statuses):
            raise NoReference(f"the model does not run at its start values beyond {i * STEP_SIZE:.4g} s")
        rows.append(list(values))
    return rows
