"""Sections of rings: mass, groove, mesh, and dimensions of which no ring can be made."""

import dataclasses
import math
import re

import numpy as np
import pytest

from fmu_bearing.elastic.section import INNER, OUTER, grid, ring_section
from fmu_bearing.prepare import bodies
from fmu_bearing.scene import read_scene_text, si
from tests.conftest import GATES
from tests.elastic.rings import HOLLOW, RINGS, ring

TEXT = (GATES / "7003C-bare.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize(("name", "body"), RINGS)
def test_grooved_ring_weighs_what_the_engine_moves(name, body, scene):
    section, material = ring(name, body)
    rigid = (bodies.inner_ring if body == INNER else bodies.outer_ring)(scene(name))
    mass = 2.0 * math.pi * material.density * section.moment
    assert mass == pytest.approx(rigid.mass, rel=1e-9)  # the root finder's 1e-12 m


@pytest.mark.parametrize(("name", "body"), RINGS)
def test_unloaded_ball_touches_the_groove_at_the_contact_angle(name, body, scene):
    section, _ = ring(name, body)
    b = si(scene(name).bearing)
    side = -1.0 if body == INNER else 1.0
    place = np.array(section.contact)
    ball = np.array([0.0, b.pitch_diameter / 2.0])
    normal = side * np.array([math.sin(b.contact_angle), math.cos(b.contact_angle)])
    assert place == pytest.approx(ball + b.ball_diameter / 2.0 * normal, abs=1e-15)
    # nowhere does the race reach into the ball
    x = np.linspace(-0.49, 0.49, 801) * b.ball_diameter
    gap = np.hypot(x, section.race(x) - ball[1]) - b.ball_diameter / 2.0
    assert gap.min() > -1e-15
    assert section.race(place[:1])[0] == pytest.approx(place[1], abs=1e-15)


@pytest.mark.parametrize(("name", "body"), RINGS)
def test_moment_of_the_section(name, body):
    section, _ = ring(name, body)
    x = np.linspace(*section.faces, 200_001)
    seat = section.high if body == OUTER else section.low
    by_hand = np.trapezoid(np.abs(seat**2 - section.race(x) ** 2) / 2.0, x)
    assert section.moment == pytest.approx(by_hand, rel=1e-7)  # corners fall between points


@pytest.mark.parametrize(("name", "body"), RINGS)
def test_mesh_follows_the_section(name, body):
    section, _ = ring(name, body)
    made = grid(section)
    x, r = made.mesh.doflocs
    race = section.race(x)
    low, high = (race, section.high) if body == OUTER else (section.low, race)
    assert np.all(r >= low - 1e-15) and np.all(r <= high + 1e-15)
    moment = sum(quadrature(x[corners], r[corners]) for corners in made.mesh.t[:4].T)
    assert moment == pytest.approx(section.moment, rel=3e-3)  # chords instead of arcs


def quadrature(x, r):
    """Integral of r over a polygon."""
    ahead, above = np.roll(x, -1), np.roll(r, -1)
    return abs(np.sum((x * above - ahead * r) * (r + above))) / 6.0


def test_groove_to_the_end_faces():
    section, _ = ring("7003C-bare", OUTER)
    narrow = dataclasses.replace(section, width=2.0e-3)
    first, last = narrow.angles()
    x = narrow.groove.x + narrow.groove.radius * np.sin([first, last])
    assert x == pytest.approx([-1e-3, 1e-3])
    assert grid(narrow).mesh.doflocs[0].max() == pytest.approx(1e-3)


def test_plain_section_meets_its_middle():
    made = grid(HOLLOW, 4)
    assert (made.columns, made.contact) == (4, 4)
    assert HOLLOW.contact == (0.0, HOLLOW.low)
    assert HOLLOW.moment == pytest.approx(0.5 * 0.010 * (0.0175**2 - 0.0148**2))


def variant(**keys):
    """The bare 7003C without cage, other values at keys of its bearing."""
    text = TEXT[: TEXT.index("[bearing.cage]")] + TEXT[TEXT.index("[materials.inner_ring]") :]
    for key, value in keys.items():
        text, count = re.subn(rf"^{key} = .*$", f"{key} = {value}", text, count=1, flags=re.MULTILINE)
        assert count == 1
    return read_scene_text(text)


@pytest.mark.parametrize(
    ("body", "key", "light", "heavy"),
    [
        (INNER, "inner_ring_outer_diameter_mm", 20.5, 25.9),
        (OUTER, "outer_ring_inner_diameter_mm", 31.5, 26.1),
    ],
)
def test_effective_diameter_that_no_grooved_ring_has(body, key, light, heavy):
    for value in (light, heavy):
        with pytest.raises(ValueError, match=rf"bearing\.{key} gives; allowed ") as reported:
            ring_section(variant(**{key: value}), body)
        low, high = map(float, re.search(r"angle: (\S+) to ([\d.]+)", str(reported.value)).groups())
        assert not low <= value <= high
        for inside in (low + 0.01, high - 0.01):  # the message is rounded to four digits
            assert ring_section(variant(**{key: inside}), body).moment > 0.0


def test_ring_too_narrow_for_the_contact():
    with pytest.raises(
        ValueError, match=r"outer ring's width_mm = 1 does not reach the contact.*smaller contact"
    ):
        ring_section(variant(width_mm=1.0), OUTER)


def test_groove_without_a_wall():
    scene = variant(bore_mm=21.4988, inner_conformity=0.6)
    with pytest.raises(ValueError, match="inner ring's groove leaves no wall.*smaller inner_conformity"):
        ring_section(scene, INNER)
