"""The preload of a scene in newtons, where its file gives a class or an offset of the ring faces.

Both say how the loose bearings are ground: by how much the faces of the rings are offset, which the preload
closes. The bearings of a set are ground for a pair, and with flush faces the loads follow from the offsets.
"""

import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic import ValidationError

from fmu_bearing.formulas.makers import ANGLES, CLASS_NAMES, at_known_angle, preload_classes
from fmu_bearing.scene import nsk
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.material import Material, Materials
from fmu_bearing.scene.problems import shown

if TYPE_CHECKING:
    from fmu_bearing.formulas.axial import Axial

#: Keys of a scene's file that determine ``preload_N``.
CLASS, OFFSET, FORCE = "preload_class", "preload_offset_um", "preload_N"
#: Tables that have them: of one bearing, of a set.
TABLES = (("mounting",), ("spindle", "preload"))
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
        near = abs(bearing.nominal_angle_deg - size.angle) <= _NEAR
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
    angle = bearing.nominal_angle_deg
    if not at_known_angle(angle):
        return None
    rating = bearing.dynamic_rating
    shares = zip(CLASS_NAMES, preload_classes(angle), strict=True)
    return Classes("GMN", {name: float(f"{share * rating:.3g}") for name, share in shares})


def preload_table(data: Any, path: tuple[str, ...]) -> Any:
    """Return one of the `TABLES` of a scene's tables; None: there is none."""
    for key in path:
        data = data.get(key) if isinstance(data, Mapping) else None
    return data if isinstance(data, Mapping) else None


def carried(data: Any) -> list[Any]:
    """Return which way each bearing of a set carries, of a scene's tables; none of one bearing."""
    spindle = data.get("spindle")
    several = spindle.get("bearing") if isinstance(spindle, Mapping) else None
    members = several if isinstance(several, list | tuple) else ()
    return [member.get("carries") for member in members if isinstance(member, Mapping)]


def differing_preload(data: Mapping[str, Any], key: str) -> list[str]:
    """Return a line about a class or an offset, given at a key, of bearings that differ; none of equal ones.

    ``data``: a scene's tables, catalogue entries resolved.
    """
    spindle = data.get("spindle")
    members = spindle.get("bearing") if key.startswith("spindle") and isinstance(spindle, Mapping) else None
    for k, member in enumerate(members if isinstance(members, list | tuple) else (), start=1):
        own = member if isinstance(member, Mapping) else {}
        of_all, materials = data.get("materials"), own.get("materials") or {}
        same = own.get("bearing") in (None, data.get("bearing"))
        if isinstance(materials, Mapping) and isinstance(of_all, Mapping):
            same = same and all(one in (None, of_all.get(part)) for part, one in materials.items())
        if not same:
            return [
                f"{key} is of equal bearings, and spindle.bearing[{k}] has tables of its own: makers grind "
                f"pairs of one size; give {FORCE} in its place"
            ]
    return []


def preload_key(table: Mapping[str, Any], path: tuple[str, ...] = TABLES[0]) -> str | None:
    """Return the key that gives the preload in place of newtons; None: there is none.

    ``table``: as the file has it; ``path``: where it is, for messages.

    Raises
    ------
    PreloadError
        Where more than one key gives it, or springs do.
    """
    where = ".".join(path)
    given = [key for key in (FORCE, CLASS, OFFSET) if table.get(key) is not None]
    if len(given) > 1:
        raise PreloadError(
            f"{where}.{given[1]} = {shown(table[given[1]])} cannot be given with {given[0]}: "
            f"the preload is given by one of {FORCE}, {CLASS} and {OFFSET}; keep one"
        )
    if not given or given[0] == FORCE:
        return None
    if table.get("kind") == "spring":
        raise PreloadError(
            f"{where}.{given[0]} = {shown(table[given[0]])} is an offset of ring faces, which springs do not "
            'hold: leave it out and give force_N, or give kind = "spacer"'
        )
    return given[0]


