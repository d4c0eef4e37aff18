"""Measured values: what is read, and what is refused in words that help."""

import math

import numpy as np
import pytest

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.layout import SD
from fmu_bearing.identification.data import STD, read_data
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.quantities import parse_quantity

ROW = {"microphone": "P1", "speed_rpm": 9000.0, "quantity": "leq", "value_dB": 70.0}


@pytest.fixture(scope="module")
def spindle(scene):
    return scene("7003C-spindle")


def read(spindle, *rows, **options):
    return read_data([ROW | row for row in rows], spindle, **options)


def test_a_file_with_commas_and_one_with_semicolons_are_the_same(spindle, tmp_path):
    commas, semicolons = tmp_path / "a.csv", tmp_path / "b.csv"
    commas.write_text(
        "# a remark\nmicrophone,speed_rpm,preload_N,quantity,value_dB,std_dB,role\n"
        "P3,9000,,leq_a,70.5,1.5,fit\n\nP3,9000,,line[f_i - 2 f_r],50.25,2,check\n"
    )
    semicolons.write_text(
        "\ufeffmicrophone;speed_rpm;preload_N;quantity;value_dB;std_dB;role\n"
        "P3;9000;;leq_a;70,5;1,5;fit\nP3;9000;;line[f_i - 2 f_r];50,25;2;check\n"
    )
    one, other = read_data(commas, spindle), read_data(str(semicolons), spindle)
    assert [(d.value, d.std, d.fit, d.position) for d in one] == [
        (70.5, 1.5, True, (0.0, 0.0, 0.105)), (50.25, 2.0, False, (0.0, 0.0, 0.105))
    ]  # fmt: skip
    assert [d.quantity for d in one] == [d.quantity for d in other]
    assert one[0].conditions == (("operation.speed_rpm", 9000.0),)
    assert one[1].source.endswith("line 5")


def test_frames_datasets_and_records_are_the_same(spindle):
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    rows = [ROW | {"microphone": name, "preload_N": 300.0} for name in ("P1", "P2")]
    records, frame = read_data(rows, spindle), read_data(pandas.DataFrame(rows), spindle)
    grid = xarray.Dataset(
        {"value_dB": (("microphone", "speed_rpm"), [[70.0, math.nan], [70.0, math.nan]])},
        {"microphone": ["P1", "P2"], "speed_rpm": [9000.0, 12000.0], "quantity": "leq", "preload_N": 300.0},
    )
    from_grid = read_data(grid, spindle)

    def plain(found):
        return [(d.place, d.conditions, d.value, d.std, d.fit) for d in found]

    assert plain(records) == plain(frame) == plain(from_grid)  # nothing was measured where the grid has NaN
    assert records[0].std == STD and read_data(records, spindle) == records


def test_places_velocities_and_keys_as_columns(spindle):
    found = read(
        spindle,
        {"microphone": "", "x_mm": 0.0, "y_mm": 200.0, "z_mm": -10.0},
        {"microphone": "", "quantity": "velocity[housing.z]", "value_dB": None, "value_mm_s": 1.0},
        {"lubricant.viscosity_Pa_s": 0.02, "speed_rpm": None},
    )
    assert found[0].position == (0.0, 0.2, -0.01)
    assert found[1].value == pytest.approx(120.0)  # 1 mm/s re 1 nm/s
    assert found[1].quantity.channel == SD.c_body(1, 2) and found[1].position is None
    assert found[2].conditions == (("lubricant.viscosity_Pa_s", 0.02),)


def test_background_is_beside_its_value_or_in_a_file_of_its_own(spindle, tmp_path):
    (one,) = read(spindle, {}, {"quantity": "background_leq", "value_dB": 65.0})
    own = tmp_path / "background.csv"
    own.write_text("microphone,speed_rpm,quantity,value_dB\nP1,9000,leq,65\n")
    (other,) = read(spindle, {}, background=own)
    assert one.background == other.background == 65.0
    with pytest.raises(IdentifyError, match="without a measured value beside it.*P2"):
        read(spindle, {}, {"microphone": "P2", "quantity": "background_leq"})


def test_an_empty_cell_of_a_frame_is_the_default(spindle):
    (row,) = read(spindle, {"std_dB": math.nan, "role": math.nan})
    assert (row.std, row.fit) == (STD, True)


def test_rows_that_were_read_before_serve_as_background(spindle):
    noise = read(spindle, {"value_dB": 61.0})
    (row,) = read(spindle, {}, background=noise)
    assert (row.value, row.background) == (70.0, 61.0)


def test_lines_follow_the_speed():
    kinematics = KinematicFrequencies(f_r=300.0, f_c=125.0, f_b=800.0, f_i=2100.0, f_o=1500.0)
    for text, frequency in (
        ("line[f_r]", 300.0), ("line[2 f_r]", 600.0), ("line[f_i - 2 f_r]", 1500.0),
        ("line[2f_o+f_c]", 3125.0), ("line[467 Hz]", 467.0), ("line[1.2kHz]", 1200.0),
    ):  # fmt: skip
        assert parse_quantity(text).line(kinematics) == frequency
    assert parse_quantity("third_octave[1000]").frequency == 1000.0
    assert parse_quantity("third_octave[315]").frequency == pytest.approx(10**2.5)


