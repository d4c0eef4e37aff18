"""info: the operating point; scene check: limits that are passed."""

import math
import time

import numpy as np
import pytest

from fmu_bearing import stiffness
from fmu_bearing.accuracy.changes import point
from fmu_bearing.design.measured import PAGE, measured_elsewhere
from fmu_bearing.instance import Instance
from fmu_bearing.scene import read_scene
from tests.conftest import EXAMPLES
from tests.spindle.sets import scene as bearings

SET = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


def changed(tmp_path, *changes, name="7003C-spindle"):
    text = (EXAMPLES / f"{name}.toml").read_text("utf-8")
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    path = tmp_path / "changed.toml"
    path.write_text(text, "utf-8")
    return path


def test_info_tells_the_operating_point_without_a_run(run, monkeypatch):
    monkeypatch.setattr(Instance, "step", lambda *a: pytest.fail("a run has begun"))
    begin = time.process_time()  # of this process: other work on the machine does not count
    result = run("info", EXAMPLES / "7003C-spindle.toml", "--json")
    assert result.exit_code == 0 and time.process_time() - begin < 2.0  # 0.2 s, 1.1 s with a new interpreter
    (data,) = result.data["bearings"]
    # 500 N on 12 balls at the loaded angle: Q = F / (Z sin a)
    inner = data["contact"]["inner"]
    assert inner["load_mean"] == pytest.approx(500.0 / 12 / math.sin(inner["angle_mean"]), rel=0.01)
    assert inner["pressure_max"] == pytest.approx(1.89e9, rel=0.01)
    assert len(data["stiffness"]) == 5 and data["stiffness"][0][0] > 1e7
    assert data["frequencies_Hz"]["f_r"] == pytest.approx(20_000 / 60)
    assert data["speed_number_mm_rpm"] == 520_000 and data["kind"] == "hybrid"
    # own figures of the designers' notes: 5.4 N against skidding, viscosity ratio 1.79 at 40 degC, 1000 h
    assert data["least_preload_N"] == pytest.approx(5.4, rel=0.02)
    assert data["viscosity_ratio"] == pytest.approx(1.79, rel=0.02)
    # the notes leave out the rotor's 12 N of weight, which take 2.7 %
    assert data["rating"]["life"] == pytest.approx(1000.0, rel=0.03)


def test_info_fits_a_terminal_and_names_units(run):
    result = run("info", EXAMPLES / "7003C-spindle.toml")
    assert result.exit_code == 0
    assert max(map(len, result.stdout.splitlines()[1:])) <= 80
    for words in ("GPa", "orders", "ISO 281", "tilt z", "n d_m"):
        assert words in result.stdout
    assert "caution: contact pressure 1.89 GPa" in result.stderr


def test_info_names_local_defects_and_their_lines(run, tmp_path):
    lines = '[[imperfections.defect]]\non = "inner"\nshape = "pit"\nlength_mm = 0.3\ndepth_um = 50.0\n\n'
    path = changed(tmp_path, ("[operation]", lines + "[operation]"))
    result = run("info", path)
    assert result.exit_code == 0
    assert max(map(len, result.stdout.splitlines()[1:])) <= 80
    assert "defect 1: pit of 0.3 mm, 50 um deep, on the inner race at 0 deg" in result.stdout
    data = run("info", path, "--json").data
    frequencies = data["bearings"][0]["frequencies_Hz"]
    assert data["defects"] == [{
        "defect": "defect 1", "words": "pit of 0.3 mm, 50 um deep, on the inner race at 0 deg", "line": "f_i",
        "frequency_Hz": frequencies["f_i"], "side_bands_Hz": frequencies["f_r"],
    }]  # fmt: skip
    assert "defects" not in run("info", EXAMPLES / "7003C-spindle.toml", "--json").data


@pytest.mark.heavy
@pytest.mark.parametrize("path", [EXAMPLES / "7003C-spindle.toml", SET], ids=["single", "set"])
def test_info_says_how_far_torque_and_stiffness_were_from_values_elsewhere(run, path):
    """One line each, then the page; life and level say that nobody measured them."""
    shown = run("info", path).stdout.splitlines()
    at = shown.index("computed figures over what others measured or print:")
    torque, stiff, life, page = shown[at + 1 : at + 5]
    assert torque.startswith("torque: 0.") and "of SKF's, heat 0." in torque
    assert stiff.startswith("stiffness: 0.") and "NSK's and TPI's pairs" in stiff
    assert life == "life and level: no measured values are known"
    assert page == f"all values: {PAGE}"
    assert all(len(line) <= 80 for line in (torque, stiff, life, page))
    assert run("info", path, "--json").data["measured_elsewhere"] == measured_elsewhere()


