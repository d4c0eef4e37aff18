"""CSV files of inputs: units by column, separators, decimal commas, errors with line and column."""

import re
import warnings

import numpy as np
import pytest

from fmu_bearing import simulate
from fmu_bearing.results.result import ResultError
from fmu_bearing.run.input_file import read_inputs
from fmu_bearing.run.inputs import Input
from fmu_bearing.scene.read import with_fidelity

INPUTS = {
    "shaft_speed": Input(0.0, -10472.0, 10472.0, "rad/s"),
    "preload": Input(0.0, 0.0, 1e4, "N"),
    "radial_load.z": Input(0.0, -3e3, 3e3, "N"),
    "oil_temperature": Input(293.0, 233.0, 473.0, "K"),
    "gain": Input(1.0),
}


def read(tmp_path, text):
    file = tmp_path / "inputs.csv"
    file.write_text(text, "utf-8")
    return read_inputs(file, INPUTS)


@pytest.mark.parametrize(
    "text",
    [
        "time,shaft_speed_rpm,oil_temperature_degC,radial_load.z\n0,30000,40,-1.5\n0.5,60000,-20,2.5\n",
        "time;shaft_speed_rpm;oil_temperature_degC;radial_load.z\n0;30000;40;-1,5\n0,5;60000;-20;2,5\n",
        "time\tshaft_speed_rpm\toil_temperature_degC\tradial_load.z_N\r\n0\t3e4\t40\t-1,5\r\n0,5\t6e4\t-20\t2,5\r\n",
        '\ufeff"time_s"; "shaft_speed_rpm"; "oil_temperature_degC"; "radial_load.z"\n\n# remark\n'
        '0;30000.0;40,0;"-1,5"\n0.5;60000;-20;2.5\n\n',
    ],
)
def test_units_separators_and_decimal_commas(tmp_path, text):
    table = read(tmp_path, text)
    assert table.dtype.names == ("time", "shaft_speed", "oil_temperature", "radial_load.z")
    np.testing.assert_array_equal(table["time"], [0.0, 0.5])
    np.testing.assert_allclose(table["shaft_speed"], np.array([1e3, 2e3]) * np.pi, rtol=1e-15)
    np.testing.assert_allclose(table["oil_temperature"], [313.15, 253.15], rtol=1e-15)
    np.testing.assert_array_equal(table["radial_load.z"], [-1.5, 2.5])


def test_values_at_both_bounds_are_taken(tmp_path):
    table = read(tmp_path, "time,preload,oil_temperature_degC\n0,0,-40.15\n1,10000,199.85\n")
    np.testing.assert_allclose(table["preload"], [0.0, 1e4], rtol=1e-15)
    np.testing.assert_allclose(table["oil_temperature"], [233.0, 473.0], rtol=1e-15)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "holds no values"),
        ("time,preload\n", "holds no values"),
        ("u,preload\n0,1\n", r"the first column must be 'time' \(s\), not 'u'"),
        ("time,preload\n0,1\n1,one\n", "line 3, column 'preload': 'one' is not a finite number"),
        ("time,preload\n0,1\n\n1,\n", "line 4, column 'preload': '' is not a finite number"),
        ("time,preload\n0,nan\n", "line 2, column 'preload': 'nan' is not a finite number"),
        ("time;preload\n0;1.000,5\n", "'1.000,5' is not a finite number"),
        ("time,preload\n0,5,1,5\n", "line 2 has 4 values for 2 columns; with decimal commas .* semicolons"),
        ("time,preload\n0,1\n1,1\n0.5,1\n", "line 4: time falls from 1 to 0.5 s"),
        ("time,prelaod\n0,1\n", "column 'prelaod': there is no input 'prelaod'; did you mean 'preload'"),
        ("time,preload,preload_N\n0,1,1\n", "column 'preload': preload is given more than once"),
        ("time,preload_rpm\n0,1\n", r"preload is not given in r/min; write preload \(N\) or preload_N"),
        ("time,gain_mm\n0,1\n", r"gain is not given in mm; write gain \(\)"),
        (
            "time,shaft_speed_rpm\n0,1\n1,200000\n",
            "line 3, column 'shaft_speed_rpm': 200000 is refused: allowed are -100000 to 100000 r/min",
        ),
        ("time;oil_temperature_degC\n0;-80,5\n", "-80.5 is refused: allowed are -40.15 to 199.85 degC"),
        ("time,preload\n0,-1\n", "-1 is refused: allowed are 0 to 10000 N"),
    ],
)
def test_what_is_wrong_is_reported_with_line_and_column(tmp_path, text, reason):
    with pytest.raises(ResultError, match=reason):
        read(tmp_path, text)


