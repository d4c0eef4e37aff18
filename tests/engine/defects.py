"""Local defects of smooth, made-up tables on bare parameters, and the same law in plain Python."""

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from fmu_bearing.engine.layout import DE, P
from fmu_bearing.prepare.defect_blocks import Placed, block
from fmu_bearing.prepare.defects import Table


def smooth(length=1e-3, touch=1.5e-6, lost=2e-6, deepest=8e-6, places=33, approaches=10):
    """Table of a round valley of a ``length`` (m), deeper behind its middle than before.

    ``touch`` (m): first touch in the middle; ``lost``: more approach, at ``deepest`` approach beyond it. The
    gain is at least 1 - 2 lost / deepest.
    """
    t = np.linspace(-1.0, 1.0, places)
    t = 0.7 * t + 0.3 * t**3  # uneven
    x, e = 0.5 * length * t, deepest * (np.arange(approaches) / (approaches - 1)) ** 2
    shape = (1.0 - t**2) ** 3 * (1.0 + 0.3 * t)
    slope = (0.3 * (1.0 - t**2) ** 3 - 6.0 * t * (1.0 - t**2) ** 2 * (1.0 + 0.3 * t)) / (0.5 * length)
    grown, rate = 2.0 * (e / deepest) - (e / deepest) ** 2, 2.0 * (1.0 - e / deepest) / deepest
    drop = lost * np.outer(shape, grown), lost * np.outer(slope, grown)
    return Table(
        x, e, touch * shape, touch * slope, *drop, lost * np.outer(shape, rate), lost * np.outer(slope, rate),
        0.5 * length,
    )  # fmt: skip


def left(table, delta, x):
    """Approach that a table leaves, by SciPy's splines: along the track, then along the approach."""
    if not table.places[0] < x < table.places[-1]:
        return delta
    e = delta - CubicHermiteSpline(table.places, table.touch, table.touch_x)(x)
    if e <= 0.0:
        return e
    drop = CubicHermiteSpline(table.places, table.drop, table.drop_x)(x)
    drop_e = CubicHermiteSpline(table.places, table.drop_e, table.drop_xe)(x)
    return e - CubicHermiteSpline(table.approaches, drop, drop_e)(min(e, table.approaches[-1]))


def on_race(p, race, table, angle=0.0, number=0, length=1e-3):
    """Place a table on a race at an ``angle`` (rad)."""
    side = -1.0 if race == 0 else 1.0
    radius = p[P.PITCH_RADIUS] + side * 0.5 * p[P.DIAMETER]
    tables = (table, None) if race == 0 else (None, table)
    return Placed(number, race, length, tables, (radius, radius), angle)


def on_ball(p, tables, ball=0, direction=(0.0, 0.0, 1.0), across=(2e-4, 6e-4), number=0, length=1e-3):
    """Place tables, one for each race or None, on a ball; ``direction`` (x, r, theta) at the start."""
    radius = 0.5 * p[P.DIAMETER]
    return Placed(
        number,
        DE.BALL,
        length,
        tables,
        (radius, radius),
        ball=ball,
        direction=direction,
        across=2 * (across,),
    )


def with_defects(p, *placed, **parameters):
    """Parameters with local defects behind all others, and other values of some."""
    longer = np.concatenate([p, block(placed)])
    longer[P.DEFECTS], longer[P.AT_DEFECTS] = len(placed), p.size
    longer[P.BALL_DEFECTS] = sum(one.on == DE.BALL for one in placed)
    for name, value in parameters.items():
        longer[getattr(P, name)] = value
    longer.setflags(write=False)
    return longer


def groove(length, radius, depth=1e-3, nodes=201):
    """Table of a groove of a ``length`` (m) across the whole track, as a rigid ball drops into it.

    ``radius`` (m): effective radius along rolling. The drop has a kink in the middle, where the ball is on
    both edges; its slope there is zero, as if the edges yielded over the last nodes.
    """
    x = 0.5 * length * np.linspace(-1.0, 1.0, nodes)
    inside = 0.5 * length - abs(x)
    touch = inside**2 / (2.0 * radius)
    deep = touch >= depth
    slope = np.where(deep | (x == 0.0), 0.0, -np.sign(x) * inside / radius)
    e = 2e-5 * np.array([0.0, 1.0])
    nothing = np.zeros((nodes, e.size))
    return Table(x, e, np.where(deep, depth, touch), slope, nothing, nothing, nothing, nothing, np.inf)
