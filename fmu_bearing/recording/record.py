"""One run from a scene's steady state with the engine's channel history kept."""

import itertools
import math
import os
import pathlib
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.field import TAIL, form_of
from fmu_bearing.acoustics.radiation.radiators import Air
from fmu_bearing.cautions import DOUBTS
from fmu_bearing.engine.layout import SD, P, S
from fmu_bearing.instance import Instance
from fmu_bearing.modal.campbell.doubts import doubt
from fmu_bearing.prepare.lengths import parts_of
from fmu_bearing.prepare.model import Model, prepare
from fmu_bearing.prepare.sound_block import from_lines
from fmu_bearing.progress import Stopped
from fmu_bearing.recording.channels.turning import WHIRL
from fmu_bearing.recording.recording import Recording
from fmu_bearing.results.rates import RatesWatch
from fmu_bearing.run.choose import resolve
from fmu_bearing.run.figures import of_each
from fmu_bearing.run.inputs import Signal
from fmu_bearing.run.march import begin, march, to_points, underway
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.sound import Microphone, Sound

__all__ = ["OUTPUTS", "Recording", "RecordingSource", "record", "recording_of"]

#: A recording or its file (``.npz``), or a scene or its file, which is recorded.
RecordingSource = Recording | SceneSource

#: Default variables of a recording, besides speed and channels.
OUTPUTS = (
    "friction_torque", "contact.inner.load_mean", "contact.outer.load_mean", "contact.inner.angle_mean",
    "contact.outer.angle_mean",
)  # fmt: skip
SHORTEST = 0.02  # s of a recording that Ctrl-C ends: periods of 50 Hz and more
DURATION = 0.5  # s: of a scene that is recorded where a recording is taken
_QUICK = 0.5  # s: a run without a bar, where nothing is said of it
_FAR = 2000.0  # mm: place of the one microphone of a recording; its flight lengthens the channel history


