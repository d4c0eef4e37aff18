"""Tables of the contact over a local defect: what is left of the approach, at places along the track."""

import contextlib
import hashlib
import itertools
import math
import pathlib
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.files import cache_root, read_arrays, whole
from fmu_bearing.prepare.defect_contact import CELLS, BallOverDefect
from fmu_bearing.prepare.defect_shapes import Shape
from fmu_bearing.progress import work
from fmu_bearing.threads import cores, one_thread

Real = NDArray[np.float64]

#: Peak pressure (Pa) of the undamaged contact at the last approach: the static limit of ISO 76.
PRESSURE = 4.2e9
APPROACHES = 16
#: Most places of a table; shapes of one outline take 20 to 50.
PLACES = 128
#: Loads halfway between places, over that of the undamaged contact, above which there is a place.
TOLERANCE = 0.03
_FLOOR = 0.02  # of the last approach: lighter loads are measured by that there
_SOURCES = (
    "prepare/defects.py", "prepare/defect_contact.py", "prepare/defect_shapes.py", "formulas/half_space.py",
    "formulas/hertz.py",
)  # fmt: skip


class Table(NamedTuple):
    """Effective approach of a ball over a defect, bicubic between nodes; SI units.

    A ball whose middle is at x from the middle of the defect, with the approach delta of the undamaged
    contact, stores U = (2/5) K eta^(5/2), with

        e = delta - touch(x),    eta = e - drop(e, x),    no force where e <= 0 or eta <= 0.

    ``touch`` is a cubic Hermite polynomial between ``places``, ``drop`` a bicubic one between ``places`` and
    ``approaches``. Outside of ``places`` both are zero, with slopes zero at both ends. From the last approach
    on ``drop`` keeps its value: its slope along e is zero there. At e = 0 it is zero.

    Attributes
    ----------
    places : array, shape (n,)
        x, ascending, not evenly spaced (m).
    approaches : array, shape (m,)
        e, in even steps of the root: e_k = e_(m-1) (k/(m-1))^2 (m).
    touch, touch_x : array, shape (n,)
        Approach at which a rigid ball touches first (m); its slope along x.
    drop, drop_x, drop_e, drop_xe : array, shape (n, m)
        Approach that is lost beyond it (m), its slopes along x (1) and e (1) and both (1/m).
    across : float
        Half of the width of the shape across the track, its offset included (m).
    """

    places: Real
    approaches: Real
    touch: Real
    touch_x: Real
    drop: Real
    drop_x: Real
    drop_e: Real
    drop_xe: Real
    across: float


@lru_cache(maxsize=32)
def defect_table(shape: Shape, radius_x: float, radius_y: float, modulus: float) -> Table:
    """Table of a defect under a ball: from memory, from disk, or computed now.

    It takes 2 to 20 s of a processor. Tables are kept beside the compiled kernels, in the folder ``defects``
    (`files.cache_root`), for these numbers and this version of the code.

    Parameters
    ----------
    shape : Shape
    radius_x, radius_y : float
        Effective radii of ball and race along and across rolling (m).
    modulus : float
        E' (Pa).

    Raises
    ------
    ValueError
        For a shape that there is not.
    """
    shape.check()
    path = table_file(shape, radius_x, radius_y, modulus)
    kept = _load(path)
    if kept is not None:
        return kept
    across = "the track's width" if math.isinf(shape.width) else f"{1e3 * shape.width:.3g} mm"
    what = f"table of the contact over a defect of {1e3 * shape.length:.3g} mm by {across}, kept for later"
    # how many there will be is not known before
    with work(what, unit="places of some 20 to 50") as one:
        found = computed(shape, radius_x, radius_y, modulus, said=lambda places: one.at(float(places)))
    _save(path, found)
    return found


def table_file(shape: Shape, radius_x: float, radius_y: float, modulus: float) -> pathlib.Path:
    """Return where the table of these numbers is kept, or will be; see `defect_table`."""
    return cache_root() / "defects" / f"{_key(shape, radius_x, radius_y, modulus)}.npz"


def _key(shape: Shape, *numbers: float) -> str:
    """Key (64 hex digits) of a table: what it is for, and the sources that compute it."""
    root = pathlib.Path(__file__).parents[1]
    given = [shape.kind, *(float(one) for one in (*shape[1:], *numbers))]
    hashed = hashlib.sha256(repr(given).encode())
    for name in _SOURCES:
        hashed.update((root / name).read_bytes())
    return hashed.hexdigest()


