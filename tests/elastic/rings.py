"""Rings the tests share: exact cases, rings of the gate scenes, and a ring as a curved beam."""

from functools import lru_cache

import numpy as np
from scipy.linalg import eigh

from fmu_bearing.elastic.fourier import Elastic, solid
from fmu_bearing.elastic.modes import elastic
from fmu_bearing.elastic.section import FINENESS, INNER, OUTER, Section, grid, ring_section
from fmu_bearing.scene import read_scene_text
from tests.conftest import GATES

STEEL = Elastic(208e9, 0.3, 7800.0)
HOLLOW = Section(OUTER, 0.0148, 0.0175, 0.010)  # plain hollow cylinder
THIN = Section(OUTER, 0.0495, 0.0505, 0.001)  # mean radius 50 mm, 1 x 1 mm
RINGS = [
    ("7003C-bare", OUTER),
    ("7003C-bare", INNER),
    ("7009C-full-ceramic", OUTER),
    ("7009C-full-ceramic", INNER),
]


def text_with(name, flexure):
    """Text of a gate scene with this table of flexure instead of its own, if any."""
    text = (GATES / f"{name}.toml").read_text(encoding="utf-8")
    head, mark, tail = text.partition("# Standard imperfections")
    head = head.partition("[mounting.flexure]")[0]
    return f"{head}[mounting.flexure]\n{flexure}\n\n{mark}{tail}"


def bent(name, flexure):
    """A gate scene with this table of flexure."""
    return read_scene_text(text_with(name, flexure))


def ring(name, body):
    """Section and material of a ring of a gate scene."""
    scene = bent(name, "")
    material = scene.materials.inner_ring if body == INNER else scene.materials.outer_ring
    return ring_section(scene, body), elastic(material)


@lru_cache(maxsize=8)
def solid_of(name, body, fineness=FINENESS):
    """Matrices of a ring of a gate scene."""
    section, material = ring(name, body)
    return solid(grid(section, fineness), material)


def curved_beam(section, material, order):
    """Lowest in-plane frequency (Hz) of a ring of straight sections that stretch, bend and shear.

    Three equations of Timoshenko's beam on a circle (Love 1927, section 293, with shear and rotary inertia);
    unknowns are radial and tangential motion of the centroid and the turn of the section. Shear coefficient
    of a rectangle after Cowper (1966).
    """
    x = np.linspace(*section.faces, 4001)
    race = section.race(x)
    seat = section.high if section.body == OUTER else section.low
    area = np.trapezoid(np.abs(seat - race), x)
    centroid = np.trapezoid(np.abs(seat**2 - race**2) / 2.0, x) / area
    inertia = np.trapezoid(np.abs((seat - centroid) ** 3 - (race - centroid) ** 3) / 3.0, x)
    nu = material.poisson_ratio
    shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu) * material.shear_modulus * area
    n, r = order, centroid
    strains = np.array([[1.0, n, 0.0], [0.0, 0.0, n], [-n, -1.0, r]]) / r
    e = material.youngs_modulus
    stiffness = strains.T @ np.diag([e * area, e * inertia, shear]) @ strains
    mass = material.density * np.diag([area, area, inertia])
    return np.sqrt(eigh(stiffness, mass, eigvals_only=True)[0]) / (2.0 * np.pi)
