"""The tables of a new scene that hold a set of bearings: shaft, places and directions, preload or load."""

from collections.abc import Iterator
from typing import NamedTuple

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.spindle import DIRECTIONS

_FAR = 1000.0  # mm: of neighbouring ball planes, at most
#: Of the shaft, assumed: lengths of nose and rear in widths of a bearing, and their diameters in bores.
_NOSE, _REAR = (1.0, 1.2), (2.0, 0.9)


class SetShape(NamedTuple):
    """A set as a new scene has it: bearings at equal distances, in the directions of an arrangement.

    Attributes
    ----------
    directions : str
        A sign per bearing, from the nose on.
    bore, width : float
        Of a bearing (mm).
    distance : float
        Of neighbouring ball planes (mm).
    spring : float or None
        Force (N) on each outer ring that carries as the last bearing does, which slide then.
    """

    directions: str
    bore: float
    width: float
    distance: float
    spring: float | None

    @property
    def one_way(self) -> bool:
        """Whether all bearings carry the same way: an axial force holds them, no preload."""
        return len(set(self.directions)) == 1

    @property
    def places(self) -> list[float]:
        """Ball planes from the nose (mm)."""
        first = (_NOSE[0] + 0.5) * self.width
        return [round(first + k * self.distance, 4) for k in range(len(self.directions))]


def set_shape(
    arrangement: str, bore: float, width: float, distance: float | None, spring: float | None
) -> SetShape:  # fmt: skip
    """Return the set of an arrangement; ``distance`` (mm): default the width.

    Raises
    ------
    SceneError
        For an arrangement without a name, bearings that overlap, and a spring that nothing holds.
    """
    if arrangement not in DIRECTIONS:
        names = ", ".join(reversed(DIRECTIONS))
        raise SceneError(f"there is no arrangement '{arrangement}': choose from {names}")
    if distance is not None and not width <= distance <= _FAR:
        raise SceneError(
            f"distance of ball planes = {distance:g} mm is refused; allowed: {width:g} (the width of a "
            f"bearing) to {_FAR:g} mm"
        )
    apart = width if distance is None else distance
    shape = SetShape(DIRECTIONS[arrangement], bore, width, apart, spring)
    if shape.one_way and spring is not None:
        raise SceneError(
            f"a spring of {spring:g} N is refused for {arrangement}: all carry one way, and an axial force "
            "loads them; give a preload or a class for that force, or an arrangement that carries both ways"
        )
    return shape


def set_parts(shape: SetShape, preload: str) -> Iterator[str]:
    """Yield the tables; ``preload``: the line that gives it, of springs and bearings of one way unused."""
    (nose, collar), (rear, tail) = _NOSE, _REAR
    sections = [
        [nose * shape.width, collar * shape.bore, 0.0],
        [shape.width + shape.places[-1] - shape.places[0], shape.bore, 0.0],
        [rear * shape.width, tail * shape.bore, 0.0],
    ]
    lines = [[round(value, 4) for value in section] for section in sections]
    yield (
        "[spindle.shaft] # assumed: solid, a short nose, and a rear behind the last bearing\n"
        f"sections_mm = {lines} # assumed: length, diameter, bore of nose, seats, rear\n"
        'material = "GCr15" # assumed\nflexible = true # assumed: it bends'
    )
    yield (
        '[spindle.housing] # assumed: it does not move\nmaterial = "GCr15" # assumed\n'
        "# How tight the rings sit on shaft and in housing is in [spindle.fit]; without it they are as drawn."
    )
    for place, sign in zip(shape.places, shape.directions, strict=True):
        slides = '\nseat = "sliding"' if shape.spring is not None and sign == shape.directions[-1] else ""
        yield f'[[spindle.bearing]]\nposition_mm = {place}\ncarries = "{sign}x"{slides}'
    if shape.one_way:
        yield f"[spindle.load]\n{preload}"
    elif shape.spring is not None:
        yield f'[spindle.preload]\nkind = "spring"\nforce_N = {float(shape.spring)}'
    else:
        yield f'[spindle.preload]\nkind = "spacer"\n{preload}'
