"""Loose balls that hit the inner ring: peak load grows with the 6/5th power of speed, 24 dB per decade.

An impact by Hertz's law has the peak ``K^(2/5) (5/4 m v^2)^(3/5)``. The impact-noise paper's levels grow with
23.8 dB per decade of shaft speed. Here the engine's equations, without friction, weight, waves and preload,
are left to themselves with all balls flying at the inner race at once.
"""

import math

import numpy as np
import pytest

from examples.papers.case import SCENES
from examples.papers.printed_forces import Bearing
from fmu_bearing.arrays import Arrays
from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, P, S, Y
from fmu_bearing.engine.reference.runge_kutta import ROWS, SIZE
from fmu_bearing.scene import read_scene
from tests.engine.explicit import Motion

LOOSE = 5e-5  # m: how far the inner ring is moved out of its balls
H = 5e-8  # s


def loose():
    """The impact scene without springs, damping and preload, at rest, its inner ring out of its balls."""
    run = Arrays.of(
        read_scene(SCENES / "7003C-impact.toml").replace({
            "bearing.ball_springs": None, "bearing.contact_damping_us": 0.0, "imperfections": None,
            "sound": None, "mounting.flexure": None,
        })
    )  # fmt: skip
    run.init()
    motion = Motion(run)
    motion.c[C.PRELOAD] = 0.0
    return motion, Bearing(run.p.copy(), run.s[S.C : S.C + C.SIZE].copy())


def peak(motion, bearing, speed):
    """Peak load (N) of balls that fly at the inner race with a speed (m/s), and the angle of that line."""
    race = {key: value[0].item() for key, value in vars(bearing.races).items()}
    y, scratch = motion.start.copy(), np.zeros(ROWS * SIZE)
    balls, bodies = int(motion.p[P.BALLS]), y[Y.Q0 : Y.V0]
    rows = y[: 9 * STRIDE].reshape(9, STRIDE)[:, :balls]

    def place():
        x, r = rows[0] - bodies[0] - race["groove_x"], bearing.pitch_radius + rows[1] - race["groove_radius"]
        return x, r, np.hypot(x, r)

    x, r, _ = place()  # of the preloaded bearing: the line of contact
    bodies[0] -= LOOSE
    angle = math.atan2(x[0], r[0])
    e = np.array([math.sin(angle), math.cos(angle)])
    rows[0] = bodies[0] + race["groove_x"] + race["free"] * e[0]
    rows[1] = race["groove_radius"] - bearing.pitch_radius + race["free"] * e[1]
    rows[3:] = 0.0
    rows[3], rows[4] = speed * e[0], speed * e[1]
    y[Y.V0 : Y.SIZE] = 0.0
    highest, parted = 0.0, False
    for _ in range(4000):
        call("runge_kutta", motion.p, motion.c, y, motion.w, scratch, motion.angle, 0.0, H, 1)
        pressed = place()[2] - race["free"]
        highest = max(highest, float(race["stiffness"] * max(pressed.max(), 0.0) ** 1.5))
        parted = highest > 0.0 and pressed.max() < 0.0
        if parted:
            break
    assert parted  # the impact has ended
    return highest, angle


@pytest.mark.heavy
def test_peaks_of_impacts_grow_by_24_db_per_decade():
    motion, bearing = loose()
    stiffness = float(bearing.races.stiffness[0].item())
    speeds, peaks = (0.03, 0.1, 0.3, 1.0), []
    for speed in speeds:
        found, angle = peak(motion, bearing, speed)
        # all balls push the ring along the axis; across it they cancel
        mass = 1.0 / (1.0 / bearing.ball_mass + bearing.balls * math.sin(angle) ** 2 / bearing.inner_mass)
        assert found == pytest.approx(stiffness**0.4 * (1.25 * mass * speed**2) ** 0.6, rel=0.01)
        peaks.append(20.0 * math.log10(found))
    slope = np.polyfit(np.log10(speeds), peaks, 1)[0]
    assert slope == pytest.approx(24.0, abs=0.1)
