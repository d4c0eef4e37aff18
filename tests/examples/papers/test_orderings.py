"""Orderings that the papers state, on made-up fields and levels."""

import math

import numpy as np
import pytest

from examples.papers import circles, lines, sound_field
from examples.papers.statements import HOLDS, NOT, UNSEEN


def around(angle, depth=3.0, level=80.0):
    """Result of a run whose whole field is `pattern`."""
    return {"radii": circles.RADII, "places": circles.PLACES, "field": pattern(angle, depth, level)}


def pattern(angle, depth=3.0, level=80.0):
    """Field of circles with lobes at ``angle`` and opposite it, the former louder by 1 dB."""
    a = np.radians(np.array(circles.ANGLES) - angle)
    around = level + depth * np.cos(a) ** 2 + 0.5 * np.cos(a)
    return [[(around + 10 / r - x / 50).tolist() for x in circles.PLACES] for r in circles.RADII]


def test_circle_reads_angles_and_differences():
    c = circles.circle_at(around(210), 210, 50)
    assert c.angle == 210 and c.zone(circles.IMPACT)[1] == 30 and c.zone(circles.FRICTION)[1] == 210
    assert c.zone(circles.FRICTION)[0] - c.zone(circles.IMPACT)[0] == pytest.approx(1.0)
    assert c.dv == pytest.approx(np.ptp(c.levels)) and c.dl == pytest.approx(c.top / c.mean)


def test_orderings_of_the_sound_field_follow_the_field():
    speeds = {3000: 15, 6000: 18, 12000: 36, 18000: 225}
    found = {rpm: around(a, level=60 + rpm / 1000) for rpm, a in speeds.items()}
    judged = {one.statement: one.verdict for one in circles.orderings(found)}
    assert set(circles.REASONS) <= set(judged)
    assert judged["both DA 180 deg apart (within 30)"] == HOLDS
    assert judged["3,000 r/min: zone 0-60 louder than 180-240"] == HOLDS
    assert judged["above: zone 180-240 louder than 0-60"] == NOT  # not yet at 6,000 and 12,000
    assert judged["points 1, 7, 13, 19 louder with every step of speed"] == HOLDS
    assert judged["both DA the same at all r (18,000 r/min)"] == HOLDS
    assert judged["DV grows with r at every l"] == NOT  # the same everywhere
    blind = {one.statement: one.verdict for one in circles.orderings(found, directive=False)}
    assert blind["both DA 180 deg apart (within 30)"] == UNSEEN
    assert blind["points 1, 7, 13, 19 louder with every step of speed"] == HOLDS
    sideways = {rpm: around(300) for rpm in speeds}
    judged = {one.statement: one.verdict for one in circles.orderings(sideways)}
    assert judged["DA of the whole circle in or beside one of the zones (within 15 deg)"] == NOT


def test_load_points_to_its_angle():
    (_, y), (_, z) = sound_field.LOADED
    assert math.hypot(y, z) == pytest.approx(100.0)
    assert math.degrees(math.atan2(-y, z)) % 360.0 == pytest.approx(210.0)


def result(p1, p2, p3, p4, parts, tones):
    levels = {"total": [p1, p2, p3, p4]} | {name: [value] * 4 for name, value in parts.items()}
    return {"levels": levels, "lines": {name: dict(tones) for name in levels}}


def test_orderings_of_the_multi_source_paper_follow_the_levels():
    parts = {"outer_ring": 80.0, "inner_ring": 70.0, "balls": 60.0, "cage": 50.0}
    tones = {"f_r": 40.0, "2 f_r": 10.0, "f_c": 30.0, "f_b": 60.0, "f_i": 50.0, "f_o": 55.0}
    found = {
        rpm: result(80 + up, 70 + up, 81 + up, 75 + up, {k: v + up for k, v in parts.items()}, tones)
        for rpm, up in ((20000, 0.0), (28000, 9.0), (30000, 3.0))
    }
    judged = {one.statement: one.verdict for one in lines.orderings(found)}
    assert set(lines.REASONS) <= set(judged)
    for words in (
        "P2 below P1 at every speed",
        "P4 between P2 and P1",
        "every point loudest at 28,000 r/min",
        "P1: every component loudest at 28,000 r/min",
        "balls: f_b largest",
        "balls: f_o above f_i",
        "inner ring: 2 f_r smallest",
        "P1: balls above cage at every speed",
    ):
        assert judged[words] == HOLDS, words
    for words in ("P3 below P1 at other speeds", "cage: f_c largest", "outer ring: f_o largest"):
        assert judged[words] == NOT, words
