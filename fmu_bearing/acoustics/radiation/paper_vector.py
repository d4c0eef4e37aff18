"""Radiation model ``paper_vector``: the multi-source paper's filters on vectors instead of magnitudes.

The paper forms |v| before its filters, which turns a sine into a constant and twice its frequency, and
leaves cos(theta) open. Here the same filters (its eqs. 17, 20, 29 and 40) act on the components of the
accelerations, each times the real direction cosine between its axis and the line from the bearing's centre
to the microphone: x / R for axial motion (the end face, eq. 27), -r sin(phi) / R and r cos(phi) / R for
motion along y and z (the mantle, eq. 36), the same for tilts (the point source of eq. 18 with eq. 19's
length). Spin has no cosine towards anything and is silent, as spin is. Everything adds as pressures; the
paper's energy sum is the output ``spl_energy_sum``. Radii equal those of the model ``paper``; all
bodies are bare.
"""

import numpy as np

from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.circle import (
    MicrophoneCircle,
    ball_paths,
    check_outside,
    tilt_paths,
    translation_paths,
)
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.paper_scalars import paper_scalars
from fmu_bearing.acoustics.radiation.radiators import Air, Path, Radiators


def paper_vector_paths(
    radiators: Radiators, air: Air, circle: MicrophoneCircle, harmonics: int
) -> list[Path]:
    """Paths to microphones on a circle.

    ``harmonics`` is the highest circumferential order among the channels; of it the orders 0 and 1 are used,
    because the paper places all balls in the bearing's centre.

    Raises
    ------
    ValueError
        When the circle runs through the bearing or its housing.
    """
    check_outside(radiators, circle)
    f, distance, flight = fit_frequencies(), circle.distance, circle.flight(air)
    along, across = circle.axial / distance, circle.radius / distance
    medium = (air.density, air.sound_speed)
    cosine, sine = circle.order(1)
    paths: list[Path] = []
    for body, ring in radiators.rings:
        mantle = across * sources.paper_cylinder_causal(f, distance, ring.outer / 2, *medium)
        face = along * sources.paper_piston(f, distance, ring.outer, ring.inner, *medium)
        point = across * sources.paper_point(f, distance, ring.outer / 2, *medium)
        point *= paper_scalars(radiators)[1 + body]
        paths += translation_paths(body, flight, face, mantle, circle)
        paths += tilt_paths(body, flight, point, (-sine, cosine))
    ball = sources.paper_ball(f, distance, radiators.ball_diameter / 2, *medium)
    responses = np.zeros((3, min(harmonics, 1) + 1, len(f)), dtype=complex)
    responses[0, 0] = along * ball
    if harmonics > 0:
        responses[1, 1] = responses[2, 1] = across * ball
    return paths + [path for path in ball_paths(responses, flight, circle) if np.any(path.response)]
