"""Results of checks."""

from dataclasses import dataclass, field

#: Outcomes of a check, from good to bad.
PASSED, SKIPPED, NOTE, FINDING = "passed", "skipped", "note", "finding"
_ORDER = (PASSED, SKIPPED, NOTE, FINDING)


class Skip(Exception):
    """A check that does not apply; the message says why."""


@dataclass(frozen=True)
class Remark:
    """A finding or note of a check.

    Attributes
    ----------
    called, returned, expected : str
        What was called, what came back, what was expected instead.
    where : str
        Section of FMI 2.0 with the requirement; empty where there is none.
    severity : str
        ``finding`` where FMI requires it, ``note`` where FMI leaves it open.
    """

    called: str
    returned: str
    expected: str
    where: str = ""
    severity: str = FINDING

    def __str__(self) -> str:
        asks = "" if self.severity == FINDING else " leaves it open"
        section = f" (FMI 2.0, section {self.where}{asks})" if self.where else ""
        return f"{self.called}: {self.returned}; expected {self.expected}{section}"


@dataclass
class Result:
    """One check of one FMU.

    Attributes
    ----------
    check : str
        Its name.
    meaning : str
        The requirement on the FMU, in a sentence.
    outcome : str
        ``passed``, ``skipped`` (it does not apply), ``note`` or ``finding``.
    details : list of str
        Findings and notes, or why it was skipped.
    """

    check: str
    meaning: str
    outcome: str = PASSED
    details: list[str] = field(default_factory=list)

    def add(self, severity: str, detail: str) -> None:
        """Add a detail; the outcome is that of the worst."""
        self.outcome = max(self.outcome, severity, key=_ORDER.index)
        self.details.append(detail)
