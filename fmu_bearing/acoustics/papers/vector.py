"""Rung ``paper_vector``: the multi-source paper's filters on vectors instead of magnitudes.

The paper forms |v| before its filters, which turns a sine into a constant and twice its frequency, and
leaves cos(theta) open. Here the same filters (its eqs. 17, 20, 29 and 40) act on the components of the
accelerations, each times the real direction cosine between its axis and the line from the bearing's centre
to the microphone: x / R for axial motion (the end face, eq. 27), -r sin(phi) / R and r cos(phi) / R for
motion along y and z (the mantle, eq. 36), the same for tilts (the point source of eq. 18 with eq. 19's
length). Spin has no cosine towards anything and is silent, as spin is. Everything adds as pressures; the
paper's energy sum is the output ``spl_energy_sum``. Radii are those of rung ``paper``; all bodies are bare.
"""

from collections.abc import Sequence

import numpy as np

from fmu_bearing.acoustics.papers.scalars import paper_scalars
from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.compact import ball_paths, check_outside
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import CAGE, INNER, OUTER, Air, Path, Radiators
from fmu_bearing.engine.layout import SD


def paper_vector_paths(
    radiators: Radiators, air: Air, radius: float, axial: float, azimuths: Sequence[float], harmonics: int
) -> list[Path]:
    """Paths to microphones on a circle, in the order of channels.

    Parameters
    ----------
    radius, axial
        Distance of the circle from the axis and place along it, m.
    azimuths
        Angles of its microphones from 12 o'clock in rad.
    harmonics
        Highest circumferential order among the channels; of it the orders 0 and 1 are used, because the
        paper places all balls in the bearing's centre.

    Raises
    ------
    ValueError
        When the circle runs through the bearing or its housing.
    """
    check_outside(radiators, radius, axial)
    f = fit_frequencies()
    distance = float(np.hypot(radius, axial))
    flight = distance / air.sound_speed
    along, across = axial / distance, radius / distance
    medium = (air.density, air.sound_speed)
    angles = np.asarray(azimuths, dtype=float)
    level, sine, cosine = np.ones(len(angles)), -np.sin(angles), np.cos(angles)
    paths = []
    bodies = ((INNER, radiators.inner_ring), (OUTER, radiators.outer_ring), (CAGE, radiators.cage))
    for body, (component, ring) in enumerate(bodies):
        if ring is None:
            continue
        mantle = across * sources.paper_cylinder_causal(f, distance, ring.outer / 2, *medium)
        face = along * sources.paper_piston(f, distance, ring.outer, ring.inner, *medium)
        point = across * sources.paper_point(f, distance, ring.outer / 2, *medium)
        point *= paper_scalars(radiators)[1 + body]
        tilt = SD.C_TILTS + 2 * body
        paths += [
            Path(component, 3 * body, flight, face, level, SD.AXIAL),
            Path(component, 3 * body + 1, flight, mantle, sine, SD.RADIAL),
            Path(component, 3 * body + 2, flight, mantle, cosine, SD.RADIAL),
            Path(component, tilt, flight, point, sine, SD.ROTATION),
            Path(component, tilt + 1, flight, point, cosine, SD.ROTATION),
        ]
    ball = sources.paper_ball(f, distance, radiators.ball_diameter / 2, *medium)
    responses = np.zeros((3, min(harmonics, 1) + 1, len(f)), dtype=complex)
    responses[0, 0] = along * ball
    if harmonics > 0:
        responses[1, 1] = responses[2, 1] = across * ball
    paths += [path for path in ball_paths(responses, flight, angles) if np.any(path.response)]
    return sorted(paths, key=lambda path: path.channel)
