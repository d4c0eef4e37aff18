"""Every class of results: its values are saved, read back and have units, whichever study returns it."""

import csv
import importlib
import json
import math
import pkgutil
import re
from functools import partial

import numpy as np
import pytest

import fmu_bearing
from fmu_bearing import (
    campbell,
    changes,
    compare,
    error_motion,
    fits,
    lobes,
    measure,
    modes,
    operating_point,
    receptance,
    record,
    simulate,
    spread,
    stiffness,
    verdicts,
    vibration,
    with_fidelity,
)  # fmt: skip
from fmu_bearing.accuracy.sensitivity import Row as Moved, Sensitivity
from fmu_bearing.accuracy.tradeoff import Row, Tradeoff
from fmu_bearing.design.temperatures import temperatures
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.free import free_numbers
from fmu_bearing.identification.result import Compared, Estimate, Identified
from fmu_bearing.machining.lobes_result import LobesTable
from fmu_bearing.modal.campbell.diagram import Diagram
from fmu_bearing.modal.receptance.receptance_table import ReceptanceTable
from fmu_bearing.recording.measurements.at_frequency import noise_at
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.recording.studies.finding import Finding
from fmu_bearing.recording.studies.pairs import BandPair, FigurePair, KeyPair
from fmu_bearing.results.base import Quantity, Result, Study, plain, table
from fmu_bearing.run.choose import Choice, Probe
from fmu_bearing.run.metrics import Errors
from fmu_bearing.run.settings import Setting
from fmu_bearing.run.step_times import Realtime, Timed
from fmu_bearing.scene import read_scene
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable
from fmu_bearing.sweeps.global_sensitivity import evaluated, lay_out
from fmu_bearing.sweeps.point import Outcome
from tests.conftest import EXAMPLES

#: Rooms of kernels and of files for other programs: no results.
WITHOUT = ("fmu_bearing.engine", "fmu_bearing.compiled", "fmu_bearing.fmi", "fmu_bearing.testing")
#: Classes that only their descendants make.
BASES = (Diagram, LobesTable, ReceptanceTable, StiffnessTable, Study)
#: Values whose units are in the words beside them: of variables by name, counts, a scene's keys.
BESIDE = (
    "figures", "energy_share", "last", "values", "fits", "origin", "keys", "std_ln", "std", "value", "moved",
    "a", "b", "change", "rms",
)  # fmt: skip


def identified(scene):
    """Return what a search could have found, from few numbers."""
    (datum,) = read_data([{"microphone": "P1", "quantity": "leq_a", "value_dB": 60.0}], scene)
    (free,) = free_numbers(scene, ["mounting.preload_N"])
    one = np.eye(1)
    return Identified(
        scene, scene, (Estimate(free, 480.0, 0.02, True),), (Compared(datum, 61.0, 60.2, 0.5),), one,
        4e-4 * one, np.ones(1), one, 1.0, ("a remark",), "response", (1, 2), 12, True,
        {"mounting.preload_N": 480.0},
    )  # fmt: skip


@pytest.fixture(scope="module")
def roots():
    """Return results that hold one of each class."""
    bare, pair = EXAMPLES / "7003C-bare.toml", EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
    scene = with_fidelity(bare, model="rings")
    made = record(scene, 0.1, settle=0.02, radiation_model="compact", progress=False)
    sound = analyse_sound(made, ["P1", "P4"])
    point = operating_point(read_scene(pair))
    ranges = {"preload": (200.0, 500.0), "speed": (5e3, 9e3)}
    layout = lay_out(scene, ranges, "morris", 4, figures=["friction_torque"])
    run, rough = np.array([1e-4, 2e-4]), vibration(scene, seeds=1, rigid=True)
    return [
        point, *verdicts(point), fits(EXAMPLES.parent / "fits" / "7003C-ceramic.toml"),
        temperatures(read_scene(bare)), modes(bare), campbell(bare, [18e3, 20e3, 22e3]),
        stiffness(pair, frequencies=[1e3]), receptance(pair, [1e3]),
        lobes(EXAMPLES.parent / "milling" / "7003C-QBC-end-mill.toml", [18e3]),
        error_motion(scene, revolutions=20), sound,
        noise_at(made, sound, 3000.0), measure.envelope_of(made, "outer_ring.acceleration.z"),
        spread(made, ["P1"], seeds=1), compare(made, made),
        KeyPair("mounting.preload_N", None, 2.0), BandPair(500.0, 60.0, math.nan),
        FigurePair("friction_torque", "N mm", 15.0, 16.0), Finding("P1", 1.5, (1.2, 1.7)),
        Choice("a", 1.0, 0.1, (Probe("full", "", 0.01, 1e-5, (Errors(0, 0.1, 0.2, 0.3, 0.4),), 2.0),), 0),
        rough, *rough.bands,
        changes(bare, levels=False), identified(scene), simulate(scene, 2e-3, outputs=["friction_torque"]),
        Tradeoff("a", 9e3, 0.01, 0.01, 1e-6, 1e-6, 1e-6, (Row(Setting(), trajectory=1e-3),)),
        Sensitivity("a", 9e3, 0.01, 0.01, {}, (Moved("fmu.x", 1.0, 1.2, (0.1,) * 7),)),
        evaluated(
            layout,
            {task.key: Outcome((1.0 + k,), "", 1.0) for k, task in enumerate(layout.plan.tasks)},
        ),
        Realtime(scene, 1e-3, (Timed("rings", 0, "held", run, run, 1e-3),), {}, "a machine"),
    ]  # fmt: skip


