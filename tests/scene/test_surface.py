"""Surfaces found from a measurement: their law, their draws, their file, and scenes that take them."""

import numpy as np
import pytest

from fmu_bearing import read_scene
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.surface import KEYS, Surface
from fmu_bearing.scene.surface_file import read_surface, surface_toml, write_surface
from tests.conftest import EXAMPLES

BARE = EXAMPLES / "7003C-bare.toml"


def made(count=400, scatter=True, seed=1):
    """Draws of ln A_1 and p with a correlation of 0.9, and of ln B."""
    rng = np.random.default_rng(seed)
    common, own, balls = rng.normal(size=(3, count))
    exponent = 1.5 + 0.05 * (0.9 * common + (1.0 - 0.9**2) ** 0.5 * own)
    numbers = np.arange(count)
    return Surface(
        "7003C", "L = 41 um/s, M = 42 um/s", np.exp(-1.0 + 0.3 * common), exponent,
        80.0 * np.exp(0.5 * balls), numbers, numbers + 7 if scatter else None, ("ask for a line",),
    )  # fmt: skip


@pytest.fixture(scope="module")
def found():
    return made()


@pytest.fixture
def file(found, tmp_path):
    return write_surface(found, tmp_path / "surface.toml")


def test_law_is_median_and_95_percent_of_the_draws(found):
    law = found.law
    assert law.amplitude_um == tuple(np.quantile(found.amplitude_um, [0.5, 0.025, 0.975]))
    assert law.exponent.low < law.exponent.median < law.exponent.high
    assert found.order(12) == tuple(
        np.quantile(1e3 * found.amplitude_um * 12.0**-found.exponent, [0.5, 0.025, 0.975])
    )
    assert found.rows()[1][0][0] == "order 12 of the races, nm"


def test_covariance_is_that_of_the_logarithms(found):
    # 400 draws: standard deviations to 1 / sqrt(2 * 400) = 3.5 %, correlation 0.9 to 0.01; three of each
    assert np.sqrt(np.diag(found.covariance)) == pytest.approx([0.3, 0.05, 0.5], rel=0.11)
    assert found.correlation[0, 1] == pytest.approx(0.9, abs=0.03)
    assert np.diag(found.correlation) == pytest.approx([1.0, 1.0, 1.0], rel=1e-12)


def test_draws_are_imperfections_with_the_rest_of_a_scene(found):
    flaws = read_scene(BARE).imperfections
    one, other = found.draws(2, flaws)
    assert one.inner_race_amplitude_um == one.outer_race_amplitude_um == found.amplitude_um[0]
    assert (other.waviness_exponent, other.ball_form_nm) == (found.exponent[1], found.ball_form_nm[1])
    assert (other.seed, other.order_scatter_seed) == (1, 8)
    rest = {*type(flaws).model_fields} - {*KEYS, "seed", "order_scatter_seed"}
    assert all(getattr(one, key) == getattr(flaws, key) for key in rest)
    (alone,) = found.draws(1)
    assert (alone.unbalance_um, alone.ball_diameter_spread_nm) == (0.0, 0.0)
    assert len(found.draws()) == len(found) == 400
    assert made(scatter=False).draws(1)[0].order_scatter_seed is None
    with pytest.raises(ValueError, match="401 draws of a surface that holds 400: give 1 to 400"):
        found.draws(401)


def test_a_file_gives_the_same_surface(found, file):
    read = read_surface(file)
    assert (read.bearing, read.measured, read.remarks) == (found.bearing, found.measured, found.remarks)
    assert np.array_equal(read.seed, found.seed)
    assert np.array_equal(read.order_scatter_seed, found.order_scatter_seed)
    for name in ("amplitude_um", "exponent", "ball_form_nm"):
        # five digits are written
        np.testing.assert_allclose(getattr(read, name), getattr(found, name), rtol=5e-5)
    assert surface_toml(read_surface(file)) == file.read_text("utf-8")  # and no more are lost
    exact = write_surface(made(scatter=False), file)
    assert read_surface(exact).order_scatter_seed is None


def test_a_scene_takes_the_median_law(file):
    scene = read_scene(BARE)
    taken = scene.replace({"imperfections.surface": str(file)})
    assert taken == read_surface(file).scene(scene)
    law = read_surface(file).law
    assert taken.imperfections.waviness_exponent == pytest.approx(law.exponent.median, rel=1e-4)
    assert taken.imperfections.seed == scene.imperfections.seed
    assert taken.imperfections.order_scatter_seed is None


