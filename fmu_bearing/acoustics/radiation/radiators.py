"""What sounds, the air around it, and one way from a channel of motion to microphones, on plain numbers."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import SD

INNER, OUTER, CAGE, BALLS = range(4)


@dataclass(frozen=True)
class Ring:
    """A ring or cage: outer diameter, inner diameter, width in m."""

    outer: float
    inner: float
    width: float


@dataclass(frozen=True)
class Housing:
    """A closed cylinder about the bearing axis: diameter, length, place of its centre along X, in m.

    ``turned``: its open front looks towards +X, as round a mirrored bearing of a set. ``tilts``: model
    `compact` hears its tilts too. They move the middle of a set's housing, which may be far from the bearing
    whose motion it has; of a single bearing the model has translations alone.
    """

    diameter: float
    length: float
    centre: float
    turned: bool = False
    tilts: bool = False


@dataclass(frozen=True)
class Radiators:
    """What sounds, in m: the bearing centre is the origin, X its axis."""

    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    inner_ring: Ring
    outer_ring: Ring
    cage: Ring | None = None
    housing: Housing | None = None
    contact_angle: float = np.pi / 12  # rad; only the radiation model paper_contacts asks for it
    baffle: bool = False  # the face at -X lies flush in a rigid plane: only the model bem can
    turned: bool = False  # that face is the one at +X, as of a mirrored bearing of a set
    shaft: bool = False  # fills the inner ring's bore: only the model bem knows it

    @property
    def rings(self) -> list[tuple[int, Ring]]:
        """Inner ring, outer ring, and the cage if there is one, each behind its component's number."""
        known = ((INNER, self.inner_ring), (OUTER, self.outer_ring), (CAGE, self.cage))
        return [(body, ring) for body, ring in known if ring is not None]


@dataclass(frozen=True)
class Air:
    """Density in kg/m3 and sound speed in m/s."""

    density: float = 1.225
    sound_speed: float = 340.0


@dataclass(frozen=True)
class Path:
    """One channel's way to the microphones of one circle.

    ``response`` is pressure per channel at `fit_frequencies`, flight time included; ``flight`` the time in s
    to take out before the fit; ``weights`` one factor per microphone; ``kind`` the source type, a place in
    ``engine.layout.sound_filters.KINDS``; ``bearing`` which one of a set radiates, from 0.
    """

    component: int
    channel: int
    flight: float
    response: NDArray[np.complex128]
    weights: NDArray[np.float64]
    kind: int = SD.RADIAL
    bearing: int = 0
