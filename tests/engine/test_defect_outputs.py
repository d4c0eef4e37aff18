"""Outputs of local defects in runs: beside numpy on the kept angles, in fidelities and sets, by scale."""

import math
from functools import partial

import numpy as np
import pytest

from fmu_bearing import read_scene, simulate
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import DE, P, Q, R, S, Y
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import ROOT
from tests.engine.deep_groove import deep_groove
from tests.engine.defects import groove

NONE = {
    "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "waviness_exponent": 1.0,
}  # fmt: skip
PIT = {"shape": "pit", "length_mm": 0.3, "depth_um": 50.0}
RPM_, STEP, STOP = 1797.0, 2e-5, 0.03
NAMES = ("passages", "load", "time", "entry", "impact")


@pytest.fixture(autouse=True)
def _rigid(monkeypatch):
    """Tables of rigid balls, which take no minute: a tenth of the groove, so that rings follow it, too."""

    def table(shape, radius_x, radius_y, modulus):
        made = groove(shape.length, radius_x, shape.depth)
        return made._replace(touch=0.1 * made.touch, touch_x=0.1 * made.touch_x, across=0.5 * shape.length)

    monkeypatch.setattr("fmu_bearing.prepare.defect_blocks.defect_table", table)


def scene_with(*defects, radial=300.0, **changes):
    return deep_groove(radial, RPM_, 12.0, {"imperfections": NONE | {"defect": list(defects)}, **changes})


class Angles:
    """Keeps of each point: time, places of balls and rings, angles of the rings, and kept loads."""

    def __init__(self):
        self.rows = []

    def __call__(self, bearing):
        s, balls = bearing.s, int(bearing.p[P.BALLS])
        ball = [s[S.Y + row :][:balls].copy() for row in (Y.TH, Y.R)]
        rings = [s[S.Y + Y.Q0 + ring :][:3].copy() for ring in (0, Q.OUTER)]
        turned = s[S.ANGLE], s[S.Y + Y.Q0 + Q.OUTER + Q.TURN]
        loads = [s[S.CONTACTS + race * R.KEPT + R.KEPT_LOAD :][:balls].copy() for race in (0, 1)]
        self.rows.append((s[S.TIME], *ball, *rings, turned, np.array(loads)))

    def columns(self):
        return [np.array(column) for column in zip(*self.rows, strict=True)]


def wrapped(angle):
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def oracle(kept, race, place, pitch, radius):
    """Places (m) of the balls along the track from a defect, and how far they are towards the race."""
    _, theta, r, *rings, turned, _ = kept.columns()
    at = rings[race]
    y = -(pitch + r) * np.sin(theta) - at[:, 1:2]
    z = (pitch + r) * np.cos(theta) - at[:, 2:3]
    angle = np.arctan2(-y, z) - turned[:, race : race + 1]
    return radius * wrapped(angle - place), (np.hypot(y, z) - pitch) * (1.0 if race else -1.0)


