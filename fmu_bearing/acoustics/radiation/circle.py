"""Microphones on one circle about the bearing axis, and the paths that all radiation models share there.

Bodies of revolution: their transfer functions depend on a microphone's distance from the axis and its place
along it, its azimuth phi enters as cos(m phi) and sin(m phi) only. Microphones of one circle therefore share
their transfer functions and differ in weights.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.radiators import BALLS, Air, Path, Radiators
from fmu_bearing.engine.layout import SD

#: m: a microphone nearer to a body than this is on it, where fields of surface sources are singular.
SKIN = 1e-6


@dataclass(frozen=True)
class MicrophoneCircle:
    """Microphones on one circle about the bearing axis.

    Attributes
    ----------
    radius, axial : float
        Distance of the circle from the axis and place along it, m.
    azimuths : sequence of float
        Angles of its microphones from 12 o'clock in rad, growing with positive rotation about X.
    """

    radius: float
    axial: float
    azimuths: Sequence[float]

    @property
    def distance(self) -> float:
        """From the bearing's centre, m."""
        return float(np.hypot(self.radius, self.axial))

    @property
    def words(self) -> str:
        """Where it is, for messages."""
        return f"microphone at {1e3 * self.radius:g} mm from the axis, {1e3 * self.axial:g} mm along it"

    def flight(self, air: Air) -> float:
        """Time in s that sound takes from the bearing's centre."""
        return self.distance / air.sound_speed

    def uniform(self) -> NDArray[np.float64]:
        """Weights of what sounds the same all round."""
        return np.ones(len(self.azimuths))

    def order(self, m: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Weights cos(m phi), sin(m phi)."""
        angles = np.asarray(self.azimuths, dtype=float)
        return np.cos(m * angles), np.sin(m * angles)


def translation_paths(
    body: int,
    flight: float,
    axially: NDArray[np.complex128],
    radially: NDArray[np.complex128],
    circle: MicrophoneCircle,
) -> list[Path]:
    """Three paths of a body of revolution that moves as a whole: y is -r sin(phi), z is r cos(phi)."""
    channel = SD.c_body(body)
    cosine, sine = circle.order(1)
    return [
        Path(body, channel, flight, axially, circle.uniform(), SD.AXIAL),
        Path(body, channel + 1, flight, radially, -sine, SD.RADIAL),
        Path(body, channel + 2, flight, radially, cosine, SD.RADIAL),
    ]


def tilt_paths(
    body: int,
    flight: float,
    response: NDArray[np.complex128],
    weights: tuple[NDArray[np.float64], NDArray[np.float64]],
) -> list[Path]:
    """Two paths of a body that tilts about y and z, with the weights of either."""
    channel = SD.c_tilt(body, 0)
    return [Path(body, channel + k, flight, response, weights[k], SD.ROTATION) for k in range(SD.TILTS)]


def ball_paths(responses: NDArray[np.complex128], flight: float, circle: MicrophoneCircle) -> list[Path]:
    """Paths of the balls from their circumferential harmonics.

    Parameters
    ----------
    responses : ndarray, shape (3, harmonics + 1, frequencies)
        As `compact.ball_harmonics` returns them.
    flight : float
        Time in s to take out before the fit.
    circle : MicrophoneCircle
    """
    paths = []
    for m in range(responses.shape[1]):
        cosine, sine = circle.order(m)
        for axis in range(SD.AXES):
            if m == 0 and axis == 2:
                continue  # equal tangential accelerations all round make no sound
            first, second = (sine, -cosine) if axis == 2 else (cosine, sine)
            channel, response = SD.c_ball(m, axis), responses[axis, m]
            paths.append(Path(BALLS, channel, flight, response, first, SD.BALLS_KIND))
            if m > 0:
                paths.append(Path(BALLS, channel + 1, flight, response, second, SD.BALLS_KIND))
    return paths


def check_outside(radiators: Radiators, circle: MicrophoneCircle) -> None:
    """Refuse microphones on or inside the bearing or its housing.

    Raises
    ------
    ValueError
        With the place, in mm from the axis and along it.
    """
    ring, housing = radiators.outer_ring, radiators.housing
    bodies = [("bearing", ring.outer / 2, 0.0, ring.width / 2)]
    if housing is not None:
        bodies.append(("housing", housing.diameter / 2, housing.centre, housing.length / 2))
    for name, radius, centre, half in bodies:
        depth = min(radius - circle.radius, half - abs(circle.axial - centre))
        if depth > -SKIN:
            raise ValueError(
                f"{circle.words}, lies {'inside' if depth > SKIN else 'on'} the {name}, which reaches to "
                f"r = {1e3 * radius:g} mm from x = {1e3 * (centre - half):g} to {1e3 * (centre + half):g} "
                "mm: move it out of these"
            )
