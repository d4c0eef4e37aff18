"""Ball waviness: zonal harmonics, the turning of the balls' axes, and the tone it makes."""

import numpy as np
import pytest
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from fmu_bearing.engine.fidelities.condensed.ball_form import pair_of_sums
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, P, W, Y, Z
from fmu_bearing.engine.mechanics.ball_waves import advance_axes, turn_axes, turned_vector, zonal
from fmu_bearing.engine.mechanics.triples import store_three
from fmu_bearing.prepare.surfaces import form_rows
from tests.engine.helpers import RPM, Run, quiet


@kernel
def series_at(p, orders, x, out):
    """Heights and slopes of zonal harmonics at four places, then those of `zonal`."""
    height, rise, _, _ = pair_of_sums(p, 1, orders, load(x, 0), load(x, 0))
    store(out, 0, height)
    store(out, FOUR, rise)
    heights, rises = zonal(p, 1, orders, (splat(0.0), splat(1.0), load(x, 0)))
    store(out, 2 * FOUR, heights[2])
    store(out, 3 * FOUR, rises[2])


@kernel
def turned(vector, rate, t, out):
    """One vector turned, in the first of four lanes."""
    a = splat(vector[0]), splat(vector[1]), splat(vector[2])
    store_three(out, 0, turned_vector(a, (splat(rate[0]), splat(rate[1]), splat(rate[2])), t))


@pytest.mark.parametrize("orders", [1, 2, 3, 8, 40, 200])
def test_zonal_harmonics_are_legendre_polynomials(orders):
    amplitudes = np.random.default_rng(orders).normal(size=orders)
    series = [0.0, *amplitudes]
    for x in np.linspace(-1.0, 1.0, 44).reshape(-1, FOUR):
        found = np.zeros((4, FOUR))
        series_at(np.array([9.0, *form_rows(amplitudes)]), orders, x, found.ravel())
        for order in range(2):
            wanted = legendre.legval(x, legendre.legder(series, order))
            # a slope reaches n^2/2 per harmonic
            for row in (order, order + 2):
                np.testing.assert_allclose(
                    found[row], wanted, rtol=1e-12, atol=1e-13 * orders ** (2 * order + 1)
                )


@pytest.mark.parametrize("turn", [0.0, 1e-9, 9e-5, 1.1e-4, 0.3, -0.3, 40.0])
def test_vectors_turn_like_rotations(turn):
    rng = np.random.default_rng(1)
    for _ in range(20):
        vector, way = rng.normal(size=(2, 3))
        vector /= np.linalg.norm(vector)
        rate = 3e4 * way / np.linalg.norm(way)
        wanted = Rotation.from_rotvec(rate * (turn / 3e4)).apply(vector)
        rows = np.zeros(3 * STRIDE)
        turned(vector, rate, turn / 3e4, rows)
        # the angle of 40 rad is good to 40 roundings
        np.testing.assert_allclose(rows[::STRIDE], wanted, atol=2e-14)


