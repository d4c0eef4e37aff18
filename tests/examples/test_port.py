"""A rotor of another model on the port: limits and damping of the couplings against the shaft inside."""

import re
import sys

import numpy as np
import pytest

from tests.examples.conftest import ROOT

FOLDER = ROOT / "examples" / "port"


@pytest.fixture(scope="module")
def limits():
    sys.path.insert(0, str(FOLDER))
    import limits

    yield limits
    sys.path.remove(str(FOLDER))


@pytest.fixture(scope="module")
def outcome(limits):
    truth, found = limits.study((1e-5, 3e-5))
    return truth, {(name, scheme, h): text for name, scheme, h, text in found}


@pytest.mark.heavy
def test_no_coupling_is_stable_by_damping_of_its_own(outcome):
    (frequency, ratio), found = outcome
    for scheme in ("extrapolated", "derivative", "rollback"):
        hertz, damping = found["rigid", scheme, 1e-5].split(" Hz, ")
        # w H = 0.34: the page's figures are within 5 % of the ratio inside, (w H)^2 / 12 of the frequency
        assert float(damping) == pytest.approx(ratio, rel=0.08), scheme
        assert float(hertz) == pytest.approx(frequency, rel=0.03), scheme


@pytest.mark.heavy
def test_page_has_what_the_example_prints(outcome):
    """Frequencies within 2 Hz, ratios within 5e-4: processors round a fit of a few periods differently."""
    (frequency, ratio), found = outcome
    page = (ROOT / "docs" / "coupling.md").read_text("utf-8")
    inside = re.search(r"inside \(`\[spindle.shaft\]`\) they are (\d+) Hz\s+and ([\d.]+)\.", page)
    assert float(inside[1]) == pytest.approx(frequency, abs=2.0)
    assert float(inside[2]) == pytest.approx(ratio, abs=5e-4)
    for h in (1e-5, 3e-5):
        (line,) = re.findall(rf"^\| {1e6 * h:.0f} \| ((?:[^|]+ \| ){{3}}[^|]+) \|$", page, re.MULTILINE)
        phase, *cells = line.split(" | ")
        assert float(phase) == pytest.approx(2.0 * np.pi * frequency * h, abs=0.006)
        for cell, scheme in zip(cells, ("extrapolated", "derivative", "rollback"), strict=True):
            shown, printed = (text.split(" Hz, ") for text in (cell, found["rigid", scheme, h]))
            if len(printed) == 1:
                assert shown == printed, scheme
            else:
                assert float(shown[0]) == pytest.approx(float(printed[0]), abs=2.0), scheme
                assert float(shown[1]) == pytest.approx(float(printed[1]), abs=5e-4), scheme


@pytest.mark.heavy
def test_extrapolation_has_its_limit_and_the_others_none(outcome):
    _, found = outcome
    for rotor in ("rigid", "bending"):
        assert found[rotor, "extrapolated", 3e-5] == "runs away"
        assert found[rotor, "derivative", 3e-5] == found[rotor, "rollback", 3e-5] == "decays"


@pytest.mark.heavy
def test_rest_is_that_of_the_shaft_inside(limits):
    import couple
    from rotor import PORT

    from fmu_bearing.instance import Instance
    from fmu_bearing.prepare.model import prepare
    from fmu_bearing.scene import read_scene

    scene = read_scene(couple.SCENE).replace({"fidelity.model": "full"})
    bearings = couple.Bearings(scene)
    bearings.start(np.zeros(PORT))
    place = couple.rest(bearings, limits.rotors(scene, bearings)["rigid"])
    own = Instance(prepare(limits.with_shaft(scene)))
    own.initialise()
    inside = [own.get(f"shaft.nose.displacement.{axis}") for axis in "xyz"]
    # the force is that of turning balls, with their friction: parts in 1e4 of the 500 N of preload
    assert place[:3] == pytest.approx(inside, rel=1e-2, abs=1e-10)
