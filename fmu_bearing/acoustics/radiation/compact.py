"""From the motion of each component to the pressure at a microphone: paths on plain numbers.

Everything here turns with the bearing axis: the transfer functions depend on a microphone's distance
from the axis and its place along it, its azimuth enters as cos(m phi) and sin(m phi) only. Microphones of
one circle therefore share their transfer functions and differ in weights.

Rung ``compact``: rings, cage and housing are dipoles (`effective`), balls are exact spheres on their orbit.
Its reach, from comparison with boundary elements: 1 dB up to 2 kHz for the 7003C and up to 1 kHz for the
7009C in the bearing plane, 6 and 4 kHz on the axis. Above, it over-reads: neither the rings' size nor
the shielding of balls and inner ring by the outer one is in it.

With a housing, the outer ring's motion radiates from the housing's skin; inner ring, cage and balls keep the
free field of their own, as if the housing's front were open. That is an upper bound (assumed).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.effective import cylinder_volumes, ring_volumes
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import BALLS, CAGE, INNER, OUTER, Air, Housing, Path, Radiators
from fmu_bearing.engine.layout import SD

_HOUSING_SLICES = 16  # dipoles along the housing: a tenth of its length apart is ample outside its skin
_ANGLES = 128  # source angles round the orbit: orders far above those kept


def compact_paths(
    radiators: Radiators, air: Air, radius: float, axial: float, azimuths: Sequence[float], harmonics: int
) -> list[Path]:
    """Paths of the rung ``compact`` to microphones on a circle, in the order of channels.

    Parameters
    ----------
    radius, axial
        Distance of the circle from the axis and place along it, m.
    azimuths
        Angles of its microphones from 12 o'clock in rad, growing with positive rotation about X.
    harmonics
        Highest circumferential order kept of the balls' sound.

    Raises
    ------
    ValueError
        When the circle runs through the bearing or its housing.
    """
    check_outside(radiators, radius, axial)
    angles = np.asarray(azimuths, dtype=float)
    rings = [(INNER, SD.C_INNER, radiators.inner_ring), (CAGE, SD.C_CAGE, radiators.cage)]
    paths = []
    if radiators.housing is None:
        rings.append((OUTER, SD.C_OUTER, radiators.outer_ring))
    else:
        axially, radially, flight = housing_responses(radiators.housing, air, radius, axial)
        paths += _body(OUTER, SD.C_OUTER, flight, axially, radially, angles)
    distance = np.hypot(radius, axial)
    for component, channel, ring in rings:
        if ring is not None:
            radial, along = ring_volumes(ring.outer, ring.inner, ring.width)
            f = fit_frequencies()
            axially = sources.compact_dipole(
                f, distance, axial / distance, along, air.density, air.sound_speed
            )
            radially = sources.compact_dipole(
                f, distance, radius / distance, radial, air.density, air.sound_speed
            )
            paths += _body(component, channel, distance / air.sound_speed, axially, radially, angles)
    paths += _balls(radiators, air, radius, axial, angles, harmonics)
    return sorted(paths, key=lambda path: path.channel)


def housing_responses(
    housing: Housing, air: Air, radius: float, axial: float
) -> tuple[NDArray[np.complex128], NDArray[np.complex128], float]:
    """Pressure per axial and per radial acceleration of a housing, and the flight time in s to take out.

    Dipoles are spread along the axis with a strength that totals the finite cylinder's effective volume,
    times the exact frequency dependence of a shaken infinite cylinder (radial) or of a sphere of the same
    radius (axial, fading out towards the axis, where the end face looks straight at the microphone). The
    mixture is ours (assumed). Against boundary elements for d100 x 160 mm at points 105 mm from the axis
    and 60 mm ahead of the front face: within 1.1 dB to 0.5 kHz and 5.5 dB to 4 kHz,
    but axial motion heard from beside over-reads above 2 kHz (10 dB at 3 kHz), where the true sound falls
    into a minimum.
    """
    f = fit_frequencies()
    volume_radial, volume_axial = cylinder_volumes(housing.diameter, housing.length)
    place = housing.centre + housing.length * ((np.arange(_HOUSING_SLICES) + 0.5) / _HOUSING_SLICES - 0.5)
    offset = axial - place[:, None]
    distance = np.hypot(radius, offset)
    medium = (air.density, air.sound_speed)
    share = 1.0 / _HOUSING_SLICES
    axially = sources.compact_dipole(f, distance, offset / distance, volume_axial * share, *medium).sum(
        axis=0
    )
    radially = sources.compact_dipole(f, distance, radius / distance, volume_radial * share, *medium).sum(
        axis=0
    )
    aside = radius**2 / (radius**2 + (axial - housing.centre) ** 2)
    sphere = sources.sphere_factor(f, housing.diameter / 2, air.sound_speed)
    axially *= 1.0 - aside + aside * sphere
    radially *= sources.cylinder_factor(f, housing.diameter / 2, air.sound_speed)
    nearest = np.hypot(radius, max(abs(axial - housing.centre) - housing.length / 2, 0.0))
    flight = 0.5 * (nearest + distance.max()) - 0.5 * housing.diameter
    return axially, radially, max(flight, 0.0) / air.sound_speed


def ball_harmonics(
    radiators: Radiators, air: Air, radius: float, axial: float, harmonics: int
) -> NDArray[np.complex128]:
    """Circumferential harmonics of a ball's sound, shape (3, harmonics + 1, frequencies).

    The exact field of an oscillating sphere on the pitch circle at angle theta, seen at angle phi, is a
    sum over m of these times cos m(phi - theta) for accelerations along x and r, and sin m(phi - theta)
    for accelerations along theta. Because the expansion holds for each moment of emission, fixed filters on
    the sums of a cos(m theta), a sin(m theta) give the moving ball exactly, Doppler effect included.
    """
    f = fit_frequencies()
    orbit = 0.5 * radiators.pitch_diameter
    angle = 2.0 * np.pi * np.arange(_ANGLES) / _ANGLES
    offset = np.stack([np.full(_ANGLES, axial), radius * np.cos(angle) - orbit, radius * np.sin(angle)])
    distance = np.sqrt((offset**2).sum(axis=0))
    result = np.empty((3, harmonics + 1, len(f)), dtype=complex)
    for k in range(3):
        cosine = (offset[k] / distance)[:, None]
        field = sources.oscillating_sphere(
            f, distance[:, None], cosine, radiators.ball_diameter / 2, air.density, air.sound_speed
        )
        for m in range(harmonics + 1):
            shape = np.sin(m * angle) if k == 2 else np.cos(m * angle)
            result[k, m] = (1.0 if m == 0 else 2.0) / _ANGLES * (shape @ field)
    return result


def _balls(
    radiators: Radiators, air: Air, radius: float, axial: float, azimuths: NDArray[np.float64], harmonics: int
) -> list[Path]:
    responses = ball_harmonics(radiators, air, radius, axial, harmonics)
    flight = float(np.hypot(radius, axial)) / air.sound_speed  # the rings' own, so that one bank serves all
    return ball_paths(responses, flight, azimuths)


def ball_paths(responses: NDArray[np.complex128], flight: float, azimuths: NDArray[np.float64]) -> list[Path]:
    """Paths of the balls from their circumferential harmonics, laid out as `ball_harmonics` returns them."""
    paths = []
    for m in range(responses.shape[1]):
        cosine, sine = np.cos(m * azimuths), np.sin(m * azimuths)
        for k in range(3):
            if m == 0 and k == 2:
                continue  # tangential accelerations alike all round make no sound
            first, second = (sine, -cosine) if k == 2 else (cosine, sine)
            channel = SD.C_BALLS + k if m == 0 else SD.C_BALLS + 2 + 6 * (m - 1) + 2 * k
            response = responses[k, m]
            paths.append(Path(BALLS, channel, flight, response, first, SD.BALLS_KIND))
            if m > 0:
                paths.append(Path(BALLS, channel + 1, flight, response, second, SD.BALLS_KIND))
    return paths


def _body(
    component: int,
    channel: int,
    flight: float,
    axially: NDArray[np.complex128],
    radially: NDArray[np.complex128],
    azimuths: NDArray[np.float64],
) -> list[Path]:
    """Three paths of a body of revolution moving as a whole: y is -r sin(phi), z is r cos(phi)."""
    return [
        Path(component, channel, flight, axially, np.ones(len(azimuths)), SD.AXIAL),
        Path(component, channel + 1, flight, radially, -np.sin(azimuths), SD.RADIAL),
        Path(component, channel + 2, flight, radially, np.cos(azimuths), SD.RADIAL),
    ]


def check_outside(radiators: Radiators, radius: float, axial: float) -> None:
    """Refuse a microphone inside the bearing or its housing.

    Raises
    ------
    ValueError
        With the place, in mm from the axis and along it.
    """
    ring, housing = radiators.outer_ring, radiators.housing
    where = f"microphone at {1e3 * radius:g} mm from the axis, {1e3 * axial:g} mm along it"
    if radius < ring.outer / 2 and abs(axial) < ring.width / 2:
        raise ValueError(f"{where}, lies inside the bearing")
    if (
        housing is not None
        and radius < housing.diameter / 2
        and (abs(axial - housing.centre) < housing.length / 2)
    ):
        raise ValueError(f"{where}, lies inside the housing")
