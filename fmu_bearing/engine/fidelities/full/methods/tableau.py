"""Coefficients of one Runge-Kutta method into one block of numbers, laid out as ``layout.tableau`` says."""

import numpy as np

from fmu_bearing.engine.layout import TAB


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
    weights = np.array([*rows[-1], gamma])
    block[TAB.B : TAB.B + stages] = weights
    block[TAB.ERROR : TAB.ERROR + stages] = weights - np.array(low)
    return block
