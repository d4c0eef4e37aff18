"""Modes of fidelities `rings` and `response`: those of `full`, linearised at its steady state."""

import numpy as np
import pytest

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import H
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.equations.quick import operator_matrix
from fmu_bearing.scene.read import with_fidelity
from tests.engine.condensed import FIDELITIES, history
from tests.engine.helpers import Run, quiet
from tests.modal.decay import pencil

FASTEST = 2.0 * np.pi * 30e3  # rad/s


def poles_of(matrix):
    """Eigenvalues (1/s) of a first-order matrix, its rows and columns scaled to like sizes."""
    size = np.ones(len(matrix))
    for _ in range(20):
        rows, columns = np.abs(matrix).sum(1), np.abs(matrix).sum(0)
        scale = np.sqrt(np.maximum(columns, 1e-300) / np.maximum(rows, 1e-300)) ** 0.5
        matrix, size = matrix * scale[:, None] / scale, size * scale
    return np.linalg.eigvals(matrix)


def weightless(scene):
    """The scene with rigid rings, without imperfections, sound and weight, which loads balls unequally."""
    return quiet(scene.with_rigid_rings()).replace({"fidelity.terms.gravity": False})


def full_and_quick(scene, fidelity="rings"):
    """Poles (1/s) of `full` without its cage, of motions that rings take part in, and of the operator."""
    scene = weightless(scene)
    found = linearised(scene).bearings[0]
    at = found.coordinates
    balls = np.tile((np.arange(at.balls) + 1) // 2 <= 1, at.BALL_STATES)
    moving = np.concatenate([balls, np.ones(at.size - at.rings, dtype=bool)])
    full = poles_of(found.matrix[np.ix_(moving, moving)])
    run = Arrays.of(with_fidelity(scene, model=fidelity), CAGE=0.0)
    run.init()
    return full, poles_of(operator_matrix(run))


def nearest(values, frequency):
    """The value whose imaginary part is nearest to a frequency (Hz, signed): frequency and damping ratio."""
    best = min(values, key=lambda value: abs(value.imag / (2 * np.pi) - frequency))
    return best.imag / (2 * np.pi), -best.real / abs(best)


def slow_enough(poles):
    """Those below 30 kHz that oscillate."""
    return poles[(poles.imag > 2.0 * np.pi * 20.0) & (poles.imag < FASTEST)]


def assert_equal_poles(scene, tolerance, fidelity="rings"):
    """Assert that each pole of one has its equal in the other.

    The operator comes from the kernels' Jacobian, `linearised` from central differences of a nanometre: 1e-7
    of a contact's slope, and of a soft mode's pole as much more as contacts are stiffer than what holds it.
    """
    full, quick = full_and_quick(scene, fidelity)
    assert len(slow_enough(quick)) >= 8
    for one, other in ((slow_enough(quick), full), (slow_enough(full), quick)):
        for pole in one:
            mate = other[np.argmin(np.abs(other - pole))]
            assert abs(mate - pole) <= tolerance * abs(pole) + 0.05, (pole, mate)
    assert max(slow_enough(quick).real) <= max(max(slow_enough(full).real), 0.0) + 0.05


def poles_of_rings(scene, rpm, spacing=1e-5, count=300, axis=1):
    """Poles (1/s) that the free decay of `rings` shows after a kick of the inner ring; radial, or axis 0."""
    run = Run(quiet(scene), rpm, FIDELITY=FIDELITIES["rings"], GRAVITY=0.0, CAGE=0.0, MAX_STEP=5e-6).init()
    history(run)[H.V0, axis] += 1e-5
    rows = run.run(count * spacing, spacing)
    return pencil(rows[:, axis : axis + 1] + 1j * rows[:, 2:3] * (axis == 1), spacing, 20)


SPEEDS = (3_000, 10_000, 20_000, 28_000)  # r/min


@pytest.mark.parametrize("damping", [0.5, 10.0, 12.0, 20.0])
@pytest.mark.parametrize(
    "name", ["7003C-bare", "7003C-impact", "7003C-spindle", "7009C-full-ceramic", "7009C-steel"]
)
def test_the_operator_has_the_modes_of_full(scene, example, name, damping):
    for folder in (scene, example):
        assert_equal_poles(folder(name).replace({"bearing.contact_damping_us": damping}), 2e-6)


@pytest.mark.parametrize("damping", [12.0, 20.0])
def test_the_axial_mode_is_damped_as_in_full_by_strong_contacts(scene, damping):
    """2.46 kHz. Contacts that store all of its energy would have a damping ratio of pi f tau: 0.09 and 0.15.

    Operators to 1e-6; the free decay of `rings` to 0.1 %, by its steps of 5 us.
    """
    spindle = scene("7003C-spindle")
    damped, plain = (spindle.replace({"bearing.contact_damping_us": us}) for us in (damping, 0.0))
    full, undamped = (nearest(full_and_quick(one)[0], 2_460) for one in (damped, plain))
    assert 0.8 < (full[1] - undamped[1]) / (np.pi * full[0] * 1e-6 * damping) < 1.0
    for fidelity in FIDELITIES:
        assert nearest(full_and_quick(damped, fidelity)[1], 2_460) == pytest.approx(full, rel=1e-6)
    assert nearest(poles_of_rings(damped, 20_000, axis=0), 2_460) == pytest.approx(full, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "rpm", "frequency", "damping"),
    [
        ("7009C-full-ceramic", 12_000, 14_330, 0.1),
        ("7009C-full-ceramic", 18_000, 14_630, 0.1),
        # the free inner ring that tilts between the balls, backward and forward
        ("7003C-bare", 10_000, -4_103, 0.2),
        ("7003C-bare", 10_000, 4_300, 0.2),
    ],
)
def test_free_decay_of_rings_has_the_modes_of_full(scene, name, rpm, frequency, damping):
    """Frequencies within 1 %; damping ratios within the share given."""
    full = nearest(full_and_quick(scene(name).replace({"operation.speed_rpm": rpm}))[0], frequency)
    assert full[0] == pytest.approx(frequency, rel=5e-3)
    found = nearest(poles_of_rings(scene(name), rpm), frequency)
    assert found[0] == pytest.approx(full[0], rel=0.01)
    assert found[1] == pytest.approx(full[1], rel=damping)
