"""Several bearings on one shaft: where they are, which way they carry, what preloads them."""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.material import Material, OwnMaterials
from fmu_bearing.scene.mounting import SUPPORTS, AxesAngle, AxesRatio, Flexure, SeatTiltY, SeatTiltZ
from fmu_bearing.scene.seats import LARGEST_UM, Fit
from fmu_bearing.scene.shaft import LONG, Shaft, ShaftTiltSupport

_MOST = 16  # bearings of a set
_HEAVY = 1e7  # N: beyond twice C0 of any set
#: What may be in the place of a preload in newtons.
OR_CLASS = 'or preload_class = "light", or preload_offset_um = 10.0'

#: Sets by their directions, from the nose on, and what makers call them.
ARRANGEMENTS = {
    "+": "single", "-": "single", "+-": "DB (O)", "-+": "DF (X)", "++": "DT", "--": "DT", "++-": "TBT (O)",
    "+--": "TBT (O)", "--+": "TFT (X)", "-++": "TFT (X)", "+++": "triple tandem", "---": "triple tandem",
    "++--": "QBC (O)", "--++": "QFC (X)", "+++-": "QBT (O)", "+---": "QBT (O)", "---+": "QFT (X)",
    "-+++": "QFT (X)", "++++": "QT", "----": "QT",
}  # fmt: skip
#: Directions by makers' name; the first where a set has two, which carries +x ahead or with more bearings.
DIRECTIONS = {
    words.split()[0]: signs for signs, words in reversed(ARRANGEMENTS.items()) if words.split()[0].isupper()
}


class SetBearing(Part):
    """One bearing of the set; `[bearing]`, `[materials]` and `[lubricant]` serve all without their own."""

    position_mm: float = Field(
        ge=0, le=LONG, examples=[40.0], description="Plane of the ball centres from the shaft's nose, mm."
    )
    carries: Literal["+x", "-x"] = Field(
        examples=["+x"],
        description="Direction of the axial force on the shaft that the bearing carries; +X leads from the "
        "nose to the rear.",
    )
    stickout_um: float = Field(
        default=0.0, ge=-200, le=200, examples=[1.0],
        description="How much more than the spacer preload asks for the inner ring is pushed into the "
        "bearing at assembly, um.",
    )  # fmt: skip
    seat: Literal["fixed", "sliding", "pedestal"] = Field(
        default="fixed", examples=["fixed"],
        description="Outer ring held in the housing, sliding along it against a spring, or on a pedestal of "
        "its own as in [mounting].",
    )  # fmt: skip
    misalignment_y_mrad: SeatTiltY = 0.0
    misalignment_z_mrad: SeatTiltZ = 0.0
    inner_ring_temperature_degC: float | None = Field(
        default=None, ge=-40, le=199, examples=[45.0],
        description="Temperature of its inner ring (absent: that of [operation]), degC.",
    )  # fmt: skip
    outer_ring_temperature_degC: float | None = Field(
        default=None, ge=-40, le=199, examples=[40.0],
        description="Temperature of its outer ring (absent: that of [operation]), degC.",
    )  # fmt: skip
    shaft_interference_um: float | None = Field(
        default=None, ge=-LARGEST_UM, le=LARGEST_UM, examples=[2.0],
        description="Interference of its inner ring on the shaft, on diameter, + tight (absent: that of "
        "[spindle.fit.shaft]), um.",
    )  # fmt: skip
    housing_interference_um: float | None = Field(
        default=None, ge=-LARGEST_UM, le=LARGEST_UM, examples=[-3.0],
        description="Interference of its outer ring in the housing, on diameter, + tight (absent: that of "
        "[spindle.fit.housing]), um.",
    )  # fmt: skip
    bearing: Bearing | None = Field(
        default=None,
        description="Its own geometry in the place of [bearing]: a table, or the name of a catalogue entry.",
    )
    materials: OwnMaterials | None = Field(
        default=None, description="Its own materials in the place of those of [materials]."
    )

    @property
    def sign(self) -> int:
        """1 where the bearing carries force on the shaft towards +X, else -1."""
        return 1 if self.carries == "+x" else -1


