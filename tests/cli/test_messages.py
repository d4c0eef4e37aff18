"""What commands say of a mistake: in one line, in their words, with the way out, and the page's exit code."""

import os
import re
import subprocess
import sys
import warnings

import pytest

from fmu_bearing.cli.base import Commands
from fmu_bearing.scene import SceneError, read_scene_text
from tests.conftest import EXAMPLES
from tests.marks import heavy_but
from tests.messages import says

# compact sound: a table of boundary elements that is not in the cache is progress beside the message
SINGLE = (EXAMPLES / "7003C-bare.toml").read_text("utf-8").replace('"bem"', '"compact"')
SET = (EXAMPLES.parent / "spindle_set" / "7003C-DB.toml").read_text("utf-8")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a scene of one bearing, one of a set, and files of other kinds; work is done there."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "one.toml").write_text(SINGLE)
    (tmp_path / "set.toml").write_text(SET)
    (tmp_path / "run.csv").write_text("time,friction_torque\n0,1\n1,1\n")
    (tmp_path / "sweep.toml").write_text('scene = "one.toml"\n[axes]\nspeed = "8000:9000:2"\n')
    (tmp_path / "empty.toml").write_text("")
    (tmp_path / "utf16.toml").write_text(SINGLE, "utf-16")
    (tmp_path / "latin.toml").write_bytes('name = "é"\n'.encode("latin-1"))
    (tmp_path / "sub").mkdir()
    return tmp_path


def said(run, *words, code=2):
    """The one line on standard error, without "error: "."""
    done = run(*words)
    assert done.exit_code == code, done.output
    assert done.stdout == "" and done.stderr.startswith("error: ") and done.stderr.count("\n") == 1
    assert "Errno" not in done.stderr and "codec" not in done.stderr and "PosixPath" not in done.stderr
    return done.stderr.removeprefix("error: ").rstrip("\n")


# --- names -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "table", "line", "answer"),
    [
        (SINGLE, "operation", "speed_rmp = 3.0", "did you mean 'speed_rpm'?"),
        (SINGLE, "operation", "shaft_speed_rmp = 3.0", "did you mean 'speed_rpm'?"),
        (SINGLE, "operation", "shaft_speed_rpm = 3.0", "did you mean 'speed_rpm'?"),
        (SINGLE, "operation", "preload_N = 3.0", "it belongs in [mounting]"),
        (SINGLE, "operation", 'preload_class = "light"', "it belongs in [mounting]"),
        (SINGLE, "operation", "preloads_N = 3.0", "did you mean preload_N in [mounting]?"),
        (SINGLE, "operation", "preload = 3.0", "one bearing has preload_N in [mounting]"),
        (SINGLE, "mounting", "preload = 3.0", "did you mean 'preload_N'?"),
        (SINGLE, "mounting", "force_x_N = 3.0", "one bearing has preload_N in [mounting]"),
        (SINGLE, "operation", "force_z_N = 3.0", "one bearing has radial_load_z_N in [mounting]"),
        (SINGLE, "mounting", "mass_kg = 3.0", "it belongs in [mounting.rotor] or [mounting.housing]"),
        (SINGLE, "mounting", "sections_mm = 3.0", "it belongs in [tool] or [tool.holder]"),
        (SINGLE, "mounting", "position_mm = 3.0", "it belongs in [tool]"),
        (SET, "operation", "preload_N = 3.0", "it belongs in [spindle.preload]"),
        (SET, "operation", "preload = 3.0", "it belongs in [spindle.preload]"),
        (SET, "spindle.load", "pedestal_stiffness_N_m = 3.0", "it belongs in [spindle.housing]"),
        (SET, "spindle.load", "radial_load_z_N = 3.0", "a set on one shaft has force_z_N in [spindle.load]"),
        (SET, "operation", "rotor = 3.0", "a set on one shaft has [spindle.shaft]"),
        (SET, "operation", "misalignment_y_mrad = 3.0", "it belongs in [spindle.bearing]"),
        (
            SET,
            "operation",
            "preload_mode = 3.0",
            "[mounting] ... a set on one shaft",
        ),
    ],
)
def test_a_key_in_the_wrong_table_names_the_right_one_for_this_scene(run, folder, text, table, line, answer):
    assert f"[{table}]\n" in text
    (folder / "it.toml").write_text(text.replace(f"[{table}]\n", f"[{table}]\n{line}\n", 1))
    key = line.partition(" = ")[0]
    assert says(said(run, "info", "it.toml"), f"it.toml ... {table}.{key} ... {answer}")


@pytest.mark.parametrize(
    ("text", "old", "new", "answer"),
    [
        (
            SET,
            "[spindle.preload]",
            "[preload]",
            "preload ... [spindle.preload]",
        ),
        (
            SINGLE,
            "[sound]",
            "[microphone]",
            "microphone ... [[sound.microphone]]",
        ),
        (
            SINGLE,
            "[mounting]",
            "[preload]",
            "preload ... preload_N in [mounting]",
        ),
    ],
)
def test_a_table_in_the_wrong_place(run, folder, text, old, new, answer):
    (folder / "it.toml").write_text(text.replace(old, new, 1))
    assert says(said(run, "info", "it.toml"), f"it.toml: {answer}")


