"""U: inputs: :data:`INPUTS` of the assembly, then :data:`BEARING_INPUTS` of each bearing.

A single bearing has the inputs of a set of one; its inner ring takes the place of the shaft's nose. Kernels
of one bearing are given the inputs of a set of one, too: see `spindle.inputs.bearing_inputs`.
"""

INPUTS = (
    "shaft_speed", "nose.force.x", "nose.force.y", "nose.force.z", "nose.moment.y", "nose.moment.z",
    "preload", "pedestal_stiffness", "port.displacement.x", "port.displacement.y", "port.displacement.z",
    "port.tilt.y", "port.tilt.z", "port.velocity.x", "port.velocity.y", "port.velocity.z",
    "port.tilt_rate.y", "port.tilt_rate.z", "shaft_temperature", "housing_temperature",
)  # fmt: skip
BEARING_INPUTS = ("oil_temperature", "inner_ring_temperature", "outer_ring_temperature")
SPEED = INPUTS.index("shaft_speed")  # rad/s
NOSE = INPUTS.index("nose.force.x")  # N, three, then moments about y and z (N m)
LOAD_Y = INPUTS.index("nose.force.y")
LOAD_Z = INPUTS.index("nose.force.z")
PRELOAD = INPUTS.index("preload")  # N: of a single bearing, or of springs
PEDESTAL = INPUTS.index("pedestal_stiffness")  # N/m
PORT = INPUTS.index("port.displacement.x")  # m, rad: where another model puts the shaft
PORT_RATE = INPUTS.index("port.velocity.x")  # m/s, rad/s
# K: from here on temperatures alone
SHAFT_T = INPUTS.index("shaft_temperature")  # of what holds inner rings,
HOUSING_T = INPUTS.index("housing_temperature")  # and outer ones
BEARINGS = len(INPUTS)  # per bearing BEARING_INPUTS
ROW = len(BEARING_INPUTS)
OIL, INNER, OUTER = range(ROW)
OIL_T, INNER_T, OUTER_T = range(BEARINGS, BEARINGS + ROW)  # of the first bearing
SIZE = BEARINGS + ROW  # of one bearing
