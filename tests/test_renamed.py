"""An old name is refused with a message that gives the new name, and the new name exists."""

import inspect
from typing import get_args

import pytest
import typer.main
from typer.testing import CliRunner

import fmu_bearing
from fmu_bearing import cli, renamed
from fmu_bearing.instance import Instance
from fmu_bearing.interface.names import UnknownName, chosen_names
from fmu_bearing.prepare.model import prepare
from fmu_bearing.recording.measurements import measure, sound_analysis
from fmu_bearing.recording.recording import Recording
from fmu_bearing.reports import make
from fmu_bearing.results.result import Run
from fmu_bearing.results.series import structured
from fmu_bearing.run.bearing import Bearing
from fmu_bearing.scene import SceneError, read_scene, read_scene_text
from fmu_bearing.scene.values import fields_of
from fmu_bearing.sweeps.axes import ALIASES, SweepError, axes_of
from tests.conftest import GATES

FILE = GATES / "7003C-bare.toml"
#: Functions that took an old argument, each with that argument.
FUNCTIONS = [
    *(
        (function, "rung")
        for function in (fmu_bearing.record, make, sound_analysis.analyse_sound, sound_analysis.write_all)
    ),
    *((getattr(Recording, name), "rung") for name in ("pressure", "partial", "levels", "mean_squares")),
    *(
        (getattr(measure, name), "rung")
        for name in ("component_spectra", "circle", "planes", "sweep", "sound_power", "run_up")
    ),
    (prepare, "level"),
]


@pytest.fixture(scope="module")
def bearing():
    """A bearing that is not initialised, without sound: nothing has to be compiled for it."""
    return Bearing(read_scene(FILE).model_copy(update={"sound": None}))


@pytest.mark.parametrize(("old", "new"), renamed.PUBLIC.items())
def test_public_names(old, new):
    with pytest.raises(ImportError, match=f"^fmu_bearing has no '{old}': it is now '{new}'$"):
        exec(f"from fmu_bearing import {old}")
    assert new in fmu_bearing.__all__ and old not in fmu_bearing.__all__


@pytest.mark.parametrize(("old", "new"), renamed.KEYS.items())
def test_keys(old, new):
    text = FILE.read_text("utf-8")
    before, after = (f"\n{key.rpartition('.')[2]} = " for key in (new, old))
    assert text.count(before) == 1
    with pytest.raises(SceneError) as refusal:
        read_scene_text(text.replace(before, after), "a.toml")
    assert refusal.value.problems == (f"a.toml: {old} is now {new}; its values are the same",)
    assert new in fields_of(read_scene(FILE)) and old not in fields_of(read_scene(FILE))


def test_keys_by_keyword():
    for call in (lambda: fmu_bearing.with_fidelity(read_scene(FILE), level="rings"),
                 lambda: Bearing(FILE, level="rings")):  # fmt: skip
        with pytest.raises(SceneError, match=r"fidelity\.level is now fidelity\.model"):
            call()
    assert Bearing(read_scene(FILE).model_copy(update={"sound": None}), fidelity="rings")["fidelity"] == 1.0


@pytest.mark.parametrize(
    ("key", "old", "new"), [(key, *pair) for key, pairs in renamed.VALUES.items() for pair in pairs.items()]
)
def test_values(key, old, new):
    table, _, name = key.rpartition(".")
    present = fields_of(read_scene(FILE))[key]
    before, after = (f'\n{name} = "{value}"\n' for value in (new, old))
    text = FILE.read_text("utf-8")
    assert table == "fidelity" and text.count(before) == 1 and new in get_args(present.annotation)
    for call in (lambda: read_scene_text(text.replace(before, after), "a.toml"),
                 lambda: fmu_bearing.with_fidelity(read_scene(FILE), **{name: old}),
                 lambda: Bearing(FILE, **{name: old})):  # fmt: skip
        with pytest.raises(
            SceneError, match=rf"{key} = '{old}' is refused; .*'{old}' was removed, use '{new}'$"
        ):
            call()


@pytest.mark.parametrize(("old", "new"), renamed.OPTIONS.items())
@pytest.mark.parametrize("command", ["sound", "report", "simulate"])
def test_options(old, new, command):
    for words in ([old, "x"], [f"{old}=x"]):
        done = CliRunner().invoke(cli.app, [command, str(FILE), *words])
        assert done.exit_code == 2 and isinstance(done.exception, SystemExit)
        assert done.output == f"error: {old} is now {new}\n"
    commands = typer.main.get_command(cli.app).commands.values()
    known = {name for each in commands for option in each.params for name in option.opts}
    assert new in known and old not in known


@pytest.mark.parametrize(("old", "new"), renamed.VARIABLES.items())
def test_variables(old, new, bearing):
    assert new in list(bearing) and old not in list(bearing)
    with pytest.raises(UnknownName, match=f"no variable '{old}'; it is now '{new}'"):
        bearing[old]
    with pytest.raises(UnknownName, match=f"it is now '{new}'"):
        chosen_names([old], list(bearing), [])
    with pytest.raises(KeyError, match=f"no variable '{old}'; it is now '{new}'"):
        Instance(bearing._instance.model).get(old)
    with pytest.raises(KeyError, match=f"'{old}' was not kept; it is now '{new}'"):
        Run("a", structured({"time": [0.0]}), {})[old]


@pytest.mark.parametrize(("old", "new"), (renamed.AXES | renamed.KEYS).items())
def test_axes(old, new):
    with pytest.raises(SweepError, match=f"axis {old} is now {new}"):
        axes_of(read_scene(FILE), {old: "full"})
    assert new in ALIASES or new in fields_of(read_scene(FILE))
    assert old not in ALIASES


@pytest.mark.parametrize(("function", "old"), FUNCTIONS, ids=lambda value: getattr(value, "__name__", value))
def test_arguments(function, old):
    new = renamed.ARGUMENTS[old]
    with pytest.raises(TypeError) as refusal:
        function(**{old: "x"})
    assert str(refusal.value) == f"{function.__name__}() has no argument '{old}': it is now '{new}'"
    assert new in inspect.signature(function).parameters


def test_arguments_of_a_report():
    with pytest.raises(TypeError, match=r"report\(\) has no argument 'rung': it is now 'radiation_model'"):
        fmu_bearing.report(FILE, "report.html", rung="bem")


def test_every_argument_is_tested():
    assert {old for _, old in FUNCTIONS} == set(renamed.ARGUMENTS)
