"""The block of fits in reports: only of scenes with fits, with the figures of the study."""

import pytest

from fmu_bearing import fits, read_scene
from fmu_bearing.design.fit_table import fit_rows, head as head_of, state_rows
from fmu_bearing.reports import make
from fmu_bearing.reports.sections.seats import seats
from tests.conftest import EXAMPLES
from tests.design.test_fits import SHAFT, bearing
from tests.reports.reading import Page, not_run

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


@pytest.mark.heavy
def test_a_set_has_its_seats_bearing_by_bearing():
    fit = {"bearing_class": "P4", "preload": "unmounted", "shaft": {"shaft_class": "js5"}}
    scene = read_scene(DB).replace({"spindle.fit": fit})
    tables, found = {one.caption: one for one in seats(not_run(scene)).blocks}, fits(scene)
    for number in (1, 2):
        words = f"bearing {number}: {found.words(number)}"
        table = tables[f"Fits over their tolerances, {words}; each column is computed in full"]
        assert table.columns == head_of(found) and table.rows == fit_rows(found, number)
        assert tables[f"Fits at mean, {words}"].rows == state_rows(found.column("mean").bearings[number - 1])


@pytest.mark.heavy
def test_a_single_bearing_has_its_seats_at_the_speed_of_the_run(tmp_path):
    scene = bearing(shaft=SHAFT).model_copy(update={"sound": None})
    made = make(
        scene, tmp_path / "one.html", duration=0.02, settle=0.01, speed=10e3 * 3.141592653589793 / 30.0
    )
    assert made.sections["fits"] == ""
    found = fits(scene.replace({"operation.speed_rpm": 10e3}))
    (words,) = [name for name in Page(made.path).tables if name.startswith("Fits over")]
    _, *rows = Page(made.path).tables[words]
    assert rows == fit_rows(found, 1)
