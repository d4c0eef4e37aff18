"""Places in the flat arrays that every kernel shares.

Five one-dimensional float64 arrays carry everything:

=====  ==========================================================================
``p``  parameters: written once by ``prepare``, read only in the engine
``u``  inputs, in the order of :data:`INPUTS`
``s``  state: all that a later step needs, and nothing else
``z``  what people read: velocities, loads, levels
``w``  work space: scratch, no value survives a call
=====  ==========================================================================

Per-ball quantities are structures of arrays: quantity ``k`` of ball ``j`` stands at
``k * STRIDE + j``, so that one loop over balls is one vector loop.
"""

import numpy as np

from fmu_bearing.engine import layout_flexure as modes_layout

STRIDE = modes_layout.STRIDE  # lanes per ball quantity: no power of two, so that rows spread over cache sets
MAX_BALLS = STRIDE

# --- u: inputs -------------------------------------------------------------------------------
INPUTS = (
    "shaft_speed", "preload", "pedestal_stiffness", "radial_load.y", "radial_load.z", "oil_temperature",
    "inner_ring_temperature", "outer_ring_temperature",
)  # fmt: skip
U_SPEED, U_PRELOAD, U_PEDESTAL, U_LOAD_Y, U_LOAD_Z, U_OIL_T, U_INNER_T, U_OUTER_T = range(len(INPUTS))

# --- z: what people read ---------------------------------------------------------------------
BEARING_OUTPUTS = (
    "inner_ring.velocity.x", "inner_ring.velocity.y", "inner_ring.velocity.z", "outer_ring.velocity.x",
    "outer_ring.velocity.y", "outer_ring.velocity.z", "cage.velocity.x", "cage.velocity.y",
    "cage.velocity.z", "friction_torque", "heat.inner_ring", "heat.outer_ring", "heat.oil",
    "cage.speed_ratio", "inner_ring.displacement.x", "inner_ring.displacement.y",
    "inner_ring.displacement.z", "outer_ring.displacement.x", "outer_ring.displacement.y",
    "outer_ring.displacement.z", "contact.inner.load_mean", "contact.inner.load_max",
    "contact.inner.angle_mean", "contact.inner.pressure_max", "contact.outer.load_mean",
    "contact.outer.load_max", "contact.outer.angle_mean", "contact.outer.pressure_max", "film.lambda_min",
    "stiffness.axial", "stiffness.radial", "solver.steps", "solver.rejected", "energy.residual",
    "solver.fallbacks", "inner_ring.tilt.y", "inner_ring.tilt.z", "contact.inner.spin_to_roll",
    "contact.outer.spin_to_roll", "contact.inner.slip", "contact.outer.slip", "cage.whirl_radius",
    "cage.whirl_speed", "friction_torque.contacts", "friction_torque.rolling", "friction_torque.cage",
    "friction_torque.drag", "contact.inner.shoulder_margin", "contact.outer.shoulder_margin",
)  # fmt: skip
Z_BALLS = len(BEARING_OUTPUTS)  # ball[j].velocity.x|y|z at Z_BALLS + 3 j
MIC_OUTPUTS = (
    "pressure", "spl", "spl_a", "leq", "leq_a", "spl_inner_ring", "spl_outer_ring", "spl_cage", "spl_balls",
    "spl_fast", "spl_fast_a", "spl_slow", "spl_slow_a", "spl_energy_sum", "spl_radial", "spl_axial",
    "spl_rotation", "spl_flexure",
)  # fmt: skip
#: Third octaves: nominal mid-band frequencies in Hz, IEC 61260-1; the exact ones are 10^(n/10).
BANDS = (
    25.0, 31.5, 40.0, 50.0, 63.0, 80.0, 100.0, 125.0, 160.0, 200.0, 250.0, 315.0, 400.0, 500.0, 630.0, 800.0,
    1000.0, 1250.0, 1600.0, 2000.0, 2500.0, 3150.0, 4000.0, 5000.0, 6300.0, 8000.0, 10000.0, 12500.0, 16000.0,
)  # fmt: skip


def z_mics(n_balls):
    """Place of the first microphone's first output in ``z`` for ``n_balls`` balls."""
    return Z_BALLS + 3 * n_balls


def z_bands(n_balls, n_mics):
    """Place of the first microphone's first third octave in ``z``: after all its other outputs."""
    return z_mics(n_balls) + len(MIC_OUTPUTS) * n_mics


def z_flex(n_balls, n_mics, n_bands=0):
    """Place in ``z`` of the flexural velocities: two for each mode, cosine then sine."""
    return z_bands(n_balls, n_mics) + n_bands * n_mics


