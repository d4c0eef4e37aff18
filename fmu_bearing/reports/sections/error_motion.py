"""Error motion of the axis of rotation, from the run of the report: values, lines, sources, a polar plot."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.metrology.at_speed import DIRECTIONS, AtSpeed
from fmu_bearing.metrology.axis_watch import OUTER_TILTS
from fmu_bearing.metrology.error_motion import BOUND, ErrorMotion
from fmu_bearing.metrology.nose import resampled
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Choice, Option, Section, Table, Words, small
from fmu_bearing.run.rates import rates_of

_SHOWN = ("fixed y", "fixed z", "rotating", "axial")
_DRAWN = 20  # revolutions of a plot
_EVERY = 2  # points of a revolution are drawn
_STEADY = 1e-3  # of the speed: more is a run-up
_BASE = 2.0  # radius of the base circle over the largest deviation
_FITTED = 4  # bearings: the lines of more take the fit minutes, and memory
_AXES = "xyz"
_OF_RUN = 2  # columns of `ErrorMotion.table` that say which run it was


def error_motion(subject: Subject) -> Section:
    """Error motion: of a bearing's inner ring against the outer one, of a set's nose against the ground.

    Values are those of `fmu_bearing.error_motion`, as far as the run kept what they need.

    Raises
    ------
    Absent
        Where the shaft does not turn evenly, or for too few revolutions.
    """
    found = _read(subject)
    (one,) = found.speeds
    if found.against == "ground":
        what = "of the nose of the shaft against the ground"
    else:
        what = "of the inner ring against the outer ring"
    columns, rows = found.table()
    fitted = bool(one.nose.rates)
    chosen = [k for k, name in enumerate(columns) if k >= _OF_RUN and (fitted or "by line" not in name)]
    tilts = bool(subject.scene.assembly.members) or subject.has(*OUTER_TILTS)
    table = Table(
        f"Error motion {what} over {one.revolutions} revolutions",
        [columns[k] for k in chosen],
        [[row[k] for k in chosen] for row in rows if tilts or row[_OF_RUN] in _SHOWN],
        note="Terms of ISO 230-7, whose text was not at hand. Asynchronous: the largest width of the polar "
        f"plot at any angle. {_synchronous(fitted)} {BOUND[0].upper()}{BOUND[1:]}.",
    )
    blocks: list[Block] = [table, _polar(one)]
    if fitted:
        remarks = [line for line in found.remarks() if line != BOUND]
        blocks[1:1] = [Words(f"{line[0].upper()}{line[1:]}.", "note") for line in remarks]
        blocks += _sources(found)
    return Section("error-motion", "Error motion", blocks)


def _synchronous(fitted: bool) -> str:
    """Say what the synchronous values hold."""
    if fitted:
        return (
            "Averaged: as an instrument does; an average over few revolutions holds a part of the lines near "
            "whole orders. By line: whole orders, fitted beside the lines of the bearings."
        )
    return (
        "An average over few revolutions holds a part of the lines near whole orders; the command "
        "error-motion takes them out, and names lines and sources."
    )


def _sources(found: ErrorMotion) -> list[Block]:
    """Return the largest lines, and what each bearing and each of its sources makes alone."""
    columns, rows = found.lines()
    blocks: list[Block] = [
        Table(
            "Largest lines of the error motion, amplitudes", columns[1:], [r[1:] for r in rows], folded=True
        )
    ]
    parts = [("source", found.per_source())]
    if found.scene.assembly.members:
        parts.insert(0, ("bearing", found.per_bearing()))
    for name, (heads, cells) in parts:
        caption = f"Asynchronous error motion that the lines of each {name} make alone"
        blocks.append(Table(caption, heads[1:], [row[1:] for row in cells], folded=True))
    return blocks


def _read(subject: Subject) -> ErrorMotion:
    """Return the error motion of the run; `Absent` where it does not allow that."""
    scene = subject.scene
    several = scene.assembly.shaft is not None
    if several:
        moving = scene.assembly.moving
        motion = _columns(subject, moving)
        motion = np.hstack([motion, _tilts(subject, (f"{moving}.tilt.y", f"{moving}.tilt.z"))])
    else:
        motion = np.hstack(
            [_columns(subject, "inner_ring") - _columns(subject, "outer_ring"), _between(subject)]
        )
    if not np.isfinite(subject.turn):
        raise Absent("the shaft does not turn")
    if np.ptp(subject.recording.speed) > _STEADY * abs(subject.speed):
        raise Absent("the speed changes, so that no revolution repeats another")
    scene = scene.replace({"operation.speed_rpm": subject.speed / RPM})
    rates = None
    if len(scene.bearings()) <= _FITTED:
        rates = rates_of(subject.recording.outputs, scene)
    try:
        nose = resampled(scene, subject.time, motion, None if rates is None else rates[subject.within])
    except ValueError as reason:
        way = "" if not several else "; the run of a set's report cannot, and the command error-motion does"
        raise Absent(f"{reason}{way}") from None
    return ErrorMotion(scene, (AtSpeed(nose),), 0.0, "ground" if several else "outer ring")


def _columns(subject: Subject, body: str) -> NDArray[np.float64]:
    """Return the displacement (m) of a body, shape (points, 3)."""
    return np.column_stack([subject.output(f"{body}.displacement.{axis}") for axis in _AXES])


def _tilts(subject: Subject, names: Sequence[str]) -> NDArray[np.float64]:
    """Return tilts (rad) about y and z, shape (points, 2)."""
    return np.column_stack([subject.output(name) for name in names])


def _between(subject: Subject) -> NDArray[np.float64]:
    """Return the tilt of the inner ring against the outer one; zeros where it was not kept."""
    if not subject.has(*OUTER_TILTS):
        return np.zeros((len(subject.time), 2))
    return _tilts(subject, ("inner_ring.tilt.y", "inner_ring.tilt.z")) - _tilts(subject, OUTER_TILTS)


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