@pytest.mark.heavy
def test_info_of_ceramic_rings_has_no_life_and_of_nonsense_no_figures(run, tmp_path):
    result = run("info", EXAMPLES / "7009C-full-ceramic.toml")
    assert result.exit_code == 0 and "standards rate rings of steel only" in result.stdout
    still = changed(tmp_path, ("speed_rpm = 20000.0", "speed_rpm = 0.0\nlowest_speed_rpm = 1000.0"))
    assert run("info", still).exit_code == 0
    refused = run("info", tmp_path / "none.toml")
    assert refused.exit_code == 2 and "no such scene file" in refused.stderr


@pytest.mark.parametrize(
    ("name", "changes", "words"),
    [
        (
            "7003C-spindle",
            (("preload_N = 500.0", "preload_N = 3.0"),),
            ("below the 5.31 N", "fitted to GMN", "give"),
        ),
        ("7003C-spindle", (), ("pressure 1.89 GPa", "1.50 GPa", "GMN", "reduce")),
        (
            "7003C-spindle",
            (("preload_N = 500.0", "preload_N = 900.0"),),
            ("above 2.0 GPa", "rule of the field"),
        ),
        (
            "7003C-spindle",
            (("preload_N = 500.0", "preload_N = 300.0"),),
            ("0.050 C): 1.7 times", "GMN, 179 N: give 179 N"),
        ),
        (
            "7003C-spindle",
            (("speed_rpm = 20000.0", "speed_rpm = 90000.0"),),
            ("n d_m 2.34e6", "2.19e6", "lower"),
        ),
        (
            "7003C-spindle",
            (("speed_rpm = 20000.0", "speed_rpm = 200.0"),),
            ("film over roughness 0.5", "Harris 2006", "thicker"),
        ),
    ],
)
def test_check_cautions_where_a_limit_is_passed(run, tmp_path, name, changes, words):
    result = run("scene", "check", changed(tmp_path, *changes, name=name))
    assert result.exit_code == 0, result.output
    assert any(
        line.startswith("caution: ") and all(word in line for word in words)
        for line in result.stdout.splitlines()
    ), result.stdout


def test_check_says_nothing_of_a_bearing_within_its_limits(run, tmp_path):
    result = run("scene", "check", changed(tmp_path, ("preload_N = 500.0", "preload_N = 100.0")))
    assert result.exit_code == 0 and "caution" not in result.output


def test_info_of_a_set_tells_what_each_bearing_carries(run):
    data = run("info", SET, "--json").data
    found = data["statics"]
    assert found["arrangement"] == "DB (O)"
    # 100 N along the axis, the rest of both is preload
    front, rear = found["bearings"]
    # 0.002 N along and 0.02 N across are friction of the start that is not balanced yet
    assert front["axial_N"] - rear["axial_N"] == pytest.approx(100.0, abs=0.01)
    assert front["force_z_N"] + rear["force_z_N"] == pytest.approx(found["load"][2], abs=0.1)
    assert found["preloads_N"]["cold"] == pytest.approx([150.0, 150.0], rel=1e-6)
    assert set(found["lift_off"]) == {"+x", "-x"}
    result = run("info", SET)
    assert result.exit_code == 0
    assert result.stdout.startswith("7003C-DB: 2 x 7003C, DB (O), hybrid: rings GCr15, balls Si3N4")
    assert "15000 r/min; supply oil-air; oil 40, inner ring " in " ".join(result.stdout.split())
    assert max(map(len, result.stdout.splitlines())) <= 80


def test_load_and_angle_of_a_ball_are_of_one_race(run):
    shown = run("info", SET, "--set", "spindle.load.force_x_N=0", "--set", "spindle.load.force_z_N=0").stdout
    table = shown.partition("by race")[2]
    cells = [part.strip() for part in next(line for line in table.splitlines() if "1, +x" in line).split("│")]
    inner, outer, at_inner, at_outer = map(float, cells[2:6])
    axial = float(next(line for line in shown.splitlines() if "1, +x" in line).split("│")[3])
    # each race carries the axial load; friction against the gyroscopic moment and weights take below 5 %
    for load, angle in ((inner, at_inner), (outer, at_outer)):
        assert 12 * load * math.sin(math.radians(angle)) == pytest.approx(axial, rel=0.05)
    assert outer > inner and at_inner > at_outer


@pytest.mark.heavy
def test_a_set_is_checked_shown_and_run(run, tmp_path):
    result = run("scene", "check", SET)
    assert result.exit_code == 0 and "a scene, with an equilibrium" in result.stdout
    # nobody asked for error motion against an outer ring, which no set has
    assert result.stdout.partition("at its operating point\n")[2] == ""
    shown = run("scene", "check", SET, EXAMPLES / "7003C-bare.toml", "--json").data
    assert all(shown[str(path)]["cannot"] == [] for path in (SET, EXAMPLES / "7003C-bare.toml"))
    out = tmp_path / "run.csv"
    result = run("simulate", SET, "-t", 1e-3, "-v", "bearing[*].force.x", "-o", out, "--json")
    assert result.exit_code == 0 and result.data["points"] == 2
    assert run("plot", out).exit_code == 0 and out.with_suffix(".png").is_file()
    result = run("scene", "show", SET, "--json")
    assert result.data["computed"]["scene"] == "7003C-DB: 2 x 7003C, DB (O), 15000 r/min"
    assert {one["key"] for one in result.data["values"]} >= {
        "spindle.preload.kind",
        "spindle.bearing[1].carries",
    }


