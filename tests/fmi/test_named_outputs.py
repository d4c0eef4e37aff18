"""Outputs that ``fmu.outputs`` of a scene names: what stays in the FMU, and that it has the same bits."""

import functools
import re
import warnings
import zipfile

import numpy as np
import pytest

from fmu_bearing import simulate
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.fmi.fmu_model import as_fmu_model
from fmu_bearing.fmi.package import build
from fmu_bearing.instance import Instance
from fmu_bearing.interface import fmu_variables, variables
from fmu_bearing.interface.fmu_names import GROUPS, USUAL
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import SceneError, read_scene
from tests.conftest import EXAMPLES, GATES
from tests.native_builds import no_native_fmu
from tests.spindle.port import as_port

from .conftest import OK, Master

SINGLE, SET = GATES / "7003C-spindle.toml", EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
FIVE = {
    SINGLE: ("friction_torque", "heat.oil", "inner_ring.velocity.y", "inner_ring.velocity.z", "mic[1].leq_a"),
    SET: ("friction_torque", "heat.oil", "shaft.nose.velocity.z", "shaft.nose.displacement.x",
          "bearing[2].heat.oil"),
}  # fmt: skip


def scene(file, outputs=None, **changes):
    compact = {"sound.radiation_model": "compact"} if file == SINGLE else {}
    found = read_scene(file).replace(compact | changes)
    return found if outputs is None else found.replace({"fmu.outputs": list(outputs)})


def shown(file, outputs):
    """Computed variables of the FMU, by name."""
    found = scene(file, outputs)
    return {v.name: v for v in fmu_variables(found, variables(found, 0.0)) if v.array == "z"}


@pytest.mark.parametrize("file", FIVE)
def test_outputs_that_are_not_named_leave_and_torque_and_inputs_stay(file):
    usual, five = (as_fmu_model(prepare(scene(file, of))) for of in (None, FIVE[file][1:]))
    assert {v.name for v in five.variables if v.array == "z"} == set(FIVE[file])
    assert {v.causality for v in five.variables if v.array == "z"} == {"output"}
    kept = [v for v in usual.variables if v.array != "z"]  # inputs, parameters, constants
    assert [v for v in five.variables if v.array != "z"] == kept
    inputs = [v for v in kept if v.causality == "input"]
    assert list(five.variables[: len(inputs)]) == list(usual.variables[: len(inputs)]) == inputs
    assert list(shown(file, [])) == ["friction_torque"]


@pytest.mark.parametrize("file", FIVE)
def test_groups_are_words_for_patterns_and_together_all_but_the_solver(file):
    found = scene(file)
    every = {v.name for v in variables(found, 0.0) if v.array == "z"}
    usual = {v.name for v in variables(found, 0.0) if v.causality == "output"}
    assert set(shown(file, [USUAL])) == usual
    assert set(shown(file, ["*"])) == every
    some = {}
    for word in GROUPS:
        try:
            some[word] = set(shown(file, [word])) - {"friction_torque"}
        except SceneError as problem:
            assert (word, file) in {
                ("forces", SINGLE),
                ("levels", SET),
                ("defects", SINGLE),
                ("defects", SET),
            }
            assert f"fmu.outputs: this scene has nothing of '{word}'" in str(problem)
    rest = every.difference(*some.values()) - {"friction_torque"}
    assert {re.sub(r"\[\d+\]", "[]", name) for name in rest} <= {
        "solver.steps", "solver.rejected", "solver.restarts", "solver.growth", "solver.wave_time",
        "mic[].pressure", "cage.speed_ratio", "cage.whirl_radius", "cage.whirl_speed",
        "bearing[].solver.wave_time", "bearing[].cage.speed_ratio", "bearing[].cage.whirl_radius",
        "bearing[].cage.whirl_speed",
    }  # fmt: skip
    assert not some["velocities"] & some["balls"] and len(some["balls"]) >= 36
    assert {"energy.residual", "heat.oil", "friction_torque_mean"} <= some["energy"]