class Preload(Part):
    """Preload of the set by spacers of fixed length, or by springs behind sliding outer rings."""

    kind: Literal["spacer", "spring"] = Field(
        default="spacer",
        examples=["spacer"],
        description="A distance that is held, or a spring that pushes sliding outer rings.",
    )
    preload_N: float | None = Field(
        default=None, ge=0, le=1e6, examples=[500.0],
        description="Spacer: axial load of each bearing at standstill and 20 degC without stick-out and "
        "load, on the side with more bearings where the sides differ, N.",
    )  # fmt: skip
    force_N: float | None = Field(
        default=None, ge=0, le=1e6, examples=[300.0],
        description="Spring: force on each sliding outer ring at standstill and 20 degC, N.",
    )  # fmt: skip
    stiffness_N_m: float | None = Field(
        default=None, ge=0, le=1e9, examples=[1e5],
        description="Spring: stiffness behind each sliding outer ring (absent: 0, a constant force), N/m.",
    )  # fmt: skip

    def conflicts(self) -> Iterator[Conflict]:
        """Yield keys of the other kind, and the one that is missing."""
        own, others = ("preload_N", ["force_N", "stiffness_N_m"])
        if self.kind == "spring":
            own, others = "force_N", ["preload_N"]
        if getattr(self, own) is None:
            instead = f"; {OR_CLASS}" if own == "preload_N" else ""
            yield Conflict(
                own, f'is missing, for example {own} = 300.0; kind = "{self.kind}" needs it{instead}'
            )
        for key in others:
            if getattr(self, key) is not None:
                yield Conflict(key, f'is not read with kind = "{self.kind}": leave it out')


class SetHousing(Part):
    """What holds the outer rings: at rest, or with a mass a rigid body that moves on its pedestal."""

    material: Material | None = Field(
        default=None,
        examples=["GCr15"],
        description="Material of the housing; absent: that of the outer rings.",
    )
    temperature_degC: float | None = Field(
        default=None, ge=-40, le=199, examples=[35.0],
        description="Mean temperature of the housing between its seats (absent: that of [operation]'s outer "
        "ring), degC.",
    )  # fmt: skip
    mass_kg: float | None = Field(
        default=None, ge=0.001, le=1e4, examples=[2.0],
        description="Mass of the housing, which moves then (absent: it does not move), kg.",
    )  # fmt: skip
    diameter_mm: float | None = Field(
        default=None, ge=5, le=3000, examples=[100.0], description="Outside diameter of the housing, mm."
    )
    length_mm: float | None = Field(
        default=None, ge=1, le=5000, examples=[160.0], description="Length of the housing, mm."
    )
    position_mm: float | None = Field(
        default=None, ge=-LONG, le=LONG, examples=[90.0],
        description="Middle of the housing and of its pedestal from the shaft's nose (absent: the middle of "
        "the bearings), mm.",
    )  # fmt: skip
    pedestal_stiffness_N_m: float | None = Field(
        default=None, ge=1e4, le=1e12, examples=[1e8],
        description="Radial stiffness under the housing, or under each ring with a pedestal of its own, N/m.",
    )  # fmt: skip
    pedestal_stiffness_ratio: AxesRatio = 1.0
    pedestal_axis_angle_deg: AxesAngle = 0.0
    pedestal_axial_ratio: float = Field(
        default=1.0, ge=0.01, le=100, examples=[1.0],
        description="Axial over radial stiffness of the pedestal (default assumed).",
    )  # fmt: skip
    pedestal_rotational_ratio_mm2: float = Field(
        default=200.0, ge=0.1, le=1e6, examples=[200.0],
        description="Rotational over radial stiffness of the pedestal (default assumed), mm2.",
    )  # fmt: skip
    pedestal_damping_ratio: float = Field(
        default=0.05, ge=0, le=1, examples=[0.05],
        description="Damping over the critical one of the mass on the pedestal (default assumed).",
    )  # fmt: skip

    @property
    def moves(self) -> bool:
        """Whether the housing is a body of its own."""
        return self.mass_kg is not None

    def conflicts(self) -> Iterator[Conflict]:
        """Yield a housing with a mass and no size or pedestal, and sizes without a mass."""
        sizes = ("diameter_mm", "length_mm")
        for key, example in (*zip(sizes, (100.0, 160.0), strict=True), ("pedestal_stiffness_N_m", 1e8)):
            if self.moves and getattr(self, key) is None:
                yield Conflict(
                    key, f"is missing, for example {key} = {example:g}: a housing with a mass moves"
                )
        for key in (*sizes, "position_mm"):
            if not self.moves and getattr(self, key) is not None:
                yield Conflict(key, "has no effect without mass_kg: the housing does not move; leave it out")


