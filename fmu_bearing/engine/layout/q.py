"""Q: the 17 coordinates of the bodies, in this order in ``y`` (displacements, then rates) and in ``f``."""

from fmu_bearing.engine.layout.sizes import Places

_at = Places()
INNER = _at(5)  # inner ring: its rotation is an input
OUTER = _at(6)  # outer ring
CAGE = _at(6)
SIZE = _at.next
RINGS = CAGE  # coordinates of both rings

X, Y, Z = 0, 1, 2  # m, of any body
INNER_BY, INNER_BZ = 3, 4  # rad: tilts of the inner ring
TURN, BY, BZ = 3, 4, 5  # rad, of outer ring and cage: rotation about X, tilts
