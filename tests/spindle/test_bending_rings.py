"""Sets whose rings bend: runs against the oracle of dense systems, a set of one, the scene's refusals."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import FL, Q, S, W, Y, Z
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import pack, prepare
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.member import one_of
from fmu_bearing.scene.mounting import Flexure as Bending, Mounting, Rotor
from tests.engine.flexible import Flexure
from tests.engine.helpers import Run
from tests.marks import heavy_but
from tests.oracles import spindle_dynamics as oracle
from tests.spindle.dynamics import Bearing, bearing_arrays, bearing_of, place_from, spindle_of
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene
from tests.spindle.test_runs import carriers, loaded, offsets

# loose fits: 1e7 N/m moves the outer ring's n = 2 from 6.6 to 7.4 kHz
BENT = {
    "inner_ring": [2], "outer_ring": [2, 3], "damping_ratio": 0.005,
    "inner_seat_stiffness_N_m": 1e7, "outer_seat_stiffness_N_m": 1e7,
}  # fmt: skip
WAVES = {"imperfections": {"grade": "P4", "seed": 1}}


class BendingBearing(Bearing):
    """The engine's kernels of a bearing whose rings have the places ``q`` and rates ``v`` of their modes."""

    def __init__(self, bearing, p):
        self.__dict__.update(bearing.__dict__)
        self.p, self.w = p, np.zeros(W.size(p))
        self.flexure = Flexure(p, self.w)
        self.q = self.v = self.a = np.zeros(self.flexure.count)

    def right_hand_side(self, y, angle, speed, speed_rate):
        self.flexure.array(FL.Q)[:], self.flexure.array(FL.V)[:] = self.q, self.v
        f = super().right_hand_side(y, angle, speed, speed_rate)
        self.a = self.flexure.array(FL.A).copy()
        return f


def bending_of(given, number):
    """Bearing of a set's scene for the oracle, from 0, without imperfections."""
    return BendingBearing(bearing_of(given, number), pack(one_of(given, number), np.empty(0)))


def rates_of(system):
    """Rates of the oracle's state with places and rates of all modes behind it."""
    bearings = [one.bearing for one in system.mounted]
    size = 2 * system.count + 2

    def rate(t, state):
        modes = state[size:].reshape(len(bearings), 2, -1)
        for one, (q, v) in zip(bearings, modes, strict=True):
            one.q, one.v = q, v
        found = system.rate(t, state[:size])
        return np.concatenate([found, *(np.concatenate([one.v, one.a]) for one in bearings)])

    return rate


@pytest.mark.heavy
@pytest.mark.parametrize("seat", heavy_but(["fixed", "housing", "pedestal"], "housing"))
def test_runs_are_those_of_the_oracle(seat):
    """Balls, bodies, modes and shaft in one dense system, by the classical method in steps of 0.1 us."""
    given = loaded(seat, **{"fidelity.tolerance": 1e-6, "spindle.flexure": BENT})
    run = SetRun(given).init()
    system = spindle_of(given, offsets=offsets(run), bearings=[bending_of(given, b) for b in range(2)])
    modes = [Flexure(system.mounted[b].bearing.p, run.work(b)).state(run.state(b)) for b in range(2)]
    for one in modes:
        one[1] += 2e-3 * np.array([1.0, -0.5, 0.7, 0.2, -0.4, 0.3])  # m/s
    start = place_from(system, [run.y(b) for b in range(2)], carriers(run, system))
    start = np.concatenate([start, *(one[:2].ravel() for one in modes)])
    run.run(2e-4)
    end = oracle.runge_kutta(rates_of(system), start, 2e-4, 1e-7)
    exact = end[2 * system.count + 2 :].reshape(2, 2, -1)
    for b in range(2):
        largest = np.abs(exact[b, 1]).max()
        assert largest > 1e-4
        np.testing.assert_allclose(modes[b][1], exact[b, 1], atol=1e-3 * largest)
    largest = max(np.abs(run.y(b)[Y.V0 : Y.V0 + 3]).max() for b in range(2))
    rings = slice(Y.V0, Y.V0 + Q.RINGS)
    for b, y in enumerate(bearing_arrays(system, end[: 2 * system.count + 2], 2e-4)):
        assert np.abs(run.y(b)[rings][:3] - y[rings][:3]).max() < 2e-4 * largest
    assert run.heat == pytest.approx(end[2 * system.count + 1], rel=1e-4)


def test_energy_closes_with_waves():
    run = SetRun(loaded("fixed", **WAVES | {"spindle.flexure": BENT})).init()
    run.run(0.01)
    assert abs(run.imbalance) <= 1e-3 * run.heat


def test_a_set_of_one_bends_as_a_mounted_bearing():
    """On the same rotor and pedestal: velocities of rings and modes over 1 ms with waves."""
    given = scene(
        "+", (90.0,), None, 20e3, shaft={"sections_mm": [[180.0, 15.0, 0.0]]},
        load={"force_x_N": 500.0, "position_mm": 90.0}, bearings=[{"seat": "pedestal"}],
        housing={"pedestal_stiffness_N_m": 1e8}, flexure=BENT,
        changes={"fidelity.tolerance": 1e-6, "bearing.cage": None, "materials.cage": None} | WAVES,
    )  # fmt: skip
    mass = given.materials.inner_ring.density_kg_m3 * np.pi / 4.0 * 0.015**2 * 0.18
    mounting = Mounting(
        preload_N=500.0, pedestal_stiffness_N_m=1e8, flexure=Bending.model_validate(BENT),
        rotor=Rotor(mass_kg=mass, length_mm=180.0, diameter_mm=15.0),
    )  # fmt: skip
    rows = Run(one_of(given).model_copy(update={"mounting": mounting}), 20e3, bends=True).init().run(1e-3)
    found = SetRun(given).init().run(1e-3)
    modes = Z.flexures(given.bearing.ball_count, 0)
    for first, count in ((Z.INNER_VELOCITY, 3), (Z.OUTER_VELOCITY, 3), (modes, 6)):
        wanted = rows[:, first : first + count]
        # waves push across the axis, where the start of a set holds the rings: 4e-5 m/s follow
        assert found[:, first : first + count] == pytest.approx(wanted, abs=8e-5)


def test_modes_of_every_bearing_are_outputs():
    given = loaded("fixed", **{"spindle.flexure": BENT})
    one = Instance(prepare(given), tell=lambda text: None)
    one.initialise()
    one.step(1e-3)
    for b in (1, 2):
        assert one.get(f"bearing[{b}].outer_ring.flexure.n3.sine") != 0.0
        first = S.SOUND + 6  # places come before rates
        assert one.get(f"bearing[{b}].inner_ring.flexure.n2.cosine") == one.s[_state(one, b)][first]


def _state(one, number):
    from fmu_bearing.prepare.lengths import parts_of

    return parts_of(one.p)[number - 1][1]


def test_tight_seats_are_refused_with_the_way_out():
    loose = BENT | {"outer_seat_stiffness_N_m": 0.0}
    with pytest.raises(SceneError, match=r"flexure.outer_ring: cannot bend on the tight seat of the housing"):
        loaded("fixed", **{"spindle.flexure": loose})
    with pytest.raises(SceneError, match=r"rigid rings only; give .* or leave out .*\[spindle.flexure\]"):
        loaded("fixed", **{"spindle.flexure": BENT, "fidelity.model": "rings"})
