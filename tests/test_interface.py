"""The variable table: names are a contract."""

from typing import get_args

import pytest

from fmu_bearing.engine.layout import Z
from fmu_bearing.interface import variables
from fmu_bearing.scene.sound import Sound


def table(scene):
    return {variable.name: variable for variable in variables(scene, rotor_inertia=1e-5)}


def test_inputs_are_the_contracts_eight(scene):
    names = [v.name for v in variables(scene("7003C-spindle"), 1e-5) if v.causality == "input"]
    assert names == [
        "shaft_speed",
        "preload",
        "pedestal_stiffness",
        "radial_load.y",
        "radial_load.z",
        "oil_temperature",
        "inner_ring_temperature",
        "outer_ring_temperature",
    ]


def test_names_of_the_contract_are_there(scene):
    names = set(table(scene("7003C-spindle")))
    for body in ("inner_ring", "outer_ring", "cage", "ball[1]", "ball[12]"):
        assert {f"{body}.velocity.{axis}" for axis in "xyz"} <= names
    for k in range(1, 5):
        assert {f"mic[{k}].{n}" for n in Z.MIC_OUTPUTS} <= names
        assert {f"mic[{k}].position.{axis}" for axis in "xyz"} <= names
    for ring in ("inner", "outer"):
        quantities = ("load_mean", "load_max", "angle_mean", "pressure_max")
        assert {f"contact.{ring}.{q}" for q in quantities} <= names
        assert {f"{ring}_ring.displacement.{axis}" for axis in "xyz"} <= names
    assert {
        "friction_torque", "heat.inner_ring", "heat.outer_ring", "heat.oil", "cage.speed_ratio",
        "film.lambda_min", "stiffness.axial", "stiffness.radial", "rotor.inertia", "solver.steps",
        "solver.rejected", "solver.restarts", "solver.growth", "energy.residual", "fidelity", "tolerance",
        "max_internal_step", "imperfection.scale", "imperfection.seed", "sound.time_weighting",
        "sound.metering_start", "lubricant.viscosity_ref", "radiator",
    } <= names  # fmt: skip
    assert "time" not in names and "ball[13].velocity.x" not in names and "mic[5].spl" not in names


def test_ranges_and_starts(scene):
    found = table(scene("7003C-spindle"))
    speed = found["shaft_speed"]
    assert (speed.min, speed.max, speed.unit, speed.display_unit) == (-10472.0, 10472.0, "rad/s", "r/min")
    assert speed.start == pytest.approx(2094.3951)
    assert (found["preload"].min, found["preload"].max, found["preload"].start) == (0.0, 1e4, 500.0)
    assert (found["pedestal_stiffness"].min, found["pedestal_stiffness"].max) == (1e4, 1e12)
    assert found["oil_temperature"].start == pytest.approx(293.15)
    for variable in found.values():
        assert variable.description and not variable.description.endswith(".")
        if variable.causality == "input":
            assert variable.unit and variable.quantity and variable.nominal is not None
        if variable.array == "z":
            assert 0 <= variable.index < Z.size(12, 4)


def test_places_do_not_overlap(scene):
    places = [(v.array, v.index) for v in variables(scene("7009C-full-ceramic"), 1e-5) if v.array]
    assert len(places) == len(set(places))


def test_what_a_scene_leaves_out_has_no_variable(scene):
    spindle = scene("7003C-spindle")
    mute = spindle.model_copy(update={"sound": None, "imperfections": None})
    names = set(table(mute))
    assert not any(name.startswith(("mic[", "sound.", "imperfection.")) for name in names)
    bare = spindle.model_copy(update={"bearing": spindle.bearing.model_copy(update={"cage": None})})
    names = set(table(bare))
    assert not any(name.startswith("cage.") or name.endswith("spl_cage") for name in names)


