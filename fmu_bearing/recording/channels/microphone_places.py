"""Microphones by name or by place."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from fmu_bearing.acoustics.analysis.field import Position

#: Places (m), names of microphones, both mixed, one name, or None for all microphones of the scene.
Places = str | Sequence[str | ArrayLike] | None


def named_places(there: Sequence[tuple[str, Position]], wanted: Places = None) -> list[tuple[str, Position]]:
    """Return names and places (m) of the microphones wanted; ``there`` are those known by name.

    Raises
    ------
    ValueError
        For an unknown name, with the known ones; for what is not a place; without any microphone.
    """
    if wanted is None:
        if not there:
            raise ValueError("the scene has no microphones: give positions, or give the scene [sound]")
        return list(there)
    known = dict(there)
    given = [wanted] if isinstance(wanted, str) else list(wanted)
    if not given:
        raise ValueError("there is no microphone to listen at: give names or places")
    unknown = sorted({one for one in given if isinstance(one, str)} - set(known))
    if unknown:
        names = ", ".join(known) or "none: give the scene [sound]"
        raise ValueError(f"there is no microphone {', '.join(map(repr, unknown))}; there are {names}")
    return [(one, known[one]) if isinstance(one, str) else _place(one) for one in given]


def _place(given: ArrayLike) -> tuple[str, Position]:
    """Return a place (m) as plain numbers, with its coordinates in mm as its name."""
    point = np.asarray(given, dtype=float)
    if point.shape != (3,) or not np.isfinite(point).all():
        raise ValueError(
            f"positions must be finite (x, y, z) in m or names of microphones, not of shape {point.shape}"
        )
    x, y, z = map(float, point)
    return place_name((x, y, z)), (x, y, z)


def place_name(place: Position) -> str:
    """Return the name of a place (m): its coordinates in mm, to a micrometre, as ``(0, 300, 0) mm``."""
    x, y, z = (f"{round(1e3 * one, 3) + 0.0:g}" for one in place)  # + 0.0: without the sign of -0
    return f"({x}, {y}, {z}) mm"
