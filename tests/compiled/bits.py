"""What every entry computes, as digests: run as ``python -m tests.compiled.bits [FOLDER | single]``.

With a folder, its ``step.o``, ``init.o``, ... are loaded instead of the package's own objects.
With ``single``, units for single bearings alone compute the cases that they serve.
"""

import hashlib
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.first_order import FirstOrder
from fmu_bearing.acoustics.radiation.bem.integrals import Potentials
from fmu_bearing.acoustics.radiation.bem.meridian import mesh_of, ring
from fmu_bearing.arrays import Arrays
from fmu_bearing.compiled import call, load
from fmu_bearing.engine.layout import EQ, MO, SD, C, F, J, Q, S, U, Y, Z
from fmu_bearing.engine.reference.runge_kutta import ROWS, SIZE
from fmu_bearing.engine.status import OK
from fmu_bearing.interface.inputs import led_inputs
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.scene import read_scene

ROOT = Path(__file__).parents[2]
GATES, EXAMPLES = ROOT / "tests" / "scenes" / "gates", ROOT / "examples"
SINGLE = GATES / "7003C-spindle.toml"
PAIR = EXAMPLES / "spindle_set" / "7003C-DB.toml"
FOUR = EXAMPLES / "spindle_set" / "7003C-QBC.toml"
PORT = EXAMPLES / "port" / "7003C-DB-port.toml"
FIDELITIES = ("full", "rings", "response")
STEP = 1e-4  # s
STEPS = 60


def _digest(*arrays: np.ndarray) -> str:
    return hashlib.sha256(b"".join(one.tobytes() for one in arrays)).hexdigest()[:20]


def _ran(scene, sound: str = "") -> Arrays:
    """Return a scene's bearing or set after its start; ``sound``: radiation model, default none."""
    if not sound:
        return _started(Arrays.of(scene.model_copy(update={"sound": None})))
    own = scene.sound.model_copy(update={"radiation_model": sound, "third_octaves": True})
    scene = scene.model_copy(update={"sound": own})
    return _started(Arrays.of(scene, *sound_blocks(scene)))


def _started(bearing: Arrays) -> Arrays:
    bearing.init()
    return bearing


def _steps(bearing: Arrays) -> str:
    """Digest of start, steps under a changing speed and load, and of outputs read from the last state."""
    found = [bearing.s.copy(), bearing.z.copy()]
    speed = bearing.u[U.SPEED]
    for k in range(STEPS):
        bearing.u[U.SPEED] = speed * (1.0 + 1e-4 * k)
        bearing.step(STEP)
        found += [bearing.s.copy(), bearing.z.copy()]
    z = np.zeros_like(bearing.z)
    assert call("outputs", bearing.p, bearing.s, z) == OK
    assert not np.array_equal(found[1], found[-1])  # it does not stand still
    return _digest(*found, z)


def _port(scene) -> str:
    """Digest of derivatives at the port at rest and over a step."""
    bearing = _ran(scene)
    found = []
    for k in range(20):
        bearing.step(STEP)
        for place in led_inputs(scene):
            change = np.zeros(2 * bearing.u.size)
            change[: bearing.u.size], change[bearing.u.size + place] = bearing.u, 1.0
            z, w = np.zeros_like(bearing.z), np.zeros_like(bearing.w)
            assert call("derivative", bearing.p, change, np.tile(bearing.s, 2), z, w, STEP * (k % 2)) == OK
            found.append(z)
    return _digest(*found)


def _study(scene) -> Iterator[tuple[str, str]]:
    """Digests of the entries for Python alone, at a state of fidelity ``full`` after a start."""
    run = _ran(scene)
    run.run(20 * STEP, STEP)
    y, c = run.s[S.Y : S.Y + Y.SIZE].copy(), run.s[S.C : S.C + C.SIZE].copy()
    angle, speed = float(run.s[S.ANGLE]), float(run.s[S.SPEED])
    f, w = np.zeros(F.SIZE), np.zeros_like(run.w)
    call("right_hand_side", run.p, c, y, w, f, angle, speed, 3.0)
    yield "right_hand_side", _digest(f, w)
    call("repeat", run.p, c, y, w, f, angle, speed, 7.0)
    yield "repeat", _digest(f, w)
    blocks = np.zeros(J.SIZE)
    call("jacobian", run.p, c, y, w, blocks, angle, speed, 3.0)
    yield "jacobian", _digest(blocks, w)
    both = np.concatenate([y, run.s[S.AXES : S.JAC]])
    call("runge_kutta", run.p, c, both, w, np.zeros(ROWS * SIZE), angle, speed, 2e-8, 500)
    yield "runge_kutta", _digest(both)
    rates = FirstOrder(run)
    x = rates.start
    out, square = np.zeros(x.size), np.zeros((x.size, x.size))
    rates.rate(1e-5, x, out)
    rates.jacobian(1e-5, x, square)
    yield "first_order", _digest(out)
    yield "first_order_jacobian", _digest(square)
    ring, force, answer = np.array([2e-6, 1e-6, 0.0, 1e-5, 0.0]), np.zeros(Q.OUTER), np.zeros(EQ.SIZE)
    status = call("forces_at_displacement", run.p, run.u, c, ring, force, answer, w)
    yield "forces_at_displacement", _digest(np.array([status]), c, force, answer)


