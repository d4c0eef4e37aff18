"""Figures of a run: variables of the table with a statistic over the window."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface import Variable, variables
from fmu_bearing.interface.names import chosen_names, known
from fmu_bearing.metrology.at_speed import DIRECTIONS, AtSpeed
from fmu_bearing.metrology.nose import followed
from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import exclusion
from fmu_bearing.sweeps.axes import SweepError

#: Default figures.
DEFAULT = (
    "mic[*].leq_a",
    "mic[*].leq",
    "inner_ring.velocity",
    "outer_ring.velocity",
    "outer_ring.velocity:1x",
    "cage.velocity",
    "cage.speed_ratio",
    "contact.*.load_mean",
    "contact.*.angle_mean",
    "contact.*.pressure_max",
    "contact.*.shoulder_margin",
    "film.lambda_min",
    "friction_torque",
    "heat.*",
    # of a set
    "shaft.nose.velocity",
    "bearing[*].force.x",
    "bearing[*].contact.*.pressure_max",
    "bearing[*].contact.*.shoulder_margin",
)
STATISTICS = {
    "mean": "mean over the window",
    "rms": "rms about the mean over the window, all axes together",
    "min": "least over the window",
    "max": "largest over the window",
    "last": "at the end of the window",
    "1x": "rms of the part at shaft speed, vertical and horizontal together",
}
#: Of a run of its own, read by parts of a revolution: values of `AtSpeed` in each direction.
_ERROR_MOTION, _PREFIX = "error motion", "error_motion."
_VALUES = {
    "asynchronous": "Asynchronous error motion",
    "synchronous": "Synchronous error motion, averaged,",
    "synchronous_by_line": "Synchronous error motion by line",
}
#: How each figure is taken, in words.
HOW = STATISTICS | {_ERROR_MOTION: "over 20 to 120 whole revolutions of a run of its own"}
_MOTION, _PLACE = ".velocity", ".displacement"
_AXES = ("x", "y", "z")
_TURN = "1x"
#: Of the part at shaft speed: rows for each point. What folds onto it then lies at 40 kHz, where rings hardly
#: move; waves of a surface end at 20 kHz.
_PARTS = 4


@dataclass(frozen=True)
class Figure:
    """One number of a run.

    Attributes
    ----------
    name : str
        Variable, with ``:`` and the statistic where it is not the usual one of its kind.
    statistic : str
    columns : tuple of int
        Places in the engine's outputs ``z``; for velocities of a body its three axes.
    unit, words : str
    places : tuple of int
        For the part at shaft speed: places of the body's displacements in ``z``; empty where it has none.
    """

    name: str
    statistic: str
    columns: tuple[int, ...]
    unit: str
    words: str
    places: tuple[int, ...] = ()


def columns_of(figures: Sequence[Figure]) -> list[int]:
    """Places in ``z`` that figures read, each once."""
    return sorted({place for figure in figures for place in (*figure.columns, *figure.places)})


def parts_of(figures: Sequence[Figure]) -> int:
    """Rows that are needed for each point: more where the part at shaft speed is read."""
    return _PARTS if any(figure.statistic == _TURN for figure in figures) else 1


def figures_of(scene: Scene, patterns: Sequence[str] | None = None) -> tuple[Figure, ...]:
    """Return the figures that patterns name in a scene's table of variables.

    Parameters
    ----------
    patterns : sequence of str, optional
        Variables, with ``*`` for any text; ``:statistic`` behind one asks for another than the usual, for
        example ``"friction_torque:max"``. A body's velocity goes without axis: ``"cage.velocity"``. Default:
        figures of `DEFAULT` that the scene has.

    Raises
    ------
    UnknownName
        For an unknown name or statistic; the message suggests the nearest.
    SweepError
        For a statistic that a variable does not have.
    """
    table = _table(scene)
    found: dict[str, Figure] = {}
    of_axis = {} if exclusion(scene, "error motion") else _error_motions()
    for pattern in DEFAULT if patterns is None else patterns:
        name, _, statistic = pattern.partition(":")
        if statistic:
            known(statistic, list(STATISTICS), "statistic")
        if patterns is None:
            names = _matching(name, table)
        else:
            # a run of its own is not for a pattern of all variables
            apart = of_axis if name.startswith(_PREFIX) else ()
            names = chosen_names([name], [*table, *apart], [])
        for one in names:
            if one in of_axis and statistic:
                raise SweepError(f"{one}:{statistic} is refused: it is a value over revolutions already")
            figure = of_axis.get(one) or _figure(one, statistic, table)
            found[figure.name] = figure
    return tuple(found.values())


def read(
    figures: Sequence[Figure], rows: NDArray[np.float64], h: float, speed: float
) -> tuple[float, ...]:  # fmt: skip
    """Return the figures of a window.

    Parameters
    ----------
    rows : ndarray, shape (1 + points * parts_of(figures), columns)
        Outputs `columns_of` the figures, ``h`` (s) apart; the first at the window's beginning.
    speed : float
        Of the shaft (rad/s), constant.
    """
    place = {column: k for k, column in enumerate(columns_of(figures))}
    every, found = parts_of(figures), []
    for figure in figures:
        if figure.statistic == _ERROR_MOTION:
            found.append(math.nan)  # of another run, see `error_motions`
            continue
        moved = bool(figure.places)
        signals = rows[:, [place[column] for column in (figure.places or figure.columns)]]
        if not np.isfinite(signals).all():
            found.append(math.nan)
        elif figure.statistic == _TURN:
            found.append(_turning(signals[:, 1:], moved, h, speed))
        else:
            found.append(_value(figure, signals[every::every]))
    return tuple(found)


def error_motions(figures: Sequence[Figure], scene: Scene) -> dict[str, float]:
    """Return the figures of error motion by name (m, rad), from a run of their own; {} where none is wanted.

    At the middle of a single bearing against its outer ring, at the nose of a set against the ground. NaN
    where the shaft does not turn.
    """
    wanted = [one.name for one in figures if one.statistic == _ERROR_MOTION]
    if not wanted:
        return {}
    if scene.operation.speed_rpm == 0.0:
        return dict.fromkeys(wanted, math.nan)
    values = AtSpeed(followed(scene, 0.0, None, scene.assembly.shaft is None)).values
    found = {_named(kind, one.direction): getattr(one, kind) for one in values for kind in _VALUES}
    return {name: found[name] for name in wanted}


def _named(kind: str, direction: str) -> str:
    return f"{_PREFIX}{kind}.{direction.replace(' ', '_')}"


def _error_motions() -> dict[str, Figure]:
    """Return all figures of error motion by name."""
    return {
        _named(kind, direction): Figure(
            _named(kind, direction), _ERROR_MOTION, (), "rad" if "tilt" in direction else "m",
            f"{words} {direction}",
        )
        for kind, words in _VALUES.items()
        for direction in DIRECTIONS
    }  # fmt: skip


def _value(figure: Figure, signals: NDArray[np.float64]) -> float:
    if figure.statistic == "mean":
        return float(signals.mean())
    if figure.statistic == "rms":
        return float(np.sqrt(signals.var(axis=0).sum()))
    if figure.statistic == "min":
        return float(signals.min())
    if figure.statistic == "max":
        return float(signals.max())
    return float(signals[-1, 0])


def _turning(signals: NDArray[np.float64], moved: bool, h: float, speed: float) -> float:
    """Rms velocity at shaft speed, from displacements where ``moved``, else from velocities.

    The mean velocity between two displacements takes what folds onto the shaft speed, lines near the rate of
    reading, down to that speed over this rate.
    """
    time = h * np.arange(1, len(signals), dtype=np.float64)
    if not moved:
        return _once_per_turn(signals[1:], time, speed)
    mean = np.sinc(speed * h / (2.0 * math.pi))  # what the line itself loses
    return _once_per_turn(np.diff(signals, axis=0) / h, time, speed) / float(mean)


def _once_per_turn(signals: NDArray[np.float64], time: NDArray[np.float64], speed: float) -> float:
    """Rms of the part at shaft speed; Hann's window suppresses lines two of its bins away."""
    turns = abs(speed) * (time[-1] - time[0]) / (2.0 * math.pi)
    if turns < 3.0:  # the line would not be apart from the mean
        return math.nan
    weights = np.hanning(len(time) + 2)[1:-1]
    carrier = weights * np.exp(-1j * speed * (time - time[0]))
    centred = signals - (weights @ signals) / weights.sum()
    amplitudes = 2.0 * (carrier @ centred) / weights.sum()
    return float(np.sqrt(0.5 * (np.abs(amplitudes) ** 2).sum()))


