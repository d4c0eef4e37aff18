"""The table of `fits` for people: a row per figure, a column per interference."""

import math
from collections.abc import Callable, Iterator, Sequence

from fmu_bearing.design.fits import STATES, FitPoint, Fits, SeatPoint
from fmu_bearing.design.mounted import RINGS
from fmu_bearing.design.verdict import shown_hours
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas.fits import Kind, State

_WORDS = {"drawing": "drawing", "mounted": "mounted", "warm": "warm", "running": "at speed"}
#: Head of the table of states.
STATE_COLUMNS = ("", *_WORDS.values())
_MICRO, _MEGA = 1e6, 1e-6


def head(study: Fits) -> tuple[str, ...]:
    """Return the head of the table."""
    return ("", *(column.take.replace("probable", "prob.") for column in study.columns))


def fit_rows(study: Fits, number: int) -> list[list[str]]:
    """Return the rows on one bearing; ``number``: from 1."""
    points = [column.bearings[number - 1] for column in study.columns]
    rows: list[list[str]] = []
    for ring in RINGS:
        if ring in points[0].seats:
            rows += _seat_rows(ring, [point.seats[ring] for point in points])
    rows += _by_state(
        "free angle, deg", points, lambda one: one.free_angles, lambda x: f"{math.degrees(x):.1f}"
    )
    if points[0].clearances:
        rows += _by_state("clearance, um", points, lambda one: one.clearances, lambda x: f"{_MICRO * x:.1f}")
    rows += _by_state("preload, N", points, lambda one: one.preloads, lambda x: f"{x:.0f}")
    for key in _WORDS:
        if any(key in point.gaps for point in points):
            cells = [f"{_MICRO * point.gaps[key]:.1f}" if key in point.gaps else "" for point in points]
            rows.append([f"balls loose by, um, {_WORDS[key]}", *cells])
    for ring in RINGS:
        angles = [math.degrees(point.point.contacts[ring]["angle_mean"]) for point in points]
        rows.append([f"contact angle, {ring} race, deg", *(f"{angle:.1f}" for angle in angles)])
    pressures = [max(point.point.contacts[ring]["pressure_max"] for ring in RINGS) for point in points]
    rows.append(["pressure of balls, GPa", *(f"{1e-9 * value:.2f}" for value in pressures)])
    rows.append(["axial stiffness, N/um", *(f"{_MEGA * point.axial_stiffness:.1f}" for point in points)])
    rows.append(["radial stiffness, N/um", *(f"{_MEGA * point.radial_stiffness:.1f}" for point in points)])
    lives = [point.point.life for point in points]
    if any(life is not None for life in lives):
        rows.append(["L10r, h", *("-" if life is None else shown_hours(life) for life in lives)])
    return rows


def shown_tables(study: Fits) -> list[tuple[str, tuple[str, ...], list[list[str]]]]:
    """Return title, head and rows of the tables that people read, what all bearings share once."""
    rows = {bearing.number: fit_rows(study, bearing.number) for bearing in study.columns[0].bearings}
    words = {number: study.words(number) for number in rows}
    shared: list[list[str]] = []
    if len(rows) > 1 and len(set(words.values())) == 1:
        shared = [row for row in rows[1] if all(row in table for table in rows.values())]
    parts = [(f"all bearings, {words[1]}", shared)]
    for number, table in rows.items():
        name = f"bearing {number}, " if len(rows) > 1 else ""
        parts.append((f"{name}{words[number]}", [row for row in table if row not in shared]))
    given = all(len(set(row[1:])) == 1 for _, table in parts for row in table)
    columns = ("", "as given") if given else head(study)
    count = len(columns)
    return [
        (f"{study.scene.name}: {name}", columns, [row[:count] for row in table])
        for name, table in parts
        if table
    ]