def z_size(n_balls, n_mics, n_bands=0, n_modes=0):
    """Length of ``z`` for microphones of ``n_bands`` third octaves each, and ``n_modes`` flexural modes."""
    return z_flex(n_balls, n_mics, n_bands) + 2 * n_modes


# --- p: head, tunable before initialisation -----------------------------------------------------
P_LEVEL = 0  # see LEVELS
P_TOLERANCE = 1  # relative, on ring velocities
P_MAX_STEP = 2  # s
P_IMPERFECTION_SCALE = 3
P_TIME_WEIGHTING = 4  # s: 0.125 Fast, 1 Slow
P_METERING_START = 5  # s after initialisation
P_VISCOSITY = 6  # Pa s at the reference temperature

# --- motion sample handed to the sound kernels ----------------------------------------------------
# Bodies inner ring, outer ring, cage: velocity, acceleration, angular velocity, angular acceleration
# in inertial axes (x, y, z), 12 numbers each; then per ball 14 numbers: the same four vectors in the
# orbiting axes (x, r, theta) - inertial quantities, only resolved there - and cos, sin of the angle; then the
# second time derivatives (m/s2) of the flexural coordinates, two per mode.
MO_INNER, MO_OUTER, MO_CAGE, MO_BALLS = 0, 12, 24, 36
MO_PER_BALL = 14


def mo_flex(n_balls):
    """Place of the flexural accelerations in a motion sample for ``n_balls`` balls."""
    return MO_BALLS + MO_PER_BALL * n_balls


def motion_size(n_balls, n_modes=0):
    """Length of a motion sample for ``n_balls`` balls and ``n_modes`` flexural modes."""
    return mo_flex(n_balls) + 2 * n_modes


REFERENCE_TEMPERATURE = 293.15  # K: viscosity is the reference one, expansion is zero
GRAVITY = 9.81  # m/s2, along -Z
PI = np.pi

