"""A bearing from its boundary dimensions, with rules of thumb for the dimensions that catalogues leave out.

Each rule names the bearings it was derived from, and their scatter. All its values are assumed.

Ball and number of balls: against NSK's 60 sizes of series 70 and 79 (`fmu_bearing.scene.nsk`), whose balls
follow from printed ratings, 0.29 of outside diameter minus bore is off by 4.0 % rms (0.25 to 0.31 occur;
0.27, the rule before, was off by 7.5 %), and three quarters of a full circle by 7.7 % rms, 3 balls at
most. Conformities 0.52 and 0.525: against 240 axial stiffnesses of pairs that NSK prints, with these balls,
the median is 1.01, rms 2.7 % (0.515 and 0.52, the rule before: 1.10, 11 %).
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.bearing import most_balls

_BALL = 0.29


class Estimate(NamedTuple):
    """A value for a key of ``[bearing]`` or ``[bearing.cage]``, and the rule it comes from."""

    key: str
    value: float | int
    rule: str


def estimates(bore: float, outside: float, width: float, angle: float) -> Iterator[Estimate]:
    """Yield the values of ``[bearing]`` for these dimensions.

    Parameters
    ----------
    bore, outside, width : float
        Boundary dimensions (mm).
    angle : float
        Contact angle (deg).

    Raises
    ------
    SceneError
        For dimensions that leave no room for balls.
    """
    if not 0.0 < bore < outside or not width > 0.0:
        raise SceneError(
            f"bore {bore:g}, outside diameter {outside:g} and width {width:g} mm: the outside diameter must "
            "exceed the bore, and all must be positive"
        )
    ball = round(_BALL * (outside - bore), 3)
    pitch = 0.5 * (bore + outside)
    land = 0.7 * ball
    yield Estimate("pitch_diameter_mm", pitch, "mean of bore and outside diameter")
    yield Estimate(
        "ball_diameter_mm",
        ball,
        f"{_BALL} of outside diameter minus bore; series 70 and 79 have 0.26 to 0.31",
    )
    yield Estimate(
        "ball_count", math.floor(0.75 * most_balls(pitch, ball)), "three quarters of a full circle of balls"
    )
    yield Estimate("contact_angle_deg", angle, "")
    yield Estimate("inner_conformity", 0.52, "agrees with makers' printed stiffness of pairs")
    yield Estimate("outer_conformity", 0.525, "agrees with makers' printed stiffness of pairs")
    yield Estimate("inner_ring_outer_diameter_mm", round(pitch - land, 2), "0.7 ball diameters below pitch")
    yield Estimate("outer_ring_inner_diameter_mm", round(pitch + land, 2), "0.7 ball diameters above pitch")
    yield Estimate("contact_damping_us", 2.5, "Kraemer (1993): 2.5 to 25 us")
    yield Estimate("race_roughness_um", 0.02, "fine honing")
    yield Estimate("ball_roughness_um", 0.01, "grade 5 or better")


def cage_estimates(
    bore: float, outside: float, width: float, ball: float | None = None
) -> Iterator[Estimate]:  # fmt: skip
    """Yield the values of ``[bearing.cage]`` for these dimensions (mm); ``ball``: its diameter, if known."""
    if ball is None:
        ball = _BALL * (outside - bore)
    pitch = 0.5 * (bore + outside)
    yield Estimate("outside_diameter_mm", round(pitch + 0.38 * ball, 2), "0.38 ball diameters above pitch")
    yield Estimate("bore_mm", round(pitch - 0.55 * ball, 2), "0.55 ball diameters below pitch")
    yield Estimate("width_mm", round(0.9 * width, 2), "0.9 of the rings' width")
    yield Estimate("pocket_diameter_mm", round(1.02 * ball, 3), "2 % larger than a ball")
    yield Estimate("land_clearance_mm", round(0.025 + 0.001 * bore, 3), "25 um and 1 um per mm of bore")
    yield Estimate("mass_eccentricity_um", 5.0, "")
    yield Estimate("pocket_damping_N_s_m", 0.02, "")
    yield Estimate("pocket_friction", 0.05, "")
