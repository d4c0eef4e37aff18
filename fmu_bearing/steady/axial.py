"""Sets under axial load alone: which load unloads a bearing, which spacing keeps the preload."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.member import SceneBearing, set_of
from fmu_bearing.steady.member import Member

_WARMER = 10.0  # K: inner rings and shaft against the housing; the spacing hardly depends on it
_REACH = 1e-3  # m: of a sliding ring; no load would press its bearing so far


@dataclass(frozen=True)
class LiftOff:
    """Axial load alone on the shaft that just unloads a bearing, at standstill.

    Attributes
    ----------
    load : float
        N along X: the sign gives the direction.
    bearing : int
        Which bearing is the first, from 1.
    """

    load: float
    bearing: int


def lift_off(members: Sequence[Member]) -> dict[str, LiftOff]:
    """Return the axial load that unloads the first bearing, by its direction ``+x`` and ``-x``.

    At standstill and the temperatures of the bearings, without other loads and weight: at speed centrifugal
    forces keep the balls of an unloaded bearing on both races, and its load fades without an end. Missing: a
    direction in which nothing is unloaded, as springs of constant force never unload their bearings.
    """
    loads = {}
    for key, way in (("+x", 1.0), ("-x", -1.0)):
        # a bearing that carries the other way is unloaded when the shaft has gone this far
        reach = [(way * _free_at(member), k) for k, member in enumerate(members) if member.sign == -way]
        reach = [one for one in reach if np.isfinite(one[0])]
        if reach and {member.sign for member in members} != {-way}:
            at, first = min(reach)
            load = sum(member.sign * _carried(member, way * at) for member in members)
            loads[key] = LiftOff(load, first + 1)
    return loads


def _free_at(one: Member) -> float:
    """Place (m) of the shaft at which a bearing carries nothing; infinite where it follows the shaft."""
    slide = 0.0
    if one.spring is not None:
        spring_force, stiffness = one.spring
        if spring_force >= _REACH * stiffness:  # springs that soft never unload their bearing
            return -one.sign * np.inf
        slide = -spring_force / stiffness
    return one.sign * (one.lifted() + slide - one.offset)


def _carried(one: Member, shaft: float) -> float:
    """Axial load (N) that a bearing carries with the shaft at a place (m)."""
    inner = one.sign * shaft + one.offset
    if one.spring is None:
        return one.carried(inner)
    spring_force, stiffness = one.spring
    # between the spring without load and a bearing without one
    free = inner - one.lifted()
    low = free - _REACH
    if stiffness > 0.0:
        if free <= -spring_force / stiffness:
            return 0.0
        low = max(low, -spring_force / stiffness)

    def excess(slide: float) -> float:
        return one.carried(inner - slide) - spring_force - stiffness * slide

    if excess(low) <= 0.0:  # the bearing that is unloaded: both ends are one place
        return one.carried(inner - low)
    return one.carried(inner - float(brentq(excess, low, free, xtol=1e-14)))


def neutral_spacing(scene: Scene, members: Sequence[Member]) -> float | None:
    """Distance (m) of the bearings' planes at which inner rings and shaft may warm up together.

    At standstill, from 20 degC: warm inner rings tighten spacer preload, a longer shaft loosens it where the
    bearings that carry +X are ahead of the others. With bearings of one direction side by side the
    distance is that of both groups' middles. None for other sets and for springs.
    """
    spindle = set_of(scene)
    count = len(members)
    if any(one.spring is not None for one in members) or spindle.directions != "+" * (count // 2) + "-" * (
        count // 2
    ):
        return None
    preload = spindle.preload
    if preload is None or not preload.preload_N:
        return None
    if scene.differing and count > 2:
        return None  # each bearing of a side asks for another distance
    material = spindle.shaft.material or scene.materials.inner_ring
    tightened = [
        one.place_under(preload.preload_N, one.warmer(0.0))
        - one.place_under(preload.preload_N, one.warmer(_WARMER))
        for one in (members if scene.differing else members[:1])
    ]
    expansion = float(si(material).expansion)
    return 2.0 * float(np.mean(tightened)) / (expansion * _WARMER) if expansion > 0.0 else None


def spacing(bearings: Sequence[SceneBearing[Scene]]) -> float | None:
    """Distance (m) between the middles of the bearings that carry +X and of those that carry -X."""
    groups = [[bearing.position for bearing in bearings if bearing.sign == sign] for sign in (1, -1)]
    return abs(float(np.mean(groups[1]) - np.mean(groups[0]))) if all(groups) else None
