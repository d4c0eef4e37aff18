"""The files of a data set: waveforms (netCDF-4, which is HDF5), labels (CSV), data card."""

import math
import pathlib
from importlib.metadata import version
from typing import Any

import numpy as np

from fmu_bearing.dataset.card import card
from fmu_bearing.dataset.layout import Layout
from fmu_bearing.dataset.run import RunOutcome, samples
from fmu_bearing.dataset.store import Runs
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.extras import need
from fmu_bearing.files import naming, taking_place, write_whole
from fmu_bearing.results.table import write_csv
from fmu_bearing.scene.values import value_at
from fmu_bearing.sweeps.point import code_digest
from fmu_bearing.sweeps.result import NOT_RUN, text_of
from fmu_bearing.sweeps.runs import Outcomes

WAVEFORMS, LABELS, CARD = "waveforms.nc", "labels.csv", "README.md"
#: Text of any length, as h5py writes it.
_TEXT = np.dtype("O", metadata={"vlen": str})
#: Columns of the labels before and behind those of scene and run.
RUN, CLASS, VERSION, REASON = "run", "class", "version", "reason"


def write(layout: Layout, outcomes: Outcomes, store: Runs, folder: pathlib.Path) -> dict[str, pathlib.Path]:
    """Write what is finished and return the files; a run without waveforms has NaN and its reason.

    Equal runs give equal files: nothing in them is of the time or the order in which they were made.
    """
    columns, rows = labels(layout, outcomes)
    cells = [[text_of(value) for value in row] for row in rows]
    return {
        "waveforms": _waveforms(layout, outcomes, store, folder / WAVEFORMS),
        "labels": write_csv(folder / LABELS, columns, cells),
        "card": write_whole(folder / CARD, card(layout, outcomes, versions()).encode("utf-8")),
    }


def labels(layout: Layout, outcomes: Outcomes) -> tuple[list[str], list[list[Any]]]:
    """Return heads and a row per run: values of its scene under their dotted keys, then those of the run."""
    done = [outcomes.get(task.key) for task in layout.tasks]
    found = [one.labels if isinstance(one, RunOutcome) else {} for one in done]
    keys, names = layout.columns(), list(dict.fromkeys(name for one in found for name in one))
    rows = []
    for number, (drawn, task, one) in enumerate(zip(layout.runs, layout.tasks, done, strict=True)):
        given = [value_at(task.scene, key) for key in keys]
        read = [found[number].get(name) for name in names]
        reason = NOT_RUN if one is None else one.reason
        rows.append([number, drawn.label, *given, *read, version("fmu-bearing"), reason])
    blank = [["" if value is None else value for value in row] for row in rows]
    return [RUN, CLASS, *keys, *names, VERSION, REASON], blank


def versions() -> dict[str, str]:
    """Return what the numbers come from."""
    return {"fmu_bearing": version("fmu-bearing"), "engine": source_hash(), "code": code_digest()}


def _waveforms(layout: Layout, outcomes: Outcomes, store: Runs, path: pathlib.Path) -> pathlib.Path:
    """Write the waveforms run by run, so that memory holds one of them."""
    h5netcdf = need("h5netcdf", "the waveforms of a data set")
    plan, sensors = layout.plan, layout.sensors
    size = samples(plan.length_s, plan.rate_Hz)
    shape = (len(layout.tasks), len(sensors), size)
    with taking_place(path) as target, naming(path), h5netcdf.File(target, "w") as file:
        file.dimensions = dict(zip(("run", "sensor", "sample"), shape, strict=True))
        kept = file.create_variable(
            "waveforms",
            ("run", "sensor", "sample"),
            np.float32,
            chunks=(1, *shape[1:]),
            fillvalue=np.float32(math.nan),
        )
        scenes = file.create_variable("scene", ("run",), _TEXT)
        texts = {
            "class": ("run", [run.label for run in layout.runs], "Class of the run"),
            "sensor": ("sensor", list(sensors), "Name of the sensor"),
            "unit": ("sensor", list(sensors.values()), "Unit of what the sensor reads"),
        }
        for name, (dimension, values, words) in texts.items():
            variable = file.create_variable(name, (dimension,), _TEXT, data=np.array(values, dtype=object))
            variable.attrs["long_name"] = words
        scenes.attrs["long_name"] = "Scene of the run, TOML"
        kept.attrs["long_name"] = "What the sensors read, in the unit of each"
        time = file.create_variable("time", ("sample",), np.float64, data=np.arange(size) / plan.rate_Hz)
        time.attrs["units"], time.attrs["long_name"] = "s", f"Time after {plan.settle_s:g} s of the run"
        for number, task in enumerate(layout.tasks):
            if outcomes.get(task.key) is not None and outcomes[task.key].lasting:
                scenes[number], waves = store.read(task)
                if waves.size:
                    kept[number] = waves
        about = {
            "title": plan.title,
            "plan": plan.to_toml(),
            "rate_Hz": plan.rate_Hz,
            "licence": plan.licence,
        }
        file.attrs.update(about | versions())
    return path
