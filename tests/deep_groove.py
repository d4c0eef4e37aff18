"""Deep groove bearings of tests: one given by its grooves, and rest by ISO/TS 16281 as an oracle.

The oracle shares the Hertzian contact (`formulas.hertz`, which has an oracle of its own) and nothing of the
engine: SciPy finds where three equations of rings at rest balance.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import root

from fmu_bearing import Scene
from fmu_bearing.formulas.hertz import effective_modulus, point_contact

#: Elastic constants of the published comparison (Pa).
STEEL = 210e9, 0.3


@dataclass(frozen=True)
class Size:
    """Balls, their diameter and that of their circle, conformities inner and outer, clearance (mm)."""

    balls: int
    ball: float
    pitch: float
    inner: float
    outer: float
    clearance: float


#: Of the published comparison; its clearance is 0 or 10 um.
PUBLISHED = Size(7, 11.5, 43.5, 0.52, 0.53, 0.0)


def scene_of(size, axial=0.0, radial=0.0, rpm=1.0, across=0.0, fit=None, temperatures=(20.0, 20.0)):
    """Return a scene with a deep groove bearing of a size, loads (N) along X, upwards and along Y, no weight.

    Rings are thick and the pedestal is stiff: the rings move against each other alone. No cage and no
    traction: at rest they carry nothing.
    """
    wall = 0.6 * size.ball
    bore, outside = size.pitch - 2.6 * size.ball, size.pitch + 2.6 * size.ball
    steel = {
        "youngs_modulus_GPa": 1e-9 * STEEL[0], "poisson_ratio": STEEL[1], "density_kg_m3": 7800.0,
        "expansion_1e6_K": 11.8,
    }  # fmt: skip
    mounting = {
        "preload_N": axial, "radial_load_z_N": radial, "radial_load_y_N": across,
        "pedestal_stiffness_N_m": 1e12, "pedestal_rotational_ratio_mm2": 1e6,
    }  # fmt: skip
    if fit is not None:
        mounting["fit"] = fit
    return Scene.from_dict({
        "name": "deep-groove",
        "bearing": {
            "kind": "deep-groove", "designation": "own", "bore_mm": bore, "outside_diameter_mm": outside,
            "width_mm": 1.5 * size.ball, "pitch_diameter_mm": size.pitch, "ball_diameter_mm": size.ball,
            "ball_count": size.balls, "radial_clearance_um": 1e3 * size.clearance,
            "inner_conformity": size.inner, "outer_conformity": size.outer,
            "inner_ring_outer_diameter_mm": size.pitch - wall,
            "outer_ring_inner_diameter_mm": size.pitch + wall, "contact_damping_us": 2.5,
            "race_roughness_um": 0.02, "ball_roughness_um": 0.01,
        },
        "materials": {"inner_ring": steel, "outer_ring": steel, "balls": steel},
        "lubricant": {"catalogue": "spindle-oil", "traction_max": 0.0},
        "mounting": mounting,
        "operation": {
            "speed_rpm": rpm, "oil_temperature_degC": 20.0,
            "inner_ring_temperature_degC": temperatures[0], "outer_ring_temperature_degC": temperatures[1],
        },
        "fidelity": {"model": "full", "terms": {"gravity": False}},
    })  # fmt: skip


def at_rest(size, axial, radial, standard=False):
    """Return where the inner ring rests: axial and radial place (mm) and tilt (rad); loads (N) of the balls.

    Balls keep their places around the bearing, and ball 0 is where the radial load points; ``axial``: from
    the middle. ``standard``: by the equations of ISO/TS 16281, whose moment leaves out that radial forces of
    a tilted ring act beside its centre (a hundredth of the places under both loads).
    """
    modulus = effective_modulus(*STEEL, *STEEL)
    g = size.ball / size.pitch
    compliance = 0.0
    for conformity, curvature in ((size.inner, g / (1.0 - g)), (size.outer, -g / (1.0 + g))):
        along = 0.5e-3 * size.ball / (1.0 + curvature)
        contact = point_contact(along, 1e-3 * size.ball / (2.0 - 1.0 / conformity), modulus)
        compliance += (contact.stiffness * 1e-3**1.5) ** (-2.0 / 3.0)
    stiffness = compliance**-1.5
    free = (size.inner + size.outer - 1.0) * size.ball
    drawn = free - 0.5 * size.clearance
    arm = 0.5 * size.pitch + (size.inner - 0.5) * size.ball - 0.25 * size.clearance
    cosine = np.cos(2.0 * np.pi * np.arange(size.balls) / size.balls)

    def balls(x):
        across, along = drawn + x[0] * cosine, x[1] + arm * np.sin(x[2]) * cosine
        if not standard:
            across -= arm * (1.0 - math.cos(x[2])) * cosine**2
        length = np.hypot(across, along)
        return stiffness * np.maximum(length - free, 0.0) ** 1.5, across / length, along / length

    def out_of_balance(x):
        x = 1e-3 * x
        load, c, s = balls(x)
        moment = (load * s * cosine).sum()
        if not standard:
            moment -= (load * c * cosine**2).sum() * math.sin(x[2])
        return [radial - (load * c * cosine).sum(), axial - (load * s).sum(), 0.1 * arm * moment]

    touching = math.sqrt(max(free**2 - drawn**2, 0.0))
    sign = math.copysign(1.0, axial) if axial else 0.0
    for radially, beyond, tilt in (
        (20.0, 60.0, -1.0),
        (10.0, 10.0, 0.0),
        (5.0, 1.0, 0.0),
        (30.0, 100.0, -3.0),
    ):
        first = [math.copysign(radially, radial), sign * (1e3 * touching + beyond), sign * tilt]
        found = root(out_of_balance, first, tol=1e-13)
        if np.abs(found.fun).max() < 1e-6 * (1.0 + abs(axial) + abs(radial)):
            x = 1e-3 * found.x
            return x[1], x[0], x[2], balls(x)[0]
    raise AssertionError(f"no rest of {size} at {axial} N along and {radial} N across")
