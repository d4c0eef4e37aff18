"""A bearing on its seats in closed form: interference, pressure, hoop stress and free angle at any state.

Warmth is a share of the way from 20 degC (0) to the temperatures of the scene (1).
"""

from dataclasses import dataclass

from fmu_bearing.design.operating_point import OperatingPoint
from fmu_bearing.elastic.section import INNER, OUTER, groove_circle
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas import fits as closed
from fmu_bearing.formulas.fits import REFERENCE, Kind, State
from fmu_bearing.prepare.fits import Seat, loose, seats
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.fit import Fit, Take, held_loose, partner_temperatures

#: Largest hoop stress at the bore of a grooved ring over that of the closed form: the groove bends the ring,
#: and pressure is higher at its ends (elements: 1 to 7 % more; a sharp corner adds 3 %).
GROOVE = 1.07
_PRELOADS = {"mounted": "cold", "warm": "warm", "running": "running"}  # names of `steady.rest.preloads`
RINGS: tuple[Kind, Kind] = ("inner", "outer")
_COLD = 20.0  # degC


@dataclass(frozen=True)
class Mounted:
    """One bearing on its seats.

    Attributes
    ----------
    scene : Scene
        Of this bearing alone; its contact angle is that of the loose bearing.
    seats : dict
        By ``inner`` and ``outer``, those rings that have a seat.
    """

    scene: Scene
    seats: dict[Kind, Seat]

    @property
    def speed(self) -> float:
        """Speed of the scene, rad/s."""
        return self.scene.operation.speed_rpm * RPM

    def temperatures(self, ring: Kind, warmth: float = 1.0) -> tuple[float, float]:
        """Return the temperatures of a ring and its partner, K."""
        operation = self.scene.operation
        of_ring = getattr(operation, f"{ring}_ring_temperature_degC")
        partner = partner_temperatures(self.scene)[RINGS.index(ring)]
        return REFERENCE + warmth * (of_ring - _COLD), REFERENCE + warmth * (partner - _COLD)

    def at(self, ring: Kind, speed: float, warmth: float = 1.0) -> State:
        """Return the state of a seat at a speed (rad/s); interference on the radius."""
        seat = self.seats[ring]
        return seat.fit.at(seat.interference, speed, *self.temperatures(ring, warmth))

    def loss_speed(self, ring: Kind, warmth: float = 1.0) -> float | None:
        """Return the speed (rad/s) at which a seat lets go; None where no speed loosens it."""
        seat = self.seats[ring]
        return seat.fit.loss_speed(seat.interference, *self.temperatures(ring, warmth))

    def _grown(self, speed: float, warmth: float) -> tuple[tuple[float, float, float], tuple[float, float]]:
        """Return the thermal growth of inner ring, outer ring and balls, and the motion of the races (m)."""
        materials = self.scene.materials
        warm = [self.temperatures(ring, warmth)[0] - REFERENCE for ring in RINGS]
        rises = (*warm, 0.5 * sum(warm))
        bodies = (materials.inner_ring, materials.outer_ring, materials.balls)
        inner, outer, ball = (1.0 + si(one).expansion * rise for one, rise in zip(bodies, rises, strict=True))
        moved = [self.at(ring, speed, warmth).race if ring in self.seats else 0.0 for ring in RINGS]
        return (inner, outer, ball), (moved[0], moved[1])

    def free_angle(self, speed: float, warmth: float = 1.0) -> float:
        """Return the free contact angle (rad) at a speed (rad/s); 0 where the bearing is radially tight."""
        if self.scene.bearing.is_deep_groove:
            return self._clearance(speed, warmth)[1]
        b, angle = si(self.scene.bearing), self.scene.bearing.nominal_angle
        return closed.free_angle(
            b.pitch_diameter, b.ball_diameter, b.inner_conformity, b.outer_conformity, angle,
            *self._grown(speed, warmth),
        )  # fmt: skip

    def clearance(self, speed: float, warmth: float = 1.0) -> float:
        """Return the radial clearance (m) at a speed (rad/s); negative where the bearing is tight."""
        return self._clearance(speed, warmth)[0]

    def _clearance(self, speed: float, warmth: float) -> tuple[float, float]:
        b = si(self.scene.bearing)
        grooves = groove_circle(self.scene, INNER)[1], groove_circle(self.scene, OUTER)[1]
        return closed.clearance(
            grooves, b.ball_diameter, b.inner_conformity, b.outer_conformity, *self._grown(speed, warmth)
        )

    def breaking_chance(self, speed: float, warmth: float = 1.0) -> float | None:
        """Return the chance that the inner ring breaks at once, at `GROOVE` times its hoop stress.

        None without seat, strength or modulus.
        """
        ring = self.scene.materials.inner_ring
        if "inner" not in self.seats or ring.bending_strength_MPa is None or ring.weibull_modulus is None:
            return None
        strength = 1e6 * ring.bending_strength_MPa / GROOVE
        state = self.at("inner", speed, warmth)
        return closed.breaking_chance(self.seats["inner"].fit, state, speed, strength, ring.weibull_modulus)


def mounted(scene: Scene) -> Mounted:
    """Return a bearing on its seats.

    Parameters
    ----------
    scene : Scene
        Of one bearing alone, as `BearingPoint.scene`.

    Raises
    ------
    SceneError
        For a ring whose section leaves no wall.
    """
    drawn = loose(scene)
    seats_by_ring = {ring: seat for ring, seat in zip(RINGS, seats(drawn), strict=True) if seat is not None}
    return Mounted(drawn, seats_by_ring)


def with_fit(scene: Scene, fit: Fit) -> Scene:
    """Return a scene, of a single bearing or a set, with another fit."""
    table = scene.assembly.table
    whole = getattr(scene, table)
    return scene.model_copy(update={table: whole.model_copy(update={"fit": fit})})


def with_interference(scene: Scene, take: Take) -> Scene:
    """Return a scene with another interference of those that its classes allow."""
    assert scene.fit is not None, "a scene without a fit"
    return with_fit(scene, scene.fit.model_copy(update={"take": take}))


def preloads(point: OperatingPoint, number: int) -> dict[str, float]:
    """Return the preload (N) of a bearing, from 0, without other loads: drawing, mounted, warm, running.

    ``mounted`` is at 20 degC and standstill, ``warm`` at standstill. ``drawing`` is missing where the preload
    was measured on the spindle; empty where a constant force holds the bearing, or nothing.
    """
    scene, carried = point.scene, point.statics.preloads
    if not carried or scene.fit is None:
        return {}
    loads = {}
    if held_loose(scene):
        loads["drawing"] = scene.assembly.usual_N[number]
    return loads | {key: carried[own][number] for key, own in _PRELOADS.items()}


def axial_gaps(point: OperatingPoint) -> dict[str, float]:
    """Return how far (m) balls are loose along the axis, by those states of `preloads` in which they are."""
    found = point.statics.gaps
    return {key: found[own] for key, own in _PRELOADS.items() if own in found}
