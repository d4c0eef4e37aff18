"""The run that the tests of this folder share."""

import pytest

from fmu_bearing.testing import Plan


@pytest.fixture
def start() -> Plan:
    """Start of the spindle: speed and preload of the machine it is for, 5 ms in steps of 0.1 ms."""
    return Plan(
        stop_time=5e-3,
        step=1e-4,
        inputs={"shaft_speed": lambda t: 2000.0 + 2e4 * t, "preload": 400.0},  # rad/s, N
        outputs=["friction_torque", "heat.*", "cage.speed_ratio", "inner_ring.velocity.*"],
    )
