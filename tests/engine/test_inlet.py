"""Moment of the oil at an inlet: its formula, at standstill too, and the powers with which it grows."""

import numpy as np
import pytest

from fmu_bearing.engine.choices import EHL_ALONE, FLOODED, STARVED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, P, R, W
from fmu_bearing.engine.mechanics.inlet import inlet_moments, local_powers

#: Powers of speed and load by law: of the EHL force, of that of rigid surfaces (Biboulet and Houpert 2010).
HOUPERT = (0.66, 0.47, 0.636, 0.364)
POWERS = {EHL_ALONE: HOUPERT, STARVED: HOUPERT, FLOODED: (0.75, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0)}
ELASTIC, RIGID = 2e-4, 5e-4  # N m at 1 m/s and 1 N
STEP = 1e-4  # of logarithms: the quotients err by its square


@kernel
def powers_of(law, factors, x, out):
    """Fill ``out`` with the powers by speed, then by load, of four contacts: speeds, then loads in ``x``."""
    by_speed, by_load = local_powers(law, factors, load(x, 0), load(x, FOUR))
    store(out, 0, by_speed)
    store(out, FOUR, by_load)


def moment(law, u, q, regime):
    """Moment (N m) as printed, of speeds (m/s) and loads (N)."""
    es, ew, rs, rw = POWERS[law]
    soft, stiff = ELASTIC * u**es * q**ew, RIGID * u**rs * q**rw
    return soft if law == EHL_ALONE else soft + (stiff - soft) / (1.0 + regime * q * u**-0.75)


@pytest.mark.parametrize("law", [EHL_ALONE, STARVED, FLOODED])
def test_moments_at_all_speeds(law):
    """Speeds are rounded over 1e-4 m/s, also backward and at standstill; an open contact has no moment."""
    p, w = np.zeros(P.TABLES), np.zeros(W.ROWS)
    p[P.ROLLING_LAW] = law
    speed, pressing = np.array([0.0, -3e-5, 2.0, 2.0]), np.array([20.0, 20.0, 5.0, 0.0])
    w[W.RACE + R.ENTRAIN :][:FOUR], w[W.RACE + R.LOAD :][:FOUR] = speed, pressing
    inlet_moments(p, FOUR, (ELASTIC, RIGID, 0.1), W.RACE, w)
    wanted = moment(law, np.sqrt(speed**2 + 1e-8), pressing, 0.1)
    # the load is lifted by 1e-9 N, a tenth of a billionth of 5 N
    np.testing.assert_allclose(w[W.RACE + R.ROLL :][:FOUR], wanted, rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("law", [STARVED, FLOODED])
@pytest.mark.parametrize("regime", [1e-3, 0.1, 10.0])
def test_powers_are_slopes_of_logarithms(law, regime):
    """From contacts that hardly deform to ones that pressure flattens and whose oil it thickens."""
    speed, pressing = np.array([0.3, 1.0, 5.0, 20.0]), np.array([0.5, 20.0, 3.0, 200.0])

    def logarithm(u, q):
        return np.log(moment(law, u, q, regime))

    found = np.empty(2 * FOUR)
    powers_of(law, (ELASTIC, RIGID, regime), np.concatenate([speed, pressing]), found)
    up, down = np.exp(STEP), np.exp(-STEP)
    by_speed = (logarithm(speed * up, pressing) - logarithm(speed * down, pressing)) / (2.0 * STEP)
    by_load = (logarithm(speed, pressing * up) - logarithm(speed, pressing * down)) / (2.0 * STEP)
    # speeds are rounded over 1e-4 m/s, which is 1e-7 of 0.3 m/s squared
    np.testing.assert_allclose(found, np.concatenate([by_speed, by_load]), rtol=1e-6, atol=1e-7)
