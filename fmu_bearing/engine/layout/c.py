"""C: conditions, held over a communication step."""

from fmu_bearing.engine.layout.sizes import MAX_DEFECTS, Places

_race = Places()
GROOVE_X = _race()  # m: circle of groove centres, its place along the axis
GROOVE_RADIUS = _race()  # m: and its radius
FREE = _race()  # m: distance of ball and groove centre without load
ROLLING = _race()  # N m: rolling moment factor at the oil's viscosity, of EHL
INTERFERENCE = _race()  # m on the radius, + tight: of the ring on its shaft, in its housing
GROWTH = _race()  # m: of the race by fit and rotation, in GROOVE_START
GROWTH_RATE = _race()  # m/s: within a communication step of fidelity full
GROOVE_START = _race()  # m: GROOVE_RADIUS at the state; in a step that grows it is that of a stage
RIGID = _race()  # N m: rolling moment factor of rigid surfaces
REGIME = _race()  # weight of EHL against 1 of rigid surfaces, but for load and speed
RACE_SIZE = _race.next

_at = Places()
PRELOAD = _at()  # N
LOAD_Y = _at()  # N
LOAD_Z = _at()  # N
PEDESTAL = _at()  # N/m, radial, along the second of its axes,
PEDESTAL_Y = _at()  # along y, along z and between both
PEDESTAL_Z = _at()
PEDESTAL_YZ = _at()
PEDESTAL_AXIAL = _at()  # N/m
PEDESTAL_ROTATIONAL = _at()  # N m/rad
DAMPING_Y = _at()  # N s/m, radial
DAMPING_Z = _at()
DAMPING_YZ = _at()
DAMPING_AXIAL = _at()  # N s/m
DAMPING_ROTATIONAL = _at()  # N m s/rad, of tilts
DAMPING_SPIN = _at()  # N m s/rad, about the axis
VISCOSITY = _at()  # Pa s
LAND_VISCOSITY = _at()  # Pa s
LAND_CLEARANCE = _at()  # m
THINNING = _at()  # 1/K: what a kelvin takes of the logarithm of the viscosity; 0 without thermal traction
OVERSIZE_SCALE = _at()  # factor on ball sizes and waviness
DEFECT_SCALE = _at(MAX_DEFECTS)  # of each local defect of the bearing, beside OVERSIZE_SCALE
ECCENTRICITY = _at()  # m, of the rotating parts
CAGE_ECCENTRICITY = _at()  # m
RACES = _at(2 * RACE_SIZE)  # inner, outer
BALL_RADIUS = _at()  # m
POCKET = _at()  # N/m^1.5: contact of ball and pocket
NEUTRAL_Y = _at()  # m: where the pedestal's springs are free; zero but while a start is searched
NEUTRAL_Z = _at()
USED = _at.next  # places from here on are spare: nothing writes them
SIZE = _at.next