def test_a_file_that_is_no_text(tmp_path):
    file = tmp_path / "inputs.csv"
    file.write_bytes(b"time,preload\n0,\xff\x01\n")
    with pytest.raises(ResultError, match="cannot be read as text in UTF-8"):
        read_inputs(file, INPUTS)
    with pytest.raises(ResultError, match="there is no such file"):
        read_inputs(tmp_path / "none.csv", INPUTS)
    with pytest.raises(ValueError, match="path of a CSV file, not an array"):
        simulate("examples/scenes/7003C-bare.toml", 1e-3, inputs=[1, 2])


def test_a_run_from_r_min_is_that_from_rad_s(silent, tmp_path):
    rings = with_fidelity(silent, model="rings")
    (tmp_path / "rpm.csv").write_text("time;shaft_speed_rpm\n0;6000\n0,002;12000\n")
    found = simulate(rings, 2e-3, inputs=tmp_path / "rpm.csv", outputs=["shaft_speed"])
    np.testing.assert_allclose(found["shaft_speed"] * 30.0 / np.pi, [6000.0, 6000.0, 9000.0], rtol=1e-12)
    # inputs are taken at the beginning of each step, as FMPy does


def held(silent, tmp_path, times, **more):
    """Speeds (r/min) of a run of 2 ms whose file has these times, the speed going from 6,000 to 12,000."""
    rows = "".join(f"{time!r},{6000.0 + 6000.0 * k}\n" for k, time in enumerate(times))
    (tmp_path / "rpm.csv").write_text(f"time,shaft_speed_rpm\n{rows}")
    rings = with_fidelity(silent, model="rings")
    run = simulate(rings, 2e-3, inputs=tmp_path / "rpm.csv", outputs=["shaft_speed"], **more)
    return run["shaft_speed"] * 30.0 / np.pi


@pytest.mark.parametrize(
    "times",
    [(1.0, 1.002), (1.7e9, 1.7e9 + 0.25), (-1.0, -0.5), (2e-3, 4e-3)],
    ids=["late", "clock", "past", "end"],
)
def test_a_file_whose_times_miss_the_run_is_refused_with_both_ranges(silent, tmp_path, times):
    first, last = (re.escape(f"{time:.10g}") for time in times)
    reason = rf"rpm.csv: times are {first} to {last} s, the run takes 0 to 0.002 s.*--input-from-start"
    with pytest.raises(ValueError, match=reason):
        held(silent, tmp_path, times)


@pytest.mark.parametrize(
    ("times", "words"),
    [
        ((0.0, 5e-4), "times are 0 to 0.0005 s, the run takes 0 to 0.002 s: the last values are held after"),
        (
            (1e-3, 2e-3),
            "times are 0.001 to 0.002 s.*: the first values are held before 0.001 s: --",
        ),
        (
            (5e-4, 8e-4),
            "the first values are held before 0.0005 s.*; the last .* after 0.0008 s",
        ),
    ],
)
def test_a_file_that_covers_a_part_of_the_run_says_so(silent, tmp_path, times, words):
    with pytest.warns(UserWarning, match=words):
        held(silent, tmp_path, times)


@pytest.mark.parametrize("times", [(0.0, 2e-3), (-1.0, 5.0), (0.0, 1e-3), (3.0,)])
def test_a_file_that_covers_the_run_says_nothing(silent, tmp_path, times):
    """The last step begins 1 ms before the end; one row is a constant."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        held(silent, tmp_path, times)


@pytest.mark.parametrize("begin", [1.0, 1.7e9, -3.0])
def test_times_are_shifted_to_the_start(silent, tmp_path, begin):
    found = held(silent, tmp_path, (begin, begin + 0.25), input_from_start=True)
    # 6,000 r/min in 0.25 s, read at the beginning of each step; a clock of 1.7e9 s has digits of 0.24 us
    np.testing.assert_allclose(found, [6000.0, 6000.0, 6024.0], rtol=1e-6)
