"""What each thing of a scene costs, and what leaving it out saves: ``python -m benchmarks.costs [FILE]``.

The example spindle, silent, with one thing changed at a time, then with sound. Variants take turns, so that
what else the machine does falls on all of them.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

from fmu_bearing import Scene, read_scene, with_fidelity
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.prepare.sound_block import Sounds
from fmu_bearing.results.table import machine, markdown, number, write_csv
from fmu_bearing.run.paces import speed
from fmu_bearing.run.settings import TERMS, Setting

COLUMNS = ("variant", *(f"{name}{of}" for name in FIDELITIES for of in (", us", ", of the whole")))
_EXAMPLES = Path(__file__).parents[1] / "examples"
_WHOLE = "whole scene, silent"
_BENDING = {  # orders as in the 7009C's scenes; stiffness of the loose seats assumed
    "outer_ring": [2, 3, 4, 5],
    "inner_ring": [2, 3],
    "outer_seat_stiffness_N_m": 1e8,
    "inner_seat_stiffness_N_m": 1e8,
}
_BUDGET, _TURNS = 0.2, 3  # s of each timed run


def variants() -> Iterator[tuple[str, Scene]]:
    """Yield name and scene."""
    sounding = read_scene(_EXAMPLES / "scenes" / "7003C-spindle.toml")
    assert sounding.sound is not None
    scene = sounding.replace({"sound": None})
    smooth, alone = {"imperfections": None}, {"bearing.cage": None}
    yield _WHOLE, scene
    yield "6 balls in place of 12", scene.replace({"bearing.ball_count": 6})
    yield "no cage", scene.replace(alone)
    yield "perfect surfaces and balls", scene.replace(smooth)
    yield "neither cage nor imperfections", scene.replace(smooth | alone)
    longest = {"fidelity.max_internal_step_us": 100.0}
    yield "the same, steps up to 100 us", scene.replace(smooth | alone | longest)
    yield "1 strip in place of 5", with_fidelity(scene, traction_strips=1)
    yield "all terms left out that can be", Setting(without=TERMS).scene(scene)
    yield "6 modes of bending rings", scene.replace({"mounting.flexure": _BENDING})
    yield "two bearings, DB", read_scene(_EXAMPLES / "spindle_set" / "7003C-DB.toml").replace({"sound": None})
    places = sounding.model_dump()["sound"]["microphone"]
    for count in (1, len(places)):
        yield f"{count} microphone{'s' * (count > 1)}", sounding.replace({"sound.microphone": places[:count]})
    yield f"{len(places)} with third octaves", sounding.replace({"sound.third_octaves": True})


def rows(turns: int = _TURNS, budget: float = _BUDGET) -> list[list[str]]:
    """Return the rows of the table: us of the processor per simulated ms, constant inputs, steps of 1 ms."""
    bearings: dict[tuple[str, str], Arrays] = {}
    names = []
    for name, scene in variants():
        names.append(name)
        for fidelity in FIDELITIES:
            if Setting(fidelity).carries(scene):
                of = with_fidelity(scene, model=fidelity)
                made = Arrays.of(of, *(Sounds(of).at(fidelity) if of.sound is not None else ()))
                made.init()
                made.run(0.05, 1e-3)
                bearings[name, fidelity] = made
    cost = dict.fromkeys(bearings, float("inf"))
    for _ in range(turns):
        for key, bearing in bearings.items():
            cost[key] = min(cost[key], 1e3 / speed(bearing, budget, 1, 1.0)[1])
    found = []
    for name in names:
        cells = [name]
        for fidelity in FIDELITIES:
            us = cost.get((name, fidelity))
            cells += ["", ""] if us is None else [number(us), f"{us / cost[_WHOLE, fidelity]:.2f}"]
        found.append(cells)
    return found


def main() -> None:
    """Print the table; write it to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("file", nargs="?", type=Path, help="where to write the table, .md and .csv")
    given = parser.parse_args()
    found = rows()
    text = markdown(COLUMNS, found)
    print(text)
    if given.file is not None:
        head = (
            f"# What each thing costs\n\n{machine()}\n\nMade by `python -m benchmarks.costs`: the 7003C in "
            "its spindle at 20,000 r/min with one thing changed,\nus of the processor per simulated ms with "
            "constant inputs, in steps of 1 ms, best of three.\n\n"
        )
        given.file.with_suffix(".md").write_text(head + text, encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, found)


if __name__ == "__main__":
    main()
