"""A sweep as a small TOML file, so that it can be made again."""

import os
import pathlib
from collections.abc import Mapping
from typing import Annotated, Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fmu_bearing.file_words import SWEEP, text_of
from fmu_bearing.files import read_text
from fmu_bearing.likeness import nearest
from fmu_bearing.scene.toml_text import LONGEST, parse
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.plan import SETTLE, WINDOW

Value = int | float | str | bool


class Description(BaseModel):
    """Contents of a sweep file.

    Attributes
    ----------
    scene : str
        Scene file, relative to the sweep file.
    axes : dict
        Values by dotted key of the scene: an array, or text as on the command line.
    figures : tuple of str, optional
        Variables to keep; default: `figures.DEFAULT`.
    settle_s, window_s : float
        Time left out, and over which figures are taken.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    scene: Annotated[str, Field(min_length=1)]
    axes: Annotated[dict[str, str | list[Value]], Field(min_length=1)]
    figures: Annotated[tuple[str, ...] | None, Field(strict=False)] = None
    settle_s: Annotated[float, Field(ge=0.0, le=1e3)] = SETTLE
    window_s: Annotated[float, Field(ge=1e-3, le=1e3)] = WINDOW

    def to_toml(self) -> str:
        """Write the description so that it reads back equal."""
        import tomlkit

        return tomlkit.dumps(self.model_dump(mode="json", exclude_none=True))


def is_description(path: str | os.PathLike[str]) -> bool:
    """Whether a file holds a sweep rather than a scene: it names a scene, or axes."""
    try:
        data = parse(read_text(path, LONGEST))
    except (OSError, ValueError):
        return False  # reading it as a scene reports what is wrong
    return "axes" in data or isinstance(data.get("scene"), str)


def read_description(path: str | os.PathLike[str]) -> Description:
    """Read a sweep file; the scene's path is then relative to the current folder.

    Raises
    ------
    SweepError
        With a line for each key that is refused.
    """
    return read_file(path, Description, "a sweep", SWEEP, _EXAMPLES, {"axes.": _VALUES})


File = TypeVar("File", bound=BaseModel)


def read_file(
    path: str | os.PathLike[str], model: type[File], what: str, due: str, examples: Mapping[str, str],
    forms: Mapping[str, str], tables: Mapping[str, type[BaseModel]] | None = None,
) -> File:  # fmt: skip
    """Read a file that names a scene; the scene's path is then relative to the current folder.

    Parameters
    ----------
    what, due : str
        What it is, in messages, and as `file_words` names it.
    examples : mapping
        Of keys that may be missing.
    forms : mapping
        By the beginning of a key: what its value may be.
    tables : mapping, optional
        Models of arrays of tables by their key.

    Raises
    ------
    SweepError
        With a line for each key that is refused.
    """
    path = pathlib.Path(path)
    try:
        data = parse(text_of(path, due, LONGEST))
    except ValueError as problem:
        raise SweepError(f"{path}: {problem}") from None
    try:
        made = model.model_validate(data)
    except ValidationError as failure:
        lines = [_line(error, model, what, examples, forms, tables or {}) for error in failure.errors()]
        raise SweepError("\n".join(dict.fromkeys(f"{path}: {line}" for line in lines))) from None
    return made.model_copy(update={"scene": str(path.parent / getattr(made, "scene"))})  # noqa: B009


def _line(
    error: Any, model: type[BaseModel], what: str, examples: Mapping[str, str], forms: Mapping[str, str],
    tables: Mapping[str, type[BaseModel]],
) -> str:  # fmt: skip
    """Say in one line what is wrong with a key."""
    first, *rest = error["loc"]
    inside = first in tables and len(rest) > 1
    key = f"{first}[{rest[0] + 1}].{rest[1]}" if inside else ".".join(str(s) for s in error["loc"][:2])
    last = str(rest[1]) if inside else str(first)
    if error["type"] == "extra_forbidden":
        names = [
            field.alias or name for name, field in (tables[first] if inside else model).model_fields.items()
        ]
        near = nearest(last, names)
        hint = f"did you mean '{near}'?" if near else f"known here: {', '.join(names)}"
        return f"{key} is not a key of {what}; {hint}"
    if error["type"] == "missing":
        return f"{key} is missing, for example {examples[last]}"
    form = next((words for start, words in forms.items() if key.startswith(start) or last == start), None)
    if form is not None:
        return f"{key} is refused: {form}"
    return f"{key} = {_shown(error['input'])} is refused: {error['msg']}"


_EXAMPLES = {"scene": 'scene = "my-scene.toml"', "axes": '[axes] with speed = "8000:40000:9"'}
_VALUES = "an array of values, or text such as '8000:40000:9'"


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 60 else f"{text[:57]}..."
