"""Options of the dynamics: what is accepted, what files without them mean, what does not go together."""

import tomllib

import pytest

from fmu_bearing.scene import Scene, SceneError, read_scene_text, si
from tests.conftest import EXAMPLES, GATES

TEXT = (GATES / "7003C-bare.toml").read_text(encoding="utf-8")
OPTIONS = """method race_control rolling_reduction contact_damping pocket_friction viscosity_law walther_slope
traction_law eyring_stress_MPa preload_mode misalignment_y_mrad misalignment_z_mrad ball_waviness_nm
ball_waviness_order level_dB relative""".split()
SPRINGS = "\n[bearing.ball_springs]\nstiffness_N_m = 5e6\n"


def changed(*changes, text=TEXT):
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return text


def refused(text):
    with pytest.raises(SceneError) as caught:
        read_scene_text(text, "a")
    return [line.removeprefix("a: ") for line in caught.value.problems]


def without_cage(text=TEXT):
    return text[: text.index("[bearing.cage]")] + text[text.index("[materials.inner_ring]") :]


def test_a_file_that_names_no_option_means_what_it_meant_before():
    text = (EXAMPLES / "7003C-bare.toml").read_text(encoding="utf-8")
    data = tomllib.loads(text)
    named = [data["fidelity"], data["fidelity"]["terms"], data["fidelity"].pop("accuracy")]
    named += [data["lubricant"], data["mounting"], data["imperfections"]]
    for key in OPTIONS:
        assert sum(table.pop(key, None) is not None for table in named) == 1, key
    was, now = Scene.model_validate(data), read_scene_text(text)
    # the examples' oil has a slope of its own, which Vogel's law does not read
    slope = {"walther_slope": was.lubricant.walther_slope}
    assert was == now.model_copy(update={"lubricant": now.lubricant.model_copy(update=slope)})
    assert was.fidelity.accuracy.level_dB == 1.0 and was.fidelity.accuracy.relative == 0.1


@pytest.mark.parametrize(
    ("table", "key", "value"),
    [
        *(("fidelity", "model", name) for name in ("rings", "response", "auto")),
        *(("fidelity", "method", name) for name in ("trbdf2", "rk4")),
        *(("fidelity", "race_control", name) for name in ("outer", "inner")),
        *(("lubricant", "traction_law", name) for name in ("eyring", "paper")),
        ("lubricant", "viscosity_law", "walther"),
        ("mounting", "preload_mode", "rigid"),
    ],
)
def test_choices(table, key, value):
    today = {"model": "full", "method": "esdirk4", "race_control": "shared", "traction_law": "regularised"}
    today |= {"viscosity_law": "vogel", "preload_mode": "force"}
    scene = read_scene_text(changed((f'{key} = "{today[key]}"', f'{key} = "{value}"')))
    assert getattr(getattr(scene, table), key) == value
    assert read_scene_text(scene.to_toml()) == scene


def test_numbers_arrive_in_si():
    scene = read_scene_text(
        changed(
            ("misalignment_y_mrad = 0.0", "misalignment_y_mrad = 0.5"),
            ("misalignment_z_mrad = 0.0", "misalignment_z_mrad = -10"),
            ("eyring_stress_MPa = 5.0", "eyring_stress_MPa = 4"),
            ("ball_waviness_nm = 0.0", "ball_waviness_nm = 20"),
        )
    )
    assert si(scene.mounting).misalignment_y == 5e-4 and si(scene.mounting).misalignment_z == -0.01
    assert si(scene.lubricant).eyring_stress == 4e6
    assert si(scene.imperfections).ball_waviness == 20e-9


@pytest.mark.parametrize("term", ["rolling_reduction", "contact_damping", "pocket_friction"])
def test_terms_can_be_left_out(term):
    scene = read_scene_text(changed((f"{term} = true", f"{term} = false")))
    assert getattr(scene.fidelity.terms, term) is False


def test_accuracy_may_be_given_in_part():
    scene = read_scene_text(changed(('model = "full"', 'model = "auto"'), ("relative = 0.1\n", "")))
    assert scene.fidelity.accuracy.relative == 0.1
    (line,) = refused(changed(("[fidelity.accuracy]", "[fidelity.accuracy]\nlevel = 3")))
    assert line.startswith("fidelity.accuracy.level is not a key of a scene")


def test_springs_between_balls_need_no_cage_and_no_material():
    text = without_cage()
    start = text.index("[materials.cage]")
    text = text[:start] + SPRINGS + text[text.index("[lubricant]") :]
    springs = read_scene_text(text).bearing.ball_springs
    assert (springs.stiffness_N_m, springs.damping_N_s_m) == (5e6, 0.0)
    assert read_scene_text(read_scene_text(text).to_toml()) == read_scene_text(text)


def test_springs_and_cage_exclude_each_other():
    (line,) = refused(TEXT + SPRINGS)
    assert line.startswith(
        "bearing.ball_springs: replace a cage and cannot be given with one: write cage = false"
    )


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("5e6", "0", "bearing.ball_springs.stiffness_N_m = 0 is refused; allowed: 1 to 1e+09 N/m"),
        ("5e6", "5e6\ndamping_N_s_m = -1", "damping_N_s_m = -1 is refused; allowed: 0 to 10000 N s/m"),
        ("stiffness_N_m = 5e6", "", "stiffness_N_m is missing, for example stiffness_N_m = 100000.0"),
        ("stiffness_N_m", "stifness_N_m", "did you mean 'stiffness_N_m'?"),
    ],
)
def test_springs_out_of_range(old, new, expected):
    lines = refused(without_cage() + SPRINGS.replace(old, new))
    assert any(expected in line for line in lines), lines
    assert not any("catalogue" in line for line in lines)
