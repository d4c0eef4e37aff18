"""Shaft that bends: closed forms, the whole chain against its reduction, and the rotor program ROSS."""

import json
import math
import os
import shlex
import subprocess

import numpy as np
import pytest
from scipy.linalg import eig, eigh

from fmu_bearing.elastic.shaft import rigid_transform, shaft_model
from fmu_bearing.elastic.shaft.beam import beam, shear_coefficient
from fmu_bearing.elastic.shaft.flexible import flexible_model
from fmu_bearing.elastic.shaft.sections import Section
from tests.spindle.sets import scene

ROSS = os.environ.get("FMU_BEARING_ROSS")
STEEL = (7800.0, 208e9, 0.3)
STEPS = [(0.03, 0.011, 0.0), (0.14, 0.0085, 0.0), (0.06, 0.008, 0.002)]  # length, radius, bore
PLANES = (0.04, 0.052, 0.15, 0.162)


def chain(steps=STEPS):
    found, start = [], 0.0
    for length, radius, bore in steps:
        found.append(Section(start, length, radius, bore, *STEEL))
        start += length
    return found


def constants(section):
    """E I, k G A, rho A, rho I."""
    area = math.pi * (section.radius**2 - section.bore**2)
    moment = math.pi / 4.0 * (section.radius**4 - section.bore**4)
    shear = shear_coefficient(section.bore / section.radius, 0.3) * 208e9 / 2.6 * area
    return 208e9 * moment, shear, 7800.0 * area, 7800.0 * moment


def test_shear_coefficients_of_cowpers_paper():
    assert shear_coefficient(0.0, 0.3) == pytest.approx(6 * 1.3 / (7 + 6 * 0.3), rel=1e-12)  # full circle
    assert shear_coefficient(1.0, 0.3) == pytest.approx(2 * 1.3 / (4 + 3 * 0.3), rel=1e-12)  # thin tube


@pytest.mark.parametrize("slender", [10.0, 40.0])
def test_simply_supported_frequencies_are_timoshenkos(slender):
    """rho A rho I w4 / kGA - (rho A + k2 (rho I + rho A E I / kGA)) w2 + E I k4 = 0, k = n pi / L."""
    length = slender * 0.02
    (section,) = chain([(length, 0.01, 0.004)])
    bend, shear, mass, turn = constants(section)
    whole = beam([section])
    kept = np.setdiff1d(np.arange(len(whole.mass)), [0, len(whole.mass) - 2])
    found = eigh(*(one[np.ix_(kept, kept)] for one in (whole.stiffness, whole.mass)), eigvals_only=True)
    for n in (1, 2, 3):
        k = n * math.pi / length
        roots = np.roots([mass * turn / shear, -(mass + k**2 * (turn + mass * bend / shear)), bend * k**4])
        # elements of a 96th of the length: square of a frequency within 2e-4
        assert found[n - 1] == pytest.approx(min(roots), rel=2e-4)


def test_cantilever_bends_and_shears():
    """F L3 / 3 E I + F L / kGA, to rounding: the shape functions are exact for loads at nodes."""
    (section,) = chain([(0.1, 0.01, 0.003)])
    bend, shear, *_ = constants(section)
    whole = beam([section])
    flexibility = np.linalg.inv(whole.stiffness[2:, 2:])
    assert flexibility[-2, -2] == pytest.approx(0.1**3 / (3 * bend) + 0.1 / shear, rel=1e-8)
    assert flexibility[-1, -2] == pytest.approx(0.1**2 / (2 * bend), rel=1e-8)


def test_stepped_cantilever_is_the_sum_of_its_sections():
    """Castigliano: integral of x2 / E I and 1 / kGA from the loaded nose to the clamped end."""
    sections = chain()
    whole = beam(sections)
    expected = 0.0
    for one in sections:
        bend, shear, *_ = constants(one)
        end = one.start + one.length
        expected += (end**3 - one.start**3) / (3 * bend) + one.length / shear
    assert np.linalg.inv(whole.stiffness[:-2, :-2])[0, 0] == pytest.approx(expected, rel=1e-7)


def reduced(**keys):
    return flexible_model(chain(), PLANES, (0.02,), **keys)


