"""A floor under a spindle: a rigid plane below the axis and parallel to it, by images.

The image of a source in the plane sounds at a microphone as the source itself sounds at the microphone's
mirror place, so no new transfer function is needed. Left out is what the housing scatters of its image:
little below 500 Hz, where k times its radius is half.
"""

from typing import Any

from examples.papers.case import Case
from examples.papers.hearing import Ear, Places
from fmu_bearing.acoustics.filters.weighting import level

#: Heights (mm) of the axis above the floor: chosen, no paper names one.
HEIGHTS = (150, 200, 300, 500, 1000)


def mirrored(places: Places, height: float) -> list[tuple[float, float, float]]:
    """Return the places mirrored in the floor, ``height`` (m) below the axis.

    Raises
    ------
    ValueError
        For a place on the floor or below it.
    """
    if low := [place for place in places if not place[2] > -height]:
        raise ValueError(f"a floor {height:g} m below the axis leaves no air at {low[0]}: put it lower")
    return [(x, y, -2.0 * height - z) for x, y, z in places]


def floors(ear: Ear, case: Case) -> dict[str, Any]:
    """Levels (dB) at the scene's microphones, without a floor (``free``) and by height (mm)."""
    places = ear.recording.positions
    direct = ear.pressure(places)
    found = {"free": level((direct**2).mean(axis=1)).tolist()}
    lowest = -1e3 * min(place[2] for place in places)
    for height in (one for one in HEIGHTS if one > lowest):
        both = direct + ear.pressure(mirrored(places, 1e-3 * height))
        found[f"{height}"] = level((both**2).mean(axis=1)).tolist()
    return {"floors": found}
