"""stiffness: what it prints, writes and refuses."""

import csv
import tomllib

import pytest

SMALL = ("--speeds", "10000,20000", "--frequencies", "100:1000:2log")


def test_a_table_is_written_and_told(run, silent_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("stiffness", silent_file, *SMALL, "--preloads", "300,500", "--plot", "k.png")
    assert done.exit_code == 0
    assert "7003C-spindle at 1000 Hz: K in N/um and N m/mrad, C in N s/m and mN m s/rad" in done.stdout
    row = next(line for line in done.stdout.splitlines() if "20000" in line and " 500" in line)
    axial, radial, tilt = map(float, row.replace("│", " ").split()[2:5])
    assert (axial, radial, tilt) == (
        pytest.approx(55.6, abs=0.1),
        pytest.approx(162.2, abs=0.3),
        pytest.approx(4.71, abs=0.01),
    )
    words = "below 100 Hz, the lowest frequency computed: K for frequency to 0 (static) differs by at most "
    assert words in done.stdout and "% from K at 100 Hz" in done.stdout
    assert {path.name for path in tmp_path.iterdir()} == {"stiffness.csv", "k.png"}
    with (tmp_path / "stiffness.csv").open(newline="", encoding="utf-8") as file:
        assert len(list(csv.reader(file))) == 1 + 4 * 3


def test_netcdf_and_settings(run, silent_file, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    plain, warm = tmp_path / "a.nc", tmp_path / "b.nc"
    changes = ("--set", "operation.inner_ring_temperature_degC=40", "--set", "radial_load.z=-50")
    for path, more in ((plain, ()), (warm, changes)):
        assert run("stiffness", silent_file, *SMALL, *more, "--format", "netcdf", "-o", path).exit_code == 0
    with (
        xarray.open_dataset(plain, engine="h5netcdf") as one,
        xarray.open_dataset(warm, engine="h5netcdf") as two,
    ):
        assert two.K[1, 0, 0, 0, 0] < 0.9 * one.K[1, 0, 0, 0, 0]  # 20 K: -13 %


def test_elements_for_ross_and_what_they_lack(run, silent_file, tmp_path):
    target = tmp_path / "rear.toml"
    axes = ("--speeds", "8000:24000:5", "--frequencies", "50:5000:5log", "--preloads", "300,500")
    done = run("stiffness", silent_file, *axes, "--format", "ross", "--mirrored", "-o", target)
    assert done.exit_code == 0
    assert "error of the three planes, %, at the worst frequency" in " ".join(done.stdout.split())
    assert "planes at -5.4, 0, 5.4 mm from the centre of the balls" in done.stdout
    names = {f"rear-{preload}N-{part}.toml" for preload in (300, 500) for part in (1, 2, 3)}
    assert {path.name for path in tmp_path.iterdir()} == names
    (element,) = tomllib.loads((tmp_path / "rear-500N-1.toml").read_text(encoding="utf-8")).values()
    assert len(element["speed"]) == 5 and len(element["kxx"][0]) == 5


def test_json_holds_all(run, silent_file, tmp_path):
    done = run(
        "stiffness", silent_file, "--speeds", "20000", "--format", "ross", "-o", tmp_path / "k.toml", "--json"
    )
    assert done.exit_code == 0
    data = done.data
    (own,) = data["bearings"]
    assert len(own["K"][0][0]) == len(data["frequencies_Hz"]) == 8 and len(own["K"][0][0][0]) == 5
    assert data["nose"] is None
    assert own["planes"][0]["places_mm"] == pytest.approx([-5.4, 0.0, 5.4], abs=0.11)
    assert len(own["planes"][0]["errors"][0]) == 8
    assert max(errors[0] for errors in own["planes"][0]["errors"][0]) < 1e-12
    assert [name.rpartition("/")[2] for name in data["files"]] == ["k-1.toml", "k-2.toml", "k-3.toml"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--speeds", "0:1:2:3"), "--speeds 0:1:2:3 is refused: write LOW:HIGH:COUNT"),
        (("--speeds", "fast"), "--speeds fast is refused: write LOW:HIGH:COUNT"),
        (("--speeds", "2e5"), "--speeds 200000 r/min is refused: allowed are -100000 to 100000 r/min"),
        (("--frequencies", "0,100"), "frequencies: 0 Hz is refused: damping needs frequencies above 0"),
        (("--preloads", "20000"), "preload = 20000.0 is refused: allowed are 0 to 10000 N"),
        (("--spacing", "cage"), "--spacing cage is refused: it is held or free"),
        (("--format", "xls"), "--format xls is refused: it is csv, netcdf, ross"),
        (
            ("--format", "netcdf", "-o", "k.csv"),
            "k.csv: --format netcdf is written as .nc",
        ),
        (("--mirrored",), "--mirrored is for --format ross"),
        (
            ("--format", "ross", "--speeds", "1000:3000:3"),
            "3 speeds are refused: ROSS interpolates between at",
        ),
        (("--format", "ross", "--frequencies", "10,20"), "2 frequencies are refused: ROSS interpolates"),
        (("--plot", "k.doc"), "k.doc: a picture is written as .png, .svg or .pdf"),
        (("--set", "preload=300"), "preload is an axis of the table: give preloads, in N"),
        (("--set", "mounting.prelaod_N=300"), "mounting.prelaod_N is not a key of a scene"),
    ],
)
def test_refusals_leave_no_trace(options, words, run, silent_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("stiffness", silent_file, *options)
    assert done.exit_code == 2
    assert words in " ".join(done.stderr.split())
    assert not list(tmp_path.iterdir())
