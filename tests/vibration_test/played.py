"""Readings of the vibration test that are played, not computed."""

import numpy as np

from fmu_bearing.vibration_test.reading import Reading

#: um/s in the bands by loading piece; each further seed has a tenth more.
PIECES = {1e5: (30.0, 80.0, 40.0), 1e6: (30.0, 40.0, 36.0)}
PLACES = (100.0, 1000.0, 5000.0)  # Hz


def played(scene):
    """A reading of one bin in each band, and of a line of each source where it is alone."""
    frequency = np.arange(6251) * 2.0
    energy = np.zeros(frequency.size)
    flaws = scene.imperfections
    values = PIECES[scene.mounting.pedestal_stiffness_N_m]
    if len(flaws.sources) == 1:
        values = tuple(value / 2.0 for value in values)  # four sources, each a quarter of the energy
    for at, value in zip(PLACES, values, strict=True):
        energy[round(at / 2.0)] = ((1.0 + 0.1 * (flaws.seed - 1)) * value) ** 2
    return Reading(frequency, energy, 0.0, orbit=0.4178)


def play(monkeypatch):
    """Play all readings of `vibration`, and return the list that the scenes of its runs go into."""
    seen = []

    def read(scene):
        seen.append(scene)
        return played(scene)

    monkeypatch.setattr("fmu_bearing.vibration_test.vibration.reading", read)
    return seen
