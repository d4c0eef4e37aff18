"""Seals in a report's section on friction: their share, its row, and where their heat goes."""

import pytest

from fmu_bearing.reports.data.observed_run import observed
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.sections.friction import friction
from fmu_bearing.scene.read import with_fidelity


@pytest.mark.parametrize(("seal", "shown"), [({"torque_N_mm": 20.0}, True), (None, False)])
def test_share_of_the_seals(scene, seal, shown):
    one = with_fidelity(scene("7003C-bare"), model="rings").replace({"bearing.seal": seal})
    recording, _ = observed(one, 0.02, settle=0.0, radiation_model="compact", progress=False)
    blocks = friction(Subject(recording, "compact")).blocks
    torque, heat = (block for block in blocks if block.sort == "chart")
    assert ("seals" in {trace.name for trace in torque.figure.data}) == shown
    assert ("what seals lose the inner ring" in heat.note) == shown
    (table,) = (block for block in blocks if getattr(block, "caption", "").endswith("over the recording"))
    rows = {row[0]: row[1:] for row in table.rows}
    assert ("seals" in rows) == shown
    if shown:
        assert float(rows["seals"][0]) == pytest.approx(20.0, abs=1e-3)
