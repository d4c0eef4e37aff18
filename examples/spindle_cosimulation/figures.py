"""Figures of the spindle co-simulation, drawn without a display."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, level_spectrum
from fmu_bearing.extras import need
from fmu_bearing.results.levels import present
from fmu_bearing.results.picture_parts import empty

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RPM = 30.0 / np.pi
STYLE = {
    "font.size": 9,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "axes.spines.top": False,
    "lines.linewidth": 1.2,
}
LUMPS = ("inner_ring", "outer_ring", "balls", "oil", "housing")


def overview(
    path: Path,
    run: NDArray[np.void],
    labels: dict[str, str],
    sound: NDArray[np.void] | None,
    sample_rate: float,
    marks: KinematicFrequencies | None,
) -> None:
    """Speed and torque, temperatures, levels over time, and the spectrum, in one picture.

    Parameters
    ----------
    path : Path
        PNG to write.
    run : structured array
        The co-simulation, one row per communication step.
    labels : dict of str to str
        Microphone prefix (``mic[1]``) to what the legend says.
    sound : structured array or None
        Pressures in Pa at ``sample_rate`` Hz; None leaves the spectrum out.
    sample_rate : float
    marks : KinematicFrequencies or None
    """
    with need("matplotlib", "a picture").rc_context(STYLE):
        figure = empty((10.0, 6.4))
        axes = figure.subplots(2, 2)
        _speed_and_torque(axes[0, 0], run)
        _temperatures(axes[0, 1], run)
        _levels(axes[1, 0], run, labels)
        _spectrum(axes[1, 1], sound, sample_rate, labels, marks)
        _save(figure, path)


def effects(
    path: Path, studies: dict[str, tuple[str, float, NDArray[np.void]]], labels: dict[str, str]
) -> None:
    """Contact angles, friction torque with film, and levels over each varied parameter.

    ``studies`` maps the parameter's name to its axis label, the factor from SI to that label's unit, and
    the rows of `studies.vary`.
    """
    with need("matplotlib", "a picture").rc_context(STYLE):
        figure = empty((4.6 * len(studies), 7.2))
        axes = figure.subplots(3, len(studies), squeeze=False, sharex="col")
        for column, (parameter, (label, factor, rows)) in zip(axes.T, studies.items(), strict=True):
            x = rows[parameter] * factor
            for race in ("inner", "outer"):
                name = f"contact.{race}.angle_mean"
                if name in rows.dtype.names:
                    column[0].plot(x, np.degrees(rows[name]), "o-", label=f"{race} race")
            column[0].set_ylabel("contact angle [deg]")
            column[1].plot(x, 1e3 * rows["friction_torque"], "o-", color="C3", label="friction torque")
            column[1].set_ylabel("friction torque [N.mm]")
            shared = [column[1]]
            if "film.lambda_min" in rows.dtype.names:
                film = _twin(column[1])
                shared.append(film)
                film.plot(x, rows["film.lambda_min"], "s--", color="C4", label="film parameter")
                film.set_ylabel("smallest lambda [-]")
            for prefix, text in labels.items():
                column[2].plot(x, rows[f"{prefix}.leq"], "o-", label=text)
            column[2].set_ylabel("Leq [dB re 20 uPa]")
            column[2].set_xlabel(label)
            _legend(column[0])
            _legend(*shared)
            _legend(column[2])
        _save(figure, path)


def _speed_and_torque(axis: "Axes", run: NDArray[np.void]) -> None:
    time = run["time"]
    axis.plot(time, RPM * run["shaft_speed"], color="C0", label="speed")
    axis.set_ylabel("shaft speed [r/min]")
    axis.set_xlabel("time [s]")
    torque = _twin(axis)
    # the motor's own, mostly for the rotor's acceleration, would press this one flat
    friction = 1e3 * run["friction_torque"]
    torque.plot(time, friction, color="C3", alpha=0.25, linewidth=0.6)
    torque.plot(time, _moving_mean(time, friction), color="C3", label="friction torque, 10 ms mean")
    torque.set_ylabel("friction torque [N.mm]")
    _legend(axis, torque)


def _temperatures(axis: "Axes", run: NDArray[np.void]) -> None:
    for lump in LUMPS:
        axis.plot(run["time"], run[f"{lump}_temperature"] - 273.15, label=lump.replace("_", " "))
    axis.set_ylabel("temperature [degC]")
    axis.set_xlabel("time [s]")
    _legend(axis)


def _levels(axis: "Axes", run: NDArray[np.void], labels: dict[str, str]) -> None:
    # The first tenth of a second shows the meters filling, not the bearing.
    shown = run[run["time"] >= min(0.1, 0.2 * run["time"][-1])]
    for prefix, text in labels.items():
        axis.plot(shown["time"], present(shown[f"{prefix}.spl"], "dB"), label=text)
    axis.set_ylabel("sound pressure level, Fast [dB]")
    axis.set_xlabel("time [s]")
    _legend(axis)


def _spectrum(
    axis: "Axes",
    sound: NDArray[np.void] | None,
    sample_rate: float,
    labels: dict[str, str],
    marks: KinematicFrequencies | None,
) -> None:
    axis.set_xlabel("frequency [Hz]")
    axis.set_ylabel("level of a line [dB re 20 uPa]")
    if sound is None or len(sound) < 8 or not labels:
        axis.text(0.5, 0.5, "not computed", ha="center", transform=axis.transAxes)
        return
    prefix, text = next(iter(labels.items()))
    frequency, level = level_spectrum(sound[f"{prefix}.pressure"], sample_rate)
    reach = (frequency > 0.0) & (frequency <= 5000.0)
    axis.plot(frequency[reach], level[reach], color="C0", linewidth=0.8, label=text)
    top = level[reach].max()
    axis.set_ylim(top - 80.0, top + 12.0)
    if marks is not None:
        for i, (name, value) in enumerate(sorted(marks._asdict().items(), key=lambda mark: mark[1])):
            axis.axvline(value, color="C3", linewidth=0.8, linestyle=":")
            # two heights, for f_c and f_r are close together
            axis.text(value, top + (3.0, 8.0)[i % 2], f"${name}$", ha="center", color="C3")
    _legend(axis)


def _moving_mean(time: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mean over 10 ms around each point, over less at the ends."""
    size = max(1, round(0.01 / (time[1] - time[0]))) if len(time) > 1 else 1
    window = np.ones(min(size, len(values)))
    return np.convolve(values, window, "same") / np.convolve(np.ones(len(values)), window, "same")


def _twin(axis: "Axes") -> "Axes":
    twin = axis.twinx()
    twin.spines["right"].set_visible(True)
    twin.grid(False)
    return twin


def _legend(*axes: "Axes") -> None:
    found = [pair for axis in axes for pair in zip(*axis.get_legend_handles_labels(), strict=True)]
    if found:
        handles, labels = zip(*found, strict=True)
        # above the plot, where it covers no curve
        place = {
            "loc": "lower center",
            "bbox_to_anchor": (0.5, 1.0),
            "ncols": 3 if len(found) in (3, 5) else 2,
        }
        axes[0].legend(handles, labels, fontsize=8, frameon=False, **place)


def _save(figure: "Figure", path: Path) -> None:
    figure.savefig(path, dpi=130, metadata={"Software": None})
