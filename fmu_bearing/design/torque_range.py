"""The range that a friction torque may have, from the inputs of a scene that few can know.

One input at a time goes to its low and to its high end, and the bearings settle at each. The changes of
torque are added as roots of squares, upwards and downwards apart, as those of inputs that do not depend on
each other. Inputs are the same in all bearings of a set.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.design.measured import Range
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P
from fmu_bearing.instance import EngineError
from fmu_bearing.prepare.model import land_clearance
from fmu_bearing.results.base import Quantity, Result, table
from fmu_bearing.results.table import Table
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.base import Part
from fmu_bearing.scene.bearing import Bearing, Cage
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.lubricant import Lubricant
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.member import still_of
from fmu_bearing.scene.seal import Seal
from fmu_bearing.scene.values import limits
from fmu_bearing.steady.rest import parts, started
from fmu_bearing.threads import one_thread

# The ends of each input. A scene's own value beyond an end becomes that end.
#: Limiting shear stress over pressure of an ester (after Hoeglund 1999, in the manuscript of sckim-ai/TRB),
#: and SKF's coefficient for mineral oils (general catalogue, p. 101). Between: 0.035 PAO, 0.04 synthetic.
TRACTION = (0.03, 0.05)
#: kg/m3. Air without oil at 120 degC, and twice what scenes assume: density and drag coefficient among balls
#: in a row were never found, so the range is assumed.
DENSITY = (0.9, 10.0)
#: Either way, on both races: 0.515/0.52 is a tenth stiffer than the pairs of NSK and TPI, 0.52/0.53 softer by
#: 2 to 4 % (docs/measured.md).
CONFORMITY = 0.005
#: Shares of the viscosity. A grade's tolerance is 10 % (ISO 3448); an inlet 7 K warmer or colder than the
#: scene has it does the rest (assumed).
VISCOSITY = (0.7, 1.4)
#: 0.005: hardened steel (sckim-ai/TRB). Houpert (1999), in Balan, Houpert, Tufescu and Olaru (2015), eq. 9,
#: comes to 0.04 on the ellipses of ball bearings.
HYSTERESIS = (0.005, 0.04)
#: Share of the clearance, where the lands carry oil; at the other end they carry none. Whether they do in jet
#: or oil-air is not known, and a clearance is rarely printed (assumed).
CLEARANCE = 0.5
#: Few drops and close conformity, or room for oil: both were measured on one rig (Balan, Houpert, Tufescu and
#: Olaru 2015). Replenishment constants of SKF's friction model for oil-air and for jets.
SUPPLY = (("starved", 6e-8), ("flooded", 3e-8))
#: The same ends with grease: bled oil alone, as SKF's model has it after some hours with 30 % of the space
#: filled (general catalogue, p. 97 f.), or inlets into which grease still comes, as in an oil bath. Makers'
#: factors f0 of what depends on speed, bath over grease: 2/1.3 (Schaeffler HR 1, 2006, p. 59) and 2/1.34
#: (KRW, p. 117); the ends are 1.5 to 1.7 apart. Fresh grease churns at two to five times f0 (HR 1, p. 56): in
#: no end.
GREASED = ("settled", "flooded")
#: Shares of the seals' torque. SKF calls its formula approximate and prints no spread; lips that have not run
#: in, a shaft off centre, grease and wear move it (assumed).
SEALS = (0.5, 1.5)

#: What `TorqueRange.table` shows, in words.
CAPTION = "friction torque, N mm, with one input at its low and its high end"

_Values = dict[str, Any]  # of a scene, by dotted key
_Ends = tuple[tuple[str, _Values], tuple[str, _Values]]  # low and high: in words, values
_EACH = ("inner_ring", "outer_ring", "balls")


@dataclass(frozen=True)
class End(Result):
    """One end of an input."""

    quantities = "values", Quantity("friction_torque_N_m [N m]", of=lambda end: end.torques or None)

    words: str
    """The values, in the unit of the input's words."""
    values: _Values
    """By dotted key, for `Scene.replace`."""
    torques: tuple[float, ...]
    """Friction torque of each bearing there, N m; empty where there is no equilibrium."""

    @property
    def shown(self) -> str:
        """Torque of all bearings, N mm, as people read it."""
        return f"{1e3 * sum(self.torques):.2f}" if self.torques else "no equilibrium"


@dataclass(frozen=True)
class Input(Result):
    """An input with its ends: name, what it is in words, `End` low and high."""

    quantities = (
        "low", "high", Quantity(" = words", ""), Quantity(" = low.words", "low"),
        Quantity(" = high.words", "high"), Quantity(" = low.shown", "at low"),
        Quantity(" = high.shown", "at high"),
    )  # fmt: skip

    name: str
    words: str
    low: End
    high: End


