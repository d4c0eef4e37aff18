"""Speed of the cage, and vibration in the bands in which makers class bearings."""

import functools

import numpy as np

from benchmarks.measured.sources import Value
from fmu_bearing import new_scene, simulate, with_fidelity
from fmu_bearing.acoustics.analysis.spectrum import kinematic_frequencies, power_spectral_density
from fmu_bearing.scene import read_scene_text
from fmu_bearing.vibration_test import rig

#: rad: contact angles of a deep groove bearing whose clearance and load are not known.
ANGLES = (0.0, np.radians(10.0))
#: %: bound of the tests on the cage speed of `full` beside Harris' (docs/validation.md).
SLIP_BOUND = 0.15
#: Speed (r/min), thrust (N) and support of the vibration: ISO 15242 holds the outer ring softly.
SPEED, THRUST, SUPPORT = 1800.0, 30.0, 1e4
_NAMES = ("low", "medium", "high")
_STEP = 2e-5  # s
_WARM_UP = 0.2  # s


def cage_ratio(value: Value, angle: float = 0.0) -> float:
    """Return cage over shaft speed of the 6205 without slip, at a contact angle (rad)."""
    speed = 2.0 * np.pi * value.shaft_Hz
    found = kinematic_frequencies(speed, 9, 7.94e-3, 39.04e-3, angle)
    return found.f_c / found.f_r


@functools.cache
def bands(grade: str, seed: int = 1, duration: float = 1.0) -> dict[str, float]:
    """Return the radial rms velocity (um/s) of the outer ring of a steel 7003C in three bands, by name."""
    text = new_scene(
        "vibration", "7003C", kind="steel", sound=False, speed_rpm=SPEED, preload_N=THRUST, grade=grade
    )
    scene = read_scene_text(text).replace(
        {"mounting.pedestal_stiffness_N_m": SUPPORT, "imperfections.seed": seed}
    )
    name = "outer_ring.velocity.y"
    run = simulate(
        with_fidelity(scene, model="rings"), _WARM_UP + duration, step=_STEP, outputs=[name], progress=False
    )
    settled = run[name][round(_WARM_UP / _STEP) :]
    frequency, density = power_spectral_density(settled, 1.0 / _STEP, 10.0)
    return {
        name: 1e6 * float(np.sqrt(density[(frequency >= low) & (frequency < high)].sum() * frequency[1]))
        for name, (low, high) in zip(_NAMES, rig.bands(scene).values(), strict=True)
    }
