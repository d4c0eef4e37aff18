"""Runs of scenes and FMUs: the same bits, ranges, jumps, early ends, files."""

import math
import signal
import threading

import fmpy
import numpy as np
import pytest

from fmu_bearing import Bearing, Run, build_fmu, simulate
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.interface.names import UnknownName, chosen_names
from fmu_bearing.results.result import INTERRUPTED, REFUSED, ResultError, read_table
from fmu_bearing.results.series import structured
from fmu_bearing.results.variable_names import unit_of
from fmu_bearing.run.inputs import input_table
from fmu_bearing.scene.read import with_fidelity
from tests.native_builds import no_native_fmu


@pytest.fixture(scope="module")
def rings(silent):
    return with_fidelity(silent, model="rings")


@pytest.fixture(scope="module")
def built(rings, tmp_path_factory):
    """A function that returns the path of an FMU of the silent scene, at fidelity rings or another."""
    folder = tmp_path_factory.mktemp("fmu")

    def of(flavour, fidelity="rings"):
        path = folder / f"{flavour}-{fidelity}.fmu"
        if not path.exists():
            try:
                build_fmu(with_fidelity(rings, model=fidelity), path, flavour)
            except BuildError as problem:
                no_native_fmu(problem)
        return path

    return of


@pytest.fixture(scope="module")
def jumping():
    """A speed that ramps and a load that jumps between two communication points."""
    rows = [(0.0, 2000.0, 0.0), (4.3e-3, 2100.0, 0.0), (4.3e-3, 2100.0, 50.0), (8e-3, 2050.0, 50.0)]
    return np.array(rows, dtype=[("time", float), ("shaft_speed", float), ("radial_load.z", float)])


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_library_and_fmu_give_what_fmpy_gives(built, rings, jumping, flavour):
    names = ["friction_torque", "inner_ring.velocity.y", "heat.oil"]
    options = {"step": 1e-3, "inputs": jumping, "start_values": {"preload": 420.0}, "outputs": names}
    library = simulate(rings, 0.0095, **options)
    path = built(flavour)
    ours = simulate(path, 0.0095, **options)
    theirs = fmpy.simulate_fmu(
        str(path), stop_time=0.0095, output_interval=1e-3, input=jumping,
        start_values={"preload": 420.0}, output=names,
    )  # fmt: skip
    assert library.complete and ours.complete
    assert len(theirs) == 12  # ten whole steps and the rest, one of them cut in two by the jump
    for name in ("time", *names):
        np.testing.assert_array_equal(library.table[name], theirs[name])
        np.testing.assert_array_equal(ours.table[name], theirs[name])
    assert library.units == ours.units == {names[0]: "N.m", names[1]: "m/s", names[2]: "W"}
    assert ours.scene is not None and ours.scene.name == rings.name


def test_functions_numbers_and_tables_are_one(rings, tmp_path):
    kept = ["friction_torque"]
    by_function = simulate(
        rings, 4e-3, inputs={"shaft_speed": lambda t: 2000.0 + 1e4 * t, "preload": 400.0}, outputs=kept
    )
    times = np.arange(5) * 1e-3
    columns = {"time": times, "shaft_speed": 2000.0 + 1e4 * times, "preload": np.full(5, 400.0)}
    file = tmp_path / "inputs.csv"
    fmpy.write_csv(str(file), structured(columns))
    by_file = simulate(rings, 4e-3, inputs=file, outputs=kept)
    np.testing.assert_array_equal(by_function.table, by_file.table)


def test_a_bearing_stepped_by_hand_is_the_same_run(rings):
    run = simulate(rings, 3e-3, start_values={"shaft_speed": 1500.0}, outputs=["friction_torque"])
    bearing = Bearing(rings)
    bearing.init(shaft_speed=1500.0)
    by_hand = [bearing["friction_torque"]]
    for k in range(3):
        bearing.step((k + 1) * 1e-3 - bearing.time)
        by_hand.append(bearing["friction_torque"])
    np.testing.assert_array_equal(run["friction_torque"], by_hand)
    again = bearing.simulate(3e-3, outputs=["friction_torque"])
    np.testing.assert_array_equal(again["friction_torque"], by_hand)


