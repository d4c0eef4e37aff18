"""Springs between inner ring and ground: where the rings rest, in all fidelities."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import Q, S, U, Y
from tests.engine.condensed import FIDELITIES
from tests.engine.helpers import SUPPORTED, Run

STIFFNESS = np.array(SUPPORTED["SUPPORT_STIFFNESS"])
LOADS = np.array([500.0, 60.0, -90.0])
PRELOAD = 450.0  # N: before it rises to that of LOADS


@pytest.fixture
def started(scene):
    """Start a perfect bearing under loads (N) on a pedestal whose two stiffnesses are at an angle."""
    given = scene("7003C-spindle").replace(
        {
            "imperfections": None, "mounting.pedestal_stiffness_N_m": 5e7,
            "mounting.pedestal_stiffness_ratio": 0.4, "mounting.pedestal_axis_angle_deg": 30.0,
        }
    )  # fmt: skip

    def start(loads, stiffness=STIFFNESS, **parameters):
        held = SUPPORTED | {"SUPPORT_STIFFNESS": stiffness}
        run = Run(given, 20e3, **held, **parameters)
        run.u[[U.PRELOAD, U.LOAD_Y, U.LOAD_Z]] = loads
        return run.init()

    return start


def places(run):
    """Of both rings, m and rad."""
    return run.s[S.Y + Y.Q0 : S.Y + Y.Q0 + Q.CAGE].copy()


@pytest.mark.parametrize("fidelity", [0.0, *FIDELITIES.values()], ids=["full", *FIDELITIES])
def test_a_spring_is_a_load(started, fidelity):
    """The rings rest where the same bearing rests under what its springs leave of the loads."""
    found = places(started(LOADS, FIDELITY=fidelity))
    carried = (STIFFNESS * found[: Q.OUTER])[:3]
    # much of each: 117, 21 and -40 N
    assert (abs(carried) > 0.2 * abs(LOADS)).all()
    alone = started(LOADS - carried, STIFFNESS * [0, 0, 0, 1, 1], FIDELITY=fidelity)
    # a search leaves 1e-10 of the forces out of balance: 6e-8 N moves a ring on 2e7 N/m by 3e-15 m; rings and
    # response hold the friction that twists the outer ring at a load found to 1e-9
    assert places(alone) == pytest.approx(found, rel=1e-7 if fidelity == 0.0 else 3e-6, abs=1e-16)


@pytest.mark.parametrize("fidelity", FIDELITIES.values(), ids=FIDELITIES)
def test_springs_follow_the_preload(started, fidelity):
    """In fidelities that hold a rest and find it again: as they would start there, without a cage."""
    run = started([PRELOAD, *LOADS[1:]], FIDELITY=fidelity, CAGE=0.0)
    before = places(run)
    run.u[U.PRELOAD] = LOADS[0]
    run.run(0.1, 1e-3)
    wanted = places(started(LOADS, FIDELITY=fidelity, CAGE=0.0))
    # what the step has set moving has died away
    assert places(run)[:3] == pytest.approx(wanted[:3], abs=1e-3 * abs(wanted - before)[:3].max())
