"""The run for a report: sound channels, all variables at 25.6 kHz, the balls' loads, angles, rates."""

import warnings

from fmu_bearing.engine.layout import SD, SP, Z
from fmu_bearing.instance import Instance
from fmu_bearing.interface.table import variables
from fmu_bearing.metrology.axis_watch import AxisWatch
from fmu_bearing.progress import Stopped
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.results.balls import Watch
from fmu_bearing.scene import Scene
from fmu_bearing.steady.rest import Part, parts

#: Communication step (s): every second sound sample. At 20,000 r/min each ball that passes gets 11 points.
STEP = 2.0 / SD.RATE
_KEPT = {*Z.BEARING_OUTPUTS, *SP.OUTPUTS, *SP.BEARING_OUTPUTS}


def variables_of(scene: Scene) -> tuple[str, ...]:
    """Names of the variables of a run but those of microphones, of single balls and of bending."""
    table = variables(scene, 0.0)
    return tuple(v.name for v in table if v.array == "z" and v.name.rpartition("].")[2] in _KEPT)


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
        Contacts of the balls are among its outputs under the names of `balls.name_of`, of a set behind
        ``bearing[1].`` and so on, and what error motion needs under those of `AxisWatch`.
    warnings : list of str
        Warnings of the run.

    Raises
    ------
    ValueError
        As ``record``.
    Stopped
        On Ctrl-C, as ``record``, with both as ``found``.
    """
    axis, watches = AxisWatch(), list[tuple[Watch, Part]]()

    def both(instance: Instance) -> None:
        axis(instance)
        if not watches:
            watches.extend((Watch(), part) for part in parts(instance))
        for watch, part in watches:
            watch(part)

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
    recording.outputs.update(axis.outputs(scene))
    for bearing, (watch, _) in zip(scene.bearings(), watches, strict=True):
        recording.outputs.update({bearing.prefix + name: values for name, values in watch.outputs().items()})
    found = recording, list(dict.fromkeys(str(each.message) for each in caught))
    if missing:
        raise Stopped(found, missing)
    return found
