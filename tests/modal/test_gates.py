"""Natural frequencies by an independent computation, on the frozen scenes; 0.1 %, damping 5 %."""

import numpy as np
import pytest

from fmu_bearing.modal.modes.points import modes

RPM = np.pi / 30.0
#: Hz, and damping ratio where one is known, by name, direction.
SPINDLE = {
    10_000: {
        ("outer axial", ""): (465.5, None), ("outer radial", "forward"): (466.3, None),
        ("outer radial", "backward"): (466.3, None), ("inner tilt", "backward"): (1925.9, None),
        ("inner tilt", "forward"): (1928.0, None), ("inner axial", ""): (2465.6, None),
        ("inner radial", "backward"): (4224.2, None), ("inner radial", "forward"): (4223.9, None),
    },
    20_000: {
        ("outer axial", ""): (465.5, 0.0467), ("outer radial", "forward"): (466.3, 0.0469),
        ("outer radial", "backward"): (466.3, 0.0469), ("inner tilt", "backward"): (1924.7, 0.0495),
        ("inner tilt", "forward"): (1928.8, 0.0495), ("inner axial", ""): (2462.5, 0.0056),
        ("inner radial", "backward"): (4222.5, 0.008), ("inner radial", "forward"): (4221.9, 0.008),
    },
}  # fmt: skip
BARE = (4102.9, 4300.5, 7022.0, 8537.0, 8590.0, 12865.0, 12867.0, 15235.0, 26441.0, 26480.0)


@pytest.mark.parametrize("rpm", SPINDLE)
def test_modes_of_the_spindle(gate, rpm):
    found = modes(gate("7003C-spindle"), {"shaft_speed": rpm * RPM})
    for (name, direction), (frequency, damping) in SPINDLE[rpm].items():
        mode = found.named(name, direction)
        assert mode.direction == direction
        assert mode.frequency == pytest.approx(frequency, rel=1e-3)
        if damping is not None:
            # printed with two or four digits. Mean of both whirls: rolling resistance sets them apart, and
            # the independent computation took it over the ellipticity (.0075 and .0077, now .0075 and .0078)
            both = [one.damping for one in found.modes if one.name == name]
            assert np.mean(both[:2]) == pytest.approx(damping, rel=0.05, abs=5e-4)


def test_modes_of_the_bare_bearing(gate):
    found = modes(gate("7003C-bare"), {"shaft_speed": 10_000 * RPM})
    hertz = np.array([mode.frequency for mode in found.modes])
    for frequency in BARE:
        assert hertz[np.abs(hertz - frequency).argmin()] == pytest.approx(frequency, rel=1e-3)
    tilts = [mode for mode in found.modes if mode.name == "inner tilt"]
    assert [mode.direction for mode in tilts] == ["backward", "forward"]
    assert [mode.damping for mode in tilts] == pytest.approx([0.0190, 0.0223], rel=0.05)


def test_tilting_mode_without_friction_and_at_standstill(gate):
    scene = gate("7003C-bare")
    sliding = modes(scene, {"shaft_speed": 10_000 * RPM}, friction=False)
    low, high = (mode.frequency for mode in sliding.modes if mode.name == "inner tilt")
    # 0.2 % less than the independent computation; the engine's free decay without traction is at 3962.6
    # and 4143.0 Hz, so here it is the computation that is off
    assert (low, high) == pytest.approx((3962.6, 4143.0), rel=1e-4)
    assert (low, high) == pytest.approx((3971.0, 4151.0), rel=3e-3)
    still = modes(scene, {"shaft_speed": 0.0})
    assert still.named("inner tilt").frequency == pytest.approx(4236.0, rel=1e-3)
    free = modes(scene, {"shaft_speed": 0.0}, friction=False)
    assert free.named("inner tilt").frequency == pytest.approx(4051.7, rel=1e-4)
    assert free.named("inner tilt").frequency == pytest.approx(4060.0, rel=3e-3)


def test_bending_of_the_mounted_rings_is_not_that_of_free_ones(gate):
    """Outer ring n = 2: 6.6 kHz free, 11.18 kHz backward and 11.28 kHz forward in the bearing."""
    bent = {"mounting.flexure": {"outer_ring": [2, 3], "inner_ring": [2]}}
    found = modes(gate("7003C-bare", **bent), {"shaft_speed": 10_000 * RPM})
    for direction, frequency in (("backward", 11_180.0), ("forward", 11_280.0)):
        assert found.named("outer flexure n = 2", direction).frequency == pytest.approx(frequency, rel=3e-3)


@pytest.mark.parametrize(("rpm", "frequency"), [(12_000, 14_330.0), (18_000, 14_750.0)])
def test_radial_mode_of_soft_balls(gate, rpm, frequency):
    """7009C, rigid rings: balls have a transverse mode of 4.6 kHz of their own below it."""
    found = modes(gate("7009C-full-ceramic").with_rigid_rings(), {"shaft_speed": rpm * RPM})
    assert found.near(frequency).frequency == pytest.approx(frequency, rel=2e-3)
