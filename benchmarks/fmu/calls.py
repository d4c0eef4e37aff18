"""Nanoseconds of doStep, getReal, state copies and instantiation, through a C host and through FMPy.

An empty step shows what the calls cost. The native build then has kernels that compute nothing
(``empty_kernel.c``), the Python build a step that returns at once, and ``minimal_fmu.c`` is what a careful
author would write by hand. Instantiation, states and threads are timed on the FMUs of whole scenes too.
"""

import hashlib
import itertools
import subprocess
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import fmpy
import fmpy.fmi2

from benchmarks.cases import GATES, silent
from fmu_bearing.compiled.platforms import Platform, host
from fmu_bearing.fmi.native.link import FLAGS, Compiler, compiler_for, headers, link, shim_sources
from fmu_bearing.fmi.native.model_file import MODEL_FILE, Contents, contents_bytes
from fmu_bearing.fmi.package import build
from fmu_bearing.interface import Variable
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

COLUMNS = (
    "FMU", "host", "empty doStep, ns", "x minimal", "50 outputs, ns", "get + set state, us",
    "instantiate, ms", "two threads", "goals",
)  # fmt: skip
HERE = Path(__file__).parent
HOST = [str(HERE.parents[1] / "tests" / "native" / name) for name in ("host.c", "host_times.c")]
GUID = "{00000000-0000-0000-0000-000000000000}"
INPUTS, OUTPUTS = 8, 50
STEP = 1e-4  # s
OVERHEAD_GOAL, INSTANTIATE_GOAL, THREADS_GOAL = 1.2, 10.0, 1.8
_ROUNDS = 5


class Case:
    """An FMU to call: its library, what it needs, and whether its step is empty."""

    def __init__(self, name: str, library: Path, guid: str, resources: Path, first: int, empty: bool) -> None:
        self.name, self.library, self.guid, self.empty = name, library, guid, empty
        self.resources = resources
        self.outputs = list(range(first, first + OUTPUTS))


def compiled(folder: Path, platform: Platform, compiler: Compiler) -> Iterator[Case]:
    """The minimal FMU and the native build around empty kernels."""
    minimal = folder / f"Minimal{platform.suffix}"
    command = [*compiler.command, *FLAGS, f"-I{headers()}", "-shared", str(HERE / "minimal_fmu.c")]
    subprocess.run([*command, "-o", str(minimal), "-lm"], check=True)
    resources = folder / "resources"
    resources.mkdir()
    yield Case("minimal, C by hand", minimal, GUID, resources, INPUTS, empty=True)
    objects = []
    for suffix, _ in platform.instruction_sets:
        made = folder / f"empty_{suffix}.o"
        source = [str(HERE / "empty_kernel.c"), f"-DISA={suffix}", "-c", "-o", str(made)]
        subprocess.run([*compiler.command, *FLAGS, *source], check=True)
        objects.append(made.read_bytes())
    digest = hashlib.sha256(b"empty kernels").hexdigest()
    library = folder / f"Empty{platform.suffix}"
    library.write_bytes(link(compiler, platform, shim_sources(), objects, digest))
    variables = [
        Variable(f"u{i}", "input", "continuous", "", min=-1e9, max=1e9, start=0.0, array="u", index=i)
        for i in range(INPUTS)
    ]
    variables += [Variable(f"z{i}", "output", "continuous", "", array="z", index=i) for i in range(OUTPUTS)]
    contents = Contents(
        guid=GUID, kernels=digest, fingerprint=digest, parameters=[0.0], inputs=[0.0] * INPUTS,
        state_size=OUTPUTS, output_size=OUTPUTS, work_size=1, time=0, tunables=1, variables=variables,
    )  # fmt: skip
    (resources / MODEL_FILE).write_bytes(contents_bytes(contents))
    yield Case("native, empty kernels", library, GUID, resources, INPUTS, empty=True)


def packed(folder: Path, name: str, flavour: str, sounding: bool) -> Case:
    """The FMU of a scene, unpacked."""
    scene = read_scene(GATES / f"{name}.toml") if sounding else silent(name)
    where = folder / f"{name} {flavour} {sounding}"
    fmu = build(prepare(scene), folder / "one.fmu", flavour)
    with zipfile.ZipFile(fmu.path) as archive:
        archive.extractall(where)
    empty = flavour == "python"
    if empty:
        (stub,) = (where / "resources").glob("bearing*.py")
        stub.write_text(
            stub.read_text()
            + "\n    def __init__(self, **kwargs):\n        super().__init__(**kwargs)\n"
            + "        self.session._instance.step = lambda h: None\n"
        )
    (library,) = (where / "binaries" / fmu.platforms[0]).iterdir()
    outputs = [
        i
        for i, v in enumerate(fmpy.read_model_description(str(where)).modelVariables)
        if v.causality == "output"
    ]
    words = f"{flavour} {name}, {'with sound' if sounding else 'no sound'}" + (
        ", step left out" if empty else ""
    )
    return Case(words, library, fmu.guid, where / "resources", outputs[0], empty)


