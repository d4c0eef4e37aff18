"""Signals of a recording by name: pressures, accelerations of the bodies, variables."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.field import form_of
from fmu_bearing.acoustics.radiation.frequencies import BAND
from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.engine.layout import SD
from fmu_bearing.interface.names import known
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.results.even_steps import ALLOWED, spacing
from fmu_bearing.results.variable_names import unit_of
from fmu_bearing.scene.member import radiating

ACCELERATION = "m/s2"
_BODIES = ("inner_ring", "outer_ring", "cage")
FEWEST = 3  # points of variables over time that have a step


@dataclass(frozen=True, eq=False)
class RecordedSignal:
    """A signal of a recording at even spacing.

    Attributes
    ----------
    name : str
        A microphone or accelerometer; ``outer_ring.acceleration.z``; a variable. Names of a set begin as
        ``bearing[1].``.
    unit : str
    values : ndarray, shape (samples,)
    rate, start : float
        Samples per second; time of the first one (s after initialisation).
    highest : float
        Frequency (Hz) up to which the signal reaches.
    bearing : int, optional
        Number of the bearing it is of, from 1; None: of no single one.
    place : (x, y, z), optional
        Of a microphone, m.
    """

    name: str
    unit: str
    values: NDArray[np.float64]
    rate: float
    start: float
    highest: float
    bearing: int | None = None
    place: tuple[float, float, float] | None = None

    @property
    def time(self) -> NDArray[np.float64]:
        """Time of each sample (s after initialisation)."""
        return self.start + np.arange(self.values.size) / self.rate


def signal_names(recording: ChannelHistory) -> list[str]:
    """Return the names of all signals: microphones, accelerometers, bodies, variables at even points."""
    microphones = [name for name, _ in recording.microphones]
    variables = recording.outputs if _step(recording) else ()
    return [*microphones, *recording.accelerometers, *_accelerations(recording), *variables]


def recorded_signal(
    recording: ChannelHistory, name: str, radiation_model: str | None = None
) -> RecordedSignal:
    """Return one signal of a recording; see `Recording.signal`."""
    known(name, signal_names(recording), "signal")
    number = _number(name) if recording.scene is not None and recording.scene.assembly.joined else 1
    if name in dict(recording.microphones):
        (values,) = recording.pressure([name], radiation_model)
        place = dict(recording.microphones)[name]
        highest = min(BAND[1], 0.5 * recording.rate)
        return RecordedSignal(name, "Pa", values, recording.rate, recording.start, highest, None, place)
    if name in recording.accelerometers:
        read: NDArray[np.float64] = getattr(recording, "acceleration")(name)  # noqa: B009
        return RecordedSignal(name, ACCELERATION, read, recording.rate, recording.start, BAND[1])
    if name in _accelerations(recording):
        column, sign = _accelerations(recording)[name]
        values = sign * recording.channel_signals([column])[0]
        return RecordedSignal(name, ACCELERATION, values, recording.rate, recording.start, BAND[1], number)
    step = _step(recording)
    kept = _within(recording)
    times, values = recording.output_time[kept], recording.outputs[name][kept]
    unit = recording.units.get(name) or unit_of(name)
    return RecordedSignal(name, unit, values, 1.0 / step, float(times[0]), 0.5 / step, number)


def _number(name: str) -> int | None:
    """Return the number of the bearing that a name of a set begins with."""
    head = name.partition(".")[0]
    return int(head[8:-1]) if head.startswith("bearing[") and head[8:-1].isdigit() else None


def _accelerations(recording: ChannelHistory) -> dict[str, tuple[int, float]]:
    """Return columns of the channel history by the name of the acceleration that they hold, and its sign.

    Channels along x are in the axes of their bearing, which one that is mounted the other way round has
    towards the nose.
    """
    scene = recording.scene
    if scene is None or not recording.history.size or form_of(recording.radiation_model) != "vectors":
        return {}
    found: dict[str, tuple[int, float]] = {}
    first = 0
    for k, bearing in enumerate(scene.bearings()):
        for body, word in enumerate(_BODIES):
            if word == "cage" and bearing.scene.bearing.cage is None:
                continue
            for axis, way in enumerate("xyz"):
                sign = bearing.sign if way == "x" else 1.0
                found[f"{bearing.prefix}{word}.acceleration.{way}"] = first + SD.c_body(body, axis), sign
        modes = ring_modes(radiating(scene, k))
        first += SD.vector_channels(recording.harmonics, 2 * len(modes))
    return found


def even_step(times: NDArray[np.float64]) -> float:
    """Return the step (s) of evenly spaced times; 0 for others and for fewer than three."""
    found = spacing(times)
    return found.step if times.size >= FEWEST and found.even else 0.0


def why_uneven(times: NDArray[np.float64]) -> str:
    """Say what times without a step (`even_step`) are, too few or how uneven and where; and the way out."""
    if times.size < FEWEST:
        return f"too few: {times.size}, and {FEWEST} or more are needed: take less settle, or a longer record"
    found = spacing(times)
    gap, middle = found.gaps[found.worst], float(np.median(found.gaps))
    far = "repeated" if found.off == np.inf else f"up to {100.0 * found.off:.3g} % of a step off an even grid"
    return (
        f"uneven: {far}, where rounding explains {100.0 * ALLOWED:g} %; at {times[found.worst]:.6g} s the "
        f"step is {gap:.4g} s, the middle one {middle:.4g} s: resample them at even times"
    )


def _step(recording: ChannelHistory) -> float:
    """Return the step (s) between points of variables; 0 where they are not even."""
    return even_step(recording.output_time[_within(recording)])


def _within(recording: ChannelHistory) -> NDArray[np.bool_]:
    """Return which points of variables are within the recording."""
    time, end = recording.output_time, recording.start + recording.size / recording.rate
    return np.asarray((time >= recording.start - 1e-9) & (time < end - 1e-9))
