"""Small plans of data sets."""

from fmu_bearing.dataset import read_plan

#: Runs of some 0.2 s of one processor.
HEAD = """scene = "scene.toml"
runs = 6
length_s = 0.04
settle_s = 0.03
rate_Hz = 12800
seed = 3
sensors = ["outer_ring.acceleration.z", "P1"]
"""
DRAW = """[draw]
speed = "8000:20000"
"imperfections.seed" = "1:2147483647"
"""
CLASSES = """[[class]]
name = "across"
share = 0.5
draw = { "mounting.radial_load_z_N" = "-100:-10log" }
[[class]]
name = "along"
share = 0.5
draw = { preload = [300, 500] }
"""


def file(folder, scene, head=HEAD, draw=DRAW, classes=CLASSES):
    """Write a scene at fidelity rings and a plan of it; return the plan's file."""
    (folder / "scene.toml").write_text(scene.replace({"fidelity.model": "rings"}).to_toml(), "utf-8")
    path = folder / "plan.toml"
    path.write_text(head + draw + classes, "utf-8")
    return path


def plan(folder, scene, **parts):
    """Return a plan that is read from its file."""
    return read_plan(file(folder, scene, **parts))