def test_a_set_with_a_mounting_is_told_to_keep_one_and_no_more(run, folder):
    (folder / "it.toml").write_text(SET + "[mounting]\npreload_N = 3.0\n")
    assert says(said(run, "info", "it.toml"), "it.toml: mounting ... [spindle] ... keep one")


@pytest.mark.parametrize(
    ("column", "name"),
    [
        ("shaft_speed_rmp", "shaft_speed_rpm"),
        ("shaft_sped", "shaft_speed"),
        ("oil_temperatur_degC", "oil_temperature_degC"),
    ],
)
def test_a_misspelt_column_of_inputs_keeps_its_unit(run, folder, column, name):
    (folder / "in.csv").write_text(f"time,{column}\n0,1\n1,1\n")
    refusal = said(run, "simulate", "one.toml", "-i", "in.csv")
    assert refusal.endswith(f"column '{column}': there is no input '{column}'; did you mean '{name}'?")


# --- values ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "answer"),
    [
        (
            "preload_N = 500.0",
            'preload_N = "300"',
            "mounting.preload_N = '300' ... -1e+06 to 1e+06 N ... write preload_N = 300",
        ),
        (
            "seed = 1",
            'seed = "1"',
            "imperfections.seed = '1' ... 0 to 2147483647 ... write seed = 1",
        ),
        (
            "gravity = true",
            'gravity = "true"',
            "fidelity.terms.gravity = 'true' ... true or false ... write gravity = true",
        ),
        (
            "preload_N = 500.0",
            'preload_N = "300 N"',
            "mounting.preload_N = '300 N' ... -1e+06 to 1e+06 N ... no number",
        ),
        (
            'radiator = "bare"',
            "radiator = 3",
            "sound.radiator = 3 ... bare, housing, baffle ... text in quotes",
        ),
    ],
)
def test_quotes(run, folder, old, new, answer):
    assert old in SINGLE
    (folder / "it.toml").write_text(SINGLE.replace(old, new, 1))
    assert says(said(run, "info", "it.toml"), f"it.toml: {answer}")


@pytest.mark.parametrize(
    ("where", "name", "value"),
    [
        ("mounting", "preload_N", 300.0),
        ("", "name", "other"),
        ("fidelity.terms", "gravity", False),
        ("operation", "no_key", 1.0),
        ("materials.balls", "density_kg_m3", 7800.0),
    ],
)
def test_a_frozen_scene_points_to_replace(where, name, value):
    scene = part = read_scene_text(SINGLE)
    for step in filter(None, where.split(".")):
        part = getattr(part, step)
    with pytest.raises(SceneError) as refusal:
        setattr(part, name, value)
    assert f"a scene is frozen: scene.replace({{'[TABLE.]{name}': VALUE}})" in str(refusal.value)
    assert scene == read_scene_text(SINGLE)


def test_a_frozen_member_of_an_array_and_a_table_that_is_deleted():
    scene = read_scene_text(SINGLE)
    with pytest.raises(SceneError, match=r"replace\({'\[TABLE.\]y_mm': VALUE}\)"):
        scene.sound.microphone[1].y_mm = 3.0
    with pytest.raises(SceneError, match=r"replace\({'\[TABLE.\]sound': VALUE}\)"):
        del scene.sound


# --- files -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words", ["info", "modes", "stiffness", "build", "choose", "scene show", "sweep", "report", "changes"]
)
def test_a_table_where_a_scene_is_due(run, folder, words):
    way_out = "`fmu-bearing scene new` ... `fmu-bearing plot` and `compare`"
    assert says(said(run, *words.split(), "run.csv"), f"run.csv ... scene ... table of values ... {way_out}")


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (
            "plot one.toml",
            "one.toml ... result ... a scene ... `fmu-bearing simulate`",
        ),
        (
            "validate one.toml",
            "one.toml ... FMU ... a scene ... `fmu-bearing build`",
        ),
        (
            "validate run.csv",
            "run.csv ... FMU ... table of values ... `fmu-bearing build`",
        ),
        (
            "simulate one.toml -i set.toml",
            "set.toml ... table of values (CSV) ... a scene ... write lines",
        ),
        (
            "info one.toml --catalogue run.csv",
            "run.csv ... catalogue of bearings ... table of values",
        ),
        ("info sweep.toml", "sweep.toml ... a scene ... a sweep"),
        (
            "info empty.toml",
            "empty.toml ... empty file ... `fmu-bearing scene new`",
        ),
        (
            "identify one.toml set.toml -f mounting.preload_N",
            "set.toml ... table of values (CSV)",
        ),
        (
            "sound run.csv",
            "run.csv ... time and mic[1].pressure ... outputs",
        ),
    ],
)
def test_another_file_than_is_due(run, folder, words, answer):
    assert says(said(run, *words.split()), answer)


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("info none.toml", "none.toml: there is no such scene file"),
        ("info none/of/it.toml", "none/of/it.toml ... no folder none/of"),
        ("plot none/it.csv", "none/it.csv ... no folder none"),
        ("simulate none/it.fmu", "none/it.fmu ... no folder none"),
        ("validate none/it.fmu", "none/it.fmu ... no folder none"),
        ("info sub", "sub ... folder ... name a file in it"),
        ("plot .", ".: ... folder ... name a file in it"),
        ("compare one.toml none.toml", "none.toml: there is no such scene file"),
        ("compare one.toml sub", "sub ... folder ... name a file in it"),
        ("info utf16.toml", "utf16.toml ... UTF-16 ... save it as UTF-8"),
        (
            "info latin.toml",
            "latin.toml ... byte 9 ... save it as UTF-8",
        ),
        ("scene check none.toml one.toml", "none.toml: there is no such scene file"),
    ],
)
def test_files_that_cannot_be_read(run, folder, words, answer):
    assert says(said(run, *words.split()), answer)