def test_a_bearing_of_a_set_without_load_is_shown_and_checked(run, tmp_path):
    """It has neither life nor static safety: its cells are empty."""
    file = tmp_path / "free.toml"
    load = {"force_x_N": 2500.0, "position_mm": 0.0}
    file.write_text(bearings(preload=500.0, load=load).to_toml(), "utf-8")
    result = run("info", file)
    assert result.exit_code == 0 and "caution: axial load 2500 N: above the 2194 N" in result.stderr
    assert "lift-off over axial load" in result.stdout
    result = run("scene", "check", file)
    assert result.exit_code == 0 and "bearing 1: contact pressure" in result.stdout
    assert "above the 2194 N that unload bearing 2" in result.stdout


#: Catalogue bearing, changes of the scene that `scene new` writes, radial stiffness at rest, N/um. Own
#: figures; the quasi-static state had 141 and 136.3 there, which `stiffness` did not.
LIGHT = (
    ("NSK-7010AC", "hybrid", {"operation.speed_rpm": 15e3, "mounting.preload_N": 590.0}, 128.8),
    ("NSK-7914C", "steel", {"operation.speed_rpm": 6e3, "mounting.preload_N": 200.0}, 125.5),
)


@pytest.mark.heavy
@pytest.mark.parametrize(("bearing", "kind", "changes", "radial"), LIGHT)
def test_stiffness_is_one_figure(run, tmp_path, bearing, kind, changes, radial):
    path = tmp_path / "light.toml"
    assert run("scene", "new", path, "--bearing", bearing, "--kind", kind).exit_code == 0
    rings = dict.fromkeys(("oil", "inner_ring", "outer_ring"), 20.0)
    warmth = {f"operation.{part}_temperature_degC": value for part, value in rings.items()}
    loose = {"mounting.tilt_support": None}
    loose |= {"bearing.inner_conformity": 0.52, "bearing.outer_conformity": 0.53}
    light = read_scene(path).replace(changes | warmth | loose)
    path.write_text(light.to_toml(), "utf-8")
    result = run("info", path, "--json")
    matrix = np.array(result.data["bearings"][0]["stiffness"])
    # traction, and what a new scene assumes, move it by less
    assert 1e-6 * matrix[1, 1] == pytest.approx(radial, rel=5e-3)
    known = stiffness(light, frequencies=[0.1])
    # friction lets the spin of light balls follow within 0.1 s
    np.testing.assert_allclose(matrix, known.bearings[0].K[0, 0, 0], rtol=1e-3, atol=1e-4 * matrix[0, 0])
    assert point(light).stiffness == pytest.approx(1e-6 * 0.5 * (matrix[1, 1] + matrix[2, 2]), rel=1e-9)


def test_the_matrix_is_headed_by_directions(run):
    lines = run("info", EXAMPLES / "7003C-spindle.toml").stdout.splitlines()
    head = next(k for k, line in enumerate(lines) if "stiffness at rest" in line)
    assert "axial" in lines[head + 2] and "radial z" in lines[head + 2]
    rows = [line.split("│")[1].strip() for line in lines[head + 4 : head + 9]]
    assert rows == ["axial", "radial y", "radial z", "tilt y", "tilt z"]


@pytest.mark.heavy
@pytest.mark.parametrize("command", [("info",), ("scene", "check"), ("modes",)])
def test_a_soft_pedestal_is_named(run, tmp_path, command):
    firm, weak = (f"pedestal_stiffness_N_m = {value}" for value in ("1e8", "1e5"))
    soft = changed(tmp_path, (firm, weak), name="7003C-bare")
    result = run(*command, soft)
    assert result.exit_code == 0
    words = " ".join((result.stdout + result.stderr).split())
    key = "mounting.pedestal_stiffness_N_m = 100000"
    # 500 N along the axis; its axial stiffness is the radial one
    assert f"soft pedestal: with {key} the loads move the outer ring by 5 mm; give 1e+06 N/m" in words
    assert "no steady state" not in words
    firm = changed(tmp_path, name="7003C-bare")
    result = run(*command, firm)
    assert "soft pedestal" not in result.stdout + result.stderr


@pytest.mark.heavy
@pytest.mark.parametrize("speed", [0, 1, 1e-6, -50])
@pytest.mark.parametrize("path", [EXAMPLES / "7003C-bare.toml", SET], ids=["bare", "set"])
def test_a_speed_that_decides_no_waves_is_taken(run, path, speed):
    """They stay those of the scene's own speed."""
    for words in (("--speed", speed), ("--set", f"shaft_speed_rpm={speed}")):
        found = run("info", path, *words, "--json")
        assert found.exit_code == 0, found.stderr
