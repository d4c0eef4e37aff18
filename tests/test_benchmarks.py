"""The benchmark runs and fills its table; figures themselves are never asserted."""

import csv
import dataclasses
import importlib
import math

import numpy as np
import pytest
import typer

from benchmarks import (
    commands,
    costs,
    memory,
    ours,
    peers,
    quick_fidelities,
    quick_gates,
    quick_limits,
    realtime,
    scenes,
    sets,
    sound,
    table,
    tables,
    terms,
)
from benchmarks.cases import CASES, GATES, SOLVERS, Case
from benchmarks.first_order import FirstOrder
from benchmarks.fmu import calls, whole
from fmu_bearing.cli import app
from fmu_bearing.results.table import markdown, write_csv
from fmu_bearing.run.metrics import SAMPLE
from tests.pages import parse

TINY = Case("7003C-spindle", 20000, (1.0, 0.0, 0.0), "start", window=2e-4, communication=1e-4)


def test_one_case_through_to_the_table(tmp_path):
    start = TINY.bearing()
    exact = ours.reference_from(start, TINY.window, sample=SAMPLE)
    mine = ours.full_rows(TINY, SOLVERS[0], start, exact, budget=1e-3, repeats=1)
    problem = FirstOrder(start)
    times = np.array([2.5e-5, 5e-5])
    short = ours.reference_from(start, times[-1], sample=times[0])
    entry = peers.solvers()["LSODA"]
    other = peers.peer_row(TINY.name, "LSODA", entry, problem, short.velocities, times, 1e-3, 30.0)
    rows = [*mine, other]
    table.fill_ratios(rows)
    for row in rows:
        assert math.isfinite(row.error) and row.wall > 0.0 and row.cpu > 0.0
        assert len(row.cells()) == len(table.COLUMNS)
    assert mine[-1].error <= ours.LIMIT
    assert other.error <= ours.LIMIT
    assert mine[-1].ratios["x LSODA"] == mine[-1].cpu / other.cpu
    write_csv(tmp_path / "t.csv", table.COLUMNS, [row.cells() for row in rows])
    with (tmp_path / "t.csv").open(encoding="utf-8") as file:
        read = list(csv.reader(file))
    assert read[0] == list(table.COLUMNS) and len(read) == 1 + len(rows)
    assert markdown(table.COLUMNS, read[1:]).count("\n") == 2 + len(rows)


@pytest.mark.heavy
def test_every_table_of_the_benchmark_can_be_made():
    """Each part reaches into the package; figures are not asserted."""
    for columns, rows in (
        (memory.COLUMNS, memory.rows(("7003C-spindle",))),
        (terms.COLUMNS, terms.rows("7003C-spindle", 20000.0, 1e-3, 1)),
        (sound.COLUMNS, sound.rows("7003C-spindle", ("compact",), 1)),
        (whole.COLUMNS, whole.rows(quick=True)),
        (calls.COLUMNS, calls.rows(quick=True)),
        (realtime.COLUMNS, realtime.rows(quick=True)),
        (commands.COLUMNS, list(commands.rows(("info S.toml",)))),
    ):
        assert rows and all(len(row) == len(columns) for row in rows)


def test_every_table_s_command_is_there():
    """A module that imports what is no longer there would fail when the tables are made, an hour later."""
    for arguments in tables.COMMANDS.values():
        if arguments[0] == "-m":
            assert arguments[1] == "fmu_bearing" or importlib.import_module(arguments[1])
        else:
            assert (tables.ROOT / arguments[0]).is_file()


def test_every_command_has_its_time():
    """But the three that the table names; each line is one that the command line understands."""
    lines = [["fmu-bearing", *one.split()] for one in commands.COMMANDS]
    for words in lines:
        parse(words)
    timed = {words[1] for words in lines}
    assert timed == set(typer.main.get_command(app).commands) - {"identify", "warm-up", "dataset"}


def test_a_missed_goal_is_named():
    row = table.Row("c", "s", error=2e-3, wall=1.0, cpu=1.0, goal=2.0)
    assert row.verdict == "missed: speed, error"
    assert dataclasses.replace(row, error=1e-4, cpu=2.5).verdict == "met"
    assert dataclasses.replace(row, error=math.nan).verdict == "missed: speed, error"
    assert dataclasses.replace(row, goal=0.0).verdict == ""


def test_a_missing_package_is_a_remark():
    row = peers.peer_row("c", "CVODE", None, None, np.zeros((1, 6)), np.ones(1), 1e-3, 1.0)
    assert row.remark == "not installed" and math.isnan(row.wall)


