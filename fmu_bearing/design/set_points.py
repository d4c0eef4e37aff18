"""The bearings of a set at their operating points, without a run, and the life of all together."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.design.operating_point import OperatingPoint, figures, whirl_of
from fmu_bearing.design.verdicts import Judgement, Verdict, judged_life, verdicts
from fmu_bearing.formulas import iso281
from fmu_bearing.instance import Instance
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.modes.solve import may_grow, solved
from fmu_bearing.prepare.lengths import members
from fmu_bearing.prepare.model import prepare
from fmu_bearing.progress import Tell, silent
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.member import one_of, set_of, still_of
from fmu_bearing.scene.spindle import SetBearing
from fmu_bearing.spindle.statics import ShaftStatics, shaft_statics
from fmu_bearing.threads import one_thread

_SLOPE = 10.0 / 9.0  # Weibull's exponent of point contact: Lundberg and Palmgren (1947), ISO 281


@dataclass
class _Part:
    """Parameters and state of one bearing of a set."""

    p: NDArray[np.float64]
    s: NDArray[np.float64]


@one_thread
def operating_points(scene: SceneSource, tell: Tell = silent) -> tuple[OperatingPoint, ...]:
    """Return the figures of each bearing of a set at the scene's operating point, without a run.

    Each stands where the set's shaft puts it, under its own load and at its own temperatures. Its scene is
    that of a single bearing; its preload is what it carries loose, at standstill and 20 degC without load on
    the shaft, by a constant force behind springs and by displacement with spacers; 0 in a set without one.
    Friction torques are those at the start of fidelity full.

    Raises
    ------
    SceneError
        If the file cannot be read or has no set.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import operating_points
    >>> for point in operating_points("examples/spindle_set/7003C-DB.toml"):
    ...     print(f"{1e-9 * point.contacts['inner']['pressure_max']:.2f} GPa")
    1.54 GPa
    1.17 GPa
    """
    scene = scene_of(scene)
    spindle = set_of(scene)
    quiet = still_of(scene)
    statics = shaft_statics(quiet)
    run = Instance(prepare(quiet, fidelity="full"), tell=tell)
    run.initialise()
    found = []
    for b, (place, carried) in enumerate(zip(spindle.bearing, statics.bearings, strict=True)):
        at_p, at_s = members(run.p)[b]
        sign = place.sign

        def output(name: str, prefix: str = f"bearing[{b + 1}].", sign: int = sign) -> float:
            value = run.get(prefix + name)
            return sign * value if name.endswith("displacement.x") else value

        alone = _alone(quiet, b, place, statics)
        part = _Part(run.p[at_p], run.s[at_s])
        torque = run.get(f"bearing[{b + 1}].friction_torque")
        axial = max(0.0, carried.axial)
        found.append(figures(alone, part, output, axial, carried.radial, torque, carried.stiffness, True))
    system = linearised(quiet)
    whirl = whirl_of(solved(quiet, system)) if system.steady and may_grow(system.matrix) else None
    return tuple(replace(one, whirl=whirl, steady=system.steady) for one in found)


def _alone(scene: Scene, number: int, place: SetBearing, statics: ShaftStatics) -> Scene:
    """Return the scene of one bearing of a set with its preload and temperatures."""
    spindle, alone = set_of(scene), one_of(scene, number)
    cold = statics.preloads.get("cold")
    carried = 0.0 if cold is None else cold[number]
    spacer = spindle.preload is not None and spindle.preload.kind == "spacer"
    mounting = alone.mounted.model_copy(
        update={
            "preload_N": float(f"{max(carried, 0.0):.4g}"),
            "preload_mode": "rigid" if spacer else "force",
        }
    )
    rings = ("inner_ring_temperature_degC", "outer_ring_temperature_degC")
    given = {key: getattr(place, key) for key in rings if getattr(place, key) is not None}
    return alone.model_copy(
        update={"mounting": mounting, "operation": alone.operation.model_copy(update=given)}
    )


def life_of_set(points: Sequence[OperatingPoint]) -> float | None:
    """Return L10r (h) of all bearings of a set together; None where one has none or nothing turns.

    Ten of a hundred sets have lost a bearing by then: with lives L, the sum of L^(-10/9) is that of the set
    (Lundberg and Palmgren 1947; Weibull's exponent 10/9 of point contact, ISO 281).
    """
    lives = [point.reference_life for point in points]
    speed = points[0].scene.operation.speed_rpm
    if speed == 0.0 or any(one is None for one in lives):
        return None
    hours = [iso281.hours(one, speed) for one in lives if one is not None]
    total = sum(one**-_SLOPE for one in hours if math.isfinite(one))
    return float(total ** (-1.0 / _SLOPE)) if total > 0.0 else math.inf


def set_verdicts(found: ShaftStatics, points: Sequence[OperatingPoint]) -> list[Verdict]:
    """Return the verdicts on a set as a whole: its life, and how far its load is from lift-off.

    Parameters
    ----------
    found : ShaftStatics
        Under the scene's load.
    points : sequence of OperatingPoint
        Its bearings, as `operating_points` returns them.
    """
    return [*_life(found.scene, points), *_lift_off(found)]


def set_cautions(found: ShaftStatics, points: Sequence[OperatingPoint]) -> list[str]:
    """Return what a designer should look at: of the statics, of each bearing, of the set."""
    told = found.cautions()
    for number, point in enumerate(points, start=1):
        told += [f"bearing {number}: {one.advice}" for one in verdicts(point) if one.advice]
    return told + [one.advice for one in set_verdicts(found, points) if one.advice]


def _life(scene: Scene, points: Sequence[OperatingPoint]) -> Iterator[Verdict]:
    hours = life_of_set(points)
    if hours is not None and math.isfinite(hours):
        yield judged_life(
            "set_life", "L10r of all bearings together", hours, scene.operation.required_life_h,
            "Lundberg and Palmgren 1947, exponent 10/9",
            "relieve the bearing with the shortest life, or take a larger one",
        )  # fmt: skip


def _lift_off(found: ShaftStatics) -> Iterator[Verdict]:
    """Yield the load that unloads a bearing over the axial force given, where both are there."""
    force = float(found.load[0])
    first = found.lift_off.get("+x" if force > 0.0 else "-x") if force else None
    if first is None:
        return
    margin, advice = first.load / force, ""
    if margin < 1.0:
        advice = (
            f"axial load {abs(force):.0f} N: above the {abs(first.load):.0f} N that unload bearing "
            f"{first.bearing} at standstill: raise the preload, or give the loaded side more bearings"
        )
    judgement: Judgement = "change" if advice else "good"
    yield Verdict(
        "lift_off", "lift-off over axial load", margin, f"{margin:.1f}", "1",
        "axial load alone, standstill, temperatures of the scene", judgement, advice,
    )  # fmt: skip