def test_bearing_begins_again_and_keeps_what_was_set(rings):
    bearing = Bearing(rings)
    bearing.set(preload=321.0).init({"radial_load.z": 10.0})
    first = bearing.read("contact.*.load_mean")
    bearing.step(1e-3, shaft_speed=1900.0)
    bearing.init(shaft_speed=rings.operation.speed_rpm * math.pi / 30.0)
    assert bearing.time == 0.0 and bearing["preload"] == 321.0
    assert bearing.read("contact.*.load_mean") == first
    assert "shaft_speed" in bearing and len(bearing) == len(list(bearing))
    assert "friction_torque" in bearing._repr_html_() and "rings" in repr(bearing)
    with pytest.raises(UnknownName, match="did you mean 'shaft_speed'"):
        bearing.set(shaft_sped=1.0)
    with pytest.raises(ValueError, match="0 to 10000 N"):
        bearing.init(preload=-1.0)


def test_inputs_are_held_against_their_ranges_before_the_run(rings):
    with pytest.raises(ValueError, match=r"input preload = -3 at t = 0.002 s .* allowed are 0 to 10000 N"):
        simulate(rings, 5e-3, inputs={"preload": lambda t: -3.0 if t > 1.5e-3 else 100.0})
    with pytest.raises(ValueError, match="input shaft_speed = nan at t = 0 s"):
        simulate(rings, 5e-3, inputs={"shaft_speed": math.nan})
    with pytest.raises(UnknownName, match="no input 'preloads'; did you mean 'preload'"):
        simulate(rings, 5e-3, inputs={"preloads": 1.0})
    with pytest.raises(ValueError, match="number or a function of time"):
        simulate(rings, 5e-3, inputs={"preload": "much"})
    with pytest.raises(UnknownName, match="no input or parameter 'friction_torque'"):
        simulate(rings, 5e-3, start_values={"friction_torque": 1.0})
    for times in ({"stop_time": 0.0}, {"stop_time": 1.0, "step": math.nan}):
        with pytest.raises(ValueError, match="finite, positive number of seconds"):
            simulate(rings, **times)
    assert input_table({}, {}, 1.0, 0.1) is None


@pytest.fixture(scope="module")
def stiffened():
    """A soft pedestal, which the preload pushes by 50 mm, of 1e12 N/m at once: forces of 5e10 N in `full`."""
    return {"pedestal_stiffness": lambda t: 1e4 if t < 2.5e-3 else 1e12}


def test_a_refused_step_keeps_what_was_computed(silent, stiffened):
    full = with_fidelity(silent, model="full")
    with pytest.warns(UserWarning, match="could not be solved"):
        run = simulate(full, 0.05, inputs=stiffened, outputs=["friction_torque"])
    assert run.ended == REFUSED and not run.complete
    assert 2e-3 <= run.time[-1] < 0.05 and np.isfinite(run["friction_torque"]).all()
    assert "change inputs by less at a time" in run.note and "refused" in repr(run)


def test_a_refused_step_of_an_fmu_keeps_the_same(silent, stiffened, built):
    full = with_fidelity(silent, model="full")
    with pytest.warns(UserWarning, match="could not be solved"):
        library = simulate(full, 0.05, inputs=stiffened, outputs=["friction_torque"])
    with pytest.warns(UserWarning, match=r"t = 0.00\d s was refused; .*could not be solved"):
        ours = simulate(built("native", "full"), 0.05, inputs=stiffened, outputs=["friction_torque"])
    assert ours.ended == REFUSED
    np.testing.assert_array_equal(ours.table, library.table)


def test_rings_begin_again_equally_in_library_and_fmu(rings, built):
    """The outer race leaves the balls: its ring is 180 K warmer at once."""
    pushed = {"outer_ring_temperature": lambda t: 240.0 if t < 2.5e-3 else 420.0}
    names = ["friction_torque", "solver.restarts"]
    with pytest.warns(UserWarning, match="restarted from rest"):
        library = simulate(rings, 0.02, inputs=pushed, outputs=names)
    assert library["solver.restarts"][-1] >= 1
    ours = simulate(built("native"), 0.02, inputs=pushed, outputs=names)
    np.testing.assert_array_equal(ours.table, library.table)


