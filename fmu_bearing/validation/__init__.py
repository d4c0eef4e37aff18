"""Checks of an FMU against FMI 2.0 co-simulation; `validate` runs them all.

============  =================================================================================
``run``       `validate`: runs the tools, and the checks in a separate process
``tools``     FMPy's validation, the checker of fmu-manipulation-toolbox
``worker``    the separate process: runs the checks in turn and reports each
``checks``    list of all checks, in their order
``life``      checks of instances: loading, start values, independence, reset
``refusals``  checks with values, steps and times that should be refused
``abilities`` checks of declared capabilities: states, steps, derivatives, reference results
``subject``   the FMU under test, its instances, the status of every call
``remarks``   results of a check: findings, notes
============  =================================================================================

A *finding* is a violation of FMI 2.0, a call that ends the process, or one that does not return. A *note* is
a behaviour that FMI leaves open and that matters to a master.
"""

from fmu_bearing.validation.remarks import FINDING, NOTE, PASSED, SKIPPED, Result
from fmu_bearing.validation.run import NotAnFmu, validate

__all__ = ["FINDING", "NOTE", "PASSED", "SKIPPED", "NotAnFmu", "Result", "validate"]