@dataclass(frozen=True)
class TorqueRange(Result):
    """The range of the friction torque of a scene's settled bearings, SI units."""

    quantities = (
        "friction_torque_N_m [N m] = total", Quantity("heat_W", of=lambda one: one.heat(one.total)),
        Quantity("inputs", of=lambda found: {one.name: one for one in found.inputs}),
    )  # fmt: skip

    scene: Scene
    """Without sound and imperfections."""
    torques: tuple[float, ...]
    """Of each bearing with the scene's own values, N m."""
    inputs: tuple[Input, ...]
    """Those that act in this scene."""

    @property
    def bearings(self) -> tuple[Range, ...]:
        """Of the torque of each bearing, N m."""
        return tuple(
            _range(torque, ([end.torques[k] for end in ends] for ends in self._found()))
            for k, torque in enumerate(self.torques)
        )

    @property
    def total(self) -> Range:
        """Of the torque of all bearings together, N m: their changes add, as inputs are the same in all."""
        return _range(sum(self.torques), ([sum(end.torques) for end in ends] for ends in self._found()))

    @property
    def shown(self) -> list[tuple[Range, Range]]:
        """Ranges of torque (N mm) and heat (W) for people: of each bearing, of several together last."""
        each = self.bearings if len(self.bearings) == 1 else (*self.bearings, self.total)
        return [(Range(1e3 * one.low, 1e3 * one.high), self.heat(one)) for one in each]

    def heat(self, torque: Range) -> Range:
        """Of the heat (W) that a range of torque (N m) makes at the speed of the scene."""
        speed = self.scene.operation.speed_rpm * RPM
        return Range(*sorted(speed * value for value in torque))

    def _found(self) -> list[list[End]]:
        """Return the ends of each input at which there is an equilibrium."""
        return [[end for end in (one.low, one.high) if end.torques] for one in self.inputs]

    def table(self) -> Table:
        """Return columns and rows for people: each input with its ends, and the torque (N mm) there."""
        return table(Input, self.inputs)


@one_thread
def torque_range(scene: SceneSource) -> TorqueRange:
    """Return the range that the friction torque of a scene's bearings may have, without a run.

    Parameters
    ----------
    scene : Scene or path

    Raises
    ------
    SceneError
        If the file cannot be read, or another model owns the shaft.
    EngineError
        Where there is no equilibrium with the scene's own values; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing.design.torque_range import torque_range
    >>> found = torque_range("examples/scenes/7003C-spindle.toml")
    >>> f"{1e3 * found.torques[0]:.1f} N mm, {1e3 * found.total.low:.1f} to {1e3 * found.total.high:.1f}"
    '21.1 N mm, 17.9 to 30.2'
    """
    scene = still_of(scene_of(scene))
    require(scene, "statics")
    run = started(scene, fidelity="response")
    first = parts(run)[0].p
    inputs = []
    for name, (words, ends_of) in _INPUTS.items():
        ends = ends_of(scene, first)
        if ends is not None:
            low, high = (End(text, values, _torques_with(scene, values)) for text, values in ends)
            inputs.append(Input(name, words, low, high))
    return TorqueRange(scene, _torques(scene, run.get), tuple(inputs))


def _torques(scene: Scene, output: Callable[[str], float]) -> tuple[float, ...]:
    return tuple(output(f"{bearing.prefix}friction_torque") for bearing in scene.bearings())


def _torques_with(scene: Scene, values: _Values) -> tuple[float, ...]:
    """Return the torques with other values; empty where the scene or the engine refuses them."""
    try:
        return _torques(scene, started(scene.replace(values), fidelity="response").get)
    except (SceneError, EngineError):
        return ()


def _range(settled: float, ends: Iterable[Sequence[float]]) -> Range:
    """Return a value's range from its values at the ends of each input: roots of squares."""
    changes = [[value - settled for value in end] for end in ends]
    down = math.hypot(*(min([0.0, *change]) for change in changes))
    up = math.hypot(*(max([0.0, *change]) for change in changes))
    return Range(settled - down, settled + up)


# --- what moves each input: low and high, None where it does not act ----------------------------------------


