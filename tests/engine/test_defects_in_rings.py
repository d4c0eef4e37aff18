"""Local defects in fidelity `rings`: contacts of balls at rest, places of defects, runs, the limit."""

import math

import numpy as np
import pytest

from fmu_bearing.arrays import EngineError
from fmu_bearing.engine.fidelities.condensed.defects import meet_defects, most_taken, push_ring
from fmu_bearing.engine.layout import DE, MAX_DEFECTS, STRIDE, C, P, T
from fmu_bearing.formulas.hertz import point_contact
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.contacts import surfaces
from fmu_bearing.prepare.defect_blocks import rows
from fmu_bearing.prepare.model import prepare
from fmu_bearing.run.choose import choose
from fmu_bearing.run.settings import Setting
from tests.engine.deep_groove import deep_groove
from tests.engine.defects import groove, left, smooth

RADIUS, PITCH, K = 0.0235, 0.01952, 7.6e9  # m, m, N/m^1.5
TABLE = smooth()
BALL, HEAD, ROW = 2, P.TABLES, T.CONTACT_OUTER  # a ball, places of a defect's head and of a contact's rows
FIDELITIES = ("full", "rings")
NONE = {
    "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "waviness_exponent": 1.0,
}  # fmt: skip


class Contact:
    """A ball over one defect of the outer race, or two, on bare arrays."""

    def __init__(self, *places, scale=0.9, ahead=0.0):
        self.p = np.zeros(HEAD + len(places) * DE.SIZE + rows(TABLE).size)
        self.p[HEAD + len(places) * DE.SIZE :] = rows(TABLE)
        self.p[P.LANES], self.p[P.BALLS], self.p[P.PITCH_RADIUS] = 4.0, 4.0, PITCH
        self.p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS] = K
        self.p[P.DEFECTS], self.p[P.AT_DEFECTS] = len(places), HEAD
        self.c, self.w = np.zeros(C.SIZE), np.zeros(T.ROWS)
        self.c[C.RACES + C.RACE_SIZE + C.FREE] = 2e-4
        self.w[T.OVER : T.OVER + 2 * MAX_DEFECTS * STRIDE] = 1.0
        self.w[T.MEETS + STRIDE + BALL], self.w[ROW + T.QR + BALL] = 1.0, PITCH
        for k in range(len(places)):
            head = self.p[HEAD + k * DE.SIZE :]
            head[DE.ON], head[DE.RADIUS + 1], head[DE.AT_TABLE + 1] = 1.0, RADIUS, len(places) * DE.SIZE
            self.w[T.MEET_SCALE + MAX_DEFECTS + k], self.w[T.MEET_AHEAD + MAX_DEFECTS + k] = scale, ahead
        self.places, self.scale = np.array(places), scale

    def meet(self, approach, moved=0.0):
        """Load (N), its slope (N/m) and push (N), at an approach (m), the ball moved (m) along the track."""
        for k, x in enumerate(self.places):
            self.w[T.OVER + (MAX_DEFECTS + k) * STRIDE + BALL] = x + moved
        self.w[ROW + T.APPROACH + BALL] = approach
        meet_defects(self.p, self.c, 1, T.OUTER, ROW, self.w)
        push = self.w[T.PUSH + STRIDE + BALL] * PITCH / RADIUS
        return np.array([self.w[ROW + T.LOAD + BALL], self.w[ROW + T.STIFF + BALL], push])

    def energy(self, approach, moved=0.0):
        """Energy (J) that the contact stores, by SciPy's splines."""
        rest = approach
        for x in self.places:
            rest = self.scale * left(TABLE, rest / self.scale, x + moved)
        return 0.4 * K * max(rest, 0.0) ** 2.5


@pytest.mark.parametrize("places", [(1e-4,), (-2e-4,), (1e-4, -1.5e-4)])
def test_loads_and_slopes_are_those_of_one_energy(places):
    contact, d, dx = Contact(*places), 1e-9, 1e-7
    for approach in (4e-6, 7e-6, 1.1e-5):
        load, stiff, push = contact.meet(approach)
        assert contact.w[ROW + T.ACROSS + BALL] == pytest.approx(load / (2e-4 + approach), rel=1e-12)
        by_approach = (contact.energy(approach + d) - contact.energy(approach - d)) / (2.0 * d)
        along = (contact.energy(approach, dx) - contact.energy(approach, -dx)) / (2.0 * dx)
        bend = (contact.meet(approach + d)[0] - contact.meet(approach - d)[0]) / (2.0 * d)
        # rounding of some 1e-4 J over the steps; second order of the steps, 1e-6 of them
        assert load == pytest.approx(by_approach, rel=1e-5, abs=1e-5)
        assert push == pytest.approx(along, rel=1e-4, abs=1e-5)
        assert stiff == pytest.approx(bend, rel=1e-4)


