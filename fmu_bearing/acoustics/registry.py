"""The radiation models: which paths each takes from the engine's channels to microphones."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fmu_bearing.acoustics.radiation.bem.paths import bem_paths
from fmu_bearing.acoustics.radiation.circle import MicrophoneCircle
from fmu_bearing.acoustics.radiation.compact import compact_paths
from fmu_bearing.acoustics.radiation.paper_contacts import contact_paths
from fmu_bearing.acoustics.radiation.paper_scalars import paper_paths, paper_scalars
from fmu_bearing.acoustics.radiation.paper_vector import paper_vector_paths
from fmu_bearing.acoustics.radiation.radiators import Air, Path, Radiators
from fmu_bearing.acoustics.radiation.table import Table, table_paths
from fmu_bearing.engine.choices import RADIATION_MODELS, ChannelForm
from fmu_bearing.engine.layout import SD
from fmu_bearing.scene.exclusions import RIGID_PLANE

Position = tuple[float, float, float]

_SAME_PLACE = 9  # decimals of a metre within which microphones share filters


@dataclass(frozen=True)
class Radiation:
    """What paths depend on besides the microphones.

    Attributes
    ----------
    model : str
        Radiation model, one of `choices.RADIATION_MODELS`.
    radiators : Radiators
    air : Air
    harmonics : int
        Highest circumferential order of the balls' sound.
    modes : sequence
        Flexural modes of the rings, two channels each.
    plane : float, optional
        Place of a rigid plane along the axis in m.
    table : Table, optional
        For the radiation model ``table``: its microphones in the scene's order.

    Raises
    ------
    ValueError
        When there is no such model, or it does not serve the rest.
    """

    model: str
    radiators: Radiators
    air: Air = field(default_factory=Air)
    harmonics: int = 4
    modes: Sequence[Any] = ()
    plane: float | None = None
    table: Table | None = None

    def __post_init__(self) -> None:
        recipe_of(self.model)
        if self.model == "table" and self.table is None:
            raise ValueError('sound.radiation_model = "table" needs a table: give sound.table_file')
        if self.model != "bem" and (self.plane is not None or self.radiators.baffle):
            raise ValueError(f'sound.radiation_model = "{self.model}" {RIGID_PLANE.words()}')

    @property
    def form(self) -> ChannelForm:
        """How the engine forms the channels."""
        return RECIPES[self.model].form

    @property
    def channels(self) -> int:
        """Number of channels."""
        if self.form == "scalars":
            return SD.scalar_channels(self.radiators.ball_count)
        if self.form == "contacts":
            return SD.contact_channels(self.harmonics)
        return SD.vector_channels(self.harmonics, 2 * len(self.modes))

    @property
    def balls(self) -> int:
        """Number of balls."""
        return self.radiators.ball_count

    @property
    def scalars(self) -> list[float]:
        """Numbers that the papers' models form their channels with: `SD.SCALAR_BALL` and so on."""
        angle, orbit = self.radiators.contact_angle, 0.5 * self.radiators.pitch_diameter
        return [*paper_scalars(self.radiators), float(np.sin(angle)), float(np.cos(angle)), orbit]

    def circles(self, microphones: Sequence[Position]) -> list[list[int]]:
        """Return indices of microphones that share their transfer functions."""
        shared = RECIPES[self.model].shared
        groups: dict[tuple[float, ...], list[int]] = {}
        for i, position in enumerate(microphones):
            place = (float(i),) if shared is None else shared(*position)
            groups.setdefault(tuple(round(float(v), _SAME_PLACE) for v in place), []).append(i)
        return list(groups.values())

    def paths(self, microphones: Sequence[Position], members: Sequence[int]) -> list[Path]:
        """Paths to the microphones ``members``, which share filters, in the order of channels.

        Raises
        ------
        ValueError
            When a microphone lies inside a body, or the table does not serve.
        """
        paths = RECIPES[self.model].paths(self, microphones, members)
        return sorted(paths, key=lambda path: path.channel)


_Maker = Callable[[Radiation, Sequence[Position], Sequence[int]], list[Path]]


@dataclass(frozen=True)
class Recipe:
    """How one radiation model gets from channels to microphones.

    Attributes
    ----------
    form : str
        How the engine forms its channels, see `choices.CHANNEL_FORMS`.
    shared : callable, optional
        What microphones that share filters have in common, from (x, y, z) in m; none share without it.
    paths : callable
        Makes the paths to the microphones that share filters: from a `Radiation`, all positions, and the
        indices of these.
    """

    form: ChannelForm
    shared: Callable[[float, float, float], tuple[float, ...]] | None
    paths: _Maker


def recipe_of(model: str) -> Recipe:
    """Return how a radiation model works.

    Raises
    ------
    ValueError
        When there is no such model.
    """
    if model not in RECIPES:
        raise ValueError(f"sound.radiation_model must be one of {', '.join(RADIATION_MODELS)}, not {model!r}")
    return RECIPES[model]


def _distance(x: float, y: float, z: float) -> tuple[float, ...]:
    return (np.hypot(np.hypot(y, z), x),)


def _circle(x: float, y: float, z: float) -> tuple[float, ...]:
    return np.hypot(y, z), x


def _circle_of(microphones: Sequence[Position], members: Sequence[int]) -> MicrophoneCircle:
    """Return the circle that the microphones ``members`` are on."""
    x, y, z = microphones[members[0]]
    azimuths = [float(np.arctan2(-microphones[i][1], microphones[i][2])) for i in members]
    return MicrophoneCircle(float(np.hypot(y, z)), float(x), azimuths)


def _on_circle(make: Callable[[Radiators, Air, MicrophoneCircle, int], list[Path]]) -> _Maker:
    def paths(radiation: Radiation, microphones: Sequence[Position], members: Sequence[int]) -> list[Path]:
        circle = _circle_of(microphones, members)
        return make(radiation.radiators, radiation.air, circle, radiation.harmonics)

    return paths


def _scalars(radiation: Radiation, microphones: Sequence[Position], members: Sequence[int]) -> list[Path]:
    distance = float(np.linalg.norm(microphones[members[0]]))
    return paper_paths(radiation.radiators, radiation.air, distance, len(members))


def _elements(radiation: Radiation, microphones: Sequence[Position], members: Sequence[int]) -> list[Path]:
    circle = _circle_of(microphones, members)
    modes = tuple(radiation.modes)
    return bem_paths(
        radiation.radiators, radiation.air, circle, radiation.harmonics, modes=modes, plane=radiation.plane
    )


def _table(radiation: Radiation, microphones: Sequence[Position], members: Sequence[int]) -> list[Path]:
    assert radiation.table is not None
    bodies = [mode.body for mode in radiation.modes for _ in range(2)]
    return table_paths(radiation.table, members[0], radiation.harmonics, bodies)


#: Every radiation model: channels, what microphones that share filters have in common, maker of paths.
RECIPES: dict[str, Recipe] = {
    "paper": Recipe("scalars", _distance, _scalars),
    "paper_vector": Recipe("vectors", _circle, _on_circle(paper_vector_paths)),
    "paper_contacts": Recipe("contacts", _circle, _on_circle(contact_paths)),
    "compact": Recipe("vectors", _circle, _on_circle(compact_paths)),
    "bem": Recipe("vectors", _circle, _elements),
    "table": Recipe("vectors", None, _table),
}
