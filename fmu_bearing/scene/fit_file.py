"""Fits as the file of a scene has them: what follows from its other tables, and tables in the wrong place."""

from collections.abc import Iterator, Mapping
from typing import Any

from fmu_bearing.scene.seats import BEARING_CLASSES, SIDES

#: Tables of fits: of one bearing, of a set.
TABLES = (("mounting", "fit"), ("spindle", "fit"))


def fit_of(data: Mapping[str, Any], mount: str) -> dict[str, Any] | None:
    """Return the table of fits under ``mounting`` or ``spindle`` of a scene's tables; None: there is none."""
    above = data.get(mount)
    fit = above.get("fit") if isinstance(above, Mapping) else None
    return fit if isinstance(fit, dict) else None


def seats(data: Mapping[str, Any]) -> Iterator[tuple[tuple[str, ...], dict[str, Any]]]:
    """Yield place and table of each seat of a scene's tables."""
    for mount, _ in TABLES:
        fit = fit_of(data, mount) or {}
        for side in SIDES:
            if isinstance(fit.get(side.seat), dict):
                yield (mount, "fit", side.seat), fit[side.seat]


def bodies(data: Mapping[str, Any]) -> Iterator[tuple[tuple[str, ...], dict[str, Any]]]:
    """Yield place and table of what may have a material of its own: bodies, tool, seats."""
    spindle = data.get("spindle")
    for side in SIDES:
        body = spindle.get(side.seat) if isinstance(spindle, Mapping) else None
        if isinstance(body, dict):
            yield ("spindle", side.seat), body
    tool = data.get("tool")
    if isinstance(tool, dict):
        yield ("tool",), tool
        if isinstance(tool.get("holder"), dict):
            yield ("tool", "holder"), tool["holder"]
    yield from seats(data)


def give_class(data: Mapping[str, Any]) -> None:
    """Put the grade of the imperfections in the place of a bearing class that is not given."""
    flaws = data.get("imperfections")
    grade = flaws.get("grade") if isinstance(flaws, Mapping) else None
    for mount, _ in TABLES:
        fit = fit_of(data, mount)
        if fit is not None and grade in BEARING_CLASSES and fit.get("bearing_class") is None:
            fit["bearing_class"] = grade


def loose_preload(data: Mapping[str, Any], mount: str, key: str) -> list[str]:
    """Mark the preload of a class or an offset, given at a key, as that of the loose bearing.

    Returns a line about a fit that says otherwise, or none.
    """
    fit = fit_of(data, mount)
    if fit is None:
        return []
    if fit.get("preload") == "mounted":
        return [
            f"{mount}.fit.preload = 'mounted' contradicts {key}, which is of the loose bearing: leave "
            'preload out or give "unmounted", or give the newtons that were measured as preload_N'
        ]
    if fit.get("preload") is None:
        fit["preload"] = "unmounted"
    return []


def misplaced(data: Mapping[str, Any]) -> str:
    """Say where a table of fits belongs that alone is in the other kind's table; "": there is none."""
    ways = (("mounting", "spindle", "a set of bearings"), ("spindle", "mounting", "one bearing"))
    for mount, other, kind in ways:
        above, right = data.get(mount), data.get(other)
        if isinstance(above, Mapping) and set(above) == {"fit"} and isinstance(right, Mapping):
            return f"{mount}.fit: {kind} has its fits in [{other}.fit]: rename the table"
    return ""


def make_room(data: dict[str, Any], given: Mapping[str, Any]) -> None:
    """Take out of a scene's seats the class or the interference that a new value of the other replaces."""
    for path, seat in seats(data):
        where = ".".join(path)
        (class_key,) = (side.class_key for side in SIDES if side.seat == path[-1])
        for new, old in ((class_key, "interference_um"), ("interference_um", class_key)):
            if given.get(f"{where}.{new}") is not None and f"{where}.{old}" not in given:
                seat.pop(old, None)