def through_c(program: Path, case: Case) -> dict[str, float]:
    """What the host in C prints, in its own units: ns, and how much faster two threads are."""
    references = ",".join(map(str, case.outputs))
    commands = [
        "start:0",
        f"time-step:{STEP}:{200_000 if case.empty else 20}",
        f"time-get:200000:{references}",
    ]
    commands += [f"time-state:{20_000 if case.empty else 500}", "time-instantiate:50"]
    if not case.empty:
        commands.append("threads:2:1e-3:40")
    ran = subprocess.run(
        [str(program), str(case.library), case.guid, case.resources.as_uri(), *commands],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return {line.split()[0]: float(line.split()[1]) for line in ran.stdout.splitlines()}


def least(call: Callable[[], object], count: int) -> float:
    """Least time (ns) of a call over several rounds."""
    rounds = []
    for _ in range(_ROUNDS):
        begin = time.perf_counter()
        for _ in range(count):
            call()
        rounds.append((time.perf_counter() - begin) / count)
    return 1e9 * min(rounds)


@contextmanager
def slave(case: Case) -> Iterator[fmpy.fmi2.FMU2Slave]:
    """An instance through FMPy, started and freed."""
    one = fmpy.fmi2.FMU2Slave(
        guid=case.guid, modelIdentifier=case.library.stem, instanceName="timed",
        unzipDirectory=str(case.resources.parent), libraryPath=str(case.library),
    )  # fmt: skip
    one.instantiate()
    one.setupExperiment(startTime=0.0)
    one.enterInitializationMode()
    one.exitInitializationMode()
    try:
        yield one
    finally:
        one.freeInstance()


def through_fmpy(case: Case) -> dict[str, float]:
    """The same figures (ns) through FMPy."""
    found = {}
    with slave(case) as one:
        if case.empty:
            times = itertools.count()
            found["doStep"] = least(lambda: one.doStep(next(times) * STEP, STEP), 20_000)
        found["getReal"] = least(lambda: one.getReal(case.outputs), 5_000)
        found["state"] = least(lambda: _keep(one), 200)

    def instantiate() -> None:
        with slave(case):
            pass

    found["instantiate"] = least(instantiate, 5)
    return found


def _keep(one: fmpy.fmi2.FMU2Slave) -> None:
    state = one.getFMUState()
    one.setFMUState(state)
    one.freeFMUState(state)


def host_program(folder: Path) -> Path:
    """Compile the host in C into ``folder``."""
    program = folder / "host"
    command = ["cc", "-O2", f"-I{headers()}", *HOST, "-o", str(program), "-ldl", "-lpthread", "-lm"]
    subprocess.run(command, check=True)
    return program


def rows(quick: bool) -> list[list[str]]:
    """One row per FMU and host; the reason alone where no library can be built."""
    platform = host()
    if platform is None:
        return [["none: no library can be built for this machine", *[""] * (len(COLUMNS) - 1)]]
    compiler = compiler_for(platform)
    found = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = host_program(folder)
        cases = list(compiled(folder, platform, compiler))
        if not quick:
            cases += [packed(folder, "7003C-spindle", "native", sounding) for sounding in (False, True)]
        cases.append(packed(folder, "7003C-spindle", "python", False))
        minimal: dict[str, float] = {}
        for case in cases:
            hosts = {
                "C": lambda case=case: through_c(program, case),
                "FMPy": lambda case=case: through_fmpy(case),
            }
            if case.name.startswith("python"):
                del hosts["C"]  # it needs a Python library in the process
            for host_name, measure in hosts.items():
                figures = measure()
                if case.empty:
                    minimal.setdefault(host_name, figures["doStep"])
                found.append(_cells(case, host_name, figures, minimal[host_name]))
    return found


def _cells(case: Case, host_name: str, figures: dict[str, float], minimal: float) -> list[str]:
    verdicts = []
    step = figures.get("doStep", 0.0) if case.empty else 0.0
    native = case.name.startswith("native")
    if native and case.empty:
        verdicts.append(f"step <= {OVERHEAD_GOAL} x: {_verdict(step <= OVERHEAD_GOAL * minimal)}")
    if native and not case.empty and "threads" in figures:
        verdicts.append(f"threads >= {THREADS_GOAL}: {_verdict(figures['threads'] >= THREADS_GOAL)}")
        verdicts.append(
            f"< {INSTANTIATE_GOAL:g} ms: {_verdict(1e-6 * figures['instantiate'] < INSTANTIATE_GOAL)}"
        )
    return [
        case.name, host_name,
        f"{step:.1f}" if step else "", f"{step / minimal:.2f}" if step else "",
        f"{figures['getReal']:.0f}", f"{1e-3 * figures['state']:.2f}", f"{1e-6 * figures['instantiate']:.3f}",
        f"{figures['threads']:.2f}" if "threads" in figures else "", "; ".join(verdicts),
    ]  # fmt: skip


def _verdict(met: bool) -> str:
    return "met" if met else "missed"
