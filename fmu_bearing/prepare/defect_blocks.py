"""Local defects as the engine's numbers: a head for each, then the tables of the contacts that meet it."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import DE
from fmu_bearing.prepare import fits
from fmu_bearing.prepare.contacts import race_contacts, surfaces
from fmu_bearing.prepare.defect_shapes import Shape
from fmu_bearing.prepare.defects import Table, defect_table, table_file
from fmu_bearing.prepare.surfaces import Patch, frequencies, mean_patches
from fmu_bearing.scene import Scene, SceneError, si
from fmu_bearing.scene.defect import Defect

Real = NDArray[np.float64]
Pair = tuple[float, float]

_ON = {"inner": DE.INNER, "outer": DE.OUTER, "ball": DE.BALL}
#: What the engine's steps have to see of a passage: half of the contact's width and a tenth of the length.
_SEEN, _OF_LENGTH = 0.5, 0.1
_NARROWEST = 2e-5  # m: half-width of a contact for these steps, where a bearing carries nothing as yet
_LIGHTEST = 1.0  # N, assumed for the length of its ellipse
_WHOLE_BALL = 0.5 * math.pi  # rad: a table of a ball's defect ends before


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


def shape(defect: Defect) -> Shape:
    """Shape of a defect of a scene, as `prepare.defect_shapes` has it."""
    kind = {"pit": "ellipse", "dent": "dent"}.get(defect.shape, "rectangle")
    across = math.inf if defect.across_mm is None else 1e-3 * defect.across_mm
    return Shape(
        kind, 1e-3 * defect.along_mm, across, 1e-6 * defect.depth_um, defect.edge,
        1e-6 * (defect.rim_um or 0.0), 1e-3 * (defect.offset_mm or 0.0), defect.turn,
    )  # fmt: skip


def of_scene(scene: Scene, numbers: Sequence[int]) -> list[Placed]:
    """Return the defects of the scene of one bearing, with tables; ``numbers``: theirs in the whole scene.

    Raises
    ------
    SceneError
        For a defect that is too long for its race or ball.
    """
    if scene.imperfections is None or not scene.imperfections.defect:
        return []
    patches = mean_patches(scene)
    given = zip(numbers, scene.imperfections.defect, strict=True)
    return [_placed(scene, number, defect, patches) for number, defect in given]


def missing_tables(scene: Scene) -> dict[str, tuple[Shape, float, float, float]]:
    """Return what tables a scene needs that are not kept: arguments of `defect_table` by the file's name."""
    missing = {}
    for bearing in scene.bearings():
        one = fits.loose(bearing.scene)
        for defect in () if one.imperfections is None else one.imperfections.defect:
            for race in _met(defect):
                given = shape(defect), *surfaces(one, race)
                if not (file := table_file(*given)).exists():
                    missing[file.name] = given
    return missing


def _met(defect: Defect) -> list[int]:
    """Return the races whose contacts meet a defect: 0 inner, 1 outer, of a ball's both."""
    return [race for race in (0, 1) if _ON[defect.on] in (race, DE.BALL)]


def _placed(scene: Scene, number: int, defect: Defect, patches: tuple[Patch, Patch]) -> Placed:
    on, ball = _ON[defect.on], 0.5 * si(scene.bearing).ball_diameter
    own = shape(defect)
    met = _met(defect)
    tables = [defect_table(own, *surfaces(scene, race)) if race in met else None for race in (0, 1)]
    radii = (ball, ball) if on == DE.BALL else (patches[0].radius, patches[1].radius)
    turn = _WHOLE_BALL if on == DE.BALL else math.pi
    for table, radius in zip(tables, radii, strict=True):
        if table is not None and max(-table.places[0], table.places[-1]) >= turn * radius:
            raise SceneError(
                f"{scene.name}: imperfections.defect {number + 1}: {defect.words} acts on "
                f"{1e3 * (table.places[-1] - table.places[0]):.2f} mm of a track of "
                f"{2e3 * math.pi * radius:.2f} mm: give a shorter one"
            )
    tilt = math.radians(defect.tilt_deg or 0.0)
    edges = [(0.0, 0.0) if table is None else _edges(scene, race, table) for race, table in enumerate(tables)]
    return Placed(
        number, on, own.length, (tables[0], tables[1]), radii, defect.angle, (defect.ball or 1) - 1,
        _direction(scene, tilt), (edges[0], edges[1]),
    )  # fmt: skip


def _direction(scene: Scene, tilt: float) -> tuple[float, float, float]:
    """Direction (x, r, theta) of a ball's defect at the start: along the track, a quarter turn from races.

    ``tilt`` (rad): out of the rolling circle, towards +X.
    """
    angle = scene.bearing.nominal_angle
    return math.sin(tilt) * math.cos(angle), -math.sin(tilt) * math.sin(angle), math.cos(tilt)


def _edges(scene: Scene, race: int, table: Table) -> Pair:
    """How far (m) off the track a ball's defect acts wholly and not at all: covering the ellipse, beside it.

    The ellipse is that of the mean load.
    """
    contact = race_contacts(scene)[race]
    least = (_LIGHTEST / contact.stiffness) ** (1.0 / 3.0)
    length = contact.half_length * max(mean_patches(scene)[race].half_width / contact.half_width, least)
    if not math.isfinite(table.across):
        return 1.0, 2.0
    return abs(table.across - length), table.across + length


def pass_rate(scene: Scene, placed: Sequence[Placed]) -> float:
    """Longest internal steps over local defects per rad of the shaft; 0: there are none.

    A step is at most half of the contact's width and a tenth of the defect's length at the speed with which
    the contact goes over it: error control sees a defect only where a stage falls into it.
    """
    rates, ball = frequencies(scene, 2.0 * math.pi), 0.5 * si(scene.bearing).ball_diameter
    patches = mean_patches(scene)
    turning = (rates.f_r - rates.f_c, rates.f_c)  # per turn of the shaft

    def fastest() -> Iterator[float]:
        for one in placed:
            for race, table in enumerate(one.tables):
                if table is not None:
                    speed = rates.f_b * ball if one.on == DE.BALL else turning[race] * patches[race].radius
                    width = 2.0 * max(patches[race].half_width, _NARROWEST)
                    yield abs(speed) / (_SEEN * (width + _OF_LENGTH * one.length))

    return max(fastest(), default=0.0)


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
