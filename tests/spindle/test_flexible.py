"""Sets on a shaft that bends: the design study's figures, the rigid limit, loads anywhere."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from fmu_bearing import statics
from fmu_bearing.elastic.shaft import shaft_model
from fmu_bearing.elastic.shaft.flexible import flexible_model
from fmu_bearing.elastic.shaft.sections import shaft_sections
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.prepare.bodies import inner_ring
from fmu_bearing.scene import Scene
from tests.spindle.rest import assembly, rest
from tests.spindle.sets import scene, tables

QBC = ("++--", (40.0, 55.0, 140.0, 155.0))
STUDY = [[30.0, 22.0, 0.0], [140.0, 17.0, 0.0], [60.0, 16.0, 0.0]]


def spindle(*args, flexible=True, **keys):
    return scene(*(args or QBC), shaft={"sections_mm": STUDY, "flexible": flexible}, **keys)


def first_frequency(one):
    """Lowest frequency across (Hz) of the shaft without rings on the bearings as they rest."""
    found, model = statics(one, force=(0, 0, 0)), shaft_model(one, one.spindle)
    stiffness = model.stiffness.copy()
    for bearing, plane in zip(found.bearings, model.planes, strict=True):
        own = np.array([bearing.sign, 1.0, 1.0, bearing.sign, bearing.sign])[:, None] * plane
        stiffness += own.T @ bearing.stiffness @ own
    squared = eigh(stiffness[1:, 1:], model.mass[1:, 1:], eigvals_only=True)[0]
    return np.sqrt(squared) / (2.0 * np.pi)


def test_the_study_figures():
    """A rigid shaft's nose is 11 times too stiff: 159 and 14.5 N/um."""
    rigid, soft = (statics(spindle(flexible=one), force=(0, 0, 0)) for one in (False, True))
    assert 1e-6 * rigid.nose_stiffness == pytest.approx(159.0, abs=0.5)
    assert 1e-6 * soft.nose_stiffness == pytest.approx(14.5, abs=0.05)
    assert soft.nose_stiffness_bending == pytest.approx(soft.nose_stiffness, rel=1e-12)
    # same bearings at the same places: without load both shafts are straight
    assert rigid.nose_stiffness_bending == pytest.approx(soft.nose_stiffness, rel=1e-6)
    (words,) = rigid.cautions()
    assert "159 N/um" in words and "14.5 N/um" in words
    assert soft.cautions() == []


def test_the_study_frequencies():
    rigid, soft = (first_frequency(spindle(flexible=one)) for one in (False, True))
    assert rigid == pytest.approx(4934.0, abs=1.0)
    assert soft == pytest.approx(1434.0, abs=1.0)


def test_a_very_stiff_shaft_is_the_rigid_one():
    """What bending adds falls with Young's modulus: twice the answer at 2 E less that at E leaves it out."""
    rigid = assembly(spindle(flexible=False), 0.0)
    given = np.array([200.0, 50.0, -300.0, 0.0, 0.0])
    expected = rest(rigid, rigid.shaft.at(-0.02).T @ given)

    def stiffer(times):
        sections = [
            replace(one, youngs_modulus=times * one.youngs_modulus)
            for one in shaft_sections(rigid.scene, rigid.scene.spindle.shaft)
        ]
        model = flexible_model(sections, [one.position for one in rigid.members])
        found = rest(replace(rigid, shaft=model), model.at(-0.02).T @ given)
        return found.shaft[:5], np.array([one.force for one in found.held])

    (nose, forces), (nose_2, forces_2) = stiffer(1e5), stiffer(2e5)
    # bending adds 7e-4 at 1e5 times Young's modulus; its square is left
    np.testing.assert_allclose(2.0 * nose_2 - nose, expected.shaft, rtol=1e-6, atol=1e-13)
    wanted = np.array([one.force for one in expected.held])
    np.testing.assert_allclose(2.0 * forces_2 - forces, wanted, rtol=1e-6, atol=1e-5)


@pytest.mark.parametrize("at", [-0.02, 0.0, 0.055, 0.1, 0.23])
def test_loads_anywhere_are_in_balance(at):
    """The bearings carry force and moment of the load, wherever on the shaft it acts."""
    found = statics(spindle(), force=(100.0, 40.0, -300.0), at=at)
    carried = sum(one.force for one in found.bearings)
    # across, balls that creep at the start have up to 0.06 N of traction beside a preload of 500 N
    np.testing.assert_allclose(carried, (100.0, 40.0, -300.0), rtol=0.0, atol=0.1)
    tilting = sum(one.moment[0] - one.position * one.force[2] for one in found.bearings)
    assert tilting == pytest.approx(300.0 * at, abs=0.1 * 0.155)
    np.testing.assert_allclose(found.load[3:], (300.0 * at, 40.0 * at), atol=1e-12)


def test_reciprocity_of_nose_and_middle():
    """Betti: a small force in the middle moves the nose as one at the nose moves the middle."""
    one = assembly(spindle(), 0.0)
    model, force = one.shaft, np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    still = rest(one, np.zeros(model.count)).shaft
    nose, middle = (model.at(place) for place in (0.0, 0.1))
    by_middle = nose[2] @ (rest(one, middle.T @ force).shaft - still)
    by_nose = middle[2] @ (rest(one, nose.T @ force).shaft - still)
    # 1 N on 500 N of preload: stiffness changes by its square
    assert by_middle == pytest.approx(by_nose, rel=1e-4)


def test_springs_and_weight_with_a_shaft_that_bends():
    data = tables("+-", (40.0, 155.0), bearings=[{}, {"seat": "sliding"}])
    data["spindle"]["shaft"] = {"sections_mm": STUDY, "flexible": True}
    data["spindle"]["preload"] = {"kind": "spring", "force_N": 300.0, "stiffness_N_m": 1e6}
    data["fidelity"]["terms"]["gravity"] = True
    one = Scene.from_dict(data)
    found = statics(one, force=(0, 0, 0))
    ring, model = inner_ring(one).mass, shaft_model(one, one.spindle)
    weight = GRAVITY * (model.mass[0, 0] + 2.0 * ring)
    # balls that creep at the start have 0.009 N of traction beside a preload of 300 N
    assert sum(b.force[2] for b in found.bearings) == pytest.approx(-weight, abs=0.02)
    assert found.load[2] == pytest.approx(-weight, rel=1e-9)
    np.testing.assert_allclose([b.axial for b in found.bearings], 300.0, rtol=1e-2)
