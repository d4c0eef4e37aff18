"""A ball bearing at rest under a radial load by ISO/TS 16281, its Hertz constants by elliptic integrals."""

import numpy as np
from scipy.optimize import brentq

from tests.oracles.hertz import point_contact


def radial_rest(balls, ball, pitch, conformities, clearance, modulus, poisson, load):
    """Displacement of the inner ring (m) and largest ball load (N), a ball at the side away from the load.

    Both rings of one material and upright, balls without centrifugal force: the ball at the angle a from the
    load is pressed by d cos a - s/2, s: radial clearance (m).
    """
    share = ball / pitch
    both = 0.5 * modulus / (1.0 - poisson**2)
    around = 1.0 + share / (1.0 - share), 1.0 - share / (1.0 + share)
    constants = [
        point_contact(100.0, 2.0 * along / ball, (2.0 - 1.0 / groove) / ball, both).constant
        for groove, along in zip(conformities, around, strict=True)
    ]
    together = sum(k ** (-2.0 / 3.0) for k in constants) ** -1.5
    angles = np.pi + 2.0 * np.pi * np.arange(balls) / balls

    def loads(moved):
        return together * np.maximum(moved * np.cos(angles) - 0.5 * clearance, 0.0) ** 1.5

    moved = brentq(lambda d: np.sum(loads(d) * np.cos(angles)) - load, 0.0, 1e-3, xtol=1e-14)
    return moved, loads(moved).max()
