"""What was read in one band."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.results.base import Result


@dataclass(frozen=True)
class Band(Result):
    """Rms velocity in one band, um/s, by loading piece and seed."""

    quantities = (
        "low_Hz", "high_Hz", "mean_um_s", "soft_um_s", "firm_um_s", "limit_um_s", "alone_um_s",
    )  # fmt: skip

    name: str
    """``"L"``, ``"M"`` or ``"H"``."""
    low: float
    high: float
    """Ends, Hz."""
    soft: NDArray[np.float64]
    firm: NDArray[np.float64]
    """With each loading piece. Shape (seeds,)."""
    alone: dict[str, float]
    """Of each source alone, with the first seed on the soft piece."""
    limit: float | None
    """What it may be."""

    @property
    def mean(self) -> float:
        """Mean over the seeds on the soft piece."""
        return float(self.soft.mean())
