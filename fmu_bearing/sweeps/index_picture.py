"""Picture of a study of sensitivity: per figure the indices of each key as bars, with their confidence."""

import math
from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.results.picture_parts import OTHERS, empty, label
from fmu_bearing.sweeps.global_sensitivity import COLUMNS, GlobalSensitivity
from fmu_bearing.sweeps.sampling import INDICES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST = 12  # panels: more have no room for the names of the keys
_THICK = 0.38  # of a bar, where two share the room of one key


def index_picture(study: GlobalSensitivity) -> "Figure":
    """Return bars of the two indices of each key, a panel per figure that changes, `MOST` at most.

    Raises
    ------
    MissingExtra
        Without Matplotlib (extra ``plots``).
    """
    method = study.layout.method
    names = INDICES[method]
    heads = COLUMNS[method][3:]
    second = 3 if method == "morris" else 2  # sigma, or first order
    places = [k for k in range(len(study.figures)) if np.nan_to_num(study.indices[names[0]][k]).any()]
    shown = places[:MOST]
    columns = min(len(shown), 3 if len(shown) > 4 else 2) or 1
    rows = -(-len(shown) // columns) or 1
    height = 0.9 + 0.42 * len(study.keys)
    figure = empty((min(5.2 * columns + 1.0, 16.0), max(3.0, (height + 0.6) * rows + 0.6)))
    more = f", the first {MOST} of {len(places)} figures" if len(places) > MOST else ""
    figure.suptitle(f"{study.layout.plan.scene.name}: {method}, {study.layout.samples} samples{more}")
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for ax in panels[max(len(shown), 1) :]:
        ax.set_visible(False)
    if not shown:
        panels[0].text(0.5, 0.5, "no figure changes", ha="center", va="center")
    for ax, place in zip(panels, shown, strict=False):
        one = study.figures[place]
        order = [study.keys.index(key) for key, _ in reversed(study.ranked(one.name))]
        at = np.arange(len(order), dtype=float)
        for shift, index, colour in ((0.5, 0, OTHERS[0]), (-0.5, second, OTHERS[4])):
            half = study.indices[names[1 if index == 0 else 3]][place, order]
            ax.barh(
                at + shift * _THICK, study.indices[names[index]][place, order], _THICK, color=colour,
                xerr=None if index == 3 else half, error_kw={"elinewidth": 1.0, "capsize": 2.0},
                label=heads[index],
            )  # fmt: skip
        ax.set_yticks(at, [_short(study.keys[k]) for k in order], fontsize=8)
        unit = f"{one.unit} per range" if method == "morris" else "share of the variance"
        label(ax, unit, "", one.name)
        largest = float(np.nanmax(study.indices[names[0]][place]))
        ax.set_xlim(left=min(0.0, -0.02 * largest) if math.isfinite(largest) else None)
    if shown:
        handles, words = panels[0].get_legend_handles_labels()
        figure.legend(handles, words, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _short(key: str) -> str:
    """Return a key without its first table, which the second mostly tells."""
    return key.partition(".")[2] or key
