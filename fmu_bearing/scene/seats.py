"""Tables of fits: how tight the rings sit on shaft and in housing, and what the partner of each ring is."""

from collections.abc import Iterator
from typing import Literal, NamedTuple, get_args

from pydantic import Field

from fmu_bearing.formulas.tolerances import HOUSING_CLASSES, SHAFT_CLASSES
from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.material import Material

#: Classes of ISO 492 whose tolerances are known.
BearingClass = Literal["P5", "P4", "P2"]
BEARING_CLASSES: tuple[BearingClass, ...] = get_args(BearingClass)
#: Which interference of those that the classes allow; probable: 3 sigma of both parts at their limits.
Take = Literal["min", "probable min", "mean", "probable max", "max"]
#: Classes of ISO 286 whose tolerances are known, as patterns.
SHAFT_CLASS, HOUSING_CLASS = (f"^({'|'.join(names)})$" for names in (SHAFT_CLASSES, HOUSING_CLASSES))
#: Largest interference (um): 1/500 of the largest diameter.
LARGEST_UM = 4000.0
#: Least diameter over interference: below it rings and shafts yield.
SMALLEST_RATIO = 500.0


class Seat(Part):
    """One seat of a ring: how tight it is, and the partner of the ring."""

    interference_um: float | None = Field(
        default=None, ge=-LARGEST_UM, le=LARGEST_UM, examples=[2.0],
        description="Interference on diameter at 20 degC and standstill, + tight, in the place of a class; "
        "no roughness is taken off it, um.",
    )  # fmt: skip
    roughness_Rz_um: float = Field(
        default=0.0, ge=0, le=50, examples=[1.6],
        description="Sum of the roughness depths Rz of both surfaces; 0.4 of it is taken off an interference "
        "that follows from classes, um.",
    )  # fmt: skip
    long: bool = Field(
        default=True, examples=[True],
        description="Whether the partner is longer than the ring and supported by what is beside the seat; "
        "false: as wide as the ring.",
    )  # fmt: skip
    temperature_degC: float | None = Field(
        default=None, ge=-40, le=199, examples=[40.0],
        description="Temperature of the partner of a single bearing (absent: it follows the ring), degC.",
    )  # fmt: skip


class ShaftFit(Seat):
    """The seat of the inner ring on the shaft: a class or an interference, and the shaft under it."""

    shaft_class: str | None = Field(
        default=None, pattern=SHAFT_CLASS, examples=["js4"],
        description="Tolerance class of the shaft (ISO 286): g, h, js, k or m with grade 4, 5 or 6.",
    )  # fmt: skip
    bore_mm: float | None = Field(
        default=None, ge=0, le=1000, examples=[8.0],
        description="Bore of the shaft; absent: of a set that of spindle.shaft.sections_mm at the bearing, "
        "else a solid shaft, mm.",
    )  # fmt: skip
    material: Material | None = Field(
        default=None, examples=["GCr15"],
        description="Material of the shaft; absent: of a set that of [spindle.shaft], else that of the inner "
        "ring.",
    )  # fmt: skip

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a seat whose interference is given twice."""
        yield from _twice(self, "shaft_class")


class HousingFit(Seat):
    """The seat of the outer ring in the housing: a class or an interference, and the housing around it."""

    housing_class: str | None = Field(
        default=None, pattern=HOUSING_CLASS, examples=["JS5"],
        description="Tolerance class of the housing's bore (ISO 286): H, JS, K or M with grade 4, 5 or 6.",
    )  # fmt: skip
    outside_diameter_mm: float | None = Field(
        default=None, ge=3, le=3000, examples=[60.0],
        description="Outside diameter of the housing around the seat; absent: diameter_mm of "
        "[mounting.housing], of a set of [spindle.housing], mm.",
    )  # fmt: skip
    material: Material | None = Field(
        default=None, examples=["aluminium"],
        description="Material of the housing; absent: of a set that of [spindle.housing], else that of the "
        "outer ring.",
    )  # fmt: skip

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a seat whose interference is given twice."""
        yield from _twice(self, "housing_class")


def _twice(seat: Seat, key: str) -> Iterator[Conflict]:
    if getattr(seat, key) is not None and seat.interference_um is not None:
        yield Conflict(
            "interference_um",
            f'cannot be given with {key} = "{getattr(seat, key)}", which gives the interference, too: leave '
            "out one of the two",
        )


class Fit(Part):
    """How tight the rings sit; a seat that is left out is loose and its ring is as drawn."""

    bearing_class: BearingClass | None = Field(
        default=None, examples=["P4"],
        description="Tolerance class of the bearing's bore and outside diameter (ISO 492); absent: the grade "
        "that [imperfections] of the file names.",
    )  # fmt: skip
    take: Take = Field(
        default="mean", examples=["mean"],
        description="Which interference of those that the classes allow is run, of both seats; probable: "
        "3 sigma of both diameters at their limits.",
    )  # fmt: skip
    contact_angle: Literal["unmounted", "mounted"] = Field(
        default="unmounted", examples=["unmounted"],
        description="What bearing.contact_angle_deg is: of the loose bearing, as makers give it, or of the "
        "mounted one at 20 degC and standstill.",
    )  # fmt: skip
    preload: Literal["unmounted", "mounted"] | None = Field(
        default=None, examples=["unmounted"],
        description="What a rigid or spacer preload is: of the loose bearing, as makers give it, or measured "
        "on the spindle. Asked for beside preload_N; a class or an offset is of the loose bearing.",
    )  # fmt: skip
    shaft: ShaftFit | None = Field(
        default=None, description="Seat of the inner ring; absent: the ring is loose."
    )
    housing: HousingFit | None = Field(
        default=None, description="Seat of the outer ring; absent: the ring is loose."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield fits without a seat."""
        if self.shaft is None and self.housing is None:
            yield Conflict(
                "", "has no seat: give a table shaft or housing under it, as shaft.interference_um = 2.0"
            )


class Side(NamedTuple):
    """What distinguishes the two seats: of which ring, which keys."""

    seat: str
    ring: str
    class_key: str
    diameter_key: str


SHAFT = Side("shaft", "inner", "shaft_class", "bore_mm")
HOUSING = Side("housing", "outer", "housing_class", "outside_diameter_mm")
SIDES = (SHAFT, HOUSING)
