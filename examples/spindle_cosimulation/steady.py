"""Steady temperatures of a scene's bearings without a run: as much heat leaves as arises.

The network of ``thermal.py`` at rest takes the heat of the scene's operating point, and gives temperatures at
which the operating point is computed again, until nothing changes. ``thermal.py`` says what its numbers for
the 7003C and its surroundings rest on; change them there.

    python examples/spindle_cosimulation/steady.py examples/scenes/7003C-spindle.toml mounting.preload_N=150
"""

import sys
from collections.abc import Sequence

import numpy as np
from thermal import AMBIENT, CONDUCTANCES, IN_BEARING, SHAFT_CONDUCTANCES

from fmu_bearing import Scene, operating_point, read_scene
from fmu_bearing.design.heat import Heat, heat_table
from fmu_bearing.design.operating_point import OperatingPoint
from fmu_bearing.design.verdict import shown_hours
from fmu_bearing.results.table import show

KELVIN = 273.15
HOTTEST = 150.0  # degC: beyond it steel loses hardness and oil its film, and no answer is worth more steps
_ENOUGH, _MOST = 0.01, 60  # K between two rounds, rounds
_SHARE = 0.6  # of the way to new temperatures: warmer oil makes less heat, so the whole way goes beyond
#: Lump -> degC, by bearing (1, 2, ...); 0 for housing and shaft.
Temperatures = dict[tuple[int, str], float]


def network(heats: Sequence[Heat]) -> Temperatures:
    """Return the temperatures at which the network gives off these heats (W)."""
    one = len(heats) == 1
    links = dict(CONDUCTANCES)
    if not one:
        del links["inner_ring", "ambient"]
        links |= SHAFT_CONDUCTANCES
    lumps = [(k, kind) for k in range(1, len(heats) + 1) for kind in IN_BEARING]
    lumps += [(0, "housing")] + ([] if one else [(0, "shaft")])
    place = {lump: k for k, lump in enumerate(lumps)}
    matrix, right = np.zeros((len(lumps), len(lumps))), np.zeros(len(lumps))
    for (first, second), conductance in links.items():
        for lump in (lump for lump in lumps if lump[1] == first):
            i = place[lump]
            matrix[i, i] += conductance
            if second == "ambient":
                continue
            j = place[(lump[0] if second in IN_BEARING else 0, second)]
            matrix[j, j] += conductance
            matrix[i, j] -= conductance
            matrix[j, i] -= conductance
    for k, heat in enumerate(heats, start=1):
        for kind in ("inner_ring", "outer_ring", "oil"):
            right[place[k, kind]] = getattr(heat, kind)
    rises = np.linalg.solve(matrix, right)
    return {lump: AMBIENT - KELVIN + float(rises[k]) for lump, k in place.items()}


def at(scene: Scene, found: Temperatures) -> Scene:
    """Return the scene at these temperatures."""
    numbers = sorted({number for number, _ in found if number})
    oil = float(np.mean([found[number, "oil"] for number in numbers]))
    values = {"operation.oil_temperature_degC": oil}
    for number in numbers:
        table = "operation" if scene.spindle is None else f"spindle.bearing[{number}]"
        for ring in ("inner_ring", "outer_ring"):
            values[f"{table}.{ring}_temperature_degC"] = found[number, ring]
    if scene.spindle is not None:
        values["spindle.shaft.temperature_degC"] = found[0, "shaft"]
        values["spindle.housing.temperature_degC"] = found[0, "housing"]
    return scene.replace(values)


def steady(scene: Scene) -> tuple[Temperatures, OperatingPoint]:
    """Return the temperatures (degC) at which the scene stays, and its operating point there.

    Raises
    ------
    ValueError
        Where a lump passes `HOTTEST`, or temperatures do not settle: spacers that are pressed together by a
        warm shaft may have no steady state.
    """
    point = operating_point(scene)
    found = network([one.heat for one in point.bearings])
    for _ in range(_MOST):
        if max(found.values()) > HOTTEST:
            break
        point = operating_point(at(scene, found))
        new = network([one.heat for one in point.bearings])
        if max(abs(new[lump] - found[lump]) for lump in found) < _ENOUGH:
            return found, point
        found = {lump: (1.0 - _SHARE) * found[lump] + _SHARE * new[lump] for lump in found}
    hottest = max(found, key=lambda lump: found[lump])
    raise ValueError(
        f"no steady temperature: {hottest[1]} of bearing {hottest[0]} reaches {found[hottest]:.0f} degC"
    )


def main(path: str, *settings: str) -> None:
    """Print temperatures, torque and heat, and what of the operating point depends on them."""
    pairs = (setting.split("=") for setting in settings)
    found, point = steady(read_scene(path).replace({key: float(value) for key, value in pairs}))
    places = ["spindle", *(f"bearing {k}" for k in range(1, len(point.bearings) + 1))]
    show(
        "steady temperatures",
        ("", "degC"),
        [
            [f"{places[number]}: {kind.replace('_', ' ')}", f"{value:.1f}"]
            for (number, kind), value in found.items()
        ],
    )
    show("friction and heat at them", *heat_table(point.bearings))
    rows = [
        [
            place,
            f"{one.axial:.0f}",
            f"{one.viscosity_ratio:.2f}",
            "none" if one.life is None else shown_hours(one.life),
        ]
        for place, one in zip(places[1:], point.bearings, strict=True)
    ]
    show("what depends on them", ("", "axial load, N", "viscosity ratio", "L10r, h"), rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
