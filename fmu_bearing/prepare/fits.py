"""Fits of the rings on shaft and in housing as numbers: how interference moves the races."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.section import INNER, OUTER, ring_section
from fmu_bearing.engine.layout import P
from fmu_bearing.formulas.fits import Fit, Kind, Solid, fit
from fmu_bearing.scene import Scene, SceneError, si
from fmu_bearing.scene.fit import held_loose, housing_partner, interferences, shaft_partner
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.seats import Take

_CLOSE = 1e-12  # rad: contact angle of the loose bearing
_ROUNDS = 30


class Seat(NamedTuple):
    """One ring on its partner.

    Attributes
    ----------
    fit : Fit
        What an interference on the radius does, at any speed and temperatures.
    interference : float
        At standstill and 20 degC, on the radius, + tight (m).
    words : str
        Where it comes from.
    """

    fit: Fit
    interference: float
    words: str


def seats(scene: Scene, take: Take | None = None) -> tuple[Seat | None, Seat | None]:
    """Return how inner and outer ring of one bearing are seated; None: as drawn.

    ``take``: another interference than the scene takes, see `formulas.tolerances`. A bearing of a set is
    given as its own scene (`scene.member.one_of`).

    Raises
    ------
    SceneError
        For a ring whose section leaves no wall.
    """
    given = scene.fit
    if given is None:
        return None, None
    found = interferences(scene, take)
    shaft, housing = (
        Seat(_fit(scene, body, partner.long), 5e-7 * one.um, one.words) if one and partner else None
        for body, partner, one in zip((INNER, OUTER), (given.shaft, given.housing), found, strict=True)
    )
    return shaft, housing


def _fit(scene: Scene, body: int, long: bool) -> Fit:
    b, materials = si(scene.bearing), scene.materials
    try:
        contact = ring_section(scene, body).contact[1]
    except ValueError as problem:
        raise SceneError(f"{scene.name}: mounting.fit: {problem}") from None
    kind: Kind
    if body == INNER:
        kind, ring, (partner, other) = "inner", materials.inner_ring, shaft_partner(scene)
        seat, effective = b.bore / 2, b.inner_ring_outer_diameter / 2
    else:
        kind, ring, (partner, other) = "outer", materials.outer_ring, housing_partner(scene)
        seat, effective = b.outside_diameter / 2, b.outer_ring_inner_diameter / 2
    return fit(kind, seat, effective, contact, b.width, solid(ring), solid(partner), 0.5e-3 * other, long)


def solid(material: Material) -> Solid:
    """Return the constants of a material that fits depend on."""
    one = si(material)
    return Solid(one.youngs_modulus, one.poisson_ratio, one.density, one.expansion)


def loose(scene: Scene) -> Scene:
    """Return a scene whose contact angle is that of the loose bearing.

    Where the scene gives the angle of the mounted one, at standstill and 20 degC, the free angle a0 has
    cos a0 = cos a - (G_i - G_o)/A, with the growth G of the races and the distance A of the groove centres.
    """
    if scene.fit is None or scene.fit.contact_angle == "unmounted":
        return scene
    b = scene.bearing
    apart = 1e-3 * (b.inner_conformity + b.outer_conformity - 1.0) * b.ball_diameter_mm
    mounted = b.nominal_angle
    angle, changed = mounted, scene
    for _ in range(_ROUNDS):
        inner, outer = (
            0.0 if seat is None else seat.fit.share * max(seat.interference, 0.0) for seat in seats(changed)
        )
        before, angle = angle, math.acos(max(-1.0, min(1.0, math.cos(mounted) - (inner - outer) / apart)))
        turned = b.model_copy(update={"contact_angle_deg": math.degrees(angle)})
        changed = scene.model_copy(update={"bearing": turned})
        if abs(angle - before) < _CLOSE:
            break
    return changed


def write(scene: Scene, p: NDArray[np.float64]) -> None:
    """Write interference, its law and what it does to the races; nothing for rings as drawn.

    A partner without a temperature of its own has its ring's.
    """
    given = scene.fit
    if given is None:
        return
    p[P.FITS] = 1.0
    p[P.UNMOUNTED] = held_loose(scene)
    partners = given.shaft, given.housing
    for race, (seat, partner) in enumerate(zip(seats(scene), partners, strict=True)):
        if seat is None or partner is None:
            continue
        block, one = p[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE], seat.fit
        follows = partner.temperature_degC is None
        p[P.INTERFERENCE + race] = 2.0 * seat.interference
        block[P.RACE_FIT_RING] = one.ring + (one.partner if follows else 0.0)
        block[P.RACE_FIT_PARTNER] = 0.0 if follows else one.partner
        block[P.RACE_FIT_SPIN] = one.spin
        block[P.RACE_FIT_SHARE] = one.share
        block[P.RACE_SPIN] = one.race_spin
        block[P.RACE_FIT_PRESSURE] = one.pressure
        block[P.RACE_HOOP] = one.hoop
        block[P.RACE_SPIN_HOOP] = one.hoop_spin


def share(packed: list[NDArray[np.float64]]) -> None:
    """Let all bearings of a set have the first one's interference, which is tunable, and their own beyond."""
    first = packed[0]
    for p in packed[1:]:
        for race in range(2):
            own = P.RACES + race * P.RACE_SIZE + P.RACE_FIT_OWN
            p[own] = p[P.INTERFERENCE + race] - first[P.INTERFERENCE + race]
            p[P.INTERFERENCE + race] = first[P.INTERFERENCE + race]
