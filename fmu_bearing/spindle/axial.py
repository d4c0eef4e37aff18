"""Sets under axial load alone: which load unloads a bearing, how temperature changes preload."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from fmu_bearing.scene import si
from fmu_bearing.scene.member import set_of
from fmu_bearing.spindle.assembly import Assembly
from fmu_bearing.spindle.equilibrium import rest
from fmu_bearing.spindle.member import Member

_WARMER = 10.0  # K: inner rings and shaft against the housing; the spacing hardly depends on it
_REACH = 1e-3  # m: of a sliding ring; no load would press its bearing so far


@dataclass(frozen=True)
class LiftOff:
    """Axial load alone on the shaft that just unloads a bearing, at standstill.

    Attributes
    ----------
    load : float
        N along X: the sign tells the direction.
    bearing : int
        Which bearing is the first, from 1.
    """

    load: float
    bearing: int


def lift_off(assembled: Assembly) -> dict[str, LiftOff]:
    """Return the axial load that unloads the first bearing, by its direction ``+x`` and ``-x``.

    At standstill and the scene's temperatures, without other loads and weight: at speed centrifugal forces
    keep the balls of an unloaded bearing on both races, and its load fades without an end. Missing: a
    direction in which nothing is unloaded, as springs of constant force never let go.
    """
    found = {}
    for key, way in (("+x", 1.0), ("-x", -1.0)):
        # a bearing that carries the other way is unloaded when the shaft has gone this far
        reach = [
            (way * _free_at(assembled, k), k)
            for k, one in enumerate(assembled.members)
            if one.sign == -way
        ]  # fmt: skip
        reach = [one for one in reach if np.isfinite(one[0])]
        if reach and {one.sign for one in assembled.members} != {-way}:
            at, first = min(reach)
            load = sum(one.sign * _carried(assembled, k, way * at) for k, one in enumerate(assembled.members))
            found[key] = LiftOff(load, first + 1)
    return found


def _free_at(assembled: Assembly, k: int) -> float:
    """Place (m) of the shaft at which a bearing carries nothing; infinite where it follows the shaft."""
    one, slide = assembled.members[k], 0.0
    if k in assembled.springs:
        push, stiffness = assembled.springs[k]
        if push >= _REACH * stiffness:  # springs that soft never let go
            return -one.sign * np.inf
        slide = -push / stiffness
    return one.sign * (one.lifted() + slide - float(assembled.offsets[k]))


def _carried(assembled: Assembly, k: int, shaft: float) -> float:
    """Axial load (N) that a bearing carries with the shaft at a place (m)."""
    one = assembled.members[k]
    inner = one.sign * shaft + float(assembled.offsets[k])
    if k not in assembled.springs:
        return one.carried(inner, one.still())
    push, stiffness = assembled.springs[k]
    # between the spring without load and a bearing without one
    free = inner - one.lifted()
    low = free - _REACH
    if stiffness > 0.0:
        if free <= -push / stiffness:
            return 0.0
        low = max(low, -push / stiffness)

    def excess(slide: float) -> float:
        return one.carried(inner - slide, one.still()) - push - stiffness * slide

    if excess(low) <= 0.0:  # the bearing that lets go: both ends are one place
        return one.carried(inner - low, one.still())
    return one.carried(inner - float(brentq(excess, low, free, xtol=1e-14)), one.still())


def preloads(assembled: Assembly) -> dict[str, list[float]]:
    """Return what each bearing carries along its axis without load and weight, N.

    ``cold``: at standstill and 20 degC; ``warm``: at standstill and the scene's temperatures; ``running``: at
    its speed too. Empty for sets that carry one way.
    """
    members = assembled.members
    if len({one.sign for one in members}) == 1:
        return {}
    cold = replace(assembled, offsets=assembled.offsets - assembled.warming, warming=0.0 * assembled.warming)
    none = np.zeros(assembled.shaft.count)
    states = {
        "cold": rest(cold, none, [one.cold() for one in members]),
        "warm": rest(assembled, none, [one.still() for one in members]),
        "running": rest(assembled, none),
    }
    return {key: [-float(held.force[0]) for held in at.held] for key, at in states.items()}


def neutral_spacing(assembled: Assembly) -> float | None:
    """Distance (m) of the bearings' planes at which inner rings and shaft may warm up together.

    At standstill, from 20 degC: warm inner rings tighten spacer preload, a longer shaft loosens it where the
    bearings that carry +X stand ahead of those that carry -X. With bearings of one direction side by side the
    distance is that of both groups' middles. None for other sets and for springs.
    """
    spindle = set_of(assembled.scene)
    count = len(assembled.members)
    if assembled.springs or spindle.directions != "+" * (count // 2) + "-" * (count // 2):
        return None
    preload = spindle.preload
    if preload is None or not preload.preload_N:
        return None
    one: Member = assembled.members[0]
    material = spindle.shaft.material or assembled.scene.materials.inner_ring
    tightened = one.place_under(preload.preload_N, one.cold()) - one.place_under(
        preload.preload_N, one.warmer(_WARMER)
    )
    expansion = float(si(material).expansion)
    return 2.0 * tightened / (expansion * _WARMER) if expansion > 0.0 else None


def spacing(assembled: Assembly) -> float | None:
    """Distance (m) between the middles of the bearings that carry +X and of those that carry -X."""
    groups = [[one.position for one in assembled.members if one.sign == sign] for sign in (1.0, -1.0)]
    return abs(float(np.mean(groups[1]) - np.mean(groups[0]))) if all(groups) else None
