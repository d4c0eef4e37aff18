"""Steady temperatures of a scene's bearings without a run: as much heat leaves as arises.

Each bearing has three nodes: inner ring, outer ring, oil; the balls, which take no heat of their own, are
eliminated. A housing takes the heat of the outer rings, in a set a shaft that of the inner ones. Conductances
are those of a 7003C in a spindle with oil-air and cooling water (the thermal network of the examples), scaled
to the size and the materials of the bearing. All of them are assumed.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fmu_bearing.design.heat import Heat, heat_of
from fmu_bearing.engine.constants import RPM
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import exclusion, require
from fmu_bearing.scene.member import still_of
from fmu_bearing.steady.rest import started

AMBIENT = 22.0  # degC: a laboratory, assumed
#: degC: beyond it steel loses hardness and oil its film, and no answer is worth more steps.
HOTTEST = 150.0
#: K: by so much warmer a spindle oil has about half the viscosity, and film, torque and heat are others.
HALVES = 20.0
FACTOR = 2.0  # by which conductances may be off, either way: assumed
_ENOUGH, _MOST = 1e-3, 60  # K between two rounds, rounds
_SHARE = 0.6  # of the way to new temperatures: warmer oil makes less heat, so the whole way goes beyond
_NODES = ("inner_ring", "outer_ring", "oil")
#: Of the 7003C: number of balls; ball, inner and outer race, width, bore, outside and pitch diameter, mm.
_BALLS, _BALL, _INNER, _OUTER, _WIDTH, _BORE, _OUTSIDE, _PITCH = 12, 4.5, 22.6, 29.6, 10.0, 17.0, 35.0, 26.0
_CONDUCTION = 32.0  # W/(m K): harmonic mean of steel and silicon nitride
_STEEL = 46.0  # W/(m K): of a material that gives no conductivity
#: W/K that the supply takes from a 7003C: half of 4.84 m3/h of air; half a litre of oil a minute; nothing.
_FLOWS = {"oil-air": 0.81, "jet": 14.0, "bath": 1.0, "grease": 0.0}


class Conductance(NamedTuple):
    """What flows between two places per kelvin (W/K), and what it rests on."""

    one: str
    other: str
    value: float
    rule: str


@dataclass(frozen=True)
class Temperatures(Result):
    """Steady temperatures of a scene's bearings."""

    quantities = (
        "ambient_degC", Quantity("degC", of=lambda one: _named(one.places)),
        Quantity("low_degC", of=lambda one: _named(one.low)),
        Quantity("high_degC", of=lambda one: _named(one.high)), "heat_W = heats",
        Quantity("conductances_W_K", of=lambda found: {f"{a}-{b}": v for a, b, v, _ in found.conductances}),
    )  # fmt: skip

    scene: Scene
    """At these temperatures."""
    ambient: float
    """degC."""
    places: dict[tuple[int, str], float]
    """degC by bearing (1, 2, ...) and node: ``inner_ring``, ``outer_ring``, ``oil``; 0 with ``housing`` and,
    of a set, ``shaft``."""
    low: dict[tuple[int, str], float]
    high: dict[tuple[int, str], float]
    """The same with all conductances `FACTOR` times as large, and as small; ``high`` is empty where there is
    no steady state then."""
    heats: tuple[Heat, ...]
    """Of each bearing at these temperatures."""
    conductances: tuple[Conductance, ...]

    def rows(self) -> tuple[tuple[str, ...], list[list[str]]]:
        """Columns and rows of a table for people."""
        several = len(self.heats) > 1
        rows = []
        for (number, node), value in self.places.items():
            place = f"bearing {number}: " if number and several else ""
            high = f"{self.high[number, node]:.1f}" if self.high else "no steady state"
            low = f"{self.low[number, node]:.1f}"
            rows.append([place + node.replace("_", " "), f"{value:.1f}", low, high])
        return ("", "degC", f"all W/K times {FACTOR:g}", f"all W/K over {FACTOR:g}"), rows

    def rules(self) -> tuple[tuple[str, ...], list[list[str]]]:
        """Columns and rows of the table of conductances."""
        rows = [
            [f"{one.replace('_', ' ')} to {other.replace('_', ' ')}", f"{value:.3g}", rule]
            for one, other, value, rule in self.conductances
        ]
        return ("between", "W/K", "assumed"), rows


def _named(places: dict[tuple[int, str], float]) -> dict[str, float]:
    """Return values by the names of their places."""
    return {
        f"bearing[{number}].{node}" if number else node: value for (number, node), value in places.items()
    }


