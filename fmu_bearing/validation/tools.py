"""Validation of the description by other tools."""

import logging
from collections.abc import Callable
from pathlib import Path

from fmpy.validation import validate_fmu

from fmu_bearing.extras import MissingExtra, need
from fmu_bearing.validation.remarks import FINDING, SKIPPED, Result


def fmpy(path: Path) -> Result:
    """Validate by FMPy."""
    result = words(fmpy)
    for problem in validate_fmu(str(path)):
        result.add(FINDING, _line(problem))
    return result


def fmutool(path: Path) -> Result:
    """Validate by the checker of fmu-manipulation-toolbox, where it is installed."""
    result = words(fmutool)
    try:
        checker = need("fmu_manipulation_toolbox.checker", "the checker fmutool")
        operations = need("fmu_manipulation_toolbox.operations", "the checker fmutool")
    except MissingExtra as missing:
        result.add(SKIPPED, str(missing))
        return result
    logger = logging.getLogger("fmu_manipulation_toolbox")
    collector = _MessageCollector(logging.ERROR)
    before = logger.propagate, logger.level
    logger.addHandler(collector)
    logger.propagate = False
    try:
        with operations.FMU(str(path)) as fmu:
            for check in checker.get_checkers():
                fmu.apply_operation(check())
    except Exception as problem:  # of a description that cannot be read: its own kinds, and XML's
        collector.lines.append(str(problem) or repr(problem))
    finally:
        logger.removeHandler(collector)
        logger.propagate, logger.level = before
    for line in dict.fromkeys(collector.lines):
        result.add(FINDING, line.replace(f"'{path}': ", ""))
    return result


#: In the order in which they are run: the name of each, and its requirement.
TOOLS: dict[Callable[[Path], Result], tuple[str, str]] = {
    fmpy: ("FMPy", "FMPy's validation of the description: schema, names, units, structure"),
    fmutool: ("fmutool", "fmu-manipulation-toolbox's checks of the description: schema, semantics"),
}


def words(tool: Callable[[Path], Result]) -> Result:
    """Return the result of a tool that has found nothing yet."""
    return Result(*TOOLS[tool])


class _MessageCollector(logging.Handler):
    """Keeps messages."""

    def __init__(self, level: int) -> None:
        super().__init__(level)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a message."""
        self.lines.append(_line(record.getMessage()))


def _line(text: str) -> str:
    return " ".join(str(text).split())
