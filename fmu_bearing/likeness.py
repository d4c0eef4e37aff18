"""The name that a misspelt one was meant to be."""

import difflib
import functools
from collections.abc import Iterable

__all__ = ["nearest"]

_ALIKE = 0.5  # below this likeness a suggestion is a guess


def nearest(name: str, names: Iterable[str]) -> str:
    """Return the name that is most like another one, compared word by word; empty: none is like it.

    Words are what underscores and points separate: ``shaft_speed_rmp`` is ``shaft_speed_rpm`` or else
    ``speed_rpm``, not the equally long ``lowest_speed_rpm``.

    Parameters
    ----------
    name : str
    names : iterable of str
        The names that are known.
    """
    wanted = _words(name)
    best, nearest_name = _ALIKE, ""
    for other in names:
        likeness = _likeness(wanted, _words(other), name, other)
        if likeness > best:
            best, nearest_name = likeness, other
    return nearest_name


def _words(name: str) -> list[str]:
    return name.lower().replace(".", "_").split("_")


def _likeness(wanted: list[str], words: list[str], name: str, other: str) -> float:
    """Return 1 for equal names, 0 for names without a letter in common."""
    whole = difflib.SequenceMatcher(None, name, other)
    if whole.real_quick_ratio() < _ALIKE or whole.quick_ratio() < _ALIKE:
        return 0.0
    common = sum(max(_ratio(word, one) for one in words) for word in wanted)
    return 0.5 * (whole.ratio() + 2.0 * common / (len(wanted) + len(words)))


@functools.cache
def _ratio(word: str, other: str) -> float:
    ratio = difflib.SequenceMatcher(None, word, other).ratio()
    return ratio if ratio > _ALIKE else 0.0
