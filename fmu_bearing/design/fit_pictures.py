"""Pictures of `fits`: angle, preload, hoop stress and interference with the bands of the tolerances."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from fmu_bearing.design.fit_curves import Axis, Curves
from fmu_bearing.design.fit_verdicts import SAFE, UNSAFE
from fmu_bearing.design.fits import Fits
from fmu_bearing.design.mounted import GROOVE
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas.fits import Fit, State, breaking_chance
from fmu_bearing.results.picture_parts import OTHERS, empty, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MEAN = 2  # place of the takes
_DEGREES = 180.0 / np.pi
_FAR = 10.0  # times the strength of a bar: there every ring breaks
_COLOUR = OTHERS[0]
_SPEED, _TEMPERATURE = "speed, 1000 r/min", "inner ring, degC; all parts in proportion"
_SCENE: dict[str, Any] = {"color": "0.35", "linestyle": ":", "linewidth": 1.2}


def picture(study: Fits, curves: Sequence[Curves]) -> "Figure":
    """Draw two rows of panels per bearing, over speed and over temperature.

    Light bands reach from min to max, dark ones over the probable interferences; lines are the mean.

    Raises
    ------
    MissingExtra
        Without Matplotlib.
    """
    figure = empty((12.0, 6.6 * len(curves)))
    panels = figure.subplots(2 * len(curves), 3, squeeze=False)
    for k, curve in enumerate(curves):
        upper, lower = panels[2 * k], panels[2 * k + 1]
        name = f"bearing {curve.number}: " if len(curves) > 1 else ""
        quantity = "contact angle under load, deg" if curve.held_by_force else "preload, N"
        factor = _DEGREES if curve.held_by_force else 1.0
        scene = study.columns[_MEAN].bearings[k].point.scene
        rpm, warm = scene.operation.speed_rpm, scene.operation.inner_ring_temperature_degC
        for (left, right), axis, words, scale, at in (
            (upper[:2], curve.speed, _SPEED, 1e-3, rpm),
            (lower[:2], curve.temperature, _TEMPERATURE, 1.0, warm),
        ):
            if axis is None:
                for panel in (left, right):
                    _empty(panel, "over temperature: all is at 20 degC; give temperatures of [operation]")
                continue
            _band(left, scale * axis.fine, _DEGREES * axis.free_angle)
            _band(right, scale * axis.coarse, factor * axis.held)
            label(left, words, "free contact angle, deg", f"{name}free contact angle")
            label(right, words, quantity, f"{name}{quantity.split(',')[0]}")
            for panel in (left, right):
                panel.axvline(scale * at, **_SCENE)
            if not curve.held_by_force:
                right.set_ylim(bottom=0.0)
        if "inner" in study.columns[_MEAN].bearings[k].seats:
            _hoop(upper[2], study, k, curve.speed, name)
            _interference(lower[2], study, k, curve.speed, name)
        else:
            for panel in (upper[2], lower[2]):
                _empty(panel, "the inner ring has no seat")
    figure.suptitle(
        f"{study.scene.name}, {study.words(1)}\nlight: min to max; dark: probable; line: mean; dotted: the "
        "scene's speed and temperature",
        fontsize="medium",
    )
    return figure


def _band(panel: "Axes", x: NDArray[np.float64], y: NDArray[np.float64]) -> None:
    """Draw the curves of all takes as two bands and a line; shape (5, places)."""
    panel.fill_between(x, y[0], y[4], color=_COLOUR, alpha=0.2, linewidth=0.0)
    panel.fill_between(x, y[1], y[3], color=_COLOUR, alpha=0.35, linewidth=0.0)
    panel.plot(x, y[_MEAN], color=_COLOUR)


def _hoop(panel: "Axes", study: Fits, number: int, axis: Axis, name: str) -> None:
    """Draw the hoop stress over speed, and where the chance of breaking has its limits."""
    _band(panel, 1e-3 * axis.fine, 1e-6 * GROOVE * axis.hoop)
    label(panel, _SPEED, "MPa", f"{name}hoop stress, inner ring, x {GROOVE:g}")
    one = study.columns[_MEAN].bearings[number].point.scene
    panel.axvline(1e-3 * one.operation.speed_rpm, **_SCENE)
    ring, top = one.materials.inner_ring, panel.get_ylim()[1]
    if ring.bending_strength_MPa is None or ring.weibull_modulus is None:
        if not one.materials.steel_rings:
            _note(panel, "no strength given: ask the maker for\nbending_strength_MPa and weibull_modulus")
    else:
        fit = study.columns[_MEAN].bearings[number].apart.seats["inner"].fit
        strength = f"{ring.bending_strength_MPa:g} MPa in bending, m = {ring.weibull_modulus:g}"
        for chance, colour in ((SAFE, OTHERS[4]), (UNSAFE, OTHERS[1])):
            stress = limit(fit, chance, 1e6 * ring.bending_strength_MPa, ring.weibull_modulus)
            panel.axhline(1e-6 * stress, color=colour, linestyle="--", label=f"breaks with {chance:g}")
            top = max(top, 1.05e-6 * stress)
        panel.legend(title=strength, loc="best", fontsize="small", title_fontsize="small")
    panel.set_ylim(0.0, top)


def limit(fit: Fit, chance: float, strength: float, modulus: float) -> float:
    """Return the hoop stress at the bore (Pa) by pressure at which a ring breaks at once with a chance."""

    def beyond(stress: float) -> float:
        state = State(0.0, stress / fit.hoop, stress, 0.0)
        return breaking_chance(fit, state, 0.0, strength, modulus) - chance

    return float(brentq(beyond, 0.0, strength * _FAR, xtol=1.0))


def _interference(panel: "Axes", study: Fits, number: int, axis: Axis, name: str) -> None:
    """Draw the interference over speed, and the speed at which the mean lets go where it is near."""
    _band(panel, 1e-3 * axis.fine, 1e6 * axis.interference)
    label(panel, _SPEED, "interference on diameter, um", f"{name}interference, inner ring")
    point = study.columns[_MEAN].bearings[number]
    panel.axvline(1e-3 * point.point.scene.operation.speed_rpm, **_SCENE)
    panel.axhline(0.0, color="0.35", linewidth=1.0)
    low, high = panel.get_ylim()
    panel.set_ylim(low - 0.3 * (high - low), high)  # room for the words
    words = []
    for column in study.columns:
        loss = column.bearings[number].seats["inner"].loss_speed
        at = "never" if loss is None else "loose" if loss == 0.0 else f"{loss / RPM:,.0f}"
        words.append(f"{column.take}: {at}")
        if loss is not None and 0.0 < loss / RPM < axis.fine[-1]:
            panel.plot(1e-3 * loss / RPM, 0.0, marker="o", color=OTHERS[1])
    _note(panel, "\n".join(["lets go at, r/min:", ", ".join(words[:3]), ", ".join(words[3:])]))


def _note(panel: "Axes", words: str) -> None:
    back = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8}
    panel.text(0.02, 0.02, words, transform=panel.transAxes, fontsize="small", va="bottom", bbox=back)


def _empty(panel: "Axes", words: str) -> None:
    panel.set_axis_off()
    panel.text(0.5, 0.5, words, transform=panel.transAxes, fontsize="small", ha="center", wrap=True)