def record(
    source: SceneSource | Model,
    duration: float,
    *,
    speed: Signal | None = None,
    inputs: Mapping[str, Signal] | None = None,
    settle: float = 0.02,
    step: float = 4e-4,
    radiation_model: str | None = None,
    outputs: Iterable[str] = OUTPUTS,
    microphones: bool = False,
    progress: bool | None = None,
    watch: Callable[[Instance], None] | None = None,
    warn: bool = True,
    keep: bool = False,
) -> Recording:
    """Run a scene and keep its channels at 51.2 kHz, so that any microphone can be set up afterwards.

    Parameters
    ----------
    source : Scene, Model or path
        Scene file (TOML) or scene in memory; fidelity ``auto`` is resolved first.
    duration : float
        Length of the recording (s), counted from the end of ``settle``.
    speed : float or callable, optional
        Shaft speed (rad/s), or a function of time (s after initialisation); default: the scene's. It ramps
        between communication points.
    inputs : mapping, optional
        Other inputs by name, numbers or functions of time, SI units, held over each step.
    settle : float
        Time (s) left out at the beginning, in which the start-up dies away.
    step : float
        Communication step (s). It is limited to the length of the engine's channel history, 0.48 ms or more.
    radiation_model : str, optional
        In place of the scene's ``sound.radiation_model`` (``compact`` without sound). Each radiation model of
        the papers needs its own channels and must be chosen here; all others share one set of channels.
    outputs : iterable of str
        Variables kept at the communication points, besides ``solver.restarts``, ``solver.growth``, the cage's
        whirl and the rates of the balls; of a set ``contact.inner.load_mean`` and so on for each of its
        bearings.
    microphones : bool
        Compute the scene's own microphones during the run, so that variables such as ``mic[1].leq`` can be
        kept. Without them the engine computes a single far microphone and runs faster.
    progress : bool, optional
        Show a progress bar; default: when the run is long and a terminal is there.
    watch : callable, optional
        Called with the running bearing after initialisation and after each communication step, to read
        values of the state that are not variables.
    warn : bool
        Warn (``UserWarning``) where figures of fidelity rings or response are in doubt: a ring that whirls by
        itself, rings that depart from full in a short run, a loud cage, weakly damped modes. It takes 0.5 to
        1.5 s for each scene, of sets up to 5 s, once per process, at constant inputs; of scenes with sound
        it makes the transfer functions of ``radiation_model``.
    keep : bool
        On Ctrl-C raise `Stopped` with what was recorded until then as ``recording``, 20 ms or more of it.

    Returns
    -------
    Recording

    Raises
    ------
    ValueError
        For a refused time or input; `EngineError` and `SceneError` are subclasses.
    KeyboardInterrupt
        On Ctrl-C; with ``keep`` it is `Stopped`, or says why nothing is kept.

    Examples
    --------
    >>> from fmu_bearing import record, with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
    >>> recording = record(scene, 0.05, radiation_model="compact")
    >>> [round(float(level)) for level in recording.levels(weighting="A")]  # dB(A) at the scene's microphones
    [62, 59, 61, 69]
    """
    scene = source.scene if isinstance(source, Model) else scene_of(source)
    require(scene, "recording")
    if not isinstance(source, Model):
        scene = resolve(scene)[0]
    for name, value, low in (("duration", duration, 0.0), ("step", step, 0.0), ("settle", settle, -1e-300)):
        if not (math.isfinite(value) and value > low):
            raise ValueError(f"{name} = {value} s: it must be a finite, positive number of seconds")
    wanted = radiation_model or ("compact" if scene.sound is None else scene.sound.radiation_model)
    if microphones and (scene.sound is None or form_of(wanted) != form_of(scene.sound.radiation_model)):
        raise ValueError(
            "microphones=True runs the scene as it is, which has no channels for "
            f'radiation_model = "{wanted}": leave out microphones, or set sound.radiation_model in the scene'
        )
    drives = dict(inputs or {})
    if speed is not None:
        drives["shaft_speed"] = speed
    doubted = _doubt(scene, drives, wanted) if warn else ""
    if doubted:
        warnings.warn(doubted, stacklevel=2)
    model = source if isinstance(source, Model) and microphones and not from_lines(scene) else prepare(
        scene if microphones
        else with_far_microphone(scene, "compact" if form_of(wanted) == "vectors" else wanted),
        samples=True,
    )  # fmt: skip
    bearing = begin(Instance(model, growth=warn and not doubted), drives)
    first = round(settle * SD.RATE)
    size = round(duration * SD.RATE)
    caged = [one.prefix for one in scene.bearings() if one.scene.bearing.cage is not None]
    whirl = [head + name for head in caged for name in WHIRL]
    names = tuple(dict.fromkeys((*of_each(scene, dict.fromkeys((*outputs, *DOUBTS))), *whirl)))
    kept = _Readings(bearing, names, first + size + TAIL, watch)
    kept.read()
    total, longest = len(kept.rows) / SD.RATE, min(step, (kept.depth - 8) / SD.RATE)
    points = (number * longest for number in itertools.count(1))
    due = itertools.takewhile(lambda _: kept.count < len(kept.rows), points)
    shown = False if progress is None and total <= _QUICK else progress
    with underway(f"{scene.name}: recording", total, shown=shown, stops=keep) as proceed:
        march(bearing, to_points(bearing, due, drives), kept.read, proceed)
    done = min(size, kept.count - first - TAIL)
    if done < min(size, SHORTEST * SD.RATE):
        raise KeyboardInterrupt(
            f"interrupted at {bearing.time:.3g} s of the run: nothing is kept, as levels need {SHORTEST:g} s "
            f"behind the {settle:g} s that are left out"
        )
    recording = Recording(
        scene, wanted, SD.RATE, first / SD.RATE, done, np.array(kept.time), np.array(kept.speed),
        {name: np.array(values) for name, values in kept.outputs.items()} | kept.rates.outputs(scene),
        kept.rows[: first + done + TAIL],
        microphones=tuple((place.name, place.position_m) for place in scene.microphones),
        harmonics=kept.histories[0].harmonics, sensed=kept.sensed[: first + done + TAIL],
    )  # fmt: skip
    if done < size:
        raise Stopped(recording, f"{(size - done) / SD.RATE:.3g} s of the {duration:g} s of the run")
    return recording


def recording_of(source: RecordingSource, duration: float = DURATION, **options: Any) -> Recording:
    """Return a recording as it is, load it from its file (``.npz``), or record a scene.

    Parameters
    ----------
    source : Recording, Scene or path
    duration : float
        Length (s) of the recording of a scene.
    options
        As for `record`.

    Raises
    ------
    ValueError
        As `Recording.load` and `record`.
    """
    if isinstance(source, Recording):
        return source
    if isinstance(source, str | os.PathLike) and pathlib.Path(source).suffix == ".npz":
        return Recording.load(source)
    return record(source, duration, **options)


def _doubt(scene: Scene, drives: Mapping[str, Signal], radiation_model: str) -> str:
    """Return why figures are in doubt, at inputs that do not change; "" where the speed does."""
    if callable(drives.get("shaft_speed")):
        return ""
    fixed = {name: float(value) for name, value in drives.items() if not callable(value)}
    return doubt(scene, fixed, radiation_model)


