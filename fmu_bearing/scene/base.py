"""Base class of all tables of a scene: frozen, no unknown keys, no silent conversion; the error of scenes."""

from collections.abc import Callable, Iterator
from typing import Annotated, Any, NamedTuple, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

#: Names end up in XML and in plots: letters, digits and a little punctuation, no control characters.
LABEL = r"^[\w.,+()/ -]{1,40}$"
#: Returns the dotted key of a table's value; `problems`, which knows all tables, puts it here.
key_of: list[Callable[[type[BaseModel], str], str | None]] = []
Label = Annotated[str, Field(pattern=LABEL)]


class SceneError(ValueError):
    """A scene cannot be used; the message has one line per problem.

    Examples
    --------
    >>> from fmu_bearing import SceneError, read_scene
    >>> try:
    ...     read_scene("none.toml")
    ... except SceneError as problem:
    ...     print(problem.problems[0])
    none.toml: there is no such scene file
    """

    @property
    def problems(self) -> tuple[str, ...]:
        """The lines of the message."""
        return tuple(str(self).splitlines())


class Conflict(NamedTuple):
    """A value that conflicts with another one; ``key`` is dotted, relative to the table."""

    key: str
    reason: str


class Part(BaseModel):
    """One table of a scene file.

    Strict: a number in quotes or a truth value is refused as a number; a whole number is accepted as any
    number.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse: a scene is frozen, because it was checked as a whole."""
        raise SceneError(_frozen(type(self), name, value))

    def __delattr__(self, name: str) -> None:
        """Refuse, as `__setattr__`."""
        raise SceneError(_frozen(type(self), name, None))

    def conflicts(self) -> Iterator[Conflict]:
        """Yield what does not fit together in this table and those within it."""
        yield from ()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        found = tuple(self.conflicts())
        if found:
            # All at once, so that one run shows every error of a file.
            context: dict[str, Any] = {
                "conflicts": found,
                "text": "; ".join(f"{conflict.key}: {conflict.reason}" for conflict in found),
            }
            raise PydanticCustomError("conflict", "{text}", context)
        return self


def _frozen(model: type[Part], name: str, value: Any) -> str:
    """Return what is written in place of setting an attribute of a scene."""
    shown = repr(value) if isinstance(value, int | float | str | None) else "..."
    key = next((found for of in key_of if (found := of(model, name)) is not None), None)
    pair = "key: value" if key is None else f"{key!r}: {shown}"
    return f"a scene is frozen: scene.replace({{{pair}}}) returns another one"


def below(part: Part, small: str, large: str) -> Iterator[Conflict]:
    """Yield a conflict unless the value at ``small`` is below that at ``large``."""
    limit = getattr(part, large)
    if getattr(part, small) >= limit:
        yield Conflict(small, f"must be below {large} = {limit:g}")
