"""Sensitivity of a scene's figures to its assumed values, which are changed one by one.

Each changed scene is run with fidelity ``full`` from its own steady state, and its figures are compared
with those of the unchanged scene. A value is changed by a fifth down and up, or by the step in ``ASSUMED``
where a fifth would be too much or too little.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.prepare.sound_block import sound_blocks, sound_key
from fmu_bearing.progress import keeping
from fmu_bearing.results.base import Quantity, Result, Study
from fmu_bearing.results.table import machine, markdown
from fmu_bearing.run.metrics import INAUDIBLE, Figures, measure, of_kind
from fmu_bearing.scene import Scene, SceneError, SceneSource
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.values import value_at

SHARE = 0.2

Moves = Callable[[Any], tuple[Any, Any]]


def by_share(value: float) -> tuple[float, float]:
    """Return a fifth less and a fifth more."""
    return (1.0 - SHARE) * value, (1.0 + SHARE) * value


def conformity(value: float) -> tuple[float, float]:
    """Return a groove radius over ball diameter whose excess over one half is a fifth less, and more."""
    return 0.5 + (1.0 - SHARE) * (value - 0.5), 0.5 + (1.0 + SHARE) * (value - 0.5)


def by(step: float) -> Moves:
    """Return a move by ``step`` in the value's own unit, or to whole neighbours."""
    return lambda value: (value - step, value + step)


def to(first: Any, second: Any) -> Moves:
    """Return a move to two given values."""
    return lambda value: (first, second)


#: Dotted key of the scene, and how it is moved.
ASSUMED: dict[str, Moves] = {
    "bearing.pitch_diameter_mm": by(0.1),
    "bearing.inner_conformity": conformity,
    "bearing.outer_conformity": conformity,
    "bearing.inner_ring_outer_diameter_mm": by(0.2),  # more would close a land clearance taken from it
    "bearing.outer_ring_inner_diameter_mm": by(0.5),
    "bearing.contact_damping_us": by_share,
    "bearing.race_roughness_um": by_share,
    "bearing.ball_roughness_um": by_share,
    "bearing.cage.bore_mm": by(0.2),
    "bearing.cage.land_clearance_mm": by_share,
    "bearing.cage.mass_eccentricity_um": to(0.0, 20.0),
    "bearing.cage.pocket_damping_N_s_m": by_share,
    "bearing.cage.pocket_friction": by_share,
    "lubricant.viscosity_Pa_s": by_share,
    "lubricant.pressure_viscosity_1_GPa": by_share,
    "lubricant.density_kg_m3": by_share,
    "lubricant.vogel_B_K": by_share,
    "lubricant.vogel_C_K": by_share,
    "lubricant.walther_slope": by_share,
    "lubricant.eyring_stress_MPa": by_share,
    "lubricant.traction_max": by_share,
    "lubricant.traction_slide_to_roll": by_share,
    "lubricant.traction_floor_m_s": by_share,
    "lubricant.land_viscosity_Pa_s": by_share,
    "lubricant.supply": to("oil-air", "jet"),
    "lubricant.replenishment_constant": by_share,
    "lubricant.replenishment_held": to(False, True),
    "lubricant.oil_air_density_kg_m3": by_share,
    "lubricant.drag_coefficient": by_share,
    "mounting.pedestal_stiffness_N_m": by_share,
    "mounting.pedestal_stiffness_ratio": by_share,
    "mounting.pedestal_axial_ratio": by_share,
    "mounting.pedestal_rotational_ratio_mm2": by_share,
    "mounting.pedestal_damping_ratio": by_share,
    "mounting.rotor.mass_kg": by_share,
    "mounting.rotor.length_mm": by_share,
    "mounting.rotor.diameter_mm": by_share,
    "mounting.tilt_support.stiffness_N_m_rad": by_share,
    "mounting.tilt_support.damping_ratio": by_share,
    "mounting.flexure.outer_ring": to((2, 3, 4), (2, 3)),
    "mounting.flexure.inner_ring": to((2,), ()),
    "mounting.flexure.damping_ratio": by_share,
    "mounting.flexure.outer_seat_stiffness_N_m": to(1e6, 1e7),
    "mounting.flexure.inner_seat_stiffness_N_m": to(1e6, 1e7),
    "mounting.housing.mass_kg": by_share,
    "mounting.housing.diameter_mm": by(5.0),
    "mounting.housing.length_mm": by_share,
    "mounting.housing.front_face_mm": by_share,
    "spindle.housing.mass_kg": by_share,
    "spindle.housing.diameter_mm": by(5.0),
    "spindle.housing.length_mm": by_share,
    "spindle.housing.pedestal_stiffness_N_m": by_share,
    "spindle.housing.pedestal_stiffness_ratio": by_share,
    "spindle.housing.pedestal_axial_ratio": by_share,
    "spindle.housing.pedestal_rotational_ratio_mm2": by_share,
    "spindle.housing.pedestal_damping_ratio": by_share,
    "spindle.housing.temperature_degC": by(10.0),
    "spindle.tilt_support.stiffness_N_m_rad": by_share,
    "spindle.tilt_support.damping_ratio": by_share,
    "spindle.shaft.temperature_degC": by(10.0),
    "spindle.shaft.damping_ratio": by_share,
    "spindle.shaft.flexible": to(False, True),
    "spindle.preload.preload_N": by_share,
    "spindle.preload.force_N": by_share,
    "spindle.preload.stiffness_N_m": by_share,
    "spindle.flexure.outer_ring": to((2, 3, 4), (2, 3)),
    "spindle.flexure.inner_ring": to((2,), ()),
    "spindle.flexure.damping_ratio": by_share,
    "spindle.flexure.outer_seat_stiffness_N_m": to(1e6, 1e7),
    "spindle.flexure.inner_seat_stiffness_N_m": to(1e6, 1e7),
    "imperfections.seed": by(1),
    "imperfections.unbalance_um": by_share,
    "imperfections.ball_diameter_spread_nm": by_share,
    "imperfections.inner_race_amplitude_um": by_share,
    "imperfections.outer_race_amplitude_um": by_share,
    "imperfections.waviness_exponent": to(1.0, 1.6),
    "imperfections.order_scatter_seed": by(1),
    "imperfections.lowest_order": to(1, 3),
    "imperfections.highest_frequency_kHz": to(5.0, 20.0),
    "imperfections.contact_filter": to(False, True),
    "imperfections.ball_form_nm": to(40.0, 160.0),
    "imperfections.ball_waviness_nm": to(0.0, 20.0),
    "operation.oil_temperature_degC": by(20.0),
    "operation.inner_ring_temperature_degC": by(20.0),
    "operation.outer_ring_temperature_degC": by(20.0),
}
_OF_SET = (
    " Unchanged figures are of bearing 1, the torque of the whole set; rings, loads and angles are those "
    "of the bearing where they changed most."
)
#: Keys whose values follow from others where a scene leaves them out, and the attribute that has them.
_FOLLOWS = {
    "lubricant.traction_max": "largest_traction",
    "lubricant.land_viscosity_Pa_s": "viscosity_of_lands",
    "lubricant.replenishment_constant": "replenishment",
}
QUICK = ("bearing.inner_conformity", "lubricant.traction_max", "lubricant.walther_slope")


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, int | float) else str(value)


