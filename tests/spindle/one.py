"""A set of one bearing on a pedestal of its own, and the same as a mounted bearing with a rotor."""

import math

from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.mounting import SUPPORTS, Mounting, Rotor
from tests.conftest import GATES
from tests.spindle.sets import scene

LENGTH, DIAMETER = 180.0, 15.0  # mm: of a shaft that is centred in the bearing, and is the rotor
PRELOAD, PEDESTAL = 500.0, 1e8  # N, N/m
MIDDLE = 0.5 * LENGTH
_PEDESTAL = tuple(
    f"pedestal_{key}"
    for key in (
        "stiffness_N_m", "stiffness_ratio", "axis_angle_deg", "axial_ratio", "rotational_ratio_mm2",
        "damping_ratio",
    )
)  # fmt: skip


def as_set(single: Scene) -> Scene:
    """Return a mounted bearing with a rotor as a set of one, on a pedestal of its own or in a housing.

    The rotor has the density of the inner ring; the housing's mass is at the bearing. Sound is left out.
    """
    mount = single.mounting
    rotor = mount.rotor
    spindle = {
        "shaft": {"sections_mm": [[rotor.length_mm, rotor.diameter_mm, 0.0]]},
        "bearing": [
            {"position_mm": 0.5 * rotor.length_mm, "carries": "+x", "seat": "pedestal"}
            | {key: getattr(mount, key) for key in ("misalignment_y_mrad", "misalignment_z_mrad")}
        ],
        "housing": {key: getattr(mount, key) for key in _PEDESTAL},
        "load": {
            "force_x_N": mount.preload_N,
            "force_y_N": mount.radial_load_y_N,
            "force_z_N": mount.radial_load_z_N,
            "position_mm": 0.5 * rotor.length_mm,
        },
    }
    if mount.housing is not None:
        body = mount.housing.model_dump(exclude={"front_face_mm"})
        spindle["housing"] |= body | {"position_mm": 0.5 * rotor.length_mm}
        spindle["bearing"][0]["seat"] = "fixed"
    for key in SUPPORTS:
        if getattr(mount, key) is not None:
            spindle[key] = getattr(mount, key).model_dump()
    if mount.flexure is not None:
        spindle["flexure"] = mount.flexure.model_dump()
    return Scene.from_dict(single.model_dump(exclude={"mounting"}) | {"spindle": spindle})


def _rotor(single: Scene, diameter: float) -> Rotor:
    volume = math.pi / 4.0 * (1e-3 * diameter) ** 2 * 1e-3 * LENGTH
    mass = single.materials.inner_ring.density_kg_m3 * volume
    return Rotor(mass_kg=mass, length_mm=LENGTH, diameter_mm=diameter)


def set_of_one(rpm, radial=0.0, cage=True, changes=None, mount=None, **tables):
    """Return the scene of the set and that of the mounted bearing.

    ``radial``: upwards (N); ``changes``: of both, by dotted key; ``mount``: more of their mounting, by key of
    its table; ``tables``: more of both, by name.
    """
    plain = scene("+", (MIDDLE,), None, rpm, changes=changes, load={"force_x_N": PRELOAD})
    if not cage:
        tables["bearing"] = plain.bearing.model_copy(update={"cage": None})
    mounting = Mounting(
        preload_N=PRELOAD, radial_load_z_N=radial, pedestal_stiffness_N_m=PEDESTAL,
        rotor=_rotor(plain, DIAMETER), **(mount or {}),
    )  # fmt: skip
    single = Scene.from_dict(
        plain.model_copy(update=tables).model_dump(exclude={"spindle"}) | {"mounting": mounting.model_dump()}
    )
    return as_set(single), single


def gate_as_set(name, radial=0.0, cage=True, changes=None):
    """Return a gate scene as a set of one and as a mounted bearing, both with a rotor in the bearing's bore.

    Left out of both: what `as_set` leaves out. Inner rings do not bend, because a rotor fills them.
    """
    found = read_scene(GATES / f"{name}.toml")
    mount = found.mounted.model_copy(
        update={
            "rotor": _rotor(found, found.bearing.bore_mm - 2.0), "housing": None, "radial_load_z_N": radial,
        }
    )  # fmt: skip
    if mount.flexure is not None:
        mount = mount.model_copy(update={"flexure": mount.flexure.model_copy(update={"inner_ring": []})})
    found = found.model_copy(update={"mounting": mount, "sound": None})
    if not cage:
        found = found.model_copy(update={"bearing": found.bearing.model_copy(update={"cage": None})})
    found = found.replace(changes or {})
    return as_set(found), found
