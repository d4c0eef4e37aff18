"""Identification for the papers' pages: count of free numbers, search for one, values for `identify`."""

import math

import pytest

from examples.papers import case as case_module, impact_noise, multi_source, sound_field
from examples.papers.identification import AMPLITUDE_UM, BOTH, by_bracket, check_count
from examples.papers.page import Output


def test_there_are_never_more_free_numbers_than_fitted_values():
    for module, free in ((multi_source, multi_source.FREE), (sound_field, sound_field.FREE)):
        assert check_count(len(free), module.VALUES)
        with pytest.raises(ValueError, match="free numbers, but"):
            check_count(len(free) + 1, module.VALUES)


@pytest.mark.parametrize("slope", [1.0, 0.5, 2.5])
def test_the_search_for_one_number_ends_at_the_value(slope):
    def level(changes):
        (_, inner), (_, outer) = changes
        assert inner == outer
        return 70.0 + slope * 20.0 * math.log10(inner)

    found = by_bracket(impact_noise.SCENE, (), impact_noise.VALUES, level)
    assert level(found.changes) == pytest.approx(73.96, abs=0.11)  # it ends within 0.1 dB, at four digits
    assert [key for key, _ in found.changes] == list(BOTH)
    ((_, before, after),) = found.left
    assert abs(after) <= 0.11 < abs(before)


def test_the_search_for_one_number_is_bounded_and_says_so():
    found = by_bracket(impact_noise.SCENE, (), impact_noise.VALUES, lambda changes: changes[0][1])
    assert found.numbers[0].after == pytest.approx(AMPLITUDE_UM[1]) and "bound" in found.words


@pytest.mark.parametrize("module", [multi_source, sound_field], ids=lambda module: module.NAME)
def test_measured_values_are_read_by_identify(module, tmp_path):
    from fmu_bearing.identification.data import read_data
    from fmu_bearing.identification.free import free_numbers

    output = Output(tmp_path)
    output.make()
    output.records("measured", module.measured("fit", "check"))
    scene = case_module.changed(module.SCENE, module.CHANGES)
    found = read_data(output.results / "measured.csv", scene)
    wanted = [v for v in module.VALUES if v.role == "fit"]
    assert [row.value for row in found if row.fit] == pytest.approx(
        [round(v.paper.middle, 2) for v in wanted]
    )
    free = free_numbers(scene, dict(module.FREE))
    assert free[0].keys == BOTH  # both races together
