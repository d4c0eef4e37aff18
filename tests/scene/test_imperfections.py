"""Imperfections: by grade, by amplitudes, by harmonics, and what is drawn from the seed."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import P
from fmu_bearing.prepare.imperfections import ball_oversizes, ball_waves, order_energies, race_harmonics
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import SceneError, read_scene, read_scene_text
from fmu_bearing.scene.imperfections import Harmonic, Imperfections
from fmu_bearing.scene.read import catalogue
from tests.conftest import EXAMPLES, GATES

SETS = EXAMPLES.parent / "spindle_set"
TEXT = (GATES / "7003C-bare.toml").read_text(encoding="utf-8")
FROM, TO = TEXT.index("[imperfections]"), TEXT.index("[operation]")
GRADES = ["P0", "P6", "P5", "P4", "P2"]
BY_HAND = """seed = 1
unbalance_um = 0.5
ball_diameter_spread_nm = 50.0
"""


def flawed(lines):
    """The bare bearing with these lines in its table of imperfections."""
    return read_scene_text(TEXT[:FROM] + "[imperfections]\n" + lines + "\n" + TEXT[TO:], "a")


def refused(lines):
    with pytest.raises(SceneError) as caught:
        flawed(lines)
    return [line.removeprefix("a: ") for line in caught.value.problems]


def race_waves(scene):
    """Tables of inner and outer race one after the other; empty where there are none."""
    p = pack(scene, np.empty(0))
    return p[int(p[P.AT_WAVES]) :][: 4 * int(p[P.WAVE_INTERVALS]) * int(p[P.WAVINESS])]


def harmonics(race, rows):
    return "".join(
        f"[[imperfections.{race}_race_harmonic]]\norder = {order}\n"
        f"amplitude_um = {float(amplitude)!r}\nphase_deg = {float(phase)!r}\n"
        for order, amplitude, phase in rows
    )


# --- grades --------------------------------------------------------------------------------------


def test_every_grade_is_valid():
    entries = catalogue("grades")
    assert list(entries) == GRADES
    for name, entry in entries.items():
        assert Imperfections.model_validate({"seed": 1, **entry}), name


def test_p4_is_the_standard_set(example):
    standard = example("7003C-bare").imperfections
    assert flawed('seed = 1\ngrade = "P4"').imperfections == standard


def test_finer_grades_have_smaller_imperfections():
    keys = [
        "unbalance_um",
        "ball_diameter_spread_nm",
        "inner_race_amplitude_um",
        "outer_race_amplitude_um",
    ]
    rows = np.array([[catalogue("grades")[grade][key] for key in keys] for grade in GRADES])
    assert np.all(np.diff(rows, axis=0) < 0.0)
    forms = [catalogue("grades")[grade]["ball_form_nm"] for grade in GRADES]
    assert forms == [250.0, 250.0, 130.0, 80.0, 80.0]  # G10, G10, G5, G3, G3 (ISO 3290-2)


def test_the_files_keys_win_over_the_grade():
    flaws = flawed('grade = "P0"\nseed = 7\nunbalance_um = 0\nhighest_order = 30').imperfections
    assert (flaws.unbalance_um, flaws.highest_order, flaws.seed) == (0.0, 30, 7)
    assert flaws.inner_race_amplitude_um == 1.5


def test_grade_survives_the_way_through_toml_as_values():
    scene = flawed('grade = "P5"\nseed = 3')
    assert "grade" not in scene.to_toml()
    assert read_scene_text(scene.to_toml()) == scene


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (
            'seed = 1\ngrade = "P44"',
            "imperfections.grade = 'P44' is not in the catalogue; did you mean 'P4'?",
        ),
        (
            "seed = 1\ngrade = 4",
            "imperfections.grade = 4 is not in the catalogue; did you mean 'P4'? known: P0, P6",
        ),
        ('seed = 1\ngrad = "P4"', "imperfections.grad is not a key of a scene; did you mean 'grade'?"),
        ("seed = 1", "unbalance_um is missing, for example unbalance_um = 0.5 (Eccentricity of the rotating"),
        ("seed = 1", 'or take all from grade = "P4"'),
    ],
)
def test_grades_that_are_none(lines, expected):
    found = refused(lines)
    assert any(expected in line for line in found), found


def test_a_grade_alone_has_the_first_seed(scene):
    given = scene("7003C-spindle").replace({"imperfections": None})
    alone = given.replace({"imperfections": {"grade": "P4"}})
    assert alone == given.replace({"imperfections": {"grade": "P4", "seed": 1}})


# --- harmonics -----------------------------------------------------------------------------------


def test_harmonics_with_the_numbers_of_a_band_give_its_table(scene):
    bare = scene("7003C-bare")
    lines = BY_HAND
    for race, (amplitudes, orders, phases) in zip(("inner", "outer"), race_harmonics(bare), strict=True):
        assert list(orders) == list(range(2, 21)) and amplitudes == pytest.approx(0.1e-6)
        lines += harmonics(race, zip(orders, amplitudes * 1e6, np.degrees(phases), strict=True))
    # phases through degrees and back: a few ulp of 2 pi times order 20 on 19 harmonics of 0.1 um
    np.testing.assert_allclose(race_waves(flawed(lines)), race_waves(bare), rtol=0, atol=1e-20)


def test_one_race_by_harmonics_leaves_the_others_draw_alone(scene):
    lines = BY_HAND + "outer_race_amplitude_um = 0.1\nlowest_order = 2\nhighest_order = 20\n"
    lines += "waviness_exponent = 0\ncontact_filter = false\n"
    mixed, bare = (
        race_waves(flawed(lines + harmonics("inner", [(3, 0.2, 90.0)]))),
        race_waves(scene("7003C-bare")),
    )
    half = bare.size // 2
    assert np.array_equal(mixed[half:], bare[half:])
    angle = 2.0 * np.pi * np.arange(half // 2) / (half // 2)
    # 0.2 um cos(3 angle + 90 deg) = -0.2 um sin(3 angle)
    np.testing.assert_allclose(mixed[:half:2], -0.2e-6 * np.sin(3.0 * angle), rtol=0, atol=1e-20)


def test_harmonics_beside_a_grade_stand_for_its_band():
    flaws = flawed('seed = 1\ngrade = "P4"\n' + harmonics("outer", [(5, 1.0, 0.0)])).imperfections
    assert (flaws.inner_race_amplitude_um, flaws.outer_race_amplitude_um) == (0.3, None)
    assert (flaws.lowest_order, flaws.highest_order) == (2, None)
    both = harmonics("inner", [(5, 1.0, 0.0)]) + harmonics("outer", [(5, 1.0, 0.0)])
    flaws = flawed('seed = 1\ngrade = "P4"\n' + both).imperfections
    assert flaws.highest_order is flaws.inner_race_amplitude_um is None


INNER, OUTER = (harmonics(race, [(5, 1.0, 0.0)]) for race in ("inner", "outer"))


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (
            "inner_race_amplitude_um = 0.1\nlowest_order = 2\nhighest_order = 3\n" + INNER + OUTER,
            "imperfections.inner_race_amplitude_um = 0.1 cannot be given with "
            "[[imperfections.inner_race_harmonic]]",
        ),
        (
            INNER,
            "imperfections.outer_race_amplitude_um is missing, for example outer_race_amplitude_um = 0.3",
        ),
        (INNER, 'or give [[imperfections.outer_race_harmonic]], or grade = "P4" for all'),
        (
            "outer_race_amplitude_um = 0.1\n" + INNER,
            "waviness_exponent is missing, for example waviness_exponent = 1.35: amplitudes are A_1",
        ),
        ("ball_form_nm = 80\n" + INNER + OUTER, "waviness_exponent is missing"),
        (
            "highest_order = 9\n" + INNER + OUTER,
            "highest_order = 9 has no meaning where both races have explicit harmonics",
        ),
        (INNER + INNER + OUTER, "imperfections.inner_race_harmonic: order 5 is given more than once"),
        (
            INNER + OUTER.replace("order = 5", "order = 0"),
            "imperfections.outer_race_harmonic[1].order = 0 is refused; allowed: 1 to 1000, whole",
        ),
        (
            INNER + OUTER.replace("amplitude_um = 1.0", "amplitude_um = 21"),
            "outer_race_harmonic[1].amplitude_um = 21 is refused; allowed: 0 to 20 um",
        ),
        (
            INNER + OUTER.replace("phase_deg = 0.0", "phase_deg = 721"),
            "outer_race_harmonic[1].phase_deg = 721 is refused; allowed: -720 to 720 deg",
        ),
        (INNER + OUTER.replace("order = 5\n", ""), "outer_race_harmonic[1].order is missing, for example"),
        (
            "inner_race_harmonic = 3\n" + OUTER,
            "inner_race_harmonic = 3 is refused; allowed: at most 200 tables",
        ),
    ],
)
def test_waviness_by_halves_or_twice(lines, expected):
    found = refused(BY_HAND + lines)
    assert any(expected in line for line in found), found


def test_a_smooth_race_needs_no_orders():
    scene = flawed(BY_HAND + "inner_race_amplitude_um = 0\nouter_race_amplitude_um = 0\n")
    assert race_waves(scene).size == 0


# --- the seed ------------------------------------------------------------------------------------


def test_draws_are_those_of_the_first_release(scene):
    """Pinned, because a scene's numbers must not change: NumPy's generator for each kind of draw, seed first.

    Order 1 has a draw of its own, phases of the orders from 2 on are one draw.
    """
    bare = scene("7003C-bare")
    for race, found in enumerate(race_harmonics(bare)):
        assert list(found.orders) == list(range(2, 21))
        assert np.array_equal(found.phases, np.random.default_rng([1, race]).uniform(0.0, 2.0 * np.pi, 19))
        whole = bare.model_copy(
            update={"imperfections": bare.imperfections.model_copy(update={"lowest_order": 1})}
        )
        first = np.random.default_rng([1, race, 1]).uniform(0.0, 2.0 * np.pi, 1)[0]
        assert race_harmonics(whole)[race].phases[0] == first
    drawn = np.random.default_rng([1, 2]).uniform(-50e-9, 50e-9, 12)
    assert np.array_equal(ball_oversizes(bare), drawn - drawn.mean())
    axes = np.random.default_rng([1, 3]).normal(size=(12, 3))
    wavy = bare.model_copy(
        update={"imperfections": bare.imperfections.model_copy(update={"ball_waviness_nm": 20.0})}
    )
    assert np.array_equal(ball_waves(wavy)[1].T, axes / np.linalg.norm(axes, axis=1)[:, None])


def test_the_seed_fixes_every_number():
    one, again, other = (flawed(f'grade = "P4"\nseed = {seed}') for seed in (1, 1, 2))
    for draw in (race_waves, ball_oversizes, lambda scene: ball_waves(scene)[1]):
        assert np.array_equal(draw(one), draw(again))
        assert not np.array_equal(draw(one), draw(other))


def test_round_balls_have_no_table(scene):
    amplitudes, axes = ball_waves(scene("7003C-bare"))
    assert amplitudes.size == axes.size == 0


def test_wavy_balls():
    lines = "ball_form_nm = 0\nball_waviness_nm = 20\nball_waviness_order = 4"
    scene = flawed('grade = "P4"\nseed = 1\n' + lines)
    amplitudes, axes = ball_waves(scene)
    assert list(amplitudes) == [0.0, 0.0, 0.0, 20e-9]
    assert axes.shape == (3, 12)
    np.testing.assert_allclose(np.linalg.norm(axes, axis=0), 1.0, rtol=1e-15)


def test_an_order_beside_the_form_adds_to_it():
    form, both = (
        ball_waves(flawed(f'grade = "P4"\nseed = 1\nball_waviness_nm = {amplitude}'))[0]
        for amplitude in (0.0, 20.0)
    )
    assert both[1] - form[1] == pytest.approx(20e-9, rel=1e-12)
    assert np.array_equal(np.delete(both, 1), np.delete(form, 1))


def test_axes_of_wavy_balls_point_everywhere_equally():
    axes = np.concatenate(
        [ball_waves(flawed(f'grade = "P4"\nseed = {seed}'))[1] for seed in range(100)], axis=1
    )
    # 1200 directions: the mean of a component has the standard deviation 1/sqrt(3 * 1200) = 0.017, that of
    # its square sqrt(4/45/1200) = 0.009; four of each
    assert np.all(np.abs(axes.mean(axis=1)) < 0.07)
    np.testing.assert_allclose((axes**2).mean(axis=1), 1.0 / 3.0, atol=0.035)


def test_each_source_alone_is_a_scene_that_reads_back(example):
    bare = example("7003C-bare")
    flaws = bare.imperfections.model_copy(
        update={
            "inner_race_amplitude_um": None,
            "inner_race_harmonic": (Harmonic(order=13, amplitude_um=0.1),),
            "unbalance_um": 0.5,
        }
    )
    assert flaws.sources == ("unbalance", "inner race", "outer race", "ball sizes", "form of the balls")
    for source in flaws.sources:
        alone = flaws.alone(source)
        assert alone.sources == (source,)
        # checked as a file is: a race without waves has an amplitude of 0
        bare.replace({"imperfections": alone.model_dump()})
    assert flaws.alone("weather").sources == ()


def test_other_seeds_follow_the_own_one_and_begin_again_behind_the_last(example):
    flaws = example("7003C-bare").imperfections.model_copy(update={"seed": 2**31 - 2})
    assert [one.seed for one in flaws.redrawn(2)] == [2**31 - 1, 0]
    assert {one.model_copy(update={"seed": flaws.seed}) for one in flaws.redrawn(2)} == {flaws}


# --- orders that scatter about the law -------------------------------------------------------------


def split_mix(place):
    """Number ``place`` (from 0) of the sequence SplitMix64 from the state 0, in whole numbers of Python."""
    mask = 2**64 - 1
    z = (place + 1) * 0x9E3779B97F4A7C15 & mask
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 & mask
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB & mask
    return z ^ (z >> 31)


def test_orders_scatter_about_the_law_from_a_seed_of_their_own():
    """Oracle: the law's amplitudes times the root of -ln of a uniform number per seed, race and order."""
    assert split_mix(0) == 0xE220A8397B1DCDAF  # the first number that its authors' program prints
    exact, scattered = (flawed(f'grade = "P4"\nseed = 1\n{more}') for more in ("", "order_scatter_seed = 8"))
    pairs = zip(race_harmonics(exact), race_harmonics(scattered), strict=True)
    for race, (by_law, drawn) in enumerate(pairs):
        places = [(8 << 11) + (race << 10) + int(order) for order in drawn.orders]
        factors = [-np.log(((split_mix(place) >> 11) + 0.5) / 2**53) for place in places]
        assert np.array_equal(by_law.orders, drawn.orders) and np.array_equal(by_law.phases, drawn.phases)
        # the square root, a logarithm and one product: some ulp
        np.testing.assert_allclose((drawn.amplitudes / by_law.amplitudes) ** 2, factors, rtol=1e-14)
    for draw in (ball_oversizes, lambda scene: ball_waves(scene)[1], lambda scene: ball_waves(scene)[0]):
        assert np.array_equal(draw(exact), draw(scattered))