# --- p: numbers of the mechanics -------------------------------------------------------------------
(
    P_BALLS,  # number of balls
    P_LANES,  # balls rounded up to a multiple of 4; the lanes beyond copy ball 0
    P_MICS,
    P_STRIPS,
    P_CAGE,  # switches: 1 computed, 0 left out
    P_GRAVITY,
    P_DRAG,
    P_ROLLING,
    P_LAND,
    P_GYROSCOPIC,
    P_WAVINESS,
    P_AT_STRIPS,  # offsets into p: strip nodes then weights
    P_AT_OVERSIZE,  # ball diameter deviations, one per lane
    P_AT_WAVES,  # race tables: inner then outer, values and slopes interleaved
    P_AT_SOUND,  # sound block; 0 when there is none
    P_SOUND_SIZE,
    P_SOUND_STATE,
    P_SOUND_WORK,
    P_PITCH_RADIUS,
    P_DIAMETER,  # of a ball
    P_BALL_MASS,
    P_BALL_INERTIA,
    P_BALL_EXPANSION,
    P_CONTACT_DAMPING,  # s: damping coefficient over contact stiffness
    P_MU,
    P_SLIDE_TO_ROLL,
    P_TRACTION_FLOOR,
    P_VOGEL_B,
    P_VOGEL_C,
    P_OIL_DENSITY,
    P_SHEAR_HEATING,  # constants of the SKF reduction factors, for speed in r/min and viscosity in mm2/s
    P_STARVATION,
    P_DRAG_FACTOR,  # N per (m/s)^2
    P_ROUGHNESS,  # m rms, both surfaces
    P_INNER_MASS,  # with the rotor
    P_INNER_TRANSVERSE,
    P_INNER_POLAR,
    P_OUTER_MASS,  # with the housing
    P_OUTER_TRANSVERSE,
    P_OUTER_POLAR,
    P_CAGE_MASS,
    P_CAGE_TRANSVERSE,
    P_CAGE_POLAR,
    P_ECCENTRICITY,  # m: centre of mass of the rotating parts
    P_TILT_STIFFNESS,
    P_TILT_DAMPING,
    P_AXIAL_RATIO,
    P_ROTATIONAL_RATIO,  # m2
    P_PEDESTAL_ZETA,
    P_POCKET_CLEARANCE,
    P_POCKET_STIFFNESS,
    P_POCKET_DAMPING,  # Hunt-Crossley, s/m
    P_POCKET_FRICTION,
    P_POCKET_SLIP,  # m/s
    P_POCKET_FILM,  # N s/m
    P_LAND_RADIUS,
    P_LAND_LENGTH,
    P_LAND_OFFSET,
    P_LAND_CLEARANCE,
    P_LAND_VISCOSITY,
    P_LAND_STOP_STIFFNESS,
    P_LAND_STOP_FRACTION,
    P_LAND_STOP_FRICTION,
    P_LAND_STOP_SLIP,
    P_METHOD,  # integrator of level full: see METHODS
    P_TRACTION_LAW,  # see TRACTION_LAWS
    P_EYRING_STRESS,  # Pa
    P_PRESSURE_VISCOSITY,  # 1/Pa
    P_VISCOSITY_LAW,  # 0 Vogel, 1 Walther
    P_WALTHER_SLOPE,
    P_REDUCTION,  # switch: thermal and starvation factors of the rolling resistance
    P_RIGID,  # switch: rigid preload
    P_MISALIGNMENT_Y,  # rad, of the outer ring's seat against the shaft
    P_MISALIGNMENT_Z,
    P_SPRINGS,  # N/m between adjacent balls; 0: none
    P_SPRING_DAMPING,  # N s/m
    P_BALL_WAVES,  # number of zonal orders of the balls' waviness; 0: none
    P_AT_BALL_WAVES,  # offset: amplitudes of orders 1.., then the bodies' axes, 3 rows of STRIDE
    P_RACE_CONTROL,  # who balances the gyroscopic moment: 0 shared, 1 outer race, 2 inner race
    P_MODES,  # number of flexural modes of both rings; 0: rigid rings
    P_AT_MODES,  # offset: MODE_SIZE numbers per mode
    P_MODE_STEP,  # s: longest internal step that resolves the modes
) = range(8, 8 + 82)
P_BANDS = 99  # third octaves per microphone; 0: none
P_RACES = 100  # two blocks of RACE_SIZE: inner, outer
LEVELS = ("full", "rings", "response")
METHODS = ("esdirk4", "fast", "trbdf2", "rk4")
TRACTION_LAWS = ("regularised", "eyring", "paper")
RACE_CONTROLS = ("shared", "outer", "inner")
(
    RACE_STIFFNESS,  # N/m^1.5
    RACE_HALF_LENGTH,  # semi-major axis over sqrt(approach)
    RACE_PRESSURE,  # peak pressure over sqrt(approach)
    RACE_PROFILE_RADIUS,  # of the deformed contact surface across the rolling direction
    RACE_ROLLING,  # rolling moment factor at viscosity 1 Pa s
    RACE_FILM,  # minimum film factor at viscosity 1 Pa s
    RACE_GROOVE_X,
    RACE_GROOVE_RADIUS,  # radius of the circle of groove centres
    RACE_GROOVE,  # groove radius
    RACE_EXPANSION,
    RACE_HALF_WIDTH,  # semi-minor axis over sqrt(approach)
    RACE_CENTRAL_FILM,  # central film factor at viscosity 1 Pa s
    RACE_SHOULDER,  # rad: contact angle at which the groove ends
) = range(13)
RACE_SIZE = 13
P_TABLES = P_RACES + 2 * RACE_SIZE  # variable part begins here
WAVE_INTERVALS = 2048

# --- y: positions and velocities of the mechanics (head of s; also each solver stage) ---------------
# Nine rows per ball: x, r (from the pitch radius), theta, their rates, spin in the orbiting axes.
B_X, B_R, B_TH, B_VX, B_VR, B_OM, B_WX, B_WR, B_WT = range(9)
Y_Q = 9 * STRIDE  # 17 coordinates of the bodies
Y_V = Y_Q + 17  # and their rates
Y_SIZE = Y_V + 17
# Bodies' coordinates: inner x y z by bz; outer and cage x y z angle by bz.
Q_OUTER, Q_CAGE = 5, 11
N_BODY = 17

# --- f: right-hand side -----------------------------------------------------------------------------
F_G = 6 * STRIDE  # after the ball accelerations
F_WORK = F_G + N_BODY  # power in
F_HEAT = F_WORK + 1  # dissipated: inner ring, outer ring, oil
F_TORQUE = F_HEAT + 3  # taken from the shaft
F_SIZE = F_TORQUE + 1

