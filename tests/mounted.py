"""Bearings with fits: gate scenes in other materials, their quasi-static places and preloads, an oracle's."""

import math

import numpy as np
from scipy.optimize import brentq

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.layout import ST, C, P, U, W
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.statics.rigid_preload import cold_place, place_under
from fmu_bearing.engine.status import OK
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import read_scene
from tests.conftest import GATES
from tests.oracles import Bearing
from tests.oracles.jones_harris import JonesHarris

STEEL, CERAMIC = "GCr15", "Si3N4"
HELD = 1e12  # N/m: a pedestal that does not give way


def mounted(
    fit, rpm=0.0, name="7003C-bare", rings=STEEL, balls=STEEL, load=150.0, warm=(20.0, 20.0), flawed=False,
    **more,
):  # fmt: skip
    """Return a silent gate scene of rigid rings with a rigid preload (N) and a fit, None: as drawn.

    ``warm``: inner and outer ring (degC), oil as the outer one; ``flawed``: with its imperfections;
    ``more``: other values by key, with two underscores in the place of dots.
    """
    changes = {
        "materials.inner_ring": rings,
        "materials.outer_ring": rings,
        "materials.balls": balls,
        "mounting.preload_N": load,
        "mounting.preload_mode": "rigid",
        "mounting.pedestal_stiffness_N_m": HELD,
        "operation.speed_rpm": rpm,
        "operation.inner_ring_temperature_degC": warm[0],
        "operation.outer_ring_temperature_degC": warm[1],
        "operation.oil_temperature_degC": warm[1],
    }
    if fit is not None:
        changes["mounting.fit"] = {"preload": "unmounted"} | fit
    changes |= {key.replace("__", "."): value for key, value in more.items()}
    quiet = {"sound": None} | ({} if flawed else {"imperfections": None})
    return read_scene(GATES / f"{name}.toml").with_rigid_rings().model_copy(update=quiet).replace(changes)


def own_bearing(scene, growth):
    """The bearing at temperatures of its rings, races moved by ``growth`` (m): an oracle's, and its zero.

    The oracle is brought to the same groove circles by its pitch, angle and conformities. Zero (m): what is
    added to a place of its inner ring, which counts from balls that just touch, for one from the drawing.
    """
    b, m, o = scene.bearing, scene.materials, scene.operation
    rises = [getattr(o, f"{ring}_ring_temperature_degC") - 20.0 for ring in ("inner", "outer")]
    warm = [1.0 + 1e-6 * m.inner_ring.expansion_1e6_K * rise for rise in rises]
    drawn = 1e-3 * b.ball_diameter_mm
    ball = drawn * (1.0 + 1e-6 * m.balls.expansion_1e6_K * sum(rises) / 2.0)
    reach = [(f - 0.5) * drawn for f in (b.inner_conformity, b.outer_conformity)]
    angle, pitch = math.radians(b.contact_angle_deg), 1e-3 * b.pitch_diameter_mm
    fit = [f * g * drawn / ball for f, g in zip((b.inner_conformity, b.outer_conformity), warm, strict=True)]
    radii = [
        (0.5 * pitch + side * one * math.cos(angle)) * g + moved
        for side, one, g, moved in zip((1.0, -1.0), reach, warm, growth, strict=True)
    ]
    free = [(f - 0.5) * ball for f in fit]
    turned = math.acos((radii[0] - radii[1]) / sum(free))
    own = Bearing(
        ball_diameter=ball, pitch_diameter=2.0 * (radii[1] + free[1] * math.cos(turned)),
        ball_count=b.ball_count, ring_modulus=1e9 * m.inner_ring.youngs_modulus_GPa,
        ring_poisson=m.inner_ring.poisson_ratio, inner_conformity=fit[0], outer_conformity=fit[1],
        contact_angle=turned, ball_modulus=1e9 * m.balls.youngs_modulus_GPa,
        ball_poisson=m.balls.poisson_ratio, ball_density=m.balls.density_kg_m3 * (drawn / ball) ** 3,
    )  # fmt: skip
    zero = sum(free) * math.sin(turned)
    zero -= sum(one * g for one, g in zip(reach, warm, strict=True)) * math.sin(angle)
    return own, turned, zero


def own_oracle(scene, growth, friction_limit=0.05):
    """Jones and Harris of `own_bearing`, with contacts as stiff as drawn; its angle (rad) and zero (m)."""
    cold = scene.replace({f"operation.{ring}_ring_temperature_degC": 20.0 for ring in ("inner", "outer")})
    drawn = JonesHarris(own_bearing(cold, (0.0, 0.0))[0])
    own, turned, zero = own_bearing(scene, growth)
    oracle = JonesHarris(own, friction_limit=friction_limit)
    oracle.inner_constant, oracle.outer_constant = drawn.inner_constant, drawn.outer_constant
    return oracle, turned, zero


class Rest:
    """A bearing on its quasi-static equilibrium at the inputs of its scene, equal balls under axial load."""

    def __init__(self, scene):
        self.p, self.u = pack(scene, np.empty(0)), input_values(scene)
        self.w, self.found = np.zeros(W.size(self.p)), np.zeros(ST.AXIAL_SIZE)

    def _conditions(self, cold, p):
        u = self.u.copy()
        if cold:
            u[U.SPEED] = 0.0
            u[U.SHAFT_T :] = REFERENCE_TEMPERATURE
        c = np.zeros(C.SIZE)
        conditions(p, u, u[U.SPEED], c)
        return c, u[U.SPEED]

    def place(self, load, cold=False, loose=False):
        """Axial place (m) of the inner ring under a load (N), at standstill and 20 degC or at the inputs."""
        p = self.p.copy()
        if loose:
            p[P.FITS] = 0.0
        c, speed = self._conditions(cold, p)
        c[C.PRELOAD] = load
        self.c = c
        place, status = place_under(p, c, speed, self.found)
        assert status == OK
        return place

    def angles(self):
        """Contact angles (deg) inside and outside at the place found last."""
        centres = [
            (self.c[held + C.GROOVE_X], self.c[held + C.GROOVE_RADIUS])
            for held in (C.RACES, C.RACES + C.RACE_SIZE)
        ]
        shift, x, r = self.found[[ST.AXIAL_SHIFT, ST.AXIAL_X, ST.AXIAL_R]]
        radius = self.p[P.PITCH_RADIUS] + r
        inner = np.arctan2(centres[0][0] + shift - x, centres[0][1] - radius)
        outer = np.arctan2(x - centres[1][0], radius - centres[1][1])
        return np.degrees([inner, outer])

    def preload(self, cold=False):
        """Axial load (N) of the place held, at standstill and 20 degC or at the inputs."""
        place, status = cold_place(self.p, self.u, self.u[U.PRELOAD], self.w)
        assert status == OK
        c, speed = self._conditions(cold, self.p)

        def beyond(load):
            c[C.PRELOAD] = load
            return place_under(self.p, c, speed, self.found)[0] - place

        return brentq(beyond, 0.01, 1e4, xtol=1e-9)
