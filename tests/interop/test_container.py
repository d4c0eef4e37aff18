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

STOP = STEPS * EXACT_STEP


def fmucontainer(description, folder):
    """Run the toolbox's command; path of the container."""
    command = [Path(sys.executable).with_name("fmucontainer"), "-fmu-directory", folder]
    ran = subprocess.run(
        [*map(str, command), "-container", f"{description}:{EXACT_STEP!r}"], capture_output=True, text=True
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
    found = fmpy.simulate_fmu(
        str(pair), validate=True, stop_time=STOP, output_interval=EXACT_STEP, output=list(expected_pair)
    )
    for name, values in expected_pair.items():
        assert np.array_equal(found[name], values), name


@needs_linux64
def test_pair_without_python(pair, ecos, expected_pair, tmp_path):
    ran = ecos("simulate", "--path", pair, "--stepSize", EXACT_STEP, "--stopTime", STOP, cwd=tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    found = read_csv(tmp_path / "pair.csv")
    for name, values in expected_pair.items():
        assert found[name] == pytest.approx(values[:STEPS], abs=CSV_ERROR), name


@pytest.mark.parametrize("flavour", ["native", "python"])
def test_archive_as_a_container(archives, flavour, tmp_path):
    """Motor, bearing and thermal network of the .ssp example in one FMU."""
    shutil.copy(archives[flavour], tmp_path / "spindle.ssp")
    container = fmucontainer("spindle.ssp", tmp_path)
    outputs = {
        "spindlemotor.shaft_speed": ("motor", "shaft_speed"),
        "bearing7003c.friction_torque": ("bearing", "friction_torque"),
        "spindlethermal.oil_temperature": ("thermal", "oil_temperature"),
    }
    found = fmpy.simulate_fmu(
        str(container), stop_time=STOP, output_interval=EXACT_STEP, output=list(outputs)
    )
    expected = container_by_hand(archives[flavour], tmp_path, list(outputs.values()))
    for name, values in zip(outputs, expected.T, strict=True):
        assert np.array_equal(found[name], values), name


def container_by_hand(path, folder, shown):
    """What the container does, with FMPy's instances: all step at once, then outputs are passed on.

    Of FMUs in a loop the first is initialised before the others have values to give: the motor starts
    with a load of 0.
    """
    from coupling import Fmu
    from write import CONNECTIONS

    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    names = {"motor": "SpindleMotor", "bearing": "Bearing7003C", "thermal": "SpindleThermal"}
    with ExitStack() as stack:
        fmus = {
            name: stack.enter_context(Fmu(folder / "resources" / f"{file}.fmu", name))
            for name, file in names.items()
        }

        def read():
            return [fmus[component].get([variable])[0] for component, variable in shown]

        fmus["motor"].enter_initialization(load_torque=0.0)
        fmus["bearing"].enter_initialization()
        fmus["thermal"].enter_initialization()
        for fmu in fmus.values():
            fmu.exit_initialization()
        rows = [read()]
        for k in range(STEPS):
            values = [fmus[one].get([output])[0] for one, output, _, _ in CONNECTIONS]
            for value, (_, _, other, given) in zip(values, CONNECTIONS, strict=True):
                fmus[other].set({given: value})
            for fmu in fmus.values():
                fmu.step(k * EXACT_STEP, EXACT_STEP)
            rows.append(read())
    return np.array(rows)
