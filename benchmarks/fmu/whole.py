"""Speed of one scene through the library, an FMU in a host in C, and the same FMU in FMPy."""

import functools
import subprocess
import tempfile
import time
from pathlib import Path

from benchmarks.cases import GATES, WARM_UP, silent
from benchmarks.fmu.calls import Case, host_program, packed, slave
from fmu_bearing.arrays import Arrays
from fmu_bearing.compiled.platforms import host
from fmu_bearing.prepare.sound_block import sound_block
from fmu_bearing.scene import read_scene

COLUMNS = ("scene", "sound", "through", "sim/wall", "of the library")
SCENE = "7003C-spindle"
STEP = 1e-3  # s
_ROUNDS = 5  # the host in C has as many
_TURNS = 4  # the ways take turns: a virtual machine is slower by a fifth for seconds at a time


def _best(step, count: int) -> float:
    """Simulated s per wall s, best of the rounds."""
    rounds = []
    for _ in range(_ROUNDS):
        begin = time.perf_counter()
        for _ in range(count):
            step()
        rounds.append(time.perf_counter() - begin)
    return count * STEP / min(rounds)


def through_library(sounding: bool, count: int) -> float:
    """Speed of the arrays that Python holds."""
    scene = read_scene(GATES / f"{SCENE}.toml") if sounding else silent(SCENE)
    bearing = Arrays.of(scene, *([sound_block(scene)] if sounding else []))
    bearing.init()
    bearing.run(WARM_UP, STEP)
    return _best(lambda: bearing.step(STEP), count)


def through_c(program: Path, case: Case, count: int) -> float:
    """Speed of the FMU in the host in C."""
    arguments = [str(case.library), case.guid, case.resources.as_uri()]
    commands = ["start:0", f"step:{STEP}:{round(WARM_UP / STEP)}", f"time-step:{STEP}:{count}"]
    ran = subprocess.run([str(program), *arguments, *commands], capture_output=True, text=True, check=True)
    (nanoseconds,) = (float(line.split()[1]) for line in ran.stdout.splitlines() if line.startswith("doStep"))
    return STEP / (1e-9 * nanoseconds)


def through_fmpy(case: Case, count: int) -> float:
    """Speed of the FMU in FMPy."""
    with slave(case) as one:
        steps = 0

        def step() -> None:
            nonlocal steps
            one.doStep(steps * STEP, STEP)
            steps += 1

        for _ in range(round(WARM_UP / STEP)):
            step()
        return _best(step, count)


def rows(quick: bool) -> list[list[str]]:
    """One row per way to run the scene; the library alone where no FMU can be built."""
    count = 20 if quick else 200
    found = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for sounding in (False,) if quick else (False, True):
            ways = {"library, Python": functools.partial(through_library, sounding, count)}
            if host() is not None:
                case = packed(folder, SCENE, "native", sounding)
                ways["FMU, host in C"] = functools.partial(through_c, host_program(folder), case, count)
                ways["FMU, FMPy"] = functools.partial(through_fmpy, case, count)
            speeds = dict.fromkeys(ways, 0.0)
            for _ in range(1 if quick else _TURNS):
                for words, way in ways.items():
                    speeds[words] = max(speeds[words], way())
            own = speeds["library, Python"]
            for words, speed in speeds.items():
                sound = "four microphones" if sounding else "none"
                found.append([SCENE, sound, words, f"{speed:.2f}", f"{speed / own:.2f}"])
    return found
