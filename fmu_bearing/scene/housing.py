"""The housing of a set where it radiates: its place, and what does not fit into it."""

from collections.abc import Iterator, Sequence

from fmu_bearing.scene.base import Conflict
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.spindle import Spindle

#: mm: a microphone nearer to a body than this is on it; places carry rounding.
SKIN = 1e-3
_BACK = 'or give sound.radiator = "bare"'


def middle_mm(spindle: Spindle) -> float:
    """Middle of the housing and its pedestal from the shaft's nose, mm."""
    given = spindle.housing.position_mm
    return spindle.middle_mm if given is None else given


def envelope(spindle: Spindle) -> tuple[float, float, float] | None:
    """Radius and axial extent (mm) of the housing; None without a size."""
    diameter, length = spindle.housing.diameter_mm, spindle.housing.length_mm
    if diameter is None or length is None:
        return None
    middle = middle_mm(spindle)
    return 0.5 * diameter, middle - 0.5 * length, middle + 0.5 * length


def conflicts(spindle: Spindle, geometries: Sequence[Bearing]) -> Iterator[Conflict]:
    """Yield why a housing that moves cannot radiate: its size, and bearings that are not inside."""
    cylinder = envelope(spindle)
    if cylinder is None:
        return
    radius, front, rear = cylinder
    limit = max(one.outside_diameter_mm for one in geometries)
    if 2.0 * radius <= limit:
        yield Conflict(
            "spindle.housing.diameter_mm",
            f"must exceed bearing.outside_diameter_mm = {limit:g} where the housing radiates: enlarge "
            f"it, {_BACK}",
        )
    for number, (one, bearing) in enumerate(zip(spindle.bearing, geometries, strict=True), start=1):
        half = 0.5 * bearing.width_mm
        low, high = one.position_mm - half, one.position_mm + half
        if low < front - SKIN or high > rear - SKIN:  # closed behind the bearings
            yield Conflict(
                f"spindle.bearing[{number}].position_mm",
                f"= {one.position_mm:g} puts the bearing from x = {low:g} to {high:g} mm, which must lie "
                f"inside the housing that radiates, x = {front:g} to {rear:g} mm: change "
                f"spindle.housing.position_mm or length_mm, {_BACK}",
            )
