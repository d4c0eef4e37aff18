"""U: inputs, in the order of :data:`INPUTS`."""

INPUTS = (
    "shaft_speed", "preload", "pedestal_stiffness", "radial_load.y", "radial_load.z", "oil_temperature",
    "inner_ring_temperature", "outer_ring_temperature", "shaft_temperature", "housing_temperature",
)  # fmt: skip
SPEED = INPUTS.index("shaft_speed")  # rad/s
PRELOAD = INPUTS.index("preload")  # N
PEDESTAL = INPUTS.index("pedestal_stiffness")  # N/m
LOAD_Y = INPUTS.index("radial_load.y")  # N
LOAD_Z = INPUTS.index("radial_load.z")  # N
OIL_T = INPUTS.index("oil_temperature")  # K
INNER_T = INPUTS.index("inner_ring_temperature")  # K
OUTER_T = INPUTS.index("outer_ring_temperature")  # K
SHAFT_T = INPUTS.index("shaft_temperature")  # K: of what holds the inner ring,
HOUSING_T = INPUTS.index("housing_temperature")  # K: and the outer
SIZE = len(INPUTS)
