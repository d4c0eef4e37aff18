"""Powers with which the moment of the oil at an inlet grows: against difference quotients of its formula."""

import numpy as np
import pytest

from fmu_bearing.engine.choices import FLOODED, STARVED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR
from fmu_bearing.engine.mechanics.inlet import local_powers

#: Powers of speed and load by law: of the EHL force, of that of rigid surfaces (Biboulet and Houpert 2010).
POWERS = {STARVED: (0.66, 0.47, 0.636, 0.364), FLOODED: (0.75, 1.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0)}
ELASTIC, RIGID = 2e-4, 5e-4  # N m at 1 m/s and 1 N
STEP = 1e-4  # of logarithms: the quotients err by its square


@kernel
def powers_of(law, factors, x, out):
    """Fill ``out`` with the powers by speed, then by load, of four contacts: speeds, then loads in ``x``."""
    by_speed, by_load = local_powers(law, factors, load(x, 0), load(x, FOUR))
    store(out, 0, by_speed)
    store(out, FOUR, by_load)


@pytest.mark.parametrize("law", POWERS)
@pytest.mark.parametrize("regime", [1e-3, 0.1, 10.0])
def test_powers_are_slopes_of_logarithms(law, regime):
    """From contacts that hardly deform to ones that pressure flattens and whose oil it thickens."""
    speed, pressing = np.array([0.3, 1.0, 5.0, 20.0]), np.array([0.5, 20.0, 3.0, 200.0])

    def logarithm(u, q):
        es, ew, rs, rw = POWERS[law]
        stiff, soft = RIGID * u**rs * q**rw, ELASTIC * u**es * q**ew
        return np.log(soft + (stiff - soft) / (1.0 + regime * q * u**-0.75))

    found = np.empty(2 * FOUR)
    powers_of(law, (ELASTIC, RIGID, regime), np.concatenate([speed, pressing]), found)
    up, down = np.exp(STEP), np.exp(-STEP)
    by_speed = (logarithm(speed * up, pressing) - logarithm(speed * down, pressing)) / (2.0 * STEP)
    by_load = (logarithm(speed, pressing * up) - logarithm(speed, pressing * down)) / (2.0 * STEP)
    # speeds are rounded over 1e-4 m/s, which is 1e-7 of 0.3 m/s squared
    np.testing.assert_allclose(found, np.concatenate([by_speed, by_load]), rtol=1e-6, atol=1e-7)