def _answer_set(scene) -> str:
    run = _ran(scene)
    run.run(20 * STEP, STEP)
    status = call("solve_at_state", run.p, run.s, run.w, float(run.s[S.FACTOR_STEP]))
    return _digest(np.array([status]), run.s, run.w)


def _play(scene, sound: str) -> str:
    """Digest of levels and pressures of random motion."""
    (ps,) = sound_blocks(
        scene.model_copy(update={"sound": scene.sound.model_copy(update={"radiation_model": sound})})
    )
    motion = np.random.default_rng(1).standard_normal((32, MO.SIZE))
    ss, ws = np.zeros(SD.state_size(ps)), np.zeros(SD.work_size(ps))
    mics = int(ps[SD.H_MICS])
    numbers, samples = len(Z.MIC_OUTPUTS) + int(ps[SD.H_BANDS]), 4096
    z, pressures = np.zeros(mics * numbers), np.zeros((samples // SD.DECIMATION, mics))
    call("play", ps, ss, ws, motion, z, pressures, samples, MO.SIZE, 0.125, 0.0, mics, numbers, 5)
    assert np.count_nonzero(pressures) > pressures.size // 2  # but for the delay
    return _digest(z, pressures, ss)


def _potentials() -> str:
    """Digest of the matrices of boundary elements for a ring at some wavenumbers (1/m)."""
    mesh = mesh_of([ring("outer", 1, 0.035, 0.0296, -0.005, 0.005)], 0.002)
    found = Potentials(mesh.points, np.repeat(np.arange(len(mesh.ends)), 2), mesh, 4, plane=0.02)
    return _digest(*(layer for k in (0.37, 20.0, 400.0) for layer in found(k)))


def singles() -> Iterator[tuple[str, str]]:
    """Name and digest of each case of a single bearing that units for those alone can compute."""
    single, bare = read_scene(SINGLE), read_scene(GATES / "7003C-bare.toml")
    for fidelity in FIDELITIES:
        choice = {"fidelity.model": fidelity}
        yield f"single {fidelity}", _steps(_ran(single.replace(choice)))
        yield f"compact {fidelity}", _steps(_ran(bare.replace(choice), "compact"))
    yield "bem full", _steps(_ran(bare, "bem"))
    for name in ("7009C-steel", "7009C-full-ceramic", "7003C-impact"):
        yield name, _steps(_ran(read_scene(GATES / f"{name}.toml")))


def digests() -> Iterator[tuple[str, str]]:
    """Name and digest of each case."""
    yield from singles()
    single, pair, port = map(read_scene, (SINGLE, PAIR, PORT))
    bare = read_scene(GATES / "7003C-bare.toml")
    for fidelity in FIDELITIES:
        yield f"pair {fidelity}", _steps(_ran(pair.replace({"fidelity.model": fidelity})))
    yield "pair compact full", _steps(_ran(pair.model_copy(update={"sound": bare.sound}), "compact"))
    yield "four full", _steps(_ran(read_scene(FOUR)))
    yield "port full", _steps(_ran(port.replace({"fidelity.model": "full"})))
    yield "derivative full", _port(port.replace({"fidelity.model": "full"}))
    yield from _study(single)
    yield "solve_at_state", _answer_set(pair)
    yield "potentials", _potentials()
    for sound in ("compact", "bem"):
        yield f"play {sound}", _play(bare, sound)


def main() -> None:
    """Print the digests, one case a line."""
    cases, choice = digests, sys.argv[1:]
    load.kept = lambda platform, units, suffix: choice != ["single"]
    if choice == ["single"]:
        cases = singles
    elif choice:
        load.objects = lambda platform, units, sets: {
            (unit, one): Path(choice[0], f"{unit}.o").read_bytes() for unit in units for one in sets
        }
    for name, found in cases():
        print(f"{found} {name}", flush=True)


if __name__ == "__main__":
    main()
