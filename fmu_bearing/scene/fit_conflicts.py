"""What does not fit together with fits of the rings: refusals that need more than their own table."""

from collections.abc import Iterator

from fmu_bearing.formulas.tolerances import ToleranceError
from fmu_bearing.scene.base import Conflict
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.fit import bore_at, by_classes, housing_outside
from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.seats import (
    BEARING_CLASSES,
    SHAFT,
    SIDES,
    SMALLEST_RATIO,
    Fit,
    HousingFit,
    Seat,
    ShaftFit,
    Side,
)


def conflicts(tables: Tables) -> Iterator[Conflict]:
    """Yield fits that do not fit the other tables of a scene."""
    fit = tables.fit
    yield from _without_table(tables)
    if fit is None:
        return
    where = "mounting.fit" if tables.mounting is not None else "spindle.fit"
    for side in SIDES:
        seat = getattr(fit, side.seat)
        if seat is not None:
            yield from _given(tables, fit, seat, side, where)
            yield from _wall(tables, side, where)
            yield from _bending(tables, side, where)
            if tables.spindle is not None and seat.temperature_degC is not None:
                yield Conflict(
                    f"{where}.{side.seat}.temperature_degC",
                    f"is of a single bearing: give the {side.seat}'s temperature as "
                    f"spindle.{side.seat}.temperature_degC",
                )
    if fit.shaft is not None:
        yield from _shaft(tables, fit.shaft, where)
    if fit.housing is not None:
        yield from _housing(tables, fit.housing, where)
    yield from _preload(tables, fit, where)


def _geometries(tables: Tables) -> Iterator[tuple[str, Bearing, list[int]]]:
    """Yield key, geometry and the numbers from 0 of the bearings that have it; of a single one none."""
    own = [k for k, one in enumerate(tables.members) if one.bearing is not None]
    yield "bearing", tables.bearing, [k for k in range(len(tables.members)) if k not in own]
    for k in own:
        yield f"spindle.bearing[{k + 1}].bearing", tables.geometries[k], [k]


def _own(tables: Tables, side: Side) -> list[tuple[str, float | None]]:
    """Return key and value of what each bearing of a set has of its own."""
    key = f"{side.seat}_interference_um"
    members = enumerate(tables.members, start=1)
    return [(f"spindle.bearing[{k}].{key}", getattr(one, key)) for k, one in members]


def _without_table(tables: Tables) -> Iterator[Conflict]:
    """Yield interferences of single bearings of a set without the table that says what the partner is."""
    for side in SIDES:
        if tables.fit is None or getattr(tables.fit, side.seat) is None:
            for key, own in _own(tables, side):
                if own is not None:
                    yield Conflict(
                        key,
                        f"= {own:g} needs the table [spindle.fit.{side.seat}]: give it, or leave the key out",
                    )


def _given(tables: Tables, fit: Fit, seat: Seat, side: Side, where: str) -> Iterator[Conflict]:
    """Yield seats whose interference is not given, or is larger than any ring bears."""
    own = _own(tables, side)
    key = f"{where}.{side.seat}.{side.class_key}"
    wanted = getattr(seat, side.class_key)
    for place, bearing, numbers in _geometries(tables):
        diameter = getattr(bearing, side.diameter_key)
        most = 1e3 * diameter / SMALLEST_RATIO
        values = [(f"{where}.{side.seat}.interference_um", seat.interference_um, "")]
        mine = [own[k] for k in numbers]
        values += [(of_one, value, f"= {value:g} ") for of_one, value in mine if value is not None]
        for of_one, value, shown in values:
            if value is not None and abs(value) > most:
                yield Conflict(
                    of_one,
                    f"{shown}is beyond 1/500 of the seat's diameter {place}.{side.diameter_key} = "
                    f"{diameter:g}; allowed: {-most:g} to {most:g} um",
                )
        if wanted is not None:
            one = tables.model_copy(update={"bearing": bearing})
            yield from _by_classes(one, fit, side, key, most)
    if wanted is not None:
        return
    if seat.interference_um is None and not (own and all(value is not None for _, value in own)):
        example = "js4" if side is SHAFT else "JS5"
        each = f", or {side.seat}_interference_um to every [[spindle.bearing]]" if own else ""
        yield Conflict(
            key,
            f'is missing, for example {side.class_key} = "{example}"; or give interference_um = 2.0{each}',
        )


def _by_classes(tables: Tables, fit: Fit, side: Side, key: str, most: float) -> Iterator[Conflict]:
    """Yield classes without tolerances, or with interferences larger than any ring bears."""
    if fit.bearing_class is None:
        yield Conflict(
            f"{key.rsplit('.', 2)[0]}.bearing_class",
            f'is missing, for example bearing_class = "P4": {side.class_key} needs the tolerances of the '
            f"bearing, and [imperfections] names no grade of {', '.join(BEARING_CLASSES)}; or give "
            f"interference_um in the place of {side.class_key}",
        )
        return
    try:
        extremes = by_classes(tables, side, "min"), by_classes(tables, side, "max")
    except ToleranceError as problem:
        yield Conflict(key, f"is refused: {problem}")
        return
    worst = max(extremes, key=abs)
    if abs(worst) > most:
        yield Conflict(
            key,
            f"on {fit.bearing_class} reaches an interference of {worst:g} um, beyond 1/500 of the seat's "
            f"diameter, {most:g} um: take another class, or give interference_um",
        )


