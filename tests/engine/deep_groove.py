"""A 6205 of steel on the pedestal of a gate scene, with a machined cage on its inner ring."""

from fmu_bearing.scene import Scene, read_scene
from tests.conftest import GATES

_STEEL = (
    "youngs_modulus_GPa", "poisson_ratio", "density_kg_m3", "expansion_1e6_K", "conductivity_W_mK",
    "specific_heat_J_kgK",
)  # fmt: skip


def deep_groove(load_N: float, rpm: float, clearance_um: float, changes: dict | None = None) -> Scene:
    """Return a perfect steel 6205 under a load downwards alone, its shaft held against tilting.

    A ring that hangs on one bearing alone tilts: the contact below it is a point to turn about.
    """
    scene = read_scene(GATES / "7003C-bare.toml")
    steel = {f"materials.balls.{key}": getattr(scene.materials.inner_ring, key) for key in _STEEL}
    values = {
        "name": "6205", "bearing.designation": "6205", "bearing.bore_mm": 25.0,
        "bearing.outside_diameter_mm": 52.0, "bearing.width_mm": 15.0, "bearing.pitch_diameter_mm": 39.04,
        "bearing.ball_diameter_mm": 7.938, "bearing.ball_count": 9, "bearing.inner_conformity": 0.52,
        "bearing.outer_conformity": 0.53, "bearing.kind": "deep-groove",
        "bearing.contact_angle_deg": None, "bearing.radial_clearance_um": clearance_um,
        "bearing.inner_ring_outer_diameter_mm": 33.0, "bearing.outer_ring_inner_diameter_mm": 45.1,
        "bearing.cage.outside_diameter_mm": 42.0, "bearing.cage.bore_mm": 34.0,
        "bearing.cage.width_mm": 12.0, "bearing.cage.pocket_diameter_mm": 8.1, "mounting.preload_N": 0.0,
        "mounting.radial_load_z_N": -load_N, "operation.speed_rpm": rpm,
        "mounting.tilt_support": {"stiffness_N_m_rad": 1e5, "damping_ratio": 0.05},
        "sound": None, "imperfections": None,
    }  # fmt: skip
    return scene.replace(values | steel | (changes or {}))