def test_order_of_the_coordinates():
    model = reduced()
    assert model.count == 1 + 4 * (1 + 4) + 2 * 2
    np.testing.assert_array_equal(model.nose, np.eye(5, model.count))
    for k, plane in enumerate(model.planes):
        expected = np.zeros((5, model.count))
        expected[0, 0] = 1.0
        expected[1:, 5 + 4 * k : 9 + 4 * k] = np.eye(4)
        np.testing.assert_allclose(plane, expected, atol=1e-12)
    assert flexible_model(chain(), (0.0, 0.1)).count == 1 + 4 * 2 + 2 * 2  # a bearing at the nose


def test_a_rigid_motion_meets_the_rigid_shaft():
    keys = {"spindle.shaft.sections_mm": [[30.0, 22.0, 0.0], [140.0, 17.0, 0.0], [60.0, 16.0, 4.0]]}
    rigid = scene("++--", [1e3 * one for one in PLANES], changes=keys)
    soft = rigid.replace({"spindle.shaft.flexible": True, "spindle.shaft.damping_ratio": 0.02})
    rigid, soft = (shaft_model(one, one.spindle) for one in (rigid, soft))
    motion = np.zeros((soft.count, 5))
    motion[:5] = np.eye(5)
    for k, place in enumerate(PLANES):
        motion[5 + 4 * k : 9 + 4 * k] = rigid_transform(1.0, place)[1:]
    np.testing.assert_allclose(motion.T @ soft.mass @ motion, rigid.mass, atol=1e-13)
    np.testing.assert_allclose(motion.T @ soft.gyroscopic @ motion, rigid.gyroscopic, atol=1e-14)
    np.testing.assert_allclose(soft.across @ motion, rigid.across, atol=1e-13)
    np.testing.assert_allclose(soft.stiffness @ motion, 0.0, atol=1e-9 * soft.stiffness.max())
    np.testing.assert_allclose(soft.damping @ motion, 0.0, atol=1e-9 * soft.damping.max())
    for place in (-0.02, 0.013, 0.1, 0.23, 0.25):
        np.testing.assert_allclose(soft.at(place) @ motion, rigid_transform(1.0, place), atol=1e-10)


def test_matrices_commute_with_turning_about_the_axis():
    model, angle = reduced(damping_ratio=0.01), 0.7
    turn = np.eye(model.count)
    pair = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    for at in range(1, model.count, 2):
        turn[at : at + 2, at : at + 2] = pair
    for name in ("mass", "damping", "stiffness", "gyroscopic"):
        one = getattr(model, name)
        np.testing.assert_allclose(turn @ one, one @ turn, atol=1e-13 * np.abs(one).max(), err_msg=name)
    np.testing.assert_allclose(model.gyroscopic, -model.gyroscopic.T, atol=1e-18)


def full():
    """The whole chain on springs at the planes: mass, stiffness, gyroscopic matrix in (y, bz), (z, -by)."""
    whole = beam(chain(), [*PLANES, 0.02])
    none = np.zeros_like(whole.mass)
    stiffness = whole.stiffness.copy()
    for place in PLANES:
        at = 2 * whole.node(place)
        stiffness[at, at] += 5e7
    mass, stiff = (np.block([[one, none], [none, one]]) for one in (whole.mass, stiffness))
    return whole, mass, stiff, np.block([[none, whole.spin], [-whole.spin, none]])


def supported(model):
    stiffness = model.stiffness.copy()
    for plane in model.planes:
        stiffness += 5e7 * plane[1:3].T @ plane[1:3]
    return stiffness