def _wall(tables: Tables, side: Side, where: str) -> Iterator[Conflict]:
    """Yield effective diameters inside the groove: a ring of such a section has no race."""
    for place, bearing, _ in _geometries(tables):
        if side is SHAFT:
            key, bottom = "inner_ring_outer_diameter_mm", bearing.pitch_diameter_mm - bearing.ball_diameter_mm
            wall, word = bearing.inner_ring_outer_diameter_mm - bottom, "exceed"
        else:
            key, bottom = "outer_ring_inner_diameter_mm", bearing.pitch_diameter_mm + bearing.ball_diameter_mm
            wall, word = bottom - bearing.outer_ring_inner_diameter_mm, "be below"
        if wall <= 0.0:
            yield Conflict(
                f"{place}.{key}",
                f"leaves no wall around the race: with [{where}.{side.seat}] the effective diameter must "
                f"{word} that of the race's bottom, {bottom:g} mm",
            )


def _bending(tables: Tables, side: Side, where: str) -> Iterator[Conflict]:
    """Yield rings that bend on a loose seat although a fit holds them."""
    flexure = None if tables.mount is None else tables.mount.flexure
    if flexure is None or not getattr(flexure, f"{side.ring}_ring"):
        return
    if getattr(flexure, f"{side.ring}_seat_stiffness_N_m") == 0.0:
        yield Conflict(
            f"{where.split('.')[0]}.flexure.{side.ring}_ring",
            f"cannot bend on the seat of [{where}.{side.seat}]: write {side.ring}_ring = [], or give "
            f"{side.ring}_seat_stiffness_N_m above 0, or leave out that seat",
        )


def _shaft(tables: Tables, seat: ShaftFit, where: str) -> Iterator[Conflict]:
    """Yield a shaft that is not known, or leaves nothing under the seat."""
    spindle, limit = tables.spindle, min(one.bore_mm for one in tables.geometries)
    key = f"{where}.shaft"
    if spindle is not None and spindle.shaft.external:
        if seat.bore_mm is None:
            yield Conflict(
                f"{key}.bore_mm",
                "is missing, for example bore_mm = 0.0 of a solid shaft: another model owns the shaft, and "
                "its sections are not known here",
            )
        if seat.material is None and spindle.shaft.material is None:
            yield Conflict(
                f"{key}.material",
                'is missing, for example material = "GCr15": another model owns the shaft, and its material '
                "is not known here",
            )
    if seat.bore_mm is not None:
        if seat.bore_mm >= limit:
            yield Conflict(f"{key}.bore_mm", f"must be below the seat's diameter bearing.bore_mm = {limit:g}")
    elif spindle is not None and not spindle.shaft.external:
        for k, one in enumerate(tables.geometries):
            if (bore := bore_at(tables, k)) >= (limit := one.bore_mm):
                yield Conflict(
                    "spindle.shaft.sections_mm",
                    f"the bore of {bore:g} mm at bearing {k + 1} must be below the seat's diameter "
                    f"bearing.bore_mm = {limit:g}: correct the section, or give {key}.bore_mm",
                )


def _housing(tables: Tables, seat: HousingFit, where: str) -> Iterator[Conflict]:
    """Yield a housing whose wall is not known, or leaves nothing around the seat."""
    outside, limit = housing_outside(tables), max(one.outside_diameter_mm for one in tables.geometries)
    body = f"{where.split('.')[0]}.housing.diameter_mm"
    key = f"{where}.housing.outside_diameter_mm"
    if outside is None:
        yield Conflict(
            key,
            f"is missing, for example outside_diameter_mm = {60.0 if limit < 60.0 else 1.5 * limit:g} "
            f"(outside diameter of the housing around the seat; {body} serves, too)",
        )
    elif outside <= limit:
        own = seat.outside_diameter_mm is not None
        yield Conflict(
            key if own else body, f"must exceed the seat's diameter bearing.outside_diameter_mm = {limit:g}"
        )


def _preload(tables: Tables, fit: Fit, where: str) -> Iterator[Conflict]:
    """Yield a place held by a preload that may be that of the loose or of the mounted bearing."""
    if fit.preload is not None:
        return
    mounting, spindle = tables.mounting, tables.spindle
    if mounting is not None and mounting.preload_mode == "rigid":
        key, force = "mounting.preload_N", mounting.preload_N
    elif spindle is not None and spindle.preload is not None and spindle.preload.preload_N is not None:
        key, force = "spindle.preload.preload_N", spindle.preload.preload_N
    else:
        return
    yield Conflict(
        f"{where}.preload",
        f'is missing beside {key} = {force:g}: give preload = "unmounted" if a maker gave it, "mounted" if '
        "it was measured on the spindle; the fit changes a preload that is held by a distance",
    )