def test_ctrl_c_keeps_what_was_computed(rings, built):
    before = signal.getsignal(signal.SIGINT)
    for source in (rings, built("native")):
        simulate(source, 1e-3, outputs=["friction_torque"])  # what is loaded once takes no part
        timer = threading.Timer(0.5, signal.raise_signal, (signal.SIGINT,))
        timer.start()
        with pytest.warns(UserWarning, match="interrupted at t ="):
            run = simulate(source, 1e4, outputs=["friction_torque"])
        timer.join()
        assert run.ended == INTERRUPTED and 1 < len(run) and run.time[-1] < 1e4
    assert signal.getsignal(signal.SIGINT) is before


def test_files_give_back_what_was_written(rings, tmp_path):
    run = simulate(rings, 2e-3)
    for ending in ("csv", "nc"):
        back = Run.load(run.save(tmp_path / f"run.{ending}"))
        np.testing.assert_array_equal(back.table, run.table)
    assert back.units == run.units and back.name == run.name  # netCDF knows them, CSV does not
    assert back.scene == run.scene
    np.testing.assert_array_equal(fmpy.read_csv(str(tmp_path / "run.csv")), run.table)
    data = run.to_xarray()
    assert data["friction_torque"].attrs["units"] == "N.m" and data["time"].attrs["units"] == "s"
    assert run.summary()["last"]["friction_torque"] == {"value": run["friction_torque"][-1], "unit": "N.m"}
    assert "<td>heat.oil</td>" in run._repr_html_() and set(run) == set(run.names)
    with pytest.raises(KeyError, match="'nothing' was not kept"):
        run["nothing"]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "holds no values"),
        ("a,b\n1,2\n", "the first column must be 'time'"),
        ("time,x\n0,one\n", "line 2, column 'x': 'one' is not a finite number"),
        ("time,x\n0,nan\n", "line 2, column 'x': 'nan' is not a finite number"),
        ("time,x\n0,1\n1,1\n0.5,1\n", "line 4: time falls from 1 to 0.5 s"),
        ("time,x\n0,1 2\n", "column 'x'"),
    ],
)
def test_tables_that_are_none_are_refused(tmp_path, text, reason):
    file = tmp_path / "table.csv"
    file.write_text(text)
    with pytest.raises(ResultError, match=reason):
        read_table(file)


def test_results_that_are_none_are_refused(tmp_path, rings):
    (tmp_path / "text.nc").write_text("no netCDF")
    for name in ("none.csv", "none.nc", "text.nc"):
        with pytest.raises(ResultError, match=name):
            Run.load(tmp_path / name)
    with pytest.raises(ValueError, match="written as .csv, .nc or .uff"):
        simulate(rings, 1e-3).save(tmp_path / "run.mat")
    (tmp_path / "text.fmu").write_text("no FMU")
    for name in ("none.fmu", "text.fmu"):
        with pytest.raises(ResultError, match=name):
            simulate(tmp_path / name, 1e-3)


def test_names_with_stars():
    names = ["mic[1].leq", "mic[2].leq", "mic[1].spl", "heat.oil"]
    assert chosen_names(["mic[*].leq", "heat.oil", "*.leq"], names, ()) == [names[0], names[1], names[3]]
    assert chosen_names(None, names, ["heat.oil"]) == ["heat.oil"]
    with pytest.raises(UnknownName, match=r"no variable 'x'; there are mic\[\*\].leq, mic"):
        chosen_names(["x"], names, ())
    assert unit_of("port.force.z") == "N" and unit_of("port_tilt_rate_y") == "rad/s"
    assert unit_of("ball[7].velocity.x") == "m/s" and unit_of("mic[12].leq_a") == "dB"
    assert unit_of("something.else") == ""
