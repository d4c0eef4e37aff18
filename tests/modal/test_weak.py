"""Where levels of fidelities rings and response are in doubt, and who says so."""

import pytest

from fmu_bearing import modes, read_scene
from fmu_bearing.modal.campbell import doubts
from fmu_bearing.modal.campbell.doubts import LEAST, doubt, reason_for_doubt
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import EXAMPLES
from tests.marks import heavy_but


def at(name, rpm):
    scene = read_scene(EXAMPLES / f"{name}.toml")
    return scene.replace({"operation.speed_rpm": float(rpm)}).with_rigid_rings()


# levels of rings and response are 18, 15 and 6 dB(A) off there
@pytest.mark.parametrize(
    ("name", "rpm", "mode"),
    heavy_but(
        [("7003C-impact", 8000, "inner tilt"), ("7003C-impact", 22000, "inner tilt"),
         ("7009C-steel", 11000, "inner tilt")],
        0,
    ),
)  # fmt: skip
def test_a_dry_or_steel_bearing_is_named(name, rpm, mode):
    scene = at(name, rpm)
    for fidelity in ("rings", "response"):
        text = doubt(with_fidelity(scene, model=fidelity))
        assert text.startswith("levels ") and f" of fidelity {fidelity} are in doubt here: " in text
        assert f"the rings' mode '{mode}" in text and text.endswith("take fidelity full")
    assert doubt(with_fidelity(scene, model="full")) == ""
    assert min(found.damping for found in modes(scene).modes if found.name == mode) < LEAST


@pytest.mark.heavy
@pytest.mark.parametrize(("name", "rpm"), [("7003C-spindle", 20000), ("7003C-bare", 20000)])
def test_well_damped_bearings_are_not(name, rpm):
    """Their levels agree with levels of full within 0.3 dB(A), docs/results/scenes.md."""
    assert reason_for_doubt(at(name, rpm)) == ""


@pytest.mark.heavy
def test_a_line_on_a_narrow_mode_counts(monkeypatch):
    """With a wider bound f_i - f_r lies within the peak of the spindle's radial mode (damping ratio 0.02)."""
    monkeypatch.setattr(doubts, "NARROW", 0.02)
    scene = at("7003C-spindle", 20000)
    assert "'inner radial backward'" in reason_for_doubt(scene)
    assert reason_for_doubt(scene).endswith("and f_i - f_r of inner race lies within its peak)")
    assert reason_for_doubt(scene.replace({"imperfections": None})) == ""
    assert reason_for_doubt(scene.replace({"operation.speed_rpm": 22000.0})) == ""
