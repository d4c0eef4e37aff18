"""fmu-bearing envelope on records of a logger: their times, columns, units, the speed of the shaft."""

import numpy as np
import pytest

RATE, COUNT = 12_000.0, 24_000
TIME = np.arange(COUNT) / RATE
#: m/s2: strokes of 105 Hz through a resonance of 3 kHz, in noise.
STROKES = 107.0


def values():
    """Acceleration (m/s2)."""
    since = TIME % (1.0 / STROKES)
    noise = np.random.default_rng(5).normal(size=COUNT)
    return 20.0 * np.exp(-800.0 * since) * np.sin(2.0 * np.pi * 3000.0 * since) + noise


@pytest.fixture
def record_of(tmp_path):
    """Write columns under their titles; return the file."""

    def write(title="acceleration (m/s2)", time="{:.6f}", times=TIME, **others):
        columns = {title: values(), **others}
        path = tmp_path / "measured.csv"
        with path.open("w", encoding="utf-8") as file:
            file.write(",".join(["time", *columns]) + "\n")
            for t, *row in zip(times, *columns.values(), strict=True):
                file.write(",".join([time.format(t), *(f"{value:.6g}" for value in row)]) + "\n")
        return path

    return write


@pytest.mark.parametrize("time", ["{:.6f}", "{:.8g}", "{:.17g}"])
def test_times_that_were_rounded_are_taken(run, record_of, time):
    done = run("envelope", record_of(time=time), "--signal", "acceleration", "--json")
    (found,) = done.data["envelopes"]
    # 0.5 us at both ends of 1.9 s, and settle = 0.1 s of 2 s left out
    assert found["resolution_Hz"] == pytest.approx(1.0 / 1.9, rel=1e-4)


def test_uneven_times_are_refused_with_place_and_size(run, record_of):
    times = TIME + np.where(np.arange(COUNT) > 12_000, 0.5 / RATE, 0.0)
    refused = run("envelope", record_of(times=times), "--signal", "acceleration")
    assert refused.exit_code == 2 and "uneven" in refused.stderr and "too few" not in refused.stderr
    assert "at 1 s the step is 0.000125 s, the middle one 8.3e-05 s" in refused.stderr.replace("8.4e", "8.3e")
    assert "run " not in refused.stderr


def test_too_few_times_are_refused_with_their_number(run, record_of):
    few = run("envelope", record_of(), "--signal", "acceleration", "--settle", "1.9999")
    assert few.exit_code == 2 and "too few: 1, and 3 or more are needed" in few.stderr
    assert "uneven" not in few.stderr