def test_scatter_leaves_the_mean_energy_and_belongs_to_the_order():
    seeds, orders = np.arange(50)[:, None], np.arange(1, 1001)
    energies = np.array([order_energies(seeds, race, orders) for race in range(2)])
    # 100,000 draws of mean and variance 1, kurtosis 9: four standard deviations of their mean and variance
    assert energies.mean() == pytest.approx(1.0, abs=4.0 * energies.size**-0.5)
    assert energies.var() == pytest.approx(1.0, abs=4.0 * (8.0 / energies.size) ** 0.5)
    # neighbours in race, seed and order know nothing of each other
    for one, other in (
        (energies[0], energies[1]), (energies[:, 1:], energies[:, :-1]),
        (energies[..., 1:], energies[..., :-1]),
    ):  # fmt: skip
        assert abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 4.0 * one.size**-0.5
    assert np.array_equal(order_energies(3, 1, 12), energies[1, 3, 11])
    low, high = (
        race_harmonics(flawed(f'grade = "P4"\nseed = 1\norder_scatter_seed = 2\nhighest_order = {n}'))
        for n in (60, 300)
    )
    assert np.array_equal(low[0].amplitudes, high[0].amplitudes[: low[0].orders.size])


def test_every_bearing_of_a_set_has_orders_of_its_own():
    pair = read_scene(SETS / "7003C-DB.toml").replace(
        {"imperfections": {"grade": "P4", "seed": 3, "order_scatter_seed": 7}}
    )
    drawn = [one.scene.imperfections for one in pair.bearings()]
    assert [(flaws.seed, flaws.order_scatter_seed) for flaws in drawn] == [(3, 7), (4, 8)]
    exact = pair.replace({"imperfections.order_scatter_seed": None})
    assert [one.scene.imperfections.order_scatter_seed for one in exact.bearings()] == [None, None]


def test_scatter_beside_harmonics_of_both_races_is_refused():
    (line,) = refused(BY_HAND + INNER + OUTER + "order_scatter_seed = 1")[:1]
    assert "order_scatter_seed" in line


@pytest.mark.parametrize("name", ["DB", "QBC"])
def test_no_bearing_of_a_set_has_the_surfaces_of_another_draw(name):
    path = EXAMPLES.parent / "spindle_set" / f"7003C-{name}.toml"
    scene = read_scene(path).replace({"imperfections": {"grade": "P4", "seed": 5, "order_scatter_seed": 9}})
    draws = [scene.imperfections, *scene.imperfections.redrawn(3, scene.seeds_apart)]
    drawn = [scene.model_copy(update={"imperfections": one}) for one in draws]
    for key in ("seed", "order_scatter_seed"):
        seeds = [getattr(one.scene.imperfections, key) for each in drawn for one in each.bearings()]
        assert len(set(seeds)) == len(seeds) == 4 * len(scene.bearings())
