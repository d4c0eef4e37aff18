"""Static stiffness of a set's shaft at its nose over speed and preload; its table and picture."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from operator import methodcaller
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.files import check_file
from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.picture_parts import empty, label, marked
from fmu_bearing.results.table import write_csv
from fmu_bearing.scene import Scene
from fmu_bearing.steady.statics import Statics
from fmu_bearing.steady.stiffness.stiffness_files import unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Named stiffness: words, attribute of `Statics`, unit and factor of a picture.
NAMED = (
    ("axial", "axial_stiffness", "N/um", 1e-6),
    ("radial", "radial_stiffness", "N/um", 1e-6),
    ("tilt", "tilt_stiffness", "N m/mrad", 1e-3),
    ("nose", "nose_stiffness", "N/um", 1e-6),
    ("nose, shaft bends", "nose_stiffness_bending", "N/um", 1e-6),
)
_PANELS = 4  # the first of them


@dataclass(frozen=True)
class NoseStiffness(Result):
    """Stiffness of a set's shaft at its nose over speed and preload, under the scene's load."""

    quantities = (
        "static [N/m, N, N m/rad]",
        *(
            Quantity(
                f"{key} [{'N m/rad' if key == 'tilt_stiffness' else 'N/m'}]", of=methodcaller("named", key)
            )
            for _, key, _, _ in NAMED
        ),
    )

    scene: Scene
    speeds: NDArray[np.float64]
    """r/min."""
    preloads: NDArray[np.float64]
    """N: of spacers, or the force of springs; 0 alone for a set without preload."""
    points: tuple[tuple[Statics, ...], ...]
    """By speed, then by preload."""

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
        target = check_file(path, ".csv", "the stiffness of a shaft at its nose")
        entries = [(force, motion) for force in FREEDOMS for motion in FREEDOMS]
        columns = ["speed_rpm", "preload_N"]
        columns += [f"K_{force}_{motion} [{unit(force, motion)}]" for force, motion in entries]
        columns += ["K_nose [N/m]", "K_nose_bending [N/m]"]
        return write_csv(target, columns, list(self._rows()))

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
        dots = "o" if len(krpm) == 1 else ""
        for ax, (words, attribute, shown, factor) in zip(panels, NAMED[:_PANELS], strict=True):
            for k, preload in enumerate(self.preloads):
                style = marked(k, dots)
                curve = factor * self.named(attribute)[:, k]
                ax.plot(krpm, curve, **style, label=f"{preload:g} N")
                if attribute == "nose_stiffness":
                    bent = factor * self.named("nose_stiffness_bending")[:, k]
                    ax.plot(krpm, bent, **style, ls="--", lw=1.0)
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
        lines = (line for row in self.points for one in row for line in one.cautions())
        return list(dict.fromkeys(lines))
