"""Constants of nature and convention."""

import math

REFERENCE_TEMPERATURE = 293.15  # K: viscosity is the reference one, expansion is zero
GRAVITY = 9.81  # m/s2, along -Z
PI = math.pi
RPM = math.pi / 30.0  # rad/s
STANDSTILL = 1e-9  # rad/s: below it nothing is divided by the shaft speed
