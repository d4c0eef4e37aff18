"""What was read in one band."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Band:
    """Rms velocity in one band, um/s, by loading piece and seed.

    Attributes
    ----------
    name : str
        ``"L"``, ``"M"`` or ``"H"``.
    low, high : float
        Ends, Hz.
    soft, firm : ndarray, shape (seeds,)
        With each loading piece.
    alone : dict of str to float
        Of each source alone, with the first seed on the soft piece.
    limit : float or None
        What it may be.
    """

    name: str
    low: float
    high: float
    soft: NDArray[np.float64]
    firm: NDArray[np.float64]
    alone: dict[str, float]
    limit: float | None

    @property
    def mean(self) -> float:
        """Mean over the seeds on the soft piece."""
        return float(self.soft.mean())
