"""The linear operator of fidelities `rings` and `response` as one matrix: x' = A x.

About the point that they hold, for equal ball loads: what `condensed.operator` has found in the engine,
beside the condensed balls. It holds the cage as it runs there, whirling and pressed against the balls, which
`linearised` leaves out; without a cage both have the same modes.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.fidelities.condensed.families import family_size, member, side
from fmu_bearing.engine.layout import SP, L, S, U
from fmu_bearing.engine.spindle import members
from fmu_bearing.modal.equations.shaft import matrices, rows_of
from fmu_bearing.scene.read import Scene, with_fidelity


def quick_run(scene: Scene, inputs: dict[int, float] | None = None) -> Arrays:
    """Return a quiet scene in fidelity `rings`, initialised.

    ``inputs``: values by their places in the engine's ``u``, in place of the scene's.
    """
    quiet = with_fidelity(scene, model="rings").model_copy(update={"sound": None, "imperfections": None})
    return Arrays.of(quiet.with_rigid_rings()).at(inputs or {}).init()


def engine_growth(run: Arrays) -> tuple[float, float]:
    """Return frequency (Hz) and growth (1/s) of the motion that the engine has found to grow most; 0: none.

    That of ``solver.growth``, see `engine.fidelities.rings.growth`.
    """
    at = members.march(run.p) + SP.RATE_KNOWN
    growth, omega = members.set_state(run.p, run.s)[at : at + 2]
    return float(omega) / (2.0 * math.pi), float(growth)


def operator_matrix(run: Arrays) -> NDArray[np.float64]:
    """Return A of an initialised model of fidelity `rings` or `response`, shape (m, m), SI units.

    States: displacements of the n coordinates (of a single bearing the rings' 11, of a set those of shaft and
    housing), their rates, then modes of balls and cage of each bearing, real and imaginary parts.
    """
    if not SP.has_shaft(run.p):
        none, own = np.zeros((L.N, L.N)), np.eye(L.N)
        return _assembled([run.s[S.CONDENSED :][: L.SIZE]], [own], [np.ones(L.N)], none, none, own)
    shaft = matrices(run, float(run.u[U.SPEED]))
    blocks, motions, inertia = [], [], []
    for row in rows_of(run.p):
        blocks.append(run.s[int(row[SP.ROW_S]) :][S.CONDENSED :][: L.SIZE])
        table = run.p[int(row[SP.ROW_AT_T]) :][: shaft.count * SP.LANES]
        motions.append(table.reshape(shaft.count, SP.LANES)[:, : L.N].T)
        inertia.append(row[SP.ROW_MASS : SP.ROW_MASS + L.N])
    return _assembled(blocks, motions, inertia, shaft.stiffness, shaft.damping, shaft.inverse)


def _assembled(
    blocks: list[NDArray[np.float64]],
    motions: list[NDArray[np.float64]],
    inertia: list[NDArray[np.float64]],
    stiffness: NDArray[np.float64],
    damping: NDArray[np.float64],
    inverse: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return A of bearings whose rings move as ``motions`` of the coordinates, with masses ``inertia``.

    The other matrices are the coordinates' own: ``inverse`` of their mass.
    """
    n = motions[0].shape[1]
    sizes = [2 * int(lv[L.OPERATOR : L.OPERATOR + 2].sum()) for lv in blocks]
    matrix = np.zeros((2 * n + sum(sizes), 2 * n + sum(sizes)))
    places, rates = slice(0, n), slice(n, 2 * n)
    matrix[places, rates] = np.eye(n)
    matrix[rates, places], matrix[rates, rates] = -stiffness, -damping
    begin = 2 * n
    for lv, motion, mass, size in zip(blocks, motions, inertia, sizes, strict=True):
        own = slice(begin, begin + size)
        by_place, by_rate, modes, into, out = _bearing(lv)
        force = motion.T * mass
        matrix[rates, places] += force @ by_place @ motion
        matrix[rates, rates] += force @ by_rate @ motion
        matrix[rates, own] += force @ out
        matrix[own, places] += into[0] @ motion
        matrix[own, rates] += into[1] @ motion
        matrix[own, own] = modes
        begin += size
    matrix[rates] = inverse @ matrix[rates]
    return matrix


def _bearing(lv: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Return accelerations of the rings by places and rates, the modes, what drives them, what they do."""

    def table(at: int) -> NDArray[np.float64]:
        return np.asarray(lv[at : at + L.MATRIX].reshape(L.N, L.COLUMN)[:, : L.N].T)

    def row(at: int, count: int) -> NDArray[np.complex128]:
        return np.asarray(lv[at : at + count] + 1j * lv[at + L.MODES : at + L.MODES + count])

    counts = [int(count) for count in lv[L.OPERATOR : L.OPERATOR + 2]]
    total = 2 * sum(counts)
    modes, into, out = np.zeros((total, total)), np.zeros((2, total, L.N)), np.zeros((L.N, total))
    begin = 0
    for family, count in enumerate(counts):
        f = L.FAMILY + family * L.FAMILY_SIZE
        re, im = slice(begin, begin + count), slice(begin + count, begin + 2 * count)
        value = row(f + L.VALUE, count)
        modes[re, re] = modes[im, im] = np.diag(value.real)
        modes[re, im], modes[im, re] = -np.diag(value.imag), np.diag(value.imag)
        for b in range(family_size(family)):
            planes = [(member(family, 0, b), 1.0)]
            if family == 1:
                planes.append((member(1, 1, b), 1j * side(1, b)))
            pushed = row(f + L.OUT + b * L.COMPLEX, count)
            for k, turned in planes:
                for rate, at in enumerate((L.IN_PLACE, L.IN_RATE)):
                    driven = turned * row(f + at + b * L.COMPLEX, count)
                    into[rate][re, k], into[rate][im, k] = driven.real, driven.imag
                # the coordinate is the part of the sum along its own plane
                part = np.conj(turned) * pushed
                out[k, re], out[k, im] = part.real, -part.imag
        begin += 2 * count
    return table(L.JX) + table(L.FEEDTHROUGH_PLACE), table(L.JV) + table(L.FEEDTHROUGH_RATE), modes, into, out
