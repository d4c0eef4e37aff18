"""Film places of the races for tests, from the scene, as Hamrock and Dowson (1977) give them."""

import math

import numpy as np

from fmu_bearing.engine.choices import TRACTION_LAWS
from fmu_bearing.engine.layout import P
from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.scene import si


def film_places(scene, p, law):
    """Set traction law, its constants and the races' widths and central films in ``p``."""
    b, oil = si(scene.bearing), si(scene.lubricant)
    p[P.TRACTION_LAW] = TRACTION_LAWS.index(law)
    p[P.EYRING_STRESS] = 5e6
    p[P.PRESSURE_VISCOSITY] = oil.pressure_viscosity
    gamma = b.ball_diameter * math.cos(b.contact_angle) / b.pitch_diameter
    sides = (
        (scene.materials.inner_ring, b.inner_conformity, gamma / (1.0 - gamma)),
        (scene.materials.outer_ring, b.outer_conformity, -gamma / (1.0 + gamma)),
    )
    for race, (material, conformity, curvature) in enumerate(sides):
        ring, ball = si(material), si(scene.materials.balls)
        modulus = effective_modulus(
            ring.youngs_modulus, ring.poisson_ratio, ball.youngs_modulus, ball.poisson_ratio
        )
        rx = b.ball_diameter / 2.0 / (1.0 + curvature)
        ry = 1.0 / (2.0 / b.ball_diameter - 1.0 / (conformity * b.ball_diameter))
        hertz = point_contact(rx, ry, modulus)
        block = p[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]
        block[P.RACE_HALF_WIDTH] = hertz.half_width
        block[P.RACE_CENTRAL_FILM] = central_film(rx, modulus, oil.pressure_viscosity, hertz.ellipticity)
    return p


def central_film(rx, modulus, alpha, k):
    """All of 2.69 Rx U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k)) but (eta u)^0.67 Q^-0.067."""
    speed, load = 1.0 / (modulus * rx), 1.0 / (modulus * rx**2)
    shape = 1.0 - 0.61 * np.exp(-0.73 * k)
    return 2.69 * rx * speed**0.67 * (alpha * modulus) ** 0.53 * load**-0.067 * shape
