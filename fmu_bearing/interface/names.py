"""Names of variables: patterns with a star for any text, and suggestions for misspelt names."""

import fnmatch
import re
from collections.abc import Iterable, Sequence

from fmu_bearing.likeness import nearest
from fmu_bearing.scene.problems import described

__all__ = ["UnknownName", "chosen_names", "known", "matching"]

_MOST = 24  # names listed in a message
#: Variables of microphones by how standards write them (IEC 61672-1), without marks.
_QUANTITIES = {
    "laeq": "leq_a", "laeqdb": "leq_a", "lpaeq": "leq_a", "dba": "leq_a", "leq": "leq", "lpeq": "leq",
    "lzeq": "leq", "laf": "spl_fast_a", "lpaf": "spl_fast_a", "lzf": "spl_fast", "las": "spl_slow_a",
    "lpas": "spl_slow_a", "lzs": "spl_slow", "lpa": "spl_a", "lp": "spl", "spl": "spl",
}  # fmt: skip
_INDEX = re.compile(r"\[\d+\]")


class UnknownName(ValueError):
    """An unknown name; the message suggests the nearest one."""


def known(name: str, names: Sequence[str], what: str) -> str:
    """Return ``name`` if it is one of ``names``; else raise `UnknownName` with the nearest name."""
    if name in names:
        return name
    near = _by_quantity(name, names) or nearest(name, names)
    hint = f"did you mean '{near}'?" if near else f"there are {_some(names)}"
    raise UnknownName(f"there is no {what} '{name}'; {hint}")


def _by_quantity(name: str, names: Sequence[str]) -> str:
    """Return the first variable of a quantity that is written as in standards: LAeq; empty: none is."""
    wanted = _QUANTITIES.get(re.sub(r"[^a-z]", "", name.lower()))
    return "" if wanted is None else next((one for one in names if one.endswith(f".{wanted}")), "")


def _some(names: Iterable[str]) -> str:
    """List names, those that differ by an index once, at most `_MOST`."""
    listed = list(dict.fromkeys(_INDEX.sub("[*]", name) for name in names))
    more = f" and {len(listed) - _MOST} more" if len(listed) > _MOST else ""
    return ", ".join(listed[:_MOST]) + more


def matching(pattern: str, names: Iterable[str]) -> list[str]:
    """Return the names that a pattern matches: ``*`` is any text, brackets match themselves."""
    rule = re.compile(fnmatch.translate(pattern.replace("[", "[[]")))
    return [name for name in names if rule.match(name)]


def chosen_names(
    patterns: Sequence[str] | None, names: Iterable[str], default: Sequence[str], words: Iterable[str] = ()
) -> list[str]:
    """Return the names that match any of the patterns, in order of the patterns, each once.

    ``*`` matches any text; brackets match themselves, as in ``mic[*].leq``. ``words``: what a
    misspelt name may mean beside names.

    Raises
    ------
    UnknownName
        For a pattern that matches nothing.
    """
    if patterns is None:
        return list(default)
    listed = isinstance(patterns, Iterable) and not isinstance(patterns, str)
    if not listed or not all(isinstance(pattern, str) for pattern in patterns):
        raise UnknownName(f"variables are given as a list of names, not as {described(patterns)}")
    every = list(names)
    chosen: dict[str, None] = {}
    for pattern in patterns:
        matches = matching(pattern, every)
        if not matches:
            known(pattern, [*every, *words], "variable")
        chosen |= dict.fromkeys(matches)
    return list(chosen)
