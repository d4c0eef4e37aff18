"""The preload of a scene in newtons, where its file gives a class or an offset of the ring faces."""

import tomllib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import ValidationError

from fmu_bearing.formulas.iso281 import dynamic_rating
from fmu_bearing.formulas.makers import ANGLES, CLASS_NAMES, at_known_angle, preload_classes
from fmu_bearing.scene import nsk
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.material import Material, Materials
from fmu_bearing.scene.mounting import Mounting
from fmu_bearing.scene.problems import shown
from fmu_bearing.scene.values import limits

if TYPE_CHECKING:
    from fmu_bearing.formulas.axial import Axial

#: Keys of a scene's file that determine ``preload_N``.
CLASS, OFFSET, FORCE = "preload_class", "preload_offset_um", "preload_N"
_NEAR = 1.0  # deg: how far off the printed angle a measured one may be
_MOST = 200.0  # um: more than any ball of a scene takes


class Preload(NamedTuple):
    """A preload (N), and in words where it comes from."""

    force: float
    words: str


class PreloadError(ValueError):
    """No preload follows from what is given; the message begins with the key."""


class Classes(NamedTuple):
    """Preload classes of the loose bearing: whose they are, and N by name, from the lightest on."""

    maker: str
    loads: dict[str, float]


#: What of a catalogue entry makes a bearing of another designation the same one: its balls and grooves.
_INSIDE = ("ball_diameter_mm", "ball_count", "inner_conformity", "outer_conformity")


def nsk_size(bearing: Bearing) -> nsk.Size | None:
    """Return the size of NSK that a bearing is: by its designation, or by the balls and grooves of the entry.

    Its boundary dimensions have to be the printed ones, its contact angle within a degree.
    """
    shape = bearing.bore_mm, bearing.outside_diameter_mm, bearing.width_mm
    for size in nsk.sizes().values():
        near = abs(bearing.contact_angle_deg - size.angle) <= _NEAR
        if near and shape == (size.bore, size.outside, size.width):
            if bearing.designation == size.name:
                return size
            entry = tomllib.loads(nsk.entry_text(size))[size.name]
            if all(getattr(bearing, key) == entry[key] for key in _INSIDE):
                return size
    return None


def classes(bearing: Bearing) -> Classes | None:
    """Return the preload classes of a bearing: NSK's printed ones for its sizes, else GMN's shares of C.

    The latter have three digits. None at contact angles of which no maker gives classes.
    """
    size = nsk_size(bearing)
    if size is not None:
        return Classes("NSK", {name: one.force for name, one in size.preload.items()})
    angle = bearing.contact_angle_deg
    if not at_known_angle(angle):
        return None
    rating = dynamic_rating(*bearing.for_ratings)
    shares = zip(CLASS_NAMES, preload_classes(angle), strict=True)
    return Classes("GMN", {name: float(f"{share * rating:.3g}") for name, share in shares})


def preload_key(mounting: Mapping[str, Any]) -> str | None:
    """Return the key that gives the preload in place of newtons; None: there is none.

    Raises
    ------
    PreloadError
        Where more than one key gives it.
    """
    given = [key for key in (FORCE, CLASS, OFFSET) if mounting.get(key) is not None]
    if len(given) > 1:
        raise PreloadError(
            f"mounting.{given[1]} = {shown(mounting[given[1]])} cannot be given with {given[0]}: "
            f"the preload is given by one of {FORCE}, {CLASS} and {OFFSET}; keep one"
        )
    return given[0] if given and given[0] != FORCE else None


def preload(mounting: Mapping[str, Any], bearing: Any, materials: Any) -> Preload | None:
    """Return the preload that a class or an offset gives.

    Parameters
    ----------
    mounting : mapping
        As the file has it, with one of the keys.
    bearing, materials : Bearing and Materials, or their tables

    Returns
    -------
    Preload or None
        None: bearing or materials have errors, which are reported elsewhere.

    Raises
    ------
    PreloadError
        For a class or an offset that is refused.
    """
    key = preload_key(mounting)
    try:
        rings = Bearing.model_validate(bearing)
        elastic = Materials.model_validate(materials) if key == OFFSET else None
    except ValidationError:
        return None
    if elastic is None:
        return _of_class(mounting[CLASS], rings)
    return _of_offset(mounting[OFFSET], rings, elastic)


def _of_class(wanted: Any, bearing: Bearing) -> Preload:
    found = classes(bearing)
    known = CLASS_NAMES if found is None else tuple(found.loads)
    if wanted not in known:
        more = "; extra light is a class of NSK's sizes" if wanted == "extra light" else ""
        raise PreloadError(
            f"mounting.{CLASS} = {shown(wanted)} is refused; allowed: {', '.join(known)}{more}"
        )
    angle = bearing.contact_angle_deg
    if found is None:
        low, high = ANGLES
        raise PreloadError(
            f"mounting.{CLASS} = '{wanted}' is known for contact angles of {low:g} to {high:g} deg, not for "
            f"{angle:g}: give {FORCE}"
        )
    force = found.loads[wanted]
    if found.maker == "NSK":
        return Preload(force, f"{wanted} class of NSK: {force:g} N")
    share = dict(zip(CLASS_NAMES, preload_classes(angle), strict=True))[wanted]
    rating = dynamic_rating(*bearing.for_ratings)
    return Preload(force, f"{wanted} class of GMN: {share:.3g} of C = {rating:.0f} N, {force:g} N")


def _of_offset(offset: Any, bearing: Bearing, materials: Materials) -> Preload:
    number = isinstance(offset, int | float) and not isinstance(offset, bool)
    if not number or not 0.0 <= offset <= _MOST:
        raise PreloadError(f"mounting.{OFFSET} = {shown(offset)} is refused; allowed: 0 to {_MOST:g} um")
    from fmu_bearing.formulas.axial import axial_load  # with SciPy, which few scenes need

    force = axial_load(_axial(bearing, materials), 1e-3 * offset)
    most = limits(Mounting.model_fields[FORCE])[1]
    if force > most:
        raise PreloadError(
            f"mounting.{OFFSET} = {shown(offset)} gives a preload of {force:.4g} N; allowed: up to {most:g} N"
        )
    return Preload(force, f"offset of {offset:g} um: {force:.4g} N")


def _axial(bearing: Bearing, materials: Materials) -> "Axial":
    """Return what the axial load of a bearing at rest depends on."""
    from fmu_bearing.formulas.axial import axial

    return axial(
        bearing.ball_count, bearing.ball_diameter_mm, bearing.pitch_diameter_mm, bearing.contact_angle_deg,
        (bearing.inner_conformity, bearing.outer_conformity),
        (_elastic(materials.inner_ring), _elastic(materials.outer_ring), _elastic(materials.balls)),
    )  # fmt: skip


def _elastic(material: Material) -> tuple[float, float]:
    return 1e9 * material.youngs_modulus_GPa, material.poisson_ratio
