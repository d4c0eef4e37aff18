"""The toy model: its file, its library, and a master that calls the library as C does."""

import hashlib
import importlib.util
import os
import platform
import subprocess
from dataclasses import replace
from pathlib import Path

from fmu_bearing.fmi.native.model_file import Caution, Contents, contents_bytes
from fmu_bearing.interface import Variable

HERE = Path(__file__).parent
#: Sources of the host in C.
HOST = tuple(str(HERE / name) for name in ("host.c", "host_times.c"))
SHIM = HERE.parents[1] / "fmu_bearing" / "fmi" / "native" / "shim"
HEADERS = Path(importlib.util.find_spec("fmpy").origin).parent / "c-code"
KERNELS = hashlib.sha256(b"toy kernels").hexdigest()
GUID = "{11111111-2222-3333-4444-555555555555}"
IS_X86 = platform.machine() in ("x86_64", "AMD64")
WARNINGS = ("-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror")


def _input(name, index, start, low, high, unit=""):
    return Variable(
        name, "input", "continuous", name, unit=unit, min=low, max=high, start=start, array="u", index=index
    )


def _parameter(name, index, start, low, high):
    return Variable(name, "parameter", "fixed", name, min=low, max=high, start=start, array="p", index=index)


def _shown(name, index, causality="output", kind="Real"):
    return Variable(name, causality, "continuous", name, type=kind, array="z", index=index)


VARIABLES = (
    _input("speed", 0, 3.0, -100.0, 100.0, "rad/s"),
    _input("load", 1, 50.0, 0.0, 1e4, "N"),
    _input("trouble", 2, 0.0, 0.0, 99.0),
    _input("no_start", 3, 0.0, 0.0, 99.0),
    _shown("angle", 0),
    _shown("load_held", 1),
    _shown("steps", 2, "local", "Integer"),
    _shown("mark", 3, "local", "Integer"),
    _shown("margin", 4, "local"),
    _shown("speed_reached", 5),
    _shown("sizes", 6, "local"),
    _parameter("tolerance", 0, 1e-3, 1e-6, 0.1),
    _parameter("gain", 1, 1.0, 0.0, 10.0),
    Variable("fixed_real", "local", "constant", "constant", value=2.5),
    Variable("fixed_whole", "local", "constant", "constant", type="Integer", value=7),
    Variable("fixed_text", "local", "constant", "constant", type="String", value="grün"),
    Variable("fixed_truth", "local", "constant", "constant", type="Boolean", value=1),
)
REFERENCES = {variable.name: reference for reference, variable in enumerate(VARIABLES)}
CONTENTS = Contents(
    guid=GUID,
    kernels=KERNELS,
    fingerprint=hashlib.sha256(b"toy").hexdigest(),
    parameters=[1e-3, 1.0, 42.0],
    inputs=[3.0, 50.0, 0.0, 0.0],
    state_size=5,
    output_size=7,
    work_size=2,
    time=1,
    tunables=2,
    variables=VARIABLES,
    ramped=0,
    reasons={1: "it did not converge", 4: "there is no equilibrium"},
    cautions=(
        Caution(4, 0.0, -2.0, "the margin is short by ", " half newtons"),
        Caution(1, 0.5, 1.0, "the load is ", " N", decimals=0, array="u"),
    ),
)


def write_model(folder, **changes):
    """Write the toy's model.bin, and return the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "model.bin").write_bytes(contents_bytes(replace(CONTENTS, **changes)))
    return folder


def compile_library(folder, *options, compiler=("cc",), suffix=".so", objects=()):
    """Compile shim and toy kernels into a library; ``TOY_FLAGS`` of the environment are added."""
    folder.mkdir(parents=True, exist_ok=True)
    flags = ["-O2", "-fPIC", "-fvisibility=hidden", f"-I{HEADERS}", f'-DFB_KERNELS="{KERNELS}"', *options]
    flags += os.environ.get("TOY_FLAGS", "").split()
    sets = {"v2": 2, "v3": 3} if IS_X86 else {"base": 0}
    kernels = []
    for isa, mark in sets.items():
        kernels.append(folder / f"toy_{isa}.o")
        source = [str(HERE / "toy_kernel.c"), f"-DISA={isa}", f"-DMARK={mark}.0"]
        run([*compiler, *WARNINGS, *flags, "-c", *source, "-o", str(kernels[-1])])
    flags += ["-DFB_X86"] if IS_X86 else []
    library = folder / f"Toy{suffix}"
    sources = sorted(map(str, SHIM.glob("*.c")))
    inputs = [*sources, *map(str, kernels), *objects]
    run([*compiler, *WARNINGS, *flags, "-shared", *inputs, "-o", str(library), "-lm"])
    return library


def run(command):
    """Run a compiler, and show what it says if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
