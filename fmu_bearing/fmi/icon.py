"""Draws the icon that importers show, ``model.png``: run once, the picture is kept beside the description.

``python -m fmu_bearing.fmi.icon modelDescription/model.png``
"""

import math
import sys
from pathlib import Path

from fmu_bearing.extras import need

__all__ = ["draw_icon"]


def draw_icon(path: str | Path, pixels: int = 256) -> None:
    """Draw a bearing seen along its axis, and its sound; ``pixels`` is the width and height."""
    shapes = need("matplotlib.patches", "a picture")
    figure = need("matplotlib.figure", "a picture").Figure(figsize=(pixels / 100, pixels / 100), dpi=100)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-1.5, 1.5), ylim=(-1.5, 1.5), aspect="equal")
    axes.axis("off")
    steel, ceramic = "#33475b", "#f4f1ea"
    for outer, width in ((1.05, 0.2), (0.58, 0.2)):
        axes.add_patch(
            shapes.Annulus((0, 0), outer, width, facecolor="#b8c4ce", edgecolor=steel, linewidth=1.5)
        )
    for j in range(11):
        angle = 2 * math.pi * j / 11
        centre = (0.715 * math.cos(angle), 0.715 * math.sin(angle))
        axes.add_patch(shapes.Circle(centre, 0.14, facecolor=ceramic, edgecolor=steel, linewidth=1.5))
    for reach in (1.2, 1.35):
        for towards in (45, 225):
            arc = shapes.Arc((0, 0), 2 * reach, 2 * reach, theta1=towards - 25, theta2=towards + 25)
            arc.set(edgecolor="#d9822b", linewidth=3)
            axes.add_patch(arc)
    figure.savefig(path, transparent=True, metadata={"Software": None})


if __name__ == "__main__":
    draw_icon(sys.argv[1])
