"""Receptance coupling of a tool against finite elements of shaft and tool in one, and closed forms."""

import math

import numpy as np
import pytest

from fmu_bearing import read_scene, receptance
from fmu_bearing.modal.receptance.tool import fixed_at, free_tool, tool_sections
from fmu_bearing.scene import SceneError
from tests.conftest import EXAMPLES

QBC = EXAMPLES.parent / "spindle_set" / "7003C-QBC.toml"
TOOL = [[20.0, 12.0, 0.0], [25.0, 14.0, 0.0], [30.0, 25.0, 4.0]]
STEEL = {
    "youngs_modulus_GPa": 208.0, "poisson_ratio": 0.3, "density_kg_m3": 7800.0, "expansion_1e6_K": 11.8,
}  # fmt: skip


def with_tool(scene, sections=TOOL, damping=0.0, **keys):
    tool = {"sections_mm": sections, "material": STEEL, "damping_ratio": damping} | keys
    return scene.replace({"tool": tool})


def spindle(**keys):
    """The example's spindle at full speed; no damping of its shaft, which is in proportion to stiffness."""
    shaft = {"spindle.shaft.damping_ratio": 0.0, "spindle.shaft.unbalance": [], "spindle.load": {}}
    return read_scene(QBC).replace(shaft | {"fidelity.terms.gravity": False} | keys)


@pytest.mark.parametrize("modes", [2, pytest.param(8, marks=pytest.mark.heavy)])
def test_coupled_tool_is_that_of_finite_elements_of_shaft_and_tool_in_one(modes):
    """Within 0.5 % over all frequencies, cross terms and gyroscopic effect included.

    The shaft with the tool as its first sections has eight modes between nose and bearings, its tip being the
    nose. The coupled one keeps those of its own shaft.
    """
    hertz = np.linspace(20.0, 4000.0, 400)
    own = spindle(**{"spindle.shaft.fixed_modes": modes})
    found = receptance(with_tool(own), hertz, at="tip").G[0, 0]
    length = sum(row[0] for row in TOOL)
    sections = [*TOOL, *(list(row) for row in own.spindle.shaft.sections_mm)]
    moved = {
        f"spindle.bearing[{k}].position_mm": one.position_mm + length
        for k, one in enumerate(own.spindle.bearing, start=1)
    }
    whole = own.replace({"spindle.shaft.sections_mm": sections, "spindle.shaft.fixed_modes": 8} | moved)
    wanted = receptance(whole, hertz).G[0, 0]
    assert np.abs(found[:, 1, 1]).max() > 30.0 * np.abs(
        found[0, 1, 1]
    )  # a peak of hardly any damping is in it
    for i, k in ((0, 0), (1, 1), (2, 2), (1, 2), (4, 4), (1, 4)):
        assert np.abs(found[:, i, k] - wanted[:, i, k]).max() < 5e-3 * np.abs(wanted[:, i, k]).max(), (i, k)


def test_a_free_beam_has_the_frequencies_of_closed_form():
    """cos x cosh x = 1: 4.7300 and 7.8532, of a slender rod; shear and its turning take some 0.1 %."""
    length, radius, modulus, density = 0.4, 2e-3, 208e9, 7800.0
    sections = tool_sections(with_tool(read_scene(QBC), [[400.0, 4.0, 0.0]]))
    unit = math.sqrt(modulus * radius**2 / (4.0 * density)) / (2.0 * math.pi * length**2)
    for root in (4.730041, 7.853205):
        near = root**2 * unit * np.linspace(0.99, 1.01, 2001)
        peak = near[np.abs(free_tool(sections, 1e-5, near, 0.0)[:, 1, 1]).argmax()]
        assert peak == pytest.approx(root**2 * unit, rel=2e-3)


def test_at_low_frequency_the_tip_is_nose_and_cantilever_in_series():
    """Static: compliance of the nose, its tilt times the overhang, and L^3 / 3 E I with shear."""
    length, radius = 0.06, 6e-3
    scene = with_tool(read_scene(QBC), [[60.0, 12.0, 0.0]])
    nose, tip = (receptance(scene, [5.0], at=at).G[0, 0, 0].real for at in ("nose", "tip"))
    area, moment = math.pi * radius**2, math.pi * radius**4 / 4.0
    shear = 6.0 * 1.3 / (7.0 + 6.0 * 0.3)  # Cowper, solid round
    own = length**3 / (3.0 * 208e9 * moment) + length / (shear * 80e9 * area)
    # the nose moves by its own and, ahead of it, by its tilt about z: y at -L
    across = nose[1, 1] - length * (nose[1, 4] + nose[4, 1]) + length**2 * nose[4, 4]
    assert tip[1, 1] == pytest.approx(across + own, rel=1e-3)


def test_a_rigid_stub_only_moves_the_place():
    """5 mm of a bar of 40 mm: as the nose 5 mm ahead, with its mass of 49 g."""
    scene = with_tool(read_scene(QBC), [[5.0, 40.0, 0.0]])
    nose, tip = (receptance(scene, [20.0], at=at).G[0, 0, 0] for at in ("nose", "tip"))
    ahead = nose[2, 2] + 0.005 * (nose[2, 3] + nose[3, 2]) + 0.005**2 * nose[3, 3]
    assert tip[2, 2] == pytest.approx(ahead, rel=2e-3)


def test_holder_and_tool_have_their_own_materials():
    holder = {"sections_mm": [[30.0, 25.0, 4.0]], "material": STEEL}
    parts = with_tool(read_scene(QBC), TOOL[:2], holder=holder)
    one = with_tool(read_scene(QBC))
    assert tool_sections(parts) == tool_sections(one)
    carbide = parts.replace({"tool.material": "tungsten-carbide"})
    soft, stiff = (receptance(scene, [20.0], at="tip").peaks()[1].stiffness for scene in (parts, carbide))
    assert stiff > 1.05 * soft
    assert [section.density for section in tool_sections(carbide)] == [14400.0, 14400.0, 7800.0]


def test_where_it_is_fixed():
    assert fixed_at(with_tool(read_scene(QBC))) == 0.0
    single = read_scene(EXAMPLES / "7003C-spindle.toml")
    assert fixed_at(with_tool(single)) == pytest.approx(-0.5e-3 * single.mounting.rotor.length_mm)
    assert fixed_at(with_tool(read_scene(EXAMPLES / "7003C-bare.toml"))) == 0.0
    assert fixed_at(with_tool(single, position_mm=-20.0)) == pytest.approx(-0.02)


def test_what_a_scene_refuses():
    with pytest.raises(
        SceneError, match=r"tool\.sections_mm: section 1 has a bore of 12 mm in a diameter of 12"
    ):
        with_tool(read_scene(QBC), [[20.0, 12.0, 12.0]])
    with pytest.raises(SceneError, match=r"tool\.material = 'carbide' is not in the catalogue"):
        read_scene(QBC).replace({"tool": {"sections_mm": TOOL, "material": "carbide"}})
    with pytest.raises(SceneError, match=r"milling\.teeth"):
        read_scene(QBC).replace(
            {"milling": {"teeth": 0, "cutting_coefficient_N_mm2": 1e3, "radial_immersion": 1}}
        )
