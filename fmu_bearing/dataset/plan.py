"""A data set as a small TOML file: the scene, the classes, what is drawn, what is kept of a run."""

import os
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from fmu_bearing.engine.layout import SD
from fmu_bearing.file_words import DATASET
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.description import read_file

#: Of a draw: one value, of which all are equally likely, or a range as text.
Value = int | float | str | bool
Draw = dict[str, Value | list[Value]]
_FORM = (
    "a key with dots goes in quotes, and has a value, an array of values, or a range as text: "
    '"1000:3000", "-1000:-100log"'
)
_DEFECT = 'a table such as { on = "outer", shape = "pit", length_mm = "0.2:3log" }, or an array of such'
_ROUND = 1e-9  # by which shares may miss 1
RATE = int(SD.RATE)  # Hz: of the samples inside the engine
#: What a data card says where the plan names no licence.
NO_LICENCE = (
    "None is named. The waveforms are computed and hold no measured record; the program that computed them "
    "puts no condition on them. Who publishes the set names a licence: key `licence` of the plan."
)


class Class(BaseModel):
    """Runs with one label.

    Attributes
    ----------
    name : str
    share : float
        Of all runs.
    defect : dict, or list of dict
        Keys of ``[[imperfections.defect]]``, each drawn or fixed; none: as in the scene.
    draw : dict
        Other keys of the scene in this class, over those of the plan.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    name: Annotated[str, Field(min_length=1, max_length=60, pattern=r"^[^\n\r,;\"]+$")]
    share: Annotated[float, Field(gt=0.0, le=1.0)]
    defect: Draw | list[Draw] = []
    draw: Draw = {}

    @property
    def defects(self) -> list[Draw]:
        """Its defects, each by the keys of its table."""
        return [self.defect] if isinstance(self.defect, dict) else self.defect


class Plan(BaseModel):
    """Contents of a plan.

    Attributes
    ----------
    scene : str
        Scene file, relative to the plan.
    runs : int
        Of all classes together.
    length_s, settle_s : float
        Length of a waveform, and what each run leaves out before it.
    rate_Hz : int
        Samples per second of the waveforms.
    seed : int
        Of the draws.
    sizes : int
        Sizes of defects that a class has: runs of one size share the table of its contact.
    sensors : tuple of str
        Names of accelerometers and microphones, or accelerations of rings; empty: all accelerometers, of a
        scene without them all microphones.
    title, licence : str
        For the data card.
    draw : dict
        Keys of the scene that all classes draw.
    classes : tuple of Class
    """

    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, allow_inf_nan=False, populate_by_name=True
    )

    scene: Annotated[str, Field(min_length=1)]
    runs: Annotated[int, Field(ge=1, le=1_000_000)]
    length_s: Annotated[float, Field(ge=0.02, le=100.0)] = 1.0
    settle_s: Annotated[float, Field(ge=0.02, le=100.0)] = 0.1
    rate_Hz: Annotated[int, Field(ge=2000, le=RATE, multiple_of=100)] = 25_600
    seed: Annotated[int, Field(ge=0, le=2**31 - 1)] = 1
    sizes: Annotated[int, Field(ge=1, le=1000)] = 12
    sensors: Annotated[tuple[str, ...], Field(strict=False)] = ()
    title: str = ""
    licence: str = NO_LICENCE
    draw: Draw = {}
    classes: Annotated[tuple[Class, ...], Field(strict=False, min_length=1, max_length=1000, alias="class")]

    def to_toml(self) -> str:
        """Write the plan so that it reads back equal."""
        import tomlkit

        return tomlkit.dumps(self.model_dump(mode="json", by_alias=True, exclude_defaults=True))

    def counts(self) -> list[int]:
        """Return the runs of each class: whole numbers nearest to the shares, with the exact sum."""
        wanted = [one.share * self.runs for one in self.classes]
        counts = [int(number) for number in wanted]
        by_rest = sorted(range(len(wanted)), key=lambda k: (counts[k] - wanted[k], k))
        for k in by_rest[: self.runs - sum(counts)]:
            counts[k] += 1
        return counts


def read_plan(path: str | os.PathLike[str]) -> Plan:
    """Read a plan; the scene's path is then relative to the current folder.

    Raises
    ------
    SweepError
        With a line for each key that is refused, and for shares that do not add up to 1.
    """
    plan = read_file(path, Plan, "a plan", DATASET, _EXAMPLES, _FORMS, {"class": Class})
    problems = []
    total = sum(one.share for one in plan.classes)
    if abs(total - 1.0) > _ROUND:
        problems.append(f"the shares of the classes add up to {total:.6g}: they have to add up to 1")
    names = [one.name for one in plan.classes]
    problems += [
        f"class {name} is there twice: give each class a name" for name in names if names.count(name) > 1
    ]
    empty = [one.name for one, count in zip(plan.classes, plan.counts(), strict=True) if count == 0]
    problems += [f"class {name} has no run: raise its share, or runs = {plan.runs}" for name in empty]
    if problems:
        raise SweepError("\n".join(f"{path}: {line}" for line in dict.fromkeys(problems)))
    return plan


_FORMS: dict[str, str] = {"draw": _FORM, "defect": _DEFECT}
_EXAMPLES: dict[str, Any] = {
    "scene": 'scene = "6205.toml"', "runs": "runs = 1000", "class": '[[class]] with name = "healthy"',
    "name": 'name = "healthy"', "share": "share = 0.25",
}  # fmt: skip
