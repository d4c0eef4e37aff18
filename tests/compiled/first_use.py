"""Wheels as a user meets them: their size, what pip makes of them, and a first use that compiles nothing.

``python -m tests.compiled.first_use FOLDER`` (`make wheel-check`) looks into every wheel of a folder, lets
pip install the one for this machine into a new environment, and runs the README's commands there without a
compiler or any other program. It needs Python alone, because it runs on machines that have nothing else.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import venv
import zipfile
from pathlib import Path

from tests.blocks import blocks, commands

ROOT = Path(__file__).parents[2]
PACKAGE = "fmu-bearing"
INSIDE = "fmu_bearing/compiled/prebuilt/"
#: Bytes of a wheel.
LARGEST = 11_000_000
#: CPU s of the first `simulate` of a fresh scene on a machine that does nothing else.
GOAL = 5.0
#: Beside other work a processor shares clock and caches; compiling the kernels would take 90 s.
CROWDED = 3.0
_TIMEOUT = 900  # s


class Problem(Exception):
    """What is wrong with a wheel."""


def look_into(wheel):
    """Return the size of a wheel (bytes).

    Raises
    ------
    Problem
        If it is too large, or type checkers would take it for untyped.
    """
    size = wheel.stat().st_size
    if size >= LARGEST:
        raise Problem(f"{wheel.name} has {size / 1e6:.2f} MB: it must have less than {LARGEST / 1e6:g} MB")
    with zipfile.ZipFile(wheel) as archive:
        if "fmu_bearing/py.typed" not in archive.namelist():
            raise Problem(f"{wheel.name} has no fmu_bearing/py.typed")
    return size


def environment(folder):
    """Make a new environment with pip and return its Python."""
    venv.create(folder, with_pip=True)
    return folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def pip(python, *words):
    """Run pip of an environment."""
    command = [python, "-m", "pip", "--quiet", "--disable-pip-version-check", *words]
    subprocess.run(command, check=True, timeout=_TIMEOUT)


def install(python, wheels):
    """Install the wheel of a folder that pip takes for this machine, then all that it needs, as wheels."""
    pip(python, "install", "--no-index", "--no-deps", "--find-links", wheels, PACKAGE)
    pip(python, "install", "--only-binary", ":all:", "--constraint", ROOT / "constraints.txt", PACKAGE)
    pip(python, "check")


def first_use(python, folder):
    """Use a wheel that an environment holds as the README does, and its FMU in FMPy.

    Parameters
    ----------
    python : Path
        Of the environment.
    folder : Path
        An empty one; the user's home, cache and scenes.

    Returns
    -------
    dict of str to float
        CPU s of each command, 0 where the system does not count those of other processes.

    Raises
    ------
    Problem
        If the wheel brought no kernels, anything was compiled, or a command failed.
    """
    alone = _alone(folder)
    where = "import fmu_bearing.compiled; print(fmu_bearing.compiled.__file__)"
    brought = Path(_run([python, "-c", where], alone, folder).strip()).with_name("prebuilt")
    if not (brought / "about.txt").exists():
        raise Problem(f"the wheel that pip took has no kernels in {brought}: it is not one for this machine")
    program = python.with_name("fmu-bearing.exe" if os.name == "nt" else "fmu-bearing")
    seconds = {}
    for words in readme():
        begin = _spent()
        _run([program, *words], alone, folder)
        seconds[" ".join(words)] = _spent() - begin
    _run([python, Path(__file__).with_name("in_fmpy.py"), folder / "my.fmu"], alone, folder)
    if compiled := sorted((folder / "cache").glob("compiled-*")):
        raise Problem(f"kernels were compiled: {compiled[0]}")
    with zipfile.ZipFile(folder / "my.fmu") as fmu:
        libraries = [fmu.read(name) for name in fmu.namelist() if name.startswith("binaries/")]
    if [one for one in libraries if one not in [path.read_bytes() for path in brought.iterdir()]]:
        raise Problem("the library in the FMU is not the one of the wheel")
    return seconds


def readme():
    """Arguments of the README's commands, in its order but for the run, which goes before what needs none."""
    every = [commands(text) for language, _, text in blocks(ROOT / "README.md") if language == "sh"]
    first, *more = [words[1:] for block in every for words in block if words[0] == "fmu-bearing"]
    return [first, *sorted(more, key=lambda words: words[0] != "simulate")]


def _alone(folder):
    """Variables of a shell that finds no program and no file of the user's."""
    found = {"PATH": "", "CC": "", "HOME": str(folder), "USERPROFILE": str(folder)}
    if os.name == "nt":  # which Python and the system's own libraries need
        found |= {name: os.environ[name] for name in ("SYSTEMROOT", "TEMP", "TMP") if name in os.environ}
    return found | {"FMU_BEARING_CACHE": str(folder / "cache"), "PYTHONUTF8": "1"}


def _run(command, variables, folder):
    """Return what a command prints on standard output."""
    done = subprocess.run(
        command, env=variables, cwd=folder, capture_output=True, text=True, encoding="utf-8", timeout=_TIMEOUT
    )
    if done.returncode != 0:
        raise Problem(f"{' '.join(map(str, command))} ended with code {done.returncode}:\n{done.stderr}")
    if "compiling" in done.stderr:
        raise Problem(f"{' '.join(map(str, command))} compiled:\n{done.stderr}")
    return done.stdout


def _spent():
    """CPU s of all processes that ended."""
    times = os.times()
    return times.children_user + times.children_system


def on_time(seconds):
    """Raise a `Problem` where the first `simulate` took longer than a machine beside other work needs."""
    (late,) = (one for name, one in seconds.items() if name.startswith("simulate"))
    if late > CROWDED * GOAL:
        raise Problem(f"the first simulate took {late:.1f} CPU s, the goal is {GOAL:g}")


def main():
    """Check the wheels of a folder."""
    wheels = sorted(Path(sys.argv[1]).resolve().glob("*.whl"))
    if not wheels:
        sys.exit(f"error: there is no wheel in {sys.argv[1]}: make wheels")
    folder = Path(tempfile.mkdtemp(prefix="first-use-"))
    try:
        for wheel in wheels:
            print(f"{wheel.name}: {look_into(wheel) / 1e6:.2f} MB")
        python = environment(folder / "environment")
        install(python, wheels[0].parent)
        (folder / "home").mkdir()
        seconds = first_use(python, folder / "home")
        for name, spent in seconds.items():
            print(f"{spent:5.1f} CPU s  fmu-bearing {name}")
        on_time(seconds)
        print("the FMU ran in FMPy, and its states went on with equal bits; nothing was compiled")
    except Problem as problem:
        sys.exit(f"error: {problem}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
