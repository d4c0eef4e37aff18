"""One reader for all CSV files: results, inputs, measured tables as spreadsheets and loggers write them."""

import io
import zipfile

import numpy as np
import pandas as pd
import pytest
import scipy

from fmu_bearing import Run, read_scene, simulate
from fmu_bearing.identification.data import read_data
from fmu_bearing.results.result import ResultError
from fmu_bearing.run.input_file import read_inputs
from fmu_bearing.run.inputs import Input
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import EXAMPLES

INPUTS = {
    "shaft_speed": Input(0.0, -10472.0, 10472.0, "rad/s"),
    "preload": Input(0.0, 0.0, 1e4, "N"),
}
#: The same values, as people have them: 0 and 0.5 s, 30,000 and 15,000 r/min, 150.5 and 200 N.
SHEETS = {
    "German": "time;shaft_speed_rpm;preload\n0;30000;150,5\n0,5;15000;200\n",
    "sep=": "sep=;\ntime;shaft_speed_rpm;preload\n0;30000;150,5\n0,5;15000;200\n",
    "sep= in quotes": '"sep=,"\ntime,shaft_speed_rpm,preload\n0,30000,150.5\n0.5,15000,200\n',
    "sep=|": "SEP=|\r\ntime|shaft_speed_rpm|preload\r\n0|30000|150,5\r\n0,5|15000|200\r\n",
    "trailing": "time;shaft_speed_rpm;preload;\n0;30000;150,5;\n0,5;15000;200;\n",
    "trailing values": "time,shaft_speed_rpm,preload\n0,30000,150.5,,\n0.5,15000,200,\n",
    "brackets": "time [s],shaft_speed [rpm],preload [N]\n0,30000,150.5\n0.5,15000,200\n",
    "round brackets": "Time (ms),shaft_speed (1/min),preload (kN)\n0,30000,0.1505\n500,15000,0.2\n",
    "capitals": "Time,shaft_speed_rpm,preload\n0,30000,150.5\n0.5,15000,200\n",
    "t": "t;shaft_speed_rpm;preload\n0;30000;150,5\n0,5;15000;200\n",
    "slash": "Zeit/s\tshaft_speed/(U/min)\tpreload/N\n0\t30000\t150,5\n0,5\t15000\t200\n",
    "units": "time,shaft_speed,preload\ns,r/min,N\n0,30000,150.5\n0.5,15000,200\n",
    "units in brackets": "time;shaft_speed;preload\n[ms];[min-1];[N]\n0;30000;150,5\n500;15000;200\n",
    "units and titles": "time [s],shaft_speed_rpm,preload\ns,r/min,N\n0,30000,150.5\n0.5,15000,200\n",
    "counted": ",time,shaft_speed_rpm,preload\n0,0,30000,150.5\n1,0.5,15000,200\n",
    "numpy": "# time,shaft_speed_rpm,preload\n0,30000,150.5\n0.5,15000,200\n",
    "minus": "time;shaft_speed_rpm;preload\n\u22120;30000;150,5\n0,5;15000;200\n",
    "names in quotes": '"time";"shaft_speed_rpm";"preload"\n"0,0";"30000,0";"150,5"\n"0,5";"15000";"200"\n',
}


@pytest.fixture(params=[*SHEETS, "UTF-16"])
def sheet(request, tmp_path):
    """A file of every kind."""
    text = SHEETS.get(request.param, SHEETS["slash"])
    file = tmp_path / "sheet.csv"
    file.write_bytes(text.encode("utf-16" if request.param == "UTF-16" else "utf-8"))
    return file


def test_inputs_of_every_kind(sheet):
    table = read_inputs(sheet, INPUTS)
    assert table.dtype.names == ("time", "shaft_speed", "preload")
    # rounding of one product and one quotient
    np.testing.assert_allclose(table["time"], [0.0, 0.5], rtol=1e-15)
    np.testing.assert_allclose(table["shaft_speed"], [1000.0 * np.pi, 500.0 * np.pi], rtol=1e-15)
    np.testing.assert_allclose(table["preload"], [150.5, 200.0], rtol=1e-15)


def test_results_of_every_kind(sheet):
    run = Run.load(sheet)
    names = [name.removesuffix("_rpm") for name in run.names]
    assert names == ["shaft_speed", "preload"]
    np.testing.assert_allclose(run.time, [0.0, 0.5], rtol=1e-15)
    np.testing.assert_allclose(run["preload"], [150.5, 200.0], rtol=1e-15)
    # a unit in a title or below it makes SI; a suffix is a part of the name
    speed = [30000.0, 15000.0] if "shaft_speed_rpm" in run.names else [1000.0 * np.pi, 500.0 * np.pi]
    np.testing.assert_allclose(run[run.names[0]], speed, rtol=1e-15)
    if "shaft_speed" in run.names:
        assert run.units["shaft_speed"] == "rad/s"


