"""The operating point against runs of fidelity full that start from the quasi-static state.

Torque within 3 % and the mean orbit of the balls (the cage's speed over the shaft's) within 0.2 % of what
full has settled at after 0.6 s, wherever no mode of the ring grows (with more than 5 1/s, without cage).
Cases that miss these gates carry their own, with the measured figure and the reason.
"""

import numpy as np
import pytest

from fmu_bearing.engine.layout import P, U, Y
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.mounting import TiltSupport
from tests.conftest import ROOT
from tests.engine.test_steady_point import SUPPORT, balls, lost, started, torque
from tests.spindle.runs import SetRun

pytestmark = pytest.mark.heavy

TORQUE, ORBIT = 0.03, 2e-3
SETTLING, MEAN = 0.6, 0.15  # s
WIDE = TiltSupport(stiffness_N_m_rad=5e4, damping_ratio=0.05)  # of the 7014C
NO_FIDELITY = -1.0


def from_quasistatic_state(*args, **kwargs):
    """Bearing in the quasi-static state with balanced spins: that of a start which no fidelity settles."""
    return started(*args, parameters={"FIDELITY": NO_FIDELITY}, **kwargs).with_parameters(FIDELITY=0.0)


def settled(run, seconds=SETTLING):
    """Mean torque (N mm) and mean orbit over shaft speed of a run once it has settled."""
    run.run(seconds, 1e-3)
    mean = lost(run, MEAN)
    orbits = []
    for _ in range(50):
        run.step(1e-3)
        orbits.append(balls(run, Y.OM).mean())
    return mean, np.mean(orbits) / run.u[U.SPEED]


def agree(bearing, rpm, preload, load=0.0, support=None, gate=TORQUE):
    measured, orbit = settled(from_quasistatic_state(bearing, rpm, preload, load, support=support))
    point = started(bearing, rpm, preload, load, support=support)
    assert torque(point) == pytest.approx(measured, rel=gate)
    assert balls(point, Y.OM).mean() / point.u[U.SPEED] == pytest.approx(orbit, rel=ORBIT)


def rows():
    """Bearing, speed, preload, support: all with a tilt support, bare where the ring stays quiet."""
    for bearing, growing in (
        ("NSK-7008AC", {(20000, 150), (20000, 400)}),
        ("NSK-7010C", {(20000, 150), (20000, 400)}),
    ):
        for rpm in (8000, 20000):
            for preload in (150, 400, 800):
                if (rpm, preload) not in growing:
                    yield bearing, rpm, preload, None
                # the ring of this one whirls on its support too: see `test_two_steady_motions`
                if (bearing, rpm, preload) != ("NSK-7008AC", 20000, 150):
                    yield bearing, rpm, preload, SUPPORT
    # bare at 300 N its ring whirls: + 95 1/s
    yield "NSK-7014C", 12000, 300, WIDE
    yield "NSK-7014C", 12000, 900, None
    yield "NSK-7014C", 12000, 900, WIDE


@pytest.mark.parametrize(("bearing", "rpm", "preload", "support"), list(rows()))
def test_under_preload_and_weight(bearing, rpm, preload, support):
    agree(bearing, rpm, preload, support=support)


@pytest.mark.parametrize(
    ("bearing", "support"), [("NSK-7008AC", SUPPORT), ("NSK-7010C", SUPPORT), ("NSK-7010C", None)]
)
@pytest.mark.parametrize("share", [0.1, 0.5])
def test_under_radial_load(bearing, support, share):
    agree(bearing, 20000, 400, share * 400, support)


@pytest.mark.parametrize(
    ("load", "gate"),
    [
        (4.0, TORQUE),
        # 6.9 % too high: the point's whirl knows no load, full's goes round an orbit that 7 N make narrower
        (7.0, 0.08),
        (10.0, TORQUE),
        (15.0, TORQUE),
    ],
)
def test_between_whirl_and_rest(load, gate):
    """The cage rests where its whirl decays: in full from 10 N across on, at 7 N it whirls."""
    agree("NSK-7008AC", 20000, 400, load, SUPPORT, gate)


