"""Picture of milling lobes: the limit of the depth over speed with the scene's own cut, and its frequency."""

import math
from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.machining.lobes_result import LobesTable
from fmu_bearing.modal.receptance.receptance_picture import WHERE
from fmu_bearing.results.picture_parts import COLOURS, empty, label

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_BEYOND = 1.5  # of the largest limit, and below the least by this: the picture ends there
_MOST = 1e3  # of the least limit: a depth that no tool has
_COLOUR = {"good": COLOURS["cage"], "watch": "#E69F00", "change": COLOURS["outer_ring"], "": "black"}


def _ends(found: LobesTable) -> tuple[float, float]:
    """Return the ends of the axis of depths, mm."""
    depths = np.append(found.depths, found.depth)
    shown = 1e3 * depths[np.isfinite(depths)]
    if not len(shown):
        return 0.1, 10.0  # nothing to show, as no speed has a limit
    low, high = float(shown.min()), float(shown.max())
    return low / _BEYOND, _BEYOND * min(high, _MOST * low)


def picture(found: LobesTable) -> "Figure":
    """Draw the lobes; see `Lobes.picture`."""
    figure = empty((9.0, 6.2))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 1.0))
    krpm, depth = 1e-3 * found.speeds, 1e3 * found.depths
    bottom, top = _ends(found)
    shown = np.minimum(depth, 2.0 * top)
    above.fill_between(krpm, shown, 2.0 * top, color=COLOURS["outer_ring"], alpha=0.15, linewidth=0.0)
    above.plot(krpm, shown, color=COLOURS["inner_ring"], lw=1.3, label="limit")
    least = 1e3 * found.least.depth
    if math.isfinite(least):
        above.axhline(least, color="0.4", lw=0.9, ls=":", label=f"{least:.3g} mm: stable at all speeds")
    own = 1e-3 * found.own.speed
    above.axvline(own, color="0.4", lw=0.9, ls="--", label=f"{found.own.speed:,.0f} r/min: the scene's speed")
    if not math.isnan(found.depth):
        above.plot(
            [own], [1e3 * found.depth], "o", color=_COLOUR[found.judgement], ms=8,
            label=f"{1e3 * found.depth:.3g} mm: {found.judgement}",
        )  # fmt: skip
    above.set_yscale("log")  # lobes of high speed are ten times as high as those of low speed, and more
    above.set_ylim(bottom, top)
    above.yaxis.set_major_formatter("{x:g}")
    above.set_xlim(krpm[0], krpm[-1])
    label(above, "", "axial depth, mm", "")
    above.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4, fontsize=8, frameon=False)
    below.plot(krpm, [one.frequency for one in found.limits], ".", ms=2, color=COLOURS["inner_ring"])
    below.axvline(own, color="0.4", lw=0.9, ls="--")
    label(below, "speed, 1000 r/min", "chatters at, Hz", "")
    figure.suptitle(f"{found.scene.name}: milling at the {WHERE[found.place]}; shaded: chatter")
    return figure
