"""Modes against the engine's own free decay: 0.1 % of the frequency, 5 % of the damping, and the direction.

Wanted are ten times less: found is 1e-5 of the frequency where the decay is clean.
"""

import numpy as np
import pytest

from fmu_bearing.modal.modes.points import modes
from tests.marks import heavy_but
from tests.modal.decay import axial, bending, nearest, radial

RPM = np.pi / 30.0


def compare(found, poles, order, above=0.0, frequency=1e-4, damping=0.005):
    """Every mode of rings of an order below 30 kHz has its pole; return how many."""
    chosen = [
        mode for mode in found.modes
        if mode.order == order and mode.ring_share > 0.5 and above < mode.frequency < 30e3
    ]  # fmt: skip
    for mode in chosen:
        hertz, zeta = nearest(poles, mode)
        assert hertz == pytest.approx(mode.frequency, rel=frequency), mode.label
        assert zeta == pytest.approx(mode.damping, rel=damping, abs=1e-5), mode.label
    return len(chosen)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("name", "rpm"),
    heavy_but([("7003C-bare", 10_000), ("7003C-bare", 28_000), ("7009C-full-ceramic", 18_000)], 0),
)
def test_free_decay_has_the_frequencies_the_damping_and_the_direction_of_the_modes(gate, name, rpm):
    scene = gate(name).with_rigid_rings()
    found = modes(scene, {"shaft_speed": rpm * RPM})
    assert compare(found, radial(scene, rpm), 1) == 8
    assert compare(found, axial(scene, rpm), 0) == 3


@pytest.mark.heavy
def test_decay_of_a_bearing_that_turns_backwards(gate):
    scene = gate("7003C-bare")
    found = modes(scene, {"shaft_speed": -10_000 * RPM})
    # forward is with the shaft: below zero in axes that count the other way
    assert compare(found, radial(scene, -10_000).conj(), 1) == 8


@pytest.mark.heavy
def test_decay_on_a_pedestal_of_two_stiffnesses(gate):
    """The outer ring swings along the pedestal's axes: neither whirl dominates there."""
    scene = gate("7003C-spindle", **{"mounting.pedestal_stiffness_ratio": 1.5})
    found = modes(scene, {"shaft_speed": 10_000 * RPM})
    low, high = (mode for mode in found.modes if mode.name == "outer radial")
    assert low.direction == high.direction == "" and high.frequency > 1.2 * low.frequency
    poles = radial(scene, 10_000, h=1e-4, count=500, order=40)
    for mode in (low, high):
        hertz, zeta = nearest(poles, mode)
        assert hertz == pytest.approx(mode.frequency, rel=1e-3) and zeta == pytest.approx(
            mode.damping, rel=0.05
        )


@pytest.mark.heavy
def test_decay_of_rings_that_bend(gate):
    bent = {"mounting.flexure": {"outer_ring": [2, 3], "inner_ring": [2]}}
    scene = gate("7003C-bare", **bent)
    found = modes(scene, {"shaft_speed": 10_000 * RPM})
    assert compare(found, bending(scene, 10_000, 0), 2) == 2


@pytest.mark.heavy
def test_decay_under_a_radial_load_has_the_frequencies_of_the_mean_over_a_pitch(gate):
    scene = gate("7003C-bare").with_rigid_rings()
    found = modes(scene, {"shaft_speed": 10_000 * RPM, "radial_load.z": -200.0})
    poles = radial(scene, 10_000, load_z=-200.0, order=40)
    tilts = [mode for mode in found.modes if mode.name == "inner tilt"]
    assert len(tilts) == 2
    for mode in tilts:
        hertz, zeta = nearest(poles, mode)
        assert hertz == pytest.approx(mode.frequency, rel=1e-3) and zeta == pytest.approx(
            mode.damping, rel=0.05
        )