def _change(place: int, spec: str, head: str, form: str = "+.2f", scale: float = 100.0) -> Quantity:
    return Quantity(spec, head, form, scale, of=lambda row: row.changes[place] if row.changes else None)


@dataclass(frozen=True)
class Row(Result):
    """One changed value: the relative changes it causes, or the reason why there are none.

    ``changes``: of rms velocity of inner and outer ring, load, angle (rad), torque, cage speed, all but the
    angle relative, and of the level (dB) at the microphone where it changed most; NaN: does not apply. Of a
    set each is that of the bearing where it changed most, the cage speed that of the first.
    """

    quantities = (
        Quantity("key", "parameter"),
        Quantity("value", "value", _shown),
        Quantity("moved", "moved to", _shown),
        _change(0, "inner_ring_rms [1]", "inner ring rms, %"),
        _change(1, "outer_ring_rms [1]", "outer ring rms, %"),
        _change(2, "contact_load [1]", "contact load, %"),
        _change(3, "contact_angle_rad", "contact angle, deg", "+.3f", 180.0 / math.pi),
        _change(4, "friction_torque [1]", "friction torque, %"),
        _change(5, "cage_speed [1]", "cage speed, %"),
        _change(6, "sound_dBA", "sound, dB(A)", scale=1.0),
        Quantity("remark", "remark"),
    )

    key: str
    value: Any
    moved: Any
    changes: tuple[float, ...] = ()
    remark: str = ""


@dataclass(frozen=True)
class Sensitivity(Study):
    """Rows of one scene, and the figures of the unchanged scene."""

    quantities = "scene", "rpm", "warm_up_s", "window_s", "moves = rows"
    stem, row = "sensitivity", Row

    scene: str
    rpm: float
    warm_up: float
    window: float
    base: Figures
    rows: tuple[Row, ...]

    def records(self) -> tuple[Row, ...]:
        """Return the rows."""
        return self.rows

    def markdown(self) -> str:
        """Return the study as a page."""

        def first(end: str) -> float:
            return next(iter(of_kind(self.base, end)), 0.0)

        sound = ", ".join(f"{level:.1f}" for level in of_kind(self.base, ".leq_a"))
        return (
            f"# What rests on assumed values: {self.scene}, {self.rpm:,.0f} r/min\n\n{machine()}\n\n"
            "Made by `fmu-bearing sensitivity`. One value at a time, fidelity `full`, figures over "
            f"{1e3 * self.window:g} ms after {1e3 * self.warm_up:g} ms; sound by radiation model "
            f"`compact`. Unchanged: rms ring velocity {1e3 * first('inner_ring.velocity'):.3g} (inner) and "
            f"{1e3 * first('outer_ring.velocity'):.3g} mm/s (outer), contact load "
            f"{first('contact.inner.load_mean'):.4g} N, "
            f"contact angle {math.degrees(first('contact.inner.angle_mean')):.2f} deg "
            "(both inner race), "
            f"friction torque {1e3 * first('friction_torque'):.3g} N mm, cage speed "
            f"{first('cage.speed_ratio'):.4f} of the shaft's"
            + (f", sound {sound} dB(A) at the microphones" if sound else "")
            + ". The last column is that of the microphone where it changed most."
            + (_OF_SET if len(of_kind(self.base, ".load_mean")) > 2 else "")
            + "\n\n"
            + markdown(*self.table())
        )


