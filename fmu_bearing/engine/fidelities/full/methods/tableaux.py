"""Tableaux of the Runge-Kutta methods: explicit first stage, one diagonal entry, last stage at the new state.

One block of ``SIZE`` numbers per method: number of stages, diagonal entry, order of the error estimate, six
nodes, the rows below the diagonal (five numbers each), six weights, six differences to the weights of the
embedded method. Unused places are zero. A diagonal entry of zero makes the method explicit.
"""

import math

import numpy as np

T_STAGES, T_GAMMA, T_ORDER, T_NODES, T_A = 0, 1, 2, 3, 9
T_B = T_A + 30
T_ERROR = T_B + 6
SIZE = T_ERROR + 6
ESDIRK4, TRBDF2, RK4 = 0, SIZE, 2 * SIZE


def _tableau(gamma, order, rows, low):
    """Pack one method; the last row with the diagonal entry is the weights."""
    stages = len(rows)
    block = np.zeros(SIZE)
    block[T_STAGES], block[T_GAMMA], block[T_ORDER] = stages, gamma, order
    for i, row in enumerate(rows):
        block[T_NODES + i] = sum(row) + (gamma if i else 0.0)
        block[T_A + 5 * i : T_A + 5 * i + len(row)] = row
    weights = np.array([*rows[-1], gamma])
    block[T_B : T_B + stages] = weights
    block[T_ERROR : T_ERROR + stages] = weights - np.array(low)
    return block


def _esdirk4():
    """Implicit part of ARK4(3)6L[2]SA: Kennedy and Carpenter (2003), appendix C."""
    return _tableau(
        0.25,
        4,
        [
            [],
            [1 / 4],
            [8611 / 62500, -1743 / 31250],
            [5012029 / 34652500, -654441 / 2922500, 174375 / 388108],
            [15267082809 / 155376265600, -71443401 / 120774400, 730878875 / 902184768, 2285395 / 8070912],
            [82889 / 524892, 0.0, 15625 / 83664, 69875 / 102672, -2260 / 8211],
        ],
        [
            4586570599 / 29645900160,
            0.0,
            178811875 / 945068544,
            814220225 / 1159782912,
            -3700637 / 11593932,
            61727 / 225920,
        ],
    )


def _trbdf2():
    """TR-BDF2 with its third-order companion: Bank et al. (1985); Hosea and Shampine (1996)."""
    diagonal = 1.0 - math.sqrt(2.0) / 2.0
    weight = math.sqrt(2.0) / 4.0
    return _tableau(
        diagonal,
        3,
        [[], [diagonal], [weight, weight]],
        [(1.0 - weight) / 3.0, (3.0 * weight + 1.0) / 3.0, diagonal / 3.0],
    )


def _rk4():
    """Classical Runge-Kutta method; the first stage of the next step gives a third-order companion."""
    return _tableau(
        0.0,
        4,
        [[], [0.5], [0.0, 0.5], [0.0, 0.0, 1.0], [1 / 6, 1 / 3, 1 / 3, 1 / 6]],
        [1 / 6, 1 / 3, 1 / 3, 0.0, 1 / 6],
    )


TABLEAUX = np.concatenate([_esdirk4(), _trbdf2(), _rk4()])
