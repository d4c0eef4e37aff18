"""All methods in one array, ``TAB.SIZE`` numbers each, and the place where each begins."""

import numpy as np

from fmu_bearing.engine.fidelities.full.methods.esdirk4 import ESDIRK4
from fmu_bearing.engine.fidelities.full.methods.rk4 import RK4
from fmu_bearing.engine.fidelities.full.methods.trbdf2 import TRBDF2
from fmu_bearing.engine.layout import TAB

TABLEAUX = np.concatenate([ESDIRK4, TRBDF2, RK4])
AT_ESDIRK4, AT_TRBDF2, AT_RK4 = range(0, TABLEAUX.size, TAB.SIZE)
