"""A short, stiff shaft, whose own modes lie far above the rings': fidelity rings damps them as full does."""

import numpy as np
import pytest

from fmu_bearing import modes, record, with_fidelity
from fmu_bearing.design.fresh import new_scene
from fmu_bearing.modal.equations.quick import operator_matrix
from fmu_bearing.scene import read_scene_text
from tests.engine.condensed import FIDELITIES
from tests.engine.test_condensed_modes import poles_of, weightless
from tests.spindle.runs import SetRun
from tests.spindle.test_dynamics_oracle import NO_CAGE

RPM = 18e3  # from 13,500 r/min on balls turned one whirl's damping negative


@pytest.fixture(scope="module")
def stiff():
    """A fresh pair on the shaft that is assumed for it: its first bending mode is at 19 kHz."""
    return read_scene_text(
        new_scene(
            "stiff", "NSK-7010C", kind="hybrid", speed_rpm=RPM, arrangement="DB", preload_class="medium"
        )
    )


def test_no_mode_of_the_shaft_grows(stiff):
    """The operator of rings and response has the modes of shaft and rings that full has, at 19 kHz too."""
    run = SetRun(weightless(stiff), FIDELITY=FIDELITIES["rings"], CAGE=0.0).init()
    found = poles_of(operator_matrix(run))
    found = found[found.imag > 2.0 * np.pi * 300.0]
    assert found.real.max() < -300.0
    near = []
    for mode in modes(weightless(stiff)).modes:
        if 300.0 < mode.frequency < 25e3 and mode.label.startswith("shaft"):
            at = mode.frequency * 2j * np.pi - mode.damping * mode.frequency * 2.0 * np.pi
            near.append(np.abs(found - at).min() / abs(at))
    assert len(near) >= 7
    # a frequency counts as the imaginary part, the ratio as that to the modulus: second order in the damping
    assert max(near) < 0.02


@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [13.5e3, RPM])
def test_levels_are_those_of_full(stiff, rpm):
    """Without cages, whose rattle rings leave out."""
    given = stiff.replace(NO_CAGE | {"operation.speed_rpm": rpm})
    levels = []
    for fidelity in ("full", "rings"):
        made = record(with_fidelity(given, model=fidelity), 0.2, settle=0.05, warn=False, progress=False)
        assert made.doubts["solver.restarts"] == 0
        levels.append(made.levels(weighting="A"))
    # measured 0.2 dB(A) at 13,500 r/min and 0.6 at 18,000; where it diverges 70 and more
    assert np.abs(levels[0] - levels[1]).max() < 1.0
