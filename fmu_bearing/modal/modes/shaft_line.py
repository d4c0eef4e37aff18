"""The line of a set's shaft in a mode, and the picture of it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import shaft_model
from fmu_bearing.extras import need
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import set_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DRAWN = 6  # modes in the picture
_POINTS = 81  # of a line in it
_STATIONS = 41  # of a shaft in a universal file, besides its bearings


def line(
    scene: Scene, system: Linearised, mode: Mode, places: Sequence[float] | None = None
) -> NDArray[np.complex128]:
    """Return y and z of the shaft at ``places`` (m from the nose), see `Modes.line`; shape (2, places)."""
    at = (0.0, *system.shaft.positions) if places is None else places
    points = motion(scene, system, mode, at)[:, 1:].T
    largest = points.ravel()[int(np.argmax(abs(points)))]
    return np.asarray(points / largest if abs(largest) > 0.0 else points)


def motion(scene: Scene, system: Linearised, mode: Mode, places: Sequence[float]) -> NDArray[np.complex128]:
    """Return x, y and z of the shaft at ``places`` (m from the nose), as the eigenvector has them."""
    shaft = shaft_model(scene, set_of(scene))
    q = mode.vector[system.places : system.places + system.shaft.shaft_count]
    return np.array([shaft.at(float(place))[:3] @ q for place in places])


def stations(scene: Scene, system: Linearised) -> list[float]:
    """Return even places along the shaft (m from the nose) with those of its bearings between."""
    even = np.linspace(0.0, 1e-3 * set_of(scene).shaft.length_mm, _STATIONS)
    return sorted({round(float(place), 9) for place in (*even, *system.shaft.positions)})


def picture(scene: Scene, system: Linearised, modes: Sequence[Mode], rpm: float) -> "Figure":
    """Draw the line of the shaft in its lowest ``modes`` across, at a speed (r/min)."""
    chosen = [mode for mode in modes if mode.order == 1][:_DRAWN]
    rows = max(len(chosen), 1)
    figure, axes = need("matplotlib.pyplot", "a picture").subplots(
        rows, 1, sharex=True, squeeze=False, figsize=(7.0, 1.2 * rows + 0.8), layout="constrained"
    )
    places = np.linspace(0.0, 1e-3 * set_of(scene).shaft.length_mm, _POINTS)
    bearings = 1e3 * system.shaft.positions
    for ax, mode in zip(axes[:, 0], chosen, strict=False):
        y, z = line(scene, system, mode, list(places))
        # both when each is largest
        for part, colour, dash, label in ((y, "#D55E00", "--", "y"), (z, "#0072B2", "-", "z")):
            turn = part[int(np.argmax(abs(part)))]
            turned = (part * np.conj(turn) / abs(turn)).real if abs(turn) > 0.0 else part.real
            ax.plot(1e3 * places, turned, color=colour, linestyle=dash, label=label)
        ax.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
        ax.plot(bearings, 0.0 * bearings, "k^", markersize=6)
        ax.set_ylim(-1.15, 1.15)
        words = f"{mode.frequency:,.0f} Hz, damping {100 * mode.damping:.2g} %, {mode.label}"
        ax.set_title(words, fontsize=8, loc="left", pad=2)
    if chosen:
        axes[0, 0].legend(fontsize=7, loc="upper right", frameon=False, ncols=2)
    axes[-1, 0].set_xlabel("from the nose, mm (triangles: bearings); y and z each at its largest")
    figure.suptitle(f"{scene.name}: line of the shaft at {rpm:,.0f} r/min", fontsize=9)
    return figure  # type: ignore[no-any-return]
