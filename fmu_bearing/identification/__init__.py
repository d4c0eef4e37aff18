"""Identification: numbers of a scene found from measured sound and vibration.

=================  =======================================================================
``errors``         what is refused
``quantities``     levels, third octaves, lines: how data name them
``data``           measured values from files and tables
``free``           free keys, their bounds and their scale
``sensors``        paths from recorded channels to the measured places, and levels there
``run_cache``      evaluations on disk, so that a search can go on
``model``          computed levels for values of the free keys, over conditions and seeds
``statistics``     covariance of levels and of values, what the data cannot distinguish
``search``         least squares from several starts
``result``         identified values, tables
``files``          the scene with its new values, tables, report
``picture``        measured against computed
=================  =======================================================================

Every computed level is that of a run of the scene: with fidelity ``response`` a step of the search costs half
as many runs as recordings of each excitation alone would (``docs/identification.md`` has the count).
"""

import os
import pathlib

from fmu_bearing.identification.data import Source, read_data
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.free import Wanted, free_numbers
from fmu_bearing.identification.result import Identified
from fmu_bearing.scene import SceneSource, scene_of
from fmu_bearing.scene.exclusions import require

__all__ = ["Identified", "IdentifyError", "identify"]

SEEDS, STARTS = 4, 3


def identify(
    scene: SceneSource,
    data: Source,
    free: Wanted,
    *,
    background: Source | None = None,
    fidelity: str | None = None,
    seeds: int = SEEDS,
    starts: int = STARTS,
    duration: float | None = None,
    settle: float | None = None,
    few: bool = False,
    accept: bool = False,
    folder: str | os.PathLike[str] | None = None,
    workers: int = 1,
    progress: bool | None = None,
) -> Identified:
    """Find the values of some keys of a scene from measured levels.

    Parameters
    ----------
    scene : Scene or path
        Where the search starts; fidelity ``auto`` is resolved once.
    data : path, pandas.DataFrame, xarray.Dataset or sequence of mapping
        Measured values: microphone, conditions, quantity, ``value_dB``, ``std_dB``, role ``fit`` or
        ``check`` (`fmu_bearing.identification.data.read_data`).
    free : sequence of str, or mapping
        Dotted keys, ``"KEY"`` or ``"KEY=LOW:HIGH"``, or bounds (low, high) or None by key. ``*`` in a key
        matches any text: one common factor acts on all keys that match. Without bounds: a decade to
        either side of the scene's value.
    background : like data, optional
        Levels that are there without the bearing; they are added as energy.
    fidelity : str, optional
        Of the search; default: ``response`` where it carries the scene, else ``full``. The levels before and
        after are computed in the scene's own.
    seeds : int
        Levels are averaged over so many seeds of the imperfections, from the scene's own on; of a set of K
        bearings every K-th, as its bearings have seeds of their own one after the other.
    starts : int
        Starting points: the scene, and others within the bounds.
    duration, settle : float, optional
        Length (s) of each run that is measured, and of what is left out before it.
    few : bool
        Allow fewer than three fitted values per free key. The result then repeats the values rather than
        explaining them, and says so.
    accept : bool
        Take levels outside 20 to 160 dB (bands and lines: 5 to 160 dB) and speeds below 500 r/min as they
        are. They are refused otherwise: most often they are another unit, or a microphone is dead.
    folder : path, optional
        Computed levels are kept there: the same call goes on where an earlier one ended.
    workers : int
        Threads.
    progress : bool, optional
        Show progress; default: on a terminal.

    Returns
    -------
    Identified
        Look at ``doubts`` first: what says that values and data contradict each other.

    Raises
    ------
    IdentifyError
        For data, keys or settings that are refused, all problems at once.
    SceneError
        For a set on another model's shaft.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with the best values so far as ``found``, not ``complete``.

    Examples
    --------
    >>> from fmu_bearing import identify, with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="response")
    >>> measured = [
    ...     {"microphone": name, "quantity": "leq_a", "value_dB": value, "std_dB": 1.5}
    ...     for name, value in {"P1": 60.0, "P2": 57.0, "P3": 60.0, "P4": 67.0}.items()
    ... ]
    >>> found = identify(scene, measured, ["imperfections.*_race_amplitude_um"], seeds=2, starts=1)
    >>> found.rms() < found.rms(before=True), found["imperfections.*_race_amplitude_um"].determined
    (True, True)
    """
    from fmu_bearing.identification.search import search

    start = scene_of(scene)
    require(start, "identification")
    measured = read_data(data, start, background, accept=accept)
    conditions = {key for one in measured for key, _ in one.conditions}
    return search(
        start, measured, free_numbers(start, free, conditions),
        fidelity=fidelity, seeds=seeds, starts=starts, duration=duration, settle=settle, few=few,
        folder=None if folder is None else pathlib.Path(folder), workers=workers, progress=progress,
    )  # fmt: skip
