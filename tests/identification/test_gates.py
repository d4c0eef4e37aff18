"""Honest values and uncertainties: ten machines with a known truth, each measured with noise.

Each machine has surfaces of its own (another seed than any the search averages over). 28 levels at four
speeds and 7 lines carry 2 dB of noise; a fifth speed is checked. The search starts at other values, up to a
factor of two away. Levels are averaged over two seeds, whose mean is half as uncertain again as that of many.
"""

import numpy as np
import pytest

from fmu_bearing import identify
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.free import free_numbers, start_point
from fmu_bearing.identification.model import Levels
from fmu_bearing.scene.read import with_fidelity

START = {
    "imperfections.unbalance_um": 2.0,
    "imperfections.inner_race_amplitude_um": 0.6,
    "imperfections.outer_race_amplitude_um": 1.5,
    "mounting.pedestal_stiffness_N_m": 0.7,
    "mounting.housing.mass_kg": 1.3,
}
SPEEDS, CHECKED = (9000.0, 14000.0, 20000.0, 27000.0), 17000.0
PLACES = (
    (0.0, 105.0, 0.0), (0.0, 150.0, 0.0), (0.0, 0.0, 105.0), (-100.5, 0.0, 0.0), (0.0, 0.0, 200.0),
    (0.0, 120.0, 90.0), (60.0, 140.0, 0.0),
)  # fmt: skip
NOISE, DRAWS = 2.0, 10
LENGTHS = {"duration": 0.055, "settle": 0.01}  # s: eight turns of the shaft at 9,000 r/min


def row(place, speed, quantity, role="fit"):
    at = dict(zip(("x_mm", "y_mm", "z_mm"), place, strict=True))
    return at | {"speed_rpm": speed, "quantity": quantity, "value_dB": 70.0, "std_dB": NOISE, "role": role}


def table():
    """28 levels and 7 lines that are fitted, 7 levels that are checked."""
    levels = [row(place, speed, "leq") for speed in SPEEDS for place in PLACES]
    lines = [row(PLACES[0], speed, "line[f_r]") for speed in SPEEDS]
    lines += [row(PLACES[2], speed, "line[f_r]") for speed in SPEEDS[1:]]
    return levels + lines + [row(place, CHECKED, "leq", "check") for place in PLACES]


@pytest.mark.heavy
def test_values_are_known_as_well_as_they_say(scene, tmp_path):
    truth = with_fidelity(scene("7003C-spindle"), model="response")
    free = free_numbers(truth, list(START))
    start = truth.replace({one.key: one.start * START[one.key] for one in free})
    rows = table()
    assert sum(one["role"] == "fit" for one in rows) == 35
    machine = Levels(truth, read_data(rows, truth), free, **LENGTHS)
    noise = np.random.default_rng(5)
    scores, checked = [], []
    for draw in range(DRAWS):
        exact = machine.at(start_point(free), [1000 + draw], "response", check=True)[0]
        measured = exact + noise.normal(0.0, NOISE, len(exact))
        data = [one | {"value_dB": float(value)} for one, value in zip(rows, measured, strict=True)]
        found = identify(
            start, data, list(START), seeds=2, starts=1, folder=tmp_path, progress=False, **LENGTHS
        )
        off = [np.log(one.value / true.start) for one, true in zip(found.estimates, free, strict=True)]
        scores.append(np.array(off) / [one.std for one in found.estimates])
        checked.append(found.rms(fit=False))
    table_of = np.array(scores)
    print(np.round(table_of, 2), np.round(checked, 2))
    assert (np.abs(table_of) < 2.0).sum(axis=0).min() >= 8
    assert 0.6 < np.mean(table_of**2) < 1.6  # neither blind nor boastful
    assert np.sqrt(np.mean(np.square(checked))) < 1.5 * NOISE
