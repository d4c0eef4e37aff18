"""Error motion of the axis of rotation, from the run of the report: averaged values, a polar plot."""

import numpy as np

from fmu_bearing.engine.constants import RPM
from fmu_bearing.metrology.at_speed import DIRECTIONS, AtSpeed
from fmu_bearing.metrology.error_motion import BOUND
from fmu_bearing.metrology.nose import resampled
from fmu_bearing.metrology.polar_values import asynchronous, synchronous
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Chart, Choice, Option, Section, Table, small

#: The outer ring's tilt is not among the variables, so that tilts are left to the command.
_SHOWN = ("fixed y", "fixed z", "rotating", "axial")
_DRAWN = 20  # revolutions of a plot
_EVERY = 2  # points of a revolution are drawn
_STEADY = 1e-3  # of the speed: more is a run-up
_BASE = 2.0  # radius of the base circle over the largest deviation


def error_motion(subject: Subject) -> Section:
    """Error motion of the inner ring against the outer one, in the middle of the bearing."""
    one = _read(subject)
    rows = []
    for direction in _SHOWN:
        unit, factor = DIRECTIONS[direction]
        signal = one.signal(direction)
        lowest = 1 if direction == "axial" else 2
        values = (asynchronous(signal), synchronous(signal.mean(axis=0), lowest))
        rows.append([direction, *(f"{factor * value:.3f}" for value in values)])
    table = Table(
        f"Error motion of the inner ring against the outer ring over {one.revolutions} revolutions, um",
        ["direction", "asynchronous", "synchronous, averaged"],
        rows,
        note="Terms of ISO 230-7, from memory. Asynchronous: the largest width of the polar plot at any "
        "angle. An average over few revolutions holds a part of the lines near whole orders; the command "
        f"error-motion takes them out, and names lines and sources. {BOUND[0].upper()}{BOUND[1:]}.",
    )
    return Section("error-motion", "Error motion", [table, _polar(one)])


def _read(subject: Subject) -> AtSpeed:
    """Return the motion of the run at parts of a revolution; `Absent` where it does not allow that."""
    inner, outer = (
        np.column_stack([subject.output(f"{ring}_ring.displacement.{axis}") for axis in "xyz"])
        for ring in ("inner", "outer")
    )
    if not np.isfinite(subject.turn):
        raise Absent("the shaft does not turn")
    if np.ptp(subject.recording.speed) > _STEADY * abs(subject.speed):
        raise Absent("the speed changes, so that no revolution repeats another")
    motion = np.hstack([inner - outer, np.zeros((len(inner), 2))])
    try:
        scene = subject.scene.replace({"operation.speed_rpm": subject.speed / RPM})
        return AtSpeed(resampled(scene, subject.time, motion))
    except ValueError as reason:
        raise Absent(str(reason)) from None


def _polar(one: AtSpeed) -> Chart:
    """Draw some revolutions pale and the mean contour bold on a base circle."""
    figure = look.figure(height=460, showlegend=False)
    angle = np.sign(one.rpm) * 2.0 * np.pi * np.arange(1, 1 + one.signal(_SHOWN[0]).shape[1])
    angle /= len(angle)
    largest = 0.0
    drawn = {direction: one.polar(direction) for direction in _SHOWN}
    for direction, (rows, mean) in drawn.items():
        factor = DIRECTIONS[direction][1]
        base = _BASE * factor * max(float(np.abs(rows).max()), 1e-15)
        largest = max(largest, 1.5 * base)
        pale = base + factor * rows[:_DRAWN].ravel()[::_EVERY]
        turned = np.tile(angle, min(len(rows), _DRAWN))[::_EVERY]
        bold, around = base + factor * np.append(mean, mean[:1]), np.append(angle, angle[:1])
        for radius, at, colour, width in (
            (pale, turned, look.colour("grey"), 0.6),
            (bold, around, look.colour("inner_ring"), 2.4),
        ):
            figure.add_scatter(
                x=small(-radius * np.sin(at)), y=small(radius * np.cos(at)), mode="lines",
                meta={"direction": direction}, visible=direction == _SHOWN[0], hoverinfo="skip",
                line={"color": colour, "width": width},
            )  # fmt: skip
    reach = [-1.05 * largest, 1.05 * largest]
    figure.update_layout(
        xaxis=look.axis("um", range=reach, constrain="domain"),
        yaxis=look.axis("um", range=reach, scaleanchor="x", constrain="domain"),
    )
    return Chart(
        "error-motion",
        "Polar plot about the circle of least squares",
        figure,
        "Polar plot of the deviations over the angle of the shaft: revolutions pale, their mean bold.",
        (Choice("direction", "Direction", [Option(name, name) for name in _SHOWN]),),
        note=f"{min(one.revolutions, _DRAWN)} revolutions pale, the mean of {one.revolutions} bold, on a "
        "base circle of free radius: only deviations from it have a scale.",
    )
