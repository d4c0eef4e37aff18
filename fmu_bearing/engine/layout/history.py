"""H: what a march by Newmark's method keeps of its coordinates (fidelity rings): numbers, then vectors.

Vectors follow each other in whole groups of four lanes, the spare ones with zeros.
"""

from fmu_bearing.engine.layout.sizes import Places

LENGTH = 5  # accelerations: now and at earlier steps

_at = Places()
HIGHEST = _at()  # rad/s: highest mode
SPACING = _at()  # s between the kept accelerations; 0: none
KNOWN = _at()  # how many earlier steps of that spacing are kept
CONTRACTION = _at()
FACTOR_STEP = _at()  # s: step the inverse holds for; 0: none
CALM = _at()  # steps since the last rejection or change of step
FRESH = _at()  # 1 while the Jacobian is that of the present state
DEGREE = _at()  # of the polynomial that continues the accelerations
ERRORS = _at(LENGTH)  # m/s2: lately largest error of the polynomials of degree 0, 1, ...
NUMBERS = _at.next

_vector = Places()
Q0 = _vector()  # m, rad: displacements,
V0 = _vector()  # their Newmark velocities,
A0 = _vector()  # accelerations now
A1 = _vector()  # and four steps before
A2 = _vector()
A3 = _vector()
A4 = _vector()
LEVERS = _vector()  # m or 1: what makes a coordinate a displacement; 0 in spare lanes
JERK = _vector()  # rates of acceleration, kept over a change of step
GROWING = _vector(2)  # m, rad: a motion that may grow, complex, see rings/growth
VECTORS = _vector.next
