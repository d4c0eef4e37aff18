"""The assumed values of a scene, with the remarks of its file."""

from collections.abc import Sequence
from typing import Any

from pydantic import BaseModel

from fmu_bearing.accuracy.sensitivity import ASSUMED, value_at
from fmu_bearing.reports.page.blocks import Table
from fmu_bearing.scene import Scene
from fmu_bearing.scene.origins import Origin
from fmu_bearing.scene.units import symbol

_WORTH = "fmu-bearing sensitivity changes them one by one and shows the effect of each."


def assumed_table(scene: Scene, origins: Sequence[Origin] = ()) -> Table:
    """Table of the values that are assumed by the remarks of the scene's file, or that the papers leave open.

    Parameters
    ----------
    scene : Scene
    origins : sequence of Origin
        Of the file it was read from; empty where there is none.
    """
    if origins:
        marked = [origin for origin in origins if origin.assumed]
        rows = [
            [one.key, _shown(one.value), one.unit, meaning(scene, one.key), one.origin, one.remark]
            for one in marked
        ]
        return Table(
            f"{len(rows)} of {len(origins)} values are assumed",
            ["key", "value", "unit", "what it is", "from", "remark"],
            rows,
            note=f"By the remarks that the scene file and the catalogue carry. {_WORTH}",
            folded=True,
        )
    values = {key: value_at(scene, key) for key in ASSUMED}
    rows = [
        [key, _shown(value), symbol(key.rsplit(".", 1)[-1]), meaning(scene, key)]
        for key, value in values.items()
        if value is not None
    ]
    return Table(
        f"{len(rows)} values that the papers leave open",
        ["key", "value", "unit", "what it is"],
        rows,
        note="This run does not carry its file's remarks: what of these was measured is not known here. "
        + _WORTH,
        folded=True,
    )


def _shown(value: Any) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(str(item) for item in value) or "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.6g}" if isinstance(value, int | float) else str(value)


def meaning(scene: Scene, key: str) -> str:
    """Return the sentence by which the scene's model describes a key, its unit left out."""
    part: Any = scene
    *tables, last = key.split(".")
    for name in tables:
        part = getattr(part, name, None)
    if not isinstance(part, BaseModel) or last not in type(part).model_fields:
        return ""
    sentence = (type(part).model_fields[last].description or "").removesuffix(".")
    unit = symbol(last)
    return sentence.removesuffix(f", {unit}") if unit else sentence
