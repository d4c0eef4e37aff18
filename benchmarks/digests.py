"""Digests of the engine's results: what a change that is meant to alter nothing must leave equal.

``python -m benchmarks.digests > FILE`` before and after, on one machine, then ``diff``. Every gate scene and
every scene of the examples runs for 5 ms in every fidelity and method that carries it, with a jump of speed
and radial load on the way; a line holds the hashes of state, outputs, pressures, and outputs by their names,
which stay equal where the places of the arrays change. Sound is compact: boundary elements take a minute. The
last bits of a sound block depend on the threads of the linear algebra: `benchmarks` sets one.
"""

import hashlib
import warnings

import numpy as np
from numpy.typing import NDArray

from benchmarks.cases import EXAMPLES, GATES
from fmu_bearing.engine.choices import FIDELITIES, METHODS
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene, read_scene

STEP, STEPS, JUMP = 1e-4, 50, 20  # s; counts: 5 ms, inputs change after 2 ms
#: What changes after the jump beside the speed, of one bearing, of a set, of one on another model's shaft.
PUSHED = {"radial_load.y": 30.0, "nose.force.y": 30.0, "port.displacement.y": 1e-7}
SCENES = (GATES, EXAMPLES.parent)


def settings() -> list[Setting]:
    """Fidelity full by each method, and the others."""
    full = [Setting("full", method) for method in METHODS]
    return full + [Setting(fidelity) for fidelity in FIDELITIES if fidelity != "full"]


def variants(scene: Scene) -> dict[str, Scene]:
    """Return the scene with compact sound, and with rigid rings where they bend."""
    if scene.sound is not None:
        scene = scene.model_copy(
            update={"sound": scene.sound.model_copy(update={"radiation_model": "compact"})}
        )
    return {"": scene, " rigid": scene.with_rigid_rings()} if scene.bends else {"": scene}


def digest(scene: Scene, setting: Setting, jump: float = 1.01) -> str:
    """Hashes (16 hex digits each) of state, outputs and pressures; ``jump``: factor on the speed."""
    bearing = Instance(prepare(scene, fidelity=setting.fidelity, method=setting.method))
    pressures, named = [], []
    names = sorted(one.name for one in bearing.model.variables if one.causality in ("output", "local"))
    pushed = PUSHED.keys() & {one.name for one in bearing.model.variables}
    try:
        bearing.initialise()
        for k in range(STEPS):
            if k == JUMP:
                bearing.set("shaft_speed", jump * bearing.get("shaft_speed"))
                for name in pushed:
                    bearing.set(name, PUSHED[name])
            bearing.step(STEP)
            named.append([bearing.get(name) for name in names])
            pressures.append([bearing.get(f"mic[{m + 1}].pressure") for m in range(bearing.model.n_mics)])
    except EngineError as problem:
        return f"refused: {problem}"
    by_name = f"names {_hash(np.array(named))}"
    return f"s {_hash(bearing.s)} z {_hash(bearing.z)} p {_hash(np.array(pressures))} {by_name}"


def _hash(numbers: NDArray[np.float64]) -> str:
    return hashlib.sha256(np.ascontiguousarray(numbers).tobytes()).hexdigest()[:16]


def main() -> None:
    """Print a line for each scene, fidelity and method."""
    warnings.simplefilter("ignore")
    for path in sorted(path for folder in SCENES for path in folder.rglob("*.toml")):
        for words, scene in variants(read_scene(path)).items():
            for setting in settings():
                if setting.carries(scene):
                    name = f"{path.parent.name}/{path.stem}{words}, {setting.fidelity} {setting.method}"
                    print(f"{name}: {digest(scene, setting)}", flush=True)


if __name__ == "__main__":
    main()
