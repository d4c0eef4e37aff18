"""Bytes of one running instance."""

import tracemalloc

from benchmarks.cases import GATES, silent
from fmu_bearing.engine.layout import W
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

COLUMNS = ("scene", "radiator", "parameters", "state", "work space", "in all", "goal", "verdict")
GOAL = 3e6


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
            sizes = [instance.p.nbytes, instance.s.nbytes, 8 * W.size(instance.p)]
            verdict = "met" if total < GOAL else "missed"
            found.append(
                [name, radiator, *(f"{size / 1e3:.0f} kB" for size in sizes), f"{total / 1e6:.2f} MB",
                 f"< {GOAL / 1e6:g} MB", verdict]
            )  # fmt: skip
    return found
