"""Energies of the 7003C hybrid in L, M, H and two lines, kept so that tests need not run its 214 tests.

``python -m tests.vibration_test.known`` makes the table again, in minutes; `test_inverse` runs a part of it.
"""

import importlib
import json
from pathlib import Path

import numpy as np

from fmu_bearing.vibration_test import inverse
from fmu_bearing.vibration_test.inverse.energies import Energies, band_windows, energies, line_window
from fmu_bearing.vibration_test.inverse.runs import Spectra, _reference, _Runs, spectra
from fmu_bearing.vibration_test.subject import subject

TABLE = Path(__file__).with_name("energies.json")
LINES = ("f_i - f_r", "f_o")
_ARRAYS = ("inner_orders", "outer_orders", "inner", "outer", "balls", "bending")
OPTIONS = {"piece": "soft", "speed_rpm": None, "load_N": None}


def bearing():
    """The bearing of the table."""
    return subject("7003C")


def runs():
    """Scenes of its runs."""
    return _Runs(*_reference(bearing()), OPTIONS)


def kept():
    """Energies of the table, its windows L, M, H and `LINES`."""
    data = json.loads(TABLE.read_text("utf-8"))
    return Energies(tuple(data["names"]), **{name: np.array(data[name]) for name in _ARRAYS})


def stub():
    """Spectra with frequencies and orbit alone: what names and places of windows need."""
    data = json.loads(TABLE.read_text("utf-8"))
    made = runs()
    frequency = np.arange(data["bins"]) * data["width"]
    none = np.zeros((0, frequency.size))
    return Spectra(
        made.rig(made.scene), made.form, frequency, data["orbit"], np.zeros(frequency.size), none,
        np.zeros(0, dtype=int), none, none,
    )  # fmt: skip


def only(found, names):
    """Some windows of energies."""
    places = [found.names.index(name) for name in names]
    return Energies(
        tuple(names), found.inner_orders, found.outer_orders, found.inner[places], found.outer[places],
        found.balls[places], found.bending[places],
    )  # fmt: skip


def play(monkeypatch):
    """Let `surface` take the table in the place of runs, and fewer draws."""
    monkeypatch.setattr(inverse, "DRAWS", 6000)
    draws = importlib.import_module("fmu_bearing.vibration_test.inverse.posterior")  # not its function
    monkeypatch.setattr(draws, "_POOL", 60_000)
    monkeypatch.setattr(inverse, "spectra", lambda *_: stub())
    monkeypatch.setattr(inverse, "energies", lambda _, windows: only(kept(), [one.name for one in windows]))


def write():
    """Make the table from runs, or from what is kept of them."""
    found = spectra(bearing())
    windows = [*band_windows(found.scene), *(line_window(found, name) for name in LINES)]
    made = energies(found, windows)

    def short(values):
        return values.tolist() if values.dtype.kind == "i" else [
            short(row) if row.ndim else float(f"{row:.4g}") for row in values
        ]  # fmt: skip

    data = {"names": made.names, "bins": found.frequency.size, "width": float(found.frequency[1]),
            "orbit": found.orbit} | {name: short(getattr(made, name)) for name in _ARRAYS}  # fmt: skip
    TABLE.write_text(json.dumps(data, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write()
