"""LN: scratch of fidelity response while it renews its lines (``x`` in kernels).

It stands in the Jacobian's block of ``s``, from ``S.JAC`` on, which this fidelity does not need then: forces
of one ball on the rings, sampled round the orbit, and their circumferential orders. A complex vector is
``COMPONENTS`` real parts, then as many imaginary parts.
"""

from fmu_bearing.engine.layout.condensed import FORCES as COMPONENTS
from fmu_bearing.engine.layout.sizes import Places

REACH = 8  # highest circumferential order of the balls' unequal loads
AZIMUTHS = 96  # samples over the orbit at most

IMAGINARY = COMPONENTS  # place of the imaginary parts in a complex vector
COMPLEX = 2 * COMPONENTS  # numbers of one

# kinds of sample
FORCE = 0  # N, N m
BY_HEIGHT = 1  # per m of race height under the ball: inner, outer
BY_BEND = 3  # per m/s2 of its second time derivative: inner, outer
KINDS = 5

_at = Places()
SAMPLES = _at(KINDS * COMPONENTS * AZIMUTHS)  # entry (kind, i, m) at (kind * COMPONENTS + i) * AZIMUTHS + m
COS = _at(AZIMUTHS)  # of the azimuths
SIN = _at(AZIMUTHS)
# orders 0 .. REACH of each kind from BY_HEIGHT on: see `order_of` in response/lines
TABLE = _at((KINDS - BY_HEIGHT) * (REACH + 1) * COMPLEX)
FORCE_ORDER = _at(COMPLEX)  # one order of the force
SIZE = _at.next
