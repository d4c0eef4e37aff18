"""Kinematics of a ball between a turning inner and a standing outer race.

The ball's absolute angular velocity is ``w = w_c e_x + w_s (-cos(beta) e_x + sin(beta) e_r)``: the orbit plus
a spin w_s about an axis pitched by beta, seen from the orbiting frame. The minus sign is the trap: against a
turning inner ring the ball spins backwards, so with both numbers positive the spin points to -X.
"""

from dataclasses import dataclass
from math import atan2, cos, pi, sin


@dataclass(frozen=True)
class DefectFrequencies:
    """Frequencies in Hz: rotation, ball (BSF), cage (FTF), inner race (BPFI), outer race (BPFO)."""

    rotation: float
    ball: float
    cage: float
    inner: float
    outer: float


def defect_frequencies(
    rotation: float, ball_diameter: float, pitch_diameter: float, ball_count: int, contact_angle: float
) -> DefectFrequencies:
    """Frequencies of the multi-source paper's eq. 47 for a rotation frequency in Hz and one contact angle."""
    gamma = ball_diameter / pitch_diameter * cos(contact_angle)
    return DefectFrequencies(
        rotation=rotation,
        ball=0.5 * rotation * pitch_diameter / ball_diameter * (1.0 - gamma**2),
        cage=0.5 * rotation * (1.0 - gamma),
        inner=0.5 * ball_count * rotation * (1.0 + gamma),
        outer=0.5 * ball_count * rotation * (1.0 - gamma),
    )


def cage_ratio(ball_diameter: float, pitch_diameter: float, inner_angle: float, outer_angle: float) -> float:
    """Cage speed over shaft speed with one angle, the mean of both contacts' (Harris' simple formula)."""
    return 0.5 * (1.0 - ball_diameter / pitch_diameter * cos(0.5 * (inner_angle + outer_angle)))


def rolling(
    speed: float,
    ball_diameter: float,
    centre_radius: float,
    inner_angle: float,
    outer_angle: float,
    pitch: float,
) -> tuple[float, float]:
    """Orbit speed w_c and spin w_s (rad/s, spin seen from the orbit) that leave no rolling slip.

    Written out along e_t, with the ball point at -+ D/2 (sin a, cos a) from its centre:

        outer: w_c (r + D/2 cos a_o) - D/2 w_s cos(a_o - beta) = 0
        inner: w_c (r - D/2 cos a_i) + D/2 w_s cos(a_i - beta) = Omega (r - D/2 cos a_i)
    """
    radius = 0.5 * ball_diameter
    to_inner = centre_radius - radius * cos(inner_angle)
    to_outer = centre_radius + radius * cos(outer_angle)
    arm_inner, arm_outer = radius * cos(inner_angle - pitch), radius * cos(outer_angle - pitch)
    orbit = speed * to_inner / (to_inner + to_outer * arm_inner / arm_outer)
    return orbit, orbit * to_outer / arm_outer


def pitch_angle(
    rule: str, ball_diameter: float, centre_radius: float, inner_angle: float, outer_angle: float
) -> float:
    """Pitch beta of the ball's spin axis, seen from the orbit, under one of three rules.

    `mean`
        halfway between the contact angles: each race takes about half of the spinning. The default.
        Balancing traction over the contact ellipses gives an axis within 0.5 degrees of it up to 40,000 r/min
        (7003C) and 12,000 r/min (7009C).
    `outer`
        outer race control, no spin on the outer race: ``tan(beta) = sin a_o / (cos a_o + D/(2 r))``.
    `inner`
        inner race control, no spin on the inner race: ``tan(beta) = sin a_i / (cos a_i - D/(2 r))``.

    Raises
    ------
    ValueError
        For any other rule.
    """
    ratio = 0.5 * ball_diameter / centre_radius
    if rule == "mean":
        return 0.5 * (inner_angle + outer_angle)
    if rule == "outer":
        return atan2(sin(outer_angle), cos(outer_angle) + ratio)
    if rule == "inner":
        return atan2(sin(inner_angle), cos(inner_angle) - ratio)
    raise ValueError(f"pitch rule {rule!r} is none of mean, outer, inner")


def rad_s(rpm: float) -> float:
    """Turn r/min into rad/s."""
    return rpm * pi / 30.0