def test_cases_cover_both_bearings_and_all_conditions():
    assert {case.kind for case in CASES} == {"settled", "start", "radial"}
    gates = [case for case in CASES if case.folder == GATES]
    speeds = {name: sorted({c.rpm for c in gates if c.scene == name and c.kind == "settled"}) for name in
              ("7003C-bare", "7009C-full-ceramic")}  # fmt: skip
    assert speeds == {"7003C-bare": [1000, 10000, 28000], "7009C-full-ceramic": [3000, 18000]}


def test_why_exudyn_runs_without_a_contact_angle():
    """A frictionless sphere pressed into a groove at 20 degrees off its plane is pushed along the groove.

    By symmetry it cannot be. Once this test fails, EXUDYN has mended it: give the peer its contact angle.
    """
    exu = pytest.importorskip("exudyn")
    from exudyn.utilities import InertiaSphere, MarkerBodyRigid, NodeGenericData, SensorObject

    system = exu.SystemContainer().AddSystem()
    reach, circle = 0.06, 0.6
    ground = system.CreateGround()
    place = [circle + reach * np.cos(0.35), 0.0, reach * np.sin(0.35)]
    ball = system.CreateRigidBody(referencePosition=place, inertia=InertiaSphere(mass=1, radius=0.5))
    markers = [
        system.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0])) for body in (ball, ground)
    ]
    node = system.AddNode(NodeGenericData(initialCoordinates=[0, 0, 0, 0], numberOfDataCoordinates=4))
    contact = exu.itemInterface.ObjectContactSphereTorus(
        markerNumbers=markers, nodeNumber=node, sphereRadius=0.5, torusMajorRadius=circle,
        torusMinorRadius=0.55, torusAxis=[0, 0, 1], contactStiffness=1e3, contactStiffnessExponent=1,
        contactDamping=0, dynamicFriction=0,
    )  # fmt: skip
    sensor = system.AddSensor(
        SensorObject(
            objectNumber=system.AddObject(contact), storeInternal=True,
            outputVariableType=exu.OutputVariableType.Force,
        )
    )  # fmt: skip
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = 1e-7
    settings.timeIntegration.endTime = 1e-6
    settings.timeIntegration.numberOfSteps = 10
    system.SolveDynamic(settings)
    radial, tangential, axial = system.GetSensorStoredData(sensor)[-1, 1:]
    assert axial / radial == pytest.approx(np.tan(0.35), rel=0.01)
    assert abs(tangential) > 0.3 * abs(radial)


def test_scenes_are_compared_with_full(scene):
    """A line per setting; the finer steps of full lie nearer to the reference than rings do."""
    rows = scenes.rows_of(scenes.Case("7003C-bare", 20e3, folder=GATES), 1e-3, 5e-3, 5e-3)
    assert [row[3] for row in rows] == ["full", "full", "rings", "response"]
    assert all(len(row) == len(scenes.COLUMNS) for row in rows)
    ratios = [abs(float(row[6]) - 1.0) for row in rows]
    assert ratios[1] <= 1e-3 < ratios[2]


def test_a_set_of_one_is_timed_beside_the_single_bearing():
    (_, single), (name, one), *_ = sets.cases()
    assert name.startswith("set of one")
    assert len(one.spindle.bearing) == 1
    rotor = single.mounted.rotor
    [[length, diameter, bore]] = one.spindle.shaft.sections_mm
    volume = math.pi / 4.0 * diameter**2 * length * 1e-9
    assert (length, diameter, bore) == (rotor.length_mm, rotor.diameter_mm, 0.0)
    assert volume * one.materials.inner_ring.density_kg_m3 == pytest.approx(rotor.mass_kg, rel=0.01)
    assert one.spindle.load.force_x_N == single.mounted.preload_N


