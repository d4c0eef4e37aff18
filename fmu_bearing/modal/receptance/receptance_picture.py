"""Picture of a receptance: magnitude and phase over frequency, by direction."""

from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.modal.receptance.receptance_table import ReceptanceTable
from fmu_bearing.results.picture_parts import empty, label, marked

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Words for the place.
WHERE = {"nose": "nose", "tip": "tip of the tool"}
#: Title, motion and force of each column, and the cross term that is drawn dashed.
_PANELS = (("axial", "x", ""), ("horizontal", "y", "z"), ("vertical", "z", "y"))
_ZERO = 1e-20  # m/N: less is none, as along the axis of a ring that is held


def picture(found: ReceptanceTable) -> "Figure":
    """Draw magnitude and phase; see `Receptance.picture`."""
    figure = empty((11.0, 6.4))
    panels = figure.subplots(2, len(_PANELS), sharex=True)
    hertz = found.frequencies
    dots = "o" if len(hertz) == 1 else ""
    points = [(i, k) for i in range(len(found.speeds)) for k in range(len(found.preloads))]
    for column, (title, along, aside) in enumerate(_PANELS):
        above, below = panels[:, column]
        one = FREEDOMS.index(along)
        for place, (i, k) in enumerate(points):
            style = marked(place, dots)
            direct = found.G[i, k, :, one, one]
            if np.abs(direct).max() < _ZERO:
                continue
            words = f"{found.speeds[i]:g} r/min, {found.preloads[k]:g} N"
            above.plot(hertz, 1e6 * np.abs(direct), **style, lw=1.2, label=words)
            below.plot(hertz, np.degrees(np.unwrap(np.angle(direct))), **style, lw=1.2)
            if aside:
                cross = found.G[i, k, :, FREEDOMS.index(aside), one]
                above.plot(hertz, 1e6 * np.abs(cross), color=style["color"], ls="--", lw=0.9)
        above.set_yscale("log")
        label(above, "", "receptance, um/N", title)
        label(below, "frequency, Hz", "phase, deg", "")
    handles, labels = panels[0, -1].get_legend_handles_labels()
    dashed = panels[0, -1].plot([], [], color="0.4", ls="--", lw=0.9)[0]
    figure.legend(
        [*handles, dashed], [*labels, "motion across the force"], loc="outside lower center",
        ncols=min(len(labels) + 1, 4), frameon=False,
    )  # fmt: skip
    figure.suptitle(f"{found.scene.name}: receptance at the {WHERE[found.place]}")
    return figure
