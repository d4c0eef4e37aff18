"""A set of one bearing on a pedestal of its own, and the same as a mounted bearing with a rotor."""

import math

from fmu_bearing.scene.mounting import Mounting, Rotor
from tests.spindle.sets import scene

LENGTH, DIAMETER = 180.0, 15.0  # mm: of a shaft that is centred in the bearing, and is the rotor
PRELOAD, PEDESTAL = 500.0, 1e8  # N, N/m
MIDDLE = 0.5 * LENGTH


def set_of_one(rpm, radial=0.0, cage=True, changes=None, flexure=None, **tables):
    """Return the scene of the set and that of the mounted bearing.

    ``radial``: upwards (N); ``changes``: of both, by dotted key; ``flexure``: how their rings bend;
    ``tables``: more of both, by name.
    """
    own = {} if flexure is None else {"flexure": flexure}
    several = scene(
        "+", (MIDDLE,), None, rpm, changes=changes, shaft={"sections_mm": [[LENGTH, DIAMETER, 0.0]]},
        bearings=[{"seat": "pedestal"}], housing={"pedestal_stiffness_N_m": PEDESTAL},
        load={"force_x_N": PRELOAD, "force_z_N": radial, "position_mm": MIDDLE}, **own,
    )  # fmt: skip
    if not cage:
        tables["bearing"] = several.bearing.model_copy(update={"cage": None})
    several = several.model_copy(update=tables)
    density = several.materials.inner_ring.density_kg_m3
    mass = density * math.pi / 4.0 * (1e-3 * DIAMETER) ** 2 * 1e-3 * LENGTH
    rotor = Rotor(mass_kg=mass, length_mm=LENGTH, diameter_mm=DIAMETER)
    mounting = Mounting(
        preload_N=PRELOAD, radial_load_z_N=radial, pedestal_stiffness_N_m=PEDESTAL, rotor=rotor,
        flexure=several.spindle.flexure,
    )  # fmt: skip
    return several, several.model_copy(update={"spindle": None, "mounting": mounting})
