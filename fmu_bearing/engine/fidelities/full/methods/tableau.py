"""Coefficients of one Runge-Kutta method into one block of numbers, laid out as ``layout.tableau`` says."""

import numpy as np

from fmu_bearing.engine.layout import TAB

# The change over the last third of a step carries the remainders of two Newton iterations further than that
# over more of it. Counted from the end, the third stage serves the spindle under 1000 N best: error of its
# rings 1.3e-3, with the change over the whole step or between the last two stages 1.5e-3.
_CHANGE = 3


def tableau(gamma, order, rows, low):
    """Pack one method whose last stage is the new state.

    Parameters
    ----------
    gamma : float
        Diagonal entry of all stages but the first; zero makes the method explicit.
    order : int
        Order of the error estimate.
    rows : list of list of float
        Entries below the diagonal, one row per stage; the last row with the diagonal entry is the weights.
    low : list of float
        Weights of the embedded method that the error is estimated with.

    Returns
    -------
    numpy.ndarray
        The block, ``TAB.SIZE`` numbers; unused places are zero.
    """
    stages = len(rows)
    block = np.zeros(TAB.SIZE)
    block[TAB.COUNT], block[TAB.GAMMA], block[TAB.ORDER] = stages, gamma, order
    for i, row in enumerate(rows):
        block[TAB.NODES + i] = sum(row) + (gamma if i else 0.0)
        first = TAB.A + i * TAB.ROW
        block[first : first + len(row)] = row
    if gamma:  # an explicit stage is found without a guess
        nodes = block[TAB.NODES : TAB.NODES + stages]
        for i in range(2, stages):
            block[TAB.BEYOND + i] = (nodes[i] - nodes[i - 1]) / (nodes[i - 1] - nodes[i - 2])
    block[TAB.CHANGE_FROM] = max(stages - _CHANGE, 0)
    weights = np.array([*rows[-1], gamma])
    block[TAB.B : TAB.B + stages] = weights
    block[TAB.ERROR : TAB.ERROR + stages] = weights - np.array(low)
    return block