def _value(scene: Scene, key: str) -> Any:
    """Value of a key, of one that the scene leaves to supply or base oil what these give; None: none."""
    follows = _FOLLOWS.get(key)
    return value_at(scene, key) if follows is None else getattr(scene.lubricant, follows)


def sensitivity(
    source: SceneSource,
    keys: Sequence[str] = tuple(ASSUMED),
    *,
    warm_up: float = 0.03,
    window: float = 0.06,
    track: Callable[[Sequence[tuple[str, Any]]], Iterable[tuple[str, Any]]] = iter,
) -> Sensitivity:
    """Change each of ``keys`` that the scene has, and compare the figures.

    Parameters
    ----------
    source : Scene or path
        Always computed with fidelity full. Radiation model bem is replaced by compact, because boundary
        elements would have to be solved again for every geometry.
    warm_up, window : float
        Time (s) of each run before its figures are taken, and over which they are taken.
    track : callable
        Wraps the changes (key and new value), for a progress bar.

    Raises
    ------
    EngineError
        If the engine refuses the unchanged scene.
    SceneError
        For bearings on another model's shaft.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with what is finished as ``found``.
    """
    scene = with_fidelity(source, model="full")
    require(scene, "sensitivity")
    if scene.sound is not None and scene.sound.radiation_model == "bem" and scene.sound.radiator != "baffle":
        scene = scene.replace({"sound.radiation_model": "compact", "sound.reflecting_plane_mm": None})
    blocks: dict[str, list[NDArray[np.float64]]] = {}
    base = measure(scene, _sound(scene, blocks), warm_up, window).figures
    moves = [
        (key, moved)
        for key in keys
        if (value := _value(scene, key)) is not None
        for moved in ASSUMED[key](value)
        if moved != value
    ]
    rows: list[Row] = []

    def study() -> Sensitivity:
        return Sensitivity(scene.name, scene.operation.speed_rpm, warm_up, window, base, tuple(rows))

    with keeping(rows, study):
        for key, moved in track(moves):
            value = _value(scene, key)
            try:
                other = scene.replace({key: moved})
            except SceneError:
                rows.append(Row(key, value, moved, remark="the scene does not allow it"))
                continue
            try:
                figures = measure(other, _sound(other, blocks), warm_up, window).figures
            except ValueError as problem:
                rows.append(Row(key, value, moved, remark=str(problem)))
                continue
            rows.append(Row(key, value, moved, changes(figures, base)))
    return study()


def changes(found: Figures, base: Figures) -> tuple[float, ...]:
    """Return what ``Row.changes`` holds, from the figures of two scenes.

    Rings, loads and angles of a set are those of the bearing where they changed most.
    """

    def of(value: float, before: float) -> float:
        return value / before - 1.0 if before else math.nan

    def pairs(end: str) -> list[tuple[float, float]]:
        return list(zip(of_kind(found, end), of_kind(base, end), strict=True))

    def most(end: str) -> float:
        """Largest relative change of one figure of all bearings; NaN where they do not have it."""
        return max((of(*pair) for pair in pairs(end)), key=abs, default=math.nan)

    angles = [a - b for a, b in pairs("contact.inner.angle_mean")]
    sound = [max(a, INAUDIBLE) - max(b, INAUDIBLE) for a, b in pairs(".leq_a")]
    return (
        most("inner_ring.velocity"),
        most("outer_ring.velocity"),
        most("contact.inner.load_mean"),
        max(angles, key=abs),
        most("friction_torque"),
        of(*(pairs("cage.speed_ratio") or [(math.nan, math.nan)])[0]),
        max(sound, key=abs, default=math.nan),
    )


def _sound(scene: Scene, blocks: dict[str, list[NDArray[np.float64]]]) -> list[NDArray[np.float64]]:
    """Sound blocks of a scene's bearings, computed once for all scenes that radiate in the same way."""
    if scene.sound is None:
        return []
    key = sound_key(scene)
    if key not in blocks:
        blocks[key] = sound_blocks(scene)
    return blocks[key]