def test_a_result_saved_again_by_a_spreadsheet_is_the_result(tmp_path):
    scene = with_fidelity(EXAMPLES / "7003C-bare.toml", model="rings")
    run = simulate(scene, 2e-3)
    run.save(tmp_path / "run.csv")
    text = (tmp_path / "run.csv").read_text("utf-8")
    # a spreadsheet in German: the same digits
    german = text.replace(",", ";").replace(".", ",").split("\n", 1)
    head = text.split("\n", 1)[0].replace(",", ";")
    (tmp_path / "german.csv").write_text(f"sep=;\n{head}\n{german[1]}", "utf-8-sig")
    np.testing.assert_array_equal(Run.load(tmp_path / "german.csv").table, run.table)
    # pandas writes the index with its name, "time, s"
    run.to_pandas().to_csv(tmp_path / "pandas.csv")
    np.testing.assert_array_equal(Run.load(tmp_path / "pandas.csv").table, run.table)
    pd.DataFrame(run.table).to_csv(tmp_path / "counted.csv")
    np.testing.assert_array_equal(Run.load(tmp_path / "counted.csv").table, run.table)


@pytest.mark.parametrize(
    "text",
    [
        "sep=;\nmicrophone;speed_rpm;quantity;value_dB;\nP1;20000;leq;62,5;\n",
        "microphone,speed [r/min],quantity,value [dB]\nP1,20000,leq,62.5\n",
        "microphone;speed_rpm;quantity;value_dB\n;r/min;;dB\nP1;20000;leq;62,5\n",
    ],
)
def test_measured_tables(tmp_path, text):
    (tmp_path / "data.csv").write_text(text)
    (found,) = read_data(tmp_path / "data.csv", read_scene(EXAMPLES / "7003C-bare.toml"))
    assert (found.value, found.conditions, found.place) == (62.5, (("operation.speed_rpm", 20000.0),), "P1")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("time [s],x [N]\ns,kN\n0,1\n", r"column 'x \[N\]' has N in its title and kN in the row of units"),
        ("time [N],x\n0,1\n", r"first column must be 'time' \(s\), not 'time \[N\]'"),
        ("time,x,x\n0,1,1\n", "column 'x' is given more than once"),
        ("time,,x\n0,1,1\n", "column 2 has no title"),
        (",time,x\na,0,1\n", "line 2: 'a' has no title above it"),
        ("time;x\n0;1.234,5\n", r"column 'x': '1\.234,5' is not a finite number"),
        ('time,x\n0,"1\n2"\n', "line 3, column 'x': '1 2' is not a finite number"),
    ],
)
def test_what_is_no_result(tmp_path, text, reason):
    (tmp_path / "sheet.csv").write_text(text)
    with pytest.raises(ResultError, match=reason):
        Run.load(tmp_path / "sheet.csv")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("time,preload [rpm]\n0,1\n", r"'preload \[rpm\]': preload is not given in rpm; write preload \(N\)"),
        ("time,preload [furlong]\n0,1\n", "preload is not given in furlong"),
        ("time,shaft_speed_rpm\ns,Hz\n0,1\n", "shaft_speed is not given in Hz"),
        ("time,preload [kN]\n0,20\n", r"20 is refused: allowed are 0 to 10 kN"),
    ],
)
def test_units_that_an_input_has_not(tmp_path, text, reason):
    (tmp_path / "sheet.csv").write_text(text)
    with pytest.raises(ResultError, match=reason):
        read_inputs(tmp_path / "sheet.csv", INPUTS)


def test_an_index_is_no_unit(tmp_path):
    (tmp_path / "sheet.csv").write_text("time,mic[1].pressure,ball[1],der(h),x [furlong]\n0,1,2,3,4\n")
    run = Run.load(tmp_path / "sheet.csv")
    assert run.names == ["mic[1].pressure", "ball[1]", "der(h)", "x"] and run.units == {"x": "furlong"}


def archive(*names):
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as file:
        for name in names:
            file.writestr(name, "")
    return made.getvalue()


def matlab():
    made = io.BytesIO()
    scipy.io.savemat(made, {"x": np.arange(3.0)})
    return made.getvalue()


def modelica():
    made = io.BytesIO()
    scipy.io.savemat(made, {"Aclass": np.array(["Atrajectory", "1.1", ""])}, format="4")
    return made.getvalue()


@pytest.mark.parametrize(
    ("data", "words", "way"),
    [
        (matlab(), "a MATLAB file", "writetable"),
        (modelica(), "a result file of a Modelica tool", 'outputFormat="csv"'),
        (b"MATLAB 7.3 MAT-file, Platform: GLNXA64" + b"\0" * 500, "a MATLAB file", "h5py"),
        (b"\0\0\0\0" * 20, "a MATLAB file", "loadmat"),  # of version 4
        (archive("xl/workbook.xml"), "a workbook of a spreadsheet", "save its sheet as CSV"),
        (archive("mimetype", "content.xml"), "a workbook of a spreadsheet", "save its sheet as CSV"),
        (b"TDSm\x0e\0\0\0", "a LabVIEW file", "nptdms"),
        (b"MDF     4.10", "a measurement file", "asammdf"),
        (b"PAR1\x15\0", "a Parquet file", "read_parquet"),
    ],
)
def test_files_of_other_programs_are_named_with_the_way_to_a_table(tmp_path, data, words, way):
    file = tmp_path / "measured.mat"
    file.write_bytes(data)
    scene = read_scene(EXAMPLES / "7003C-bare.toml")
    for read in (Run.load, lambda path: read_inputs(path, INPUTS), lambda path: read_data(path, scene)):
        with pytest.raises(ValueError, match="measured.mat: is not") as refusal:
            read(file)
        assert words in str(refusal.value) and way in str(refusal.value)
