"""Heat of a bearing at its operating point: where friction loses power, and what that power warms."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, fields
from typing import Protocol

from fmu_bearing.design.measured import Range
from fmu_bearing.design.torque_range import TorqueRange
from fmu_bearing.results.base import Result
from fmu_bearing.results.table import number
from fmu_bearing.scene.bearing import Bearing

#: Where power is lost, and what the loss warms, in words.
ARISES = {
    "sliding": "sliding in the contacts",
    "rolling": "rolling resistance",
    "cage": "cage: pockets and lands",
    "drag": "drag on the balls",
    "seals": "seals",
}
GOES = {"inner_ring": "inner ring", "outer_ring": "outer ring", "oil": "oil and balls"}
_SHARES = {"sliding": "contacts"}  # names of the engine's shares that differ


@dataclass(frozen=True)
class Heat(Result):
    """Power (W) that the shaft loses to friction, all of which becomes heat.

    Five sources add up to `total`, and so do the last three: half of what a contact loses warms its ring,
    what seals lose the inner one, all else oil and balls.
    """

    quantities = tuple(f"{name} [W]" for name in ("total", *ARISES, *GOES, "inner_race", "outer_race"))

    sliding: float
    """Sliding, spinning and damping in the contacts of both races."""
    rolling: float
    """Rolling resistance of the oil at the inlets of the contacts."""
    cage: float
    """Pockets and lands of the cage, or dampers between the balls."""
    drag: float
    """Drag of oil and air on the balls that go round."""
    inner_ring: float
    outer_ring: float
    """To the rings."""
    oil: float
    """To oil and balls."""
    seals: float = 0.0
    """Lips of the seals, all of it to the inner ring."""

    @property
    def total(self) -> float:
        """All of it, W."""
        return self.sliding + self.rolling + self.cage + self.drag + self.seals

    @property
    def inner_race(self) -> float:
        """What the contacts of the inner race lose, W."""
        return 2.0 * (self.inner_ring - self.seals)

    @property
    def outer_race(self) -> float:
        """What the contacts of the outer race lose, W."""
        return 2.0 * self.outer_ring


def heat_of(output: Callable[[str], float], speed: float, bearing: Bearing) -> Heat:
    """Return the heat of a settled bearing.

    Parameters
    ----------
    output : callable
        Value of an output of the bearing by its name.
    speed : float
        Of the shaft, rad/s.
    bearing : Bearing
        Of a cage and of seals, where it has them, the share is an output; without a cage dampers between
        balls lose what is left.
    """
    has = {"cage": bearing.cage is not None, "seals": bearing.seal is not None}
    shares = [name for name in ARISES if has.get(name, True)]
    arises = {name: speed * output(f"friction_torque_share.{_SHARES.get(name, name)}") for name in shares}
    goes = {name: output(f"heat.{name}") for name in GOES}
    return Heat(**{"cage": sum(goes.values()) - sum(arises.values())} | arises | goes)


def heat_in_all(heats: Iterable[Heat]) -> Heat:
    """Return the sum of the heat of several bearings."""
    every = list(heats)
    return Heat(*(sum(getattr(one, field.name) for one in every) for field in fields(Heat)))


class Heated(Protocol):
    """A bearing with its friction torque (N m) and heat."""

    @property
    def friction_torque(self) -> float:
        """Positive where it brakes positive rotation."""
        ...

    @property
    def heat(self) -> Heat:
        """What the torque loses."""
        ...


def heat_table(
    bearings: Sequence[Heated], ranges: TorqueRange | None = None
) -> tuple[tuple[str, ...], list[list[str]]]:
    """Return columns and rows for people: a column per bearing, and one for all where they are several.

    ``ranges``: of the torques, in rows beside them; None: without these rows.
    """
    torques = [1e3 * bearing.friction_torque for bearing in bearings]
    heats = [bearing.heat for bearing in bearings]
    columns: tuple[str, ...] = ("", "value")
    if len(heats) > 1:
        columns = ("", *(f"bearing {k + 1}" for k in range(len(heats))), "all")
        torques, heats = [*torques, sum(torques)], [*heats, heat_in_all(heats)]
    words = {"inner_race": "of it in the inner race", "outer_race": "of it in the outer race"}
    arises = {
        name: text for name, text in ARISES.items() if name != "seals" or any(one.seals for one in heats)
    }
    words = arises | {"total": "in all"} | words | {name: f"of it to {_the(name)}" for name in GOES}
    rows = [[f"{text}, W", *(f"{getattr(heat, name):.2f}" for heat in heats)] for name, text in words.items()]
    rows = [["friction torque, N mm", *(f"{torque:.2f}" for torque in torques)], *rows]
    if ranges is not None:
        at = 1 + next(k for k, row in enumerate(rows) if row[0] == "in all, W")
        of_torque, of_heat = zip(*ranges.shown, strict=True)
        rows[at:at] = _range_rows(of_heat, "W")
        rows[1:1] = _range_rows(of_torque, "N mm")
    return columns, rows


def _range_rows(ranges: Sequence[Range], unit: str) -> list[list[str]]:
    ends = (("low", [one.low for one in ranges]), ("high", [one.high for one in ranges]))
    return [[f"its range: {name}, {unit}", *map(number, values)] for name, values in ends]


def _the(name: str) -> str:
    return GOES[name] if name == "oil" else f"the {GOES[name]}"