def test_damping_advances_what_is_left():
    """To first order as `full` damps a contact: by the rate of what is left, along the track, too."""
    still, moving, approach, ahead = Contact(1e-4), Contact(1e-4, ahead=2e-7), 7e-6, 2e-7
    scale = still.scale
    slope = (left(TABLE, approach / scale, 1e-4 + 1e-8) - left(TABLE, approach / scale, 1e-4 - 1e-8)) / 2e-8
    rest = scale * left(TABLE, approach / scale, 1e-4)
    share = (1.0 + ahead * scale * slope / rest) ** 1.5
    assert moving.meet(approach)[0] == pytest.approx(share * still.meet(approach)[0], rel=1e-9)
    assert abs(share - 1.0) > 1e-4


def test_a_ball_in_a_hole_carries_nothing():
    contact = Contact(0.0)
    assert contact.meet(1e-6).tolist() == [0.0, 0.0, 0.0]


def test_a_push_along_the_track_turns_about_the_ring_s_centre():
    contact, angle, push, x = Contact(0.0), 0.7, 3.0, 1e-4
    w = contact.w
    w[T.PUSH + STRIDE + BALL], w[ROW + T.QX + BALL] = push, x
    w[T.COS + BALL], w[T.SIN + BALL] = math.cos(angle), math.sin(angle)
    push_ring(contact.p, 1, ROW, T.FORCE_OUTER, w)
    w[ROW + T.QT + BALL] = 0.0
    # half of it, as the ball rolls on both races; ball at (x, -r sin, r cos) in fixed axes, its way on at
    # (0, -cos, -sin)
    force = 0.5 * push * np.array([0.0, -math.cos(angle), -math.sin(angle)])
    found = [w[T.FORCE_OUTER + row + BALL] for row in (T.FX, T.FY, T.FZ, T.MY, T.MZ)]
    moment = np.cross([x, -RADIUS * math.sin(angle), RADIUS * math.cos(angle)], force)
    assert found == pytest.approx([*force, *moment[1:]], rel=1e-12, abs=1e-15)


def test_the_most_that_a_defect_takes():
    p = np.concatenate([np.zeros(3), rows(TABLE)])
    for scale, approach in ((1.0, 7e-6), (0.4, 3e-6)):
        taken = [approach - scale * left(TABLE, approach / scale, x) for x in TABLE.places]
        assert most_taken(p, 3, scale, approach) == pytest.approx(max(taken), rel=1e-9)


@pytest.fixture
def _rigid(monkeypatch):
    """Tables of rigid balls over grooves as long as the defect: they drop by L^2/(8 rho)."""
    monkeypatch.setattr(
        "fmu_bearing.prepare.defect_blocks.defect_table",
        lambda shape, radius_x, radius_y, modulus: groove(shape.length, radius_x, shape.depth),
    )


def with_groove(length_mm, rpm=1797.0, load=300.0, axial=0.0, **defect):
    """A 6205 with a groove across the whole track, of the outer race at 6 o'clock if not said otherwise."""
    one = {"on": "outer", "shape": "scratch", "width_mm": length_mm, "depth_um": 500.0} | defect
    changes = {"imperfections": NONE | {"defect": [one]}, "mounting.preload_N": axial}
    return deep_groove(load, rpm, 12.0, changes)


def started(scene, fidelity, **values):
    """An instance at its start, with values set before."""
    bearing = Instance(prepare(scene, fidelity=fidelity))
    for name, value in values.items():
        bearing.set(name.replace("defect_scale", "defect[1].scale"), value)
    bearing.initialise()
    return bearing


def limit_of(scene):
    """Scale of a rigid groove that drops the most loaded ball by as much as it is pressed into both races."""
    sound = started(scene, "rings", defect_scale=0.0)
    both = 0.0
    for race, name in enumerate(("inner", "outer")):
        contact = point_contact(*surfaces(scene, race))
        both += (sound.get(f"contact.{name}.load_max") / contact.stiffness) ** (2.0 / 3.0)
    drop = (1e-3 * scene.imperfections.defect[0].width_mm) ** 2 / (8.0 * surfaces(scene, 1)[0])
    return both / drop