def _table(scene: Scene) -> dict[str, list[Variable]]:
    """Return the variables that figures can use: outputs and local variables, velocities as vectors."""
    read = {v.name: v for v in variables(scene, rotor_inertia=0.0) if v.array == "z"}
    table: dict[str, list[Variable]] = {}
    for name, variable in read.items():
        body, motion, axis = name.rpartition(f"{_MOTION}.")
        if motion and axis in _AXES:
            table.setdefault(body + _MOTION, []).append(variable)
        else:
            table[name] = [variable]
    return table


def _matching(pattern: str, table: dict[str, list[Variable]]) -> list[str]:
    """Names that a pattern of `DEFAULT` matches; a scene without sound or cage has none of some."""
    try:
        return chosen_names([pattern], table, [])
    except ValueError:
        return []


def _figure(name: str, statistic: str, table: dict[str, list[Variable]]) -> Figure:
    members = table[name]
    usual = _usual(name, members)
    if statistic == _TURN and len(members) != len(_AXES):
        raise SweepError(f"{name}:1x is refused: the part at shaft speed is taken of a body's velocity")
    words = members[0].description
    if len(members) > 1:
        words = words.removesuffix(" along the axis")
    label = name if statistic in ("", usual) else f"{name}:{statistic}"
    chosen = statistic or usual
    places: list[Variable] = []
    if chosen == _TURN:
        body = name.removesuffix(_MOTION) + _PLACE
        places = [one for axis in _AXES for one in table.get(f"{body}.{axis}", [])]
    columns = tuple(v.index for v in members)
    return Figure(label, chosen, columns, members[0].unit, words, tuple(v.index for v in places))


def _usual(name: str, members: list[Variable]) -> str:
    """Return the statistic that says most about a variable."""
    if len(members) > 1 or name.startswith(("inner_ring.flexure", "outer_ring.flexure")):
        return "rms"
    end = name.rpartition(".")[2]
    if members[0].unit == "dB" or members[0].type == "Integer":
        return "last"
    if end in ("shoulder_margin", "lambda_min"):
        return "min"
    return "max" if end.endswith("_max") else "mean"
