"""The run for a report: sound channels, all variables at 25.6 kHz, the balls' loads, angles, rates."""

import warnings

from fmu_bearing.engine.layout import SD, Z
from fmu_bearing.instance import Instance
from fmu_bearing.interface.outputs import internals, outputs
from fmu_bearing.metrology.axis_watch import AxisWatch
from fmu_bearing.progress import Stopped
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.run.balls import Watch
from fmu_bearing.scene import Scene

#: Communication step (s): every second sound sample. At 20,000 r/min each ball that passes gets 11 points.
STEP = 2.0 / SD.RATE


def variables_of(scene: Scene) -> tuple[str, ...]:
    """Names of all variables of a run without microphones, except the balls' velocities."""
    table = [*outputs(scene), *internals(scene)]
    return tuple(v.name for v in table if v.array == "z" and v.index < Z.BALLS)


def observed(
    scene: Scene,
    duration: float = 0.5,
    *,
    speed: float | None = None,
    settle: float = 0.1,
    radiation_model: str | None = None,
    progress: bool | None = None,
) -> tuple[Recording, list[str]]:
    """Record a scene with all variables that a report shows.

    Parameters
    ----------
    scene : Scene
        Its fidelity is not ``auto``.
    duration, settle : float
        In s, as for ``fmu_bearing.record``.
    speed : float, optional
        Shaft speed (rad/s); default: the scene's.
    radiation_model : str, optional
        In place of the scene's.

    Returns
    -------
    recording : Recording
        Contacts of the balls are among its outputs under the names of `balls.name_of`, and what error
        motion needs under those of `AxisWatch`.
    warnings : list of str
        Warnings of the run.

    Raises
    ------
    ValueError
        As ``record``.
    Stopped
        On Ctrl-C, as ``record``, with both as ``found``.
    """
    watch, axis = Watch(), AxisWatch()

    def both(bearing: Instance) -> None:
        watch(bearing)
        axis(bearing)

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        missing = ""
        try:
            recording = record(
                scene, duration, speed=speed, settle=settle, step=STEP, radiation_model=radiation_model,
                outputs=variables_of(scene), progress=progress, watch=both, warn=False, keep=True,
            )  # fmt: skip
        except Stopped as stop:
            recording, missing = stop.found, stop.missing
    recording.outputs.update(watch.outputs() | axis.outputs(scene))
    found = recording, list(dict.fromkeys(str(each.message) for each in caught))
    if missing:
        raise Stopped(found, missing)
    return found
