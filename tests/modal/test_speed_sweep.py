"""Runs of fidelity full with one order of waviness peak at its crossing, in its own direction alone."""

import numpy as np
import pytest

from fmu_bearing import modes
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import Q, S, U, Y

RPM = np.pi / 30.0
H, SETTLE, WINDOW = 2e-5, 0.08, 0.04  # s; the axial mode forgets its start in 12 ms


def line(scene, rpm, place):
    """Return what takes amplitudes (m/s, rad/s) from two rates in a row, the orbit speed, and the rates."""
    bearing = Arrays.of(scene, CAGE=0.0)
    bearing.u[U.SPEED] = rpm * RPM
    bearing.init()
    for _ in range(round(SETTLE / 1e-3)):
        bearing.step(1e-3)
    signal = np.empty(round(WINDOW / H), dtype=complex)
    for k in range(signal.size):
        bearing.step(H)
        signal[k] = bearing.s[S.Y + place] + 1j * bearing.s[S.Y + place + 1]
    window = np.hanning(signal.size)
    times = np.arange(signal.size) * H
    orbit = float(bearing.s[S.Y + Y.OM : S.Y + Y.OM + 12].mean())

    def amplitude(omega, part=signal):
        return abs((window * part * np.exp(-1j * omega * times)).sum()) / window.sum()

    return amplitude, orbit, signal


def wavy(scene, order):
    flaws = {
        "imperfections.inner_race_amplitude_um": None,
        "imperfections.outer_race_amplitude_um": 0.0,
        "imperfections.inner_race_harmonic": [{"order": order, "amplitude_um": 0.002}],
        "imperfections.unbalance_um": 0.0,
        "imperfections.ball_diameter_spread_nm": 0.0,
        "imperfections.ball_waviness_nm": 0.0,
        "imperfections.ball_form_nm": 0.0,
    }
    return scene.replace(flaws)


def test_a_speed_sweep_peaks_at_the_crossing(gate):
    """Order 12 of the inner race moves the axial mode, whose damping ratio is 0.56 %: half a width."""
    scene = wavy(gate("7003C-spindle"), 12)
    speeds = 21_209.0 * np.array([0.988, 0.992, 0.996, 1.0, 1.004, 1.008, 1.012])
    inverse = []
    for rpm in speeds:
        amplitude, orbit, signal = line(scene, rpm, Y.V0 + Q.INNER)
        inverse.append(1.0 / amplitude(12.0 * (rpm * RPM - orbit), signal.real) ** 2)
    # near resonance the inverse square of the answer is a parabola over the speed
    curve = np.polyfit(speeds, inverse, 2)
    found = modes(scene, {"shaft_speed": 21_209 * RPM}).named("inner axial")
    assert -curve[1] / (2.0 * curve[0]) == pytest.approx(21_209.0, rel=0.5 * found.damping)
    least = np.polyval(curve, -curve[1] / (2.0 * curve[0]))
    # half the width over the peak: the damping ratio
    half = np.sqrt(least / curve[0]) / 21_209.0
    assert half == pytest.approx(found.damping, rel=0.1)


@pytest.mark.parametrize(("order", "rpm", "sign"), [(13, 14_526.0, 1.0), (11, 19_361.0, -1.0)])
def test_one_order_moves_one_whirl(gate, order, rpm, sign):
    """m N + n forward, m N - n backward; the other whirl stays below 1e-4."""
    scene = wavy(gate("7003C-spindle"), order)
    amplitude, orbit, _ = line(scene, rpm, Y.V0 + Q.INNER_BY)
    omega = 12.0 * (rpm * RPM - orbit) + sign * rpm * RPM
    own, other = amplitude(sign * omega), amplitude(-sign * omega)
    assert own > 0.0 and other < 1e-4 * own