def _traction(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    return _widest("lubricant.traction_max", float(p[P.MU]), TRACTION) if p[P.MU] > 0.0 else None


def _density(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    if p[P.DRAG] == 0.0 or p[P.DRAG_FACTOR] == 0.0:
        return None
    if scene.lubricant.greased:  # the balls go through air
        return None
    return _widest("lubricant.oil_air_density_kg_m3", scene.lubricant.oil_air_density_kg_m3, DENSITY)


def _geometries(scene: Scene) -> dict[str, Bearing]:
    """Return the geometries of a scene by their dotted keys: that of all bearings, then bearings' own."""
    own = {f"spindle.bearing[{k}].bearing": one.bearing for k, one in enumerate(scene.members, start=1)}
    return {"bearing": scene.bearing} | {key: one for key, one in own.items() if one is not None}


def _materials(scene: Scene) -> dict[str, Material]:
    """Return the materials of rings and balls by their dotted keys: those of all, then bearings' own."""
    found = {f"materials.{part}": getattr(scene.materials, part) for part in _EACH}
    for k, one in enumerate(scene.members, start=1):
        for part in _EACH:
            if (own := getattr(one.materials, part, None)) is not None:
                found[f"spindle.bearing[{k}].materials.{part}"] = own
    return found


def _conformity(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    names = ("inner_conformity", "outer_conformity")
    return _ends(
        {
            f"{key}.{name}": _within(Bearing, name, getattr(bearing, name) + change)
            for key, bearing in _geometries(scene).items()
            for name in names
        }
        for change in (-CONFORMITY, CONFORMITY)
    )


def _viscosity(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    name = "viscosity_Pa_s"
    given = getattr(scene.lubricant, name)
    return _ends({f"lubricant.{name}": _within(Lubricant, name, share * given)} for share in VISCOSITY)


def _hysteresis(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    losses = {key: material.loss for key, material in _materials(scene).items()}
    lossy = {key: loss for key, loss in losses.items() if loss > 0.0}
    if not lossy or not scene.fidelity.terms.rolling_hysteresis:
        return None
    low, high = min(HYSTERESIS[0], *lossy.values()), max(HYSTERESIS[1], *lossy.values())
    keys = [f"{key}.hysteresis_loss" for key in lossy]
    return (f"{low:.4g}", dict.fromkeys(keys, low)), (f"{high:.4g}", dict.fromkeys(keys, high))


def _lands(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    film = scene.fidelity.terms.land_film and scene.lubricant.land_viscosity_Pa_s != 0.0
    cages = {key: one.cage for key, one in _geometries(scene).items()}
    caged = {key: cage for key, cage in cages.items() if cage is not None and cage.guidance != "balls"}
    if not caged or not film:
        return None
    halves: _Values = {}
    for key, cage in caged.items():
        of_key = scene.model_copy(update={"bearing": _geometries(scene)[key]})
        mine = land_clearance(of_key, cage) if scene.differing else float(p[P.LAND_CLEARANCE])
        halves[f"{key}.cage.land_clearance_mm"] = _within(Cage, "land_clearance_mm", CLEARANCE * 1e3 * mine)
    words = " / ".join(f"{half:.3g}" for half in dict.fromkeys(halves.values()))
    return ("none", {"fidelity.terms.land_film": False}), (f"in {words} mm", halves)


def _seals(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    torques = {key: one.seal_torque for key, one in _geometries(scene).items() if one.seal_torque != 0.0}
    if not torques:
        return None
    name = "torque_N_mm"
    return _ends(
        {f"{key}.seal.{name}": _within(Seal, name, share * torque) for key, torque in torques.items()}
        for share in SEALS
    )


def _supply(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    return None if scene.lubricant.greased else _inlets(p, (SUPPLY[0][0], SUPPLY[1][0]))


def _grease(scene: Scene, p: NDArray[np.float64]) -> _Ends | None:
    return _inlets(p, GREASED) if scene.lubricant.greased else None


def _inlets(p: NDArray[np.float64], words: tuple[str, str]) -> _Ends | None:
    if p[P.ROLLING] == 0.0:
        return None
    keys = ("lubricant.rolling_law", "lubricant.replenishment_constant")
    low, high = (dict(zip(keys, one, strict=True)) for one in SUPPLY)
    return (words[0], low), (words[1], high)


#: By name: what the input is, in words, and its ends in a scene with these parameters of its first bearing.
_INPUTS: dict[str, tuple[str, Callable[[Scene, NDArray[np.float64]], _Ends | None]]] = {
    "traction": ("largest traction", _traction),
    "drag_density": ("oil-air density, kg/m3", _density),
    "conformity": ("conformities", _conformity),
    "viscosity": ("viscosity at 20 degC, Pa s", _viscosity),
    "hysteresis": ("hysteresis loss", _hysteresis),
    "seals": ("torque of the seals, N mm", _seals),
    "lands": ("oil between cage and lands", _lands),
    "supply": ("oil at the inlets", _supply),
    "grease": ("grease at the inlets", _grease),
}


def _widest(key: str, own: float, ends: tuple[float, float]) -> _Ends:
    return _ends({key: value} for value in (min(ends[0], own), max(ends[1], own)))


def _ends(values: Iterable[_Values]) -> _Ends:
    """Return both ends with their values as words."""
    low, high = ((" / ".join(f"{value:.4g}" for value in value.values()), value) for value in values)
    return low, high


def _within(table: type[Part], name: str, value: float) -> float:
    """Return a value within what its key of a scene allows."""
    low, high = limits(table.model_fields[name])
    return min(max(float(f"{value:.6g}"), low), high)
