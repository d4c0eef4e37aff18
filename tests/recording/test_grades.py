"""Grades of surfaces as sound: levels follow the ratio of their amplitudes, and what does not scale stays."""

import numpy as np
import pytest

from fmu_bearing.recording.record import record
from fmu_bearing.scene.read import catalogue, with_fidelity

QUICK = {"duration": 0.2, "radiation_model": "compact", "warn": False, "progress": False}
RACES = ("inner_race_amplitude_um", "outer_race_amplitude_um")
#: Parts of a grade that are not waves of the races.
ELSE = ("unbalance_um", "ball_diameter_spread_nm", "ball_form_nm")


def graded(scene, grade, without=(), seed=3):
    """The spindle with the surfaces of a grade, some of its imperfections left out."""
    table = {"seed": seed} | catalogue("grades")[grade] | dict.fromkeys(without, 0.0)
    return scene("7003C-spindle").replace({"imperfections": table})


def energies(scene, model="response"):
    """Mean squares of pressure over that of 0 dB at the microphones, A-weighted."""
    found = record(with_fidelity(scene, model=model), **QUICK)
    return 10.0 ** (found.levels(weighting="A") / 10.0)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("model", "size", "within"), [("response", 1.0, 0.15), ("rings", 1.0, 0.15), ("rings", 0.1, 0.02)]
)
def test_races_alone_differ_by_the_ratio_of_their_amplitudes(scene, model, size, within):
    """20 lg(0.3/0.15) = 6.02 dB. What is of second order adds 0.13 dB, a tenth of that with a tenth."""
    own = catalogue("grades")
    ratio = own["P4"]["outer_race_amplitude_um"] / own["P2"]["outer_race_amplitude_um"]
    assert ratio == own["P4"]["inner_race_amplitude_um"] / own["P2"]["inner_race_amplitude_um"] == 2.0
    found = []
    for grade in ("P4", "P2"):
        races = {f"imperfections.{key}": size * own[grade][key] for key in RACES}
        found.append(energies(graded(scene, grade, ELSE).replace(races), model))
    assert 10.0 * np.log10(found[0] / found[1]) == pytest.approx(20.0 * np.log10(ratio), abs=within)


@pytest.mark.heavy
def test_real_grades_differ_by_what_each_of_their_parts_does(scene):
    """P4 over P2 by energies: races a factor of 4, unbalance and sizes of 2.8, balls of G3 in both 1.

    Parts have no order in common but where balls of several sizes pass, so energies add: to 0.3 dB.
    """
    names = {"races": RACES} | {one: (one,) for one in ELSE}
    every = [key for keys in names.values() for key in keys]
    alone = {
        name: energies(graded(scene, "P4", [key for key in every if key not in keys]))
        for name, keys in names.items()
    }
    shares = {"races": 0.25, "unbalance_um": 0.36, "ball_diameter_spread_nm": 0.36, "ball_form_nm": 1.0}
    expected = sum(alone.values()) / sum(share * alone[name] for name, share in shares.items())
    p4, p2 = (energies(graded(scene, grade)) for grade in ("P4", "P2"))
    assert 10.0 * np.log10(p4 / p2) == pytest.approx(10.0 * np.log10(expected), abs=0.3)
    assert (p4 > p2).all() and (p4 < 4.0 * p2).all()
