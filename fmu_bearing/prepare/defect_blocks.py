"""Local defects as the engine's numbers: a head for each, then the tables of the contacts that meet it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import DE
from fmu_bearing.prepare.defects import Table

Real = NDArray[np.float64]
Pair = tuple[float, float]


class Placed(NamedTuple):
    """A defect and where it is: what its head in `layout.defect` holds, with the tables themselves."""

    number: int
    on: int
    length: float
    tables: tuple[Table | None, Table | None]
    radii: Pair
    angle: float = 0.0
    ball: int = 0
    direction: tuple[float, float, float] = (0.0, 0.0, 0.0)
    across: tuple[Pair, Pair] = ((0.0, 0.0), (0.0, 0.0))


def block(defects: Sequence[Placed]) -> Real:
    """Heads and tables of the defects of one bearing, for ``p[P.AT_DEFECTS:]``; empty without defects."""
    heads = np.zeros((len(defects), DE.SIZE))
    tables, start = [], heads.size
    for head, one in zip(heads, defects, strict=True):
        head[DE.NUMBER], head[DE.ON] = one.number, one.on
        head[DE.ANGLE], head[DE.LENGTH] = one.angle, one.length
        head[DE.RADIUS : DE.RADIUS + 2] = one.radii
        head[DE.OF_BALL] = one.ball
        head[DE.DIRECTION : DE.DIRECTION + 3] = one.direction
        head[DE.ACROSS : DE.ACROSS + 4] = np.ravel(one.across)
        for race, table in enumerate(one.tables):
            if table is not None:
                head[DE.AT_TABLE + race] = start
                tables.append(rows(table))
                start += tables[-1].size
    return np.concatenate([heads.ravel(), *tables])


def rows(table: Table) -> Real:
    """Numbers of one table, as `layout.defect` places them."""
    count = [float(table.places.size), float(table.approaches.size)]
    touch = np.column_stack([table.touch, table.touch_x])
    drop = np.stack([table.drop, table.drop_x, table.drop_e, table.drop_xe], axis=-1)
    parts = (count, table.places, table.approaches, touch.ravel(), drop.ravel())
    return np.concatenate([np.asarray(part, dtype=float) for part in parts])