# --- c: conditions held over a communication step ---------------------------------------------------
(
    C_PRELOAD,
    C_LOAD_Y,
    C_LOAD_Z,
    C_PEDESTAL,
    C_PEDESTAL_AXIAL,
    C_PEDESTAL_ROTATIONAL,
    C_DAMPING,
    C_DAMPING_AXIAL,
    C_DAMPING_ROTATIONAL,
    C_DAMPING_SPIN,
    C_VISCOSITY,
    C_OVERSIZE_SCALE,
    C_ECCENTRICITY,
) = range(13)
C_RACES = 13  # per race: groove centre x, circle radius, free distance, rolling moment factor
C_RACE_SIZE = 4
C_BALL_RADIUS = C_RACES + 2 * C_RACE_SIZE
C_SIZE = 32

# --- s: state ----------------------------------------------------------------------------------------
S_Y = 0
S_F = S_Y + Y_SIZE  # right-hand side at the state: accelerations start the next step
S_C = S_F + F_SIZE
(
    S_TIME,
    S_ANGLE,  # of the inner ring
    S_SPEED,  # reached at S_TIME
    S_SPEED_RATE,
    S_WORK,
    S_HEAT_INNER,
    S_HEAT_OUTER,
    S_HEAT_OIL,
    S_ENERGY_START,
    S_STEP,  # internal step proposed next
    S_FACTOR_STEP,  # step for which the factors hold; 0: none
    S_JACOBIAN_TIME,
    S_JACOBIAN_ANGLE,
    S_CONTRACTION,
    S_STEPS,
    S_REJECTED,
    S_MEAN_INNER,  # heats averaged over the last communication step
    S_MEAN_OUTER,
    S_MEAN_OIL,
    S_SAMPLE,  # index of the next sound sample
    S_START,  # time of initialisation
    S_NEWTON,  # iterations so far
    S_JACOBIANS,
    S_ENERGY_NOW,
    S_FALLBACKS,  # times the one-evaluation path was left
    S_FAST_STEP,  # its step: wanted, and that of the history; history's length in steps, 0 to 3
    S_FAST_LENGTH,
    S_FAST_COUNT,
    S_FAST_HOLD,  # time before which it is not tried
    S_FAST_PATIENCE,  # s: the next hold
    S_FAST_BETA,  # Newmark's beta of the balls
    S_SPIN_TO_ROLL,  # inner, outer: means over the loaded contacts at the last communication point
    S_SPIN_TO_ROLL_OUTER,
    S_SLIP,
    S_SLIP_OUTER,
    S_LOSS,  # W: contacts, rolling, cage, drag
    S_LOSS_ROLLING,
    S_LOSS_CAGE,
    S_LOSS_DRAG,
    S_PLACE,  # m: where rigid preload takes the inner ring
) = range(S_C + C_SIZE, S_C + C_SIZE + 40)
S_AXES = S_C + C_SIZE + 48  # the balls' body-fixed axes in their orbiting axes, 3 rows
S_JAC = S_AXES + 3 * STRIDE  # raw blocks: B 6x9, C 6x34, D 17x9 rows per lane, E 17x34
J_B, J_C, J_D = 0, 54 * STRIDE, (54 + 204) * STRIDE
J_E = (54 + 204 + 153) * STRIDE
J_SIZE = J_E + 17 * 34
S_FAC = S_JAC + J_SIZE  # factors: inverse 6x6, W 6x17, M_Gb 17x6 rows per lane, inverse 17x17 by columns
A_INV, A_W, A_GB = 0, 36 * STRIDE, (36 + 102) * STRIDE
A_S = (36 + 102 + 102) * STRIDE
BORDER = 20  # numbers per column of the inverse: 17, rounded up to whole vectors
A_SPRING = A_S + 17 * BORDER  # coupling of neighbouring balls: strength, bodies' answers, inverse Z x Z
A_SPRING_BODY = A_SPRING + 1
A_SPRING_BALLS = A_SPRING_BODY + 17 * STRIDE
A_SIZE = A_SPRING_BALLS + MAX_BALLS * MAX_BALLS
# the one-evaluation path: its own rates (trapezoidal rule), accelerations now and two steps back
S_FAST = S_FAC + A_SIZE
FAST_Y, FAST_A0, FAST_A1, FAST_A2 = 0, Y_SIZE, Y_SIZE + F_SIZE, Y_SIZE + 2 * F_SIZE
S_LEVEL = S_FAST + Y_SIZE + 3 * F_SIZE  # what the levels `rings` and `response` keep: see engine/levels
L_SIZE = 4992
S_SOUND = S_LEVEL + L_SIZE