@pytest.mark.parametrize(
    ("outputs", "said"),
    [
        (["velocites"], "there is no variable 'velocites'; did you mean 'velocities'?"),
        (["velocit*s"], "there is no variable 'velocit*s'"),
        (["heat.oill"], "did you mean 'heat.oil'?"),
        (["usual", "preload"], "'preload' is an input; leave it out"),
        (["forces"], "this scene has nothing of 'forces' (bearing[*].force.*,"),
    ],
)
def test_what_the_scene_does_not_have_is_refused(outputs, said):
    with pytest.raises(SceneError, match=re.escape(said)):
        shown(SINGLE, outputs)


@pytest.mark.parametrize("file", FIVE)
def test_a_left_out_output_is_not_read_and_the_way_out_is_named(file):
    model = as_fmu_model(prepare(scene(file, FIVE[file])))
    one = Instance(model)
    one.initialise()
    one.step(1e-4)
    name = next(n for n in model.left_out if "contact.inner.load_max" in n)
    with pytest.raises(KeyError, match=f"this FMU has no '{re.escape(name)}': fmu.outputs of its scene"):
        one.get(name)
    with pytest.raises(KeyError, match="no variable 'contact.inner.loadmax'"):
        one.get("contact.inner.loadmax")
    whole = Instance(prepare(scene(file, FIVE[file])))  # the library's own bearing has everything
    whole.initialise()
    assert whole.get(name) > 0.0


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A function that builds the FMU of five outputs, once."""

    @functools.cache
    def made(file, flavour):
        folder = tmp_path_factory.mktemp("five")
        try:
            model = prepare(scene(file, FIVE[file]), fidelity="response")
            path = build(model, folder / "five.fmu", flavour).path
        except BuildError as problem:
            no_native_fmu(problem)
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder / "in")
        return path, folder / "in"

    return made


@pytest.mark.parametrize("flavour", FLAVOURS)
@pytest.mark.parametrize("file", FIVE)
def test_fmus_of_five_outputs_have_the_bits_of_all(built, file, flavour):
    whole = Instance(prepare(scene(file), fidelity="response"))
    whole.initialise()
    one = Master(built(file, flavour)[1]).start()
    assert [name for name, v in one.by_name.items() if v.causality == "output"] == sorted(
        FIVE[file], key=list(one.by_name).index
    )
    for i in range(200):
        speed = 2000.0 + 10.0 * i
        whole.set("shaft_speed", speed)
        assert one.set("shaft_speed", speed) == OK
        whole.step(2e-4)
        assert one.step(2e-4 * i, 2e-4) == OK
        assert [one.get(name) for name in FIVE[file]] == [whole.get(name) for name in FIVE[file]]
    one.free()


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_a_run_of_such_an_fmu_has_its_outputs(built, flavour):
    run = simulate(built(SINGLE, flavour)[0], 1e-3)
    assert set(run.names) >= set(FIVE[SINGLE])
    assert np.isfinite(run["mic[1].leq_a"]).all() and run["friction_torque"][-1] > 0.0


def test_a_port_keeps_what_it_names():
    port = as_port(scene(SET)).replace({"fmu.outputs": ["forces"]})
    names = {v.name for v in fmu_variables(port, variables(port, 0.0)) if v.causality == "output"}
    assert "port.force.x" in names and "bearing[1].force.x" in names and "heat.oil" not in names


def test_warnings_come_where_their_numbers_are_left_out():
    """The edge of a race: the warning reads a margin that the FMU does not show."""
    many = scene(SINGLE, ["heat.*"], **{"bearing.inner_ring_outer_diameter_mm": 22.6})
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for model in (prepare(many), as_fmu_model(prepare(many))):
            one = Instance(model)
            one.set("preload", 5000.0)
            one.initialise()
    words = [str(one.message) for one in caught]
    assert len(words) == 2 * len(set(words)) and any("beyond its shoulder" in one for one in words)
