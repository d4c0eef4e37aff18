"""Run checks of one unpacked FMU, in a process that the FMU may end.

``python -m fmu_bearing.validation.worker FMU FOLDER FIRST [COUNT]`` writes to its standard output, in lines
of JSON, which check begins and what it found. What the FMU prints goes to standard error.
"""

import json
import os
import sys
from pathlib import Path
from typing import Any

from fmu_bearing.children import end_with_parent
from fmu_bearing.validation.checks import CHECKS
from fmu_bearing.validation.remarks import FINDING, SKIPPED, Skip
from fmu_bearing.validation.subject import NoInstance, Subject
from fmu_bearing.validation.tools import TOOLS


def main(path: str, folder: str, first: str, count: str = "1000") -> None:
    """Run checks from number ``first`` on: those of other tools, then those of behaviour."""
    end_with_parent()
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as out:
        os.dup2(2, 1)  # libraries print where they like

        def tell(**what: Any) -> None:
            out.write(json.dumps(what) + "\n")
            out.flush()

        subject = None  # a description that other tools look at need not be readable
        tools = list(TOOLS)
        for number in range(int(first), min(len(tools) + len(CHECKS), int(first) + int(count))):
            tell(begins=number)
            if number < len(tools):
                result = tools[number](Path(path))
                details = [(result.outcome, detail) for detail in result.details]
            else:
                subject = subject or Subject(Path(folder))
                details = _details(number - len(tools), subject)
            tell(ends=number, details=details)


def _details(number: int, subject: Subject) -> list[tuple[str, str]]:
    try:
        return [(remark.severity, str(remark)) for remark in CHECKS[number](subject)]
    except Skip as why:
        return [(SKIPPED, str(why))]
    except NoInstance as why:
        return [(SKIPPED if number else FINDING, f"no instance to check: {why}")]


if __name__ == "__main__":
    main(*sys.argv[1:])
