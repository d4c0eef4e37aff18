"""R: contact of the balls with one race: rows of ``w`` per race. Forces and moments are those on the ball."""

from fmu_bearing.engine.layout.sizes import STRIDE, Places

_at = Places()
EN = _at(3 * STRIDE)  # unit vector from groove centre to ball centre, in the ball's orbiting axes
EM = _at(3 * STRIDE)  # across the track
PER_GROOVE = _at(STRIDE)  # 1/m: one over the distance of ball centre and groove centre
APPROACH = _at(STRIDE)  # m
RATE = _at(STRIDE)  # m/s
LOAD = _at(STRIDE)  # N, with damping
ELASTIC = _at(STRIDE)  # N, without
UT = _at(STRIDE)  # m/s: sliding along the track,
UM = _at(STRIDE)  # and across
AN = _at(STRIDE)  # rad/s: spin of the ball against the race,
AT = _at(STRIDE)  # about the track's direction,
AM = _at(STRIDE)  # and rolling
SCALE = _at(STRIDE)  # m/s: sliding at which traction levels off
FT = _at(STRIDE)  # N: traction along the track,
FM = _at(STRIDE)  # and across
MN = _at(STRIDE)  # N m: moments of traction about the normal,
MT = _at(STRIDE)  # the track's direction,
MM = _at(STRIDE)  # and the rolling axis
HALF = _at(STRIDE)  # m: semi-major axis
WAVE = _at(STRIDE)  # m: height of the race under the ball
SLOPE = _at(STRIDE)  # its slope along the track
ENTRAIN = _at(STRIDE)  # m/s: entrainment speed
ROLL = _at(STRIDE)  # N m: rolling resistance
SINA = _at(STRIDE)  # of the contact angle
COSA = _at(STRIDE)
BUMP_T = _at(STRIDE)  # slope of the ball's own waviness towards e_t and e_m
BUMP_M = _at(STRIDE)
# local defects: no kernel reads these rows of a bearing without any
GAIN = _at(STRIDE)  # change of the approach over that of the sound contact; 1 beside defects
BUMP_N = _at(STRIDE)  # m/rad: approach by turning of a ball with a defect about e_n, over GAIN
BEND_N = _at(STRIDE)  # 1/m: second derivative of the approach by the ball's place along e_n,
BEND_T = _at(STRIDE)  # along e_n and along the track,
BEND_TT = _at(STRIDE)  # and along the track
SIZE = _at.next

# rows of a race that the state keeps for outputs
_at = Places()
KEPT_APPROACH = _at(STRIDE)
KEPT_LOAD = _at(STRIDE)
KEPT_SINA = _at(STRIDE)
KEPT_COSA = _at(STRIDE)
KEPT = _at.next