def _load(path: pathlib.Path) -> Table | None:
    """Return a table that was kept; None where it is absent or damaged."""
    try:
        kept = read_arrays(path)
        found = Table(**kept)._replace(across=float(kept["across"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
    rows, columns = (len(found.places),), (len(found.places), len(found.approaches))
    shapes = [one.shape for one in found[:-1]]
    if shapes != [rows, columns[1:], rows, rows, *[columns] * 4] or len(found.places) < 3:
        return None
    return found if all(np.isfinite(one).all() for one in found[:-1]) else None


def _save(path: pathlib.Path, table: Table) -> None:
    """Keep a table; a cache that cannot be written is no reason to fail."""
    with contextlib.suppress(OSError), whole(path) as file:
        np.savez(file, **table._asdict())


@one_thread  # its places are computed side by side
def computed(
    shape: Shape, radius_x: float, radius_y: float, modulus: float, *,
    approaches: int = APPROACHES, places: int = PLACES, tolerance: float = TOLERANCE,
    cells: tuple[int, int] = CELLS, said: Callable[[int], None] = lambda places: None,
) -> Table:  # fmt: skip
    """Table of a defect, computed now; see `defect_table`.

    Intervals are halved where load or force along the track halfway differ from what the neighbours give by
    more than ``tolerance`` of the load of the undamaged contact, up to a number of ``places``; ``said`` is
    called with the number of them.
    """
    ball = BallOverDefect(shape, radius_x, radius_y, modulus, cells)
    highest = (PRESSURE / ball.hertz.pressure) ** 2
    nodes = highest * (np.arange(approaches) / (approaches - 1.0)) ** 2
    # turned by 180 deg about its middle an ellipse is the same: so is a shape without offset
    even = shape.offset == 0.0 or shape.turn == 0.0
    columns: dict[float, _Column] = {}
    across = ball.extent(highest)[1] + abs(shape.offset)

    def add(wanted: Sequence[float]) -> None:
        for x, column in zip(wanted, pool.map(lambda x: _column(ball, nodes, x), wanted), strict=True):
            columns[x] = column
            if even:
                columns[-x] = column if x == 0.0 else column.mirrored()
            said(len(columns))

    first = [x for x in _first_places(ball, highest) if not even or x <= 0.0]
    wide = list(itertools.pairwise(first))
    finest = 0.1 * ball.hertz.half_width * math.sqrt(highest)
    with ThreadPoolExecutor(cores()) as pool:
        add(first)
        while wide and (free := (places - len(columns)) // (2 if even else 1)) > 0:
            wide = sorted(wide, key=lambda ends: ends[0] - ends[1])[:free]
            before = _table(columns, nodes, across)
            halves = [0.5 * (a + b) for a, b in wide]
            add(halves)
            wrong = [_error(before, columns[x], ball, x) for x in halves]
            wide = [
                part
                for x, (a, b), error in zip(halves, wide, wrong, strict=True)
                if error > tolerance and b - a > finest
                for part in ((a, x), (x, b))
            ]
    return _table(columns, nodes, across)


class _Column(NamedTuple):
    """Values of a table at one place: touch and its slope, rows along e."""

    touch: float
    touch_x: float
    drop: Real
    drop_x: Real
    drop_e: Real

    def mirrored(self) -> "_Column":
        return self._replace(touch_x=-self.touch_x, drop_x=-self.drop_x)


def _column(ball: BallOverDefect, nodes: Real, x: float) -> _Column:
    """Solve the contact at one place for all approaches."""
    near = 1e-2 * ball.hertz.half_width * math.sqrt(nodes[1])
    touch = ball.touch(x)
    touch_x = (ball.touch(x + near) - ball.touch(x - near)) / (2.0 * near)
    drop, drop_x, drop_e = (np.zeros(len(nodes)) for _ in range(3))
    for k, e in enumerate(nodes[1:], 1):
        left, rate, along = effective(ball, touch + e, x)
        drop[k], drop_e[k], drop_x[k] = e - left, 1.0 - rate, -(along + rate * touch_x)
    # at the first touch the slope with which the cubic has the right value where the root is half way
    quarter = 0.25 * nodes[1] - effective(ball, touch + 0.25 * nodes[1], x)[0]
    value, _ = hermite(0.25, nodes[1])
    drop_e[0] = min(1.0, (quarter - value[1] * drop[1] - value[3] * drop_e[1]) / value[2])
    drop_e[-1] = 0.0
    return _Column(touch, touch_x, drop, drop_x, drop_e)


def effective(ball: BallOverDefect, delta: float, x: float) -> tuple[float, float, float]:
    """Effective approach (m) of a contact that is solved, and its slopes along approach and place."""
    found = ball.carried(delta, x)
    if found.energy <= 0.0:
        return 0.0, 0.0, 0.0
    left = (2.5 * found.energy / ball.hertz.stiffness) ** 0.4
    force = ball.hertz.stiffness * left**1.5
    return left, found.load / force, found.slope / force


def _first_places(ball: BallOverDefect, highest: float) -> list[float]:
    """Places to begin with: ends, edges, where a ball touches the bottom, and some between."""
    half, end = ball.extent(highest)[0], ball.reach(highest)
    inside = half - math.sqrt(2.0 * ball.rx * ball.shape.depth)
    found = {0.0, half, end, 0.5 * (half + end), 0.5 * half}
    if inside > 0.0:
        found |= {inside, 0.5 * (inside + half)}
    width = 0.5 * (end - half)
    found |= {half - width} if half > width else set()
    ordered = sorted(found)
    apart = [ordered[0]]
    for x in ordered[1:]:
        if x - apart[-1] > 0.1 * width:
            apart.append(x)
    apart[-1] = end
    return [-x for x in reversed(apart[1:])] + apart


def _table(columns: dict[float, _Column], nodes: Real, across: float) -> Table:
    """Put columns into a table; both ends join the undamaged race."""
    places = np.array(sorted(columns))
    ordered = [columns[x] for x in places]
    touch, touch_x = (np.array([getattr(one, name) for one in ordered]) for name in ("touch", "touch_x"))
    drop, drop_x, drop_e = (
        np.array([getattr(one, name) for one in ordered]) for name in ("drop", "drop_x", "drop_e")
    )
    for rows in (touch, touch_x, drop, drop_x, drop_e):
        rows[0] = rows[-1] = 0.0
    drop_xe = np.zeros_like(drop)
    drop_xe[1:-1] = _slopes(places, drop_e)
    return Table(places, nodes, touch, touch_x, drop, drop_x, drop_e, drop_xe, across)


def _slopes(x: Real, rows: Real) -> Real:
    """Slopes of rows along x at the inner nodes, of the parabola through both neighbours."""
    step = np.diff(x)[:, None]
    secant = np.diff(rows, axis=0) / step
    return (secant[:-1] * step[1:] + secant[1:] * step[:-1]) / (step[1:] + step[:-1])


def _error(table: Table, column: _Column, ball: BallOverDefect, x: float) -> float:
    """Largest error of load and force along the track at a place, over the load of the undamaged contact."""
    worst, least = 0.0, _FLOOR * table.approaches[-1]
    for k, e in enumerate(table.approaches[1:-1], 1):
        delta = column.touch + e
        load = max(delta, least) ** 1.5
        left, rate, along = eta(table, delta, x)
        there = e - column.drop[k]
        rate_there = 1.0 - column.drop_e[k]
        along_there = -(column.touch_x * rate_there + column.drop_x[k])
        wrong = left**1.5 * rate - there**1.5 * rate_there
        aside = left**1.5 * along - there**1.5 * along_there
        # forces along the track are loads times an angle, of half a width over the radius
        angle = ball.hertz.half_width * math.sqrt(max(delta, least)) / ball.rx
        worst = max(worst, abs(wrong) / load, abs(aside) / (load * angle))
    return worst


def eta(table: Table, delta: float, x: float, scale: float = 1.0) -> tuple[float, float, float]:
    """Effective approach (m) at approach and place (m), with its slopes along both.

    A defect of another scale has s zeta(delta/s, x), zeta = delta - eta: depths grow, lengths do not.
    No force: three zeros.
    """
    if scale <= 0.0 or not table.places[0] < x < table.places[-1]:
        return (delta, 1.0, 0.0) if delta > 0.0 else (0.0, 0.0, 0.0)
    i = int(np.searchsorted(table.places, x, side="right")) - 1
    step = table.places[i + 1] - table.places[i]
    cubic, slope = hermite((x - table.places[i]) / step, step)
    touch, touch_x = (float(one @ _ends(table.touch, table.touch_x, i)) for one in (cubic, slope))
    e = delta / scale - touch
    if e <= 0.0:
        return 0.0, 0.0, 0.0
    last = len(table.approaches) - 1
    if e >= table.approaches[last]:
        values = _ends(table.drop[:, last], table.drop_x[:, last], i)
        drop, drop_x, drop_e = float(cubic @ values), float(slope @ values), 0.0
    else:
        k = min(int(last * np.sqrt(e / table.approaches[last])), last - 1)
        width = table.approaches[k + 1] - table.approaches[k]
        along, along_e = hermite((e - table.approaches[k]) / width, width)
        # rows: value and slope along x at both places; columns: value and slope along e at both approaches
        block = np.empty((4, 4))
        for j in (0, 1):
            block[:, j] = _ends(table.drop[:, k + j], table.drop_x[:, k + j], i)
            block[:, 2 + j] = _ends(table.drop_e[:, k + j], table.drop_xe[:, k + j], i)
        drop, drop_x = float(cubic @ block @ along), float(slope @ block @ along)
        drop_e = float(cubic @ block @ along_e)
    left = e - drop
    if left <= 0.0:
        return 0.0, 0.0, 0.0
    return scale * left, 1.0 - drop_e, -scale * (touch_x * (1.0 - drop_e) + drop_x)


def hermite(t: float, step: float) -> tuple[Real, Real]:
    """Weights of both values, then of both slopes, at t from 0 to 1 of a step; those of the slope there."""
    value = [(1.0 + 2.0 * t) * (1.0 - t) ** 2, t**2 * (3.0 - 2.0 * t)]
    value += [step * t * (1.0 - t) ** 2, -step * t**2 * (1.0 - t)]
    rate = 6.0 * t * (1.0 - t) / step
    return np.array(value), np.array([-rate, rate, (1.0 - t) * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)])


def _ends(values: Real, slopes: Real, i: int) -> Real:
    """Values, then slopes, at both ends of interval i."""
    return np.array([values[i], values[i + 1], slopes[i], slopes[i + 1]])
