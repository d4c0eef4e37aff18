"""A sweep as a small TOML file, so that it can be made again."""

import os
import pathlib
from typing import Annotated, Any

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
    path = pathlib.Path(path)
    try:
        data = parse(text_of(path, SWEEP, LONGEST))
    except ValueError as problem:
        raise SweepError(f"{path}: {problem}") from None
    try:
        description = Description.model_validate(data)
    except ValidationError as failure:
        raise SweepError("\n".join(dict.fromkeys(f"{path}: {line}" for line in _lines(failure)))) from None
    return description.model_copy(update={"scene": str(path.parent / description.scene)})


def _lines(failure: ValidationError) -> list[str]:
    lines = []
    for error in failure.errors(include_url=False):
        key = ".".join(str(step) for step in error["loc"][:2])
        if error["type"] == "extra_forbidden":
            names = list(Description.model_fields)
            near = nearest(key, names)
            hint = f"did you mean '{near}'?" if near else f"known here: {', '.join(names)}"
            lines.append(f"{key} is not a key of a sweep; {hint}")
        elif error["type"] == "missing":
            lines.append(f"{key} is missing, for example {_EXAMPLES[key]}")
        elif key.startswith("axes."):
            lines.append(f"{key} is refused: an array of values, or text such as '8000:40000:9'")
        else:
            lines.append(f"{key} = {_shown(error['input'])} is refused: {error['msg']}")
    return lines


_EXAMPLES = {"scene": 'scene = "my-scene.toml"', "axes": '[axes] with speed = "8000:40000:9"'}


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 60 else f"{text[:57]}..."