def test_quick_fidelities_go_on_where_they_were_interrupted(tmp_path, capsys):
    """Two scenes of the grid; then the last line is cut, as by a process that was ended while it wrote."""
    words = ["--what", "grid", "--share", "0.004", "--output", str(tmp_path)]  # of 540 scenes

    def rows():
        quick_fidelities.main(words)
        with (tmp_path / "grid.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    first = rows()
    assert capsys.readouterr().out.count("of 2") == len(first) == 2
    for row in first:
        assert tuple(row) == quick_fidelities.COLUMNS
        for cell in ("growth, 1/s", "rings y, mm/s", "response x, mm/s", "rings/response z"):
            assert math.isfinite(float(row[cell])), (row["scene"], cell)
        assert row["full x, mm/s"] == "" and row["remark"] == ""
    assert "2 scenes, 0 with a refusal" in (tmp_path / "grid.md").read_text("utf-8")
    text = (tmp_path / "grid.csv").read_text("utf-8")
    (tmp_path / "grid.csv").write_text(text[:-20], "utf-8")
    again = rows()
    assert capsys.readouterr().out.count("of 1") == 1
    seconds = [key for key in first[0] if key.endswith("CPU s")]
    assert [row | dict.fromkeys(seconds) for row in again] == [row | dict.fromkeys(seconds) for row in first]
    (tmp_path / "grid.csv").write_text(text.replace(first[0]["engine"], "0" * 16), "utf-8")
    with pytest.raises(SystemExit, match="give another --output"):
        rows()


def test_bad_scenes_are_those_that_restart_or_move_far_more():
    row = dict.fromkeys(quick_fidelities.COLUMNS, "") | {"restarts of rings": "0", "rings/response y": "2.9"}
    assert quick_fidelities.faults(row) == []
    assert quick_fidelities.faults(row | {"rings/response y": "3.1"}) == ["rings/response 3.1"]
    assert quick_fidelities.faults(row | {"rings/full z": "nan"}) == ["rings/full nan"]
    assert quick_fidelities.faults(row | {"restarts of rings": "4"}) == ["rings restarts 4"]


@pytest.mark.heavy
def test_rings_beside_full_are_written_in_their_columns(tmp_path):
    quick_gates.main(["--what", "drawn", "--count", "1", "--output", str(tmp_path)])
    quick_limits.main(["--what", "stiff_preload", "--output", str(tmp_path)])
    for name, columns in (("drawn", quick_gates.columns("drawn")), ("quick_limits", quick_limits.COLUMNS)):
        with (tmp_path / f"{name}.csv").open(encoding="utf-8") as file:
            (row,) = csv.reader(file.read().splitlines()[1:])
        assert len(row) == len(columns)
    for what in ("terms", "grew"):
        assert len(set(quick_gates.columns(what))) == len(quick_gates.columns(what))


def test_tables_of_another_engine_are_named(tmp_path):
    (tmp_path / "new.md").write_text(f"{scenes.machine()}\n", "utf-8")
    (tmp_path / "old.md").write_text("AMD; fmu-bearing 0.1.0, engine 0123456789abcdef\n", "utf-8")
    (tmp_path / "none.md").write_text("AMD\n", "utf-8")
    found = tables.stale(tmp_path)
    assert list(found) == ["none", "old"]
    assert "engine not named" in found["none"]
    assert "engine 0123456789abcdef, now" in found["old"]


@pytest.mark.pages
@pytest.mark.parametrize("path", sorted(tables.RESULTS.glob("*.md")), ids=lambda path: path.name)
def test_a_table_names_what_made_it_and_a_command_makes_it(path):
    text = path.read_text("utf-8")
    assert path.stem in tables.APART or tables.made_by(text)
    assert (path.stem in tables.APART) != any(path.stem in made for made in tables.COMMANDS)


def test_costs_change_one_thing_of_the_spindle_at_a_time():
    found = dict(costs.variants())
    whole, *others = found.values()
    assert whole.sound is None and len(set(map(repr, found.values()))) == len(found) == 13
    assert found["no cage"].bearing.cage is None and found["6 balls in place of 12"].bearing.ball_count == 6
    assert [len(found[name].sound.points()) for name in ("1 microphone", "4 microphones")] == [1, 4]
    assert all(one.operation.speed_rpm == whole.operation.speed_rpm for one in others if one.spindle is None)


def test_old_tables_are_made_one_after_the_other_and_the_rest_goes_on(tmp_path, monkeypatch):
    """A command that fails is named, and one that makes two tables runs once."""
    (tmp_path / "ok.py").write_text("import pathlib; pathlib.Path('ran').open('a').write('x')\n", "utf-8")
    monkeypatch.setattr(tables, "ROOT", tmp_path)
    commands = {("a", "b"): ("ok.py",), ("c",): ("missing.py",), ("d",): ("ok.py",), ("e",): ("ok.py",)}
    monkeypatch.setattr(tables, "COMMANDS", commands)
    assert tables.make(["a", "b", "c", "d"]) == ["c"]
    assert (tmp_path / "ran").read_text("utf-8") == "xx"