def test_what_the_system_refuses_is_said_in_words(run, folder, monkeypatch):
    """A folder that may not be read: whoever runs the tests may be allowed everything, so `stat` refuses."""

    def refuse(path, *_, **__):
        raise PermissionError(13, os.strerror(13), str(path))

    monkeypatch.setattr("fmu_bearing.file_words.read_text", refuse)
    assert said(run, "info", "one.toml") == "one.toml: cannot be read: permission denied"


def test_a_system_error_that_no_reader_has_put_into_words(run, folder, monkeypatch):
    def refuse(*_, **__):
        raise OSError(28, os.strerror(28), "one.npz")

    monkeypatch.setattr("fmu_bearing.design.operating_point.operating_point", refuse)
    assert said(run, "info", "one.toml") == "one.npz: no space left on device"


# --- words of the command ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        ("compare one.toml", "missing argument 'B'; `fmu-bearing compare --help` lists what there is"),
        (
            "info one.toml --nonsense",
            "no such option: --nonsense; `fmu-bearing info --help` lists what there is",
        ),
        ("infos one.toml", "no such command 'infos'. Did you mean 'info'?"),
        ("scene chek one.toml", "no such command 'chek'. Did you mean 'check'?"),
    ],
)
def test_words_that_are_no_command_or_option(run, folder, words, answer):
    assert said(run, *words.split()).replace("root", "fmu-bearing") == answer


def test_help_of_the_command_alone_is_no_error(run):
    done = run()
    assert done.exit_code in (0, 2) and "Commands" in done.output and "error:" not in done.output


@pytest.mark.heavy
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such pipes")
@pytest.mark.parametrize(
    "words", heavy_but(["info one.toml", "scene show one.toml", "scene catalogue --json"], 2)
)
def test_a_reader_that_has_read_enough_is_no_error(folder, words):
    """The pipe is closed before the command prints."""
    ours, theirs = os.pipe()
    os.close(ours)
    command = [sys.executable, "-m", "fmu_bearing", *words.split()]
    done = subprocess.run(command, stdout=theirs, stderr=subprocess.PIPE, text=True, timeout=300)
    os.close(theirs)
    assert done.returncode == 0 and "error" not in done.stderr.lower()


# --- warnings ----------------------------------------------------------------------------------------


def test_warnings_show_no_line_of_the_package(folder):
    """An ellipse beyond its shoulder: the library warns, and the command prints a caution."""
    (folder / "it.toml").write_text(SINGLE.replace("preload_N = 500.0", "preload_N = 5000.0"))
    words = "simulate it.toml --stop-time 0.001 --output it.csv"
    command = [sys.executable, "-m", "fmu_bearing", *words.split()]
    environment = {**os.environ, "PYTHONWARNINGS": "always"}
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, env=environment)
    assert done.returncode == 0, done.stderr
    assert "caution: the ellipse of the most loaded contact of the inner race reaches" in done.stderr
    assert ".py" not in done.stderr and "Warning" not in done.stderr and "warn(" not in done.stderr


@pytest.mark.parametrize("command", ["info", "scene show", "modes", "choose", "build", "report"])
def test_every_command_prints_a_warning_as_one_caution(run, folder, monkeypatch, command):
    """A warning from wherever a command calls the library."""
    real = Commands.invoke.__globals__["TyperGroup"].invoke

    def invoke(self, context):
        warnings.warn("two\n lines", UserWarning, stacklevel=1)
        warnings.warn("for developers", DeprecationWarning, stacklevel=1)
        return real(self, context)

    monkeypatch.setattr("fmu_bearing.cli.base.TyperGroup.invoke", invoke)
    done = run(*command.split(), "none.toml")
    assert done.exit_code == 2
    assert re.fullmatch(
        r"(caution: two lines\n)+error: none\.toml: there is no such scene file\n", done.stderr
    )
