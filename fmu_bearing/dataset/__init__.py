"""Labelled data sets: waveforms of many runs of a scene, with what each run was given and what it did.

===========  =====================================================================
``plan``     a data set as a TOML file: classes, draws, rate, sensors
``draw``     the values of each run: Latin hypercubes, few sizes of defects
``sensors``  what accelerometers and microphones of a run read, at another rate
``run``      one run: waveforms and the labels that it gives
``layout``   all runs, checked before the first is run
``store``    finished runs on disk
``card``     the data card
``files``    waveforms (netCDF-4), labels (CSV), data card
===========  =====================================================================

Runs go over the cores, or a Dask cluster, as the points of a sweep do (`sweeps.runs`).
"""

import os
import pathlib

from fmu_bearing.dataset.files import write
from fmu_bearing.dataset.layout import Layout, lay_out
from fmu_bearing.dataset.plan import Plan, read_plan
from fmu_bearing.dataset.run import run
from fmu_bearing.dataset.store import Runs
from fmu_bearing.extras import need
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.cluster import checked
from fmu_bearing.sweeps.runs import Outcomes, run_plan

__all__ = ["Layout", "Plan", "dataset", "lay_out", "read_plan", "run_layout", "write"]


def dataset(
    source: str | os.PathLike[str] | Plan | Layout,
    folder: str | os.PathLike[str],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: bool | None = None,
) -> dict[str, pathlib.Path]:
    """Run a plan of labelled scenes and write waveforms, labels and a data card.

    Finished runs are kept under ``folder`` and are not run again. Equal plans give equal files on one
    machine, whatever the number of workers, and however often the work was interrupted.

    Parameters
    ----------
    source : path, Plan or Layout
        Plan file (TOML), or what `read_plan` and `lay_out` return.
    folder : path
        Where the files go.
    workers : int, optional
        Processes; 1: all in this one. Default: one per core. A script needs
        ``if __name__ == "__main__":`` then.
    scheduler : str, optional
        Address of a Dask scheduler (``"tcp://host:8786"``), in place of processes here.
    progress : bool, optional
        Show a progress bar; default: on a terminal.

    Returns
    -------
    dict
        The files: ``waveforms``, ``labels``, ``card``.

    Raises
    ------
    ValueError
        For a plan that is refused, before anything is run (`SweepError`, `SceneError`), and for a scheduler
        that does not answer.
    MissingExtra
        Without h5netcdf, or without Dask where a scheduler is given.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt`; finished runs are in the folder.
    """
    need("h5netcdf", "the waveforms of a data set")
    if scheduler is not None:
        checked(scheduler)
    if workers is not None and workers < 1:
        raise SweepError(f"workers = {workers} is refused: give 1 or more")
    if not isinstance(source, Layout):
        source = lay_out(source if isinstance(source, Plan) else read_plan(source))
    store = Runs(pathlib.Path(folder))
    outcomes = run_layout(source, store, workers, scheduler, progress)
    return write(source, outcomes, store, pathlib.Path(folder))


def run_layout(
    layout: Layout, store: Runs, workers: int | None = None, scheduler: str | None = None,
    progress: bool | None = None,
) -> Outcomes:  # fmt: skip
    """Run what ``store`` does not hold; parameters and errors as `dataset`."""
    return run_plan(layout, store, workers, scheduler, progress, run, "runs")
