"""Bytes of one running instance."""

import tracemalloc

import numpy as np

from benchmarks.cases import GATES, silent
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

COLUMNS = ("scene", "radiator", "parameters", "state", "work space", "in all", "goal", "verdict")
GOAL = 5e6


def rows(names: tuple[str, ...]) -> list[list[str]]:
    """One row per scene, without and with its sound: bytes of arrays, and all that Python allocated."""
    found = []
    for name in names:
        for radiator, scene in (("none", silent(name)), ("with sound", read_scene(GATES / f"{name}.toml"))):
            model = prepare(scene)
            tracemalloc.start()
            instance = Instance(model)
            total = tracemalloc.get_traced_memory()[0]
            tracemalloc.stop()
            arrays: tuple[np.ndarray, ...] = (instance.p, instance.s, instance._w)
            sizes = [array.nbytes for array in arrays]
            goal = GOAL if radiator == "none" else 0.0
            verdict = "" if not goal else ("met" if total < goal else "missed")
            found.append(
                [name, radiator, *(f"{size / 1e3:.0f} kB" for size in sizes), f"{total / 1e6:.2f} MB",
                 "< 5 MB" if goal else "", verdict]
            )  # fmt: skip
    return found
