"""Progress of long work: lines of text, passed to a callable."""

from collections.abc import Callable

#: Takes one line about what is going on.
Tell = Callable[[str], None]


def silent(text: str) -> None:
    """Print nothing."""
