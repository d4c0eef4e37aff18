"""All bearings of a set at their places on the shaft, preloaded; loads of the scene."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import ShaftModel, shaft_model
from fmu_bearing.engine.constants import GRAVITY, REFERENCE_TEMPERATURE
from fmu_bearing.prepare.bodies import inner_ring
from fmu_bearing.prepare.spindle import expansions
from fmu_bearing.scene import Scene, SceneError, si
from fmu_bearing.scene.member import set_of, shares
from fmu_bearing.scene.units import convert
from fmu_bearing.spindle.member import Member
from fmu_bearing.spindle.supports import Supports, axial_springs, supports


@dataclass(frozen=True)
class Assembly:
    """Bearings on a shaft.

    Attributes
    ----------
    scene : Scene
    shaft : ShaftModel
    members : tuple of Member
    supports : Supports
        What holds the outer rings and gives way.
    offsets : ndarray
        Axial displacement (m) of each inner ring in its own axes with the shaft at zero, at the scene's
        temperatures.
    warming : ndarray
        What temperatures add to them.
    springs : dict
        Force (N) and stiffness (N/m) behind each outer ring that gives way along its axis by itself, by its
        bearing from 0: sliding ones and those on pedestals.
    """

    scene: Scene
    shaft: ShaftModel
    members: tuple[Member, ...]
    supports: Supports
    offsets: NDArray[np.float64]
    warming: NDArray[np.float64]
    springs: dict[int, tuple[float, float]]


def assembly(scene: Scene, speed: float) -> Assembly:
    """Return the bearings of a scene's set, preloaded at standstill and 20 degC, at the scene's temperatures.

    Parameters
    ----------
    scene : Scene
    speed : float
        Of the shaft, rad/s.
    """
    spindle = set_of(scene)
    if spindle.shaft.external:
        raise SceneError(
            f"{scene.name}: another model owns the shaft (spindle.shaft.external): where it rests is not "
            "known here"
        )
    members = tuple(Member(scene, one, speed) for one in spindle.bearing)
    expansion = _strain(scene)
    preload, spring = spindle.preload, None
    asked = 0.0
    if preload is not None:
        asked = preload.force_N if preload.kind == "spring" else preload.preload_N  # type: ignore[assignment]
        spring = (asked, preload.stiffness_N_m or 0.0) if preload.kind == "spring" else None
    loads = [share * asked for share in shares(spindle)]
    springs = axial_springs(spindle, spring)
    one_way = len({one.sign for one in members}) == 1
    places = {load: 0.0 if one_way else members[0].place_under(load, members[0].cold()) for load in loads}
    cold = np.array(
        [places[load] + 1e-6 * one.place.stickout_um for one, load in zip(members, loads, strict=True)]
    )
    for k, one in enumerate(members):
        if one.place.seat == "pedestal" and not one_way:
            cold[k] += loads[k] / springs[k][1]
    warming = np.array([one.sign * one.position * expansion for one in members])
    behind = supports(scene, spindle, members, spring)
    return Assembly(scene, shaft_model(scene, spindle), members, behind, cold + warming, warming, springs)


def _strain(scene: Scene) -> float:
    """Strain of the shaft less that of the housing against 20 degC."""
    spindle, operation = set_of(scene), si(scene.operation)
    given = (
        (spindle.shaft.temperature_degC, operation.inner_ring_temperature),
        (spindle.housing.temperature_degC, operation.outer_ring_temperature),
    )
    rises = [(ring if own is None else convert(own, "_degC")) - REFERENCE_TEMPERATURE for own, ring in given]
    shaft, housing = expansions(scene)
    return float(shaft * rises[0] - housing * rises[1])


def weight(assembled: Assembly) -> NDArray[np.float64]:
    """Return the weight of shaft and inner rings as loads on the shaft's coordinates, N.

    Zero where the scene leaves weight out.
    """
    scene, shaft = assembled.scene, assembled.shaft
    if not scene.fidelity.terms.gravity:
        return np.zeros(shaft.count)
    found = -GRAVITY * shaft.heavy
    for plane in shaft.planes:
        found -= GRAVITY * inner_ring(scene).mass * plane[2]
    return found