# --- w: rows of the force evaluation, then stages --------------------------------------------------
W_COS, W_SIN = 0, 1
W_POSE = 2  # per body 20 rows
POSE_ROWS = 20
X_Q, X_N, X_H, X_T, X_A, X_RHO, X_DV, X_DW = 0, 3, 6, 9, 12, 13, 14, 17
W_RACE = W_POSE + 3 * POSE_ROWS  # per race 30 rows
RACE_ROWS = 30
(
    R_EN,
    R_EM,
    R_APPROACH,
    R_RATE,
    R_LOAD,
    R_ELASTIC,
    R_UT,
    R_UM,
    R_AN,
    R_AT,
    R_AM,
    R_SCALE,
    R_FT,
    R_FM,
    R_MN,
    R_MT,
    R_MM,
    R_HALF,
    R_WAVE,
    R_SLOPE,
    R_ENTRAIN,
    R_ROLL,
    R_SINA,
    R_COSA,
    R_BUMP_T,  # slope of the ball's own waviness towards e_t and e_m
    R_BUMP_M,
) = (0, 3, *range(6, 30))
W_POCKET = W_RACE + 2 * RACE_ROWS  # penetration of the pocket
W_FORCE = W_POCKET + 2  # per body 6 rows: force and moment on the ball
W_G = W_FORCE + 18  # 17 rows: generalised forces on the bodies
W_SHAFT = W_G + 17  # moment on the inner ring about its own axis
W_LOSS = W_SHAFT + 1  # dissipated per body, and by drag
W_AXES = W_LOSS + 4  # the balls' body-fixed axes at the state evaluated
W_ROWS = W_AXES + 3
W_SCALARS = W_ROWS * STRIDE  # scratch scalars
STAGES = modes_layout.STAGES
W_Y = W_SCALARS + 64  # stage state
W_F = W_Y + Y_SIZE
W_F0 = W_F + F_SIZE  # unperturbed right-hand side
W_D = W_F0 + F_SIZE  # Newton increment
W_ACC = W_D + F_SIZE  # stage accelerations, STAGES x F_SIZE
W_VEL = W_ACC + STAGES * F_SIZE  # stage velocities in the layout of accelerations
W_LAST = W_ACC + (STAGES - 1) * F_SIZE  # accelerations at the end of a step, of any method
# a block of one-evaluation steps: accelerations two and one step back, then states and accelerations
BLOCK = 8
W_BLOCK_A = W_VEL + STAGES * F_SIZE
W_BLOCK_Y = W_BLOCK_A + (BLOCK + 3) * F_SIZE
W_FLEX = W_BLOCK_A  # flexible rings: never together with one-evaluation steps; see modes_layout
W_MOTION = W_BLOCK_Y + (BLOCK + 1) * Y_SIZE
W_G0 = W_MOTION + MO_BALLS + MO_PER_BALL * MAX_BALLS + 2 * modes_layout.MAX_MODES
W_SOUND = W_G0 + N_BODY * STRIDE


def state_size(p):
    """Length of ``s`` for the parameters ``p``."""
    return S_SOUND + int(p[P_SOUND_STATE]) + modes_layout.state_size(int(p[P_MODES]))


def work_size(p):
    """Length of ``w`` for the parameters ``p``."""
    return W_SOUND + int(p[P_SOUND_WORK]) + 8


# --- status codes -------------------------------------------------------------------------------------
OK = 0
NOT_CONVERGED = 1  # the step did not converge at the smallest internal step
BAD_INPUT = 2  # an input is not finite or out of range
BAD_STEP = 3  # communication step not positive or not finite
NO_START = 4  # the quasi-static start did not converge
TOO_SOFT = 5  # the loads push the outer ring sideways by more than 0.3 of the pitch radius
RIGID_ONLY = 6  # flexible rings, and a level or method that knows rigid ones only

# --- out of the quasi-static equilibrium (solvers/quasistatic.py) ----------------------------------------
Q5_SHIFT = 0  # x y z by bz of the inner ring against the outer (m, rad)
Q5_RESIDUAL = 5  # N; moments over the pitch radius
Q5_ITERATIONS = 6
Q5_STIFFNESS = 7  # 5 x 5, row by row: force or moment on x y z by bz per displacement
# then ten rows of STRIDE: ball's place (m), orbit speed and spin (rad/s), loads (N), contact angles (rad)
Q5_X, Q5_R, Q5_OM, Q5_WX, Q5_WR, Q5_WT, Q5_LOAD_I, Q5_LOAD_O, Q5_ANGLE_I, Q5_ANGLE_O = (
    32 + k * STRIDE for k in range(10)
)
Q5_SIZE = 32 + 10 * STRIDE
