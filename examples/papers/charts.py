"""Pictures of the pages: small PNG files, colours for all kinds of colour vision (Okabe and Ito, 2008)."""

import io
import pathlib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.results.picture_parts import empty

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = "osDv^Px"
_DPI = 80


def figure(width: float, height: float, rows: int, columns: int, polar: bool = False, share_y: bool = False):
    """Return an empty figure and its axes, flat."""
    drawn = empty((width, height))
    kind = {"projection": "polar"} if polar else {}
    axes = drawn.subplots(rows, columns, squeeze=False, subplot_kw=kind, sharey=share_y)
    return drawn, list(np.ravel(axes))


def save(drawn: "Figure", path: pathlib.Path) -> None:
    """Write the PNG with few colours and without a date: small, and equal pictures are equal files."""
    from PIL import Image  # comes with Matplotlib

    buffer = io.BytesIO()
    drawn.savefig(buffer, dpi=_DPI, format="png")
    Image.open(buffer).convert("RGB").quantize(96).save(path, optimize=True)


def curves(
    ax: "Axes", x: Sequence[float], lines: Mapping[str, Sequence[float]], title: str, x_label: str,
    y_label: str = "SPL, dB", first: int = 0, **style,
) -> None:  # fmt: skip
    """Draw named lines over one abscissa."""
    for k, (name, y) in enumerate(lines.items()):
        colour, marker = COLOURS[(first + k) % 7], MARKERS[(first + k) % 7]
        ax.plot(x, y, color=colour, marker=marker, markersize=4, linewidth=1.2, label=name, **style)
    ax.set_title(title, fontsize=10)
    ax.set_xlabel(x_label)
    ax.set_ylabel(y_label)
    ax.grid(True, color="0.9")


def circle(
    ax: "Axes", degrees: Sequence[float], lines: Mapping[str, Sequence[float]], title: str, zero: str = "N"
) -> None:
    """Draw levels round a circle, angles growing to the left; ``zero``: the compass point of the first."""
    ax.set_theta_zero_location(zero)
    ax.set_theta_direction(1)
    lowest = min(min(y) for y in lines.values())
    highest = max(max(y) for y in lines.values())
    for k, (name, y) in enumerate(lines.items()):
        around = np.radians([*degrees, degrees[0]])
        ax.plot(around, [*y, y[0]], color=COLOURS[k % 7], linewidth=1.2, label=name)
    ax.set_ylim(lowest - 0.3 * (highest - lowest) - 0.5, highest + 0.3)
    ax.tick_params(labelsize=7)
    ax.set_title(title, fontsize=10)
    ax.legend(fontsize=7, loc="lower left", bbox_to_anchor=(-0.25, -0.2))