def test_what_the_model_was_built_as_is_a_constant(scene):
    bare = scene("7003C-bare")
    found = table(bare)
    for name in ("fidelity", "method"):
        variable = found[name]
        assert (variable.causality, variable.variability, variable.type) == ("local", "constant", "Integer")
        assert (variable.array, variable.value) == ("", 0)
    fidelity = bare.fidelity.model_copy(update={"model": "response", "method": "rk4"})
    found = table(bare.model_copy(update={"fidelity": fidelity}))
    assert (found["fidelity"].value, found["method"].value) == (2, 3)
    # the numbers that FMUs give out are a contract: what is added comes behind them
    words = "Integrator of fidelity full: 0 esdirk4, 2 trbdf2, 3 rk4"
    assert found["method"].description.startswith(words)
    assert found["fidelity"].description.startswith("Fidelity: 0 full, 1 rings, 2 response")


def test_details_of_contacts_cage_and_torque(scene):
    found = table(scene("7003C-spindle"))
    units = {
        "inner_ring.tilt.y": "rad",
        "inner_ring.tilt.z": "rad",
        "cage.whirl_radius": "m",
        "cage.whirl_speed": "rad/s",
        **{f"friction_torque_share.{name}": "N.m" for name in ("contacts", "rolling", "cage", "drag")},
        **{f"contact.{ring}.{q}": "" for ring in ("inner", "outer") for q in ("spin_to_roll", "slip")},
    }
    for name, unit in units.items():
        variable = found[name]
        assert (variable.unit, variable.causality, variable.type) == (unit, "local", "Real")
        assert (variable.array, variable.index) == ("z", Z.BEARING_OUTPUTS.index(name))
    count = found["solver.steps"]
    assert (count.type, count.variability, count.min) == ("Integer", "discrete", 0)


def test_every_output_of_the_engine_has_its_variable(scene):
    spindle = scene("7003C-spindle")
    of_fits = {name for name in Z.BEARING_OUTPUTS if name.startswith("fit.") or name == "contact.free_angle"}
    own = {"clearance", "friction_torque_share.seals"}  # of deep groove bearings, of sealed ones
    assert set(Z.BEARING_OUTPUTS) - set(table(spindle)) == of_fits | own
    fit = {"shaft": {"interference_um": 2.0}, "housing": {"interference_um": -4.0}}
    fitted = spindle.replace({"mounting.fit": fit, "mounting.fit.housing.outside_diameter_mm": 60.0})
    assert set(Z.BEARING_OUTPUTS) - set(table(fitted)) == own
    deep = fitted.replace({"bearing.catalogue": "6203"}).replace({"bearing.seal.kind": "RS1"})
    assert set(Z.BEARING_OUTPUTS) <= set(table(deep))
    bare = scene("7003C-bare")
    caged = {name for name in Z.BEARING_OUTPUTS if name.split(".")[0] == "cage" or name.endswith(".cage")}
    names = set(table(bare.model_copy(update={"bearing": bare.bearing.model_copy(update={"cage": None})})))
    assert set(Z.BEARING_OUTPUTS) - names == caged | of_fits | own


def test_rigid_preload_says_what_the_input_means(scene):
    bare = scene("7003C-bare")
    rigid = bare.model_copy(update={"mounting": bare.mounting.model_copy(update={"preload_mode": "rigid"})})
    assert "at standstill and 20 degC" in table(rigid)["preload"].description
    assert table(rigid)["preload"].start == 500.0


def test_every_radiator_has_a_number_of_its_own(scene):
    bare = scene("7003C-bare")
    numbers = {"none": table(bare.model_copy(update={"sound": None}))["radiator"].value}
    for name in get_args(Sound.model_fields["radiator"].annotation):
        sound = bare.sound.model_copy(update={"radiator": name})
        numbers[name] = table(bare.model_copy(update={"sound": sound}))["radiator"].value
    assert numbers == {"none": 0, "bare": 1, "housing": 2, "baffle": 3}


@pytest.mark.parametrize("name", ["7003C-bare", "7003C-spindle", "7009C-full-ceramic"])
def test_no_name_is_a_variable_and_a_group_of_variables(scene, name):
    """Tools with trees of names (Dymola, Simulink) cannot show a leaf that is a branch too."""
    names = set(table(scene(name)))
    branches = {whole[:k] for whole in names for k, letter in enumerate(whole) if letter in ".["}
    assert not names & branches