def rolling(seed, rate):
    """Parameters, axes, and two states whose spins differ by ``rate`` (relative)."""
    rng = np.random.default_rng(seed)
    p = np.zeros(P.TABLES)
    p[P.BALL_WAVES], p[P.BALLS], p[P.LANES] = 2.0, 11.0, 12.0
    axes = rng.normal(size=(3, STRIDE))
    axes /= np.linalg.norm(axes, axis=0)
    y0 = np.zeros(Y.SIZE)
    rows = y0[: 9 * STRIDE].reshape(9, STRIDE)
    rows[Y.OM // STRIDE], rows[6:] = 900.0, 6000.0 * rng.normal(size=(3, STRIDE))
    y1 = y0.copy()
    y1[: 9 * STRIDE].reshape(9, STRIDE)[5:] *= 1.0 + rate * rng.normal(size=(4, STRIDE))
    return p, axes, y0, y1


def test_axes_of_a_stage_are_exact_at_constant_spin():
    p, axes, y0, _ = rolling(1, 0.0)
    w, t = np.zeros(W.ROWS), 7e-6
    turn_axes(p, axes.ravel(), y0, 12, t, w)
    rows = y0[: 9 * STRIDE].reshape(9, STRIDE)
    for j in range(12):
        # inertial rotation first, then the orbiting axes turn away underneath
        inertial = Rotation.from_rotvec(t * (rows[6:, j] - [rows[5, j], 0.0, 0.0])).apply(axes[:, j])
        np.testing.assert_allclose(w[W.AXES :][: 3 * STRIDE].reshape(3, STRIDE)[:, j], inertial, atol=1e-14)


def test_accepted_axes_are_second_order():
    """Against a tight integration with the spin running evenly from one state to the other."""
    errors = []
    for h in (2e-5, 1e-5):
        p, axes, y0, y1 = rolling(2, 0.02)
        start, end = ((y[: 9 * STRIDE].reshape(9, STRIDE)) for y in (y0, y1))
        end[5:] = start[5:] + (end[5:] - start[5:]) * h / 2e-5
        moved = axes.ravel().copy()
        advance_axes(p, moved, y0, y1, 12, h)
        worst = 0.0
        for j in range(12):

            def turning(t, a, one=start[:, j], other=end[:, j], h=h):
                spin = one + (other - one) * t / h
                return np.cross(spin[6:] - [spin[5], 0.0, 0.0], a)

            exact = solve_ivp(turning, (0.0, h), axes[:, j], rtol=1e-12, atol=1e-14).y[:, -1]
            worst = max(worst, np.abs(moved.reshape(3, STRIDE)[:, j] - exact).max())
        errors.append(worst)
    assert errors[0] < 1e-4  # spin changed by some per cent while turning 0.2 rad
    assert errors[0] / errors[1] > 7.0  # local error of third order


def test_without_waviness_nothing_turns():
    p, axes, y0, y1 = rolling(3, 0.1)
    p[P.BALL_WAVES] = 0.0
    moved, w = axes.ravel().copy(), np.zeros(W.ROWS)
    advance_axes(p, moved, y0, y1, 12, 1e-5)
    turn_axes(p, moved, y0, 12, 1e-5, w)
    assert (moved == axes.ravel()).all()
    assert not w.any()


def lines(rows, name, h, frequency):
    """Amplitude (m/s) of an output near a frequency (Hz): the highest of three bins, Hann window."""
    signal = rows[:, Z.BEARING_OUTPUTS.index(name)]
    window = np.hanning(signal.size)
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2.0 / window.sum()
    k = round(frequency * signal.size * h)
    return spectrum[k - 1 : k + 2].max()


@pytest.mark.heavy
def test_wavy_balls_sound_at_twice_their_spin(scene):
    """20 nm of order 2 in a 7003C at 20,000 r/min without other imperfections.

    A ball's contacts see P_2(e . a) at f_b and 2 f_b, f_b its spin against the cage; e stands nearly square
    to the spin, which leaves 2 f_b. Rings hear it axially as it is and radially at 2 f_b -+ f_c.
    """
    h, rpm = 2e-5, 20000
    loud = Run(quiet(scene("7003C-spindle")), rpm, ball_waves=np.array([0.0, 20e-9]))
    still = Run(quiet(scene("7003C-spindle")), rpm)
    spectra = []
    for run in (loud, still):
        run.init().run(0.02, 2e-4)
        spectra.append(run.run(0.05, h))
    balls = loud.s[: 9 * STRIDE].reshape(9, STRIDE)[:, : int(loud.p[P.BALLS])]
    orbit = balls[Y.OM // STRIDE].mean() / (2 * np.pi)
    spin = np.sqrt((balls[6] - balls[5]) ** 2 + balls[7] ** 2 + balls[8] ** 2).mean() / (2 * np.pi)
    found = {}
    for name, tones in (("x", [2 * spin]), ("y", [2 * spin - orbit, 2 * spin + orbit])):
        for tone in tones:
            found[name, round(tone)] = [
                lines(rows, f"inner_ring.velocity.{name}", h, tone) for rows in spectra
            ]
    print(f"f_b {spin:.1f} Hz, f_c {orbit:.1f} Hz, speed {rpm * RPM / 2 / np.pi:.1f} Hz", found)
    for with_waves, without in found.values():
        assert with_waves > 10.0 * without
    assert abs(loud.imbalance) < 1e-4 * loud.heat
