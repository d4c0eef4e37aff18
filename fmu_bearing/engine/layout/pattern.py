"""PT: the steady state of unequal balls: its unknowns, and the equations for them in ``w``.

In axes that turn with the load (at rest) or with a whirling cage, the places and spins of the balls are a
pattern that stays, through which the balls run. The unknowns are that pattern at the balls, ball by ball for
each of ``BALL`` quantities, then the bodies' coordinates, the orbit speed and the speed of the whirl.
"""

from fmu_bearing.engine.layout import q as _Q, y as _Y
from fmu_bearing.engine.layout.sizes import MAX_BALLS, Places

BALL = 6  # quantities of a ball: x, r (m), lead in its orbit (rad), absolute spin about x, r, theta (rad/s)
PLACED = 3  # of which places
# unknowns behind the z balls' own, counted from BALL * z
_tail = Places()
BODIES = _tail(_Q.SIZE)  # m, rad
ORBIT = _tail()  # rad/s: mean speed of the orbit
WHIRL = _tail()  # rad/s: speed at which the pattern turns
TAIL = _tail.next

MOST = BALL * MAX_BALLS + TAIL  # unknowns
EVEN = 11  # unknowns where all balls are equal
EVEN_ROW = EVEN + 1

# of a complex eigenvector: itself, its rates, the right side of its equations and their answer
_eigen = Places()
VECTOR = _eigen(2 * MOST)
RATE = _eigen(2 * MOST)
RIGHT = _eigen(2 * MOST)

_at = Places()
UNKNOWNS = _at(MOST)
STEP = _at(MOST)  # of Newton's method
SCALE = _at(MOST)  # what makes the unknowns comparable
RESIDUAL = _at(MOST)  # N: forces out of balance, moments over a lever
EIGEN = _at(_eigen.next)  # an eigenvector: see above
FIRST_STATE = _at(_Y.SIZE)  # quasi-static state that is settled,
EVEN_STATE = _at(_Y.SIZE)  # state of the even balls,
REST_STATE = _at(_Y.SIZE)  # of the pattern at rest,
WHIRL_STATE = _at(_Y.SIZE)  # and of the one that turns with a whirling cage
STAGE = _at()  # of a search: see steady/point
WAY = _at()  # of searching with soft pockets, or from where for a whirl
ROUND = _at()  # rounds made in this stage
SHARE = _at()  # of the pockets' stiffness
GROWTH = _at()  # 1/s: eigenvalue that the whirl's is looked for beside
TURNING = _at()  # rad/s
FOUND_GROWTH = _at()  # 1/s: the whirl's, so far,
FOUND_TURNING = _at()  # rad/s
SIZE = _at.next

# matrices of as many unknowns as there are, rows one number longer, at the end of ``w``
MATRIX, IMAGINARY, RATES = range(3)  # equations, right-hand side last; imaginary parts; see steady/growth.py
MATRICES = 3

# what a search takes from one piece of it to the next: places and lengths
FIRST_SIZE = SIZE - FIRST_STATE
KEPT_SIZE = MOST + RIGHT + FIRST_SIZE  # from UNKNOWNS, EIGEN and FIRST_STATE on