@pytest.mark.parametrize("fidelity", ["full", "rings"])
@pytest.mark.parametrize("on", ["outer", "inner"])
def test_outputs_are_those_of_the_kept_angles(fidelity, on):
    defect = PIT | {"on": on, "angle_deg": 170.0}
    scene = with_fidelity(scene_with(defect), model=fidelity)
    kept = Angles()
    run = simulate(scene, STOP, step=STEP, outputs=["defect[1].*"], watch=kept)
    assert run.complete, run.note
    race = ("inner", "outer").index(on)
    bearing = scene.bearing
    pitch, ball = 0.5e-3 * bearing.pitch_diameter_mm, 0.5e-3 * bearing.ball_diameter_mm
    model = prepare(scene)
    head = model.parameters[int(model.parameters[P.AT_DEFECTS]) :]
    x, depth = oracle(kept, race, math.radians(170.0), pitch, head[DE.RADIUS + race])
    assert head[DE.RADIUS + race] == pytest.approx(pitch + (ball if race else -ball), rel=2e-3)
    time, half = run.time, 0.15e-3
    order = np.arange(len(time))
    near = np.abs(x).argmin(axis=1)
    place = x[order, near]
    # passages: the nearest ball goes from one side to the other
    same = near[1:] == near[:-1]
    passed = np.concatenate([[0], np.cumsum(same & (place[1:] * place[:-1] <= 0.0))])
    assert passed[-1] >= 2
    assert np.array_equal(run["defect[1].passages"], passed)
    # load: of the nearest ball between the ends of the table, which are half a length from the middle
    loads = kept.columns()[-1][order, race, near]
    assert np.array_equal(run["defect[1].load"], np.where(np.abs(place) < half, loads, 0.0))
    # entry: on straight lines between the points, where the orbit changes by far less than 1e-4
    entry = np.zeros(len(time))
    for k in range(1, len(time)):
        entry[k] = entry[k - 1]
        if same[k - 1] and abs(place[k - 1]) > half >= abs(place[k]):
            edge = math.copysign(half, place[k - 1])
            share = (edge - place[k - 1]) / (place[k] - place[k - 1])
            entry[k] = time[k - 1] + share * (time[k] - time[k - 1])
    assert np.count_nonzero(np.diff(entry)) >= 2
    assert np.abs(run["defect[1].entry"] - entry).max() < 1e-8
    since = np.where(entry > 0.0, time - entry, 0.0)
    assert np.abs(run["defect[1].time"] - since).max() < 1e-8
    # impact: the last turn within a tenth of the way down; steps within may turn once more than points show
    inside = np.flatnonzero(np.abs(place) < half)
    compared = 0
    for passage in np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1):
        if entry[passage[-1]] == 0.0 or passage[-1] == len(time) - 1:
            continue
        down = depth[passage, near[passage]]
        way = down.max() - down[0]
        tops = 1 + np.flatnonzero((down[1:-1] > down[:-2]) & (down[1:-1] >= down[2:]))
        tops = tops[down[tops] >= down.max() - 0.1 * way]
        if not tops.size:  # balls pass the inner race within few points
            continue
        last = time[passage[tops[-1]]]
        found = run["defect[1].impact"][passage[-1]]
        assert last - STEP <= found <= time[passage[-1]]
        # a step of 20 us rises or falls by a hundredth of the way near the bottom
        assert np.interp(found, time[passage], down) >= down.max() - 0.12 * way
        compared += 1
    assert compared >= 1


def test_on_a_slow_shaft_impact_follows_entry_by_half_a_length():
    """As sizes are estimated from signals: a ball that follows the path of the edges turns round midway."""
    scene = scene_with(PIT | {"on": "outer", "angle_deg": 160.5}, **{"operation.speed_rpm": 30.0})
    run = simulate(scene, 0.03, step=1e-4, outputs=["defect[1].*", "ball[5].velocity.*"])
    assert run["defect[1].passages"][-1] == 1.0
    # the ball that begins at 160 deg; its centre goes round on the pitch circle, the contact further out
    centre = float(np.hypot(run["ball[5].velocity.y"], run["ball[5].velocity.z"])[-50:].mean())
    bearing = scene.bearing
    speed = centre * (1.0 + bearing.ball_diameter_mm / bearing.pitch_diameter_mm)
    between = run["defect[1].impact"][-1] - run["defect[1].entry"][-1]
    # rings shake: it turns round last where it has risen by a tenth at most, 5.1 % of half a length further
    assert between == pytest.approx(0.5 * 0.3e-3 / speed, rel=0.052)


def test_a_ball_s_defect_meets_both_races_at_twice_its_spin():
    scene = scene_with(PIT | {"on": "ball", "ball": 2})
    run = simulate(scene, 0.06, step=1e-4, outputs=["defect[1].*"])
    # f_b of rolling at the nominal angle, 0, within what slip and the weight of a loose ball may change
    ratio = scene.bearing.ball_diameter_mm / scene.bearing.pitch_diameter_mm
    spin = 0.5 * RPM_ * RPM / ratio * (1.0 - ratio**2) / (2.0 * math.pi)
    assert run["defect[1].passages"][-1] == pytest.approx(2.0 * spin * 0.06, rel=0.03, abs=1.0)
    assert np.unique(np.diff(run["defect[1].passages"])).tolist() == [0.0, 1.0]


