"""Ratings and makers' limits of the bearing of a scene: which of them hold for its materials.

ISO 281, ISO 76 and ISO 16281 rate bearings with steel rings. Hybrid ones (steel rings, ceramic balls) have
the same C (ISO 20056-1), no modified life (ISO 16281:2025), and 0.7 of C0 at the same pressure (GMN). For
rings of ceramics there is no standard.
"""

import math
from typing import NamedTuple

from fmu_bearing.formulas import iso76, iso281, makers
from fmu_bearing.scene import Scene


class Rating(NamedTuple):
    """Load ratings (N) and life of a bearing with steel rings; ``static``: C0 by ISO 76 for steel balls."""

    dynamic: float
    static: float
    equivalent: float | None  # N: P, where the factors for its contact angle are known
    life: float | None  # h: L10


def kind(scene: Scene) -> str:
    """Return ``steel``, ``hybrid``, ``full ceramic`` or ``other``, by the materials' density and modulus."""
    materials = scene.materials
    steel = [
        7000.0 < one.density_kg_m3 < 8500.0 and 180.0 < one.youngs_modulus_GPa < 230.0
        for one in (materials.inner_ring, materials.outer_ring, materials.balls)
    ]
    ceramic = [
        one.density_kg_m3 < 6500.0 and one.youngs_modulus_GPa > 180.0
        for one in (materials.inner_ring, materials.outer_ring, materials.balls)
    ]
    if all(steel):
        return "steel"
    if all(steel[:2]) and ceramic[2]:
        return "hybrid"
    return "full ceramic" if all(ceramic) else "other"


def is_rated(scene: Scene) -> bool:
    """Whether ISO 281 and ISO 76 rate such a bearing: rings of steel, balls of steel or silicon nitride."""
    return kind(scene) in ("steel", "hybrid")


def dimensions(scene: Scene) -> tuple[int, float, float, float]:
    """Return number of balls, ball and pitch diameter (mm) and contact angle (rad), for the formulas."""
    bearing = scene.bearing
    angle = math.radians(bearing.contact_angle_deg)
    return bearing.ball_count, bearing.ball_diameter_mm, bearing.pitch_diameter_mm, angle


def rating(scene: Scene, axial: float, radial: float, speed_rpm: float) -> Rating | None:
    """Return C, C0, P and L10 at an axial and a radial load (N); None for rings that are not of steel.

    The life is that of a perfect bearing in clean oil.
    """
    if not is_rated(scene):
        return None
    size = dimensions(scene)
    dynamic, static = iso281.dynamic_rating(*size), iso76.static_rating(*size)
    factor = iso76.static_factor(iso281.relative_ball(*size[1:]))
    relative = factor * axial / static
    load = iso281.equivalent_load(scene.bearing.contact_angle_deg, relative, axial, radial)
    life = None
    if load is not None and load > 0.0 and speed_rpm != 0.0:
        life = iso281.hours(iso281.basic_life(dynamic, load), speed_rpm)
    return Rating(dynamic, static, load, life)


def speed_limit(scene: Scene) -> float | None:
    """Return the n d_m (mm r/min) to which makers run such a bearing with oil; None beyond 25 deg."""
    return makers.speed_limit(scene.bearing.contact_angle_deg, kind(scene) in ("hybrid", "full ceramic"))


def least_preload(scene: Scene, centrifugal: float) -> float:
    """Return the axial force (N) below which balls of this centrifugal force (N) skid, by GMN's catalogue."""
    return makers.least_preload(scene.bearing.ball_count, dimensions(scene)[3], centrifugal)


def preload_classes(scene: Scene) -> tuple[float, float, float]:
    """Return makers' preload over C of light, medium and heavy pairs."""
    return makers.preload_classes(scene.bearing.contact_angle_deg)
