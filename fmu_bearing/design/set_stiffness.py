"""Static stiffness of a set's shaft at its nose over speed and preload; its table and picture."""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.files import check_file
from fmu_bearing.modal.stiffness.impedance import FREEDOMS
from fmu_bearing.modal.stiffness.stiffness_files import unit
from fmu_bearing.results.picture_parts import OTHERS, empty, label
from fmu_bearing.results.table import write_csv
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.member import set_of, still_of
from fmu_bearing.spindle.statics import ShaftStatics, shaft_statics
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Named stiffness: words, attribute of `ShaftStatics`, unit and factor of a picture.
NAMED = (
    ("axial", "axial_stiffness", "N/um", 1e-6),
    ("radial", "radial_stiffness", "N/um", 1e-6),
    ("tilt", "tilt_stiffness", "N m/mrad", 1e-3),
    ("nose", "nose_stiffness", "N/um", 1e-6),
    ("nose, shaft bends", "nose_stiffness_bending", "N/um", 1e-6),
)
_PANELS = 4  # the first of them


@dataclass(frozen=True)
class SetStiffness:
    """Stiffness of a set's shaft at its nose over speed and preload, under the scene's load.

    Attributes
    ----------
    scene : Scene
    speeds : ndarray
        r/min.
    preloads : ndarray
        N: of spacers, or the force of springs; 0 alone for a set without preload.
    points : tuple of tuple of ShaftStatics
        By speed, then by preload.
    """

    scene: Scene
    speeds: NDArray[np.float64]
    preloads: NDArray[np.float64]
    points: tuple[tuple[ShaftStatics, ...], ...]

    @property
    def static(self) -> NDArray[np.float64]:
        """Matrix at the nose, the rest of the shaft free, SI units, shape (speeds, preloads, 5, 5)."""
        return np.array([[one.stiffness for one in row] for row in self.points])

    def named(self, attribute: str) -> NDArray[np.float64]:
        """Return one of `NAMED` by its attribute, SI units, shape (speeds, preloads)."""
        return np.array([[getattr(one, attribute) for one in row] for row in self.points])

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the table as CSV and return its file.

        Raises
        ------
        ValueError
            For another ending than ``.csv``.
        OSError
            Where it cannot be written.
        """
        target = check_set_table(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        entries = [(force, motion) for force in FREEDOMS for motion in FREEDOMS]
        columns = ["speed_rpm", "preload_N"]
        columns += [f"K_{force}_{motion} [{unit(force, motion)}]" for force, motion in entries]
        columns += ["K_nose [N/m]", "K_nose_bending [N/m]"]
        write_csv(target, columns, list(self._rows()))
        return target

    def _rows(self) -> Iterator[list[str]]:
        for speed, row in zip(self.speeds, self.points, strict=True):
            for preload, one in zip(self.preloads, row, strict=True):
                noses = one.nose_stiffness, one.nose_stiffness_bending
                numbers = [speed, preload, *one.stiffness.ravel(), *noses]
                yield [repr(float(number)) for number in numbers]

    def picture(self) -> "Figure":
        """Draw stiffness over speed, a curve per preload; dashed: with a shaft that bends."""
        figure = empty((9.0, 6.2))
        panels = figure.subplots(2, _PANELS // 2, sharex=True).ravel()
        krpm = 1e-3 * self.speeds
        dots = "o" if len(krpm) == 1 else None
        for ax, (words, attribute, shown, factor) in zip(panels, NAMED[:_PANELS], strict=True):
            for k, preload in enumerate(self.preloads):
                colour = OTHERS[k % len(OTHERS)]
                curve = factor * self.named(attribute)[:, k]
                ax.plot(krpm, curve, color=colour, marker=dots, label=f"{preload:g} N")
                if attribute == "nose_stiffness":
                    bent = factor * self.named("nose_stiffness_bending")[:, k]
                    ax.plot(krpm, bent, color=colour, marker=dots, ls="--", lw=1.0)
            label(ax, "speed, 1000 r/min" if ax in panels[-2:] else "", shown, f"K {words}")
            ax.set_ylim(0.0, None)
        handles, labels = panels[0].get_legend_handles_labels()
        dashed = panels[0].plot([], [], color="0.4", ls="--", lw=1.0)[0]
        figure.legend(
            [*handles, dashed], [*labels, "shaft bends"], loc="outside lower center",
            ncols=len(labels) + 1, frameon=False,
        )  # fmt: skip
        figure.suptitle(f"{self.scene.name}: the shaft at its nose")
        return figure

    def cautions(self) -> list[str]:
        """Return what a designer should look at, each line once."""
        told = (line for row in self.points for one in row for line in one.cautions())
        return list(dict.fromkeys(told))

    def summary(self) -> dict[str, Any]:
        """Return all numbers by name, SI units, for machines."""
        named = {attribute: self.named(attribute) for _, attribute, _, _ in NAMED}
        return {
            "scene": self.scene.name, "speeds_rpm": self.speeds, "preloads_N": self.preloads,
            "static": self.static, **named, "cautions": self.cautions(),
        }  # fmt: skip


@one_thread
def set_stiffness(
    scene: SceneSource, speeds: Sequence[float] | None = None, preloads: Sequence[float] | None = None,
    track: Callable[[Iterable[float]], Iterable[float]] = iter,
) -> SetStiffness:  # fmt: skip
    """Return the static stiffness of a set's shaft at its nose under the scene's load.

    Parameters
    ----------
    scene : Scene or path
        With a set.
    speeds : sequence of float, optional
        r/min; default: the scene's.
    preloads : sequence of float, optional
        N: of spacers or springs; default: the scene's.
    track : callable
        Wraps the speeds, to tell progress.

    Raises
    ------
    SceneError
        If the scene has no set, or a value is refused.
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    ValueError
        For preloads of a set without one.

    Examples
    --------
    >>> from fmu_bearing import set_stiffness
    >>> found = set_stiffness("examples/spindle_set/7003C-DB.toml", [0.0, 15e3], [100.0, 200.0])
    >>> (1e-6 * found.named("axial_stiffness")).round(1).tolist()
    [[37.7, 57.1], [36.6, 57.0]]
    """
    scene = scene_of(scene)
    preload = set_of(scene).preload
    rpm = [scene.operation.speed_rpm] if speeds is None else [float(speed) for speed in speeds]
    key, own = None, 0.0
    if preload is not None:
        key = "force_N" if preload.kind == "spring" else "preload_N"
        own = getattr(preload, key)
    elif preloads is not None:
        raise ValueError(f"{scene.name}: has no [spindle.preload] that could be changed: leave preloads out")
    forces = [own] if preloads is None else [float(force) for force in preloads]
    points, still = [], still_of(scene)
    for speed in track(rpm):
        row = []
        for force in forces:
            changed: dict[str, Any] = {"operation.speed_rpm": speed}
            if key is not None:
                changed[f"spindle.preload.{key}"] = force
            row.append(shaft_statics(still.replace(changed)))
        points.append(tuple(row))
    return SetStiffness(scene, np.array(rpm), np.array(forces), tuple(points))


def check_set_table(path: str | os.PathLike[str]) -> Path:
    """Return the path of a table that is going to be written; called before the computation.

    Raises
    ------
    ValueError
        For another ending than ``.csv``.
    OSError
        Where it cannot be written.
    """
    target = check_file(path)
    if target.suffix != ".csv":
        raise ValueError(f"{target}: the stiffness of a set is written as .csv")
    return target
