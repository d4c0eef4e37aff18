"""Which values of a scene are assumed, and what its file says about them."""

from typing import Any

from pydantic import BaseModel

from fmu_bearing.scene import Scene
from fmu_bearing.scene.units import split_unit, symbol
from fmu_bearing.study.report.blocks import Table
from fmu_bearing.study.sensitivity import ASSUMED, value_at

_MARK = "assumed"


def assumed_table(scene: Scene, text: str = "") -> Table:
    """Values that the papers leave open, with what the scene file remarks; ``text``: that file."""
    remarks = remarks_of(text)
    rows = []
    for key in ASSUMED:
        value = value_at(scene, key)
        if value is None:
            continue
        rows.append(
            [
                key,
                _shown(value),
                symbol(key.rsplit(".", 1)[-1]),
                meaning(scene, key),
                _remark(key, remarks, text),
            ]
        )
    marked = sum(1 for row in rows if row[4].startswith(_MARK))
    said = (
        f" The scene file marks {marked} of them as assumed; one without the mark has a value of your own."
        if text
        else ""
    )
    return Table(
        f"{len(rows)} values that neither paper nor data sheet gives",
        ["key", "value", "unit", "what it is", "the file says" if text else "in the catalogue"],
        rows,
        note="What each of them is worth is told by fmu-bearing sensitivity, which moves them one by one."
        + said,
        folded=True,
    )


def _shown(value: Any) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(str(item) for item in value) or "none"
    return f"{value:.6g}" if isinstance(value, int | float) else str(value)


def _remark(key: str, remarks: dict[str, str], text: str) -> str:
    if not text:
        return _MARK
    *tables, _ = key.split(".")
    return remarks.get(key) or remarks.get(".".join(tables)) or "not marked"


def meaning(scene: Scene, key: str) -> str:
    """Return the sentence by which the scene's model describes a key, its unit left out."""
    part: Any = scene
    *tables, last = key.split(".")
    for name in tables:
        part = getattr(part, name)
    field = type(part).model_fields[last] if isinstance(part, BaseModel) else None
    sentence = (field.description or "") if field is not None else ""
    unit = symbol(last) if split_unit(last)[1] else ""
    return sentence.removesuffix(f", {unit}.").removesuffix(".") if unit else sentence.removesuffix(".")


def remarks_of(text: str) -> dict[str, str]:
    """Return remarks with the word *assumed* behind keys and tables of a TOML text, by dotted name.

    One on a line of its own belongs to the table that follows.
    """
    found: dict[str, str] = {}
    table, above = "", ""
    for line in text.splitlines():
        code, _, remark = line.partition("#")  # keys of scenes hold no number signs, and names may not
        code, remark = code.strip(), remark.strip()
        marked = remark if _MARK in remark else ""
        if not code:
            above = marked if remark else ""
            continue
        if code.startswith("["):
            table = code.strip("[] ")
            if marked or above:
                found[table] = _tidy(marked or above)
        elif "=" in code and marked:
            found[f"{table}.{code.partition('=')[0].strip()}".lstrip(".")] = _tidy(marked)
        above = ""
    return found


def _tidy(remark: str) -> str:
    """Put the word first, as far as it is not."""
    return remark if remark.startswith(_MARK) else f"{_MARK}: {remark}"
