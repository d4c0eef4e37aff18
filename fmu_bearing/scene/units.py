"""Conversion of field units, given in key names, to SI."""

import math
from functools import lru_cache
from types import SimpleNamespace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

_ZERO_CELSIUS = 273.15
#: A number, or an array of them.
Numbers = TypeVar("Numbers", float, NDArray[np.float64])

# Suffix -> (factor, offset): SI = factor * value + offset. The longest suffix that fits wins.
UNITS: dict[str, tuple[float, float]] = {
    "_mm": (1e-3, 0.0), "_um": (1e-6, 0.0), "_nm": (1e-9, 0.0), "_mm2": (1e-6, 0.0),
    "_deg": (math.pi / 180.0, 0.0), "_mrad": (1e-3, 0.0), "_rpm": (math.pi / 30.0, 0.0),
    "_degC": (1.0, _ZERO_CELSIUS), "_K": (1.0, 0.0), "_s": (1.0, 0.0), "_us": (1e-6, 0.0), "_N": (1.0, 0.0),
    "_N_m": (1.0, 0.0), "_N_mm": (1e-3, 0.0), "_N_mm2": (1e6, 0.0), "_N_m_rad": (1.0, 0.0),
    "_N_s_m": (1.0, 0.0), "_g_mm": (1e-6, 0.0), "_kg": (1.0, 0.0), "_kg_m3": (1.0, 0.0),
    "_m_s": (1.0, 0.0), "_W_mK": (1.0, 0.0),
    "_J_kgK": (1.0, 0.0), "_Pa_s": (1.0, 0.0), "_MPa": (1e6, 0.0), "_GPa": (1e9, 0.0), "_1_GPa": (1e-9, 0.0),
    "_1e6_K": (1e-6, 0.0), "_dB": (1.0, 0.0), "_kHz": (1e3, 0.0), "_h": (3600.0, 0.0),
    "_Hz": (1.0, 0.0), "_m_s2": (1.0, 0.0),
}  # fmt: skip
#: Suffixes as messages write them, where taking off the underscore is not enough.
_SYMBOLS = {
    "_rpm": "r/min", "_g_mm": "g mm", "_N_m": "N/m", "_N_mm": "N mm", "_N_mm2": "N/mm2",
    "_N_m_rad": "N m/rad", "_N_s_m": "N s/m", "_kg_m3": "kg/m3", "_m_s": "m/s", "_W_mK": "W/(m K)",
    "_J_kgK": "J/(kg K)",
    "_Pa_s": "Pa s", "_1_GPa": "1/GPa", "_1e6_K": "1e-6/K", "_m_s2": "m/s2",
}  # fmt: skip
_BY_LENGTH = sorted(UNITS, key=len, reverse=True)


def split_unit(key: str) -> tuple[str, str]:
    """Name and unit suffix of a key; the suffix is empty for a key without unit."""
    for suffix in _BY_LENGTH:
        if key.endswith(suffix) and len(key) > len(suffix):
            return key[: -len(suffix)], suffix
    return key, ""


def symbol(key: str) -> str:
    """Return the unit of a key as messages write it; empty for a key without unit."""
    suffix = split_unit(key)[1]
    return _SYMBOLS.get(suffix, suffix.removeprefix("_"))


def convert(value: float, suffix: str) -> float:
    """Return ``value`` in SI units."""
    return scaled(value, *UNITS[suffix])


def scaled(value: Numbers, factor: float, offset: float) -> Numbers:
    """Return ``factor * value + offset`` of a number or an array; decimal prefixes divide.

    20 / 1e6 is the double nearest to 2e-5, 20 * 1e-6 is the one below.
    """
    divisor = float(round(1.0 / factor))
    decimal = divisor > 1.0 and factor == 1.0 / divisor
    return (value / divisor if decimal else value * factor) + offset


def si(part: BaseModel) -> SimpleNamespace:
    """Values of one part of a scene in SI units, unit suffixes stripped: ``bore_mm`` becomes ``bore`` in m.

    Keys without a unit pass through; tables within the part are left as they are, so that each is converted
    by its own call.
    """
    return SimpleNamespace(**_values(part))


@lru_cache(maxsize=256)
def _values(part: BaseModel) -> dict[str, Any]:
    values = {}
    for key in type(part).model_fields:
        name, suffix = split_unit(key)
        value = getattr(part, key)
        values[name] = convert(value, suffix) if suffix and value is not None else value
    return values
