"""Picture of stiffness and damping over speed, a curve per preload."""

from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.results.picture_parts import empty, label, marked
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Title, freedom, unit and factor of stiffness and of damping.
_PANELS = (
    ("axial", "x", ("N/um", 1e-6), ("N s/m", 1.0)),
    ("radial", "y", ("N/um", 1e-6), ("N s/m", 1.0)),
    ("tilt", "bz", ("N m/mrad", 1e-3), ("mN m s/rad", 1e3)),
)


def picture(table: StiffnessTable, frequency: float | None = None) -> "Figure":
    """Draw K and C over speed; see `BearingStiffness.picture`."""
    wanted = table.frequencies[len(table.frequencies) // 2] if frequency is None else frequency
    at = int(np.abs(np.log(table.frequencies / wanted)).argmin())
    figure = empty((11.0, 6.2))
    panels = figure.subplots(2, len(_PANELS), sharex=True)
    krpm = 1e-3 * table.speeds
    dots = "o" if len(krpm) == 1 else ""
    for column, (title, freedom, stiff, damped) in enumerate(_PANELS):
        i = FREEDOMS.index(freedom)
        above, below = panels[:, column]
        for k, preload in enumerate(table.preloads):
            style = marked(k, dots)
            above.plot(krpm, stiff[1] * table.K[:, k, at, i, i], **style, label=f"{preload:g} N")
            above.plot(krpm, stiff[1] * table.static[:, k, i, i], color=style["color"], ls="--", lw=1.0)
            below.plot(krpm, damped[1] * table.C[:, k, at, i, i], **style)
        label(above, "", stiff[0], f"K {title}")
        label(below, "speed, 1000 r/min", damped[0], f"C {title}")
        for ax in (above, below):
            low, high = ax.get_ylim()
            ax.set_ylim(min(low, 0.0), max(high, 0.0))
    handles, labels = panels[0, 0].get_legend_handles_labels()
    dashed = panels[0, 0].plot([], [], color="0.4", ls="--", lw=1.0)[0]
    figure.legend(
        [*handles, dashed],
        [*labels, "frequency to 0"],
        loc="outside lower center",
        ncols=len(labels) + 1,
        frameon=False,
    )
    figure.suptitle(f"{table.scene.name}: the bearing at {table.frequencies[at]:.4g} Hz")
    return figure
