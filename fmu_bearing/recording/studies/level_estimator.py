"""Levels of many short runs of one bearing: paths to the microphones are made once for all of them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.field import Blocks, Circle, Position
from fmu_bearing.acoustics.filters.weighting import a_weighting_db
from fmu_bearing.recording.record import record
from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import PAPER_RUNS

RESOLUTION = 20.0  # Hz


class LevelEstimator:
    """Energies in bins at some places, of many runs through the paths of the first one.

    Parameters
    ----------
    places : sequence of (x, y, z)
        In m.
    radiation_model : str
        None of the papers'. All scenes must have the same bodies: paths depend on nothing else.
    weighting : str
        ``"A"`` or ``"Z"``.
    duration, settle : float
        Length (s) of each run that is measured, and of what is left out before it.

    Raises
    ------
    ValueError
        For a radiation model of the papers.
    """

    def __init__(
        self,
        places: Sequence[Position],
        radiation_model: str,
        weighting: str,
        duration: float = 0.1,
        settle: float = 0.03,
    ) -> None:
        check_model(radiation_model)
        self.places, self.radiation_model, self.weighting = places, radiation_model, weighting
        self.duration, self.settle = duration, settle
        self.frequency: NDArray[np.float64] = np.empty(0)
        self.doubts: dict[str, float] = {}  # largest values of `cautions.DOUBTS` in all runs
        self._circles: list[Circle] = []

    def spectrum(self, scene: Scene) -> NDArray[np.float64]:
        """Run a scene and return the mean square pressure (Pa^2), shape (mics, bins)."""
        made = record(
            scene,
            self.duration,
            settle=self.settle,
            progress=False,
            radiation_model="compact",
            outputs=(),
            warn=False,
        )
        self.doubts = {name: max(value, self.doubts.get(name, 0.0)) for name, value in made.doubts.items()}
        blocks = Blocks(made.channels, RESOLUTION)
        self.frequency = blocks.frequency
        self._circles = self._circles or made.paths(self.places, self.radiation_model)
        squares = np.zeros((len(self.places), len(blocks.frequency)))
        for circle in self._circles:
            squares[list(circle.members)] = blocks.mean_squares(circle)[""]
        if self.weighting == "A":
            squares *= 10.0 ** (a_weighting_db(blocks.frequency) / 10.0)
        return squares


def check_model(radiation_model: str) -> None:
    """Refuse the radiation models of the papers, which need channels of their own."""
    if radiation_model.startswith("paper"):
        raise ValueError(f'radiation_model = "{radiation_model}" {PAPER_RUNS.words()}')
