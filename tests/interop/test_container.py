"""Containers of fmu-manipulation-toolbox: several FMUs packed as one."""

import json
import shutil
import subprocess
import sys
import zipfile
from contextlib import ExitStack
from pathlib import Path

import fmpy
import numpy as np
import pytest

from .conftest import CSV_ERROR, EXACT_STEP, STEPS, WATCHED, alone, needs_linux64, read_csv

# Other masters; one FMU and three in FMPy are quick tests (tests/fmi, examples/test_cosimulation).
pytestmark = pytest.mark.heavy

STOP = STEPS * EXACT_STEP


def fmucontainer(description, folder):
    """Run the toolbox's command; path of the container."""
    command = [Path(sys.executable).with_name("fmucontainer"), "-fmu-directory", folder]
    ran = subprocess.run(
        [*map(str, command), "-container", f"{description}:{EXACT_STEP!r}"],
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return (folder / description).with_suffix(".fmu")


@pytest.fixture(scope="module")
def pair(native, tmp_path_factory):
    """Two bearings of one FMU in a container, the second with another speed and preload."""
    folder = tmp_path_factory.mktemp("pair")
    shutil.copy(native, folder)
    description = {
        "name": "pair.fmu",
        **{f"auto_{what}": False for what in ("link", "input", "output")},
        "fmu": ["front", "rear"],
        "path": {"front": native.name, "rear": native.name},
        "start": [["rear", "preload", "450.0"], ["rear", "shaft_speed", "2200.0"]],
        "output": [[fmu, name, f"{fmu}.{name}"] for fmu in ("front", "rear") for name in WATCHED],
    }
    (folder / "pair.json").write_text(json.dumps(description))
    return fmucontainer("pair.json", folder)


@pytest.fixture(scope="module")
def expected_pair(model, expected):
    """Columns by the container's names."""
    rear = alone(model, STEPS, preload=450.0, shaft_speed=2200.0)
    rows = {"front": expected, "rear": rear}
    return {f"{fmu}.{name}": rows[fmu][:, k] for fmu in rows for k, name in enumerate(WATCHED)}


def test_pair_in_fmpy(pair, expected_pair):
    found, _ = simulate(pair, expected_pair)
    for name, values in expected_pair.items():
        assert np.array_equal(found[name], values), name


@needs_linux64
def test_pair_without_python(pair, ecos, expected_pair, tmp_path):
    ran = ecos("simulate", "--path", pair, "--stepSize", EXACT_STEP, "--stopTime", STOP, cwd=tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    found = read_csv(tmp_path / "pair.csv")
    for name, values in expected_pair.items():
        assert found[name] == pytest.approx(values, abs=CSV_ERROR), name


LOOP = {
    "spindlemotor.shaft_speed": ("motor", "shaft_speed"),
    "bearing7003c.friction_torque": ("bearing", "friction_torque"),
    "spindlethermal.oil_temperature": ("thermal", "oil_temperature"),
}
FILES = {"motor": "SpindleMotor.fmu", "bearing": "Bearing7003C.fmu", "thermal": "SpindleThermal.fmu"}


def unpack(archive, folder):
    with zipfile.ZipFile(archive) as file:
        for name in FILES.values():
            (folder / name).write_bytes(file.read(f"resources/{name}"))


def motor_and_bearing(archive, folder):
    """Container of both, its outputs (name to component and variable), and what they are to be."""
    from write import CONNECTIONS

    unpack(archive, folder)
    parts = ("motor", "bearing")
    links = [link for link in CONNECTIONS if link[0] in parts and link[2] in parts]
    # A name with the FMU's own in front would meet those that the toolbox gives to what is linked.
    outputs = {".".join(("drive", *end)): end for end in LOOP.values() if end[0] in parts}
    description = {
        "name": "drive.fmu",
        **{f"auto_{what}": False for what in ("link", "input", "output")},
        "fmu": [FILES[part] for part in parts],
        "link": [[FILES[one], output, FILES[other], given] for one, output, other, given in links],
        "output": [[FILES[part], variable, name] for name, (part, variable) in outputs.items()],
    }
    (folder / "drive.json").write_text(json.dumps(description))
    made = fmucontainer("drive.json", folder)
    return made, outputs, container_by_hand(folder, links, list(outputs.values()))


@pytest.mark.parametrize("flavour", ["native", "python", "mixed"])
def test_motor_and_bearing(archives, flavour, tmp_path):
    made, outputs, expected = motor_and_bearing(archives[flavour], tmp_path)
    found, _ = simulate(made, outputs)
    for name, values in zip(outputs, expected.T, strict=True):
        assert np.array_equal(found[name], values), name


@needs_linux64
def test_motor_and_bearing_without_python(archives, ecos, tmp_path):
    made, outputs, expected = motor_and_bearing(archives["native"], tmp_path)
    ran = ecos("simulate", "--path", made, "--stepSize", EXACT_STEP, "--stopTime", STOP, cwd=tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    found = read_csv(tmp_path / "drive.csv")
    for name, values in zip(outputs, expected.T, strict=True):
        assert found[name] == pytest.approx(values, abs=CSV_ERROR), name


@pytest.mark.parametrize("flavour", ["native", "python", "mixed"])
def test_archive_as_a_container(archives, flavour, tmp_path):
    """Motor, bearing and thermal network of the .ssp example in one FMU.

    The toolbox begins the loop with zeros, 0 K among them: they wait until the first temperatures come.
    """
    from write import CONNECTIONS

    shutil.copy(archives[flavour], tmp_path / "spindle.ssp")
    found, _ = simulate(fmucontainer("spindle.ssp", tmp_path), LOOP)
    unpack(archives[flavour], tmp_path)
    expected = container_by_hand(tmp_path, CONNECTIONS, list(LOOP.values()))
    for name, values in zip(LOOP, expected.T, strict=True):
        assert np.array_equal(found[name], values), name


@needs_linux64
def test_archive_as_a_container_without_python(archives, ecos, tmp_path):
    from write import CONNECTIONS

    shutil.copy(archives["native"], tmp_path / "spindle.ssp")
    made = fmucontainer("spindle.ssp", tmp_path)
    ran = ecos("simulate", "--path", made, "--stepSize", EXACT_STEP, "--stopTime", STOP, cwd=tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    unpack(archives["native"], tmp_path)
    expected = container_by_hand(tmp_path, CONNECTIONS, list(LOOP.values()))
    found = read_csv(tmp_path / f"{made.stem}.csv")
    for name, values in zip(LOOP, expected.T, strict=True):
        assert found[name] == pytest.approx(values, abs=CSV_ERROR), name


def simulate(path, outputs, messages=None):
    """Run with FMPy; results and what the FMU said.

    FMPy 0.3.32 passes all FMUs' messages to the function that was given last, and the process dies if that
    is gone: so a function is given here.
    """
    messages = [] if messages is None else messages
    result = fmpy.simulate_fmu(
        str(path),
        stop_time=STOP,
        output_interval=EXACT_STEP,
        output=list(outputs),
        debug_logging=True,
        logger=lambda _environment, _name, _status, _category, text: messages.append(text.decode()),
    )
    return result, messages


def container_by_hand(folder, links, shown):
    """What the container does, with FMPy's instances: all step at once, then outputs are passed on.

    Of FMUs in a loop the first is initialised before the others have values to give: the motor starts
    with a load of 0.
    """
    from coupling import Fmu

    with ExitStack() as stack:
        parts = {part for one, _, other, _ in links for part in (one, other)}
        fmus = {
            name: stack.enter_context(Fmu(folder / file, name))
            for name, file in FILES.items()
            if name in parts
        }

        def read():
            return [fmus[component].get([variable])[0] for component, variable in shown]

        for name, fmu in fmus.items():
            fmu.enter_initialization(**({"load_torque": 0.0} if name == "motor" else {}))
            fmu.exit_initialization()
        rows = [read()]
        for k in range(STEPS):
            values = [fmus[one].get([output])[0] for one, output, _, _ in links]
            for value, (_, _, other, given) in zip(values, links, strict=True):
                fmus[other].set({given: value})
            for fmu in fmus.values():
                fmu.step(k * EXACT_STEP, EXACT_STEP)
            rows.append(read())
    return np.array(rows)
