"""Deep groove bearings at rest: published places, an oracle, mirror images, clearance that is left."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing import simulate, statics
from fmu_bearing.design.mounted import mounted
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.contacts import race_contacts
from fmu_bearing.prepare.model import prepare
from tests.deep_groove import PUBLISHED, Size, at_rest, scene_of

#: Clearance (mm), loads along and across (N), places along and across (um) that MASTA prints (the public test
#: of minzhun/ISO16281): 7 balls of 11.5 mm, ball 1 under the load.
PRINTED = {
    "across": (0.0, 0.0, 1e3, 0.0, 15.1101),
    "across, clearance": (0.01, 0.0, 1e3, 0.0, 21.223),
    "along": (0.0, 1e3, 0.0, 133.5381, 0.0),
    "along, clearance": (0.01, 1e3, 0.0, 149.1717, 0.0),
    "both, clearance": (0.01, 1e3, 1e3, 146.4603, 19.5923),
}
FIT = {
    "preload": "unmounted", "shaft": {"interference_um": 30.0, "material": "GCr15", "long": True},
}  # fmt: skip


def places(scene):
    """Places along and upwards (um), tilt about y (mrad) and loads at the inner race (N) at the start."""
    (one,) = statics(scene).bearings
    x = 1e6 * one.displacement
    return x[0], x[2], 1e-3 * x[3], one.ball_loads[0]


@pytest.mark.parametrize("name", PRINTED)
def test_the_oracle_has_the_published_places(name):
    clearance, axial, radial, along, across = PRINTED[name]
    found = at_rest(replace(PUBLISHED, clearance=clearance), axial, radial, standard=True)
    # four digits behind the point, and another solver's tolerance
    assert 1e3 * np.array(found[:2]) == pytest.approx([along, across], abs=6e-4)


@pytest.mark.parametrize("name", PRINTED)
def test_the_engine_has_the_published_places(name):
    clearance, axial, radial, along, across = PRINTED[name]
    size = replace(PUBLISHED, clearance=clearance)
    x, z, tilt, loads = places(scene_of(size, axial, radial))
    if not axial * radial:
        # the engine's groove of a ring that moves aside is round, the standard's is flat: 0.03 %
        assert [x, z] == pytest.approx([along, across], rel=1e-3, abs=1e-6)
    else:
        # free to tilt under both loads, the ring goes farther across than the standard has it: `at_rest`
        assert z == pytest.approx(1.0156 * across, rel=1e-3)
    own = at_rest(size, axial, radial)
    assert [x, z, tilt] == pytest.approx(1e3 * np.array(own[:3]), rel=1e-3, abs=1e-6)
    assert x == pytest.approx(along, rel=1e-3, abs=1e-6)
    assert loads == pytest.approx(own[3], abs=1e-3 * own[3].max())


def test_largest_load_without_clearance():
    """NSK (technical report E728) has 4.37 for point contact, the limit of many balls; nine balls 4.385."""
    size = Size(9, 7.938, 38.5, 0.52, 0.53, 0.0)
    loads = places(scene_of(size, 0.0, 100.0))[3]
    assert 9.0 * loads.max() / 100.0 == pytest.approx(4.37, rel=0.005)


def cases(count, seed=20):
    """Sizes and loads: small and large bearings, tight grooves and open ones, loads along, across, both."""
    draw = np.random.default_rng(seed)
    for k in range(count):
        ball = float(draw.uniform(3.0, 20.0))
        balls = int(draw.integers(6, 15))
        pitch = ball / np.sin(np.pi / balls) * float(draw.uniform(1.1, 1.5))
        grooves = [float(value) for value in draw.uniform(0.51, 0.54, 2)]
        clearance = 1e-3 * float(draw.uniform(0.0, 4.0)) * ball
        heavy = ball**2 * balls * float(draw.uniform(0.2, 1.5))  # N: 1.5 is an eighth of C0
        along = (0.0, 0.3, -0.3, 0.1)[k % 4] * heavy
        across = (1.0, 0.0, 0.5, 1.0)[k % 4] * heavy
        yield Size(balls, ball, max(pitch, 3.2 * ball), *grooves, clearance), along, across


@pytest.mark.heavy
def test_forty_cases_beside_the_oracle():
    for size, along, across in cases(40):
        x, z, tilt, loads = places(scene_of(size, along, across))
        own = at_rest(size, along, across)
        # the round groove of the engine, see above: by the place across over the distance of groove centres
        assert [x, z] == pytest.approx([1e3 * own[0], 1e3 * own[1]], rel=2e-3, abs=0.02), (
            size,
            along,
            across,
        )
        assert 5e-4 * size.pitch * tilt == pytest.approx(0.5 * size.pitch * own[2], rel=5e-3, abs=5e-5)
        assert loads == pytest.approx(own[3], abs=5e-3 * own[3].max())


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_axial_loads_of_both_signs_are_mirror_images(fidelity):
    """Places along the axis, tilts and contact angles change their sign, all else is equal."""
    size = Size(9, 7.938, 38.5, 0.52, 0.53, 0.012)
    mirrored = (
        "inner_ring.displacement.x",
        "inner_ring.tilt.y",
        "inner_ring.tilt.z",
        "inner_ring.velocity.x",
    )
    mirrored += ("contact.inner.angle_mean", "contact.outer.angle_mean")
    same = ("inner_ring.displacement.z", "friction_torque", "contact.inner.load_max", "heat.oil")
    same += ("contact.inner.shoulder_margin", "contact.outer.shoulder_margin", "contact.inner.spin_to_roll")
    runs = []
    for sign in (1.0, -1.0):
        scene = scene_of(size, sign * 200.0, 100.0, rpm=3000.0).replace({"fidelity.model": fidelity})
        scene = scene.replace({"lubricant.traction_max": 0.05})
        runs.append(simulate(scene, 2e-3, step=1e-4, outputs=[*mirrored, *same]))
    for names, sign in ((mirrored, -1.0), (same, 1.0)):
        for name in names:
            one, other = (run[name] for run in runs)
            # sums of forces round otherwise in the mirror, and steps of the run multiply that
            assert sign * other == pytest.approx(one, rel=1e-6, abs=1e-6 * np.abs(one).max()), name


def test_the_margin_is_to_the_nearer_shoulder():
    size = replace(PUBLISHED, clearance=0.01)
    margins = [started(scene_of(size, axial)).get("contact.inner.shoulder_margin") for axial in (1e3, -1e3)]
    assert margins[0] == pytest.approx(margins[1], rel=1e-9)
    contact, _ = race_contacts(scene_of(size))
    one = started(scene_of(size, 1e3))
    reach = contact.half_length * (one.get("contact.inner.load_max") / contact.stiffness) ** (1.0 / 3.0)
    profile = 2.0 * size.inner * size.ball / (2.0 * size.inner + 1.0)
    edge = math.acos(
        (0.5 * size.pitch + 0.02 * size.ball - 0.0025 - 0.5 * (size.pitch - 0.6 * size.ball))
        / (size.inner * size.ball)
    )
    angle = one.get("contact.inner.angle_mean")
    assert margins[0] == pytest.approx(edge - angle - math.asin(1e3 * reach / profile), abs=1e-6)


def started(scene):
    """The engine at its start."""
    bearing = Instance(prepare(scene))
    bearing.initialise()
    return bearing


def test_negative_clearance_loads_every_ball():
    """Of a fit, and as drawn: 2 K C (delta/2)^1.5 is what contacts in series carry at a radial closing."""
    size = Size(9, 7.938, 38.5, 0.52, 0.53, 0.004)
    loose, tight = scene_of(size, rpm=100.0, radial=1.0), scene_of(size, rpm=100.0, radial=1.0, fit=FIT)
    bearings = [started(scene) for scene in (loose, tight)]
    assert bearings[0].get("clearance") == pytest.approx(4e-6, abs=1e-9)
    left = bearings[1].get("clearance")
    assert left == pytest.approx(mounted(tight).clearance(100.0 * np.pi / 30.0), abs=1e-12)
    assert left < -2e-6
    assert bearings[1].get("contact.free_angle") == 0.0
    loads = places(tight)[3]
    assert np.all(loads > 1.0)
    assert loads == pytest.approx(
        places(scene_of(replace(size, clearance=1e3 * left), rpm=100.0, radial=1.0))[3], rel=0.02
    )


def test_heat_takes_clearance():
    """An inner ring that is 20 K warmer takes the growth of its groove and of half of the balls."""
    size = Size(9, 7.938, 38.5, 0.52, 0.53, 0.012)
    bearing = started(scene_of(size, radial=100.0, temperatures=(40.0, 20.0)))
    radius = 0.5 * size.pitch + 0.02 * size.ball - 0.25 * size.clearance
    closing = 2e-3 * (radius - 0.52 * size.ball + 0.5 * size.ball) * 11.8e-6 * 20.0
    assert bearing.get("clearance") == pytest.approx(12e-6 - closing, abs=1e-10)
