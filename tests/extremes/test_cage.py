"""A lubricated cage forgets how it began; a dry one does not, but keeps its statistics."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import Q, S, Y
from tests.extremes.bearings import RINGS, SILENT, bearing, drive
from tests.extremes.cases import DRY, FULL, SLACK

CAGE = [f"cage.velocity.{axis}" for axis in "xyz"]


def pair(changes, fidelity, method, push, rpm=2e4):
    """Two bearings, equal but for the cage's first velocity, m/s."""
    runs = []
    for given in (0.0, push):
        run = bearing("7003C-spindle", SILENT | changes, {"rpm": rpm}, fidelity, method)
        run.initialise()
        run.s[S.Y + Y.V0 + Q.CAGE + 1] += given
        runs.append(run)
    return runs


@pytest.mark.parametrize(("fidelity", "method"), FULL)
def test_a_lubricated_cage_is_contractive(fidelity, method):
    one, other = pair({}, fidelity, method, 1e-3)
    first = drive(one, 2e-3, 1e-4), drive(other, 2e-3, 1e-4)
    drive(one, 0.05, 1e-3), drive(other, 0.05, 1e-3)
    last = drive(one, 2e-3, 1e-4), drive(other, 2e-3, 1e-4)
    apart = [np.abs(a.columns(CAGE) - b.columns(CAGE)).max() for a, b in (first, last)]
    assert apart[0] > 1e-5
    # land and pocket films take the push away; what is left are the solver's errors, 1e-3 of the rings' rms
    assert apart[1] < 0.2 * apart[0]
    rings = [trace.columns(RINGS) for trace in last]
    assert np.abs(rings[0] - rings[1]).max() <= 1e-2 * SLACK.get(method, 1.0) * rings[0].std(0).max()


@pytest.mark.heavy
@pytest.mark.parametrize(("fidelity", "method"), FULL)
def test_a_dry_cage_keeps_its_statistics(fidelity, method):
    """Trajectories part, so only means and rms over 0.2 s are compared, two starts of the same bearing."""
    runs = pair(DRY, fidelity, method, 1e-3)
    found = []
    for run in runs:
        drive(run, 0.05, 1e-3)
        found.append(drive(run, 0.2, 1e-4))
    a, b = found
    assert np.isfinite(a.rows).all() and np.isfinite(b.rows).all()
    # rings: half a dozen modes with some hundred periods each, a few per cent of scatter
    np.testing.assert_allclose(a.columns(RINGS).std(0), b.columns(RINGS).std(0), rtol=0.15)
    assert a.column("contact.inner.load_mean").mean() == pytest.approx(
        b.column("contact.inner.load_mean").mean(), rel=5e-3
    )
    assert a.column("cage.speed_ratio").mean() == pytest.approx(b.column("cage.speed_ratio").mean(), rel=5e-3)
    # it rattles within its clearances, 0.05 mm in the pockets and 0.04 mm on the lands
    for trace in found:
        assert trace.column("cage.whirl_radius").max() < 1e-4
        assert np.abs(trace.columns(CAGE)).max() < 5.0
