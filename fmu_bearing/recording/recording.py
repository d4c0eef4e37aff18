"""Recordings: channels of a run, kept in files, or pressures taken from the run of an FMU."""

import json
import math
import os
import re
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.cautions import largest_of
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import SD
from fmu_bearing.extras import need
from fmu_bearing.file_words import RECORDING, instead, trouble
from fmu_bearing.files import check_file, read_arrays, whole
from fmu_bearing.interface.names import chosen_names
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.microphone_places import Places
from fmu_bearing.recording.channels.recorded_signals import (
    RecordedSignal,
    even_step,
    recorded_signal,
    signal_names,
    why_uneven,
)
from fmu_bearing.recording.measurements import measure
from fmu_bearing.recording.measurements.signals import Signals
from fmu_bearing.recording.measurements.uff_files import write_signals
from fmu_bearing.results.defect_lines import defect_labels
from fmu_bearing.results.even_steps import spacing
from fmu_bearing.results.result import Run, read_table
from fmu_bearing.results.spectra import MICROPHONE, Spectrum
from fmu_bearing.results.table import html_table, number
from fmu_bearing.results.variable_names import unit_of
from fmu_bearing.scene import Scene, SceneError, SceneSource, read_scene_text, scene_of, si

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

_PRESSURE = re.compile(r"mic\[\d+\]\.pressure")
_ENOUGH = 40_000.0  # Hz: pressures reach to 20 kHz
_VERSION = 3  # 1 had other names, 2 another decimator


