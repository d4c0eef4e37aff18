"""Geometry of the bearing."""

import math
from collections.abc import Iterator
from typing import Literal, get_args

from pydantic import Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from fmu_bearing.engine.choices import Guidance
from fmu_bearing.formulas import clearances, iso76, iso281
from fmu_bearing.scene.base import Conflict, Label, Part, below
from fmu_bearing.scene.seal import Seal

MOST_BALLS = 36
Kind = Literal["angular-contact", "deep-groove"]
ANGULAR_CONTACT, DEEP_GROOVE = get_args(Kind)
#: Keys of which one gives the clearance of a deep groove bearing.
CLEARANCE_KEYS = ("clearance", "radial_clearance_um")
_STEEPEST = 45.0  # deg: of the angle that the clearance of a deep groove bearing leaves
_MOST_RPM, _MOST_SPEED = 1e5, 2.6e6  # r/min, mm r/min: see `Bearing.most_speed`
_MOST_PRELOAD, _MOST_RADIAL = 1e4, 3e3  # N: of small bearings, as inputs of FMUs always had


class Cage(Part):
    """A cage with round pockets, guided on two lands by the shoulders of a ring, or by the balls."""

    guidance: Guidance = Field(
        default="inner", examples=["inner"],
        description="What carries the cage: lands on the shoulders of the inner or the outer ring, with "
        "radial bores as pockets, or the balls, in spherical pockets without lands.",
    )  # fmt: skip
    outside_diameter_mm: float = Field(
        ge=2, le=1000, examples=[27.6], description="Outside diameter of the cage, mm."
    )
    bore_mm: float = Field(ge=1, le=1000, examples=[23.4], description="Bore of the cage, mm.")
    width_mm: float = Field(ge=0.5, le=300, examples=[9.1], description="Width of the cage, mm.")
    pocket_diameter_mm: float = Field(ge=0.5, le=120, examples=[4.6], description="Diameter of a pocket, mm.")
    land_clearance_mm: float | None = Field(
        default=None, ge=0.005, le=2, examples=[0.04],
        description="Radial clearance between cage and lands of the ring that guides it; absent: what the "
        "cage leaves to that ring's shoulders, mm.",
    )  # fmt: skip
    mass_eccentricity_um: float = Field(
        default=5.0, ge=0, le=1000, examples=[5.0],
        description="Distance of the cage's centre of mass from its middle (default assumed), um.",
    )  # fmt: skip
    pocket_damping_N_s_m: float = Field(
        ge=0, le=10, examples=[0.02], description="Damping by the film in a pocket; 0: none, N s/m."
    )
    pocket_friction: float = Field(
        ge=0, le=0.5, examples=[0.05], description="Coefficient of friction in a pocket."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield dimensions that leave no wall or no land."""
        yield from below(self, "bore_mm", "outside_diameter_mm")
        yield from below(self, "pocket_diameter_mm", "width_mm")
        if self.guidance == "balls" and self.land_clearance_mm is not None:
            yield Conflict(
                "land_clearance_mm",
                'is of lands, which a cage with guidance = "balls" does not have: leave it out, or write '
                'guidance = "inner" or "outer"',
            )


class BallSprings(Part):
    """Linear springs between adjacent balls instead of a cage, as the impact-noise paper has them."""

    stiffness_N_m: float = Field(
        ge=1, le=1e9, examples=[1e5], description="Stiffness between two adjacent balls, N/m."
    )
    damping_N_s_m: float = Field(
        default=0.0, ge=0, le=1e4, examples=[0.0], description="Damping between two adjacent balls, N s/m."
    )


class Bearing(Part):
    """A single-row ball bearing: an angular contact one, or a deep groove one with radial clearance.

    It has two angles. The nominal one is what ratings, kinematics and contact constants take: the
    contact angle of an angular contact bearing, 0 of a deep groove one. The free one is that of balls that
    just touch both races of the unloaded bearing, by which the groove centres are placed; it is the contact
    angle, or what the clearance leaves.
    """

    designation: Label = Field(examples=["7003C"], description="Name of the bearing.")
    bore_mm: float = Field(ge=1, le=1000, examples=[17.0], description="Bore of the inner ring, mm.")
    outside_diameter_mm: float = Field(
        ge=3, le=2000, examples=[35.0], description="Outside diameter of the outer ring, mm."
    )
    width_mm: float = Field(ge=1, le=300, examples=[10.0], description="Width of both rings, mm.")
    pitch_diameter_mm: float = Field(
        ge=2, le=1500, examples=[26.0], description="Diameter of the circle of ball centres, mm."
    )
    ball_diameter_mm: float = Field(ge=0.5, le=120, examples=[4.5], description="Diameter of a ball, mm.")
    ball_count: int = Field(ge=3, le=MOST_BALLS, examples=[12], description="Number of balls.")
    kind: Kind = Field(
        default=ANGULAR_CONTACT, examples=[ANGULAR_CONTACT],
        description="Angular contact bearing, by its contact angle, or deep groove bearing, by its radial "
        "clearance.",
    )  # fmt: skip
    contact_angle_deg: float | None = Field(
        default=None, validate_default=True, ge=5, le=45, examples=[15.0],
        description="Contact angle of the unloaded bearing; not of a deep groove one, deg.",
    )  # fmt: skip
    clearance: clearances.Group | None = Field(
        default=None, examples=["CN"],
        description="Group of the radial clearance of a deep groove bearing, of which the middle is taken.",
    )  # fmt: skip
    radial_clearance_um: float | None = Field(
        default=None, validate_default=True, ge=-100, le=1000, examples=[12.0],
        description="Radial clearance of a deep groove bearing before it is mounted, in place of its group; "
        "negative: balls are pressed, um.",
    )  # fmt: skip
    inner_conformity: float = Field(
        ge=0.505, le=0.6, examples=[0.515], description="Groove radius of the inner race over ball diameter."
    )
    outer_conformity: float = Field(
        ge=0.505, le=0.6, examples=[0.52], description="Groove radius of the outer race over ball diameter."
    )
    inner_ring_outer_diameter_mm: float = Field(
        ge=1, le=1500, examples=[22.6],
        description="Effective outer diameter of the inner ring, for its mass, mm.",
    )  # fmt: skip
    outer_ring_inner_diameter_mm: float = Field(
        ge=1, le=2000, examples=[29.6],
        description="Effective inner diameter of the outer ring, for its mass, mm.",
    )  # fmt: skip
    contact_damping_us: float = Field(
        ge=0, le=25, examples=[0.5], description="Contact damping over contact stiffness; 0: none, us."
    )
    race_roughness_um: float = Field(
        ge=0.001, le=2, examples=[0.02], description="Roughness (rms) of the races, um."
    )
    ball_roughness_um: float = Field(
        ge=0.001, le=2, examples=[0.01], description="Roughness (rms) of the balls, um."
    )
    cage: Cage | None = Field(default=None, description="Cage; absent or false: a bearing without one.")
    ball_springs: BallSprings | None = Field(
        default=None, description="Springs between the balls instead of a cage; absent: none."
    )
    seal: Seal | None = Field(default=None, description="Seals; absent: an open bearing, or shields.")

    @field_validator("contact_angle_deg")
    @classmethod
    def _has_angle(cls, value: float | None, others: ValidationInfo) -> float | None:
        if value is None and others.data.get("kind") == ANGULAR_CONTACT:
            raise PydanticCustomError("missing", "an angular contact bearing has a contact angle")
        return value

    @field_validator("radial_clearance_um")
    @classmethod
    def _has_clearance(cls, value: float | None, others: ValidationInfo) -> float | None:
        known = others.data
        absent = value is None and known.get("clearance", "") is None
        if absent and known.get("kind") == DEEP_GROOVE:
            raise PydanticCustomError("missing", "a deep groove bearing has a radial clearance")
        return value

    @property
    def is_deep_groove(self) -> bool:
        """Whether it is a deep groove bearing, which carries axial loads both ways."""
        return self.kind == DEEP_GROOVE

    @property
    def nominal_angle_deg(self) -> float:
        """Contact angle as ratings, kinematics and contact constants take it, deg; 0 of deep groove ones."""
        return self.contact_angle_deg or 0.0

    @property
    def nominal_angle(self) -> float:
        """`nominal_angle_deg`, rad."""
        return math.radians(self.nominal_angle_deg)

    @property
    def radial_clearance(self) -> float:
        """Radial clearance of the deep groove bearing before it is mounted, on the diameter, m."""
        if self.radial_clearance_um is not None:
            return 1e-6 * self.radial_clearance_um
        found = None if self.clearance is None else clearances.limits(self.clearance, self.bore_mm)
        return 0.0 if found is None else 1e-6 * found.middle

    @property
    def clearance_groups(self) -> tuple[clearances.Group, ...]:
        """Groups of radial clearance that are known for its bore."""
        return tuple(
            group for group in clearances.GROUPS if clearances.limits(group, self.bore_mm) is not None
        )

    @property
    def free_angle(self) -> float:
        """Angle (rad) of balls that just touch both races as drawn; 0 where they are pressed."""
        if not self.is_deep_groove:
            return self.nominal_angle
        apart = 1e-3 * (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter_mm
        return math.acos(max(-1.0, min(1.0, 1.0 - 0.5 * self.radial_clearance / apart)))

    @property
    def free_angle_deg(self) -> float:
        """`free_angle`, deg."""
        return math.degrees(self.free_angle) if self.is_deep_groove else self.nominal_angle_deg

    @property
    def angle_words(self) -> str:
        """Contact angle, or radial clearance, in words."""
        if not self.is_deep_groove:
            return f"contact angle {self.contact_angle_deg:g} deg"
        group = "" if self.clearance is None else f", {self.clearance}"
        return f"radial clearance {1e6 * self.radial_clearance:.4g} um{group}"

    @property
    def for_ratings(self) -> tuple[int, float, float, float]:
        """Number of balls, ball and pitch diameter (mm) and contact angle (rad), as ratings take them."""
        return self.ball_count, self.ball_diameter_mm, self.pitch_diameter_mm, self.nominal_angle

    @property
    def dynamic_rating(self) -> float:
        """C (N) by ISO 281, for steel."""
        return iso281.dynamic_rating(*self.for_ratings)

    @property
    def lip_diameter(self) -> float | None:
        """Diameter (mm) on which the lips of its seals rub; None where no kind of seal says."""
        return None if self.seal is None else self.seal.lip(self.is_deep_groove, *self._diameters)

    @property
    def seal_torque(self) -> float:
        """Torque (N mm) of all its seals while it turns."""
        return 0.0 if self.seal is None else self.seal.torque(self.is_deep_groove, *self._diameters)

    @property
    def _diameters(self) -> tuple[float, float]:
        return self.bore_mm, self.outside_diameter_mm

    @property
    def most_preload(self) -> float:
        """Largest axial force (N) that may be given: twice C0 by ISO 76, 10 kN at least."""
        return max(_MOST_PRELOAD, self._twice_static)

    @property
    def least_preload(self) -> float:
        """Least axial force (N) that may be given: 0, of bearings that carry both ways minus the largest."""
        return -self.most_preload if self.is_deep_groove else 0.0

    @property
    def most_radial(self) -> float:
        """Largest radial load (N) that may be given: twice C0 by ISO 76, 3 kN at least."""
        return max(_MOST_RADIAL, self._twice_static)

    @property
    def most_speed(self) -> float:
        """Largest amount of a speed (r/min) that may be given: n d_m of 2.6e6 mm r/min, 100,000 at least.

        Every fidelity and method is run at 100,000 r/min with the 7003C, of 26 mm pitch diameter, and with
        the 7009C of 60 mm (``tests/extremes``). Smaller bearings of like shape at the 7003C's n d_m have its
        surface speeds and its stresses by centrifugal force.
        """
        return max(_MOST_RPM, float(f"{_MOST_SPEED / self.pitch_diameter_mm:.4g}"))

    @property
    def _twice_static(self) -> float:
        """Twice C0 (N) in two digits: steel races are pressed with 5.3 GPa, and dented well before."""
        return float(f"{2.0 * iso76.static_rating(*self.for_ratings):.2g}")

    def conflicts(self) -> Iterator[Conflict]:
        """Yield dimensions that contradict each other."""
        yield from below(self, "bore_mm", "inner_ring_outer_diameter_mm")
        yield from below(self, "inner_ring_outer_diameter_mm", "pitch_diameter_mm")
        yield from below(self, "pitch_diameter_mm", "outer_ring_inner_diameter_mm")
        yield from below(self, "outer_ring_inner_diameter_mm", "outside_diameter_mm")
        yield from self._ball_conflicts()
        yield from self._clearance_conflicts()
        if self.cage is not None:
            yield from self._cage_conflicts(self.cage)
        if self.cage is not None and self.ball_springs is not None:
            yield Conflict(
                "ball_springs",
                "replace a cage and cannot be given with one: write cage = false, or leave them out",
            )
        if self.seal is not None:
            yield from self.seal.misfits(self.is_deep_groove, *self._diameters)

    def _ball_conflicts(self) -> Iterator[Conflict]:
        ball, pitch = self.ball_diameter_mm, self.pitch_diameter_mm
        wall = min(pitch - self.bore_mm, self.outside_diameter_mm - pitch)
        if ball >= wall > 0.0:
            yield Conflict("ball_diameter_mm", f"must be below {wall:g}, or the races cut through the rings")
        fits = most_balls(pitch, ball)
        if self.ball_count > fits:
            yield Conflict(
                "ball_count", f"does not fit the pitch circle: at most {fits} balls of {ball:g} mm"
            )

    def _clearance_conflicts(self) -> Iterator[Conflict]:
        """Yield keys of the other kind of bearing, and a clearance that the grooves cannot have."""
        if not self.is_deep_groove:
            for key in CLEARANCE_KEYS:
                if getattr(self, key) is not None:
                    yield Conflict(
                        key, 'is of deep groove bearings: leave it out, or give kind = "deep-groove"'
                    )
            return
        if self.contact_angle_deg is not None:
            yield Conflict(
                "contact_angle_deg",
                "is of angular contact bearings: a deep groove one has clearance or radial_clearance_um",
            )
        if self.clearance is not None:
            if self.radial_clearance_um is not None:
                yield Conflict("clearance", "cannot be given with radial_clearance_um: keep one")
            elif self.clearance not in self.clearance_groups:
                yield Conflict(
                    "clearance",
                    f"is known for bores of {clearances.LEAST_BORE:g} to {clearances.MOST_BORE:g} mm: give "
                    "radial_clearance_um",
                )
        if self.free_angle_deg > _STEEPEST:
            most = 2e3 * (self.inner_conformity + self.outer_conformity - 1.0) * self.ball_diameter_mm
            most *= 1.0 - math.cos(math.radians(_STEEPEST))
            yield Conflict(
                "radial_clearance_um",
                f"must be below {most:.3g}: balls in these grooves would touch beyond {_STEEPEST:g} deg",
            )

    def _cage_conflicts(self, cage: Cage) -> Iterator[Conflict]:
        room = 2.0 * (cage.land_clearance_mm or 0.0)
        inside, outside = (room if cage.guidance == ring else 0.0 for ring in ("inner", "outer"))
        least = self.inner_ring_outer_diameter_mm + inside
        if cage.bore_mm <= least:
            more = " and twice the land's clearance" if inside else ""
            yield Conflict("cage.bore_mm", f"must exceed {least:g}: inner_ring_outer_diameter_mm{more}")
        most = self.outer_ring_inner_diameter_mm - outside
        if cage.outside_diameter_mm >= most:
            limit = "outer_ring_inner_diameter_mm"
            limit += f" less twice the land's clearance, {most:g}" if outside else f" = {most:g}"
            yield Conflict("cage.outside_diameter_mm", f"must be below {limit}")
        if not cage.bore_mm < self.pitch_diameter_mm < cage.outside_diameter_mm:
            yield Conflict(
                "pitch_diameter_mm",
                f"must lie between the cage's bore and outside diameter, {cage.bore_mm:g} to "
                f"{cage.outside_diameter_mm:g}",
            )
        if cage.width_mm > self.width_mm:
            yield Conflict("cage.width_mm", f"must not exceed the rings' width_mm = {self.width_mm:g}")
        if cage.pocket_diameter_mm <= self.ball_diameter_mm:
            yield Conflict(
                "cage.pocket_diameter_mm", f"must exceed ball_diameter_mm = {self.ball_diameter_mm:g}"
            )
        yield from self._pocket_conflicts(cage)

    def _pocket_conflicts(self, cage: Cage) -> Iterator[Conflict]:
        """Yield pockets that run into each other: radial bores come closest inside the cage."""
        fits = most_balls(cage.bore_mm, cage.pocket_diameter_mm)
        if not most_balls(self.pitch_diameter_mm, self.ball_diameter_mm) >= self.ball_count > fits:
            return
        sine = math.sin(math.pi / self.ball_count)
        room = cage.bore_mm * sine
        remedies = [f"make them smaller than {room:.4g}"] if room > self.ball_diameter_mm else []
        bore = cage.pocket_diameter_mm / sine
        if bore < min(self.pitch_diameter_mm, cage.outside_diameter_mm):
            remedies.append(f"give cage.bore_mm above {bore:.4g}")
        remedies.append(f"take at most {fits} balls")
        yield Conflict(
            "cage.pocket_diameter_mm",
            f"makes {self.ball_count} pockets overlap at the cage's bore of {cage.bore_mm:g} mm, where their "
            f"centres are {room:.4g} mm apart: {', or '.join(remedies)}",
        )


def most_balls(pitch_diameter: float, ball_diameter: float) -> int:
    """Return how many balls fit side by side on a pitch circle; neighbours are a chord apart, not an arc."""
    if ball_diameter >= pitch_diameter:
        return 1
    return math.floor(math.pi / math.asin(ball_diameter / pitch_diameter) + 1e-9)
