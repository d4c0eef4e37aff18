"""Does an FMU do what FMI 2.0 co-simulation asks of it? `validate` runs every check and tells.

============  =================================================================================
``subject``   the FMU under test, its instances, the status of every call
``remarks``   what a check tells: findings, notes
``life``      checks of instances: loading, start values, independence, reset
``refusals``  checks of what should be refused: values, steps, times
``abilities`` checks of what the description declares: states, steps, derivatives, reference results
``checks``    all checks in their order
``worker``    that process: runs checks one after the other, tells after each
``tools``     FMPy's validation, the checker of fmu-manipulation-toolbox
``run``       `validate`: tools for the description, a process of its own for the behaviour
============  =================================================================================

A *finding* is something FMI 2.0 requires and the FMU does not do, a call that ends the process, or one that
does not return. A *note* is a behaviour FMI leaves open that a master had better know.
"""

from fmu_bearing.validation.remarks import FINDING, NOTE, PASSED, SKIPPED, Result
from fmu_bearing.validation.run import NotAnFmu, validate

__all__ = ["FINDING", "NOTE", "PASSED", "SKIPPED", "NotAnFmu", "Result", "validate"]
