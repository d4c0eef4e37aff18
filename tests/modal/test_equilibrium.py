"""The steady state: what is told where there is none, and that it is the one that runs come to."""

import numpy as np
import pytest

from fmu_bearing import campbell, modes, stiffness
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import P, S, U, Y
from fmu_bearing.modal.equations import linearised as module
from fmu_bearing.modal.equations.equilibrium import settle

RPM = np.pi / 30.0


@pytest.mark.parametrize("name", ["7003C-bare", "7009C-full-ceramic"])
def test_runs_settle_there(gate, name):
    """Orbit and spin of the balls after 50 ms of fidelity full, which forgets its start in some ms."""
    scene = gate(name).replace({"imperfections": None}).with_rigid_rings()
    run, own = (Arrays.of(scene, CAGE=0.0) for _ in range(2))
    for one in (run, own):
        one.u[U.SPEED] = 12_000 * RPM
        one.init()
    start = run.s.copy()
    for _ in range(50):
        run.step(1e-3)
    assert settle([own])
    balls = int(run.p[P.BALLS])
    for row in (Y.X, Y.R, Y.OM, Y.WX, Y.WR):
        reached, found, first = (s[S.Y + row : S.Y + row + balls].mean() for s in (run.s, own.s, start))
        # a hundredth of the way that the run has gone, or rounding
        assert found == pytest.approx(reached, abs=0.01 * abs(reached - first) + 1e-6 * abs(reached)), row


def test_a_bearing_without_steady_state_says_so(gate, monkeypatch):
    monkeypatch.setattr(module, "settle", lambda bearings, tie: False)
    scene = gate("7003C-spindle")
    words = "no steady state was found"
    assert any(words in line for line in modes(scene).cautions())
    found = campbell(scene, [10e3, 15e3, 20e3])
    assert sum(words in line for line in found.cautions()) == 3
    table = stiffness(scene, [20e3], [1e3])
    assert not table.steady.any() and any(words in line for line in table.cautions())
    monkeypatch.undo()
    assert stiffness(scene, [20e3], [1e3]).steady.all()