@pytest.mark.parametrize("fidelity", ["full", "rings"])
def test_scale_0_is_no_defect_and_it_may_change_between_steps(fidelity):
    rings = ["*_ring.velocity.z"]
    sound = with_fidelity(scene_with(), model=fidelity)
    scene = with_fidelity(scene_with(PIT | {"on": "outer"}), model=fidelity)
    perfect = simulate(sound, STOP, step=STEP, outputs=rings)
    off = simulate(scene, STOP, step=STEP, start_values={"defect[1].scale": 0.0}, outputs=rings)
    for name in perfect.names:
        # steps are shorter with a defect: errors of the method differ, not what it does
        assert np.abs(off[name] - perfect[name]).max() < 0.05 * np.abs(perfect[name]).max() + 1e-6
    half = {"defect[1].scale": lambda time: 0.0 if time < 0.5 * STOP - 0.1 * STEP else 1.0}
    grown = simulate(scene, STOP, step=STEP, inputs=half, outputs=[*rings, "defect[1].scale"])
    before = grown.time < 0.5 * STOP - 0.5 * STEP
    for name in perfect.names:
        assert np.array_equal(grown[name][before], off[name][before])
    late = ~before
    assert grown["outer_ring.velocity.z"][late].std() > 3.0 * off["outer_ring.velocity.z"][late].std()
    # that of all imperfections counts, too
    none = simulate(scene, STOP, step=STEP, start_values={"imperfection.scale": 0.0}, outputs=rings)
    for name in perfect.names:
        assert np.abs(none[name] - perfect[name]).max() < 0.05 * np.abs(perfect[name]).max() + 1e-6


def test_an_instance_takes_the_scale_between_steps_and_repeats_steps_with_their_own():
    model = prepare(scene_with(PIT | {"on": "outer"}))
    one, other = Instance(model), Instance(model)
    for bearing in (one, other):
        bearing.initialise()
    for k in range(40):
        for bearing in (one, other):
            bearing.set("defect[1].scale", 0.1 * (k % 10))
            bearing.step(1e-4)
        with pytest.raises(ValueError, match="must be above 0 s"):
            one.step(-1.0)  # it goes back to before a step that is refused
    assert np.array_equal(one.s, other.s) and np.array_equal(one.z, other.z)
    with pytest.raises(ValueError, match=r"defect\[1\].scale = 101.0 is refused: allowed are 0 to 100"):
        one.set("defect[1].scale", 101.0)
    with pytest.raises(ValueError, match="imperfection.scale is fixed once the bearing is initialised"):
        one.set("imperfection.scale", 0.5)


@pytest.mark.parametrize("fidelity", ["full", "rings"])
def test_in_a_set_each_bearing_has_its_own(fidelity):
    pair = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml")
    PIT = {"shape": "pit", "length_mm": 0.15, "depth_um": 50.0}
    defects = [PIT | {"on": "outer", "bearing": 2}, PIT | {"on": "inner", "bearing": 1},
               PIT | {"on": "inner", "bearing": 2}]  # fmt: skip
    scene = with_fidelity(pair.replace({"imperfections": NONE | {"defect": defects}}), model=fidelity)
    names = ["bearing[1].defect[1].*", "bearing[2].defect[1].*", "bearing[2].defect[2].*"]
    run = simulate(scene, 0.01, step=5e-5, outputs=[*names, "*cage.speed_ratio"])
    turned, balls = scene.operation.speed_rpm / 60.0 * 0.01, scene.bearing.ball_count
    for bearing, defect, on in ((1, 1, "inner"), (2, 1, "outer"), (2, 2, "inner")):
        share = float(run[f"bearing[{bearing}].cage.speed_ratio"].mean())
        passed = balls * turned * (share if on == "outer" else 1.0 - share)
        # the first may come at once, or an orbit of a ball later
        assert run[f"bearing[{bearing}].defect[{defect}].passages"][-1] == pytest.approx(passed, abs=1.0)
        assert run[f"bearing[{bearing}].defect[{defect}].load"].max() > 0.0
    # the scale of one is that of its place in the scene
    scaled = partial(simulate, scene, 2e-3, step=1e-4, outputs=["bearing[1].defect[1].scale"])
    assert scaled(start_values={"bearing[1].defect[1].scale": 0.5}).table[-1][1] == 0.5
