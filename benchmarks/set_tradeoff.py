"""Accuracy and cost of sets, and what `auto` chooses: ``python -m benchmarks.set_tradeoff [FOLDER]``.

The example pair and motor spindle with tolerance class P4 and three microphones round the bare bearings, each
in every setting of ``fmu-bearing tradeoff``. The choice of ``fmu-bearing choose`` for the same scene stands
below each table.
"""

import argparse
import pathlib

from fmu_bearing.accuracy.tradeoff import SETTINGS, tradeoff
from fmu_bearing.results.table import markdown, write_csv
from fmu_bearing.run.choose import choose
from fmu_bearing.scene import Scene, read_scene

_EXAMPLES = pathlib.Path(__file__).parents[1] / "examples" / "spindle_set"
#: mm: ahead of the nose, and beside the first and the last bearing.
_BESIDE = 105.0
SETS = ("DB", "QBC")


def sounding(name: str) -> Scene:
    """Return an example set with surfaces of class P4 and microphones round its bare bearings."""
    scene = read_scene(_EXAMPLES / f"7003C-{name}.toml")
    places = [one.position_mm for one in scene.spindle.bearing] if scene.spindle is not None else []
    microphones = [
        {"name": "front", "x_mm": -100.0, "y_mm": 0.0, "z_mm": 0.0},
        {"name": "first", "x_mm": places[0], "y_mm": _BESIDE, "z_mm": 0.0},
        {"name": "last", "x_mm": places[-1], "y_mm": _BESIDE, "z_mm": 0.0},
    ]
    return scene.replace(
        {"imperfections": {"grade": "P4", "seed": 1}}
        | {"sound": {"radiation_model": "compact", "microphone": microphones}}
    )


def write(name: str, folder: pathlib.Path) -> None:
    """Measure a set and write its page and table."""
    scene = sounding(name)
    study = tradeoff(scene, SETTINGS)
    choice = choose(scene)
    page = study.markdown().replace("Made by `fmu-bearing tradeoff`", "Made by `benchmarks.set_tradeoff`")
    page += f"\n## What `auto` chooses\n\n{choice.words()}.\n\n{markdown(*choice.table())}"
    stem = f"tradeoff_{name.lower()}"
    (folder / f"{stem}.md").write_text(page, "utf-8")
    write_csv(folder / f"{stem}.csv", *study.table())


def main() -> None:
    """Measure both sets."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path("docs/results"))
    folder = options.parse_args().folder
    for name in SETS:
        write(name, folder)


if __name__ == "__main__":
    main()