class Recording(ChannelHistory):
    """Channels of a run, and pressures and levels at any place; can be saved and loaded.

    Made by ``fmu_bearing.record``, from a file (`load`) or from an FMU's run (`from_fmu`).

    Examples
    --------
    >>> from fmu_bearing import Bearing, Recording, record
    >>> bearing = Bearing("examples/scenes/7003C-bare.toml", fidelity="rings")
    >>> record(bearing.scene, 0.02, radiation_model="compact").save("run.npz")
    >>> recording = Recording.load("run.npz")
    >>> recording.pressure([(0.0, 0.2, 0.0)]).shape  # Pa, anywhere (m)
    (1, 1024)
    """

    #: Communication step (s) at which an FMU gives every pressure sample once. It is slightly longer than a
    #: sample, so that rounding of times never repeats one sample and skips the next.
    PRESSURE_STEP = (1.0 + 1e-9) / SD.RATE

    @classmethod
    def from_fmu(
        cls,
        result: NDArray[Any] | str | os.PathLike[str],
        scene: SceneSource | None = None,
        settle: float = 0.02,
    ) -> "Recording":
        """Take the pressures of an FMU run.

        Parameters
        ----------
        result : structured array or path
            What ``fmpy.simulate_fmu`` returns, with ``mic[1].pressure`` and so on among its outputs, or a CSV
            file of it. Run with ``output_interval=Recording.PRESSURE_STEP``, so that every sample is there
            once.
        scene : Scene or path, optional
            The scene the FMU was built from: places of microphones, kinematic frequencies.
        settle : float
            Time (s) left out at the beginning.

        Raises
        ------
        ValueError
            Without pressures, for unevenly spaced times, or when nothing is left after ``settle``.
        """
        table: Any = result if isinstance(result, np.ndarray) else read_table(result)
        scene = None if scene is None else scene_of(scene)
        names = table.dtype.names or ()
        pressures = [name for name in names if _PRESSURE.fullmatch(name)]
        if "time" not in names or not pressures:
            where = "" if isinstance(result, np.ndarray) else f"{os.fspath(result)}: "
            raise ValueError(
                f"{where}the result must hold time and mic[1].pressure; ask for them as outputs of the run"
            )
        time = np.asarray(table["time"], dtype=float)
        found = spacing(time)
        if not found.even:
            raise ValueError(f"times are {found.words('s')}: pressures must be evenly spaced")
        rate = 1.0 / found.step
        if abs(rate / SD.RATE - 1.0) < 1e-6:
            rate = SD.RATE
        if rate < _ENOUGH:
            warnings.warn(
                f"pressures at {rate:g} Hz alias all above {rate / 2:g} Hz: run with "
                "output_interval=Recording.PRESSURE_STEP",
                stacklevel=2,
            )
        first = int(np.searchsorted(time, time[0] + settle - 1e-9))
        if first >= len(time):
            raise ValueError(
                f"settle = {settle} s leaves nothing of the {time[-1] - time[0]:g} s run: give less"
            )
        known = (
            {} if scene is None else {f"mic[{k + 1}].pressure": m for k, m in enumerate(scene.microphones)}
        )
        places = [known.get(name, (name, (math.nan,) * 3)) for name in pressures]
        speed = table["shaft_speed"] if "shaft_speed" in names else _speed_of(scene, len(time))
        others = [name for name in names if name not in ("time", *pressures)]
        return cls(
            scene, "recorded", rate, float(time[first]) - SD.LATENCY / SD.RATE, len(time) - first,
            time - time[0],
            np.asarray(speed, dtype=float),
            {name: np.asarray(table[name], dtype=np.float64) for name in others},
            recorded=np.array([table[name][first:] for name in pressures], dtype=float),
            microphones=tuple((str(name), place) for name, place in places),
        )  # fmt: skip

    @classmethod
    def from_run(
        cls, result: Run | str | os.PathLike[str], scene: SceneSource | None = None, settle: float = 0.0,
        speed: float | None = None,
    ) -> "Recording":  # fmt: skip
        """Take the variables of a run, or of its file, or of a measured record, as signals; see `signal`.

        Parameters
        ----------
        result : Run or path
        scene : Scene or path, optional
            Default: the one that the result knows.
        settle : float
            Time (s) left out at the beginning.
        speed : float, optional
            Of the shaft (rad/s), of a result that does not hold it as ``shaft_speed``; default: the scene's.

        Raises
        ------
        ResultError
            For a file that is no result.
        ValueError
            For a speed of a result that holds it.
            For times that rounding does not explain (3 % of a step), and where too little is left after
            ``settle``.
        """
        run = result if isinstance(result, Run) else Run.load(result)
        known = run.scene if scene is None else scene_of(scene)
        time, start = run.time, float(run.time[0]) + settle
        after = time[time >= start - 1e-9]
        step = even_step(after)
        if not step:
            raise ValueError(f"{run.name}: the times after settle = {settle:g} s are {why_uneven(after)}")
        if "shaft_speed" in run.names:
            if speed is not None:
                raise ValueError(
                    f"{run.name}: a speed ({speed / RPM:g} r/min) is refused: it has a column shaft_speed"
                )
            speeds = run["shaft_speed"]
        else:
            speeds = _speed_of(known, len(time)) if speed is None else np.full(len(time), float(speed))
        columns = {name: run[name] for name in run.names}
        return cls(
            known, "recorded", 1.0 / step, float(after[0]), len(after), time, speeds, columns,
            units=dict(run.units),
        )  # fmt: skip

    def _repr_html_(self) -> str:
        """Return microphones and means of the variables; levels are left out, as they take time."""
        places = [
            [name, f"{1e3 * x:g}, {1e3 * y:g}, {1e3 * z:g}", "mm"] for name, (x, y, z) in self.microphones
        ]
        means = [[name, number(float(np.mean(v))), self._unit(name)] for name, v in self.within().items()]
        return html_table(repr(self), ["microphone", "place", ""], places) + html_table(
            "means", ["variable", "mean", "unit"], means
        )

    @property
    def doubts(self) -> dict[str, float]:
        """Largest values since initialisation of what puts levels in doubt, as far as they are known.

        ``solver.restarts`` and ``solver.growth`` (1/s): fidelities rings and response restart where no step
        is possible, and by their linear equations rings may whirl.
        """
        return largest_of(self.outputs, self.outputs.__getitem__)

    def within(self) -> dict[str, NDArray[np.float64]]:
        """Speed and variables at the communication points of the recording, its start left out."""
        speed, outputs = self._kept()
        return {"shaft_speed": speed} | outputs

    def _unit(self, name: str) -> str:
        """Return the unit of a variable."""
        return self.units.get(name) or unit_of(name)

    @property
    def signal_names(self) -> list[str]:
        """Names of all signals: microphones, accelerations of rings and cage, variables at even points."""
        return signal_names(self)

    def signal(self, name: str, radiation_model: str | None = None) -> RecordedSignal:
        """Return one signal at even spacing, without latency.

        Parameters
        ----------
        name : str
            A microphone (Pa); an acceleration of the centre of a body in m/s2, up to 20 kHz, as
            ``outer_ring.acceleration.z`` or ``bearing[2].inner_ring.acceleration.x``; or a variable that was
            kept, at the rate of its points, above half of which it is folded.
        radiation_model : str, optional
            In place of the recording's own.

        Raises
        ------
        UnknownName
            For another name. A recording of pressures, and one with a radiation model of a paper, has no
            accelerations.

        Examples
        --------
        >>> from fmu_bearing import record, with_fidelity
        >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
        >>> signal = record(scene, 0.02, radiation_model="compact").signal("outer_ring.acceleration.z")
        >>> signal.values.shape, signal.unit, signal.rate
        ((1024,), 'm/s2', 51200.0)
        """
        return recorded_signal(self, name, radiation_model)

    def signals_like(self, patterns: Sequence[str]) -> list[str]:
        """Return the names of the signals that match any of some names, with ``*`` for any text.

        Raises
        ------
        UnknownName
            For one that matches nothing.
        """
        return chosen_names(patterns, signal_names(self), ())

    def spectrum(
        self, positions: Places = None, radiation_model: str | None = None, resolution: float | None = None
    ) -> Spectrum:
        """Return levels (dB re 20 uPa) over frequency at places.

        Parameters
        ----------
        positions, radiation_model
            As for `pressure`.
        resolution : float, optional
            Spacing of the bins (Hz); default: 5, or what a shorter recording allows.

        Raises
        ------
        ValueError
            As `pressure`; for a recording too short for the resolution.

        Examples
        --------
        >>> from fmu_bearing import record, with_fidelity
        >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
        >>> recording = record(scene, 0.05, radiation_model="compact")
        >>> spectrum = recording.spectrum(["P1", "P4"])
        >>> spectrum.names, spectrum.units, float(spectrum.frequency[1])
        (('P1', 'P4'), ('dB', 'dB'), 20.0)
        """
        names = tuple(name for name, _ in self.named(positions))
        total = {"total": self.pressure(positions, radiation_model)}
        signals = Signals(self, positions, radiation_model, total)
        frequency, levels = signals.spectra(resolution or measure.fine(self))
        units = ("dB",) * len(names)
        return Spectrum(names, frequency, levels["total"], units, MICROPHONE, self.excitation_end)

    def plot(
        self, positions: Places = None, radiation_model: str | None = None, resolution: float | None = None,
        highest: float = 20_000.0, title: str = "",
    ) -> "Figure":  # fmt: skip
        """Draw `spectrum` up to ``highest`` (Hz), kinematic frequencies marked where the bearing is known.

        The strongest lines at the first microphone are named.

        Raises
        ------
        MissingExtra
            Without Matplotlib.
        """
        from fmu_bearing.recording.measurements.measure import strongest
        from fmu_bearing.recording.measurements.pictures import spectrum_picture

        need("matplotlib", "a picture")  # refused before the sound is computed
        spectrum = self.spectrum(positions, radiation_model, resolution)
        shown = spectrum.frequency <= highest
        kinematics = self.common_kinematics
        levels = {name: spectrum[name][shown] for name in spectrum}
        first = next(iter(levels.values()))
        lines = [] if self.scene is None else strongest(self, spectrum.frequency[shown], first)
        return spectrum_picture(
            spectrum.frequency[shown],
            levels,
            kinematics,
            title,
            self.excitation_end,
            lines,
            self.defect_lines(),
        )

    def to_xarray(self, positions: Places = None, radiation_model: str | None = None) -> "xarray.Dataset":
        """Return pressures (Pa) over microphones and time, and the variables over ``output_time``.

        Accelerations (m/s2) over accelerometers and time, too, where the scene has any. Names and places (m)
        of microphones are coordinates; units are attributes, the scene is TOML text in ``scene``, the table
        of its local defects JSON text in ``defects``.

        Raises
        ------
        MissingExtra
            Without xarray.
        """
        xr = need("xarray", "a dataset")
        named = self.named(positions) if positions is not None or self.microphones else []
        data: dict[str, Any] = {
            name: ("output_time", values, {"units": self._unit(name)})
            for name, values in ({"shaft_speed": self.speed_points} | self.outputs).items()
        }
        coords: dict[str, Any] = {"output_time": ("output_time", self.output_time, {"units": "s"})}
        if named:
            pressure = self.pressure(positions, radiation_model)
            data["pressure"] = (("microphone", "time"), pressure, {"units": "Pa"})
            coords["microphone"] = [name for name, _ in named]
            for axis, values in zip("xyz", np.array([place for _, place in named]).T, strict=True):
                coords[axis] = ("microphone", values, {"units": "m"})
        if self.accelerometers:
            data["acceleration"] = (("accelerometer", "time"), self.acceleration(), {"units": "m/s2"})
            coords["accelerometer"] = list(self.accelerometers)
        if named or self.accelerometers:
            coords["time"] = ("time", self.time, {"units": "s", "long_name": "time after initialisation"})
        head = {
            "scene": "" if self.scene is None else self.scene.to_toml(),
            "radiation_model": radiation_model or self.radiation_model,
            "rate_Hz": self.rate,
            **defect_labels(self.scene),
        }
        return xr.Dataset(data, coords, head)

    def to_pandas(self, positions: Places = None, radiation_model: str | None = None) -> "pandas.DataFrame":
        """Return pressures (Pa) over time (s after initialisation), a column per microphone.

        Units by column are in ``attrs["units"]``.

        Raises
        ------
        MissingExtra
            Without pandas.
        """
        pd = need("pandas", "a data frame")
        names = [name for name, _ in self.named(positions)]
        index = pd.Index(self.time, name="time, s")
        frame: pandas.DataFrame = pd.DataFrame(self.pressure(positions, radiation_model).T, index, names)
        frame.columns.name = "microphone"
        frame.attrs["units"] = dict.fromkeys(names, "Pa")
        return frame

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to one ``.npz`` file; to ``.uff`` microphones and accelerations over time.

        A universal file is read by programs of modal analysis, and not by `load`. Errors are those of
        `check_file`; other endings are refused.
        """
        target = check_file(path, (".npz", ".uff"), "a recording")
        if target.suffix == ".uff":
            write_signals(self, target)
            return
        head = {
            "version": _VERSION,
            "scene": None if self.scene is None else self.scene.to_toml(),
            "radiation_model": self.radiation_model,
            "rate": self.rate,
            "start": self.start,
            "size": self.size,
            "microphones": self.microphones,
            "harmonics": self.harmonics,
            "units": self.units,
        }
        arrays: dict[str, Any] = {f"output:{name}": values for name, values in self.outputs.items()}
        with whole(target) as file:
            np.savez(
                file, head=np.array(json.dumps(head)), output_time=self.output_time,
                speed_points=self.speed_points, history=self.history, recorded=self.recorded,
                sensed=self.sensed, **arrays,
            )  # fmt: skip

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "Recording":
        """Read a recording that `save` wrote.

        Raises
        ------
        ValueError
            When there is no such file, or it is not a recording.
        """
        try:
            data = read_arrays(path)
            head = json.loads(str(data["head"]))
            if head["version"] != _VERSION:
                raise KeyError("version")
            scene = head["scene"]
            return cls(
                None if scene is None else read_scene_text(scene, str(path)),
                head["radiation_model"], head["rate"], head["start"], head["size"], data["output_time"],
                data["speed_points"],
                {name[7:]: values for name, values in data.items() if name.startswith("output:")},
                data["history"], data["recorded"],
                tuple((name, tuple(place)) for name, place in head["microphones"]), head["harmonics"],
                data.get("sensed", np.zeros((0, 0))), head.get("units", {}),
            )  # fmt: skip
        except SceneError:
            raise
        except OSError as problem:
            raise ValueError(f"{path}: {trouble(path, RECORDING, problem)}") from None
        except Exception:  # of damaged files; they raise what NumPy and JSON come upon
            mistaken = instead(path, RECORDING)
            raise ValueError(
                f"{path}: {mistaken or 'is not a recording that this version has written, or damaged'}"
            ) from None


def _speed_of(scene: Scene | None, count: int) -> NDArray[np.float64]:
    """Return the scene's speed (rad/s), NaN without scene."""
    return np.full(count, math.nan if scene is None else si(scene.operation).speed)
