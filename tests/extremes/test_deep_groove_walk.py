"""Random walks of deep groove bearings under radial loads alone: all of them go on."""

import math

import numpy as np
import pytest

from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas import iso76
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.deep_groove import deep_groove

DRAWS = 60
_STEPS = 40
_OUTPUTS = (
    "friction_torque", "heat.inner_ring", "heat.outer_ring", "heat.oil", "cage.speed_ratio",
    "contact.inner.load_max", "contact.outer.load_max", "inner_ring.displacement.y",
    "inner_ring.displacement.z", "film.lambda_min",
)  # fmt: skip
#: Bore, outside diameter, width, ball count and diameter (mm) of sizes from 6000 to 6308, read from makers.
_SIZES = (
    (10, 26, 8, 7, 4.762), (17, 40, 12, 8, 6.747), (20, 47, 14, 8, 7.938), (25, 52, 15, 9, 7.938),
    (40, 68, 15, 12, 7.938), (40, 90, 23, 8, 15.081),
)  # fmt: skip

pytestmark = [pytest.mark.filterwarnings("ignore"), pytest.mark.heavy]


def drawn(draw: np.random.Generator):
    """Return a scene with dimensions, clearance, load, speed, ball material and cage drawn."""
    bore, outside, width, count, ball = _SIZES[draw.integers(len(_SIZES))]
    pitch = 0.5 * (bore + outside)
    clearance = float(np.exp(draw.uniform(np.log(4.0 * ball / 7.938), np.log(40.0))))
    static = iso76.static_rating(count, ball, pitch, 0.0)
    load = float(np.exp(draw.uniform(math.log(50.0), math.log(min(0.3 * static, 2900.0)))))
    fast = float(np.exp(draw.uniform(math.log(200.0), math.log(5e5 / pitch))))
    rpm = fast * float(draw.choice([-1.0, 1.0]))
    changes = {
        "bearing.bore_mm": bore, "bearing.outside_diameter_mm": outside, "bearing.width_mm": width,
        "bearing.pitch_diameter_mm": pitch, "bearing.ball_diameter_mm": ball, "bearing.ball_count": count,
        "bearing.inner_ring_outer_diameter_mm": pitch - 0.75 * ball,
        "bearing.outer_ring_inner_diameter_mm": pitch + 0.75 * ball,
        "bearing.cage.bore_mm": pitch - 0.6 * ball, "bearing.cage.outside_diameter_mm": pitch + 0.4 * ball,
        "bearing.cage.width_mm": min(1.5 * ball, 0.9 * width), "bearing.cage.pocket_diameter_mm": 1.02 * ball,
        "operation.oil_temperature_degC": draw.uniform(20.0, 80.0),
    }  # fmt: skip
    if draw.random() < 0.3:
        changes |= {"materials.balls.youngs_modulus_GPa": 310.0, "materials.balls.density_kg_m3": 3200.0}
    if draw.random() < 0.3:
        changes["mounting.tilt_support"] = None  # the ring tilts until balls on the other side hold it
    changes["bearing.cage.guidance"] = guidance = str(draw.choice(["inner", "outer", "balls"]))
    if guidance == "balls":
        changes["bearing.cage.land_clearance_mm"] = None
    return deep_groove(load, rpm, clearance, changes)


def walk(run: Instance, draw: np.random.Generator, linear: bool) -> None:
    """Step with jumps of load and speed; outputs stay finite, and ball loads below ten times the load."""
    speed, load = run.get("shaft_speed"), run.get("radial_load.z")
    for k in range(_STEPS):
        if k == _STEPS // 2:
            run.set("shaft_speed", speed * draw.uniform(0.5, 1.2))
            run.set("radial_load.y", load * draw.uniform(-0.5, 0.5))
        run.step(min(1e-3, 0.05 / abs(speed)))
        values = [run.get(name) for name in _OUTPUTS]
        assert np.all(np.isfinite(values)), dict(zip(_OUTPUTS, values, strict=True))
        # contacts of fidelity response never open, and a warning says what its loads are worth
        assert linear or run.get("contact.inner.load_max") < 10.0 * abs(load) + 10.0
    assert abs(run.get("shaft_speed")) > 10.0 * RPM


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
@pytest.mark.parametrize("seed", range(DRAWS))
def test_a_walk_goes_on(seed, fidelity):
    draw = np.random.default_rng([58, seed])
    run = Instance(prepare(drawn(draw), fidelity=fidelity))
    run.initialise()
    walk(run, draw, fidelity == "response")
