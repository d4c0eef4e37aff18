"""P: parameters, written by ``prepare``; the engine copies the tunable ones to all bearings of a set."""

from fmu_bearing.engine.layout.sizes import Places

_at = Places()
# head: tunable before initialisation
FIDELITY = _at()  # see choices.FIDELITIES
TOLERANCE = _at()  # relative, on ring velocities
MAX_STEP = _at()  # s
IMPERFECTION_SCALE = _at()
TIME_WEIGHTING = _at()  # s: 0.125 Fast, 1 Slow
METERING_START = _at()  # s after initialisation
VISCOSITY = _at()  # Pa s at the reference temperature
INTERFERENCE = _at(2)  # m on diameter, + tight, at the reference temperature: shaft, housing
TUNABLE = _at.next  # places before this one
# counts and choices
METHOD = _at()  # integrator of fidelity full: see choices.METHODS
RACE_CONTROL = _at()  # see choices.RACE_CONTROLS
TRACTION_LAW = _at()  # see choices.TRACTION_LAWS
VISCOSITY_LAW = _at()  # see choices.VISCOSITY_LAWS
ROLLING_LAW = _at()  # see choices.ROLLING_LAWS
THERMAL_TRACTION = _at()  # 1: friction heats the oil that it shears
BALLS = _at()  # number of balls
LANES = _at()  # balls rounded up to a multiple of 4; the lanes beyond copy ball 0
MICS = _at()  # number of microphones
BANDS = _at()  # third octaves per microphone; 0: none
STRIPS = _at()  # over a contact's major axis
MODES = _at()  # flexural modes of both rings; 0: rigid rings
INNER_MODES = _at()  # those of the inner ring, which come first in the table
BALL_WAVES = _at()  # zonal orders of the balls' waviness; 0: none
WAVE_ORDERS = _at()  # highest order of the races' waviness; 0: none
WAVE_INTERVALS = _at()  # of a race table: a power of two
# switches: 1 computed, 0 left out
CAGE = _at()
GRAVITY = _at()
DRAG = _at()
ROLLING = _at()
REDUCTION = _at()  # thermal and starvation factors of the rolling resistance
LAND = _at()
GYROSCOPIC = _at()
WAVINESS = _at()
RIGID = _at()  # rigid preload
FITS = _at()  # fits of the rings on shaft or in housing
UNMOUNTED = _at()  # preload is that of the loose bearing
READ_BALLS = _at()  # outputs of balls and contacts are read; else `response` finds them for warnings alone
READ_SOUND = _at()  # outputs of microphones are read
# offsets into p
AT_STRIPS = _at()  # strip nodes, then weights
AT_OVERSIZE = _at()  # m: ball diameter deviations, one per lane
AT_WAVES = _at()  # m: race tables: inner then outer, values and slopes interleaved
AT_ORDERS = _at()  # m: complex amplitudes of orders 1 .. WAVE_ORDERS, inner then outer
AT_FORM = _at()  # form of the balls: FORM_ROW numbers per zonal order from 0 on
AT_AXES = _at()  # the balls' body-fixed axes, 3 rows
AT_MODES = _at()  # MODE_SIZE numbers per mode
AT_SOUND = _at()  # sound block; 0: there is none
SOUND_SIZE = _at()  # its length, and the lengths of its state and work space
SOUND_STATE = _at()
SOUND_WORK = _at()
SET = _at()  # block of a set of bearings, see spindle; 0: parameters of one of its bearings
ALONE = _at()  # 1: a single bearing, the only one of its set, without shaft
# balls, contacts, oil
PITCH_RADIUS = _at()  # m
DIAMETER = _at()  # m, of a ball
BALL_MASS = _at()  # kg
BALL_INERTIA = _at()  # kg m2
BALL_EXPANSION = _at()  # 1/K
CONTACT_DAMPING = _at()  # s: damping coefficient over contact stiffness
MU = _at()  # largest traction over load
SLIDE_TO_ROLL = _at()  # at which traction levels off
TRACTION_FLOOR = _at()  # m/s
EYRING_STRESS = _at()  # Pa
PRESSURE_VISCOSITY = _at()  # 1/Pa
VOGEL_B = _at()  # K
VOGEL_C = _at()  # K
WALTHER_SLOPE = _at()
OIL_DENSITY = _at()  # kg/m3
OIL_CONDUCTIVITY = _at()  # W/(m K)
SHEAR_HEATING = _at()  # constants of the SKF reduction factors, for speed in r/min and viscosity in mm2/s
STARVATION = _at()
STARVATION_HELD = _at()  # 1: no further than to the largest rolling resistance over viscosity
DRAG_FACTOR = _at()  # N/(m/s)^2
ROUGHNESS = _at()  # m rms, both surfaces
# bodies
INNER_MASS = _at()  # kg, with the rotor
INNER_TRANSVERSE = _at()  # kg m2
INNER_POLAR = _at()  # kg m2
OUTER_MASS = _at()  # kg, with the housing
OUTER_TRANSVERSE = _at()  # kg m2
OUTER_POLAR = _at()  # kg m2
CAGE_MASS = _at()  # kg
CAGE_TRANSVERSE = _at()  # kg m2
CAGE_POLAR = _at()  # kg m2
CAGE_ECCENTRICITY = _at()  # m: centre of mass of the cage
ECCENTRICITY = _at()  # m: centre of mass of the rotating parts
SUPPORT_STIFFNESS = _at(5)  # N/m along x y z, N m/rad about y z: springs between inner ring and ground
SUPPORT_DAMPING = _at(5)  # N s/m, N m s/rad: dampers beside them
AXIAL_RATIO = _at()  # pedestal stiffness, axial over radial
ROTATIONAL_RATIO = _at()  # m2: rotational over radial
PEDESTAL_ZETA = _at()  # damping ratio
PEDESTAL_Y = _at()  # radial stiffness along y, along z and between both, over the pedestal's,
PEDESTAL_Z = _at()
PEDESTAL_YZ = _at()
PEDESTAL_DAMPING_Y = _at()  # and its damping
PEDESTAL_DAMPING_Z = _at()
PEDESTAL_DAMPING_YZ = _at()
MISALIGNMENT_Y = _at()  # rad, of the outer ring's seat against the shaft
MISALIGNMENT_Z = _at()  # rad
# cage, or springs in its place
GUIDANCE = _at()  # of the cage: see choices.GUIDANCES
POCKET_CLEARANCE = _at()  # m
POCKET_STIFFNESS = _at()  # N/m^1.5
POCKET_DAMPING = _at()  # s/m: Hunt-Crossley
POCKET_FRICTION = _at()
POCKET_SLIP = _at()  # m/s
POCKET_FILM = _at()  # N s/m
LAND_RADIUS = _at()  # m: of the journal, which is the inner ring or a cage in the outer one
LAND_LENGTH = _at()  # m
LAND_OFFSET = _at()  # m
LAND_CLEARANCE = _at()  # m
LAND_VISCOSITY = _at()  # Pa s; where the oil has its own in the lands:
LAND_SLIDE = _at()  # m: sliding speed of the land on the cage over the speed of the shaft; else 0
LAND_STOP_STIFFNESS = _at()  # N/m
LAND_STOP_FRACTION = _at()  # of the clearance
LAND_STOP_FRICTION = _at()
LAND_STOP_SLIP = _at()  # m/s
SPRINGS = _at()  # N/m between adjacent balls; 0: none
SPRING_DAMPING = _at()  # N s/m
SEAL_TORQUE = _at()  # N m: of all seals of the bearing while it turns; 0: none
MODE_STEP = _at()  # s: longest internal step that resolves the modes
TURN_RATE = _at()  # rad per rad of the shaft: fastest whirl where no waves, sound or cage ask for short steps
WAVE_RATE = _at()  # rad per rad of the shaft: the fastest phase of a wave under the balls; 0: none

