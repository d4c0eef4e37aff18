"""Modes out of the engine's own free decay: two runs, one of them kicked, and the matrix pencil.

The oracle of `modes`: nothing is linearised, no mode is presumed.
"""

import numpy as np

from fmu_bearing.engine.layout import Q, S, Y
from fmu_bearing.run.arrays import Arrays

#: Motions that are kicked and listened to: places in a state of rates, and what makes them lengths.
INNER, OUTER = Y.V0 + Q.INNER, Y.V0 + Q.OUTER
AXIAL = (INNER, OUTER)
RADIAL = ((INNER + Q.Y, 1.0), (INNER + Q.INNER_BY, 0.01), (OUTER + Q.Y, 1.0), (OUTER + Q.BY, 0.01))
_KICK = 2e-5  # m/s: a nanometre at 3 kHz, a thousandth of the contacts' approach


def decay(scene, rpm, h=8e-6, count=1200, settle=0.02, kick_axial=False):
    """Rates of the rings after a kick, less those without: shape (count, 17), m/s and rad/s."""
    bearing = Arrays.of(
        scene, CAGE=0.0, GRAVITY=0.0, IMPERFECTION_SCALE=0.0, TOLERANCE=1e-7, MAX_STEP=2e-6
    )
    bearing.u[0] = rpm * np.pi / 30.0
    bearing.init()
    for _ in range(round(settle / 1e-3)):
        bearing.step(1e-3)
    kept = bearing.s.copy()
    found = []
    for kick in (0.0, _KICK):
        bearing.s[:] = kept
        places = [INNER] if kick_axial else [INNER + Q.Y, OUTER + Q.Z]
        bearing.s[[S.Y + place for place in places]] += kick
        if kick and not kick_axial:
            bearing.s[S.Y + INNER + Q.INNER_BY] += 100.0 * kick
            bearing.s[S.Y + OUTER + Q.BZ] += 50.0 * kick
        rows = []
        for _ in range(count):
            bearing.step(h)
            rows.append(bearing.s[S.Y + Y.V0 : S.Y + Y.V0 + Q.SIZE].copy())
        found.append(np.array(rows))
    return found[1] - found[0]


def pencil(signals, h, order):
    """Poles (1/s) of decaying signals (columns): matrix pencil on their Hankel matrices (Hua, Sarkar 1990)."""
    count = len(signals)
    width = count // 2
    blocks = [np.lib.stride_tricks.sliding_window_view(column, width + 1) for column in signals.T]
    hankel = np.concatenate([block / np.abs(block).max() for block in blocks])
    _, _, right = np.linalg.svd(hankel, full_matrices=False)
    space = right[:order].T
    return np.log(np.linalg.eigvals(np.linalg.pinv(space[:-1]) @ space[1:])) / h


def whirls(rates):
    """Complex signals of the radial motions, y + i z: poles above zero are forward, below backward."""
    v = rates[:, :]
    first = {"inner": Q.INNER, "outer": Q.OUTER}
    tilt = {"inner": Q.INNER + Q.INNER_BY, "outer": Q.OUTER + Q.BY}
    pairs = [first[ring] + Q.Y for ring in first] + [tilt[ring] for ring in tilt]
    return np.array([v[:, k] + 1j * v[:, k + 1] for k in pairs]).T