REFUSED = [
    ({"quantity": "laeq"}, "there is no quantity 'laeq'; did you mean 'leq'"),
    ({"quantity": "third_octave[1100]"}, "1100 Hz is not a nominal centre.*nearest is 1000"),
    ({"quantity": "third_octave[loud]"}, "'loud' is not a centre"),
    ({"quantity": "line[f_x]"}, r"'f_x' is not a line; .*line\[2 f_r\]"),
    ({"quantity": "line[467]"}, "with its unit"),
    ({"quantity": "line[5 Hz]"}, "outside 20 Hz to 20 kHz"),
    ({"quantity": "leq[3]"}, "'3' is too much"),
    ({"quantity": "velocity[housing.w]"}, "not a direction of a body.*inner_ring, outer_ring, housing"),
    ({"microphone": "P9"}, "no microphone 'P9'; the scene has P1, P2, P3, P4"),
    ({"microphone": "P1", "x_mm": 1.0}, "leave out one"),
    ({"microphone": "", "x_mm": 1.0, "y_mm": 2.0}, "alone is not a place"),
    ({"value_dB": math.nan}, "value_dB = nan is not finite"),
    ({"value_dB": "loud"}, "value_dB = 'loud' is not a number"),
    ({"value_dB": 2e5}, "not a level in dB"),
    ({"value_dB": None, "value_mm_s": 1.0}, "value_mm_s belongs to a velocity"),
    ({"std_dB": 0.0}, "std_dB = 0 must be above 0"),
    ({"role": "train"}, "role = 'train' is unknown: write fit or check"),
    ({"speed_rpm": 1e9}, "speed_rpm = 1e.09 lies outside"),
    ({"value_db": 70.0}, "there is no column 'value_db'; did you mean 'value_dB'"),
    ({"mounting.preload": 70.0}, "did you mean 'mounting.preload_N'"),
    ({"preload_N": 300.0, "mounting.preload_N": 300.0}, "are the same condition"),
]


@pytest.mark.parametrize(("row", "message"), REFUSED, ids=[m[:24] for _, m in REFUSED])
def test_what_is_refused(row, message, spindle):
    with pytest.raises(IdentifyError, match=message):
        read(spindle, row)


def test_all_problems_are_reported_at_once_with_their_lines(spindle, tmp_path):
    path = tmp_path / "bad.csv"
    path.write_text("microphone,quantity,value_dB\nP9,leq,70\nP1,leq,70\nP1,leq,loud\nP1,leq,70\n")
    with pytest.raises(IdentifyError) as caught:
        read_data(path, spindle)
    lines = str(caught.value).splitlines()
    assert [line.split(": ")[0].rpartition(" ")[2] for line in lines] == ["2", "4", "5"]
    assert "was given before" in lines[2]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty; its first line names the columns: microphone"),
        ("# nothing\n\n", "is empty"),
        ("microphone,quantity,value_dB\n", "holds no measured value"),
        ("microphone,quantity\nP1,leq\n", "column value_dB is missing"),
        ("microphone,quantity,value_dB\nP1,leq\n", "2 values for 3 columns"),
        ("microphone,quantity,value_dB\nP1,background_leq,60\n", "without a measured value"),
    ],
)
def test_files_that_hold_nothing(text, message, spindle, tmp_path):
    path = tmp_path / "measured.csv"
    path.write_text(text)
    with pytest.raises(IdentifyError, match=message):
        read_data(path, spindle)


def test_what_is_no_table(spindle, tmp_path):
    with pytest.raises(IdentifyError, match="there is no such file"):
        read_data(tmp_path / "none.csv", spindle)
    with pytest.raises(IdentifyError, match="cannot be read"):
        read_data(3.0, spindle)
    with pytest.raises(IdentifyError, match="row 0 of the data is a"):
        read_data(np.zeros(3), spindle)


ASKED = [
    ({"value_dB": 0.0}, "is this microphone dead"),
    ({"value_dB": 0.2}, "is it a pressure in Pa. 0.2 Pa are 80.0 dB"),
    ({"value_dB": 19.9, "quantity": "leq_a"}, "outside 20 to 160 dB"),
    ({"value_dB": 160.1}, "outside 20 to 160 dB, .*is it another unit"),
    ({"value_dB": 0.0, "quantity": "line[f_r]"}, "outside 5 to 160 dB, where bands and lines"),
    ({"microphone": "", "quantity": "velocity[housing.z]", "value_dB": 1.5}, "is it another unit"),
    ({"speed_rpm": 133.3}, "speed_rpm = 133.3 is below 500 r/min: is it in Hz. 133.3 Hz are 7998 r/min"),
    ({"speed_rpm": None, "operation.speed_rpm": 499.0}, "below 500 r/min"),
]


@pytest.mark.parametrize(("row", "message"), ASKED, ids=[m[:24] for _, m in ASKED])
def test_what_no_machine_usually_has_is_asked_about(row, message, spindle):
    with pytest.raises(IdentifyError, match=message) as caught:
        read(spindle, row)
    lines = str(caught.value).splitlines()
    assert len(lines) == 2 and "--accept (accept=True)" in lines[1]
    (taken,) = read(spindle, row, accept=True)
    with pytest.raises(IdentifyError, match=message):  # rows that were read before are asked about too
        read_data([taken], spindle)


def test_usual_levels_and_quiet_lines_are_not_asked_about(spindle):
    found = read(
        spindle,
        {"value_dB": 20.0},
        {"quantity": "leq_a", "value_dB": 160.0},
        {"quantity": "line[f_r]", "value_dB": 17.9},
        {"quantity": "third_octave[1000]", "value_dB": 5.0, "speed_rpm": 500.0},
    )
    assert len(found) == 4


def test_backgrounds_are_asked_about(spindle):
    with pytest.raises(IdentifyError, match="is this microphone dead"):
        read(spindle, {}, background=[ROW | {"value_dB": 0.0}])
