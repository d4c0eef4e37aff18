"""Load ratings against printed ones, life by ISO 281, makers' limits."""

import pytest

from fmu_bearing.design import rating as rate
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.read import catalogue


def sized(scene, **keys):
    return scene.model_copy(update={"bearing": scene.bearing.model_copy(update=keys)})


@pytest.fixture(scope="module")
def hybrid(scene):
    return scene("7003C-spindle")


def test_ratings_are_those_that_nsk_prints(hybrid):
    """NSK super-precision catalogue: 7003C 6.60 and 3.80 kN, 7009C 24.4 and 19.3 kN, by its balls."""
    small = sized(hybrid, ball_count=12, ball_diameter_mm=4.762, pitch_diameter_mm=26.0)
    large = sized(hybrid, ball_count=17, ball_diameter_mm=8.731, pitch_diameter_mm=60.0)
    # three digits are printed; balls are standard sizes that give the ratings best
    for one, printed in ((small, (6600.0, 3800.0)), (large, (24_400.0, 19_300.0))):
        found = rate.rating(one, 500.0, 0.0, 1000.0)
        assert (found.dynamic, found.static) == pytest.approx(printed, rel=0.005)


def test_life_is_that_of_iso_281(hybrid):
    """500 N axially on the 7003C: P = Y Fa; Y interpolated at f0 Fa / C0 = 2.13 is 1.12."""
    found = rate.rating(hybrid, 500.0, 0.0, 20_000.0)
    assert found.equivalent == pytest.approx(1.12 * 500.0, rel=1e-3)
    assert found.life == pytest.approx((found.dynamic / found.equivalent) ** 3 / (60.0 * 0.02), rel=1e-12)
    # life in turns does not know the speed
    assert rate.rating(hybrid, 500.0, 0.0, 5000.0).life == pytest.approx(4.0 * found.life)
    # a radial load alone is its own equivalent load
    assert rate.rating(hybrid, 0.0, 300.0, 1.0).equivalent == 300.0
    assert rate.rating(hybrid, 0.0, 0.0, 1.0).life is None


def test_what_has_no_standard_has_no_rating(scene, hybrid):
    assert rate.rating(scene("7009C-full-ceramic"), 350.0, 0.0, 1.0) is None
    assert scene("7009C-full-ceramic").materials.kind == "full ceramic"
    assert hybrid.materials.kind == "hybrid"
    steep = sized(hybrid, contact_angle_deg=40.0)
    found = rate.rating(steep, 500.0, 0.0, 1.0)
    assert rate.speed_limit(steep) is None and found.factors == (1.14, 0.35, 0.57, 0.26)
    # an axial load alone: P = 0.57 Fa, P0 = 0.26 Fa
    assert (found.equivalent, found.static_load) == pytest.approx((285.0, 130.0))
    flat = rate.rating(sized(hybrid, contact_angle_deg=12.0), 500.0, 0.0, 1.0)
    assert flat.life is None and flat.static_load is None and flat.factors is None


def test_kinds_of_the_catalogue(hybrid):
    steel = hybrid.materials.model_copy(update={"balls": hybrid.materials.inner_ring})
    assert steel.kind == "steel"
    for entry in catalogue("bearings").values():
        assert (
            rate.rating(hybrid.model_copy(update={"bearing": Bearing(**entry)}), 100.0, 0.0, 1.0).life > 0.0
        )


def test_makers_limits(hybrid):
    assert rate.speed_limit(hybrid) == 1.25 * 1.75e6
    # C 5958 N, and 5670 N at 25 deg, in three digits
    assert rate.preload_classes(hybrid) == ("GMN", {"light": 29.8, "medium": 89.4, "heavy": 179.0})
    steep = rate.preload_classes(sized(hybrid, contact_angle_deg=25.0))
    assert steep == ("GMN", {"light": 48.2, "medium": 142.0, "heavy": 289.0})
