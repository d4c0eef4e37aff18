"""The blocks of accelerometers of a scene, one for each bearing: what each reads of its outer ring's motion.

A housing's sensor belongs to the bearing whose outer ring shows how the housing moves: a single one, or the
first of a set that is fixed in it. All here is in the axes of that bearing.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.sensing import Pole, Sensor, Sensors, block_of
from fmu_bearing.elastic.modes import RingMode, ring_modes
from fmu_bearing.elastic.section import OUTER
from fmu_bearing.prepare import bodies
from fmu_bearing.prepare.spindle import housing_of, pedestal_axes
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.accelerometer import Accelerometer
from fmu_bearing.scene.housing import middle_mm
from fmu_bearing.scene.member import SceneBearing, set_of
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.spindle import SetHousing
from fmu_bearing.threads import one_thread

Array = NDArray[np.float64]

__all__ = ["sensor_blocks", "sensors_of"]


class Seat(NamedTuple):
    """What holds the body of a sensor, per axis: stiffness (N/m), damping (N s/m), and its plane (m)."""

    stiffness: Array
    damping: Array
    plane: float


@one_thread
def sensor_blocks(scene: Scene) -> list[Array]:
    """Return the block of accelerometers of every bearing of a scene; empty where it carries none.

    Raises
    ------
    ValueError
        When a filter does not follow its response.
    """
    return [block_of(of) if of.each else np.zeros(0) for of in sensors_of(scene)]


def sensors_of(scene: Scene) -> list[Sensors]:
    """Return the accelerometers of every bearing of a scene."""
    if not scene.accelerometers:
        return [Sensors(()) for _ in scene.bearings()]
    found = []
    for bearing in scene.bearings():
        modes = ring_modes(bearing.scene)
        each = [
            _sensor(scene, bearing, modes, number, one)
            for number, one in enumerate(scene.accelerometers)
            if _carrier(scene, one) == bearing.number
        ]
        found.append(Sensors(each, modes))
    return found


def _carrier(scene: Scene, sensor: Accelerometer) -> int:
    """Return the number of the bearing whose outer ring moves as the sensor's body does."""
    if sensor.bearing is not None or not scene.assembly.joined:
        return sensor.bearing or 1
    return next(one.number for one in scene.bearings() if one.seat != "sliding")


def _sensor(
    scene: Scene, bearing: SceneBearing[Scene], modes: tuple[RingMode, ...], number: int, one: Accelerometer
) -> Sensor:
    housed = one.on == "housing"
    x, radius, angle = _place(scene, bearing, one)
    sine, cosine = math.sin(angle), math.cos(angle)
    along = {
        "radial": (0.0, -sine, cosine),
        "axial": (float(bearing.sign), 0.0, 0.0),
        "tangential": (0.0, -cosine, -sine),
    }[one.direction]
    axis = np.array(along)
    bending = [0.0 if housed else share for mode in modes for share in _bending(mode, x, radius, angle, axis)]
    reads = np.concatenate([axis @ _motion(x, -radius * sine, radius * cosine), bending])
    seat, still = _seat(scene, bearing), np.zeros(len(bending))
    held = _motion(seat.plane, 0.0, 0.0)
    omega = [2.0 * math.pi * mode.frequency_Hz for mode in one.mode]
    mount = one.resonance_kHz
    return Sensor(
        one.name, number, reads,
        np.concatenate([axis @ seat.stiffness @ held, still]),
        np.concatenate([axis @ seat.damping @ held, still]),
        [(Pole(w, mode.damping_ratio), mode.mass_kg) for w, mode in zip(omega, one.mode, strict=True)],
        None if mount is None else Pole(2e3 * math.pi * mount, one.damping_ratio),
    )  # fmt: skip


def _place(scene: Scene, bearing: SceneBearing[Scene], one: Accelerometer) -> tuple[float, float, float]:
    """Return place along the axis and distance from it (m), and angle (rad), in the bearing's own axes."""
    joined, housed = scene.assembly.joined, one.on == "housing"
    outside = si(bearing.scene.bearing).outside_diameter
    if housed:
        own = set_of(scene).housing if joined else scene.mounted.housing
        diameter = None if own is None else own.diameter_mm
        outside = outside if diameter is None else 1e-3 * diameter
    radius = 0.5 * outside if one.radius_mm is None else 1e-3 * one.radius_mm
    angle = math.radians(one.angle_deg)
    if not joined:
        return 1e-3 * (one.x_mm or 0.0), radius, angle
    x = one.x_mm
    if x is None:
        x = middle_mm(set_of(scene)) if housed else 1e3 * bearing.position
    return 1e-3 * scene.assembly.own_mm(bearing.number - 1, 1e-3 * x), radius, angle


def _motion(x: float, y: float, z: float) -> Array:
    """Return the matrix from acceleration and rates of spins of a body to the acceleration at a place."""
    return np.array(
        [
            [1.0, 0.0, 0.0, 0.0, z, -y],
            [0.0, 1.0, 0.0, -z, 0.0, x],
            [0.0, 0.0, 1.0, y, -x, 0.0],
        ]
    )


def _bending(mode: RingMode, x: float, radius: float, angle: float, axis: Array) -> tuple[float, float]:
    """Return what both coordinates of a mode add along an axis, at the skin's point nearest to the place."""
    if mode.body != OUTER:
        return 0.0, 0.0
    nearest = np.hypot(mode.skin_points[:, 0] - x, mode.skin_points[:, 1] - radius).argmin()
    along, out, round_ = mode.skin_shape[nearest]
    sine, cosine = math.sin(angle), math.cos(angle)
    c, s = math.cos(mode.order * angle), math.sin(mode.order * angle)

    def turned(u_x: float, u_r: float, u_t: float) -> float:
        return float(axis @ (u_x, -sine * u_r - cosine * u_t, cosine * u_r - sine * u_t))

    return turned(along * c, out * c, round_ * s), turned(along * s, out * s, -round_ * c)


def _seat(scene: Scene, bearing: SceneBearing[Scene]) -> Seat:
    """Return the pedestal of the body that carries a bearing's sensors, at the scene's own stiffness."""
    if not scene.assembly.joined or bearing.seat == "pedestal":
        own = bearing.scene
        mass = bodies.outer_ring(own).mass + bodies.housing(own).mass
        return _pedestal(own.mounted, mass, 0.0)
    body, middle = housing_of(scene)
    mass = body.mass + sum(bodies.outer_ring(one.scene).mass for one in scene.bearings())
    plane = 1e-3 * scene.assembly.own_mm(bearing.number - 1, middle)
    return _pedestal(set_of(scene).housing, mass, plane)


def _pedestal(given: Mounting | SetHousing, mass: float, plane: float) -> Seat:
    """Return a pedestal's matrices along x y z, as `mechanics.conditions` has them; ``mass``: on it (kg)."""
    radial, ratio = given.pedestal_stiffness_N_m or 0.0, given.pedestal_axial_ratio
    y, z, yz, *damped = pedestal_axes(given)
    critical = 2.0 * given.pedestal_damping_ratio * math.sqrt(radial * mass)
    return Seat(radial * _matrix(ratio, y, z, yz), critical * _matrix(math.sqrt(ratio), *damped), plane)


def _matrix(x: float, y: float, z: float, yz: float) -> Array:
    return np.array([[x, 0.0, 0.0], [0.0, y, yz], [0.0, yz, z]])
