"""Fits of the rings of a scene: interferences by tolerance classes, the partners of the rings."""

from typing import NamedTuple

from fmu_bearing.formulas import tolerances
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.seats import HOUSING, SHAFT, SIDES, Fit, HousingFit, Seat, ShaftFit, Side, Take
from fmu_bearing.scene.shaft import Shaft

__all__ = [
    "Fit",
    "HousingFit",
    "Interference",
    "ShaftFit",
    "bore_at",
    "by_classes",
    "fit_of_member",
    "held_loose",
    "housing_outside",
    "housing_partner",
    "interferences",
    "of_seat",
    "partner_temperatures",
    "shaft_partner",
]

_LOSS = 0.4  # of the roughness Rz, on diameter, where interferences come from measured diameters


class Interference(NamedTuple):
    """Interference of a seat on diameter (um, + tight), and in words where it comes from."""

    um: float
    words: str


def interferences(
    scene: Tables, take: Take | None = None, member: int | None = None
) -> tuple[Interference | None, Interference | None]:
    """Return the interferences of shaft and housing; those by classes are less by what roughness takes.

    Parameters
    ----------
    scene : Scene
    take : str, optional
        Which of those that the classes allow; default: the one that the scene runs.
    member : int, optional
        Number of the bearing of a set, from 0; default: the first.

    Returns
    -------
    tuple
        For shaft and housing an `Interference`; None where the ring has no seat.

    Raises
    ------
    ToleranceError
        For classes and sizes without tolerances; no scene that was checked has them.
    """
    own = [own_interference(scene, side, member or 0) for side in SIDES]
    shaft, housing = (
        of_seat(scene, side, take) if um is None else _as_given(um)
        for side, um in zip(SIDES, own, strict=True)
    )
    return shaft, housing


def _as_given(um: float) -> Interference:
    return Interference(um, f"{um:g} um as given")


def of_seat(scene: Tables, side: Side, take: Take | None = None) -> Interference | None:
    """Return the interference that the table of a seat gives; None: there is no such seat.

    In a set it is that of the bearings without one of their own.
    """
    fit = scene.fit
    seat = None if fit is None else getattr(fit, side.seat)
    if fit is None or seat is None:
        return None
    if seat.interference_um is not None:
        return _as_given(seat.interference_um)
    wanted = take or fit.take
    um = by_classes(scene, side, wanted)
    low, high = by_classes(scene, side, "min"), by_classes(scene, side, "max")
    loss = _LOSS * seat.roughness_Rz_um
    words = (
        f"{getattr(seat, side.class_key)} on {fit.bearing_class}, {wanted} {um:.1f} um of {low:.1f} to "
        f"{high:.1f}"
    )
    return Interference(um - loss, words + (f", less by {loss:.2g} um of roughness" if loss else ""))


def own_interference(scene: Tables, side: Side, member: int) -> float | None:
    """Return the interference (um) that one bearing of a set has of its own; None: that of its table."""
    if not scene.members:
        return None
    one = scene.members[member]
    return one.shaft_interference_um if side is SHAFT else one.housing_interference_um


def by_classes(scene: Tables, side: Side, take: Take) -> float:
    """Return the interference (um) of a seat by its classes, before the loss by roughness.

    Raises
    ------
    ToleranceError
        For classes and sizes without tolerances.
    """
    fit, bearing = scene.fit, scene.bearing
    assert fit is not None and fit.bearing_class is not None, "classes without that of the bearing"
    wanted = getattr(getattr(fit, side.seat), side.class_key)
    if side is SHAFT:
        ring = tolerances.bore_limits(bearing.bore_mm, fit.bearing_class)
        return tolerances.interference(tolerances.shaft_limits(bearing.bore_mm, wanted), ring, take)
    ring = tolerances.outside_limits(bearing.outside_diameter_mm, fit.bearing_class)
    around = tolerances.housing_limits(bearing.outside_diameter_mm, wanted)
    return tolerances.interference(around, ring, take, housing=True)


def shaft_partner(scene: Tables, member: int | None = None) -> tuple[Material, float]:
    """Return material and bore (mm) of the shaft under an inner ring, of a set at a bearing from 0."""
    seat = None if scene.fit is None else scene.fit.shaft
    assert seat is not None, "an inner ring without a seat"
    shaft = scene.spindle and scene.spindle.shaft
    material = seat.material or (shaft and shaft.material)
    bore = seat.bore_mm
    if bore is None:
        bore = bore_at(scene, member or 0) if shaft and shaft.sections_mm else 0.0
    return material or scene.materials.inner_ring, bore


def bore_at(scene: Tables, member: int) -> float:
    """Return the bore (mm) of a set's shaft, given in sections, in the plane of a bearing from 0."""
    assert scene.spindle is not None
    place = scene.spindle.bearing[member].position_mm
    return _bore(scene.spindle.shaft, place)


def _bore(shaft: Shaft, place: float) -> float:
    end = 0.0
    for length, _, bore in shaft.sections_mm:
        end += length
        if place < end:
            return bore
    return shaft.sections_mm[-1][2]


def housing_partner(scene: Tables) -> tuple[Material, float]:
    """Return material and outside diameter (mm) of the housing around an outer ring."""
    seat = None if scene.fit is None else scene.fit.housing
    assert seat is not None, "an outer ring without a seat"
    housing = scene.spindle and scene.spindle.housing
    material = seat.material or (housing and housing.material)
    outside = housing_outside(scene)
    assert outside is not None, "a housing without a diameter"
    return material or scene.materials.outer_ring, outside


def fit_of_member(scene: Tables, member: int) -> Fit | None:
    """Return the fit of one bearing of a set, from 0, as that of a single one, defaults resolved."""
    fit = scene.fit
    if fit is None:
        return None
    seats: dict[str, Seat | None] = {"shaft": fit.shaft, "housing": fit.housing}
    partners = {
        "shaft": ("bore_mm", shaft_partner(scene, member) if fit.shaft is not None else None),
        "housing": ("outside_diameter_mm", housing_partner(scene) if fit.housing is not None else None),
    }
    for side in SIDES:
        seat, (key, partner) = seats[side.seat], partners[side.seat]
        if seat is None or partner is None:
            continue
        changes = {"material": partner[0], key: partner[1], "temperature_degC": _temperature(scene, side)}
        own = own_interference(scene, side, member)
        if own is not None:
            changes |= {"interference_um": own, side.class_key: None}
        seats[side.seat] = seat.model_copy(update=changes)
    return fit.model_copy(update=seats)


def housing_outside(scene: Tables) -> float | None:
    """Return the outside diameter (mm) of the housing around the seat: its own, or that of the body."""
    seat = None if scene.fit is None else scene.fit.housing
    if seat is not None and seat.outside_diameter_mm is not None:
        return seat.outside_diameter_mm
    body = None if scene.mount is None else scene.mount.housing
    return None if body is None else body.diameter_mm


def partner_temperatures(scene: Tables) -> tuple[float, float]:
    """Return the temperatures (degC) of shaft and housing at the start; absent: those of the rings."""
    return _temperature(scene, SHAFT), _temperature(scene, HOUSING)


def _temperature(scene: Tables, side: Side) -> float:
    part = getattr(scene.spindle or scene.fit, side.seat, None)  # of a set shaft and housing, else the seats
    own = part and part.temperature_degC
    ring: float = getattr(scene.operation, f"{side.ring}_ring_temperature_degC")
    return ring if own is None else own


def held_loose(scene: Tables) -> bool:
    """Whether a rigid or spacer preload is that of the loose bearing; bearings that just touch are, too."""
    return scene.fit is not None and scene.fit.preload != "mounted"
