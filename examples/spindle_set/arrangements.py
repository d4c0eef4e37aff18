"""Draw the usual arrangements of bearings on one shaft: ``python arrangements.py [FILE]``, a second."""

import argparse
import math
import pathlib
from typing import TYPE_CHECKING

from fmu_bearing import Scene, read_scene
from fmu_bearing.extras import need
from fmu_bearing.reports.sections.arrangement import pressure_centres
from fmu_bearing.results.picture_parts import COLOURS, empty, save
from fmu_bearing.scene.member import set_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PAIR = pathlib.Path(__file__).with_name("7003C-DB.toml")
SETS = {
    "DB (O): + -": "+-",
    "DF (X): - +": "-+",
    "DT: + +, under a load towards +x": "++",
    "TBT (O): + + -": "++-",
    "QBC (O): + + - -": "++--",
    "QFC (X): - - + +": "--++",
}
_FIRST, _APART, _BEYOND = 20.0, 24.0, 20.0  # mm
_STEEL, _LINE = "#d9d9d9", "#606060"


def scenes() -> dict[str, Scene]:
    """Return the arrangements by their titles: 7003C side by side on a plain shaft."""
    base = read_scene(PAIR).model_dump(mode="json", exclude_none=True)
    found = {}
    for title, signs in SETS.items():
        length = _FIRST + _APART * (len(signs) - 1) + _BEYOND
        base["spindle"] = {
            "shaft": {"sections_mm": [[length, 17.0, 0.0]]},
            "bearing": [
                {"position_mm": _FIRST + _APART * k, "carries": f"{sign}x"} for k, sign in enumerate(signs)
            ],
            "load": {"force_x_N": 100.0},
        }
        found[title] = Scene.from_dict(base)
    return found


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


def main() -> None:
    """Write the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", nargs="?", default="arrangements.png", help="picture to write")
    save(set_figure(scenes()), parser.parse_args().file)


if __name__ == "__main__":
    main()
