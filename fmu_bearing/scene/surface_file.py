"""Files of surfaces: written and read whole, with what is wrong in words."""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomlkit
from numpy.typing import NDArray

from fmu_bearing.file_words import SURFACE, text_of
from fmu_bearing.files import write_whole
from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.imperfections import RACES, Imperfections
from fmu_bearing.scene.surface import Surface
from fmu_bearing.scene.toml_text import parse
from fmu_bearing.scene.values import limits

#: Key of a scene that names such a file.
KEY = "imperfections.surface"
_LONGEST = 10_000_000  # bytes: 100,000 draws
#: Columns of the draws: key in the file, attribute, field of the imperfections whose limits hold, decimals.
_REAL = {
    "race_amplitude_um": ("amplitude_um", "inner_race_amplitude_um"),
    "waviness_exponent": ("exponent", "waviness_exponent"),
    "ball_form_nm": ("ball_form_nm", "ball_form_nm"),
}
_WHOLE = {"seed": "seed", "order_scatter_seed": "order_scatter_seed"}
_OPTIONAL = "order_scatter_seed"
_PER_LINE = 12


def surface_toml(surface: Surface) -> str:
    """Return the file of a surface, its law in the remarks at the top."""
    rows = surface.rows()[1]
    width = max(len(row[0]) for row in rows)
    head = [
        "# Surfaces of a bearing that explain its measured vibration: equally likely draws of their law,",
        '# A_n = A_1 n^-p for both races and the balls. A scene takes the median by surface = "this file"',
        "# in [imperfections]; `fmu-bearing sound --surface` takes the range of levels from the draws.",
        "#",
        f"# {'':{width}}  median   95 %",
        *(f"# {name:{width}}  {median:<8} {around}" for name, median, around in rows),
        "",
        f"bearing = {_text(surface.bearing)}",
        f"measured = {_text(surface.measured)}",
        f"remarks = [{', '.join(map(_text, surface.remarks))}]",
        "",
        "[draws]",
    ]
    for key, (name, _) in _REAL.items():
        head += _array(key, [repr(float(f"{value:.5g}")) for value in getattr(surface, name)])
    for key, name in _WHOLE.items():
        if (values := getattr(surface, name)) is not None:
            head += _array(key, [str(int(value)) for value in values])
    return "\n".join(head) + "\n"


def write_surface(surface: Surface, path: str | os.PathLike[str]) -> Path:
    """Write the file of a surface and return its path.

    Raises
    ------
    OSError
        Where it cannot be written.
    """
    return write_whole(Path(path), surface_toml(surface).encode("utf-8"))


def read_surface(path: str | os.PathLike[str]) -> Surface:
    """Read the file of a surface.

    Raises
    ------
    SceneError
        If the file cannot be read or does not hold a surface, with the key and what is allowed.
    """
    try:
        return _surface(parse(text_of(path, SURFACE, _LONGEST, "file of a surface")))
    except ValueError as problem:
        raise SceneError(f"{path}: {problem}") from None


def fill(flaws: Any, folder: Path) -> str:
    """Put the median law of the file that a table of imperfections names in the place of keys not given.

    Returns a line about a file that is refused, or nothing. ``folder``: from which its name counts. A race
    with harmonics of its own takes none.
    """
    name = flaws.pop(KEY.rpartition(".")[2], None) if isinstance(flaws, dict) else None
    if name is None:
        return ""
    if not isinstance(name, str):
        return f'{KEY} is refused; allowed: the name of a file in quotes, as "surface.toml"'
    try:
        law = read_surface(folder / name).median()
    except SceneError as problem:
        return f"{KEY}: {problem.problems[0]}"
    own = [race for race in RACES if flaws.get(f"{race}_race_harmonic")]
    for key, value in law.items():
        if not any(key.startswith(race) for race in own):
            flaws.setdefault(key, value)
    return ""


def _surface(data: Mapping[str, Any]) -> Surface:
    """Return the surface that tables hold; ``ValueError`` says what is wrong."""
    draws = data.get("draws")
    if not isinstance(draws, Mapping):
        raise ValueError("[draws] is missing: `fmu-bearing vibration --measured` writes such files")
    unknown = {*data} - {"bearing", "measured", "remarks", "draws"} | {f"draws.{key}" for key in draws
                if key not in _REAL and key not in _WHOLE}  # fmt: skip
    if unknown:
        raise ValueError(f"{', '.join(sorted(unknown))}: no key of a surface")
    words = {key: data.get(key, "") for key in ("bearing", "measured")}
    remarks = data.get("remarks", [])
    for key, value in words.items():
        if not isinstance(value, str):
            raise ValueError(f"{key} has to be text")
    if not isinstance(remarks, list) or not all(isinstance(remark, str) for remark in remarks):
        raise ValueError("remarks has to be an array of texts")
    columns = {name: _real(draws, key, field) for key, (name, field) in _REAL.items()}
    whole = {name: _whole(draws, key) for key, name in _WHOLE.items() if key in draws or key != _OPTIONAL}
    count = len(columns["amplitude_um"])
    for name, values in (columns | whole).items():
        if len(values) != count:
            key = next(k for k, of in {**{k: v[0] for k, v in _REAL.items()}, **_WHOLE}.items() if of == name)
            raise ValueError(f"draws.{key} has {len(values)} values, and draws.race_amplitude_um {count}")
    return Surface(
        words["bearing"], words["measured"], columns["amplitude_um"], columns["exponent"],
        columns["ball_form_nm"], whole["seed"], whole.get(_OPTIONAL), tuple(remarks),
    )  # fmt: skip


def _real(draws: Mapping[str, Any], key: str, field: str) -> NDArray[np.float64]:
    low, high = limits(Imperfections.model_fields[field])
    values = _column(draws, key)
    for number, value in enumerate(values, start=1):
        good = isinstance(value, int | float) and not isinstance(value, bool)
        if not (good and low <= value <= high and (value > 0.0 or field == "waviness_exponent")):
            raise ValueError(
                f"draws.{key}: value {number} is {value!r}; allowed: numbers above 0, to {high:g}"
            )
    return np.array(values, dtype=float)


def _whole(draws: Mapping[str, Any], key: str) -> NDArray[np.int64]:
    values = _column(draws, key)
    for number, value in enumerate(values, start=1):
        if not (isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**31):
            raise ValueError(
                f"draws.{key}: value {number} is {value!r}; allowed: whole numbers, 0 to 2147483647"
            )
    return np.array(values, dtype=np.int64)


def _column(draws: Mapping[str, Any], key: str) -> list[Any]:
    values = draws.get(key)
    if not isinstance(values, list) or not values:
        raise ValueError(f"draws.{key} has to be an array of numbers, one per draw")
    return values


def _array(key: str, values: list[str]) -> list[str]:
    lines = [", ".join(values[k : k + _PER_LINE]) for k in range(0, len(values), _PER_LINE)]
    return [f"{key} = [", *(f"    {line}," for line in lines), "]"]


def _text(words: str) -> str:
    return tomlkit.item(words).as_string()