def test_reduction_keeps_statics():
    """Forces at the nose and between bearings, weight: displacements of nose and bearings."""
    whole, mass, stiffness, _ = full()
    model, size = reduced(fixed_modes=1), len(whole.mass)
    stiff = supported(model)[1:, 1:]
    rise = np.tile([1.0, 0.0], size // 2)
    for force, given in (
        (whole.motion(0.0)[0], model.at(0.0)[1]),
        (whole.motion(0.1013)[0], model.at(0.1013)[1]),
    ):
        expected = np.linalg.solve(stiffness[:size, :size], force)
        found = np.linalg.solve(stiff, given[1:])
        for place in (0.0, *PLANES):
            value = model.at(place)[1, 1:] @ found
            assert value == pytest.approx(whole.motion(place)[0] @ expected, rel=1e-9, abs=1e-16)
    sag = np.linalg.solve(stiffness[:size, :size], whole.mass @ rise)
    found = np.linalg.solve(stiff, model.heavy[1:])
    assert found[1] == pytest.approx(sag[0], rel=1e-9)


def test_reduction_keeps_three_frequencies():
    _, mass, stiffness, _ = full()
    model = reduced()
    expected = np.sqrt(eigh(stiffness, mass, eigvals_only=True))
    found = np.sqrt(eigh(supported(model)[1:, 1:], model.mass[1:, 1:], eigvals_only=True))
    np.testing.assert_allclose(found[:6], expected[:6], rtol=2e-3)  # each in two planes
    assert np.all(found[:6] > expected[:6] * (1.0 - 1e-9))  # Rayleigh: fewer coordinates are stiffer


def whirl(mass, spin, stiffness, speed):
    """Frequencies (rad/s) of mass a + speed spin v + stiffness q = 0, rising."""
    n = len(mass)
    none, one = np.zeros((n, n)), np.eye(n)
    system = np.block([[none, one], [-stiffness, -speed * spin]])
    roots = eig(system, np.block([[one, none], [none, mass]]), right=False)
    return np.sort(roots.imag[roots.imag > 1.0])


@pytest.mark.heavy
def test_reduction_keeps_gyroscopic_splitting():
    _, mass, stiffness, spin = full()
    model, speed = reduced(), 5000.0
    expected = whirl(mass, spin, stiffness, speed)[:4]
    found = whirl(model.mass[1:, 1:], model.gyroscopic[1:, 1:], supported(model)[1:, 1:], speed)[:4]
    np.testing.assert_allclose(found, expected, rtol=2e-3)
    splits, of = np.diff(found)[::2], np.diff(expected)[::2]
    assert np.all(of > 1.0)
    np.testing.assert_allclose(splits, of, rtol=0.02)


def test_damping_ratio_of_the_free_shaft():
    model = reduced(damping_ratio=0.03, fixed_modes=4)
    squared, modes = eigh(model.stiffness[1:, 1:], model.mass[1:, 1:])
    lowest = modes[:, 4]  # two translations and two tilts come first
    ratio = lowest @ model.damping[1:, 1:] @ lowest / (2.0 * math.sqrt(squared[4]))
    assert ratio == pytest.approx(0.03, rel=2e-3)


_SCRIPT = """
import json, sys
import numpy as np
import ross
given = json.load(sys.stdin)
material = ross.Material(name="steel", rho=7800.0, E=208e9, Poisson=0.3)
parts = [ross.ShaftElement(L=l, idl=2 * b, odl=2 * r, material=material, shear_effects=True,
         rotary_inertia=True, gyroscopic=True, n=k) for k, (l, r, b) in enumerate(given["parts"])]
bearings = [ross.BearingElement(n=n, kxx=5e7, cxx=0.0) for n in given["nodes"]]
rotor = ross.Rotor(parts, bearing_elements=bearings)
found = rotor.run_modal(given["speed"], num_modes=24).wn
print(json.dumps([float(value) for value in found]))
"""


@pytest.mark.skipif(ROSS is None, reason="FMU_BEARING_ROSS names no Python with ROSS 3")
def test_whirl_is_that_of_ross():
    speed, (whole, mass, stiffness, spin) = 5000.0, full()
    parts = [
        (float(length), one.radius, one.bore)
        for length, one in zip(np.diff(whole.nodes), whole.sections, strict=True)
    ]
    given = {"parts": parts, "nodes": [whole.node(place) for place in PLANES], "speed": speed}
    command = [*shlex.split(str(ROSS)), "-c", _SCRIPT]
    done = subprocess.run(command, input=json.dumps(given), capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    found = sorted(value for value in json.loads(done.stdout.splitlines()[-1]) if value > 10.0)
    expected = whirl(mass, spin, stiffness, speed)[:4]
    # ROSS keeps axial and torsional motion too: the nearest frequency of each
    nearest = [min(found, key=lambda value, one=one: abs(value - one)) for one in expected]
    np.testing.assert_allclose(nearest, expected, rtol=5e-3)
    np.testing.assert_allclose(np.diff(nearest)[::2], np.diff(expected)[::2], rtol=0.05)