def _seat_rows(ring: Kind, seats: Sequence[SeatPoint]) -> Iterator[list[str]]:
    """Yield the rows on the seat of one ring."""
    if any(abs(seat.drawn - 2.0 * seat.states["mounted"].interference) > 1e-9 for seat in seats):
        yield [f"{ring} ring, fit drawn, um", *(f"{_MICRO * seat.drawn:+.1f}" for seat in seats)]

    def rows(name: str, cell: Callable[[State], str]) -> Iterator[list[str]]:
        for key in STATES:
            yield [f"{ring} ring, {name} {_WORDS[key]}", *(cell(seat.states[key]) for seat in seats)]

    yield from rows("fit, um,", lambda one: f"{2.0 * _MICRO * one.interference:+.1f}")
    if not any(state.pressure for seat in seats for state in seat.states.values()) and ring == "outer":
        return  # loose in all columns: nothing presses
    yield from rows("seat, MPa,", lambda one: f"{_MEGA * one.pressure:.1f}")
    yield from rows("hoop, MPa,", lambda one: f"{_MEGA * one.hoop:.0f}")
    yield from rows("race, um,", lambda one: f"{_MICRO * one.race:+.2f}")
    if ring == "inner":
        losses = [seat.loss_speed for seat in seats]
        cells = [
            "never" if loss is None else "loose" if loss == 0.0 else f"{1e-3 * loss / RPM:.1f}"
            for loss in losses
        ]
        yield ["inner ring, lets go at, 1000 r/min", *cells]
    warm = ("warm the ring", "cool the shaft") if ring == "inner" else ("cool the ring", "warm the housing")
    for words, kelvins in zip(
        warm, ([seat.ring_kelvin for seat in seats], [seat.partner_kelvin for seat in seats]), strict=True
    ):
        cells = ["never" if kelvin is None else f"{kelvin:.0f}" for kelvin in kelvins]
        yield [f"to slip it on, {words}, K", *cells]
    if seats[0].breaking is not None:
        for key in STATES:
            chances = [(seat.breaking or {})[key] for seat in seats]
            yield [
                f"chance of breaking, {_WORDS[key]}",
                *(f"{chance:.0e}" if chance else "0" for chance in chances),
            ]


def _by_state(
    name: str,
    points: Sequence[FitPoint],
    figures: Callable[[FitPoint], dict[str, float]],
    cell: Callable[[float], str],
) -> Iterator[list[str]]:
    """Yield a row per state of a figure."""
    for key in figures(points[0]):
        yield [f"{name}, {_WORDS[key]}", *(cell(figures(point)[key]) for point in points)]


def state_rows(point: FitPoint) -> list[list[str]]:
    """Return the rows on one bearing with one interference: a column per state, `STATE_COLUMNS`."""
    rows = []
    for ring, seat in point.seats.items():
        tight = {"drawing": seat.drawn} | {key: 2.0 * one.interference for key, one in seat.states.items()}
        rows.append(
            [f"{ring} ring, fit on diameter, um", *(f"{_MICRO * one:+.1f}" for one in tight.values())]
        )
        for name, cells in (
            ("pressure of the seat, MPa", [f"{_MEGA * one.pressure:.1f}" for one in seat.states.values()]),
            ("hoop stress, MPa", [f"{_MEGA * state.hoop:.0f}" for state in seat.states.values()]),
            ("growth of the race, um", [f"{_MICRO * state.race:+.2f}" for state in seat.states.values()]),
        ):
            rows.append([f"{ring} ring, {name}", "", *cells])
        if seat.breaking is not None:
            rows.append(
                ["inner ring, chance of breaking", "", *(f"{one:.0e}" for one in seat.breaking.values())]
            )
    rows.append(["free contact angle, deg", *(f"{math.degrees(a):.1f}" for a in point.free_angles.values())])
    if point.clearances:
        rows.append(["radial clearance, um", *(f"{_MICRO * left:.1f}" for left in point.clearances.values())])
    if point.preloads:
        known = [point.preloads.get(key) for key in _WORDS]
        rows.append(["preload, N", *("" if force is None else f"{force:.0f}" for force in known)])
    return rows
