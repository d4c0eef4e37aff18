"""Modes out of the engine's own free decay: two runs, one of them kicked, and the matrix pencil.

The oracle of `modes`: nothing is linearised, no mode is presumed.
"""

import numpy as np

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import P, Q, S, U, Y

INNER, OUTER = S.Y + Y.V0 + Q.INNER, S.Y + Y.V0 + Q.OUTER
_KICK = 2e-5  # m/s: a nanometre at 3 kHz, a thousandth of the contacts' approach
_AXIAL = (INNER, OUTER, OUTER + Q.TURN)
_PAIRS = (INNER + Q.Y, INNER + Q.INNER_BY, OUTER + Q.Y, OUTER + Q.BY)


def decay(scene, rpm, places, h=8e-6, count=700, settle=0.02, load_z=0.0):
    """What a kick adds to the state: shape (count, numbers of the state).

    ``places``: places of rates in the state that are kicked, with their shares of the kick.
    """
    bearing = Arrays.of(scene, CAGE=0.0, IMPERFECTION_SCALE=0.0, TOLERANCE=1e-7, MAX_STEP=2e-6)
    bearing.u[U.SPEED], bearing.u[U.LOAD_Z] = rpm * np.pi / 30.0, load_z
    bearing.init()
    for _ in range(round(settle / 1e-3)):
        bearing.step(1e-3)
    kept = bearing.s.copy()
    found = []
    for kick in (0.0, _KICK):
        bearing.s[:] = kept
        for place, share in places.items():
            bearing.s[place] += share * kick
        rows = np.empty((count, bearing.s.size))
        for row in rows:
            bearing.step(h)
            row[:] = bearing.s
        found.append(rows)
    return found[1] - found[0]


def axial(scene, rpm, order=20, h=8e-6, count=700):
    """Poles (1/s) of motions along and about the axis."""
    rows = decay(scene, rpm, {INNER: 1.0, OUTER + Q.TURN: 30.0}, h, count)
    return pencil(rows[:, _AXIAL].astype(complex), h, order)


def radial(scene, rpm, order=30, h=8e-6, count=700, **more):
    """Poles (1/s) of y + i z of rings and tilts: above zero forward, below backward."""
    kick = {INNER + Q.Y: 1.0, OUTER + Q.Z: 1.0, INNER + Q.INNER_BY: 100.0, OUTER + Q.BZ: 50.0}
    rows = decay(scene, rpm, kick, h, count, **more)
    return pencil(np.array([rows[:, k] + 1j * rows[:, k + 1] for k in _PAIRS]).T, h, order)


def bending(scene, rpm, mode, order=12, h=8e-6, count=700):
    """Poles (1/s) of a + i b of one flexural mode, by its number in the table."""
    p = Arrays.of(scene).p
    first = S.SOUND + int(p[P.SOUND_STATE])
    rates = first + 2 * int(p[P.MODES])
    rows = decay(scene, rpm, {rates + 2 * mode: 1.0}, h, count)
    pairs = rows[:, rates : rates + 2 * int(p[P.MODES])]
    return pencil(pairs[:, 0::2] + 1j * pairs[:, 1::2], h, order)


def pencil(signals, h, order):
    """Poles (1/s) of decaying signals (columns): matrix pencil on Hankel matrices (Hua, Sarkar 1990)."""
    width = len(signals) // 2
    largest = np.abs(signals).max()
    # what the kick does not reach is noise
    moving = [column for column in signals.T if np.abs(column).max() > 1e-6 * largest]
    blocks = [np.lib.stride_tricks.sliding_window_view(one / np.abs(one).max(), width + 1) for one in moving]
    _, _, right = np.linalg.svd(np.concatenate(blocks), full_matrices=False)
    space = right[:order].T
    return np.log(np.linalg.eigvals(np.linalg.pinv(space[:-1]) @ space[1:])) / h


def nearest(poles, mode):
    """Frequency (Hz) and damping ratio of the pole nearest to a mode, with the mode's own direction."""
    sign = -1.0 if mode.direction == "backward" else 1.0
    pole = poles[np.abs(poles - complex(mode.value.real, sign * mode.value.imag)).argmin()]
    return sign * pole.imag / (2.0 * np.pi), -pole.real / abs(pole)
