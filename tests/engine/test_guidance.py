"""Cages on the lands of the outer ring and on the balls: forces, balances, drag."""

import numpy as np
import pytest

from fmu_bearing.engine.choices import GUIDANCES
from fmu_bearing.engine.layout import P
from fmu_bearing.engine.mechanics.cage import guiding_land
from fmu_bearing.engine.mechanics.energy import stored_energy
from tests.engine.states import ROUNDING, SCENES, agree, case_of, guided, off
from tests.engine.test_balances import moments, pulls
from tests.oracles import cartesian as oracle

#: Guidance, and how far the cage is off the middle, of its room: in the film, on the dry stop, in pockets.
KINDS = [("outer", 0.5), ("outer", 1.02), ("balls", 0.5)]


def state(scene, guidance, **keys):
    return case_of(lambda name: guided(scene(name), guidance), SCENES[0], **keys)


@pytest.mark.parametrize(("guidance", "cage_offset"), KINDS)
@pytest.mark.parametrize("tilt", [0.0, 1e-4])
def test_against_inertial_vectors(scene, guidance, cage_offset, tilt):
    """The engine rounds the direction of the film's motion, as on the inner ring."""
    one = state(scene, guidance, cage_offset=cage_offset, tilt=tilt)
    agree(one, ROUNDING if guidance == "balls" else 1e-6)
    energy = stored_energy(one.p, one.c, one.y, one.w)
    assert energy == pytest.approx(oracle.stored_energy(one.setup, one.state), rel=1e-12)


@pytest.mark.parametrize(("guidance", "cage_offset"), KINDS)
def test_momentum(scene, guidance, cage_offset):
    """Newton's third law: what cage, rings and balls do to each other cancels, as force and as moment."""
    one = state(scene, guidance, cage_offset=cage_offset, tilt=0.0, afloat=0.0, CAGE_ECCENTRICITY=0.0)
    found = one.engine()
    rate, outside, _ = pulls(one, found)
    assert off(rate.sum(0), outside.sum(0), rate) <= 1e-12
    turning, given = moments(one, found)
    assert off(turning.sum(0), given.sum(0), turning) <= 1e-11


@pytest.mark.parametrize(("guidance", "cage_offset"), KINDS)
@pytest.mark.parametrize(("tilt", "gate"), [(0.0, 1e-12), (1e-4, 2e-7)])
def test_power_balance(scene, guidance, cage_offset, tilt, gate):
    """Work less heat is the rate of the stored energy.

    Small tilts leave a rest by their square times the forces of pockets and lands, 1e-7 of the work here.
    """
    one = state(scene, guidance, cage_offset=cage_offset, tilt=tilt)
    found = one.engine()
    stored = oracle.power_stored(one.setup, one.state, found.balls, found.bodies)
    assert abs(found.work - found.heats.sum() - stored) <= gate * found.work


def land(guidance):
    p = np.zeros(P.TABLES)
    p[P.GUIDANCE] = GUIDANCES.index(guidance)
    p[P.LAND_LENGTH] = 2.25e-3
    p[P.LAND_RADIUS] = {"inner": 11.66e-3, "outer": 14.3e-3}[guidance]
    p[P.LAND_STOP_FRACTION], p[P.LAND_STOP_SLIP] = 0.96, 0.1
    return p


SHAFT, CAGE, GAP = 2094.0, 880.0, (0.006, 4e-5)  # rad/s; Pa s and m


@pytest.mark.parametrize(("guidance", "ring"), [("inner", SHAFT), ("outer", 0.0), ("outer", -3.0)])
def test_drag_of_a_centred_cage_is_petroffs(guidance, ring):
    """An inner land drives the cage, an outer one brakes it; what is lost heats the oil."""
    p = land(guidance)
    fy, fz, on_ring, on_cage, energy, lost = guiding_land(p, GAP, 0.0, 0.0, 0.0, 0.0, ring, CAGE)
    petroff = 2.0 * np.pi * GAP[0] * p[P.LAND_RADIUS] ** 3 * p[P.LAND_LENGTH] / GAP[1]
    assert on_cage == pytest.approx(petroff * (ring - CAGE), rel=1e-9)
    assert on_ring == -on_cage and energy == 0.0
    assert lost == pytest.approx(petroff * (ring - CAGE) ** 2, rel=1e-9)
    assert abs(fy) + abs(fz) < 1e-12


def test_drags_of_both_guidances_go_with_radius_and_sliding():
    """At equal clearance and length: (R_o^3 w_c)/(R_i^3 (w - w_c))."""
    drags = [
        abs(guiding_land(land(guidance), GAP, 0.0, 0.0, 0.0, 0.0, ring, CAGE)[3])
        for guidance, ring in (("outer", 0.0), ("inner", SHAFT))
    ]
    ratio = (14.3 / 11.66) ** 3 * CAGE / (SHAFT - CAGE)
    assert drags[0] / drags[1] == pytest.approx(ratio, rel=1e-9)


def test_the_film_in_the_outer_ring_turns_with_half_the_cage():
    """A cage that goes round at half its speed feels no film across its offset, faster or slower it does."""
    across = []
    offset = 2e-5
    for whirl in (0.4 * CAGE, 0.5 * CAGE, 0.6 * CAGE):
        found = guiding_land(land("outer"), GAP, offset, 0.0, 0.0, whirl * offset, 0.0, CAGE)
        across.append(found[1])
    assert across[0] > 0.0 > across[2] and abs(across[1]) < 1e-9 * across[0]