@pytest.mark.usefixtures("_rigid")
def test_a_defect_is_refused_where_the_most_loaded_ball_would_leave_a_race():
    """As deep as both its contacts are pressed together; its scale may be changed before the start."""
    scene = with_groove(0.5)
    limit = limit_of(scene)
    assert 0.5 < limit < 2.0
    # the places of the table are dense enough for 1e-4 of the drop; damping is in the loads that are read
    started(scene, "rings", defect_scale=0.99 * limit)
    with pytest.raises(EngineError, match=r"drops the most loaded ball .* fidelity full, a smaller defect"):
        started(scene, "rings", defect_scale=1.01 * limit)
    started(scene, "full", defect_scale=1.01 * limit)


@pytest.mark.usefixtures("_rigid")
def test_a_scale_that_grows_beyond_the_limit_is_refused_in_a_step():
    scene = with_groove(0.5)
    limit, bearing = limit_of(scene), started(scene, "rings", defect_scale=0.0)
    for share in (0.5, 0.9, 1.1, 0.9):
        bearing.set("defect[1].scale", share * limit)
        # loads swing as balls pass
        if share > 1.0:
            with pytest.raises(EngineError, match=r"step of .* drops the most loaded ball"):
                bearing.step(1e-3)
        else:
            bearing.step(1e-3)
    assert bearing.time == pytest.approx(3e-3)


@pytest.mark.usefixtures("_rigid")
def test_fidelity_auto_leaves_out_what_is_refused():
    scene = with_groove(1.2, rpm=6000.0, load=100.0, axial=150.0)
    candidates = (Setting("response", tolerance=1e-2), Setting("rings", tolerance=1e-2))
    found = choose(scene, candidates, warm_up=2e-3, window=2e-3, budget=1e-3)
    assert [one.fidelity for one in found.probes] == ["rings", "full"]
    assert "drops the most loaded ball" in found.probes[0].reason
    assert found.probe.fidelity == "full"


def over_defect(bearing, step, duration):
    """Load (N) of the ball over the defect and ring's velocities (m/s) after each step."""
    names = ("defect[1].load", "outer_ring.velocity.y", "outer_ring.velocity.z")
    found = np.empty((round(duration / step), 3))
    for row in found:
        bearing.step(step)
        row[:] = [bearing.get(name) for name in names]
    assert np.isfinite(found).all()
    return found


def first_passage(load):
    """Loads (N) of the first ball that passes from one end of the defect to the other."""
    edges = np.flatnonzero(np.diff((load > 0.0).astype(int)))
    first = edges[0] if load[0] == 0.0 else edges[1]
    return load[first + 1 : edges[edges > first][0] + 1]


@pytest.mark.usefixtures("_rigid")
@pytest.mark.parametrize(("on", "angle"), [("outer", 180.0), ("outer", 200.0), ("inner", 190.0)])
def test_a_slow_ball_carries_in_rings_what_it_does_in_full(on, angle):
    """At 30 r/min nothing swings: most and least load of a passage; balls of full get there by slip later."""
    scene = with_groove(0.35, rpm=30.0, on=on, angle_deg=angle)
    full, rings = (first_passage(over_defect(started(scene, one), 2e-4, 0.7)[:, 0]) for one in FIDELITIES)
    assert len(full) > 20 and full.max() > 50.0 and full.min() < 0.85 * full.max()
    # a hundredth of a turn of the orbit changes loads by 2 %
    assert rings.max() == pytest.approx(full.max(), rel=0.03)
    assert rings.min() == pytest.approx(full.min(), abs=0.03 * full.max())
    assert len(rings) == pytest.approx(len(full), rel=0.03, abs=2)


@pytest.mark.usefixtures("_rigid")
@pytest.mark.parametrize("number", [1, 4])
def test_a_ball_s_defect_meets_the_races_when_it_does_in_full(number):
    """Both start with the same directions; within a turn the balls have rolled by the same angle."""
    scene = with_groove(0.3, on="ball", ball=number)
    runs = [started(scene, fidelity) for fidelity in FIDELITIES]
    for bearing in runs:
        for _ in range(300):
            bearing.step(1e-4)
    full, rings = (run.get("defect[1].passages") for run in runs)
    assert full >= 2.0 and abs(full - rings) <= 1.0
    assert runs[1].get("solver.restarts") == 0.0
