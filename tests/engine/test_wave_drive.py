"""How waves of the races drive the rings in `rings` and `response`: as in `full`, linearised and in time."""

import numpy as np
import pytest

from benchmarks.quick_gates import HALF, QUICK, Drawn, cageless, farthest, motion, ratios
from fmu_bearing.arrays import Arrays
from fmu_bearing.compiled import bound
from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.layout import STRIDE, C, F, L, P, Q, S, W, Y
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.scene.read import with_fidelity
from tests.marks import heavy_but

BALL = (F.X, F.R, F.TH, F.WX, F.WR, F.WT)
WAVE = 1e-10  # m: 1e-4 of the least approach
RACES = (0, 1)


def put_wave(p, race, n, amplitude):
    """Let parameters have one wave alone: Re(``amplitude`` exp(i n angle)) of a race (m), on spheres."""
    count, orders = int(p[P.WAVE_INTERVALS]), int(p[P.WAVE_ORDERS])
    table = p[int(p[P.AT_WAVES]) :][: 4 * count].reshape(2, count, 2)
    lines = p[int(p[P.AT_ORDERS]) :][: 4 * orders].reshape(2, orders, 2)
    table[:], lines[:] = 0.0, 0.0
    turned = amplitude * np.exp(2j * np.pi * n * np.arange(count) / count)
    table[race, :, 0], table[race, :, 1] = turned.real, (1j * n * turned).real * 2.0 * np.pi / count
    lines[race, n - 1] = amplitude.real, amplitude.imag
    p[int(p[P.AT_OVERSIZE]) :][:STRIDE] = 0.0
    p[P.BALL_WAVES] = 0.0


def alone(scene, model):
    """The scene's arrays without weight, not initialised; parameters may be written."""
    run = Arrays.of(with_fidelity(scene, model=model), GRAVITY=0.0)
    run.p.setflags(write=True)
    return run


class Full:
    """Equations of `full`, linearised at the steady state of equal loads, driven by one wave of a race."""

    def __init__(self, scene):
        self.bearing = linearised(scene).bearings[0]
        held = self.bearing.arrays.s
        run = alone(scene, "full")
        self.p, self.w, self.f = run.p, np.zeros(W.size(run.p)), np.zeros(F.SIZE)
        self.c, self.y = held[S.C :][: C.SIZE].copy(), held[S.Y :][: Y.SIZE].copy()
        self.c[C.OVERSIZE_SCALE], self.c[C.ECCENTRICITY] = 1.0, 0.0
        self.balls, self.speed = self.bearing.coordinates.balls, self.bearing.speed
        self.angles = self.y[Y.TH :][: self.balls]
        self._evaluate = bound("right_hand_side", self.p, self.c, self.y, self.w, self.f)

    def drive(self, race, n):
        """Complex accelerations by a wave exp(i n angle) of a metre, by central differences."""
        found = np.zeros(F.SIZE, complex)
        for part in (1.0, -1j):  # of which the wave's cosine and sine are the real parts
            for sign in (1.0, -1.0):
                put_wave(self.p, race, n, sign * part * WAVE + 0j)
                self._evaluate(0.0, self.speed, 0.0)
                found += sign * np.conj(part) * self.f / (2.0 * WAVE)
        return found

    def answer(self, race, k, aside):
        """Complex places of the rings by wave n = k Z + ``aside`` (0, 1 or -1), per metre of it."""
        at, n = self.bearing.coordinates, k * self.balls + aside
        driven, x = self.drive(race, n), np.zeros(self.bearing.coordinates.size, complex)
        for row, first in enumerate(BALL):
            # what all balls do is exp(i n angle), in patterns cosine and sine of their angles
            own = (driven[first : first + self.balls] * np.exp(-1j * n * self.angles)).mean()
            to = (3 + row) * self.balls
            if aside == 0:
                x[to] = own
            else:
                x[to + 1], x[to + 2] = own, 1j * aside * own
        x[at.rings + Q.RINGS : at.rings + 2 * Q.RINGS] = driven[F.BODY : F.BODY + Q.RINGS]
        turning = k * self.balls * self.bearing.orbit - (n * self.speed if race == 0 else 0.0)
        x = np.linalg.solve(1j * turning * np.eye(at.size) - self.bearing.matrix, x)
        return x[at.rings :][: Q.RINGS] * np.exp(-1j * k * self.balls * self.angles[0])