class Load(Part):
    """Force on the shaft, as of the tool."""

    force_x_N: float = Field(
        default=0.0, ge=-_HEAVY, le=_HEAVY, examples=[200.0],
        description="Along the axis; up to 2 C0 of all bearings, 10 kN each at least, N.",
    )  # fmt: skip
    force_y_N: float = Field(
        default=0.0, ge=-_HEAVY, le=_HEAVY, examples=[0.0],
        description="Horizontal; up to 2 C0 of all bearings, 3 kN each at least, N.",
    )  # fmt: skip
    force_z_N: float = Field(
        default=0.0, ge=-_HEAVY, le=_HEAVY, examples=[-300.0],
        description="Upwards; up to 2 C0 of all bearings, 3 kN each at least, N.",
    )  # fmt: skip
    position_mm: float = Field(
        default=0.0, ge=-LONG, le=LONG, examples=[-20.0],
        description="Where it acts, from the nose; negative: ahead of it, mm.",
    )  # fmt: skip


class Spindle(Part):
    """A set of bearings on one shaft. It takes the place of `[mounting]`."""

    shaft: Shaft = Field(description="The shaft.")
    bearing: tuple[SetBearing, ...] = Field(
        min_length=1, max_length=_MOST, strict=False, description="The bearings, from the nose to the rear."
    )
    preload: Preload | None = Field(default=None, description="Absent: the bearings just touch.")
    housing: SetHousing = Field(default_factory=SetHousing, description="What holds the outer rings.")
    load: Load = Field(default_factory=Load, description="Force on the shaft.")
    tilt_support: ShaftTiltSupport | None = Field(
        default=None, description="Support of the shaft against tilting; absent: the bearings alone hold it."
    )
    flexure: Flexure | None = Field(
        default=None, description="Bending of the rings of every bearing; absent: rigid rings."
    )
    fit: Fit | None = Field(
        default=None, description="Fits of the rings of every bearing; absent: rings as drawn."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield bearings beside the shaft or out of order, and sets that nothing holds."""
        length = self.shaft.length_mm
        given = self.shaft.external or not self.shaft.sections_mm
        for number, one in enumerate(() if given else self.bearing, start=1):
            if one.position_mm > length:
                yield Conflict(
                    f"bearing[{number}].position_mm",
                    f"= {one.position_mm:g} is beyond the shaft's end at {length:g} mm",
                )
        for number, (one, other) in enumerate(pairwise(self.bearing), start=2):
            if other.position_mm <= one.position_mm:
                yield Conflict(
                    f"bearing[{number}].position_mm",
                    f"= {other.position_mm:g} must exceed that of the bearing before it, "
                    f"{one.position_mm:g}: bearings are given from the nose to the rear",
                )
        for key in SUPPORTS:
            support = getattr(self, key)
            if not given and support is not None and (support.position_mm or 0.0) > length:
                yield Conflict(f"{key}.position_mm", f"is beyond the shaft's end at {length:g} mm")
        if not self.shaft.external:
            yield from self._held()
        yield from self._springs()
        yield from self._pedestals()
        yield from self._round()
        yield from self._unread()

    def _unread(self) -> Iterator[Conflict]:
        """Yield tables of the scene that no bearing reads, because each has its own."""
        if all(one.bearing is not None for one in self.bearing):
            yield Conflict(
                "bearing",
                "all have a geometry of their own, and nothing reads the table [bearing] of the scene: leave "
                "out `bearing` of those that are equal to one another, and give theirs as [bearing]",
            )
        for key in OwnMaterials.model_fields:
            if all(one.materials is not None and getattr(one.materials, key) for one in self.bearing):
                yield Conflict(
                    "bearing",
                    f"all have their own materials.{key}, and nothing reads that of [materials]: leave it "
                    f"out of those that are equal to one another, and give theirs as materials.{key}",
                )

    def _held(self) -> Iterator[Conflict]:
        """Yield a set that carries one direction alone, and nothing pushes the shaft that way."""
        signs = {one.sign for one in self.bearing}
        if len(signs) > 1:
            return
        (sign,) = signs
        way, back = ("+x", "-x") if sign > 0 else ("-x", "+x")
        if self.preload is not None:
            yield Conflict(
                "preload",
                f"has nothing to act against: all carry {way}; leave [spindle.preload] out, or turn "
                f'a bearing to carries = "{back}"',
            )
        elif sign * self.load.force_x_N <= 0.0:
            yield Conflict(
                "bearing",
                f'all carry {way} and nothing holds the shaft the other way: turn one to carries = "{back}", '
                f"or give a force that keeps them loaded, load.force_x_N {'>' if sign > 0 else '<'} 0",
            )

    def _round(self) -> Iterator[Conflict]:
        """Yield rings that bend although a solid shaft or housing on a tight seat keeps them round."""
        if self.flexure is None:
            return
        seated = not all(one.seat == "pedestal" for one in self.bearing)
        for ring, body, seat_is_tight in (("inner", "shaft", True), ("outer", "housing", seated)):
            stiffness = getattr(self.flexure, f"{ring}_seat_stiffness_N_m")
            if seat_is_tight and getattr(self.flexure, f"{ring}_ring") and stiffness == 0.0:
                yield Conflict(
                    f"flexure.{ring}_ring",
                    f"cannot bend on the tight seat of the {body}: write {ring}_ring = [], or for a loose "
                    f"fit give {ring}_seat_stiffness_N_m",
                )

    def _springs(self) -> Iterator[Conflict]:
        """Yield sliding seats without a spring, springs without one, and sets that slide as a whole."""
        spring = self.preload is not None and self.preload.kind == "spring"
        sliding = {one.sign for one in self.bearing if one.seat == "sliding"}
        fixed_signs = {one.sign for one in self.bearing if one.seat != "sliding"}
        if sliding and not spring:
            yield Conflict(
                "preload",
                'a sliding seat needs a spring: give kind = "spring" and force_N, or seat = "fixed"',
            )
        elif spring and not sliding:
            yield Conflict(
                "preload", 'a spring needs a ring that it pushes: give a [[spindle.bearing]] seat = "sliding"'
            )
        elif sliding and (len(sliding) > 1 or sliding & fixed_signs):
            yield Conflict(
                "bearing",
                "springs push all bearings of one direction and none of the other: give those of one "
                'direction seat = "sliding", those of the other seat = "fixed"',
            )

    def _pedestals(self) -> Iterator[Conflict]:
        """Yield rings on pedestals of no stiffness, and a housing that is both held and not needed."""
        own = [one for one in self.bearing if one.seat == "pedestal"]
        if own and self.housing.pedestal_stiffness_N_m is None:
            yield Conflict(
                "housing.pedestal_stiffness_N_m",
                'is missing, for example pedestal_stiffness_N_m = 1e8: a bearing has seat = "pedestal"',
            )
        if own and self.housing.moves:
            yield Conflict(
                "housing.mass_kg",
                'applies to a housing on a pedestal, but a bearing has seat = "pedestal" of its own: leave '
                'mass_kg out, or give all bearings seat = "fixed" or "sliding"',
            )
        if own or self.housing.moves:
            return
        for key, field in SetHousing.model_fields.items():
            if key.startswith("pedestal_") and getattr(self.housing, key) != field.default:
                yield Conflict(
                    f"housing.{key}",
                    "has no effect: give housing.mass_kg for a housing that moves, or a bearing with "
                    'seat = "pedestal"',
                )

    def most_loads(self, geometries: Sequence[Bearing]) -> tuple[float, float, float]:
        """Return the largest load (N) along x, y and z that its bearings together may be given.

        ``geometries``: of each bearing, see `Tables.geometries`.
        """
        across = sum(one.most_radial for one in geometries)
        return sum(one.most_preload for one in geometries), across, across

    @property
    def middle_mm(self) -> float:
        """Middle of the bearings from the shaft's nose."""
        places = [one.position_mm for one in self.bearing]
        return 0.5 * (min(places) + max(places))

    @property
    def directions(self) -> str:
        """A sign per bearing, from the nose on: ``+`` carries force on the shaft towards +X."""
        return "".join("+" if one.sign > 0 else "-" for one in self.bearing)

    @property
    def arrangement(self) -> str:
        """What makers call the set, else its directions."""
        return ARRANGEMENTS.get(self.directions, self.directions)
