"""Universal files (.uff), which programs for modal analysis read: signals, responses, mode shapes, nodes.

Datasets 164 (units, SI), 15 (places of nodes), 58 (functions at even spacing), 55 (mode shapes), as the
Structural Dynamics Research Laboratory of the University of Cincinnati describes them.
"""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing import __version__
from fmu_bearing.files import check_file, write_whole
from fmu_bearing.results.even_steps import spacing

_TYPES = {"m": 8, "rad": 8, "m/s": 11, "rad/s": 11, "m/s2": 12, "rad/s2": 12, "N": 13, "N.m": 13, "Pa": 15}
_POWERS = {8: (1, 0), 11: (1, 0), 12: (1, 0), 13: (0, 1), 15: (-2, 1)}  # of length and force; of turns below
_DIRECTIONS = ("", "x", "y", "z", "tx", "ty", "tz")
_UNITS = f"{1:10d}{'SI: Meter (newton)':>20}{2:10d}\n{' 1.0000000000000000D+00' * 3}\n 2.7315000000000000D+02"


class Place(NamedTuple):
    """What is measured or driven: name, unit, node, direction (``y``, ``ty`` about y, empty for a scalar)."""

    name: str
    unit: str
    node: int = 0
    direction: str = ""


def place_of(name: str, unit: str) -> Place:
    """Return the place of a variable by its name: along an axis where it ends so, at its bearing's node."""
    *_, part, last = ("", *name.split("."))
    turned = part in ("tilt", "moment") or unit in ("rad", "rad/s", "N.m")
    number = name[8 : name.find("]")] if name.startswith("bearing[") else "0"
    return Place(name, unit, int(number), ("t" if turned else "") + last if last in ("x", "y", "z") else "")


@dataclass(frozen=True, eq=False)
class Function:
    """Values at even spacing: over time (s), or over frequency (Hz), complex, ``over`` what drives them."""

    at: Place
    values: NDArray[Any]
    start: float
    spacing: float
    over: Place | None = None


@dataclass(frozen=True, eq=False)
class Shape:
    """A mode: eigenvalue (1/s), and complex amplitudes along x, y, z of each node, shape (nodes, 3)."""

    name: str
    value: complex
    motion: NDArray[np.complex128]


def signal(at: Place, time: ArrayLike, values: ArrayLike) -> Function:
    """Return values over evenly spaced times (s); `ValueError` for others, and for values without number."""
    start, spacing = _even(time, "times", "s")
    if not np.isfinite(found := np.asarray(values, dtype=float)).all():
        raise ValueError(f"{at.name} is not a number at all times, as a level before metering: leave it out")
    return Function(at, found, start, spacing)


def responses(
    frequency: ArrayLike, matrix: ArrayLike, outputs: Sequence[Place], inputs: Sequence[Place]
) -> list[Function]:
    """Return functions of a matrix, shape (frequencies, outputs, inputs); `ValueError` for uneven spacing."""
    start, spacing = _even(frequency, "frequencies", "Hz")
    values = np.asarray(matrix, dtype=complex).reshape(-1, len(outputs), len(inputs))
    pairs = [(i, j) for i in range(len(outputs)) for j in range(len(inputs))]
    return [Function(outputs[i], values[:, i, j], start, spacing, inputs[j]) for i, j in pairs]


def write_uff(
    path: str | os.PathLike[str], contents: Iterable[Function | Shape],
    nodes: Mapping[int, Sequence[float]] | None = None, title: str = "",
) -> Path:  # fmt: skip
    """Write functions, and shapes over all nodes (m, by number); ``title``: scene. Errors as `check_file`."""
    target, places = check_file(path, ".uff", "a universal file"), dict(nodes or {})
    sets: list[tuple[int, Iterable[str]]] = [(164, [_UNITS])]
    if places:
        rows = [f"{k:10d}{0:10d}{0:10d}{8:10d}{_row(place)}" for k, place in places.items()]
        sets.append((15, rows))
    for one in contents:
        if isinstance(one, Shape):
            number = 1 + sum(kind == 55 for kind, _ in sets)
            sets.append((55, _shape(one, number, list(places), title)))
        else:
            sets.append((58, _function(one, title)))
    text = "".join(f"{-1:6d}\n{kind:6d}\n{chr(10).join(lines)}\n{-1:6d}\n" for kind, lines in sets)
    return write_whole(target, text.encode("ascii", "replace"))


def _even(axis: ArrayLike, what: str, unit: str) -> tuple[float, float]:
    found = spacing(axis)
    if not found.even:
        raise ValueError(
            f"the {what} are {found.words(unit)}: a universal file (.uff) takes two or more, evenly spaced"
        )
    return float(np.ravel(np.asarray(axis, dtype=float))[0]), found.step


def _row(values: Iterable[Any], form: str = "13.5e") -> str:
    return "".join(f"{float(value):{form}}" for value in values)


def _head(name: str, title: str) -> str:
    return f"{name or 'NONE':.80}\nfmu-bearing {__version__}\nNONE\n{title or 'NONE':.80}\nNONE"


def _axis(kind: int, length: int, force: int, name: str, unit: str) -> str:
    return f"{kind:10d}{length:5d}{force:5d}{0:5d} {name or 'NONE':20.20} {unit or 'NONE':20.20}"


def _function(one: Function, title: str) -> Iterator[str]:
    answer, over, flat = one.over is not None, one.over or Place("", ""), one.values.ravel()
    yield _head(f"{one.at.name} over {over.name}" if answer else one.at.name, title)
    ends = [
        f" {at.name or 'NONE':10.10}{at.node:10d}{_DIRECTIONS.index(at.direction):4d}"
        for at in (one.at, over)
    ]
    yield f"{4 if answer else 1:5d}{0:10d}{0:5d}{0:10d}{''.join(ends)}"
    # with one digit more than usual in these columns 1/51200 s is exact, and the last sample at its time
    even = _row((one.start, one.spacing, 0.0), "13.6e")
    yield f"{6 if answer else 4:10d}{flat.size:10d}{1:10d}{even}"
    yield _axis(18, 0, 0, "Frequency", "Hz") if answer else _axis(17, 0, 0, "Time", "s")
    for at in (one.at, over):
        length, force = _POWERS.get(kind := _TYPES.get(at.unit, 0), (0, 0))
        length += (1 if kind == 13 else -1) * at.direction.startswith("t")  # moments, angles
        yield _axis(kind, length, force, at.name, at.unit)
    yield _axis(0, 0, 0, "", "")
    flat = flat.astype(complex).view(float) if answer else flat
    yield from (_row(flat[k : k + 4], "20.12e") for k in range(0, flat.size, 4))


def _shape(one: Shape, number: int, nodes: list[int], title: str) -> Iterator[str]:
    yield _head(one.name, title)
    yield "".join(f"{field:10d}" for field in (1, 3, 2, 8, 5, 3))  # complex, first order, displacements
    yield f"{2:10d}{6:10d}{1:10d}{number:10d}\n{_row((one.value.real, one.value.imag, 0, 0, 0, 0))}"
    for node, motion in zip(nodes, np.asarray(one.motion, dtype=complex), strict=True):
        yield f"{node:10d}\n{_row(motion.copy().view(float))}"