def test_the_file_counts_from_the_scene_and_its_own_keys_win(file):
    text = BARE.read_text("utf-8")
    start, end = text.index("[imperfections]"), text.index("[operation]")
    lines = '[imperfections]\nseed = 4\ngrade = "P5"\nsurface = "surface.toml"\nball_form_nm = 60.0\n\n'
    path = file.parent / "scene.toml"
    path.write_text(text[:start] + lines + text[end:], encoding="utf-8")
    scene = read_scene(path)
    flaws, law = scene.imperfections, read_surface(file).law
    assert (flaws.ball_form_nm, flaws.seed, flaws.unbalance_um) == (60.0, 4, 0.8)  # the last is P5's
    assert flaws.outer_race_amplitude_um == pytest.approx(law.amplitude_um.median, rel=1e-4)
    named = {one.key: one for one in origins(path)}
    assert named["imperfections.waviness_exponent"].origin == "surface surface.toml"
    assert not named["imperfections.waviness_exponent"].assumed
    assert named["imperfections.ball_form_nm"].origin == "file"
    assert named["imperfections.unbalance_um"].origin == "grade P5"


def test_harmonics_of_a_race_stay(file):
    harmonics = [{"order": 5, "amplitude_um": 0.1}]
    changed = {
        "imperfections.inner_race_harmonic": harmonics,
        "imperfections.inner_race_amplitude_um": None,
        "imperfections.surface": str(file),
    }
    flaws = read_scene(BARE).replace(changed).imperfections
    assert flaws.inner_race_amplitude_um is None and flaws.outer_race_amplitude_um is not None
    explicit = read_scene(BARE).replace({**changed, "imperfections.surface": None})
    with pytest.raises(SceneError, match="inner_race_harmonic.*leave the harmonics out"):
        read_surface(file).scene(explicit)
    with pytest.raises(SceneError, match="imperfections is missing"):
        read_surface(file).scene(explicit.replace({"imperfections": None}))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[draws]", "[drawn]", r"\[draws\] is missing"),
        ("waviness_exponent", "exponent", "draws.exponent: no key of a surface"),
        ("seed = [\n    0,", "seed = [\n    -1,", "draws.seed: value 1 is -1; allowed: whole numbers, 0 to"),
        ("seed = [\n    0,", "seed = [\n    0.5,", "draws.seed: value 1 is 0.5"),
        ("seed = [\n    0,", "seed = [\n    ", "draws.seed has 399 values, and draws.race_amplitude_um 400"),
        ("race_amplitude_um = [\n    ", "race_amplitude_um = [\n    25.0, ", "value 1 is 25.0; allowed"),
        ("race_amplitude_um = [\n    ", "race_amplitude_um = [\n    nan, ", "value 1 is nan; allowed"),
        ("race_amplitude_um = [\n    ", 'race_amplitude_um = [\n    "a", ', "value 1 is 'a'; allowed"),
        ('bearing = "7003C"', "bearing = 7", "bearing has to be text"),
        ("remarks = [", "remarks = [3, ", "remarks has to be an array of texts"),
        ("remarks = [", "remarks = ", "Expected newline or end of document"),
    ],
)
def test_files_that_are_refused(file, old, new, words):
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(SceneError, match=words) as caught:
        read_surface(file)
    assert str(caught.value).startswith(str(file))


def test_other_files_are_named(tmp_path, file):
    with pytest.raises(SceneError, match="there is no such file of a surface"):
        read_surface(tmp_path / "none.toml")
    with pytest.raises(SceneError, match="is not a surface found from a vibration test, but a scene"):
        read_surface(BARE)
    with pytest.raises(SceneError, match="is not a scene, but a surface found from a vibration test"):
        read_scene(file)
    with pytest.raises(SceneError, match="imperfections.surface: .*none.toml: there is no such file"):
        read_scene(BARE).replace({"imperfections.surface": "none.toml"})
    with pytest.raises(SceneError, match="imperfections.surface is refused; allowed: the name of a file"):
        read_scene(BARE).replace({"imperfections.surface": 3})