# seed 20 of NumPy's default generator: a size of NSK's with classes, a class, 0.3 to 1.0 of the oil speed
# limit, on the tilt support that a new scene assumes. Draw 13, the 7913C, was left out while models had at
# most 24 balls; the last rows are the sizes with 25, at half the oil speed limit. Draw 2 has two steady
# motions, see `test_two_steady_motions`.
DRAWN = [
    ("NSK-7907C", 13600, 150, 6.08e4),
    ("NSK-7901C", 96400, 15, 9.72e3),
    ("NSK-7012AC", 11900, 1570, 1.8e5),
    ("NSK-7001AC", 36700, 100, 1.2e4),
    ("NSK-7006C", 14500, 78, 5.42e4),
    ("NSK-7906C", 39400, 49, 4.45e4),
    ("NSK-7011C", 7300, 980, 1.58e5),
    ("NSK-7008C", 11800, 120, 8.75e4),
    ("NSK-7906AC", 28600, 150, 4.45e4),
    ("NSK-7012C", 8900, 540, 1.8e5),
    ("NSK-7912C", 12300, 290, 1.58e5),
    ("NSK-7006C", 14800, 390, 5.42e4),
    ("NSK-7907AC", 18900, 100, 6.08e4),
    ("NSK-7907C", 28400, 69, 6.08e4),
    ("NSK-7009AC", 19800, 980, 1.08e5),
    ("NSK-7004AC", 20500, 390, 2.88e4),
    ("NSK-7900C", 51700, 59, 7.68e3),
    # its ring's mode at 1353 Hz grows with 69 1/s; the whirl of the cage holds it down
    ("NSK-7011AC", 12900, 340, 1.58e5),
    ("NSK-7913C", 11300, 340, 1.8e5),
    ("NSK-7913AC", 9700, 490, 1.8e5),
]


@pytest.mark.parametrize(("bearing", "rpm", "preload", "stiffness"), DRAWN)
def test_bearings_drawn_at_random(bearing, rpm, preload, stiffness):
    agree(bearing, rpm, preload, support=TiltSupport(stiffness_N_m_rad=stiffness, damping_ratio=0.05))


@pytest.mark.parametrize(
    ("case", "stiffness", "gate", "orbit_gate"),
    [
        # a mode at 1308 Hz grows with 203 1/s: from the quasi-static state full settles at 180.2 N mm with a
        # ring that whirls, 9.2 % less than the point
        (("NSK-7011AC", 13800, 340), 1.58e5, 0.14, 2.5e-3),
        # one at 1401 Hz grows with 417 1/s: 93.2 N mm, where the point has 107.3, and cages 0.61 % apart
        (("NSK-7008AC", 20000, 150), 2e4, 0.20, 8e-3),
    ],
)
def test_two_steady_motions(case, stiffness, gate, orbit_gate):
    """A motion of balls and ring grows without cage; full that starts at the point, a whirl, stays there.

    `modes` counts what grows among the orbits of the balls, which the cage holds, so nothing names it.
    """
    support = TiltSupport(stiffness_N_m_rad=stiffness, damping_ratio=0.05)
    run = started(*case, support=support)
    first = torque(run)
    orbit = balls(run, Y.OM).mean() / run.u[U.SPEED]
    measured, stays = settled(run)
    assert first == pytest.approx(measured, rel=TORQUE)
    assert orbit == pytest.approx(stays, rel=ORBIT)
    other, moved = settled(from_quasistatic_state(*case, support=support))
    assert first == pytest.approx(other, rel=gate)
    assert orbit == pytest.approx(moved, rel=orbit_gate)


def orbits(run):
    """Mean orbit (rad/s) of the balls of each bearing of a set."""
    counts = [int(run.of(run.p, b, "P")[P.BALLS]) for b in range(run.count)]
    return [run.y(b)[Y.OM : Y.OM + n].mean() for b, n in enumerate(counts)]


@pytest.mark.parametrize("fidelity", range(3))
def test_a_loaded_set(fidelity):
    """The example's pair under 100 N along and 50 N across its nose, in all fidelities against full."""
    given = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml")
    perfect = given.model_copy(update={"imperfections": None, "sound": None})
    run = SetRun(perfect).init()
    first = orbits(run)
    run.run(0.3, 1e-3)
    before = run.heat
    run.run(0.2, 1e-3)
    measured = (run.heat - before) / 0.2
    assert orbits(run) == pytest.approx(first, rel=ORBIT)
    point = SetRun(perfect, FIDELITY=fidelity).init()
    heats = sum(point.value(f"heat.{part}") for part in ("inner_ring", "outer_ring", "oil"))
    assert heats == pytest.approx(measured, rel=TORQUE)
