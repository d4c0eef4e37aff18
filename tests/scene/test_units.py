"""The one place that converts to SI."""

import math

import pytest

from fmu_bearing.scene import si
from fmu_bearing.scene.units import UNITS, split_unit


@pytest.mark.parametrize(
    ("key", "name", "suffix"),
    [
        ("bore_mm", "bore", "_mm"),
        ("viscosity_Pa_s", "viscosity", "_Pa_s"),
        ("pressure_viscosity_1_GPa", "pressure_viscosity", "_1_GPa"),
        ("youngs_modulus_GPa", "youngs_modulus", "_GPa"),
        ("vogel_B_K", "vogel_B", "_K"),
        ("expansion_1e6_K", "expansion", "_1e6_K"),
        ("stiffness_N_m_rad", "stiffness", "_N_m_rad"),
        ("pedestal_stiffness_N_m", "pedestal_stiffness", "_N_m"),
        ("pocket_damping_N_s_m", "pocket_damping", "_N_s_m"),
        ("preload_N", "preload", "_N"),
        ("traction_floor_m_s", "traction_floor", "_m_s"),
        ("oil_air_density_kg_m3", "oil_air_density", "_kg_m3"),
        ("pedestal_rotational_ratio_mm2", "pedestal_rotational_ratio", "_mm2"),
        ("contact_damping_us", "contact_damping", "_us"),
        ("metering_start_s", "metering_start", "_s"),
        ("ball_count", "ball_count", ""),
        ("land_clearance_mm", "land_clearance", "_mm"),
    ],
)
def test_suffixes_are_unambiguous(key, name, suffix):
    assert split_unit(key) == (name, suffix)


def test_factors():
    expected = {"_mm": 1e-3, "_um": 1e-6, "_nm": 1e-9, "_mm2": 1e-6, "_us": 1e-6, "_GPa": 1e9, "_1_GPa": 1e-9}
    for suffix, factor in expected.items():
        assert UNITS[suffix] == (factor, 0.0)
    assert UNITS["_deg"][0] == pytest.approx(math.pi / 180)
    assert UNITS["_rpm"][0] == pytest.approx(2 * math.pi / 60)
    assert UNITS["_degC"] == (1.0, 273.15)


def test_parts_in_si(scene):
    spindle = scene("7003C-spindle")
    assert si(spindle.bearing).bore == pytest.approx(0.017)
    assert si(spindle.operation).speed == pytest.approx(20000 * 2 * math.pi / 60)
    assert si(spindle.operation).oil_temperature == pytest.approx(293.15)
    assert si(spindle.lubricant).pressure_viscosity == pytest.approx(2e-8)
    assert si(spindle.bearing).ball_count == 12
