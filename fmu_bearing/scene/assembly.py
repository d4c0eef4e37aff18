"""The assembly of a scene: bearings, shaft, preload and where the file has them, spelt in either table.

`[mounting]` and `[spindle]` are two spellings. One bearing on a mounting has no shaft of its own: what turns
is its inner ring with a rotor, which a preload pushes. A set has a shaft with coordinates of its own, or one
that another model owns.
"""

from dataclasses import dataclass
from typing import Literal

from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.shaft import Shaft, Unbalance
from fmu_bearing.scene.spindle import Preload, SetBearing, Spindle


@dataclass(frozen=True)
class Assembly:
    """What holds the bearings of a scene together.

    Attributes
    ----------
    table : str
        Of the file, that spells it.
    shaft : Shaft, optional
        None: the rotor is a mass on the inner ring.
    members : tuple of SetBearing
        Places, directions, seats and temperatures of the bearings of a shaft, from the nose on.
    preload : Preload, optional
        Spacers or springs between bearings of a shaft.
    preload_N : float
        What is asked: of a mounting, of spacers, or the force of springs; 0 without one.
    usual_N : tuple of float
        Axial load of each bearing by its preload; without one an equal share of the axial force.
    arrangement : str
        What makers call it.
    """

    table: Literal["mounting", "spindle"]
    shaft: Shaft | None
    members: tuple[SetBearing, ...]
    preload: Preload | None
    preload_N: float
    usual_N: tuple[float, ...]
    arrangement: str

    @property
    def joined(self) -> bool:
        """Whether a shaft joins the bearings: it has coordinates and a nose, or another model owns it.

        Else the rotor is a mass on the inner ring, which moves as the ring does.
        """
        return bool(self.members)

    @property
    def heavy_spots(self) -> tuple[Unbalance, ...]:
        """Unbalances along a shaft."""
        return () if self.shaft is None else self.shaft.unbalance

    @property
    def carries(self) -> list[str]:
        """Directions of the bearings of a shaft, from the nose on."""
        return [member.carries for member in self.members]

    @property
    def moving(self) -> str:
        """Prefix of the variables of what turns, where it is read: the inner ring, or the shaft's nose."""
        return "shaft.nose" if self.joined else "inner_ring"

    @property
    def pedestal_key(self) -> str:
        """Dotted key of the pedestal's radial stiffness."""
        housing = ".housing" if self.joined else ""
        return f"{self.table}{housing}.pedestal_stiffness_N_m"

    @property
    def preload_table(self) -> str:
        """Dotted name of the table of the preload."""
        return "spindle.preload" if self.joined else "mounting"

    @property
    def preload_key(self) -> str:
        """Dotted key of the preload in newtons: of one bearing, of spacers, or of springs' force."""
        springs = self.preload is not None and self.preload.kind == "spring"
        return f"{self.preload_table}.{'force_N' if springs else 'preload_N'}"

    @property
    def can_preload(self) -> bool:
        """Whether the scene has a preload that can be changed; that of a shaft may be a force alone."""
        return not self.joined or self.preload is not None

    def name(self, number: int) -> str:
        """Return the words for a bearing by its number, from 1."""
        return f"bearing {number}" if self.joined else "the bearing"

    def own_mm(self, number: int, along: float) -> float:
        """Return a place along a shaft (m from its nose) in the axes of one bearing, from 0, in mm."""
        one = self.members[number]
        # rounded below a nanometre: places that are mirror images share their filters
        return round(1e3 * one.sign * (along - 1e-3 * one.position_mm), 7) + 0.0

    def temperature_table(self, number: int) -> str:
        """Return the dotted name of the table with the temperatures of a bearing's rings."""
        return f"{self.table}.bearing[{number}]" if self.joined else "operation"


def assembly_of(scene: Tables) -> Assembly:
    """Return the assembly of a scene."""
    spindle = scene.spindle
    if spindle is None:
        preload = scene.mounted.preload_N
        return Assembly("mounting", None, (), None, preload, (preload,), "single")
    return Assembly(
        "spindle", spindle.shaft, spindle.bearing, spindle.preload, preload_asked(spindle),
        usual_loads(spindle), spindle.arrangement,
    )  # fmt: skip


def preload_asked(spindle: Spindle) -> float:
    """Preload (N) of a set: of spacers, or the force of springs; 0 without one."""
    preload = spindle.preload
    if preload is None:
        return 0.0
    return float((preload.force_N if preload.kind == "spring" else preload.preload_N) or 0.0)


def shares(spindle: Spindle) -> list[float]:
    """Load of each bearing over the preload asked; both directions carry the same in all.

    Springs give the load of each bearing that slides, spacers that of each on the side with more bearings.
    """
    signs = [bearing.sign for bearing in spindle.bearing]
    sliding = {bearing.sign for bearing in spindle.bearing if bearing.seat == "sliding"}
    count = {sign: signs.count(sign) for sign in signs}
    reference = sliding.pop() if sliding else max(count, key=lambda sign: count[sign])
    return [count[reference] / count[sign] for sign in signs]


def usual_loads(spindle: Spindle) -> tuple[float, ...]:
    """Axial load (N) of each bearing by its preload; without one an equal share of the axial force."""
    if spindle.preload is None:
        return (abs(spindle.load.force_x_N) / len(spindle.bearing),) * len(spindle.bearing)
    return tuple(share * preload_asked(spindle) for share in shares(spindle))
