"""Radiation model ``paper``: scalar sources of the multi-source paper.

All sources are in the bearing's centre (assumed: the paper leaves r open), cos(theta) = 1 (assumed), every
body bare whatever the scene says about the housing.
"""

import numpy as np

from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import BALLS, Air, Path, Radiators
from fmu_bearing.engine.layout import SD


def paper_paths(radiators: Radiators, air: Air, distance: float, count: int) -> list[Path]:
    """Paths of the radiation model ``paper`` to ``count`` microphones at one distance.

    Radii the paper leaves open (all assumed): r0 of balls and of their point source is D/2; a ring's or
    cage's point source, eq. 19 and cylinder use its outer radius; its piston uses its own two diameters. The
    cylinder keeps eq. 36's magnitude with a causal phase (`sources.paper_cylinder_causal`): levels, being
    energy sums, do not see the difference.
    """
    f = fit_frequencies()
    flight = distance / air.sound_speed
    weights = np.ones(count)
    medium = (air.density, air.sound_speed)
    paths = []
    for body, ring in radiators.rings:
        cylinder = sources.paper_cylinder_causal(f, distance, ring.outer / 2, *medium)
        point = sources.paper_point(f, distance, ring.outer / 2, *medium)
        piston = sources.paper_piston(f, distance, ring.outer, ring.inner, *medium)
        paths.append(Path(body, SD.C_CYLINDERS + body, flight, cylinder, weights, SD.RADIAL))
        paths.append(Path(body, SD.C_POINTS + body, flight, point, weights, SD.ROTATION))
        paths.append(Path(body, SD.C_PISTONS + body, flight, piston, weights, SD.AXIAL))
    ball = sources.paper_ball(f, distance, radiators.ball_diameter / 2, *medium)
    point = sources.paper_point(f, distance, radiators.ball_diameter / 2, *medium)
    for j in range(radiators.ball_count):
        channel = SD.C_PAPER_BALLS + SD.PAPER_BALL * j
        paths.append(Path(BALLS, channel, flight, ball, weights, SD.BALLS_KIND))
        paths.append(Path(BALLS, channel + 1, flight, point, weights, SD.BALLS_KIND))
    return paths


def paper_scalars(radiators: Radiators) -> tuple[float, float, float, float]:
    """Lengths of the paper's eq. 19: D/4, and half the radii of inner ring, outer ring, cage."""
    cage = 0.0 if radiators.cage is None else radiators.cage.outer
    return (
        radiators.ball_diameter / 4,
        radiators.inner_ring.outer / 4,
        radiators.outer_ring.outer / 4,
        cage / 4,
    )
