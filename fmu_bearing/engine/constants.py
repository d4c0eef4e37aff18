"""Constants of nature and convention."""

import math

REFERENCE_TEMPERATURE = 293.15  # K: viscosity is the reference one, expansion is zero
GRAVITY = 9.81  # m/s2, along -Z
PI = math.pi
RPM = math.pi / 30.0  # rad/s
STANDSTILL = 1e-9  # rad/s: below it nothing is divided by the shaft speed
# Longest internal steps of fidelity full: the default of scenes; where a bearing has neither waves nor sound
# nor cage, and so many radians of its fastest whirl in a step. At 0.7 rad a whirl grows by 4 % too slowly, at
# 1.0 by 16 % (docs/choosing.md).
USUAL_STEP = 25e-6  # s
LONGEST_STEP = 100e-6  # s
PER_STEP = 0.75  # rad
