"""The tables of a scene: a bearing, its mounting, oil and microphones, and the fidelity of the model."""

import math
import re
import unicodedata
from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple, Self

import tomlkit
from pydantic import Field

from fmu_bearing.scene import accelerometer, housing
from fmu_bearing.scene.accelerometer import Accelerometer
from fmu_bearing.scene.base import Conflict, Part, SceneError
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.defect import Defect
from fmu_bearing.scene.fidelity import Fidelity
from fmu_bearing.scene.fmu import Fmu
from fmu_bearing.scene.housing import SKIN
from fmu_bearing.scene.imperfections import Imperfections
from fmu_bearing.scene.lubricant import Lubricant
from fmu_bearing.scene.material import Materials
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.operation import Operation
from fmu_bearing.scene.seats import Fit
from fmu_bearing.scene.sound import Place, Sound
from fmu_bearing.scene.spindle import SetBearing, Spindle
from fmu_bearing.scene.tool import Milling, Tool

#: Letters of any script; names of FMUs' files and libraries are made of the designation, in ASCII.
NAME = r"^[\p{L}\p{N}][\w. -]{0,59}$"
_LONGEST_NAME = 60
#: Bodies that a contact heats.
_HEATED = ("inner_ring", "outer_ring", "balls")
#: Below it waves up to 10 kHz would be of higher orders than any race is known for.
SLOW_RPM = 100.0


def scene_name(text: str) -> str:
    """Return a text as the name of a scene: what names do not have becomes a dash, the rest is cut off."""
    plain = re.sub(r"[^\w. -]", "-", unicodedata.normalize("NFKC", text))
    return re.sub(r"^[\W_]+", "", plain)[:_LONGEST_NAME].strip() or "scene"


class SizeLimit(NamedTuple):
    """A range that follows the size of the bearing, its unit, and why it ends there."""

    low: float
    high: float
    unit: str
    words: str


