"""Figures of a run: variables of the table with a statistic over a window of time.

The only table of figures. Sweeps, comparisons and what finds a fidelity read by it: a name, a unit, how it is
read, and where; a figure of one bearing is, of a set, one of each.
"""

import functools
import hashlib
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import SP, Z
from fmu_bearing.engine.sources import rooms_digest, source_hash
from fmu_bearing.interface import Variable, variables
from fmu_bearing.interface.names import UnknownName, chosen_names, known, matching
from fmu_bearing.run.march import march
from fmu_bearing.scene import Scene

#: Packages whose code computes figures, beside the engine.
_ROOMS = (
    "acoustics", "elastic", "formulas", "identification", "interface", "metrology", "prepare", "recording",
    "run", "scene", "sweeps",
)  # fmt: skip
STATISTICS = {
    "mean": "mean over the window",
    "rms": "rms about the mean over the window, all axes together",
    "min": "least over the window",
    "max": "largest over the window",
    "last": "at the end of the window",
    "1x": "rms of the part at shaft speed, vertical and horizontal together",
}
#: Values of signals, shape (points, axes).
_READ: dict[str, Callable[[NDArray[np.float64]], Any]] = {
    "mean": np.mean,
    "rms": lambda signals: np.sqrt(signals.var(axis=0).sum()),
    "min": np.min,
    "max": np.max,
    "last": lambda signals: signals[-1, 0],
}
#: Levels of a microphone, as variables (``mic[1].leq_a``) and measurements name them.
LEVEL, A_LEVEL, THIRD_OCTAVE = "leq", "leq_a", "third_octave"
#: Rings that each bearing has, in the order of their channels.
RINGS = ("inner_ring", "outer_ring")
#: Units of tables where the numbers of the SI unit are inconvenient, and the factor from it.
_TABLE_UNITS = {"rad": ("deg", 180.0 / np.pi), "N.m": ("N mm", 1e3)}
_MOTION, _PLACE = ".velocity", ".displacement"
_AXES = ("x", "y", "z")
_TURN = "1x"
#: Of the part at shaft speed: rows for each point. What folds onto it then lies at 40 kHz, where rings hardly
#: move; waves of a surface end at 20 kHz.
_PARTS = 4
#: What every bearing of a set has by itself; the rest is the set's as a whole.
_OWN = set(Z.BEARING_OUTPUTS) - set(SP.OUTPUTS)


@dataclass(frozen=True)
class Figure:
    """One number of a run.

    Attributes
    ----------
    name : str
        Variable, with ``:`` and the statistic where it is not the usual one of its kind.
    statistic : str
        One of `STATISTICS`, or words of who reads it from another run.
    columns : tuple of int
        Places in the engine's outputs ``z``; for velocities of a body its three axes; empty: of another run.
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


def of_each(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Return names of variables of one bearing as a scene has them: of a set one for each bearing.

    Names that a set has as a whole (``friction_torque``), or that name a bearing, stay.
    """
    prefixes = [bearing.prefix for bearing in scene.bearings()]
    return tuple(
        full
        for name in names
        for full in ([head + name for head in prefixes] if {name, f"{name}.x"} & _OWN else [name])
    )


def rings_of(scene: Scene) -> dict[str, tuple[int, int]]:
    """Return bearing, from 0, and place in `RINGS` of each ring of a scene by its name."""
    heads = enumerate(bearing.prefix for bearing in scene.bearings())
    return {head + ring: (b, k) for b, head in heads for k, ring in enumerate(RINGS)}


def table_unit(unit: str) -> tuple[str, float]:
    """Return the unit in which tables show a figure of this SI unit, and the factor to it."""
    return _TABLE_UNITS.get(unit, (unit, 1.0))


