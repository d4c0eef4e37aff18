"""Sets of the gate scenes' 7003C: standstill, 20 degC, outer race control, no weight unless asked for."""

from fmu_bearing.scene import Scene, read_scene
from tests.conftest import GATES

_BASE = read_scene(GATES / "7003C-bare.toml").model_dump()


def tables(signs="+-", positions=(40.0, 70.0), preload=500.0, rpm=0.0, **spindle):
    """Tables of a scene; keys of ``[spindle]`` as arguments, ``bearings`` holds more of each bearing."""
    data = {key: _BASE[key] for key in ("name", "bearing", "materials", "lubricant")}
    data["operation"] = {
        "speed_rpm": rpm,
        "oil_temperature_degC": 20.0,
        "inner_ring_temperature_degC": 20.0,
        "outer_ring_temperature_degC": 20.0,
    }
    data["fidelity"] = {"race_control": "outer", "terms": {"gravity": False}}
    bearings = spindle.pop("bearings", [{}] * len(signs))
    data["spindle"] = {
        "shaft": {"sections_mm": [[400.0, 17.0, 0.0]]},
        "bearing": [
            {"position_mm": float(place), "carries": f"{sign}x", **own}
            for sign, place, own in zip(signs, positions, bearings, strict=True)
        ],
        **({} if preload is None else {"preload": {"preload_N": preload}}),
        **spindle,
    }
    return data


def scene(*args, changes=None, **spindle):
    """Scene of a set, with other values by dotted key."""
    return Scene.from_dict(tables(*args, **spindle)).replace(changes or {})
