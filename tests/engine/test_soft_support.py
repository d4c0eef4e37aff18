"""`rings` on a support far softer than its contacts, and with balls that come and go under a load across."""

import numpy as np
import pytest

from fmu_bearing import new_scene, simulate
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import L, Q, S
from fmu_bearing.scene.read import read_scene_text, with_fidelity

SOFT = 1e4  # N/m: of the vibration test, and the least that a scene may have; contacts have 1e7
#: Bearing, kind, r/min, preload (N).
ON_SOFT = (
    ("7003C", "steel", 1800, 30.0),
    ("NSK-7010C", "hybrid", 5000, 50.0),
    ("7003C", "hybrid", 1800, 5.0),
)


def rings(bearing, kind, rpm, preload, **keys):
    text = new_scene("soft", bearing, kind=kind, speed_rpm=float(rpm), preload_N=preload, sound=False)
    scene = read_scene_text(text).replace({f"mounting.{key}": value for key, value in keys.items()})
    return with_fidelity(scene.model_copy(update={"imperfections": None}), model="rings")


@pytest.mark.parametrize(("bearing", "kind", "rpm", "preload"), ON_SOFT)
def test_balls_at_rest_go_with_both_rings(bearing, kind, rpm, preload):
    """What is left of two contacts' stiffness where both rings move along the axis: the support alone.

    A sweep that leaves balls short of their rest by a spring of 1 kN/m to where they were shows it as that of
    all balls: 14 kN/m, with the other sign in what is added for `full`. The steel 7003C drifted by 205 1/s.
    """
    run = Arrays.of(rings(bearing, kind, rpm, preload, pedestal_stiffness_N_m=SOFT))
    run.init()
    lv = run.s[S.CONDENSED :][: L.SIZE]
    table = lv[L.JX : L.JX + L.MATRIX].reshape(L.N, L.COLUMN)
    inner, outer = Q.X, Q.OUTER + Q.X
    stiff = abs(table[inner, inner])
    # the inner ring has no support: it feels the balls alone, whose differences hold 1e-6 (before, 6e-4)
    assert abs(table[inner, inner] + table[outer, inner]) < 1e-5 * stiff
    follow = lv[L.FAMILY + L.FOLLOW :][: 2 * L.FAMILY_RINGS].reshape(L.FAMILY_RINGS, 2)[:, 0]
    assert follow[0] + follow[1] == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize(("bearing", "kind", "rpm", "preload"), ON_SOFT)
def test_a_perfect_bearing_comes_to_rest(bearing, kind, rpm, preload):
    name = "inner_ring.velocity.x"
    scene = rings(bearing, kind, rpm, preload, pedestal_stiffness_N_m=SOFT)
    velocity = np.abs(simulate(scene, 0.12, step=5e-5, outputs=[name], progress=False)[name])
    # what a start leaves falls to 0.003 to 0.04 in 0.1 s; the drift made it 1e5 times as large
    assert velocity[-400:].max() < 0.3 * velocity[:400].max()


@pytest.mark.parametrize(
    ("bearing", "rpm", "preload"), [("NSK-7903AC", 68_900, 78.0), ("NSK-7909AC", 28_700, 150.0)]
)
def test_light_balls_do_not_cut_the_steps(bearing, rpm, preload):
    """Twice the preload across: held by loads before a sweep, a ball of 2 N cut steps to 0.06 us."""
    scene = rings(bearing, "hybrid", rpm, preload, radial_load_y_N=2.0 * preload)
    names = ["solver.steps", "solver.restarts"]  # 700 to 1,400 steps; before, 160,000
    run = simulate(scene, 0.01, step=1e-4, outputs=names, progress=False)
    assert run[names[0]][-1] < 4000 and run[names[1]][-1] == 0.0