def temperatures(scene: Scene, ambient: float = AMBIENT, cooling: float | None = None) -> Temperatures:
    """Return the temperatures at which a scene's bearings stay, with a range.

    The network takes the heat of the settled bearings, and gives temperatures at which that heat is computed
    again, until neither changes.

    Parameters
    ----------
    scene : Scene
        Its own temperatures are where the search begins.
    ambient : float
        degC.
    cooling : float, optional
        From the housing to what surrounds it, W/K; default: cooling water by the size, assumed.

    Raises
    ------
    ValueError
        Where a node passes `HOTTEST`, or temperatures do not settle: spacers that are pressed together by a
        warm shaft may have no steady state.
    """
    require(scene, "temperatures")
    scene = still_of(scene)
    links = conductances(scene, cooling)
    places, heats = _settled(scene, links, ambient)
    low, _ = _settled(scene, links, ambient, FACTOR)
    try:
        high, _ = _settled(scene, links, ambient, 1.0 / FACTOR)
    except ValueError:
        high = {}
    return Temperatures(at(scene, places), ambient, places, low, high, heats, links)


def warmer(scene: Scene, heats: Sequence[Heat], keys: Sequence[str]) -> str:
    """Return in words what these heats warm by `HALVES` or more above the scene's temperatures; empty: none.

    The first step of `temperatures`: with assumed conductances, and without the thinner oil's smaller heat.

    Parameters
    ----------
    scene : Scene
    heats : sequence of Heat
        Of each bearing at the scene's temperatures.
    keys : sequence of str
        Temperatures of ``[operation]`` that are looked at, such as ``oil_temperature_degC``.
    """
    if exclusion(scene, "temperatures") is not None:
        return ""
    beyond: dict[str, float] = {}
    for (number, node), value in network(heats, conductances(scene), AMBIENT).items():
        key = f"{node}_temperature_degC"
        if number and key in keys and value >= getattr(scene.operation, key) + HALVES:
            beyond[node] = max(value, beyond.get(node, value))
    each = ", ".join(f"{node.replace('_', ' ')} to {value:.0f}" for node, value in beyond.items())
    return f"{sum(one.total for one in heats):.3g} W would bring {each} degC" if each else ""


def conductances(scene: Scene, cooling: float | None = None) -> tuple[Conductance, ...]:
    """Return the conductances of the network, scaled to the bearings of a scene."""
    b, materials = scene.bearing, scene.materials
    spot = b.ball_count * b.ball_diameter_mm / (_BALLS * _BALL)
    inside, outside = (
        spot * _conduction(ring.conductivity_W_mK, materials.balls.conductivity_W_mK) / _CONDUCTION * 0.12
        for ring in (materials.inner_ring, materials.outer_ring)
    )
    balls = 0.23 * b.ball_count * b.ball_diameter_mm**2 / (_BALLS * _BALL**2)
    whole = inside + outside + balls
    inner = 0.21 * b.inner_ring_outer_diameter_mm * b.width_mm / (_INNER * _WIDTH) + inside * balls / whole
    outer = 0.28 * b.outer_ring_inner_diameter_mm * b.width_mm / (_OUTER * _WIDTH) + outside * balls / whole
    seat = b.bore_mm * b.width_mm / (_BORE * _WIDTH)
    shaft, film = (b.bore_mm / _BORE) ** 2, "300 W/(m2 K), balls and races"
    flow = _FLOWS[scene.lubricant.supply] * b.pitch_diameter_mm / _PITCH
    size = b.outside_diameter_mm * b.width_mm / (_OUTSIDE * _WIDTH)
    water = 20.0 * size if cooling is None else cooling
    links = [
        Conductance(
            "inner_ring", "outer_ring", inside * outside / whole, "spots of contact, through the balls"
        ),
        Conductance("inner_ring", "oil", inner, film),
        Conductance("outer_ring", "oil", outer, film),
        Conductance("outer_ring", "housing", 4.4 * size, "seat, 4000 W/(m2 K)"),
    ]
    if scene.assembly.joined:
        links.append(Conductance("inner_ring", "shaft", 2.7 * seat, "seat, 5000 W/(m2 K)"))
        links.append(Conductance("shaft", "ambient", 0.87 * shaft, "moving air, 100 W/(m2 K)"))
    else:
        away = 1.0 / (1.0 / (2.7 * seat) + 1.0 / (0.73 * shaft)) / _JOINED
        links.append(Conductance("inner_ring", "ambient", away, "seat and shaft in moving air, 100 W/(m2 K)"))
    if flow:
        links.append(Conductance("oil", "ambient", flow, f"flow of the supply ({scene.lubricant.supply})"))
    rule = "cooling water by the size, 1000 W/(m2 K)" if cooling is None else "as given"
    return (*links, Conductance("housing", "ambient", water, rule))


