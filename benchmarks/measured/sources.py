"""Values that others measured or printed, each with its source."""

import csv
import functools
import tomllib
from dataclasses import dataclass
from pathlib import Path

from fmu_bearing.scene.nsk import CLASSES, PREFIX, sizes

FOLDER = Path(__file__).parent
STEEL, CERAMIC = "steel", "Si3N4"
#: TPI's size whose C0 (2.64 kN) is not that of NSK's balls (2.90 kN): its balls are not known.
OTHER_BALLS = "7001"
NAN = float("nan")


@dataclass(frozen=True)
class Source:
    """A document or a set of recordings.

    ``kind``: measured, printed or a rule; ``work``: what it is, with pages; ``repository``: where it was
    read; ``given``: what it says of the condition; ``assumed``: what had to be assumed beside that.
    """

    kind: str
    work: str
    repository: str
    given: str
    assumed: str


@dataclass(frozen=True)
class Value:
    """A number that others give; units are in the names, NaN where the source has none.

    ``published_to``: upper end of a range, else NaN; ``grade``: preload class or class of vibration.
    """

    source: str
    place: str
    quantity: str
    bearing: str
    balls: str
    angle_deg: float
    grade: str
    load_N: float
    measuring_load_N: float
    speed_rpm: float
    viscosity_mm2_s: float
    shaft_Hz: float
    unit: str
    published: float
    published_to: float
    remark: str


@functools.cache
def sources() -> dict[str, Source]:
    """Return all sources by their key."""
    tables = tomllib.loads((FOLDER / "sources.toml").read_text("utf-8"))
    return {key: Source(**table) for key, table in tables.items()}


@functools.cache
def values() -> tuple[Value, ...]:
    """Return all values: those of ``values.csv``, and NSK's, which the package's catalogue has."""
    with (FOLDER / "values.csv").open(encoding="utf-8", newline="") as file:
        return (*map(_value, csv.DictReader(file)), *_nsk())


def of(source: str, quantity: str = "") -> list[Value]:
    """Return the values of a source whose quantity begins with a word."""
    return [one for one in values() if one.source == source and one.quantity.startswith(quantity)]


def _value(row: dict[str, str]) -> Value:
    words = {"source", "place", "quantity", "bearing", "balls", "unit", "remark"}
    given = {key: text if key in words else float(text or NAN) for key, text in row.items() if key != "class"}
    return Value(grade=row["class"], **given)


def _nsk():
    for size in sizes().values():
        for name, one in size.preload.items():
            yield Value(
                "nsk", "pages 156 to 159", "pair axial stiffness", size.name.removeprefix(PREFIX), STEEL,
                size.angle, CLASSES[name], one.force, NAN, NAN, NAN, NAN, "N/um", one.pair_stiffness, NAN, "",
            )  # fmt: skip
