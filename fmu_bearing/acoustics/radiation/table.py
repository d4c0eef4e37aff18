"""Radiation model ``table``: transfer functions that the user brings.

For housings that are no bodies of revolution.

A NumPy archive (``numpy.savez``) with five arrays:

===============  =====================================================================================
``frequencies``  (k,) Hz, ascending, from 20 Hz or less to 20 kHz or more
``inputs``       (i,) names, see below
``microphones``  (m,) names, as in the scene; more than the scene has are ignored
``positions``    (m, 3) places in m, x along the bearing axis, as in the scene
``H``            (m, i, k) complex, Pa per m/s2 (rad/s2 for tilts), time factor e^{+j omega t}
===============  =====================================================================================

Inputs are ``<body>.acceleration.<x|y|z>`` and ``<body>.angular_acceleration.<y|z>`` of ``inner_ring``,
``outer_ring`` (or ``housing``, which moves with it) and ``cage``; ``balls.acceleration.<x|r|t>.<cos|sin>[m]``
for the balls' sums over cos(m theta), sin(m theta), theta from 12 o'clock (``cos[0]`` of x and r only); and
``flexure[i]``, i = 1 .., for flexural coordinates. What a table leaves out is silent. In a set each input
begins with its bearing, ``bearing[2].inner_ring.acceleration.x``; places count from the nose, and all is in
the axes of the shaft.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path as File

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.frequencies import BAND, fit_frequencies, interpolated_response
from fmu_bearing.acoustics.radiation.radiators import BALLS, Path
from fmu_bearing.engine.layout import SD
from fmu_bearing.file_words import absent as no_file, why
from fmu_bearing.files import read_arrays
from fmu_bearing.likeness import nearest

_ARRAYS = ("frequencies", "inputs", "microphones", "positions", "H")
_BODIES = {"inner_ring": 0, "outer_ring": 1, "housing": 1, "cage": 2}
#: Inputs whose sign changes where axes are mirrored along X.
_MIRRORED = re.compile(r"\.acceleration\.x|\.angular_acceleration\.")
_APART = 1e-3  # m by which a microphone may be off its place in the scene
_TURN = 0.5 * np.pi  # rad between neighbouring frequencies: beyond this the curve between them is a guess
_HEARD = 10 ** (-40 / 20)  # turns count where the magnitude exceeds this share of the largest
_SILENT = 1e-9  # an input this far below the loudest is what rounding has left
_MARGIN = 4.0 / SD.RATE  # s that a filter keeps ahead of the sound's mean arrival


@dataclass(frozen=True)
class Table:
    """Transfer functions of a file: ``response`` has the shape (microphones, inputs, frequencies)."""

    frequencies: NDArray[np.float64]
    inputs: tuple[str, ...]
    microphones: tuple[str, ...]
    positions: NDArray[np.float64]
    response: NDArray[np.complex128]


def read_table(path: str | File) -> Table:
    """Read and check a table.

    Raises
    ------
    ValueError
        One line: what is wrong with the file, and the way out.
    """
    where = f"sound.table_file {path}"
    try:
        data = read_arrays(path, _ARRAYS)
    except FileNotFoundError:
        raise ValueError(f"{where}: {no_file(path)}; paths count from the scene file") from None
    except OSError as problem:
        raise ValueError(f"{where}: cannot be read: {why(problem)}") from None
    except ValueError as problem:
        raise ValueError(f"{where}: {problem}; make one by numpy.savez") from None
    absent = [name for name in _ARRAYS if name not in data]
    if absent:
        raise ValueError(f"{where} has no array {', '.join(absent)}; it needs {', '.join(_ARRAYS)}")
    try:
        table = Table(
            np.atleast_1d(data["frequencies"]).astype(float),
            tuple(str(name) for name in np.atleast_1d(data["inputs"])),
            tuple(str(name) for name in np.atleast_1d(data["microphones"])),
            np.atleast_2d(data["positions"]).astype(float),
            data["H"].astype(complex),
        )
    except Exception:  # NumPy raises what it comes upon
        raise ValueError(f"{where}: frequencies, positions and H must be numbers, the rest names") from None
    _check(table, where)
    return table


def _check(table: Table, where: str) -> None:
    f, shape = table.frequencies, table.response.shape
    wanted = (len(table.microphones), len(table.inputs), len(f))
    if shape != wanted:
        raise ValueError(f"{where}: H has the shape {shape}; microphones, inputs, frequencies make {wanted}")
    if table.positions.shape != (wanted[0], 3):
        raise ValueError(f"{where}: positions has the shape {table.positions.shape}, not {(wanted[0], 3)}")
    if not (np.isfinite(f).all() and np.isfinite(table.positions).all()):
        raise ValueError(f"{where}: frequencies and positions must be finite numbers")
    bad = np.argwhere(~np.isfinite(table.response))
    if len(bad):
        m, i, k = bad[0]
        raise ValueError(
            f"{where}: H is not finite for microphone {table.microphones[m]}, input {table.inputs[i]} at "
            f"{f[k]:g} Hz ({len(bad)} such values); leave such an input out, or compute it again"
        )
    if len(f) < 2 or np.any(np.diff(f) <= 0.0) or f[0] < 0.0:
        raise ValueError(f"{where}: frequencies must ascend from 0 Hz or more, without repeats")
    if f[0] > BAND[0] or f[-1] < BAND[1]:
        raise ValueError(
            f"{where} reaches from {f[0]:g} to {f[-1]:g} Hz; {BAND[0]:g} to {BAND[1]:g} Hz are needed: add "
            "the ends (below the first resonance H is nearly constant, at 0 Hz it is real)"
        )
    for names, word in ((table.inputs, "input"), (table.microphones, "microphone")):
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"{where}: {word} {twice[0]} is given more than once")


def select(table: Table, microphones: Sequence[tuple[str, Sequence[float]]], where: str) -> Table:
    """Bring a table's microphones into the order of the scene's (name, place in m).

    Raises
    ------
    ValueError
        When one is absent or is elsewhere.
    """
    order = []
    for name, place in microphones:
        if name not in table.microphones:
            known = ", ".join(table.microphones[:8]) + (" ..." if len(table.microphones) > 8 else "")
            raise ValueError(
                f"{where} has no microphone '{name}' (it has {known}); add it to the table or remove it from "
                "the scene"
            )
        row = table.microphones.index(name)
        off = float(np.linalg.norm(table.positions[row] - np.asarray(place)))
        if off > _APART:
            there = ", ".join(f"{1e3 * v:g}" for v in table.positions[row])
            here = ", ".join(f"{1e3 * v:g}" for v in place)
            raise ValueError(
                f"{where}: microphone '{name}' is at ({there}) mm, in the scene at ({here}) mm; they may "
                f"differ by {1e3 * _APART:g} mm"
            )
        order.append(row)
    return Table(
        table.frequencies, table.inputs, tuple(table.microphones[i] for i in order), table.positions[order],
        table.response[order],
    )  # fmt: skip


def of_bearing(table: Table, number: int, sign: int, count: int) -> Table:
    """Return what a table of a set has of one bearing, in that bearing's own axes.

    Parameters
    ----------
    table : Table
        With inputs that begin with ``bearing[1].`` and so on, in the axes of the shaft.
    number, count : int
        Of the bearing, from 1, and of all bearings.
    sign : int
        1 where it carries force on the shaft towards +X, else -1: then its axes are mirrored along X.

    Raises
    ------
    ValueError
        For an input that names no bearing of the set.
    """
    known = [f"bearing[{k}]." for k in range(1, count + 1)]
    for name in table.inputs:
        if not name.startswith(tuple(known)):
            raise ValueError(
                f"sound.table_file: '{name}' names none of the {count} bearings; an example: "
                "bearing[1].inner_ring.acceleration.x"
            )
    head = known[number - 1]
    own = [i for i, name in enumerate(table.inputs) if name.startswith(head)]
    names = tuple(table.inputs[i].removeprefix(head) for i in own)
    signs = np.array([sign if _MIRRORED.search(name) else 1 for name in names], dtype=float)
    response = table.response[:, own] * signs[:, None]
    return Table(table.frequencies, names, table.microphones, table.positions, response)


def channels(harmonics: int, bodies_of_flexures: Sequence[int] = ()) -> dict[str, tuple[int, int, int]]:
    """Component, channel and kind of every input that a table may have.

    ``bodies_of_flexures``: the body (0 inner, 1 outer ring) of each flexural coordinate.
    """
    known: dict[str, tuple[int, int, int]] = {}
    for body, index in _BODIES.items():
        for k, axis in enumerate("xyz"):
            known[f"{body}.acceleration.{axis}"] = (index, SD.c_body(index, k), SD.RADIAL if k else SD.AXIAL)
        for k, axis in enumerate("yz"):
            known[f"{body}.angular_acceleration.{axis}"] = (index, SD.c_tilt(index, k), SD.ROTATION)
    for k, axis in enumerate("xr"):
        known[f"balls.acceleration.{axis}.cos[0]"] = (BALLS, SD.c_ball(0, k), SD.BALLS_KIND)
    for m in range(1, harmonics + 1):
        for k, axis in enumerate("xrt"):
            for i, shape in enumerate(("cos", "sin")):
                name = f"balls.acceleration.{axis}.{shape}[{m}]"
                known[name] = (BALLS, SD.c_ball(m, k) + i, SD.BALLS_KIND)
    for i, ring in enumerate(bodies_of_flexures):
        known[f"flexure[{i + 1}]"] = (ring, SD.c_flex(harmonics) + i, SD.FLEXURE)
    return known


def table_paths(
    table: Table, microphone: int, harmonics: int, bodies_of_flexures: Sequence[int] = ()
) -> list[Path]:
    """Paths to one microphone of a table.

    Raises
    ------
    ValueError
        On an unknown input, two names for one body, or frequencies too far apart to interpolate.
    """
    known = channels(harmonics, bodies_of_flexures)
    if not table.inputs:  # of a bearing that is silent
        return []
    responses = table.response[microphone]
    flight = _flight(table.frequencies, responses)
    f = fit_frequencies()
    paths: dict[int, Path] = {}
    for name, response in zip(table.inputs, responses, strict=True):
        if name not in known:
            near = nearest(name, known)
            hint = f"did you mean '{near}'?" if near else "an example: outer_ring.acceleration.x"
            raise ValueError(f"sound.table_file: '{name}' is not an input of this scene; {hint}")
        component, channel, kind = known[name]
        if channel in paths:
            raise ValueError(
                f"sound.table_file: '{name}' is given twice, as housing and as outer_ring: keep one"
            )
        if np.abs(response).max() > _SILENT * np.abs(responses).max():
            _check_spacing(table, microphone, name, response, flight)
            transfer = interpolated_response(table.frequencies, response, flight, f)
            paths[channel] = Path(component, channel, flight, transfer, np.ones(1), kind)
    return list(paths.values())


def _flight(frequency: NDArray[np.float64], responses: NDArray[np.complex128]) -> float:
    """Mean arrival time in s of all inputs at one microphone, minus a margin: mean of the group delay."""
    peaks = np.abs(responses).max(axis=1)
    audible = peaks > _SILENT * peaks.max()
    scaled = responses[audible] / peaks[audible, None]
    steps = scaled[:, 1:] * scaled[:, :-1].conj()
    # the phase of neighbouring products, weighted by their magnitude and spacing
    delays = -np.angle(steps) / (2.0 * np.pi * np.diff(frequency))
    weights = np.abs(steps) * np.diff(frequency)
    total = weights.sum()
    mean = float((weights * delays).sum() / total) if total > 0.0 else 0.0
    return max(mean - _MARGIN, 0.0)


def _check_spacing(
    table: Table, microphone: int, name: str, response: NDArray[np.complex128], flight: float
) -> None:
    f = table.frequencies
    still = response * np.exp(2j * np.pi * f * flight)
    loud = np.abs(still) > _HEARD * np.abs(still).max()
    turn = np.abs(np.angle(still[1:] * still[:-1].conj())) * (loud[1:] & loud[:-1])
    inside = f[1:] <= BAND[1]
    if np.any(turn[inside] > _TURN):
        k = int(np.argmax(turn * inside))
        raise ValueError(
            f"sound.table_file: frequencies {f[k]:g} and {f[k + 1]:g} Hz are too far apart for {name} at "
            f"microphone {table.microphones[microphone]}: the phase turns by {np.degrees(turn[k]):.0f} deg, "
            f"allowed are {np.degrees(_TURN):.0f}; compute more frequencies there"
        )
