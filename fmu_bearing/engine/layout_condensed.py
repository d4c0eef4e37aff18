"""Places in the block ``S_LEVEL`` of the state (called ``lv`` in this room)."""

from fmu_bearing.engine.layout import (
    C_SIZE,
    F_SIZE,
    L_SIZE,
    STRIDE,
    W_ACC,
    W_POCKET,
    W_SCALARS,
    Y_SIZE,
)

N = 11  # inner x y z by bz, outer x y z angle by bz: the first coordinates of Y_Q

(
    L_RATIO,  # orbit over shaft speed
    L_PAIR_INNER,  # friction force that balances the gyroscopic moment, over shaft speed squared, per race
    L_PAIR_OUTER,
    L_TORQUE,  # N m at L_FOUND_SPEED
    L_HEAT,  # W: inner ring, outer ring, oil
    L_HEAT_2,
    L_HEAT_3,
    L_TWIST,  # N m on the outer ring about its axis
    L_FOUND_SPEED,  # rad/s of the held values
    L_HIGHEST,  # rad/s: highest mode of the rings
    L_ORDER,  # waves per turn that the step has to follow
    L_SPACING,  # s between the kept accelerations; 0: none
    L_KNOWN,  # how many earlier steps of that spacing are kept
    L_CONTRACTION,
    L_FACTOR_STEP,  # step the inverse holds for; 0: none
    L_CALM,  # steps since the last rejection or change of step
    L_THETA,  # angle of ball 0
    L_COUNT,  # of lines (level response)
    L_FRESH,  # 1 while the Jacobian is that of the present state
) = range(19)
L_C = 32  # conditions the held values were found at
L_Q = L_C + C_SIZE  # displacements, Newmark velocities, accelerations and those of two steps before
L_V = L_Q + 12
L_A = L_V + 12
L_A1 = L_A + 12
L_A2 = L_A1 + 12
L_MEAN = L_A2 + 12  # static equilibrium of the rings
L_JERK = L_MEAN + 12  # rates of acceleration, kept over a change of step
# Matrices of 11 x 11 by columns, a column padded to 12, so that a product is a few vector instructions.
MATRIX = 12 * N
L_JX = L_JERK + 12  # derivatives of accelerations by displacements and velocities
L_JV = L_JX + MATRIX
L_INVERSE = L_JV + MATRIX  # of mass - cv J_v - cx J_x
L_MASS = L_INVERSE + MATRIX  # identity plus the balls' mass over the rings' own
L_EXTRA = L_MASS + MATRIX  # damping that traction adds, per own mass
# rows per ball
L_X = L_EXTRA + MATRIX  # place now and at the three steps before
L_R = L_X + STRIDE
L_X1 = L_R + STRIDE
L_R1 = L_X1 + STRIDE
L_X2 = L_R1 + STRIDE
L_R2 = L_X2 + STRIDE
L_X3 = L_R2 + STRIDE  # level response: places at its equilibrium, ball 0 at angle 0
L_R3 = L_X3 + STRIDE
L_PHI = L_R3 + STRIDE  # angle from ball 0 in table intervals, then its cosine and sine
L_COS = L_PHI + STRIDE
L_SIN = L_COS + STRIDE
L_SIZES = L_SIN + STRIDE  # half the diameter deviation, at scale 1
L_MASK = L_SIZES + STRIDE  # 1 for a ball, 0 for a spare lane
L_SPIN = L_MASK + STRIDE  # spin over shaft speed: x, r, theta
L_SETTLED = L_SPIN + 3 * STRIDE  # how many of the latest places are places of rest
L_Y = L_SETTLED + STRIDE  # state of the quasi-static point
ORDERS = 64  # of race waviness that level response knows
L_WAVES = L_Y + Y_SIZE  # complex amplitudes of orders 1 .. ORDERS, inner then outer
L_LINES = L_WAVES + 4 * ORDERS
LINE_SIZE = 22  # multiples of ball 0's and the shaft's angle, then complex displacements without the spin
LINES = (L_SIZE - L_LINES) // LINE_SIZE

# scratch rows of w: the first ones are those of the full force evaluation, not in use meanwhile
E_COS, E_SIN, E_X, E_R, E_INNER, E_OUTER, E_STEP, E_MOVED = range(8)  # E_INNER, E_OUTER: race heights
E_FORCE = 8  # on inner ring x y z, moment y z; then on the outer ring
E_BEND = E_FORCE + 10  # second time derivative of the race heights, inner and outer
assert E_BEND + 2 <= W_POCKET
T_Q = W_SCALARS + 16  # trial numbers of a step: 12 each
T_D = W_SCALARS + 28
T_A = W_SCALARS + 40
T_V = W_SCALARS + 52
T_SPARE = W_ACC  # for matrices and balls' derivatives; F_SIZE x 5 numbers
assert 5 * F_SIZE > N + 2 * STRIDE + 2 * N * STRIDE  # see `linearised`
