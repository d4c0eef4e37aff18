"""Base class of all tables of a scene: frozen, no unknown keys, no silent conversion; the error of scenes."""

from collections.abc import Iterator
from typing import Annotated, Any, NamedTuple, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError

#: Names end up in XML and in plots: letters, digits and a little punctuation, no control characters.
LABEL = r"^[\w.,+()/ -]{1,40}$"
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
        raise SceneError(
            f"a scene is frozen: scene.replace({{'[TABLE.]{name}': VALUE}}), with the name of the table if "
            "it is in one, returns another one"
        )

    def __delattr__(self, name: str) -> None:
        """Refuse, as `__setattr__`."""
        self.__setattr__(name, None)

    def conflicts(self) -> Iterator[Conflict]:
        """Yield what does not fit together in this table and those within it."""
        yield from ()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        conflicts = tuple(self.conflicts())
        if conflicts:
            # All at once, so that one run shows every error of a file.
            context: dict[str, Any] = {
                "conflicts": conflicts,
                "text": "; ".join(f"{conflict.key}: {conflict.reason}" for conflict in conflicts),
            }
            raise PydanticCustomError("conflict", "{text}", context)
        return self


def below(part: Part, small: str, large: str) -> Iterator[Conflict]:
    """Yield a conflict unless the value at ``small`` is below that at ``large``."""
    limit = getattr(part, large)
    if getattr(part, small) >= limit:
        yield Conflict(small, f"must be below {large} = {limit:g}")
