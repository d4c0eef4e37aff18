"""TR-BDF2 with its third-order companion: Bank et al. (1985); Hosea and Shampine (1996)."""

import math

from fmu_bearing.engine.fidelities.full.methods.tableau import tableau

_DIAGONAL = 1.0 - math.sqrt(2.0) / 2.0
_WEIGHT = math.sqrt(2.0) / 4.0

TRBDF2 = tableau(
    gamma=_DIAGONAL,
    order=3,
    rows=[[], [_DIAGONAL], [_WEIGHT, _WEIGHT]],
    low=[(1.0 - _WEIGHT) / 3.0, (3.0 * _WEIGHT + 1.0) / 3.0, _DIAGONAL / 3.0],
)
