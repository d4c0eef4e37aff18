"""What `identify` refuses, and how it ends early."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fmu_bearing.identification.result import Identified


class IdentifyError(ValueError):
    """Data, free keys or settings that are refused; the message has one line per problem."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a search; ``best`` holds the best values so far, ``complete`` is False there."""

    def __init__(self, best: "Identified") -> None:
        super().__init__("interrupted: these are the best values so far")
        self.best = best
