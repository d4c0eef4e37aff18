"""Rows of the tables of a comparison: a value of A beside that of B."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene.units import symbol


def _dashed(form: str) -> Callable[[float | None], str]:
    """Return what writes a number in a format, and a dash where there is none."""
    return lambda value: "-" if value is None or math.isnan(value) else f"{value:{form}}"


def _value(value: Any) -> str:
    return "-" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


def _pair(key: str, unit: str) -> tuple[Quantity, ...]:
    """Return a level of A, that of B, and the difference."""
    a, b = f"a_{key}", f"b_{key}"
    return (
        Quantity(f"{a} [{unit}]", f"A, {unit}", _dashed(".1f")),
        Quantity(f"{b} [{unit}]", f"B, {unit}", _dashed(".1f")),
        Quantity(
            f"{key}_change [{unit}]", f"B - A, {unit}", _dashed("+.1f"),
            of=lambda row: getattr(row, b) - getattr(row, a),
        ),
    )  # fmt: skip


@dataclass(frozen=True)
class KeyPair(Result):
    """A key of the scene that differs; None where a scene has no such key."""

    quantities = (
        Quantity("key", "key of the scene"), Quantity("a", "A", _value), Quantity("b", "B", _value),
        Quantity("unit", "unit", of=lambda row: symbol(row.key.rpartition(".")[2])),
    )  # fmt: skip

    key: str
    a: Any
    b: Any


@dataclass(frozen=True)
class LevelPair(Result):
    """Levels (dB and dB(A)) at a microphone; NaN where one is missing."""

    quantities = (Quantity("microphone", "microphone"), *_pair("leq", "dB"), *_pair("laeq", "dB(A)"))

    microphone: str
    a_leq: float
    a_laeq: float
    b_leq: float
    b_laeq: float


@dataclass(frozen=True)
class BandPair(Result):
    """Levels (dB) of a third octave, by its nominal centre (Hz); NaN where one is missing."""

    quantities = (Quantity("band_Hz", "band, Hz", "g"), *_pair("level", "dB"))

    band: float
    a_level: float
    b_level: float


@dataclass(frozen=True)
class FigurePair(Result):
    """Means of a variable, in the unit of tables; NaN where one is missing."""

    quantities = (
        Quantity("figure", "mean of"), Quantity("unit", "unit"), Quantity("a", "A", _dashed(".4g")),
        Quantity("b", "B", _dashed(".4g")),
        Quantity("change", "B - A", _dashed("+.3g"), of=lambda row: row.b - row.a),
        Quantity("share [1]", "%", _dashed("+.1f"), 100.0,
                 of=lambda row: row.b / row.a - 1.0 if row.a else None),
    )  # fmt: skip

    figure: str
    unit: str
    a: float
    b: float