def kinds(of=Result):
    """Yield all classes of results of the package."""
    for kind in of.__subclasses__():
        yield kind
        yield from kinds(kind)


def every(found):
    """Yield all results within a value."""
    if isinstance(found, Result):
        yield found
        yield from every([found.records()] if found.records() != (found,) else [])
        for value in [*vars(found).values(), *(one.of(found) for one in found.declared)]:
            yield from every(value)
    elif isinstance(found, dict | list | tuple):
        for one in found.values() if isinstance(found, dict) else found:
            yield from every(one)


def without_unit(values, units, key=""):
    """Yield the keys of numbers that have no unit, in names or declared of all that is below a name."""
    if isinstance(values, dict):
        for name, value in values.items():
            known = units.get(name) or Quantity(re.sub(r"\W", "_", name)).unit  # names may have blanks
            if not known and name not in BESIDE:
                yield from without_unit(value, units, f"{key}.{name}")
    elif isinstance(values, list):
        for value in values:
            yield from without_unit(value, units, key)
    elif isinstance(values, float):
        yield key


def finite(value):
    """Return a summary as JSON has it."""
    if isinstance(value, dict):
        return {key: finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


@pytest.mark.heavy
def test_every_result_is_saved_and_read_back_with_units(roots, tmp_path):
    for module in pkgutil.walk_packages(fmu_bearing.__path__, "fmu_bearing."):
        if not module.name.startswith(WITHOUT) and not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    found = {type(one): one for one in every(roots)}
    units = {one.key: one.unit for kind in found for one in kind.declared if one.unit}
    assert {kind.__name__ for kind in kinds() if kind not in BASES} == {kind.__name__ for kind in found}
    for kind, one in found.items():
        save = partial(Result.save, one)
        summary = one.summary()
        assert summary and plain(summary) == summary, kind
        # NaN is null there
        assert json.loads(save(tmp_path / "one.json").read_text(encoding="utf-8")) == finite(summary), kind
        assert not list(without_unit(summary, units)), kind
        rows = one.records()
        columns, texts = table(type(rows[0]), rows)
        assert all(len(row) == len(columns) and all(isinstance(cell, str) for cell in row) for row in texts)
        frame = Result.to_pandas(one)
        data = Result.to_xarray(one)
        with save(tmp_path / "rows.csv").open(encoding="utf-8", newline="") as file:
            read = list(csv.DictReader(file))
        assert len(frame) == len(rows) and (not frame.size or len(read) == data.sizes["row"] == len(rows)), (
            kind
        )
        for key, unit in frame.attrs["units"].items():
            assert data[key].attrs["units"] == unit
            for cell, value in zip([row[key] for row in read], frame[key], strict=True):
                if isinstance(value, float) and math.isfinite(value):
                    assert float(cell) == pytest.approx(value, rel=1e-8), (kind, key)  # nine digits
                    assert unit or Quantity(key).unit or key in BESIDE, (kind, key)


@pytest.mark.heavy
def test_netcdf_holds_rows_with_their_units(roots, tmp_path):
    xarray = pytest.importorskip("xarray")
    (found,) = (one for one in roots if hasattr(one, "statics"))
    with xarray.open_dataset(found.statics.save(tmp_path / "loads.nc"), engine="h5netcdf") as data:
        assert data["axial_N"].values.tolist() == [one.axial for one in found.statics.bearings]
        assert data["axial_N"].attrs["units"] == "N" and data["moment_y_N_m"].attrs["units"] == "N m"
