"""Reflection in the plane of axis and vertical: speed, y components and x and z rotations turn their sign.

Gravity lies in that plane, so nothing has to be left out. Ball j becomes ball -j, a race's harmonics turn
their phase: cos(n a + p) seen from the other side is cos(n a - p).
"""

import numpy as np
import pytest

from fmu_bearing.engine.layout import P, Z
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import Model, prepare
from tests.extremes.bearings import PERFECT, RINGS, SILENT, drive, edited, feed
from tests.extremes.cases import COMPUTED

FLIPPED = [
    f"{body}.{kind}.y" for body in ("inner_ring", "outer_ring") for kind in ("velocity", "displacement")
]
FLIPPED += ["cage.velocity.y", "friction_torque", "inner_ring.tilt.z"]


def wavy(phase):
    """Imperfections of all kinds with harmonics' phases times ``phase``."""
    table = [(2, 0.1, 40.0), (12, 0.05, 100.0), (13, 0.05, -75.0)]
    rows = [{"order": n, "amplitude_um": a, "phase_deg": phase * p} for n, a, p in table]
    flaws = {"seed": 1, "unbalance_um": 2.0, "ball_diameter_spread_nm": 50.0}
    return {**flaws, "inner_race_harmonic": rows, "outer_race_harmonic": rows[1:]}


def turning(changes, rpm, mirror, fidelity, method):
    """A bearing under a load in both directions, or its mirror image."""
    model = prepare(edited("7003C-bare", changes), fidelity=fidelity, method=method)
    if mirror:
        numbers = model.parameters.copy()
        first, balls = int(numbers[P.AT_OVERSIZE]), int(numbers[P.BALLS])
        sizes = numbers[first : first + balls]
        numbers[first : first + balls] = np.roll(sizes[::-1], 1)
        numbers.setflags(write=False)
        model = Model(model.scene, numbers, model.variables)
    run = Instance(model)
    if fidelity == "full":
        # Rounding decides between two step lengths now and then, and then the runs differ by their errors:
        # these have to be small against what is compared.
        run.set("max_internal_step", 5e-6)
        run.set("tolerance", 1e-5)
    feed(
        run,
        {"rpm": -rpm if mirror else rpm, "radial_load.y": -30.0 if mirror else 30.0, "radial_load.z": 10.0},
    )
    run.initialise()
    return drive(run, 3e-3, 1e-4)


def agree(one, other, share):
    """Outputs agree within ``share`` of the largest of their kind, ``FLIPPED`` ones with the other sign."""
    for k, name in enumerate(Z.BEARING_OUTPUTS):
        if name.startswith(("solver.", "energy.", "cage.whirl")):
            continue
        left = one.column(name)
        right = (
            -other.column(name)
            if name in FLIPPED or name.startswith("friction_torque")
            else other.column(name)
        )
        size = np.abs(left).max()
        if name in RINGS:
            size = np.abs(one.columns(RINGS)).max()
        # 1 nm/s, 1 pm and such are rounding: a perfect bearing on a condensed fidelity hardly moves at all
        floor = 1e-9 if "velocity" in name else 1e-12
        assert np.abs(left - right).max() <= share * size + floor, (k, name)


@pytest.mark.parametrize(("fidelity", "method"), COMPUTED)
def test_a_perfect_bearing_turned_backwards_is_the_mirror_image(fidelity, method):
    forward, backward = (turning(PERFECT, 2e4, mirror, fidelity, method) for mirror in (False, True))
    agree(forward, backward, 1e-4)


@pytest.mark.parametrize(("fidelity", "method"), COMPUTED)
def test_an_imperfect_bearing_and_its_mirror_image(fidelity, method):
    runs = [
        turning(SILENT | {"imperfections": wavy(phase)}, 2e4, phase < 0.0, fidelity, method)
        for phase in (1.0, -1.0)
    ]
    agree(*runs, 1e-4)
    # it is the mirrored waviness that does it: the same waves turned backwards are another bearing
    same = turning(SILENT | {"imperfections": wavy(1.0)}, 2e4, True, fidelity, method)
    with pytest.raises(AssertionError):
        agree(runs[0], same, 1e-2)
