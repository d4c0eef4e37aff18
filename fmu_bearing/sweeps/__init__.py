"""A scene over a grid or samples of its values, on all cores or a cluster, resumable.

======================  ======================================================================
``description``         a sweep as a TOML file
``axes``                the varied keys, their values, their text on the command line
``figures``             the figures of the run of a point, and error motion
``plan``                all points, checked before the first is run
``point``               one point: its key, its run
``local``               points in this process or on worker processes
``cluster``             points on a Dask cluster
``store``               finished points on disk
``runs``                runs the points that are not finished; progress; Ctrl-C
``result``              the dataset, netCDF and CSV
``picture``             curves and maps
``ranges``              ranges in place of an axis's values, for a study of sensitivity
``sampling``            samples of several ranges at once, and the indices from them
``global_sensitivity``  what figures rest on, by Morris or Sobol, on the points of a sweep
``index_picture``       the indices as bars
======================  ======================================================================

Equal keys give equal figures. Each point is a separate run from its steady state, with the scene's own
seed unless the seed is an axis. Order, number of workers and restarts therefore do not change the results.
"""

import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from fmu_bearing.extras import need
from fmu_bearing.scene import SceneSource
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.cluster import checked
from fmu_bearing.sweeps.plan import SETTLE, WINDOW, plan as lay_out
from fmu_bearing.sweeps.result import dataset, save
from fmu_bearing.sweeps.runs import run_plan
from fmu_bearing.sweeps.store import Store

if TYPE_CHECKING:
    import xarray

__all__ = ["SweepError", "save", "sweep"]


def sweep(
    source: SceneSource,
    axes: Mapping[str, Sequence[Any] | str],
    *,
    settle: float = SETTLE,
    window: float = WINDOW,
    figures: Sequence[str] | None = None,
    folder: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: bool | None = None,
) -> "xarray.Dataset":
    """Run a scene over all combinations of some of its values and return figures over these axes.

    Parameters
    ----------
    source : Scene or path
        Scene file (TOML) or scene in memory; fidelity ``auto`` is resolved once, for the scene as it is.
    axes : mapping
        Values by dotted key of the scene (``"mounting.preload_N"``) or short name (``speed``, ``preload``,
        ``pedestal``, ``viscosity``, ``seed``, ``fidelity``), in the key's unit: a list, or text such as
        ``"8000:40000:9"`` and ``"1e7:1e8:5log"``.
    settle, window : float
        Time (s) that each point runs before its figures are taken, and over which they are taken.
    figures : sequence of str, optional
        Variables of the table, with ``*`` for any text, and a statistic behind a colon where another than the
        usual is wanted (``"friction_torque:max"``); default: levels, velocities, loads, friction, heat.
    folder : path, optional
        Finished points are kept there and are not run again. Default: nothing is written.
    workers : int, optional
        Processes; 1: all in this one. Default: one per core. A script needs
        ``if __name__ == "__main__":`` then.
    scheduler : str, optional
        Address of a Dask scheduler (``"tcp://host:8786"``), in place of processes here.
    progress : bool, optional
        Show a progress bar; default: on a terminal.

    Returns
    -------
    xarray.Dataset
        Figures over the axes with units in attributes, SI; ``seed``, ``wall`` (s) and ``reason`` of each
        point. A point that cannot be run has NaN and the reason; the others are run.

    Raises
    ------
    ValueError
        For keys, values and figures that are refused, all reported before anything is run (`SweepError`,
        `SceneError`), and for a scheduler that does not answer.
    MissingExtra
        Without xarray, or without Dask where a scheduler is given.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt`; finished points are in the folder.

    Examples
    --------
    >>> from fmu_bearing import read_scene, sweep
    >>> scene = read_scene("examples/scenes/7003C-bare.toml")
    >>> data = sweep(
    ...     scene.replace({"sound": None}),
    ...     {"fidelity": ["rings"], "preload": [200, 500]},
    ...     settle=0.005,
    ...     window=0.01,
    ...     figures=["contact.inner.load_mean"],
    ...     workers=1,
    ... )
    >>> data["contact.inner.load_mean"].sel(fidelity="rings").round().values.tolist()  # N
    [49.0, 111.0]
    """
    need("xarray", "a sweep")
    if scheduler is not None:
        checked(scheduler)
    made = lay_out(source, axes, settle, window, figures)
    if workers is not None and workers < 1:
        raise SweepError(f"workers = {workers} is refused: give 1 or more")
    store = None if folder is None else Store(pathlib.Path(folder))
    return dataset(made, run_plan(made, store, workers, scheduler, progress))
