"""Conversion to SI: every suffix, no ambiguity, no key of a scene left unconverted."""

import math

import pytest

from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.base import Part
from fmu_bearing.scene.units import UNITS, convert, split_unit

# key, value, name in SI, value in SI: one line per suffix
CASES = [
    ("bore_mm", 17.0, "bore", 0.017),
    ("unbalance_um", 0.5, "unbalance", 0.5e-6),
    ("ball_diameter_spread_nm", 50.0, "ball_diameter_spread", 50e-9),
    ("pedestal_rotational_ratio_mm2", 200.0, "pedestal_rotational_ratio", 2e-4),
    ("contact_angle_deg", 15.0, "contact_angle", math.pi / 12.0),
    ("misalignment_y_mrad", 0.2, "misalignment_y", 2e-4),
    ("speed_rpm", 30.0, "speed", math.pi),
    ("oil_temperature_degC", 20.0, "oil_temperature", 293.15),
    ("vogel_B_K", 879.0, "vogel_B", 879.0),
    ("metering_start_s", 0.02, "metering_start", 0.02),
    ("max_internal_step_us", 20.0, "max_internal_step", 2e-5),
    ("radial_load_y_N", 3.0, "radial_load_y", 3.0),
    ("pedestal_stiffness_N_m", 1e8, "pedestal_stiffness", 1e8),
    ("torque_N_mm", 70.0, "torque", 0.07),
    ("cutting_coefficient_N_mm2", 800.0, "cutting_coefficient", 8e8),
    ("stiffness_N_m_rad", 1e5, "stiffness", 1e5),
    ("pocket_damping_N_s_m", 0.02, "pocket_damping", 0.02),
    ("amount_g_mm", 0.1, "amount", 1e-7),
    ("mass_kg", 0.25, "mass", 0.25),
    ("density_kg_m3", 7800.0, "density", 7800.0),
    ("traction_floor_m_s", 1e-3, "traction_floor", 1e-3),
    ("viscosity_Pa_s", 0.03, "viscosity", 0.03),
    ("conductivity_W_mK", 46.0, "conductivity", 46.0),
    ("specific_heat_J_kgK", 460.0, "specific_heat", 460.0),
    ("eyring_stress_MPa", 5.0, "eyring_stress", 5e6),
    ("youngs_modulus_GPa", 208.0, "youngs_modulus", 208e9),
    ("pressure_viscosity_1_GPa", 20.0, "pressure_viscosity", 20e-9),
    ("expansion_1e6_K", 11.8, "expansion", 11.8e-6),
    ("level_dB", 1.0, "level", 1.0),
    ("highest_frequency_kHz", 10.0, "highest_frequency", 1e4),
    ("required_life_h", 2.0, "required_life", 7200.0),
    ("frequency_Hz", 3100.0, "frequency", 3100.0),
    ("noise_m_s2", 0.05, "noise", 0.05),
]

# the only numbers of a scene without a unit
DIMENSIONLESS = set(
    """ball_count bearing inner_conformity outer_conformity pocket_friction poisson_ratio traction_max
    traction_slide_to_roll replenishment_constant drag_coefficient pedestal_stiffness_ratio
    pedestal_axial_ratio pedestal_damping_ratio weibull_modulus hysteresis_loss
    damping_ratio seed order_scatter_seed lowest_order highest_order order ball_waviness_order tolerance
    traction_strips waviness_exponent ball_harmonics count walther_slope relative fixed_modes
    ball bearing teeth radial_ratio radial_immersion""".split()
)


def tables(model=Scene):
    """Every model of a scene, once."""
    found = {model: None}
    for field in model.model_fields.values():
        for kind in kinds(field.annotation):
            if isinstance(kind, type) and issubclass(kind, Part):
                found |= dict.fromkeys(tables(kind))
    return list(found)


def kinds(annotation):
    """What an annotation is made of: an optional array of tables holds one two levels down."""
    inside = getattr(annotation, "__args__", ())
    return [annotation, *(kind for one in inside for kind in kinds(one))]


@pytest.mark.parametrize(("key", "value", "name", "expected"), CASES)
def test_each_suffix(key, value, name, expected):
    stripped, suffix = split_unit(key)
    assert stripped == name
    # one multiplication, one division, one addition: an ulp or two
    assert convert(value, suffix) == pytest.approx(expected, rel=4e-16)


def test_every_suffix_has_a_case():
    assert {split_unit(key)[1] for key, *_ in CASES} == set(UNITS)


@pytest.mark.parametrize("key", ["ball_count", "model", "name", "mm", "_mm", "terms", "drag"])
def test_keys_without_unit_pass_through(key):
    assert split_unit(key) == (key, "")


def test_every_number_of_a_scene_has_a_unit_or_is_known_to_have_none():
    for table in tables():
        for key, field in table.model_fields.items():
            if field.annotation in (float, int, float | None, int | None):
                assert (split_unit(key)[1] == "") == (key in DIMENSIONLESS), f"{table.__name__}.{key}"


def test_no_two_keys_of_a_table_collide_in_si():
    for table in tables():
        names = [split_unit(key)[0] for key in table.model_fields]
        assert len(set(names)) == len(names), table.__name__


def test_decimal_units_give_the_nearest_double(scene):
    spindle = scene("7003C-spindle")
    assert si(spindle.fidelity).max_internal_step == 2e-5  # 20 * 1e-6 would be one ulp below
    assert si(spindle.imperfections).ball_diameter_spread == 50e-9
    assert si(spindle.operation).oil_temperature == 293.15


def test_values_are_the_callers_own(scene):
    bearing = scene("7003C-bare").bearing
    si(bearing).bore = 1.0
    assert si(bearing).bore == 0.017


def test_absent_values_and_tables_stay_as_they_are(scene):
    spindle = scene("7003C-spindle")
    assert si(spindle.sound.microphone[0]).theta is None
    assert si(spindle.bearing).cage == spindle.bearing.cage
    assert si(spindle.bearing).designation == "7003C"
