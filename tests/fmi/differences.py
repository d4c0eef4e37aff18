"""What the Python build does otherwise than the native one: the limits pythonfmu 0.7.0 sets it.

One row per behaviour; the tests hold both builds to it exactly, and ``docs/fmu.md`` names every row. A
pair of statuses is the answer to the call itself and to the step that follows.
"""

from dataclasses import dataclass
from typing import Any

from tests.native.master import DISCARD, ERROR, OK

_NO_STATUS = "no call of a pythonfmu slave can answer fmi2Error or fmi2Discard, except doStep fmi2Discard"
_FIXED = "answered inside pythonfmu's library"


@dataclass(frozen=True)
class Difference:
    """A behaviour, what either build does, and what keeps the Python build from doing the same."""

    behaviour: str
    native: Any
    python: Any
    why: str


DIFFERENCES = (
    Difference("needs Python", False, True, "pythonfmu's library loads the model into an interpreter"),
    Difference(
        "host without Python", 0, 2, "the library leaves Python's symbols to the host: it does not load"
    ),
    Difference("another GUID", None, "an instance", "pythonfmu does not compare the GUID"),
    Difference("model exchange", None, "an instance", "pythonfmu does not look at the kind asked for"),
    Difference(
        "reason of no instance", "log", "stderr", "pythonfmu loses the exception of a slave's constructor"
    ),
    Difference("any path", True, False, "pythonfmu undoes no escape of the location but that of a blank"),
    Difference("NULL instead of an instance", ERROR, "the process ends", "not looked at inside pythonfmu"),
    Difference("call out of order", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("step out of order", (ERROR, ERROR), (DISCARD, DISCARD), _NO_STATUS),
    Difference("step of no length", (ERROR, ERROR), (DISCARD, OK), _NO_STATUS),
    Difference("wrong communication time", (ERROR, ERROR), (DISCARD, OK), _NO_STATUS),
    Difference("value out of range", (DISCARD, OK), (OK, DISCARD), _NO_STATUS),
    Difference("what cannot be set", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("parameter after initialisation", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("unknown value reference", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("start time", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("no equilibrium", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("tolerance not finite", (ERROR, ERROR), (OK, DISCARD), _NO_STATUS),
    Difference("output without equilibrium", ERROR, OK, _NO_STATUS),
    Difference("damaged state", (ERROR, OK), (OK, DISCARD), _NO_STATUS),
    Difference("step refused again", ERROR, DISCARD, _NO_STATUS),
    Difference("asked to end after fmi2Discard", 0, 1, _FIXED),
    Difference("last successful time", "of the engine", "of the master", _FIXED),
    Difference("status before initialisation", ERROR, OK, _FIXED),
    Difference("status of a pending step", DISCARD, ERROR, _FIXED),
    Difference("directional derivative", (ERROR, ERROR), (ERROR, OK), _FIXED),
    Difference("input derivative", OK, ERROR, _FIXED),
    Difference("output derivative", OK, ERROR, _FIXED),
    Difference(
        "unknown log category", ERROR, OK, "pythonfmu passes messages of exactly the categories named"
    ),
    Difference(
        "category logAll",
        {"logStatusDiscard", "logStatusError"},
        set(),
        "pythonfmu passes messages of exactly the categories named",
    ),
)
