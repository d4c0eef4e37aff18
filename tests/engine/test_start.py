"""Where the balls of a displaced bearing are put at the start."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import EQ, STRIDE, C, F, P, Q, S, U, Y
from fmu_bearing.engine.statics.place import place_balls
from fmu_bearing.engine.statics.rigid_preload import cold_place
from fmu_bearing.engine.status import OK
from tests.engine.helpers import RPM, Run, quiet
from tests.engine.quasistatic import Bearing


@pytest.mark.parametrize("sag", [-3e-6, -2e-3])
def test_balls_follow_the_outer_ring(scene, sag):
    """Against Cartesian places and velocities, for micrometres and for the millimetres of a soft pedestal."""
    bearing = Bearing(scene("7003C-bare")).solve(20e3, (500, 0, -300, 0, 0))
    y = np.zeros(Y.SIZE)
    centre = np.array([1e-5, 0.4 * sag, sag])
    y[Y.Q0 + Q.OUTER :][:3] = centre
    place_balls(bearing.p, y, bearing.out)
    rows = y[: 9 * STRIDE].reshape(9, -1)[:, : bearing.balls]
    pitch = bearing.p[P.PITCH_RADIUS]

    def cartesian(angle, axial, radial, tangential):
        """Vectors from components along x, r, theta."""
        c, s = np.cos(angle), np.sin(angle)
        return np.array([axial, -s * radial - c * tangential, c * radial - s * tangential])

    zero = np.zeros(bearing.balls)
    theta = rows[Y.TH // STRIDE]
    nominal = 2 * np.pi * np.arange(bearing.balls) / bearing.balls
    radius = pitch + bearing.row(EQ.R)
    expected = cartesian(nominal, bearing.row(EQ.X), radius, zero) + centre[:, None]
    placed = cartesian(theta, rows[Y.X // STRIDE], pitch + rows[Y.R // STRIDE], zero)
    np.testing.assert_allclose(placed, expected, rtol=0, atol=1e-16)
    # velocity: orbit and what the ball moves along and outwards as it goes round, from a Fourier series
    orbit = bearing.row(EQ.OM)
    waves = np.fft.fftfreq(bearing.balls, 1 / bearing.balls)

    def around(values):
        return np.fft.ifft(1j * waves * np.fft.fft(values)).real

    wanted = cartesian(
        nominal, orbit * around(bearing.row(EQ.X)), orbit * around(bearing.row(EQ.R)), radius * orbit
    )
    got = cartesian(
        theta,
        rows[Y.VX // STRIDE],
        rows[Y.VR // STRIDE],
        (pitch + rows[Y.R // STRIDE]) * rows[Y.OM // STRIDE],
    )
    # the differences lose up to a few per cent of the harmonics beyond the first: of 3 mm/s
    np.testing.assert_allclose(got, wanted, rtol=0, atol=1e-4)
    spin = cartesian(theta, rows[Y.WX // STRIDE], rows[Y.WR // STRIDE], rows[Y.WT // STRIDE])
    still = cartesian(nominal, bearing.row(EQ.WX), bearing.row(EQ.WR), zero)
    np.testing.assert_allclose(spin, still, rtol=1e-12, atol=1e-9)
    assert orbit.mean() == pytest.approx(0.42 * 20e3 * RPM, rel=0.02)


def test_a_rigidly_preloaded_bearing_rests_under_a_load_across(scene):
    """The mount holds the place alone: all other forces on rings and balls balance at the start."""
    run = Run(quiet(scene("7003C-bare")), 20000, RIGID=1.0, CAGE=0.0)
    run.u[U.LOAD_Z] = -300.0
    run.init()
    f, y, c = np.zeros(F.SIZE), run.s[S.Y : S.Y + Y.SIZE], run.s[S.C : S.C + C.SIZE]
    call("right_hand_side", run.p, c, y, run.w, f, 0.0, run.u[U.SPEED], 0.0)
    place, status = cold_place(run.p, run.u, run.u[U.PRELOAD], run.w)
    assert status == OK and y[Y.Q0] == place
    assert y[Y.Q0 + Q.Z] < -1e-6
    mass, turning = run.p[P.OUTER_MASS], run.p[P.OUTER_TRANSVERSE] / run.p[P.PITCH_RADIUS]
    outer = f[F.BODY + Q.OUTER : F.BODY + Q.CAGE] * [mass, mass, mass, 0.0, turning, turning]
    inner = f[F.BODY + Q.Y : F.BODY + Q.INNER_BY] * run.p[P.INNER_MASS]
    # what may be out of balance in a steady state: 1e-4 N
    np.testing.assert_allclose([*outer, *inner], 0.0, atol=1e-3)