def figures_of(
    scene: Scene, patterns: Sequence[str], apart: Mapping[str, Figure] | None = None, *, strict: bool = True
) -> tuple[Figure, ...]:
    """Return the figures that patterns name in a scene's table of variables.

    Parameters
    ----------
    patterns : sequence of str
        Variables, with ``*`` for any text; ``:statistic`` behind one asks for another than the usual, for
        example ``"friction_torque:max"``. A body's velocity goes without axis: ``"cage.velocity"``.
    apart : mapping, optional
        Figures of runs of their own by name, for patterns that begin as they do.
    strict : bool
        False: what the scene does not have is left out.

    Raises
    ------
    UnknownName
        For an unknown name or statistic, with the nearest, and for one that a variable does not have.
    """
    table, beside = _table(scene), apart or {}
    figures: dict[str, Figure] = {}
    for pattern in patterns:
        name, _, statistic = pattern.partition(":")
        if statistic:
            known(statistic, list(STATISTICS), "statistic")
        # a run of its own is not for a pattern of all variables
        head = name.partition(".")[0]
        names = [*table, *(one for one in beside if one.partition(".")[0] == head)]
        for one in chosen_names([name], names, []) if strict else matching(name, names):
            if one in beside and statistic:
                raise UnknownName(f"{one}:{statistic} is refused: it is a value over revolutions already")
            figure = beside[one] if one in beside else _figure(one, statistic, table)
            figures[figure.name] = figure
    return tuple(figures.values())


def rows_over(bearing: Arrays, figures: Sequence[Figure], steps: Iterable[float]) -> NDArray[np.float64]:
    """March over steps (s); return what figures read at the start and after each, shape (1 + steps, n)."""
    columns = _columns_of(figures)
    rows = [bearing.z[columns]]
    march(bearing, steps, lambda: rows.append(bearing.z[columns]))
    return np.array(rows)


def parts_of(figures: Sequence[Figure]) -> int:
    """Rows that are needed for each point: more where the part at shaft speed is read."""
    return _PARTS if any(figure.statistic == _TURN for figure in figures) else 1


def values_of(
    figures: Sequence[Figure], rows: NDArray[np.float64], h: float, speed: float
) -> dict[str, float]:
    """Return the figures of a window by name; NaN for those of a run of their own.

    Parameters
    ----------
    rows : ndarray, shape (1 + points * parts_of(figures), columns)
        As `rows_over` has them, ``h`` (s) apart.
    speed : float
        Of the shaft (rad/s), constant.
    """
    every, values = parts_of(figures), {}
    for figure in figures:
        signals = signals_of(figure, figures, rows)
        if not figure.columns or not np.isfinite(signals).all():
            values[figure.name] = math.nan
        elif figure.statistic == _TURN:
            values[figure.name] = _turning(signals[:, 1:], bool(figure.places), h, speed)
        else:
            values[figure.name] = float(_READ[figure.statistic](signals[every::every]))
    return values


def signals_of(figure: Figure, figures: Sequence[Figure], rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the columns of one figure in the rows of all ``figures``."""
    place = {column: k for k, column in enumerate(_columns_of(figures))}
    return rows[:, [place[column] for column in (figure.places or figure.columns)]]


def _columns_of(figures: Sequence[Figure]) -> list[int]:
    """Places in ``z`` that figures read, each once."""
    return sorted({place for figure in figures for place in (*figure.columns, *figure.places)})


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


def _figure(name: str, statistic: str, table: dict[str, list[Variable]]) -> Figure:
    members = table[name]
    usual = _usual(name, members)
    if statistic == _TURN and len(members) != len(_AXES):
        raise UnknownName(f"{name}:1x is refused: the part at shaft speed is taken of a body's velocity")
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
    if name.startswith("accelerometer["):
        return "rms" if end == "acceleration" else "last"  # the others are metered
    if members[0].unit == "dB" or members[0].type == "Integer":
        return "last"
    if end in ("shoulder_margin", "lambda_min"):
        return "min"
    return "max" if end.endswith("_max") else "mean"


@functools.cache
def code_digest() -> str:
    """Digest (16 hex digits) of the code that computes figures: sources, versions of NumPy and Numba."""
    parts = f"{source_hash()} {np.__version__} {numba.__version__} {rooms_digest(*_ROOMS)}"
    return hashlib.sha256(parts.encode()).hexdigest()[:16]
