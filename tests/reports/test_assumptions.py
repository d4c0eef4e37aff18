"""The table of assumed values: what a maker prints stays out of it, what is derived is in it."""

from fmu_bearing.reports.sections.assumptions import assumed_table
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.template import new_scene


def test_derived_balls_of_a_makers_size_count_as_assumed(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(new_scene("a", "NSK-7008C", kind="hybrid", sound=False, preload_class="light"), "utf-8")
    rows = {row[0]: row for row in assumed_table(read_scene(path), origins(path)).rows}
    assert rows["bearing.ball_count"][-1] == "derived from C, C0 and f0 (NSK) by ISO 281 and ISO 76"
    assert "derived from the mass (NSK)" in rows["bearing.inner_ring_outer_diameter_mm"][-1]
    assert not {"bearing.bore_mm", "bearing.contact_angle_deg", "mounting.preload_N"} & set(rows)