def with_far_microphone(scene: Scene, radiation_model: str) -> Scene:
    """Return the scene with one far microphone, which is enough for the engine to form its channels."""
    one = Microphone(name="far", x_mm=0.0, y_mm=_FAR, z_mm=0.0)
    sound = scene.sound or Sound(
        radiation_model="compact", radiator="bare",
        air_density_kg_m3=Air.density, sound_speed_m_s=Air.sound_speed,
        time_weighting="fast", metering_start_s=0.0, microphone=(one,),
    )  # fmt: skip
    # channels are motion: they do not depend on what radiates, and a bare bearing is the cheapest
    sound = sound.model_copy(
        update={"radiation_model": radiation_model, "radiator": "bare", "microphone": (one,), "circle": None}
        | {"reflecting_plane_mm": None, "table_file": None, "third_octaves": False, "details": False}
    )
    return scene.model_copy(update={"sound": sound})


class _History:
    """The channel history of one bearing in the state: of its sound, or of its accelerometers.

    ``p``: its parameters; ``part``: its place in the state.
    """

    def __init__(self, p: NDArray[np.float64], part: slice, sensors: bool = False) -> None:
        places = (P.AT_SENSORS, P.SENSORS_SIZE) if sensors else (P.AT_SOUND, P.SOUND_SIZE)
        block, size = (int(p[place]) for place in places)
        if block == 0:
            raise ValueError("the model has no sound: give the scene, or leave microphones=False")
        sound: NDArray[np.float64] = p[block : block + size]
        self._begin = S.SOUND + (int(p[P.SENSORS_STATE]) if sensors else 0)
        self.depth, self.harmonics = int(sound[SD.H_ROWS]), int(sound[SD.H_HARMONICS])
        lanes, channels = int(sound[SD.H_AT_LANES]), int(sound[SD.H_CHANNELS])
        self.lanes = sound[lanes : lanes + channels].astype(int)
        self._part, self._first = part, int(sound[SD.H_S_CHANNELS])

    def count(self, state: NDArray[np.float64]) -> int:
        """Return how many rows the engine has written since initialisation."""
        return int(state[self._part][self._begin + SD.SS_COUNT])

    def rows(self, state: NDArray[np.float64], which: NDArray[np.int_]) -> NDArray[np.float64]:
        """Return rows by their numbers from initialisation on, shape (rows, channels)."""
        first, channels = self._begin + self._first, len(self.lanes)
        ring = state[self._part][first : first + channels * self.depth].reshape(self.depth, channels)
        return ring[which % self.depth][:, self.lanes]


class _Readings:
    """Values read at communication points: rows of the engine's channel history, speed, outputs."""

    def __init__(
        self, bearing: Instance, outputs: tuple[str, ...], rows: int, watch: Callable[[Instance], None] | None
    ) -> None:
        self.bearing = bearing
        self.watch = watch
        self.rates = RatesWatch()
        self.histories = [_History(bearing.p[at_p], at_s) for at_p, at_s in parts_of(bearing.p)]
        self.sensors = [
            _History(bearing.p[at_p], at_s, sensors=True)
            for at_p, at_s in parts_of(bearing.p)
            if bearing.p[at_p][P.SENSORS_SIZE] != 0.0
        ]
        self.depth = min(history.depth for history in (*self.histories, *self.sensors))
        self.rows = np.zeros((rows, sum(len(history.lanes) for history in self.histories)))
        self.sensed = np.zeros((rows, sum(len(history.lanes) for history in self.sensors)))
        self.count = 0
        self.time: list[float] = []
        self.speed: list[float] = []
        self.outputs: dict[str, list[float]] = {name: [] for name in outputs}

    def read(self) -> float:
        """Read the rows that are new since the last call; return the time (s) that all rows read are of."""
        self.time.append(self.bearing.time)
        self.speed.append(float(self.bearing.s[S.SPEED]))
        for name, values in self.outputs.items():
            values.append(self.bearing.get(name))
        self.rates(self.bearing)
        if self.watch is not None:
            self.watch(self.bearing)
        count = self.histories[0].count(self.bearing.s)
        if count - self.count > self.depth:
            raise RuntimeError(f"{count - self.count} rows came in one step, the engine keeps {self.depth}")
        new = np.arange(self.count, min(count, len(self.rows)))
        self.rows[new] = np.hstack([history.rows(self.bearing.s, new) for history in self.histories])
        if self.sensors:
            self.sensed[new] = np.hstack([history.rows(self.bearing.s, new) for history in self.sensors])
        self.count = count
        return min(count, len(self.rows)) / SD.RATE
