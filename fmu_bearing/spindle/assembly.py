"""All bearings of a set at their places on the shaft, preloaded; loads of the scene."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import GRAVITY, REFERENCE_TEMPERATURE
from fmu_bearing.prepare.bodies import inner_ring
from fmu_bearing.scene import Scene, SceneError, si
from fmu_bearing.scene.spindle import Spindle
from fmu_bearing.spindle.member import Member, placed


@dataclass(frozen=True)
class Assembly:
    """Bearings on a shaft.

    Attributes
    ----------
    scene : Scene
    members : tuple of Member
    offsets : ndarray
        Axial displacement (m) of each inner ring in its own axes with the shaft at zero, at the scene's
        temperatures.
    warming : ndarray
        What temperatures add to them.
    spring : tuple of float, optional
        Force (N) and stiffness (N/m) behind each sliding outer ring.
    """

    scene: Scene
    members: tuple[Member, ...]
    offsets: NDArray[np.float64]
    warming: NDArray[np.float64]
    spring: tuple[float, float] | None

    @property
    def sliding(self) -> list[int]:
        """Bearings whose outer rings slide, from 0."""
        return [k for k, one in enumerate(self.members) if one.place.seat == "sliding"]


def set_of(scene: Scene) -> Spindle:
    """Return the set of a scene.

    Raises
    ------
    SceneError
        For the scene of one bearing.
    """
    if scene.spindle is None:
        raise SceneError(
            f"{scene.name}: has one bearing on its mounting; a set of bearings needs [spindle] in the place "
            "of [mounting]"
        )
    return scene.spindle


def assembly(scene: Scene, speed: float) -> Assembly:
    """Return the bearings of a scene's set, preloaded at standstill and 20 degC, at the scene's temperatures.

    Parameters
    ----------
    scene : Scene
    speed : float
        Of the shaft, rad/s.
    """
    spindle = set_of(scene)
    members = tuple(Member(scene, one, speed) for one in spindle.bearing)
    expansion = _expansion(scene)
    preload, spring = spindle.preload, None
    asked = 0.0
    if preload is not None:
        asked = preload.force_N if preload.kind == "spring" else preload.preload_N  # type: ignore[assignment]
        spring = (asked, preload.stiffness_N_m or 0.0) if preload.kind == "spring" else None
    shares = _shares(spindle, asked)
    one_way = len({one.sign for one in members}) == 1
    places = {share: 0.0 if one_way else members[0].place_under(share, members[0].cold()) for share in shares}
    cold = np.array(
        [places[share] + 1e-6 * one.place.stickout_um for one, share in zip(members, shares, strict=True)]
    )
    warming = np.array([one.sign * one.position * expansion for one in members])
    return Assembly(scene, members, cold + warming, warming, spring)


def _shares(spindle: Spindle, asked: float) -> list[float]:
    """Preload (N) of each bearing; both directions carry the same in all.

    Springs give the load of each bearing that slides, spacers that of each on the side with more bearings.
    """
    signs = [one.sign for one in spindle.bearing]
    sliding = {one.sign for one in spindle.bearing if one.seat == "sliding"}
    count = {sign: signs.count(sign) for sign in signs}
    reference = sliding.pop() if sliding else max(count, key=lambda sign: count[sign])
    return [asked * count[reference] / count[sign] for sign in signs]


def _expansion(scene: Scene) -> float:
    """Strain of the shaft less that of the housing against 20 degC."""
    spindle, operation = set_of(scene), si(scene.operation)
    shaft, housing = si(spindle.shaft.model_copy(update={"sections_mm": None})), si(spindle.housing)
    strains = []
    for body, rings, ring in (
        (shaft, scene.materials.inner_ring, operation.inner_ring_temperature),
        (housing, scene.materials.outer_ring, operation.outer_ring_temperature),
    ):
        material = rings if body.material is None else body.material
        temperature = ring if body.temperature is None else body.temperature
        strains.append(si(material).expansion * (temperature - REFERENCE_TEMPERATURE))
    return float(strains[0] - strains[1])


def weight(scene: Scene) -> NDArray[np.float64]:
    """Weight of shaft and inner rings as loads x y z (N) and moments y, z (N m) at the nose.

    Zero where the scene leaves weight out.
    """
    spindle = set_of(scene)
    if not scene.fidelity.terms.gravity:
        return np.zeros(5)
    density = (spindle.shaft.material or scene.materials.inner_ring).density_kg_m3
    found, start = np.zeros(5), 0.0
    for length, diameter, bore in (tuple(1e-3 * x for x in one) for one in spindle.shaft.sections_mm):
        mass = density * math.pi / 4.0 * (diameter**2 - bore**2) * length
        found += at_plane(start + 0.5 * length, (0.0, 0.0, -GRAVITY * mass))
        start += length
    ring = inner_ring(scene).mass
    for one in spindle.bearing:
        found += at_plane(1e-3 * one.position_mm, (0.0, 0.0, -GRAVITY * ring))
    return found


def at_plane(
    position: float, force: tuple[float, float, float], moment: tuple[float, float] = (0.0, 0.0)
) -> NDArray[np.float64]:
    """Return force (N) and moment (N m) at a plane (m from the nose) as loads at the nose."""
    return placed(1.0, position).T @ np.array([*force, *moment])