#: Of the reference, 0.57 W/K in two digits where the two in series have 0.5746.
_JOINED = 1.0 / (1.0 / 2.7 + 1.0 / 0.73) / 0.57


def at(scene: Scene, places: dict[tuple[int, str], float]) -> Scene:
    """Return the scene at these temperatures."""
    numbers = sorted({number for number, _ in places if number})
    values = {"operation.oil_temperature_degC": float(np.mean([places[k, "oil"] for k in numbers]))}
    for number in numbers:
        table = scene.assembly.temperature_table(number)
        for ring in ("inner_ring", "outer_ring"):
            values[f"{table}.{ring}_temperature_degC"] = places[number, ring]
    if scene.assembly.joined:
        values["spindle.shaft.temperature_degC"] = places[0, "shaft"]
        values["spindle.housing.temperature_degC"] = places[0, "housing"]
    return scene.replace(values)


def _conduction(ring: float | None, ball: float | None) -> float:
    """Return the harmonic mean of two conductivities, W/(m K)."""
    one, other = ring or _STEEL, ball or _STEEL
    return 2.0 * one * other / (one + other)


def _heats(scene: Scene) -> tuple[Heat, ...]:
    """Return the heat of each settled bearing."""
    settled, speed = started(scene, fidelity="response"), scene.operation.speed_rpm * RPM
    return tuple(
        heat_of(lambda name, prefix=bearing.prefix: settled.get(prefix + name), speed, bearing.scene.bearing)  # type: ignore[misc]
        for bearing in scene.bearings()
    )


def _settled(
    scene: Scene, links: Sequence[Conductance], ambient: float, factor: float = 1.0
) -> tuple[dict[tuple[int, str], float], tuple[Heat, ...]]:
    """Return temperatures (degC) and heats where neither changes; ``factor``: of all conductances."""
    heats = _heats(scene)
    degC = network(heats, links, ambient, factor)
    for _ in range(_MOST):
        if max(degC.values()) > HOTTEST:
            break
        heats = _heats(at(scene, degC))
        new = network(heats, links, ambient, factor)
        if max(abs(new[place] - degC[place]) for place in degC) < _ENOUGH:
            return new, heats
        degC = {place: (1.0 - _SHARE) * degC[place] + _SHARE * new[place] for place in degC}
    number, node = max(degC, key=lambda place: degC[place])
    whose = f" of bearing {number}" if number and len(heats) > 1 else ""
    raise ValueError(
        f"{scene.name}: no steady temperature: {node.replace('_', ' ')}{whose} reaches "
        f"{degC[number, node]:.0f} degC, and {HOTTEST:g} are the limit: lower speed or preload, give "
        "another supply (lubricant.supply), or more cooling (--cooling, W/K)"
    )


def network(
    heats: Sequence[Heat], links: Sequence[Conductance], ambient: float, factor: float = 1.0
) -> dict[tuple[int, str], float]:
    """Return the temperatures (degC) at which a network gives off these heats (W)."""
    shared = [name for name in ("housing", "shaft") if any(name in (link.one, link.other) for link in links)]
    places = [(k, node) for k in range(1, len(heats) + 1) for node in _NODES] + [(0, name) for name in shared]
    at_place = {place: k for k, place in enumerate(places)}
    matrix, right = np.zeros((len(places), len(places))), np.zeros(len(places))
    for one, other, value, _ in links:
        for place in (place for place in places if place[1] == one):
            i = at_place[place]
            matrix[i, i] += factor * value
            if other == "ambient":
                continue
            j = at_place[(place[0] if other in _NODES else 0, other)]
            matrix[j, j] += factor * value
            matrix[i, j] -= factor * value
            matrix[j, i] -= factor * value
    for k, heat in enumerate(heats, start=1):
        for node in _NODES:
            right[at_place[k, node]] = getattr(heat, node)
    rises = np.linalg.solve(matrix, right)
    return {place: ambient + float(rises[k]) for place, k in at_place.items()}
