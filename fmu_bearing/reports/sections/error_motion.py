"""Error motion of the axis of rotation, from the run of the report: values, lines, sources, a polar plot."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.metrology.at_speed import AtSpeed
from fmu_bearing.metrology.axis_watch import OUTER_TILTS
from fmu_bearing.metrology.error_motion import BOUND, ErrorMotion
from fmu_bearing.metrology.nose import resampled
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Choice, Option, Section, Table, Words, small
from fmu_bearing.results.picture_parts import closed
from fmu_bearing.results.rates import rates_of

_SHOWN = ("fixed y", "fixed z", "rotating", "axial")
_DRAWN = 20  # revolutions of a plot
_EVERY = 2  # points of a revolution are drawn
_STEADY = 1e-3  # of the speed: more is a run-up
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
    motion = _read(subject)
    (one,) = motion.speeds
    if motion.against == "ground":
        what = "of the nose of the shaft against the ground"
    else:
        what = "of the inner ring against the outer ring"
    columns, rows = motion.table()
    fitted = bool(one.nose.rates)
    chosen = [k for k, name in enumerate(columns) if k >= _OF_RUN and (fitted or "by line" not in name)]
    tilts = subject.several or subject.has(*OUTER_TILTS)
    table = Table(
        f"Error motion {what} over {one.revolutions} revolutions",
        [columns[k] for k in chosen],
        [[row[k] for k in chosen] for row in rows if tilts or row[_OF_RUN] in _SHOWN],
        note="Terms of ISO 230-7, whose text was not at hand. Asynchronous: the largest width of the polar "
        f"plot at any angle. {_synchronous(fitted)} {BOUND[0].upper()}{BOUND[1:]}.",
    )
    blocks: list[Block] = [table, _polar(one)]
    if fitted:
        remarks = [line for line in motion.remarks() if line != BOUND]
        blocks[1:1] = [Words(f"{line[0].upper()}{line[1:]}.", "note") for line in remarks]
        blocks += _sources(motion)
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


def _sources(motion: ErrorMotion) -> list[Block]:
    """Return the largest lines, and what each bearing and each of its sources makes alone."""
    columns, rows = motion.lines()
    blocks: list[Block] = [
        Table(
            "Largest lines of the error motion, amplitudes", columns[1:], [r[1:] for r in rows], folded=True
        )
    ]
    parts = [("source", motion.per_source())]
    if motion.against == "ground":
        parts.insert(0, ("bearing", motion.per_bearing()))
    for name, (heads, cells) in parts:
        caption = f"Asynchronous error motion that the lines of each {name} make alone"
        blocks.append(Table(caption, heads[1:], [row[1:] for row in cells], folded=True))
    return blocks


def _read(subject: Subject) -> ErrorMotion:
    """Return the error motion of the run; `Absent` where it does not allow that."""
    moving = subject.scene.assembly.moving
    motion, tilts = _columns(subject, moving), np.zeros((len(subject.time), 2))
    if subject.several or subject.has(*OUTER_TILTS):
        tilts += _tilts(subject, (f"{moving}.tilt.y", f"{moving}.tilt.z"))
    if not subject.several:
        motion -= _columns(subject, "outer_ring")
        tilts -= _tilts(subject, OUTER_TILTS) if subject.has(*OUTER_TILTS) else 0.0
    if not np.isfinite(subject.turn):
        raise Absent("the shaft does not turn")
    if np.ptp(subject.recording.speed) > _STEADY * abs(subject.speed):
        raise Absent("the speed changes, so that no revolution repeats another")
    scene, rates = subject.at_speed, None
    if len(scene.bearings()) <= _FITTED:
        rates = rates_of(subject.recording.outputs, scene)
    try:
        watched = None if rates is None else rates[subject.within]
        nose = resampled(scene, subject.time, np.hstack([motion, tilts]), watched)
    except ValueError as reason:
        raise Absent(str(reason)) from None
    return ErrorMotion(scene, (AtSpeed(nose),), 0.0, "ground" if subject.several else "outer ring")


def _columns(subject: Subject, body: str) -> NDArray[np.float64]:
    """Return the displacement (m) of a body, shape (points, 3)."""
    return np.column_stack([subject.output(f"{body}.displacement.{axis}") for axis in _AXES])


def _tilts(subject: Subject, names: Sequence[str]) -> NDArray[np.float64]:
    """Return tilts (rad) about y and z, shape (points, 2)."""
    return np.column_stack([subject.output(name) for name in names])


def _polar(one: AtSpeed) -> Chart:
    """Draw some revolutions pale and the mean contour bold on a base circle."""
    figure = look.figure(height=460, showlegend=False)
    largest = 0.0
    for direction in _SHOWN:
        angle, rows, mean, base = one.polar(direction)
        largest = max(largest, 1.5 * base)
        turned = np.tile(angle, min(len(rows), _DRAWN))[::_EVERY]
        for radius, at, colour, width in (
            (rows[:_DRAWN].ravel()[::_EVERY], turned, look.colour("grey"), 0.6),
            (closed(mean), closed(angle), look.colour("inner_ring"), 2.4),
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
