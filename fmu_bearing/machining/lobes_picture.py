"""Picture of milling lobes: the limit of the depth over speed with the scene's own cut, and its frequency."""

import math
from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.machining.lobes_result import LobesTable
from fmu_bearing.modal.receptance.receptance_picture import WHERE
from fmu_bearing.results.picture_parts import COLOURS, empty, label

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_ABOVE = 4.0  # of the least limit, or 1.3 of the depth: the picture ends there
_COLOUR = {"good": COLOURS["cage"], "watch": "#E69F00", "change": COLOURS["outer_ring"], "": "black"}


def picture(found: LobesTable) -> "Figure":
    """Draw the lobes; see `Lobes.picture`."""
    figure = empty((9.0, 6.2))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 1.0))
    krpm, depth = 1e-3 * found.speeds, 1e3 * found.depths
    top = _ABOVE * float(depth.min())
    if not math.isnan(found.depth):
        top = max(top, 1.3e3 * found.depth)
    shown = np.minimum(depth, 2.0 * top)
    above.fill_between(krpm, shown, 2.0 * top, color=COLOURS["outer_ring"], alpha=0.15, linewidth=0.0)
    above.plot(krpm, shown, color=COLOURS["inner_ring"], lw=1.3, label="limit")
    least = 1e3 * found.least.depth
    above.axhline(least, color="0.4", lw=0.9, ls=":", label=f"{least:.3g} mm: stable at all speeds")
    own = 1e-3 * found.own.speed
    above.axvline(own, color="0.4", lw=0.9, ls="--", label=f"{found.own.speed:,.0f} r/min: the scene's speed")
    if not math.isnan(found.depth):
        above.plot(
            [own], [1e3 * found.depth], "o", color=_COLOUR[found.judgement], ms=8,
            label=f"{1e3 * found.depth:.3g} mm: {found.judgement}",
        )  # fmt: skip
    above.set_ylim(0.0, top)
    above.set_xlim(krpm[0], krpm[-1])
    label(above, "", "axial depth, mm", "")
    above.legend(loc="upper left", fontsize=8)
    below.plot(krpm, [one.frequency for one in found.limits], ".", ms=2, color=COLOURS["inner_ring"])
    below.axvline(own, color="0.4", lw=0.9, ls="--")
    label(below, "speed, 1000 r/min", "chatters at, Hz", "")
    figure.suptitle(f"{found.scene.name}: milling at the {WHERE[found.place]}; shaded: chatter")
    return figure