def preload(
    table: Mapping[str, Any], bearing: Any, materials: Any, signs: Sequence[Any] = (),
    path: tuple[str, ...] = TABLES[0],
) -> Preload | None:  # fmt: skip
    """Return the preload that a class or an offset gives.

    Parameters
    ----------
    table : mapping
        As the file has it, with one of the keys.
    bearing, materials : Bearing and Materials, or their tables
    signs : sequence
        Of a set, ``carries`` of each bearing: the preload is the load of each bearing on the side with more.
    path : tuple of str
        Where the table is, for messages.

    Returns
    -------
    Preload or None
        None: bearing or materials have errors, which are reported elsewhere.

    Raises
    ------
    PreloadError
        For a class or an offset that is refused.
    """
    key, where = preload_key(table, path), ".".join(path)
    sides = sorted(Counter(map(str, signs)).values(), reverse=True)
    uneven = len(sides) == 2 and sides[0] > sides[1]
    try:
        rings = Bearing.model_validate(bearing)
        elastic = Materials.model_validate(materials) if key == OFFSET or uneven else None
    except ValidationError:
        return None
    if key == CLASS:
        preload_N = _of_class(table[CLASS], rings, f"{where}.{CLASS}")
    else:
        assert elastic is not None
        preload_N = _of_offset(table[OFFSET], rings, elastic, f"{where}.{OFFSET}")
    if not uneven:
        return preload_N
    assert elastic is not None
    from fmu_bearing.formulas.axial import flush_load  # with SciPy, which few scenes need

    more, fewer = sides
    load = flush_load(_axial(rings, elastic), preload_N.force, more, fewer)
    words = f"faces flush: {more} bearings of {load:.4g} N against {fewer} of {load * more / fewer:.4g} N"
    return Preload(load, f"{preload_N.words}; {words}")


def _refuse_deep_groove(bearing: Bearing, key: str) -> None:
    if bearing.is_deep_groove:
        raise PreloadError(f"{key} is of angular contact bearings, not of deep groove ones: give {FORCE}")


def _of_class(wanted: Any, bearing: Bearing, key: str) -> Preload:
    _refuse_deep_groove(bearing, key)
    by_class = classes(bearing)
    known = CLASS_NAMES if by_class is None else tuple(by_class.loads)
    if wanted not in known:
        more = "; extra light is a class of NSK's sizes" if wanted == "extra light" else ""
        raise PreloadError(f"{key} = {shown(wanted)} is refused; allowed: {', '.join(known)}{more}")
    angle = bearing.nominal_angle_deg
    if by_class is None:
        low, high = ANGLES
        raise PreloadError(
            f"{key} = '{wanted}' is known for contact angles of {low:g} to {high:g} deg, not for "
            f"{angle:g}: give {FORCE}"
        )
    force = by_class.loads[wanted]
    if by_class.maker == "NSK":
        return Preload(force, f"{wanted} class of NSK: {force:g} N")
    share = dict(zip(CLASS_NAMES, preload_classes(angle), strict=True))[wanted]
    rating = bearing.dynamic_rating
    return Preload(force, f"{wanted} class of GMN: {share:.3g} of C = {rating:.0f} N, {force:g} N")


def _of_offset(offset: Any, bearing: Bearing, materials: Materials, key: str) -> Preload:
    _refuse_deep_groove(bearing, key)
    number = isinstance(offset, int | float) and not isinstance(offset, bool)
    if not number or not 0.0 <= offset <= _MOST:
        raise PreloadError(f"{key} = {shown(offset)} is refused; allowed: 0 to {_MOST:g} um")
    from fmu_bearing.formulas.axial import axial_load

    force = axial_load(_axial(bearing, materials), 1e-3 * offset)
    most = bearing.most_preload
    if force > most:
        raise PreloadError(
            f"{key} = {shown(offset)} gives a preload of {force:.4g} N; allowed: up to {most:g} N"
        )
    return Preload(force, f"offset of {offset:g} um: {force:.4g} N")


def _axial(bearing: Bearing, materials: Materials) -> "Axial":
    """Return what the axial load of a bearing at rest depends on."""
    from fmu_bearing.formulas.axial import axial

    return axial(
        bearing.ball_count, bearing.ball_diameter_mm, bearing.pitch_diameter_mm, bearing.nominal_angle_deg,
        (bearing.inner_conformity, bearing.outer_conformity),
        (elastic_of(materials.inner_ring), elastic_of(materials.outer_ring), elastic_of(materials.balls)),
    )  # fmt: skip


def elastic_of(material: Material) -> tuple[float, float]:
    """Return modulus of elasticity (Pa) and Poisson's ratio of a material."""
    return 1e9 * material.youngs_modulus_GPa, material.poisson_ratio