def line_of(scene, race, k, aside):
    """The same from the lines of `response`."""
    run = alone(scene, "response")
    balls = int(run.p[P.BALLS])
    n = k * balls + aside
    put_wave(run.p, race, n, WAVE + 0j)
    run.p.setflags(write=False)
    run.init()
    lines = run.s[line_table(run.p) :][: L.MOST_LINES * L.LINE_SIZE].reshape(-1, L.LINE_SIZE)
    (line,) = (
        one
        for one in lines[: int(run.s[S.CONDENSED + L.COUNT])]
        if one[L.LINE_BALL] == k * balls and one[L.LINE_SHAFT] == (-n if race == 0 else 0)
    )
    return (line[L.LINE_REAL :][: L.N] + 1j * line[L.LINE_IMAGINARY :][: L.N]) / WAVE


def bare(bearing, rpm, preload, damping):
    """A bearing without its cage, with its waves, at a contact damping (us)."""
    scene = cageless(Drawn(bearing, rpm, preload).scene()).replace({"bearing.contact_damping_us": damping})
    return scene.with_rigid_rings().replace({"fidelity.terms.gravity": False})


@pytest.mark.parametrize("damping", [0.5, 2.5, 10.0])
@pytest.mark.parametrize(
    ("bearing", "rpm", "preload"),
    [("NSK-7910C", 11e3, "heavy"), ("NSK-7907C", 11e3, HALF), ("NSK-7906C", 19.1e3, HALF)],
)
def test_waves_drive_rings_as_in_the_linear_equations_of_full(bearing, rpm, preload, damping):
    """Amplitude and phase, in the plane z for waves that move rings aside."""
    scene = bare(bearing, rpm, preload, damping)
    full = Full(scene)
    for race in RACES:
        # A height tau later in place of its rate made these 0.98 to 0.62 at 10 us, from 2 to 19 kHz, and
        # friction without waves' loads 0.88 to 0.99 at half of the lightest class. Found within 0.6 % above
        # 2 kHz; below it, where balls swing across their tracks, within 2.2 %: their tracks' slope.
        for k in (1, 4, 7):
            exact, found = full.answer(race, k, 0), line_of(scene, race, k, 0)
            within = 0.01 if k > 1 else 0.03
            assert np.abs(found[Q.X] / exact[Q.X] - 1.0) < within, (race, k)
        # The waves' slope, which pushes balls along their tracks, is left out: found within 4 %.
        for k, aside in ((2, 1), (3, -1), (5, 1), (6, -1)):
            exact, found = full.answer(race, k, aside), line_of(scene, race, k, aside)
            assert np.abs(found[Q.Z] / exact[Q.Z] - 1.0) < 0.05, (race, k, aside)


@pytest.mark.parametrize("damping", heavy_but([2.5, 10.0], 0))
def test_rings_move_as_in_full_by_waves_at_low_preload(damping):
    """A tenth of the surfaces of a bearing that had 0.79 to 0.96 at 10 us: found 0.97 to 1.01."""
    scene = cageless(Drawn("NSK-7907C", 11e3, HALF).scene())
    scene = scene.replace({"bearing.contact_damping_us": damping})
    full = motion(scene, "full", scale=0.1)
    for model in QUICK:
        least, most = farthest(ratios(scene, full, motion(scene, model, scale=0.1)))
        assert 0.95 < least and most < 1.03, (model, least, most)
