"""Geometry and oil push the results where mechanics says, one named expectation each."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import Z
from tests.extremes.bearings import PERFECT, RPM, bearing, drive
from tests.extremes.cases import COMPUTED


def settled(changes=None, inputs=None, name="7003C-bare", rpm=2e4):
    """Means over the last third of 15 ms of a perfect bearing."""
    run = bearing(name, PERFECT | (changes or {}), {"rpm": rpm} | (inputs or {}))
    run.initialise()
    rows = np.array(drive(run, 0.015, 1e-4).rows)[-50:]
    return dict(zip(Z.BEARING_OUTPUTS, rows.mean(0), strict=False))


@pytest.fixture(scope="module")
def usual():
    return settled()


def test_conformity(usual):
    """An open groove bears on a shorter, less stiff ellipse: higher pressure, less sliding by spin."""
    open_ = settled({"bearing.inner_conformity": 0.54})
    assert open_["stiffness.axial"] < 0.97 * usual["stiffness.axial"]
    assert open_["contact.inner.pressure_max"] > 1.1 * usual["contact.inner.pressure_max"]
    assert open_["friction_torque_share.contacts"] < 0.97 * usual["friction_torque_share.contacts"]


def test_free_contact_angle(usual):
    """Steeper contacts carry an axial load with smaller forces; stiff along the axis, soft across it."""
    steep = settled({"bearing.contact_angle_deg": 25.0})
    # Q = F / (Z sin a) holds at the loaded angle of either bearing
    for one in (usual, steep):
        load = 500.0 / (12 * np.sin(one["contact.inner.angle_mean"]))
        # the gyroscopic pair carries up to 1 % of the axial load at 20,000 r/min
        assert one["contact.inner.load_mean"] == pytest.approx(load, rel=1e-2)
    assert steep["contact.inner.angle_mean"] > usual["contact.inner.angle_mean"] + np.radians(4)
    assert steep["contact.inner.load_mean"] < 0.8 * usual["contact.inner.load_mean"]
    assert steep["stiffness.axial"] > 1.2 * usual["stiffness.axial"]
    assert steep["stiffness.radial"] < usual["stiffness.radial"]
    # spin over roll grows with the tangent of the angle (race control, Harris 2006, ch. 2)
    assert steep["contact.outer.spin_to_roll"] > 1.15 * usual["contact.outer.spin_to_roll"]


def test_speed(usual):
    """Centrifugal force flattens the outer contact and steepens the inner one; the outer load grows."""
    slow = settled(rpm=5e3)
    assert usual["contact.inner.angle_mean"] > slow["contact.inner.angle_mean"]
    assert usual["contact.outer.angle_mean"] < slow["contact.outer.angle_mean"]
    assert usual["contact.outer.load_mean"] > slow["contact.outer.load_mean"]


def test_land_clearance(usual):
    """Petroff: the lands' shear falls as one over the clearance, 2 pi eta r^3 L w / c."""
    wide = settled({"bearing.cage.land_clearance_mm": 0.08})
    ratio = wide["friction_torque_share.cage"] / usual["friction_torque_share.cage"]
    # pockets share the torque and the journal shrinks by 0.04 of 11.7 mm
    assert ratio == pytest.approx(0.5, rel=0.1)


def test_viscosity_and_film(usual):
    """Hamrock and Dowson: the minimum film grows with the viscosity to 0.68, other things equal."""
    thin = settled({"lubricant.viscosity_Pa_s": 0.01})
    assert usual["film.lambda_min"] / thin["film.lambda_min"] == pytest.approx(3.0**0.68, rel=5e-3)


def test_viscosity_and_rolling_resistance():
    """Houpert: without shear heating and starvation the rolling torque grows with viscosity to 0.66."""
    plain = {"fidelity.terms.rolling_reduction": False}
    thick, thin = (settled(plain | {"lubricant.viscosity_Pa_s": eta}) for eta in (0.03, 0.01))
    # rolling speed and loads barely change; 1 % for what does
    ratio = thick["friction_torque_share.rolling"] / thin["friction_torque_share.rolling"]
    assert ratio == pytest.approx(3.0**0.66, rel=1e-2)
    assert thick["friction_torque"] > thin["friction_torque"]


def test_reduction_of_the_rolling_resistance(usual):
    plain = settled({"fidelity.terms.rolling_reduction": False})
    assert plain["friction_torque_share.rolling"] > 1.5 * usual["friction_torque_share.rolling"]


def test_temperature(usual):
    """Equally hot rings leave the contact angle to the difference of steel and ceramic: it grows."""
    hot = settled(inputs={"inner_ring_temperature": 353.15, "outer_ring_temperature": 353.15})
    # grooves grow by 11.8e-6 per K, balls by 3.2e-6: more play, a steeper contact, a smaller load
    assert hot["contact.inner.angle_mean"] > usual["contact.inner.angle_mean"]
    assert hot["contact.inner.load_mean"] < usual["contact.inner.load_mean"]


def test_pedestal():
    """Under the same preload the outer ring moves as the spring lets it: F over k."""
    for stiffness in (1e7, 1e8):
        found = settled(inputs={"pedestal_stiffness": stiffness})
        assert found["outer_ring.displacement.x"] == pytest.approx(500.0 / stiffness, rel=2e-3)


@pytest.mark.parametrize(("fidelity", "method"), COMPUTED)
@pytest.mark.parametrize("rpm", [2e4, -2e4])
def test_heats_carry_the_shaft_power(fidelity, method, rpm):
    """Settled, all of the shaft's power becomes heat: torque times speed against the three heats."""
    run = bearing("7003C-bare", PERFECT, {"rpm": rpm}, fidelity, method)
    run.initialise()
    drive(run, 0.02, 1e-4)
    trace = drive(run, 0.01, 1e-4)
    heat = sum(trace.column(f"heat.{part}") for part in ("inner_ring", "outer_ring", "oil")).mean()
    power = trace.column("friction_torque").mean() * rpm * RPM
    # the cage still creeps towards its speed: its kinetic energy, 1 mJ, moves by less than 1 % over 10 ms
    assert heat == pytest.approx(power, rel=1e-2)
    assert heat > 0.0