# per race
_race = Places()
RACE_STIFFNESS = _race()  # N/m^1.5
RACE_HALF_LENGTH = _race()  # m^0.5: semi-major axis over sqrt(approach)
RACE_PRESSURE = _race()  # Pa/m^0.5: peak pressure over sqrt(approach)
RACE_PROFILE_RADIUS = _race()  # m: of the deformed contact surface across the rolling direction
RACE_ROLLING = _race()  # rolling moment factor at viscosity 1 Pa s: of EHL,
RACE_RIGID = _race()  # and of rigid surfaces in isoviscous oil
RACE_REGIME = _race()  # weight of EHL against 1 of rigid surfaces, at viscosity 1 Pa s
RACE_HYSTERESIS = _race()  # rolling moment by hysteresis over load times semi-major axis
RACE_FILM = _race()  # minimum film factor at viscosity 1 Pa s
RACE_GROOVE_X = _race()  # m: circle of groove centres
RACE_GROOVE_RADIUS = _race()  # m: its radius
RACE_GROOVE = _race()  # m: groove radius
RACE_EXPANSION = _race()  # 1/K
RACE_HALF_WIDTH = _race()  # m^0.5: semi-minor axis over sqrt(approach)
RACE_EFFUSIVITY = _race()  # W s^0.5/(m2 K): of ring and ball together
RACE_CENTRAL_FILM = _race()  # central film factor at viscosity 1 Pa s
RACE_SHOULDER = _race()  # rad: contact angle at which the groove ends
# fit of the ring; interference on the radius. All zero: a ring as drawn
RACE_FIT_OWN = _race()  # m on diameter: of this bearing's fit beyond ``INTERFERENCE``
RACE_FIT_RING = _race()  # m/K: interference by the ring's temperature
RACE_FIT_PARTNER = _race()  # m/K: and by that of shaft or housing
RACE_FIT_SPIN = _race()  # m s2: and over the square of the speed
RACE_FIT_SHARE = _race()  # growth of the race over interference
RACE_SPIN = _race()  # m s2: growth of the ring alone over the square of the speed
RACE_FIT_PRESSURE = _race()  # Pa/m: pressure of the fit over interference
RACE_HOOP = _race()  # hoop stress at the ring's inner surface over this pressure
RACE_SPIN_HOOP = _race()  # Pa s2: and over the square of the speed
RACE_SIZE = _race.next
RACES = _at(2 * RACE_SIZE)  # inner, outer
TABLES = _at.next  # tables of variable length begin here

# per zonal order of the balls' form, at AT_FORM; polynomials without their leading coefficients
_form = Places()
FORM_HEIGHT = _form()  # m
FORM_RISE = _form()  # m: of its derivative by the cosine
FORM_BACK = _form()  # share of the polynomial before in the next one
FORM_ROW = _form.next

# per flexural mode, at AT_MODES
_mode = Places()
MODE_BODY = _mode()  # 0 inner ring, 1 outer ring
MODE_ORDER = _mode()  # circumferential, 2 or more
MODE_MASS = _mode()  # kg, of one coordinate
MODE_STIFFNESS = _mode()  # N/m, with the seat's
MODE_DAMPING = _mode()  # 1/s: twice damping ratio times free frequency
MODE_GYROSCOPIC = _mode()
MODE_X = _mode()  # shape at the centre of the groove's circle: axial,
MODE_R = _mode()  # radial,
MODE_T = _mode()  # circumferential,
MODE_TILT = _mode()  # 1/m: and rotation about the circumferential direction
MODE_WEIGHT = _mode()  # mean square of the shape, for Newton's method and the error
_SPARE = _mode()
MODE_SIZE = _mode.next
