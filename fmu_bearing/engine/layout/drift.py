"""DR: what fidelity response keeps of a drift of its inputs, in ``s`` behind the second state.

Numbers of the drift, then `PER_BEARING` numbers of each bearing, inputs twice, a vector of the coordinates.
"""

from fmu_bearing.engine.layout.sizes import Places

COMPONENTS = 12  # of how far a bearing's conditions are off: see response/drift
HEATS = 3
LOSSES = 4  # see S.LOSSES

_at = Places()
KNOWN = _at()  # 1: the last two renewals give the differences below
SHARE = _at()  # of these differences that is in use now
RATE = _at()  # 1/s: of that share, smoothed
LARGEST = _at()  # largest of the components' differences, in tolerances,
SQUARE = _at()  # and the sum of their squares
ALLOWED = _at()  # tolerances from one renewal to the next
SINCE = _at()  # s: since the last one,
STILL = _at()  # and since inputs moved
HEAD = _at.next

_at = Places()
NOW = _at(COMPONENTS)  # how far conditions are from the frozen ones, in tolerances
CHANGE = _at(COMPONENTS)  # differences between both renewals: of the conditions, in tolerances,
HEAT = _at(HEATS)  # W: of the heats,
TORQUE = _at()  # N m,
LOSS = _at(LOSSES)  # W: of the losses by source,
OFFSET = _at()  # m: and of the inner ring's offset, see SP.OFFSET
PER_BEARING = _at.next


def size(bearings, inputs, padded_size):
    """Length of all."""
    return HEAD + bearings * PER_BEARING + 2 * inputs + padded_size
