"""Ratings and makers' limits of the bearing of a scene: which of them hold for its materials.

ISO 281, ISO 76 and ISO 16281 rate bearings with steel rings. Hybrid ones (steel rings, ceramic balls) have
the same C (ISO 20056-1), no modified life (ISO 16281:2025), and 0.7 of C0 at the same pressure (GMN). For
rings of ceramics there is no standard.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.formulas import iso76, iso281, iso16281, makers
from fmu_bearing.scene import Scene
from fmu_bearing.scene.dimension_series import series_of
from fmu_bearing.scene.preload import Classes, classes, nsk_size


class Rating(NamedTuple):
    """Load ratings (N) and life of a bearing with steel rings; ``static``: C0 by ISO 76 for steel balls."""

    dynamic: float
    static: float
    equivalent: float | None  # N: P, where the factors for its contact angle are known
    life: float | None  # h: L10
    static_load: float | None  # N: P0, likewise
    factors: tuple[float, float, float, float] | None = None  # e, X and Y of P, Y0 of P0


def unrated(scene: Scene) -> str:
    """Return why no standard rates such a bearing; empty: ISO 281 and ISO 76 do."""
    if not scene.materials.steel_rings:
        return "standards rate rings of steel only"
    own = scene.bearing.inner_conformity, scene.bearing.outer_conformity
    if any(value > limit for value, limit in zip(own, iso281.GROOVES, strict=True)):
        return (
            f"ratings hold up to conformities of {iso281.GROOVES[0]} (inner) and {iso281.GROOVES[1]} (outer)"
        )
    return ""


def is_rated(scene: Scene) -> bool:
    """Whether ISO 281 and ISO 76 rate such a bearing."""
    return not unrated(scene)


def rating(scene: Scene, axial: float, radial: float, speed_rpm: float) -> Rating | None:
    """Return C, C0, P and L10 at an axial and a radial load (N); None where `unrated` gives a reason.

    The life is that of a perfect bearing in clean oil.
    """
    if not is_rated(scene):
        return None
    size = scene.bearing.for_ratings
    dynamic, static = scene.bearing.dynamic_rating, iso76.static_rating(*size)
    factor = iso76.static_factor(iso281.relative_ball(*size[1:]))
    relative = factor * axial / static
    load = iso281.equivalent_load(scene.bearing.nominal_angle_deg, relative, axial, radial)
    life = None
    if load is not None and load > 0.0 and speed_rpm != 0.0:
        life = iso281.hours(iso281.basic_life(dynamic, load), speed_rpm)
    angle = scene.bearing.nominal_angle_deg
    still, steep = iso76.static_load(angle, axial, radial), iso76.axial_factor(angle)
    factors = iso281.factors(angle, relative)
    return Rating(
        dynamic, static, load, life, still, None if factors is None or steep is None else (*factors, steep)
    )


def speed_limit(scene: Scene) -> float | None:
    """Return the n d_m (mm r/min) to which makers run such a bearing with the supply of the scene.

    None but for rings of steel and 15 to 25 deg.
    """
    if not scene.materials.steel_rings:
        return None
    ceramic = scene.materials.kind == "hybrid"
    return makers.speed_limit(scene.bearing.nominal_angle_deg, ceramic, scene.lubricant.greased)


def least_load(scene: Scene, centrifugal: float, nu: float) -> float:
    """Return the load (N) below which balls skid.

    The axial force of angular contact bearings by GMN's catalogue, from the balls' centrifugal force (N); of
    deep groove ones SKF's least radial load, from the viscosity ``nu`` (mm2/s).
    """
    b = scene.bearing
    if b.is_deep_groove:
        series = series_of(b.bore_mm, b.outside_diameter_mm)
        return makers.least_radial(series, nu, scene.operation.speed_rpm, b.pitch_diameter_mm)
    return makers.least_preload(scene.bearing.ball_count, scene.bearing.for_ratings[3], centrifugal)


def unclassed(scene: Scene) -> str:
    """Return why no maker's preload class is for such a bearing; empty: there are classes."""
    if scene.bearing.is_deep_groove:
        return "makers' classes are for angular contact bearings"
    if not scene.materials.steel_rings:
        return "makers' classes are for rings of steel"
    if nsk_size(scene.bearing) is not None:
        return ""
    angle = scene.bearing.nominal_angle_deg
    if not makers.at_known_angle(angle):
        return f"makers' classes are for contact angles of 15 to 25 deg, not {angle:g}"
    return unrated(scene)  # GMN's classes are shares of C


def preload_classes(scene: Scene) -> Classes | None:
    """Return the preload classes of the loose bearing; None where `unclassed` has a reason."""
    return None if unclassed(scene) else classes(scene.bearing)


def reference_life(scene: Scene, inner: NDArray[np.float64], outer: NDArray[np.float64]) -> float | None:
    """Return L10r (Mrev) for the loads (N) of the balls at both races; None where no standard rates it.

    Grooves closer than the grooves of the rating count as these.
    """
    if not is_rated(scene):
        return None
    size = scene.bearing.for_ratings
    g = iso281.relative_ball(*size[1:])
    ratings = iso16281.race_ratings(scene.bearing.dynamic_rating, size[0], g, size[3], iso281.GROOVES)
    return iso16281.reference_life(ratings, inner, outer)
