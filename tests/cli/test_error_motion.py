"""``fmu-bearing error-motion``: its tables and files are the library's; what it refuses."""

import pytest

from fmu_bearing import error_motion, read_scene


@pytest.fixture
def words(rings_file, tmp_path):
    return ("error-motion", rings_file, "--revolutions", 20, "-o", tmp_path / "out")


def test_values_files_and_remarks_are_the_librarys(run, words, rings_file, tmp_path):
    done = run(*words, "--speeds", "20000", "--at", -10, "--plot", tmp_path / "p.svg", "--json")
    assert done.exit_code == 0, done.output
    found = error_motion(read_scene(rings_file), 20e3, -0.01, 20)
    (ours,) = done.data["speeds"]
    for value, true in zip(ours["values"], found.speeds[0].values, strict=True):
        assert value["direction"] == true.direction
        # the same run and fit; JSON keeps all digits
        assert value["asynchronous"] == pytest.approx(true.asynchronous, rel=1e-9)
        assert value["synchronous_by_line"] == pytest.approx(true.synchronous_by_line, rel=1e-6)
    assert done.data["remarks"] == found.remarks()
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "error-motion.csv", "lines.csv", "bearings.csv", "sources.csv", "polar.png",
    }  # fmt: skip
    assert (tmp_path / "p.svg").stat().st_size > 10_000


@pytest.mark.heavy
def test_tables_and_remarks_are_printed(run, words):
    done = run(*words, "--force")
    assert done.exit_code == 0, done.output
    for part in ("error motion, ", "against the outer ring", "largest lines", "ball form", "rotating"):
        assert part in done.stdout
    assert "remark: the computed synchronous error is a lower bound" in done.stderr


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--speeds", "0"), "0 r/min is refused: an axis of rotation needs a shaft that turns"),
        (("--speeds", "fast"), "--speeds fast is refused: write LOW:HIGH:COUNT"),
        (("--speeds", "2e5"), "--speeds 200000 r/min is refused: allowed are"),
        (("--revolutions", 12), "revolutions = 12 is refused: allowed are whole numbers from 20"),
        (("--at", 9000), "at = 9000 mm is refused, no place of the shaft or ahead of it"),
        (("--against", "housing"), "against = 'housing' is refused"),
        (("--direction", "radial"), "--direction radial is refused: it is fixed y"),
    ],
)
def test_refusals_take_one_line_and_write_nothing(run, words, tmp_path, more, message):
    refused = run(*words, *more)
    assert refused.exit_code == 2 and message in refused.stderr, refused.output
    assert refused.stderr.count("\n") == 1
    assert not (tmp_path / "out").exists()
