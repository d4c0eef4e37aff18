"""Places of the rings' flexure in the flat arrays; see ``layout``. A scene with rigid rings has none."""

STRIDE = 24  # of ``layout``, which takes both numbers from here
STAGES = 6
MAX_MODES = 16  # flexural modes of both rings

# --- p: one row of MODE_SIZE numbers per mode ------------------------------------------------------------
(
    MODE_BODY,  # 0 inner ring, 1 outer ring
    MODE_ORDER,  # circumferential, 2 or more
    MODE_MASS,  # kg, of one coordinate
    MODE_STIFFNESS,  # N/m, with the seat's
    MODE_DAMPING,  # 1/s: twice damping ratio times free frequency
    MODE_GYROSCOPIC,
    MODE_X,  # shape at the centre of the groove's circle: axial, radial, circumferential,
    MODE_R,
    MODE_T,
    MODE_TILT,  # and rotation about the circumferential direction, 1/m
    MODE_WEIGHT,  # mean square of the shape, for Newton's method and the error
) = range(11)
MODE_SIZE = 12

# --- s and w ------------------------------------------------------------------------------------------------
# In s behind the sound's part, see flexure_state in mechanics/flexure: places, velocities and accelerations
# of the coordinates, then what Newton's method keeps of the contacts: per ring 18 rows of the balls' answer
# to the groove's motion (6 x 3) and 18 of the groove's to the balls' (3 x 6), and four numbers per mode.
FACTOR_ROWS = 36
# In w, from W_FLEX on: rows of the groove's motion under each ball, cosine and sine of the first order, then
# of each mode's; then flat arrays over the coordinates.
(
    FR_X,  # displacement, later force on the ring: axial, radial,
    FR_R,
    FR_GX,  # its change with the angle, later circumferential force and moment; slope and ratio of radii
    FR_GR,
    FR_VX,  # velocity of the material
    FR_VR,
    FR_VT,
    FR_TURN,  # angular velocity about the circumferential direction
    FR_COS,
    FR_SIN,
) = range(10)
FLEX_ROWS = 10
FLAT = (FLEX_ROWS + 2 * MAX_MODES) * STRIDE
ARRAY = 2 * MAX_MODES
# flat arrays: place, velocity, force, acceleration, Newton increment, then accelerations and velocities of
# all stages
FW_Q, FW_V, FW_FORCE, FW_A, FW_D, FW_ACC = (FLAT + k * ARRAY for k in range(6))
FW_VEL = FW_ACC + STAGES * ARRAY


def state_size(modes):
    """Numbers that ``modes`` flexural modes take in ``s``."""
    return 0 if modes == 0 else 6 * modes + 2 * FACTOR_ROWS * STRIDE + 4 * modes
