"""Z: outputs. Those of :data:`BEARING_OUTPUTS` in their order, then balls, microphones, modes, defects."""

BEARING_OUTPUTS = (
    "inner_ring.velocity.x", "inner_ring.velocity.y", "inner_ring.velocity.z", "outer_ring.velocity.x",
    "outer_ring.velocity.y", "outer_ring.velocity.z", "cage.velocity.x", "cage.velocity.y",
    "cage.velocity.z", "friction_torque", "heat.inner_ring", "heat.outer_ring", "heat.oil",
    "cage.speed_ratio", "inner_ring.displacement.x", "inner_ring.displacement.y",
    "inner_ring.displacement.z", "outer_ring.displacement.x", "outer_ring.displacement.y",
    "outer_ring.displacement.z", "contact.inner.load_mean", "contact.inner.load_max",
    "contact.inner.angle_mean", "contact.inner.pressure_max", "contact.outer.load_mean",
    "contact.outer.load_max", "contact.outer.angle_mean", "contact.outer.pressure_max", "film.lambda_min",
    "stiffness.axial", "stiffness.radial", "solver.steps", "solver.rejected", "solver.restarts",
    "solver.growth", "solver.wave_time", "energy.residual", "inner_ring.tilt.y", "inner_ring.tilt.z",
    "contact.inner.spin_to_roll", "contact.outer.spin_to_roll", "contact.inner.slip",
    "contact.outer.slip", "cage.whirl_radius", "cage.whirl_speed", "friction_torque_share.contacts",
    "friction_torque_share.rolling", "friction_torque_share.cage", "friction_torque_share.drag",
    "friction_torque_share.seals",
    "contact.inner.shoulder_margin", "contact.outer.shoulder_margin", "friction_torque_mean",
    "contact.free_angle", "fit.inner.interference", "fit.inner.pressure", "fit.inner.hoop_stress",
    "fit.inner.race_growth", "fit.outer.interference", "fit.outer.pressure", "fit.outer.hoop_stress",
    "fit.outer.race_growth", "clearance",
)  # fmt: skip
INNER_VELOCITY = BEARING_OUTPUTS.index("inner_ring.velocity.x")  # m/s, three
OUTER_VELOCITY = BEARING_OUTPUTS.index("outer_ring.velocity.x")
CAGE_VELOCITY = BEARING_OUTPUTS.index("cage.velocity.x")
TORQUE = BEARING_OUTPUTS.index("friction_torque")  # N m
MEAN_TORQUE = BEARING_OUTPUTS.index("friction_torque_mean")
HEAT = BEARING_OUTPUTS.index("heat.inner_ring")  # W, then outer ring, oil
HEAT_SIZE = 3
CAGE_RATIO = BEARING_OUTPUTS.index("cage.speed_ratio")
INNER_PLACE = BEARING_OUTPUTS.index("inner_ring.displacement.x")  # m, three
OUTER_PLACE = BEARING_OUTPUTS.index("outer_ring.displacement.x")
CONTACT = BEARING_OUTPUTS.index("contact.inner.load_mean")  # four of the inner, four of the outer race
LOAD_MEAN = 0  # N: places among a race's four
LOAD_MAX = BEARING_OUTPUTS.index("contact.inner.load_max") - CONTACT
ANGLE_MEAN = BEARING_OUTPUTS.index("contact.inner.angle_mean") - CONTACT  # rad
PRESSURE_MAX = BEARING_OUTPUTS.index("contact.inner.pressure_max") - CONTACT  # Pa
CONTACT_SIZE = BEARING_OUTPUTS.index("contact.outer.load_mean") - CONTACT
LAMBDA = BEARING_OUTPUTS.index("film.lambda_min")
AXIAL_STIFFNESS = BEARING_OUTPUTS.index("stiffness.axial")  # N/m
RADIAL_STIFFNESS = BEARING_OUTPUTS.index("stiffness.radial")
STEPS = BEARING_OUTPUTS.index("solver.steps")
REJECTED = BEARING_OUTPUTS.index("solver.rejected")
RESTARTS = BEARING_OUTPUTS.index("solver.restarts")
GROWTH = BEARING_OUTPUTS.index("solver.growth")  # 1/s
WAVE_TIME = BEARING_OUTPUTS.index("solver.wave_time")  # s
RESIDUAL = BEARING_OUTPUTS.index("energy.residual")
TILT = BEARING_OUTPUTS.index("inner_ring.tilt.y")  # rad, about y and z
SPIN_TO_ROLL = BEARING_OUTPUTS.index("contact.inner.spin_to_roll")  # inner, outer
SLIP = BEARING_OUTPUTS.index("contact.inner.slip")  # m/s: inner, outer
WHIRL_RADIUS = BEARING_OUTPUTS.index("cage.whirl_radius")  # m
WHIRL_SPEED = BEARING_OUTPUTS.index("cage.whirl_speed")  # rad/s
SHOULDER = BEARING_OUTPUTS.index("contact.inner.shoulder_margin")  # rad: inner, outer
TORQUE_CONTACTS = BEARING_OUTPUTS.index("friction_torque_share.contacts")  # N m, then rolling, cage, drag
TORQUE_SEALS = BEARING_OUTPUTS.index("friction_torque_share.seals")  # N m
FREE_ANGLE = BEARING_OUTPUTS.index("contact.free_angle")  # rad
FIT = BEARING_OUTPUTS.index("fit.inner.interference")  # four of the inner, four of the outer ring
FIT_INTERFERENCE = 0  # m on diameter: places among a ring's four
FIT_PRESSURE = BEARING_OUTPUTS.index("fit.inner.pressure") - FIT  # Pa
FIT_HOOP = BEARING_OUTPUTS.index("fit.inner.hoop_stress") - FIT  # Pa
FIT_GROWTH = BEARING_OUTPUTS.index("fit.inner.race_growth") - FIT  # m
FIT_SIZE = BEARING_OUTPUTS.index("fit.outer.interference") - FIT
CLEARANCE = BEARING_OUTPUTS.index("clearance")  # m, radial, on diameter
BALLS = len(BEARING_OUTPUTS)  # m/s: ball[j].velocity.x|y|z at BALLS + PER_BALL j
PER_BALL = 3

