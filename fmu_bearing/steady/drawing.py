"""A set of bearings drawn to scale: shaft, bearings, balls and their lines of contact."""

import math
from typing import TYPE_CHECKING

from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import COLOURS, empty
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import set_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_STEEL, _LINE = "#d9d9d9", "#606060"


def pressure_centres(scene: Scene) -> list[float]:
    """Return where the lines of contact of each bearing of a set meet the shaft's axis, mm from the nose.

    With the nominal contact angle and pitch diameter, as makers give it.
    """
    bearing = scene.bearing
    reach = 0.5 * bearing.pitch_diameter_mm * math.tan(math.radians(bearing.contact_angle_deg))
    return [one.position_mm - one.sign * reach for one in set_of(scene).bearing]


def draw_set(scene: Scene, axes: "Axes", title: str = "") -> None:
    """Draw a scene's set into ``axes``, mm."""
    patches = need("matplotlib.patches", "a picture")
    spindle, bearing = set_of(scene), scene.bearing
    start = 0.0
    for length, diameter, bore in spindle.shaft.sections_mm:
        for side in (0.5 * bore, -0.5 * diameter):
            wall = 0.5 * (diameter - bore)
            axes.add_patch(
                patches.Rectangle((start, side), length, wall, facecolor=_STEEL, edgecolor=_LINE, lw=0.6)
            )
        start += length
    pitch, half = 0.5 * bearing.pitch_diameter_mm, 0.5 * bearing.width_mm
    inner, outer = 0.5 * bearing.bore_mm, 0.5 * bearing.outside_diameter_mm
    for one, centre in zip(spindle.bearing, pressure_centres(scene), strict=True):
        x = one.position_mm
        beyond = x + one.sign * (outer - pitch) * math.tan(math.radians(bearing.contact_angle_deg))
        for side in (1.0, -1.0):
            low = inner if side > 0.0 else -outer
            box = patches.Rectangle(
                (x - half, low), 2.0 * half, outer - inner, facecolor="white", edgecolor=_LINE
            )
            axes.add_patch(box)
            ball = 0.5 * bearing.ball_diameter_mm
            axes.add_patch(
                patches.Circle((x, side * pitch), ball, facecolor="white", edgecolor=COLOURS["balls"])
            )
            axes.plot([centre, beyond], [0.0, side * outer], color=COLOURS["inner_ring"], lw=1.0)
        axes.plot([centre], [0.0], marker=".", color=COLOURS["inner_ring"])
    axes.axhline(0.0, color=_LINE, lw=0.5, ls="-.")
    axes.set_aspect("equal")
    axes.set_title(title or f"{scene.name}: {spindle.arrangement}", fontsize=9)
    axes.set_xlabel("from the nose, mm", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.autoscale_view()


def set_figure(scenes: dict[str, Scene], columns: int = 3) -> "Figure":
    """Return a figure of sets side by side, by their titles."""
    rows = -(-len(scenes) // columns)
    figure = empty((3.4 * columns, 2.4 * rows))
    for place, (title, scene) in enumerate(scenes.items(), start=1):
        draw_set(scene, figure.add_subplot(rows, columns, place), title)
    return figure
