"""The identified scene as a file: values that the catalogue gave get a line of their own."""

import numpy as np
import pytest

from fmu_bearing.identification.files import identified_toml
from fmu_bearing.identification.free import free_numbers
from fmu_bearing.identification.result import Estimate, Identified
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.template import new_scene

TEXT = new_scene("catalogued", "7003C")


def found_in(text, values, free=None):
    """Result of a search that found values by key; ``free``: the keys as they were asked for."""
    scene = read_scene_text(text)
    free = free_numbers(scene, list(free or values))
    estimates = tuple(Estimate(one, values[one.key], 0.1, True) for one in free)
    none = np.zeros((0, 0))
    return Identified(
        scene, scene, estimates, (), none, np.eye(len(free)), none, none, 1.0, (), "response", (1,),
        values=dict(values),
    )  # fmt: skip


def test_values_of_the_catalogue_are_written_beside_its_name():
    values = {"bearing.contact_damping_us": 2.5, "bearing.cage.pocket_friction": 0.06}
    made = identified_toml(found_in(TEXT, values), TEXT)
    scene = read_scene_text(made)
    assert scene.bearing.contact_damping_us == 2.5
    assert scene.bearing.cage.pocket_friction == 0.06
    assert scene.bearing.cage.pocket_diameter_mm == read_scene_text(TEXT).bearing.cage.pocket_diameter_mm
    assert "contact_damping_us = 2.5 # identified: " in made


def test_a_material_that_is_a_name_keeps_its_other_values():
    made = identified_toml(found_in(TEXT, {"materials.balls.density_kg_m3": 3300.0}), TEXT)
    before, after = read_scene_text(TEXT).materials.balls, read_scene_text(made).materials.balls
    assert after.density_kg_m3 == 3300.0
    assert after.youngs_modulus_GPa == before.youngs_modulus_GPa


def test_members_of_lists_have_their_places():
    made = identified_toml(found_in(TEXT, {"sound.microphone[1].y_mm": 123.0}), TEXT)
    assert read_scene_text(made).sound.microphone[0].y_mm == 123.0


def test_without_a_file_the_whole_scene_is_written():
    made = identified_toml(found_in(TEXT, {"imperfections.unbalance_um": 1.25}))
    assert read_scene_text(made).imperfections.unbalance_um == pytest.approx(1.25)
