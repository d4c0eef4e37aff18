"""Cost of sound: CPU seconds per simulated second, by radiation model and number of microphones."""

import time

import numpy as np

from benchmarks.cases import GATES
from fmu_bearing.acoustics.filters.design import block_of, radiation_of
from fmu_bearing.acoustics.registry import Radiation
from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import MO, SD, Z
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.sound import cylindrical

COLUMNS = (
    "scene", "microphones", "radiation model", "channels", "blocks", "CPU s per s", "each more, ms per s",
    "direct form", "goal", "verdict",
)  # fmt: skip
GOAL = 0.1  # s per simulated s, four microphones
_BATCH = 8192  # motion samples: 40 ms
_ROWS = 32  # of them differ: few, because a run's sample has just been made and is still at hand


def cost(ps, repeats: int) -> float:
    """CPU s per simulated s of one sound block."""
    motion = np.random.default_rng(1).standard_normal((_ROWS, MO.SIZE))
    ss, ws = np.zeros(SD.state_size(ps)), np.zeros(SD.work_size(ps))
    mics = int(ps[SD.H_MICS])
    numbers = len(Z.MIC_OUTPUTS) + int(ps[SD.H_BANDS])
    z = np.zeros(mics * numbers)
    arguments = ps, ss, ws, motion, z, np.empty(0), _BATCH, MO.SIZE, 0.125, 0.0, mics, numbers, 0
    call("play", *arguments)  # past the start
    best = float("inf")
    for _ in range(repeats):
        clock = time.process_time()
        call("play", *arguments)
        best = min(best, time.process_time() - clock)
    return best * SD.RAW_RATE / _BATCH


def microphones(scene) -> dict[str, list[tuple[float, float, float]]]:
    """Sets of microphones: one and all of four, the scene's or a paper's; circles of 24 and 360."""
    four = [(0.0, 0.105, 0.0), (0.0, 0.150, 0.0), (0.0, 0.0, 0.105), (-0.0805, 0.0, 0.0)]
    own = [place for _, place in scene.microphones]
    circles = {
        f"circle of {count}": [cylindrical(360.0 * k / count, 210.0, 50.0) for k in range(count)]
        for count in (24, 360)
    }
    all_four = own if len(own) == 4 else four
    return {"1": all_four[:1], "4": all_four, **circles}


def block_lengths(ps) -> str:
    """Block lengths of the convolution, as text."""
    first = int(ps[SD.H_AT_SPANS]) + SD.SPAN_BLOCK
    lengths = [f"{ps[first + SD.SPAN_SIZE * i]:g}" for i in range(int(ps[SD.H_SPANS]))]
    return " + ".join(lengths) or "none"


def rows(name: str, models: tuple[str, ...], repeats: int) -> list[list[str]]:
    """One row per radiation model and set of microphones of a scene."""
    scene = read_scene(GATES / f"{name}.toml")
    given = radiation_of(scene)
    found = []
    one: dict[str, float] = {}
    for words, points in microphones(scene).items():
        for radiation_model in models:
            made = Radiation(radiation_model, given.radiators, given.air, given.harmonics)
            block, direct = (
                block_of(made, points, details=True, thirds=False, lengths=lengths) for lengths in (None, ())
            )
            here = cost(block, repeats)
            one.setdefault(radiation_model, here)
            more = f"{1e3 * (here - one[radiation_model]) / (len(points) - 1):.1f}" if len(points) > 1 else ""
            goal = words == "4"
            verdict = "" if not goal else "met" if here <= GOAL else "missed"
            found.append(
                [name, words, radiation_model, f"{block[SD.H_CHANNELS]:.0f}", block_lengths(block),
                 f"{here:.3f}", more, f"{cost(direct, repeats):.3f}", f"{GOAL:g}" if goal else "", verdict]
            )  # fmt: skip
    return found
