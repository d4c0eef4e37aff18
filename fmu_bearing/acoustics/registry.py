"""The rungs of the sound ladder: which paths lead from the engine's channels to microphones.

===================  =======================  ==========================================
rung                 channels                 microphones that share filters
===================  =======================  ==========================================
``paper``            printed scalars          those at one distance from the centre
``paper_vector``     accelerations            those on one circle about the axis
``paper_contacts``   rates at the contacts    those on one circle about the axis
``compact``          accelerations            those on one circle about the axis
``bem``              accelerations            those on one circle about the axis
``table``            accelerations            none
===================  =======================  ==========================================
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fmu_bearing.acoustics.papers.contacts import contact_paths
from fmu_bearing.acoustics.papers.scalars import paper_paths
from fmu_bearing.acoustics.papers.vector import paper_vector_paths
from fmu_bearing.acoustics.radiation.bem.paths import bem_paths
from fmu_bearing.acoustics.radiation.compact import compact_paths
from fmu_bearing.acoustics.radiation.radiators import Air, Path, Radiators
from fmu_bearing.acoustics.radiation.table import Table, table_paths
from fmu_bearing.engine.choices import CONTACTS, SCALARS, VECTORS
from fmu_bearing.engine.layout import SD

Position = tuple[float, float, float]

RUNGS = ("paper", "paper_vector", "paper_contacts", "compact", "bem", "table")
_SAME_PLACE = 9  # decimals of a metre within which microphones share a circle


@dataclass(frozen=True)
class Ladder:
    """What paths depend on besides the microphones.

    ``modes``: elastic modes of the rings, two channels each; ``plane``: place of a rigid plane along the axis
    in m; ``table``: for the rung ``table``, its microphones in the scene's order.
    """

    rung: str
    radiators: Radiators
    air: Air = field(default_factory=Air)
    harmonics: int = 4
    modes: Sequence[Any] = ()
    plane: float | None = None
    table: Table | None = None

    def __post_init__(self) -> None:
        if self.rung not in RUNGS:
            raise ValueError(f"rung must be one of {', '.join(RUNGS)}, not {self.rung!r}")
        if self.rung == "table" and self.table is None:
            raise ValueError('rung "table" needs a table: give sound.table_file')
        if self.rung != "bem" and (self.plane is not None or self.radiators.baffle):
            raise ValueError(f'a baffle or a reflecting plane needs rung "bem", not {self.rung!r}')

    @property
    def form(self) -> int:
        """How the engine forms the channels."""
        return {"paper": SCALARS, "paper_contacts": CONTACTS}.get(self.rung, VECTORS)

    @property
    def channels(self) -> int:
        """Number of channels."""
        if self.form == SCALARS:
            return SD.scalar_channels(self.radiators.ball_count)
        if self.form == CONTACTS:
            return SD.contact_channels(self.harmonics)
        return SD.vector_channels(self.harmonics, 2 * len(self.modes))

    def circles(self, microphones: Sequence[Position]) -> list[list[int]]:
        """Return indices of microphones that share their transfer functions."""
        if self.rung == "table":
            return [[i] for i in range(len(microphones))]
        groups: dict[tuple[float, ...], list[int]] = {}
        for i, (x, y, z) in enumerate(microphones):
            across = np.hypot(y, z)
            place = (np.hypot(across, x),) if self.rung == "paper" else (across, x)
            groups.setdefault(tuple(round(float(v), _SAME_PLACE) for v in place), []).append(i)
        return list(groups.values())

    def paths(self, microphones: Sequence[Position], members: Sequence[int]) -> list[Path]:
        """Paths to the microphones of one circle.

        Raises
        ------
        ValueError
            When a microphone lies inside a body, or the table does not serve.
        """
        x, y, z = microphones[members[0]]
        if self.rung == "paper":
            return paper_paths(self.radiators, self.air, float(np.linalg.norm((x, y, z))), len(members))
        if self.table is not None:
            bodies = [mode.body for mode in self.modes for _ in range(2)]
            return table_paths(self.table, members[0], self.harmonics, bodies)
        azimuths = [float(np.arctan2(-microphones[i][1], microphones[i][2])) for i in members]
        place = (self.radiators, self.air, float(np.hypot(y, z)), float(x), azimuths, self.harmonics)
        if self.rung == "bem":
            return bem_paths(*place, modes=tuple(self.modes), plane=self.plane)
        return _CIRCLES[self.rung](*place)


#: Rungs whose microphones on one circle share filters, with what makes their paths.
_CIRCLES = {"paper_vector": paper_vector_paths, "paper_contacts": contact_paths, "compact": compact_paths}