class Tables(Part):
    """All tables together, with the checks that span several; ``read`` makes a `Scene` of them."""

    name: str = Field(
        pattern=NAME, examples=["7003C-spindle"], description="Name of the scene and of the FMU's model."
    )
    bearing: Bearing = Field(description="Geometry of the bearing.")
    materials: Materials = Field(description="Materials of its components.")
    lubricant: Lubricant = Field(description="Oil in contacts and lands.")
    mounting: Mounting | None = Field(
        default=None,
        description="Preload, loads, pedestal and what is fixed to the rings. Required, but with [spindle].",
    )
    spindle: Spindle | None = Field(
        default=None, description="Several bearings on one shaft, in the place of [mounting]."
    )
    operation: Operation = Field(description="Speed and temperatures at the start.")
    fidelity: Fidelity = Field(default_factory=Fidelity, description="Physics, error bounds and terms.")
    imperfections: Imperfections | None = Field(default=None, description="Absent: a perfect bearing.")
    sound: Sound | None = Field(default=None, description="Absent: no sound and no microphones.")
    # A file's array arrives as a list: the one conversion that strictness may let pass.
    accelerometer: tuple[Accelerometer, ...] | None = Field(
        default=None, max_length=64, strict=False, description="Sensors on what does not turn; absent: none."
    )
    tool: Tool | None = Field(
        default=None, description="Tool on the nose; absent: receptance and stability are those of the nose."
    )
    milling: Milling | None = Field(default=None, description="The cut that `lobes` judges; absent: none.")
    fmu: Fmu | None = Field(default=None, description="Absent: names and causalities as documented.")

    def conflicts(self) -> Iterator[Conflict]:
        """Yield conflicts between tables."""
        if any(
            one.cage is not None and materials.cage is None
            for one, materials in zip(self.geometries, self.materials_of_each, strict=True)
        ):
            yield Conflict("materials.cage", 'is missing, for example cage = "bakelite"; the bearing has one')
        yield from self._sizes()
        yield from self._thermal()
        yield from self._set()
        if self.bearing.is_deep_groove and self.fit is not None and self.fit.contact_angle == "mounted":
            table = "mounting" if self.spindle is None else "spindle"
            yield Conflict(
                f"{table}.fit.contact_angle",
                "is of angular contact bearings: the clearance of a deep groove one is that before it is "
                "mounted; leave it out",
            )
        own = None if self.mounting is None else self.mounting.housing
        if own is not None and own.diameter_mm <= self.bearing.outside_diameter_mm:
            limit = self.bearing.outside_diameter_mm
            yield Conflict(
                "mounting.housing.diameter_mm", f"must exceed bearing.outside_diameter_mm = {limit:g}"
            )
        yield from self._orders()
        yield from accelerometer.conflicts(self.accelerometers, self.geometries, self.mounting, self.spindle)
        if self.sound is not None:
            if self.sound.radiator == "housing" and getattr(self.mount, "housing", None) is None:
                yield Conflict("sound.radiator", "needs a table [mounting.housing]")
            yield from self._buried_microphones()
            if self.sound.reflecting_plane_mm is not None:
                yield from self._behind_plane(self.sound.reflecting_plane_mm)

    def _thermal(self) -> Iterator[Conflict]:
        """Yield what thermal traction misses of the bodies that a contact heats."""
        if not self.fidelity.terms.thermal_traction:
            return
        bodies = [(f"materials.{body}", getattr(self.materials, body)) for body in _HEATED]
        for k, member in enumerate(self.members, start=1):
            own = [(body, getattr(member.materials, body, None)) for body in _HEATED]
            bodies += [(f"spindle.bearing[{k}].materials.{body}", one) for body, one in own if one]
        for path, material in bodies:
            for key, example in (("conductivity_W_mK", 46.0), ("specific_heat_J_kgK", 460.0)):
                if getattr(material, key) is None:
                    yield Conflict(
                        f"{path}.{key}",
                        f"is missing, for example {key} = {example}; fidelity.terms.thermal_traction "
                        "needs it",
                    )

    def _set(self) -> Iterator[Conflict]:
        """Yield what does not fit in a set of bearings, and a speed that nothing reads."""
        if self.spindle is None:
            return
        if self.sound is not None and self.sound.radiator == "housing":
            yield from housing.conflicts(self.spindle, self.geometries)
        flaws = self.imperfections
        if self.operation.lowest_speed_rpm is not None and not (flaws and flaws.follows_law):
            yield Conflict(
                "operation.lowest_speed_rpm",
                "has no effect: it sets the highest order of [imperfections] that follow a law; leave it out",
            )
        wide = [one.width_mm for one in self.geometries]
        for number, (one, other) in enumerate(pairwise(self.spindle.bearing), start=2):
            apart = other.position_mm - one.position_mm
            before, own = wide[number - 2 : number]
            if 0.0 < apart < 0.5 * (before + own) - SKIN:
                each = f"each is {own:g}" if own == before else f"they are {before:g} and {own:g}"
                yield Conflict(
                    f"spindle.bearing[{number}].position_mm",
                    f"= {other.position_mm:g} is {apart:g} mm behind the bearing before it; {each} mm wide",
                )

    def _behind_plane(self, plane: float) -> Iterator[Conflict]:
        key = "sound.reflecting_plane_mm"
        for body, _, low, high in self._envelopes():
            if low < plane < high:
                yield Conflict(key, f"cuts the {body}, which reaches from x = {low:g} to {high:g} mm")
        for place in self.microphones:
            x = 1e3 * place.position_m[0]
            if any((x - plane) * (plane - middle) > 0.0 for _, middle in self._middles()):
                yield Conflict(key, f"is between the bearing and microphone '{place.name}' at x = {x:g} mm")

    def size_limits(self) -> dict[str, SizeLimit]:
        """Return by key the ranges that follow the size: forces by C0, speeds by the pitch diameter.

        A load on a set is carried by all its bearings, each up to what one alone may carry.
        """
        speed = self.most_speed
        words = "n d_m of 2.6e6 mm r/min or more"
        limits = {
            "operation.speed_rpm": SizeLimit(-speed, speed, "r/min", words),
            "operation.lowest_speed_rpm": SizeLimit(10.0, speed, "r/min", words),
        }
        axial = min(one.most_preload for one in self.geometries)
        radial = self.bearing.most_radial
        words = "twice the static rating C0 or more"
        preload, across = SizeLimit(0.0, axial, "N", words), SizeLimit(-radial, radial, "N", words)
        if self.mounting is not None:
            least = self.bearing.least_preload
            limits |= {"mounting.preload_N": preload._replace(low=least)}
            limits |= {f"mounting.radial_load_{axis}_N": across for axis in "yz"}
        if self.spindle is not None:
            if self.spindle.preload is not None:
                limits |= {f"spindle.preload.{key}": preload for key in ("preload_N", "force_N")}
            words = f"twice the static rating C0 of its {len(self.spindle.bearing)} bearings or more"
            for axis, most in zip("xyz", self.spindle.most_loads(self.geometries), strict=True):
                limits[f"spindle.load.force_{axis}_N"] = SizeLimit(-most, most, "N", words)
        return limits

    def _sizes(self) -> Iterator[Conflict]:
        """Yield forces far beyond the static rating of the bearing, and speeds beyond those of its size."""
        for key, (low, high, unit, words) in self.size_limits().items():
            value: Any = self
            for step in key.split("."):
                value = getattr(value, step)
            if value is not None and not low <= value <= high:
                yield Conflict(key, f"is refused; allowed: {low:g} to {high:g} {unit}, {words}")

    def _orders(self) -> Iterator[Conflict]:
        """Yield waviness whose highest order nothing decides, because the shaft does not turn."""
        flaws, operation = self.imperfections, self.operation
        if flaws is None or not flaws.follows_law or operation.lowest_speed_rpm is not None:
            return
        if abs(operation.speed_rpm) >= SLOW_RPM:
            return
        by_order = flaws.highest_order is not None and not flaws.ball_form_nm
        if not by_order:
            yield Conflict(
                "operation.lowest_speed_rpm",
                f"is missing, for example lowest_speed_rpm = 3000: below {SLOW_RPM:g} r/min the speed does "
                "not decide the highest order of waviness (imperfections.highest_frequency_kHz)",
            )

    def _buried_microphones(self) -> Iterator[Conflict]:
        bodies = list(self._envelopes())
        for place in self.microphones:
            x, y, z = (1e3 * value for value in place.position_m)
            r = math.hypot(y, z)
            for body, radius, low, high in bodies:
                depth = min(radius - r, x - low, high - x)
                if depth > -SKIN:
                    inside = depth >= SKIN
                    deep = f", {depth:.3g} mm below its surface" if inside else ""
                    yield Conflict(
                        "sound",
                        f"microphone '{place.name}' at x = {x:g}, r = {r:g} mm lies "
                        f"{'inside' if inside else 'on'} the {body}, which reaches to r = {radius:g} mm from "
                        f"x = {low:g} to {high:g} mm{deep}: move it to r above {radius:g}, or to x below "
                        f"{low:g} or above {high:g}",
                    )
                    break

    def _envelopes(self) -> Iterator[tuple[str, float, float, float]]:
        """Yield name, radius and axial extent (mm) of the cylinders that radiate; a shaft fills the bore."""
        half = self.geometries[0].width_mm / 2.0
        own = None if self.mounting is None else self.mounting.housing
        if self.sound is not None and self.sound.radiator == "housing" and own is not None:
            front = -half - own.front_face_mm
            yield "housing", own.diameter_mm / 2.0, front, front + own.length_mm
        if self.sound is not None and self.sound.radiator == "housing" and self.spindle is not None:
            envelopes = housing.envelope(self.spindle)
            if envelopes is not None:
                yield "housing", *envelopes
        for (name, middle), one in zip(self._middles(), self.geometries, strict=True):
            half = one.width_mm / 2.0
            yield name, one.outside_diameter_mm / 2.0, middle - half, middle + half

    def _middles(self) -> list[tuple[str, float]]:
        """Names of the bearings, and their places (mm) along the axis of the microphones."""
        places = [(f"bearing {k}", member.position_mm) for k, member in enumerate(self.members, start=1)]
        return places or [("bearing", 0.0)]

    @property
    def mounted(self) -> Mounting:
        """How the one bearing is mounted.

        Raises
        ------
        SceneError
            For a set of bearings on one shaft.
        """
        if self.mounting is None:
            raise SceneError(
                f"{self.name}: has a set of bearings on one shaft; one bearing needs [mounting] in the place "
                "of [spindle]"
            )
        return self.mounting

    @property
    def mount(self) -> Mounting | Spindle | None:
        """The table that holds the bearings, spelt either way; None before it was found missing."""
        return self.mounting or self.spindle

    @property
    def members(self) -> tuple[SetBearing, ...]:
        """Bearings of a shaft, from its nose on; none for the one bearing of a mounting."""
        return self.spindle.bearing if self.spindle else ()

    @property
    def geometries(self) -> tuple[Bearing, ...]:
        """Geometry of each bearing, of a set from the nose on: its own, or the scene's."""
        return tuple(member.bearing or self.bearing for member in self.members) or (self.bearing,)

    @property
    def materials_of_each(self) -> tuple[Materials, ...]:
        """Materials of each bearing, of a set from the nose on: its own over the scene's."""
        own = (member.materials for member in self.members)
        return tuple(one.over(self.materials) if one else self.materials for one in own) or (self.materials,)

    @property
    def most_speed(self) -> float:
        """Largest amount of a speed (r/min) that may be given: what the largest bearing may have."""
        return min(one.most_speed for one in self.geometries)

    @property
    def differing(self) -> bool:
        """Whether the bearings of a set differ in geometry or materials."""
        each = list(zip(self.geometries, self.materials_of_each, strict=True))
        return any(one != each[0] for one in each)

    @property
    def fit(self) -> Fit | None:
        """Fits of the rings, of one bearing or of a set; None: rings as drawn."""
        return None if self.mount is None else self.mount.fit

    @property
    def on_other_shaft(self) -> bool:
        """Whether another model owns the shaft of the bearings."""
        return bool(self.spindle and self.spindle.shaft.external)

    @property
    def flexural_modes(self) -> int:
        """Number of flexural modes of both rings of a bearing."""
        flexure = None if self.mount is None else self.mount.flexure
        return 0 if flexure is None else len(flexure.inner_ring) + len(flexure.outer_ring)

    @property
    def bends(self) -> bool:
        """Whether a ring bends."""
        return self.flexural_modes > 0

    @property
    def has_defects(self) -> bool:
        """Whether a race or a ball has a local defect."""
        return self.imperfections is not None and bool(self.imperfections.defect)

    def defects_of(self, number: int) -> dict[int, Defect]:
        """Return the local defects of a bearing, from 0, by their numbers in the scene, from 0."""
        every = self.imperfections.defect if self.imperfections is not None else ()
        return {k: one for k, one in enumerate(every) if (one.bearing or 1) == number + 1}

    @property
    def seeds_apart(self) -> int:
        """How far the seeds of two draws are apart: a set draws its k-th bearing with its seed + k."""
        return max(len(self.members), 1)

    def with_rigid_rings(self) -> Self:
        """Return the scene without the bending of its rings."""
        rigid = {
            key: part.model_copy(update={"flexure": None})
            for key, part in (("mounting", self.mounting), ("spindle", self.spindle))
            if part is not None
        }
        return self.model_copy(update=rigid)

    @property
    def microphones(self) -> list[Place]:
        """Names and places (m) of all microphones; empty without sound."""
        return [] if self.sound is None else self.sound.points()

    @property
    def accelerometers(self) -> tuple[Accelerometer, ...]:
        """All accelerometers."""
        return self.accelerometer or ()

    def to_toml(self) -> str:
        """Write the scene, catalogue entries resolved, as TOML that reads back to an equal scene."""
        return tomlkit.dumps(self.model_dump(mode="json", exclude_none=True))
