"""Clearance of a cage in its lands by heat, fit and rotation."""

import numpy as np
import pytest

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import C, P, S, U
from tests.engine.states import guided

HOT_I, HOT_O = 333.15, 313.15  # K: 40 and 20 K above the reference


def clearance(scene, speed=2000.0, **inputs):
    run = Arrays.of(scene.model_copy(update={"sound": None}))
    for name, value in ({"INNER_T": HOT_I, "OUTER_T": HOT_O, "SPEED": speed} | inputs).items():
        run.u[getattr(U, name)] = value
    run.init()
    return run.s[S.C + C.LAND_CLEARANCE], run


def growing(scene, guidance):
    one = scene("7003C-spindle") if guidance == "inner" else guided(scene("7003C-spindle"), guidance)
    return one.replace({"fidelity.terms.land_growth": True})


@pytest.mark.parametrize(("guidance", "side"), [("inner", -1.0), ("outer", 1.0)])
def test_clearance_by_heat_and_rotation(scene, guidance, side):
    """Steel rings of 11.8e-6/K, a cage of bakelite (30e-6/K, 8 GPa, 1400 kg/m3) at their mean temperature."""
    found, run = clearance(growing(scene, guidance))
    radius, rise = run.p[P.LAND_RADIUS], {"inner": 40.0, "outer": 20.0}[guidance]
    cage = 0.5 * (1.0 - 4.5 * np.cos(np.radians(15.0)) / 26.0) * 2000.0
    gained = radius * (11.8e-6 * rise - 30e-6 * 30.0) - 1400.0 * radius**3 * cage**2 / 8e9
    assert found - run.p[P.LAND_CLEARANCE] == pytest.approx(side * gained, rel=1e-9)


def test_clearance_stays_as_given_without_the_term(scene):
    found, run = clearance(guided(scene("7003C-spindle"), "outer"))
    assert found == run.p[P.LAND_CLEARANCE] == 40e-6


def test_some_clearance_is_left(scene):
    """A cage that would grow into the outer ring keeps a tenth."""
    tight = growing(scene, "outer").replace({"bearing.cage.land_clearance_mm": 0.005})
    found, run = clearance(tight)
    assert found == pytest.approx(0.1 * run.p[P.LAND_CLEARANCE], rel=1e-12)


def test_a_deep_groove_bearing_with_a_machined_cage(scene):
    """It rolls at an angle of 0: the cage turns with (1 - D/d_m)/2 of the shaft's speed."""
    changes = {"kind": "deep-groove", "contact_angle_deg": None, "radial_clearance_um": 12.0}
    given = scene("7003C-spindle").replace({f"bearing.{key}": value for key, value in changes.items()})
    found, run = clearance(given.replace({"fidelity.terms.land_growth": True, "mounting.preload_N": 50.0}))
    radius, cage = run.p[P.LAND_RADIUS], 0.5 * (1.0 - 4.5 / 26.0) * 2000.0
    gained = radius * (11.8e-6 * 40.0 - 30e-6 * 30.0) - 1400.0 * radius**3 * cage**2 / 8e9
    assert found - run.p[P.LAND_CLEARANCE] == pytest.approx(-gained, rel=1e-9)
