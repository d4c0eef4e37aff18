"""What each part of the friction is worth: tables of the 7210B, of the 35 mm bearing, of new scenes."""

import math
from collections.abc import Sequence

import numpy as np

from benchmarks.measured import friction
from benchmarks.measured.friction import Moved
from benchmarks.measured.sources import of
from fmu_bearing import Scene, new_scene, operating_point
from fmu_bearing.prepare.contacts import race_contacts
from fmu_bearing.scene import read_scene_text, si

#: Bearings of the catalogue of which new scenes are compared.
FRESH = ("7003C", "7009C", "NSK-7010C")

_LAW, _HYSTERESIS = "lubricant.rolling_law", "fidelity.terms.rolling_hysteresis"
_ELASTIC: Moved = {_LAW: "houpert-1987-ehl", _HYSTERESIS: False}
_CHANGING: Moved = {_LAW: "starved", _HYSTERESIS: False}
_FLOODED: Moved = {_LAW: "flooded", "lubricant.replenishment_constant": 6e-8}
_NOW = "as assumed now"

#: Of the 7210B: each line alone beside the friction of today, which is in bold.
PARTS_7210B: dict[str, Moved] = {
    "EHL force of 1987 alone": _ELASTIC,
    "with the change to rigid surfaces": _CHANGING,
    f"with hysteresis: {_NOW}": {},
    "hysteresis loss 0.005": friction.MOVES_7210B["hysteresis loss 0.005"],
    "hysteresis loss 0.04": friction.MOVES_7210B["hysteresis loss 0.04"],
    "flooded inlets, K_rs 6e-8": _FLOODED,
    "conformities 0.515, 0.52": friction.MOVES_7210B["conformities 0.515, 0.52"],
    "conformities 0.52, 0.53": friction.MOVES_7210B["conformities 0.52, 0.53"],
}
_THICK: Moved = {"lubricant.land_viscosity_Pa_s": 0.006}
_BEFORE = {**_THICK, "lubricant.replenishment_constant": 6e-8, "lubricant.traction_max": 0.05}
#: Of the 35 mm bearing: a part more in every line, up to the friction of today.
PARTS_35: dict[str, Moved] = {
    "EHL force of 1987 alone, K_rs 6e-8, traction 0.05, 6 mPa s in the lands": {**_BEFORE, **_ELASTIC},
    "with the change to rigid surfaces": {**_BEFORE, **_CHANGING},
    "with flooded inlets, K_rs 3e-8": {**_THICK, "lubricant.traction_max": 0.05, _HYSTERESIS: False},
    "with hysteresis": {**_THICK, "lubricant.traction_max": 0.05},
    "with traction 0.04": _THICK,
    f"with the oil of the jets in the lands: {_NOW}": {},
}


def ratios_7210b(moved: Moved) -> np.ndarray:
    """Return the torque of the 7210B over SKF's, shape (27,)."""
    return np.array([friction.contact_torque(one, moved) / one.published for one in of("skf")])


def within(ratios: np.ndarray) -> int:
    """Return how many ratios are within 0.8 to 1.25."""
    return int(((ratios > 0.8) & (ratios < 1.25)).sum())


def table_7210b() -> tuple[Sequence[str], list[list[str]]]:
    """Return columns and rows of the 7210B."""
    rows = []
    for words, moved in PARTS_7210B.items():
        ratios = ratios_7210b(moved)
        span = f"{ratios.min():.2f} to {ratios.max():.2f}"
        rows.append([_strong(words, moved), f"{np.median(ratios):.3f}", span, f"{within(ratios)} of 27"])
    return ("rolling and sliding torque, ours over SKF's", "median", "range", "within 0.8 to 1.25"), rows


def table_35() -> tuple[Sequence[str], list[list[str]]]:
    """Return columns and rows of the 35 mm bearing; the last is of a cage that turns about the middle."""
    at = of("tp2275")
    steel, hybrid = (
        [[friction.heat_35(one, moved, kind) for one in at] for moved in PARTS_35.values()]
        for kind in friction.KINDS
    )
    named = [_strong(words, moved) for words, moved in PARTS_35.items()]
    for kind, heats in zip(friction.KINDS, (steel, hybrid), strict=True):
        heats.append([friction.centred_35(one, kind) for one in at])
    named.append("the same, were the cage in the middle of its clearance")
    rows = []
    for words, one, other in zip(named, steel, hybrid, strict=True):
        over = ", ".join(f"{heat / value.published:.2f}" for heat, value in zip(one, at, strict=True))
        light = ", ".join(f"{b / a:.2f}" for a, b in zip(one, other, strict=True))
        speeds = [value.speed_rpm for value in at]
        rows.append([words, over, f"{friction.exponent(speeds, one):.2f}", light])
    thousands = ", ".join(f"{1e-3 * one.speed_rpm:.0f}" for one in at)
    head = (
        "heat of the 35 mm bearing",
        f"ours over measured at {thousands} thousand r/min",
        "exponent of the speed",
        "hybrid over steel",
    )
    return head, rows


def table_fresh() -> tuple[Sequence[str], list[list[str]]]:
    """Return columns and rows of the torque of new scenes, N mm."""
    rows = []
    for name in FRESH:
        scene = fresh(name)
        before, changing, now = (
            1e3 * operating_point(scene.replace(moved)).bearings[0].friction_torque
            for moved in (_ELASTIC, {_HYSTERESIS: False}, {})
        )
        condition = f"{scene.operation.speed_rpm:,.0f} r/min, {scene.mounted.preload_N:g} N"
        rows.append([
            f"{name}, {scene.materials.kind}", condition, f"{before:.1f}", f"{changing - before:+.1f}",
            f"{now - changing:+.1f}", f"{now:.1f}", f"{100.0 * (now / before - 1.0):+.0f} %",
        ])  # fmt: skip
    head = ("new scene", "at", "before", "change to rigid surfaces", "hysteresis", "now", "in all")
    return head, rows


def fresh(name: str) -> Scene:
    """Return the scene that `scene new` writes for a bearing of the catalogue."""
    return read_scene_text(new_scene(name, name, kind="hybrid", sound=False))


def radii_over_ellipticity(scene: Scene) -> list[float]:
    """Return what Houpert's force grows by, inner and outer race, where the ratio of the radii is taken.

    It goes with the power 0.348 of R_y/R_x, in whose place the ellipticity was.
    """
    b = si(scene.bearing)
    gamma = b.ball_diameter * math.cos(b.contact_angle) / b.pitch_diameter
    grown = []
    for contact, conformity, side in zip(
        race_contacts(scene), (b.inner_conformity, b.outer_conformity), (-1.0, 1.0), strict=True
    ):
        ratio = 2.0 * conformity / (2.0 * conformity - 1.0) / (1.0 + side * gamma)
        grown.append((ratio / contact.ellipticity) ** 0.348)
    return grown


def _strong(words: str, moved: Moved) -> str:
    return words if moved else f"**{words}**"
