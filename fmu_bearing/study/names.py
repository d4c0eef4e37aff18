"""Names of variables as people write them: with a star for any text, or nearly right."""

import difflib
import fnmatch
import re
from collections.abc import Iterable, Sequence


class UnknownName(ValueError):
    """A name that is not among those there are; the message says which is nearest."""


def known(name: str, names: Sequence[str], what: str) -> str:
    """Return ``name`` if it is one of ``names``; else ``UnknownName`` tells the nearest."""
    if name in names:
        return name
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(names)}"
    raise UnknownName(f"there is no {what} '{name}'; {hint}")


def chosen_names(patterns: Sequence[str] | None, names: Iterable[str], default: Sequence[str]) -> list[str]:
    """Return the names that match any of the patterns, in order of the patterns, each once.

    ``*`` stands for any text; brackets stand for themselves, as in ``mic[*].leq``.

    Raises
    ------
    UnknownName
        For a pattern that matches nothing.
    """
    if patterns is None:
        return list(default)
    every = list(names)
    found: dict[str, None] = {}
    for pattern in patterns:
        rule = re.compile(fnmatch.translate(pattern.replace("[", "[[]")))
        matches = [name for name in every if rule.match(name)]
        if not matches:
            known(pattern, every, "variable")
        found |= dict.fromkeys(matches)
    return list(found)
