"""Axes of a sweep: a dotted key of the scene and the values it takes."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface.names import UnknownName, known
from fmu_bearing.scene import Scene
from fmu_bearing.scene.units import symbol
from fmu_bearing.scene.values import fields_of, value_at

#: Short names of frequent axes.
ALIASES = {
    "speed": "operation.speed_rpm", "preload": "mounting.preload_N",
    "pedestal": "mounting.pedestal_stiffness_N_m", "viscosity": "lubricant.viscosity_Pa_s",
    "seed": "imperfections.seed", "fidelity": "fidelity.model",
}  # fmt: skip
#: Dimensions whose name is not the last part of the key.
_NAMES = {"fidelity.model": "fidelity"}
_RANGE = re.compile(r"([^:,]+):([^:,]+):(\d+)(log)?")
_SYNTAX = "KEY=LOW:HIGH:COUNT, KEY=LOW:HIGH:COUNTlog or KEY=VALUE,VALUE,..."


class SweepError(ValueError):
    """A sweep cannot be made; the message has one line per problem."""


@dataclass(frozen=True)
class Axis:
    """One varied key.

    Attributes
    ----------
    key : str
        Dotted key of the scene.
    name : str
        Of the dimension: the key's last part, ``fidelity`` for ``fidelity.model``; the whole key where two
        axes have equal ends.
    values : tuple
        Numbers, texts or truth values, in the key's unit.
    unit, words : str
        Unit and meaning of the key.
    """

    key: str
    name: str
    values: tuple[Any, ...]
    unit: str = ""
    words: str = ""


def parse_axis(text: str) -> tuple[str, list[Any]]:
    """Read an axis as the command line takes it: ``speed=8000:40000:9``, ``fidelity=rings,full``.

    Raises
    ------
    SweepError
        For text that is not an axis.
    """
    key, equals, values = (part.strip() for part in text.partition("="))
    if not (key and equals and values):
        raise SweepError(f"axis '{text}' is refused: write {_SYNTAX}")
    return key, parse_values(key, values)


def parse_values(key: str, text: str) -> list[Any]:
    """Read the values of an axis from text: ``LOW:HIGH:COUNT``, with ``log`` behind it, or a list by commas.

    Raises
    ------
    SweepError
        With the axis and the reason.
    """
    match = _RANGE.fullmatch(text.strip())
    if match is None:
        if ":" in text:
            raise SweepError(f"axis {key} = '{text}' is refused: write {_SYNTAX}")
        return [plain_value(part.strip()) for part in text.split(",")]
    try:
        low, high, count = float(match[1]), float(match[2]), int(match[3])
    except ValueError:
        raise SweepError(f"axis {key} = '{text}' is refused: bounds must be numbers, {_SYNTAX}") from None
    if not (math.isfinite(low) and math.isfinite(high)) or count < 2:
        raise SweepError(f"axis {key} = '{text}' is refused: give finite bounds and 2 or more values")
    if match[4] is None:
        return _round(np.linspace(low, high, count))
    if low <= 0.0 or high <= 0.0:
        raise SweepError(f"axis {key} = '{text}' is refused: logarithmic steps need bounds above 0")
    return _round(np.geomspace(low, high, count))


def _round(values: NDArray[np.float64]) -> list[float]:
    """Return numbers rounded to 12 digits: 2e7 rather than 20000000.000000004."""
    return [float(f"{value:.12g}") for value in values]


def key_of(scene: Scene, name: str) -> str:
    """Return the dotted key that a short name has in a scene; any other name as it is."""
    if name == "preload":
        return scene.assembly.preload_key
    if name == "pedestal":
        return scene.assembly.pedestal_key
    return ALIASES.get(name, name)


def axes_of(scene: Scene, wanted: Mapping[str, Sequence[Any] | str]) -> tuple[Axis, ...]:
    """Return the axes of a sweep of a scene; keys may be short names, values lists or text.

    Raises
    ------
    SweepError
        With a line for each axis that is refused: a key the scene cannot have, no values, or one twice.
    """
    if not wanted:
        raise SweepError(f"a sweep needs an axis: {_SYNTAX}")
    fields = fields_of(scene)
    problems: list[str] = []
    axes: dict[str, list[Any]] = {}
    for given, values in wanted.items():
        key = key_of(scene, given)
        try:
            known(key, [*fields, *ALIASES], "key of a scene")
            listed = _listed(key, values, value_at(scene, key))
        except (UnknownName, SweepError) as problem:
            problems += [line.removeprefix("there is ") for line in str(problem).splitlines()]
            continue
        if key in axes:
            problems.append(f"axis {key} is given twice")
        axes[key] = listed
    if problems:
        raise SweepError("\n".join(problems))
    ends = [_NAMES.get(key, key.rpartition(".")[2]) for key in axes]
    names = [end if ends.count(end) == 1 else key for key, end in zip(axes, ends, strict=True)]
    return tuple(
        Axis(key, name, tuple(values), symbol(key), fields[key].description or "")
        for (key, values), name in zip(axes.items(), names, strict=True)
    )


def _listed(key: str, values: Sequence[Any] | str, present: Any) -> list[Any]:
    """Values of an axis as plain Python; whole numbers where the scene has one."""
    if isinstance(values, str):
        plain = parse_values(key, values)
    elif isinstance(values, Iterable):
        plain = [value.item() if hasattr(value, "item") else value for value in values]
    else:
        raise SweepError(f"axis {key} = {values!r} is refused: give a list of values, or text like {_SYNTAX}")
    odd = [value for value in plain if not isinstance(value, bool | int | float | str)]
    if odd:
        raise SweepError(f"axis {key}: {odd[0]!r} is refused: values are numbers, texts or truth values")
    if isinstance(present, int) and not isinstance(present, bool):
        plain = [int(v) if isinstance(v, float) and v.is_integer() else v for v in plain]
    twice = [value for k, value in enumerate(plain) if value in plain[:k]]
    if twice:
        raise SweepError(f"axis {key}: {twice[0]} is given more than once")
    if not plain:
        raise SweepError(f"axis {key} has no values")
    return plain


def plain_value(text: str) -> Any:
    """Return a number, a truth value or the text itself."""
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