MIC_OUTPUTS = (
    "pressure", "spl", "spl_a", "leq", "leq_a", "spl_inner_ring", "spl_outer_ring", "spl_cage", "spl_balls",
    "spl_fast", "spl_fast_a", "spl_slow", "spl_slow_a", "spl_energy_sum", "spl_radial", "spl_axial",
    "spl_rotation", "spl_flexure",
)  # fmt: skip
PER_MIC = len(MIC_OUTPUTS)
#: Third octaves: nominal mid-band frequencies in Hz, IEC 61260-1; the exact ones are 10^(n/10).
BANDS = (
    25.0, 31.5, 40.0, 50.0, 63.0, 80.0, 100.0, 125.0, 160.0, 200.0, 250.0, 315.0, 400.0, 500.0, 630.0, 800.0,
    1000.0, 1250.0, 1600.0, 2000.0, 2500.0, 3150.0, 4000.0, 5000.0, 6300.0, 8000.0, 10000.0, 12500.0, 16000.0,
)  # fmt: skip
DEFECT_OUTPUTS = ("passages", "load", "time", "entry", "impact")
DEFECT_PASSAGES = DEFECT_OUTPUTS.index("passages")
DEFECT_LOAD = DEFECT_OUTPUTS.index("load")  # N
DEFECT_TIME = DEFECT_OUTPUTS.index("time")  # s
DEFECT_ENTRY = DEFECT_OUTPUTS.index("entry")  # s
DEFECT_IMPACT = DEFECT_OUTPUTS.index("impact")  # s
PER_DEFECT = len(DEFECT_OUTPUTS)


ACCELEROMETER_OUTPUTS = ("acceleration", "rms", "peak", "kurtosis")  # m/s2 but the last
PER_ACCELEROMETER = len(ACCELEROMETER_OUTPUTS)
ACCELERATION, ACCELERATION_RMS, ACCELERATION_PEAK, KURTOSIS = range(PER_ACCELEROMETER)


def mics(n_balls):
    """Place of the first microphone's first output for ``n_balls`` balls."""
    return BALLS + PER_BALL * n_balls


def bands(n_balls, n_mics):
    """Place of the first microphone's first third octave: after all its other outputs."""
    return mics(n_balls) + PER_MIC * n_mics


def flexures(n_balls, n_mics, n_bands=0):
    """Place of the flexural velocities: two for each mode, cosine then sine."""
    return bands(n_balls, n_mics) + n_bands * n_mics


def defects(n_balls, n_mics, n_bands=0, n_modes=0):
    """Place of the outputs of local defects: :data:`DEFECT_OUTPUTS` of each, one after the other."""
    return flexures(n_balls, n_mics, n_bands) + 2 * n_modes


def accelerometers(n_balls, n_mics, n_bands=0, n_modes=0, n_defects=0):
    """Place of the first accelerometer's first output, behind those of local defects."""
    return defects(n_balls, n_mics, n_bands, n_modes) + PER_DEFECT * n_defects


def size(n_balls, n_mics, n_bands=0, n_modes=0, n_defects=0, n_accelerometers=0):
    """Length of ``z`` by the numbers of balls, microphones, their third octaves, flexural modes and so on."""
    at = accelerometers(n_balls, n_mics, n_bands, n_modes, n_defects)
    return at + PER_ACCELEROMETER * n_accelerometers
