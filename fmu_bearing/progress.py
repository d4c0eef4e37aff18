"""Progress of long work: told line by line to whoever wants to know."""

from collections.abc import Callable

#: Takes one line about what is going on.
Tell = Callable[[str], None]


def silent(text: str) -> None:
    """Tell nobody."""
