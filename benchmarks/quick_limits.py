"""Shortfalls of `rings` and `response` that docs/fidelities states. ``python -m benchmarks.quick_limits``

Each part measures one: values in `full`, and in both quick fidelities beside it. Rows are printed and written
to quick_limits.csv of the folder; ``--what`` names parts, all by default.
"""

import argparse
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.quick_gates import (
    CLASSES,
    GATES,
    HALF,
    QUICK,
    ROOT,
    Drawn,
    cageless,
    ends,
    motion,
    names_of,
    silent,
)
from fmu_bearing import Bearing, Scene, new_scene, read_scene, record, simulate, with_fidelity
from fmu_bearing.modal.equations.quick import operator_matrix, quick_run
from fmu_bearing.results.table import write_csv
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.nsk import sizes

MODELS = ("full", *QUICK)
RPM = np.pi / 30.0  # rad/s
SOURCES = ("inner_race_amplitude_um", "outer_race_amplitude_um", "ball_form_nm")
DRIFTING = ("NSK-7003C", "NSK-7010C", "NSK-7008AC", "NSK-7912C")
COLUMNS = ("what", "quantity", *MODELS)
INNER = [f"inner_ring.velocity.{axis}" for axis in "xyz"]
LOADS = [
    f"contact.{race}.{one}" for race in ("inner", "outer") for one in ("load_mean", "load_max", "angle_mean")
]
Row = tuple[str, str, Sequence[float]]


def fresh(bearing: str, rpm: float, preload: float | None, **options: Any) -> Scene:
    """Return a scene as ``scene new`` writes it, hybrid unless asked otherwise."""
    given = {"kind": "hybrid", "sound": False} | options
    return read_scene_text(new_scene(bearing, bearing, speed_rpm=rpm, preload_N=preload, **given), bearing)


def spindle() -> Scene:
    """Return the gate scene of the 7003C's spindle, silent."""
    return silent(read_scene(GATES / "7003C-spindle.toml"))


def kept(
    scene: Scene, model: str, names: Sequence[str], seconds: float, step: float = 2.5e-5, **options: Any
) -> NDArray[np.float64]:
    """Return outputs of a run, a row each."""
    run = simulate(
        with_fidelity(scene, model=model), seconds, step=step, outputs=names, progress=False, **options
    )
    if not run.complete:
        raise ValueError(run.note)
    return np.array([run[name] for name in names])


def quick_over_full(what: str, scene: Scene, scale: float = 1.0, seconds: float = 0.15) -> Iterator[Row]:
    """Yield rms velocities of the inner ring (mm/s)."""
    found = [1e3 * motion(scene, model, scale=scale, seconds=seconds)[:3] for model in MODELS]
    for k, axis in enumerate("xyz"):
        yield what, f"inner ring, {axis}, mm/s", [one[k] for one in found]


def levels(scene: Scene, radiation: str = "bem", seconds: float = 0.4) -> list[NDArray[np.float64]]:
    """Return A-weighted levels (dB) at a scene's microphones, by fidelity."""
    return [
        np.array(
            record(
                with_fidelity(scene, model=model), seconds, settle=0.1, radiation_model=radiation, outputs=(),
                progress=False, warn=False,
            ).levels(weighting="A")
        )
        for model in MODELS
    ]  # fmt: skip


def worst(found: Sequence[NDArray[np.float64]]) -> list[float]:
    """Return levels in `full` and both others at the microphone where one of them is farthest off."""
    off = np.max([np.abs(one - found[0]) for one in found[1:]], axis=0)
    return [float(one[np.argmax(off)]) for one in found]


def across() -> Iterator[Row]:
    """Balls that strike their pockets: NSK-7014C, 9,000 r/min, 386 N of preload."""
    for load in (0.0, 100.0, 150.0, 200.0, 386.0, 700.0):
        scene = fresh("NSK-7014C", 9000.0, 386.0, sound=True).replace({"mounting.radial_load_y_N": load})
        what = f"NSK-7014C, 9,000 r/min, 386 N, {load:g} N across"
        yield what, "level at the worst of four microphones, dB(A)", worst(levels(scene))
        yield next(quick_over_full(what, silent(scene)))


def run_up() -> Iterator[Row]:
    """A run-up into growth: NSK-7911AC under 200 N from 5,000 to 24,000 r/min, then 0.6 s held."""
    scene = fresh("NSK-7911AC", 5000.0, 200.0)
    for took in (0.1, 0.3):
        ramp = {"shaft_speed": lambda t, took=took: RPM * (5000.0 + 19000.0 * min(1.0, t / took))}
        found = [kept(scene, model, INNER[1:2], took + 0.6, inputs=ramp)[0, -4000:].std() for model in MODELS]
        what = f"NSK-7911AC, 200 N, from 5,000 to 24,000 r/min in {took:g} s"
        yield what, "inner ring, y, mm/s", [1e3 * one for one in found]


def limited_whirl() -> Iterator[Row]:
    """A whirl that the cage limits: 25 degrees, light class, n d_m of 1.62 million."""
    for name, rpm, kind in (
        ("NSK-7900AC", 100e3, "hybrid"), ("NSK-7909AC", 28.7e3, "hybrid"), ("NSK-7911AC", 24e3, "hybrid"),
        ("NSK-7012AC", 20.9e3, "hybrid"), ("NSK-7014AC", 18e3, "hybrid"), ("NSK-7911AC", 24e3, "steel"),
    ):  # fmt: skip
        scene = fresh(name, rpm, None, preload_class="light", kind=kind)
        what = f"{name}, {kind}, {rpm:,.0f} r/min, light"
        yield list(quick_over_full(what, scene, seconds=0.3))[1]


def heavy_load() -> Iterator[Row]:
    """1000 N down on the 7003C's spindle with 500 N of preload, 20,000 r/min, two seeds."""
    for seed in (1, 2):
        scene = spindle().replace({
            "mounting.radial_load_z_N": -1000.0, "mounting.preload_N": 500.0, "imperfections.seed": seed,
            "operation.speed_rpm": 20e3,
        })  # fmt: skip
        yield from quick_over_full(f"7003C spindle, 1,000 N down, seed {seed}", scene, seconds=0.2)


def contact_loads() -> Iterator[Row]:
    """Means over 0.1 s of contact loads (N) and angles (deg) on the 7003C's spindle."""
    for rpm, preload, times in (
        (20e3, 500.0, 1.0),
        (40e3, 100.0, 1.0),
        (55e3, 29.0, 1.0),
        (20e3, 500.0, 5.0),
    ):
        scene = spindle().replace({"operation.speed_rpm": rpm, "mounting.preload_N": preload})
        what = f"7003C spindle, {rpm:,.0f} r/min, {preload:g} N, {times:g} times its surfaces"
        options = {} if times == 1.0 else {"start_values": {"imperfection.scale": times}}
        found = [kept(scene, model, LOADS, 0.12, **options)[:, 800:].mean(axis=1) for model in MODELS]
        for k, name in enumerate(LOADS):
            unit = 180.0 / np.pi if "angle" in name else 1.0
            yield what, f"{name}, {'deg' if 'angle' in name else 'N'}", [unit * one[k] for one in found]


def soft_pedestal() -> Iterator[Row]:
    """A load across on soft pedestals: means over 0.1 s of contact loads (N)."""
    given = silent(read_scene(ROOT / "examples" / "scenes" / "7003C-spindle.toml"))
    names = [name for name in LOADS if "inner.load" in name]
    for stiffness in (3e5, 1e6, 1e7):
        keys = {"mounting.pedestal_stiffness_N_m": stiffness, "mounting.radial_load_y_N": 150.0}
        found = [kept(given.replace(keys), model, names, 0.2)[:, 4000:].mean(axis=1) for model in MODELS]
        what = f"7003C spindle, pedestal {stiffness:g} N/m, 150 N across"
        for k, name in enumerate(names):
            yield what, f"{name}, N", [one[k] for one in found]


def warm_jump() -> Iterator[Row]:
    """Three 7010C (TBT), an inner ring warmer by 67 K at once: loads, and until when they lag."""
    scene = fresh("NSK-7010C", 10e3, None, arrangement="TBT", preload_class="light")
    names = [f"bearing[{k}].contact.inner.load_mean" for k in (1, 2, 3)]
    key, at = "bearing[1].inner_ring_temperature", 0.05
    begin = Bearing(scene).get(key)
    jump = {key: lambda t: begin + 67.0 * (t >= at)}
    step = 5e-4
    found = [kept(scene, model, names, 0.25, step=step, inputs=jump) for model in MODELS]
    what = "TBT of NSK-7010C, 10,000 r/min, one ring 67 K warmer at once"
    for delay in (20e-3, 190e-3):
        for k in range(3):
            row = [one[k, round((at + delay) / step)] for one in found]
            yield what, f"load of bearing {k + 1} after {1e3 * delay:g} ms, N", row
    yield what, "ms until loads are within 5 % of the last", [lag(one, at, step) for one in found]


def lag(rows: NDArray[np.float64], at: float, step: float) -> float:
    """Return after how many ms from ``at`` (s) all rows stay within 5 % of their largest last value."""
    last = rows[:, -1:]
    off = np.flatnonzero(np.any(np.abs(rows - last) > 0.05 * np.abs(last).max(), axis=0))
    return max(1e3 * ((off[-1] + 1) * step - at), 0.0) if off.size else 0.0


def jumps() -> Iterator[Row]:
    """Jumps of an input of perfect bearings: ms until the rings stay within 5 % of their new places."""
    single = spindle().model_copy(update={"imperfections": None})
    sets = {
        name: read_scene(ROOT / "examples" / "spindle_set" / f"7003C-{name}.toml") for name in ("DB", "QBC")
    }
    cases = [("7003C spindle", single, "radial_load.y", 100.0, ["inner_ring.displacement.y"])]
    for name, scene in sets.items():
        still = silent(scene).model_copy(update={"imperfections": None})
        cases.append((f"{name} of 7003C", still, "nose.force.y", 100.0, ["shaft.nose.displacement.y"]))
    for what, scene, key, value, names in cases:
        begin = Bearing(scene).get(key)
        jump = {key: lambda t, begin=begin, value=value: begin + value * (t >= 0.05)}
        found = [kept(scene, model, names, 0.2, step=1e-4, inputs=jump) for model in MODELS]
        yield (
            f"{what}, 100 N across at once",
            "ms until displacements are within 5 %",
            [lag(one, 0.05, 1e-4) for one in found],
        )


def torque_renewed() -> Iterator[Row]:
    """A speed 10 % higher within 1 ms: ms until the mean torque stays within 0.5 % of its new value."""
    sets = {
        name: read_scene(ROOT / "examples" / "spindle_set" / f"7003C-{name}.toml") for name in ("DB", "QBC")
    }
    for what, scene in (
        ("7003C spindle", spindle()),
        *((f"{k} of 7003C", silent(v)) for k, v in sets.items()),
    ):
        begin = RPM * scene.operation.speed_rpm
        still = scene.model_copy(update={"imperfections": None})
        jump = {"shaft_speed": lambda t, begin=begin: begin * (1.0 + 0.1 * (t >= 0.05))}
        found = []
        for model in QUICK:
            rows = kept(still, model, ["friction_torque_mean"], 0.25, step=1e-3, inputs=jump)[0]
            off = np.flatnonzero(np.abs(rows / rows[-1] - 1.0) > 5e-3)
            found.append(float(off[-1] + 1) - 50.0)
        yield f"{what}, speed 10 % up at once", "ms until the mean torque is within 0.5 %", [np.nan, *found]


def stiff_preload() -> Iterator[Row]:
    """Rigid preload on a pedestal of 1e4 N/m: 1 where a run starts, 0 where it is refused."""
    scene = spindle().replace({"mounting.pedestal_stiffness_N_m": 1e4, "mounting.preload_mode": "rigid"})
    found = []
    for model in MODELS:
        try:
            kept(scene, model, INNER, 1e-3)
            found.append(1.0)
        except (ValueError, RuntimeError):
            found.append(0.0)
    yield "7003C spindle, rigid preload, pedestal 1e4 N/m", "starts", found


def weak_damping() -> Iterator[Row]:
    """Levels of scenes with weakly damped modes, and of one whose cage is what sounds."""
    for name, rpm in (
        ("7003C-impact", 8e3),
        ("7003C-impact", 22e3),
        ("7009C-steel", 11e3),
        ("7009C-spindle", None),
    ):
        scene = read_scene(ROOT / "examples" / "scenes" / f"{name}.toml").with_rigid_rings()
        if rpm is not None:
            scene = scene.replace({"operation.speed_rpm": rpm})
        what = f"example {name}, {scene.operation.speed_rpm:,.0f} r/min"
        yield what, "level at the worst microphone, dB(A)", worst(levels(scene, "compact"))


def loose_tilt() -> Iterator[Row]:
    """NSK-7913AC, 9,700 r/min, 293 N, without its support against tilting and with it."""
    with_support = fresh("NSK-7913AC", 9700.0, 293.0)
    for words, scene in (("without tilt support", with_support.replace({"mounting.tilt_support": None})),
                         ("with it", with_support)):  # fmt: skip
        for scale in (1.0, 0.1):
            full = motion(scene, "full", scale=scale)
            found = [motion(scene, model, scale=scale) for model in QUICK]
            for end in (0, 1):
                row = [1.0, *(float(ends(scene, full, one)[end]) for one in found)]
                yield (
                    f"NSK-7913AC, {words}, {scale:g} of its surfaces",
                    ("least ratio", "largest ratio")[end],
                    row,
                )


def bare_cages() -> Iterator[Row]:
    """The cage's own sound in bare scenes at 35 to 70 % of the limiting speed."""
    for name, rpm, kind, arrangement in (
        ("NSK-7908AC", 18e3, "steel", "DF"), ("NSK-7003C", 25e3, "hybrid", None),
        ("NSK-7010C", 12e3, "steel", None), ("NSK-7906AC", 20e3, "hybrid", None),
    ):  # fmt: skip
        more = {} if arrangement is None else {"arrangement": arrangement}
        scene = fresh(name, rpm, None, sound=True, kind=kind, **more)
        what = f"{name} {arrangement or 'single'}, {kind}, {rpm:,.0f} r/min, bare"
        yield what, "level at the worst microphone, dB(A)", worst(levels(scene))


def weak_traction() -> Iterator[Row]:
    """Traction that cannot drive the balls: the bare 7003C at 20,000 r/min, traction_max 0.0005."""
    scene = silent(read_scene(GATES / "7003C-bare.toml"))
    scene = scene.replace({"operation.speed_rpm": 20e3, "lubricant.traction_max": 5e-4})
    found = [kept(scene, model, ["cage.speed_ratio"], 0.3)[0, -4000:].mean() for model in MODELS]
    yield "7003C bare, 20,000 r/min, traction_max 0.0005", "speed of the cage over that of the shaft", found


def small_waves() -> Iterator[Row]:
    """A tenth of the imperfections on the bare 7003C without a cage: least and largest ratio over speeds."""
    scene = silent(read_scene(GATES / "7003C-bare.toml"))
    for words, given in (("without its cage", cageless(scene)), ("", scene)):
        for damping in (0.5, 10.0):
            found = []
            for rpm in (3e3, 5e3, 8e3, 10e3, 15e3, 28e3):
                at = given.replace({"operation.speed_rpm": rpm, "bearing.contact_damping_us": damping})
                full = motion(at, "full", scale=0.1)
                found.append(
                    [[float(x) for x in ends(at, full, motion(at, model, scale=0.1))] for model in QUICK]
                )
            table = np.array(found)  # speeds, fidelities, ends
            what = f"7003C bare {words}, 3,000 to 28,000 r/min, a tenth of its surfaces, {damping:g} us"
            yield what, "least ratio", [1.0, *table[:, :, 0].min(axis=0)]
            yield what, "largest ratio", [1.0, *table[:, :, 1].max(axis=0)]


def damped_waves() -> Iterator[Row]:
    """A tenth of the surfaces at half the lightest class without a cage: least and largest ratio."""
    cases = []
    for name, rpm in (("NSK-7907C", 11e3), ("NSK-7906C", 19.1e3)):
        scene = cageless(Drawn(name, rpm, HALF).scene())
        for damping in (0.5, 2.5, 10.0):
            what = f"{name} without its cage, {rpm:,.0f} r/min, half of the lightest class, {damping:g} us"
            cases.append((what, scene.replace({"bearing.contact_damping_us": damping})))
    what, damped = cases[2]
    flaws = damped.imperfections
    assert flaws is not None
    for source in SOURCES:
        alone = {f"imperfections.{key}": getattr(flaws, key) if key == source else 0.0 for key in SOURCES}
        cases.append((f"{what}, {source} alone", damped.replace(alone)))
    for what, scene in cases:
        full = motion(scene, "full", scale=0.1)
        found = [[float(x) for x in ends(scene, full, motion(scene, model, scale=0.1))] for model in QUICK]
        yield what, "least ratio", [1.0, *(one[0] for one in found)]
        yield what, "largest ratio", [1.0, *(one[1] for one in found)]


def without_traction() -> Iterator[Row]:
    """The example 7003C-impact, whose balls have no traction and no weight; growth of `rings`' operator."""
    given = silent(read_scene(ROOT / "examples" / "scenes" / "7003C-impact.toml"))
    for traction, weight in ((0.0, False), (0.02, False), (0.0, True)):
        changed = {"lubricant.traction_max": traction, "fidelity.terms.gravity": weight}
        scene = given.replace(changed | {"operation.speed_rpm": 8e3})
        what = f"7003C-impact, 8,000 r/min, traction_max {traction:g}, {'' if weight else 'no '}weight"
        yield list(quick_over_full(what, scene, seconds=0.5))[1]
        restarts = [kept(scene, model, ["solver.restarts"], 0.5, step=1e-3)[0, -1] for model in MODELS]
        yield what, "restarts in 0.5 s", restarts
        poles = np.linalg.eigvals(operator_matrix(quick_run(scene)))
        yield what, "largest growth, 1/s", [np.nan, poles.real.max(), np.nan]


def drift() -> Iterator[Row]:
    """Drifts of speed (30 % in 0.3 s) and temperatures (up to 8 K/s): loads at the end beside a start there.

    Of 24 draws the median, over the largest load at the start, of the bearing that is farthest off.
    """
    rng = np.random.default_rng(52)
    for arrangement in (None, "DB", "TBT", "QBC"):
        found: list[list[float]] = []
        while len(found) < 6:
            name, own = str(rng.choice(DRIFTING)), str(rng.choice(CLASSES[:3]))
            rpm = float(f"{rng.uniform(0.5e6, 1.2e6) / sizes()[name].pitch:.3g}")
            more = {} if arrangement is None else {"arrangement": arrangement}
            scene = fresh(name, rpm, None, preload_class=own, **more)
            found.append(drifted(scene.model_copy(update={"imperfections": None}), rng))
        size = "single" if arrangement is None else arrangement
        rings, response, on_the_way = 100.0 * np.median(np.array(found), axis=0)
        what, unit = f"drift of speed and temperatures, {size}, median of six", "% of the load at the start"
        yield what, f"off at the end, {unit}", [np.nan, rings, response]
        yield what, f"response beside rings on the way, {unit}", [np.nan, 0.0, on_the_way]


def drifted(scene: Scene, rng: np.random.Generator) -> list[float]:
    """Return how far mean loads of bearings are off at most, over their own at the start.

    Of rings and of response at the end, beside a start at the inputs there; of response beside rings before.
    """
    seconds, way = 0.3, float(rng.choice([-0.3, 0.3]))
    keys = [name for name in Bearing(scene) if name.endswith("_temperature")]
    warmer = dict(zip(keys, rng.uniform(-8.0, 8.0, len(keys)), strict=True))
    bearing = Bearing(scene)
    moved = moves({key: bearing.get(key) for key in ("shaft_speed", *keys)}, warmer, way, seconds)
    end = {key: value(seconds) for key, value in moved.items()}
    names = names_of_loads(scene)
    rows = [kept(scene, model, names, seconds, step=1e-3, inputs=moved) for model in QUICK]
    own = rows[0][:, :1]
    found = [
        np.abs(one[:, -1:] - kept(scene, model, names, 2e-3, step=1e-3, start_values=end)[:, :1]) / own
        for model, one in zip(QUICK, rows, strict=True)
    ]
    return [float(one.max()) for one in (*found, np.abs(rows[1] - rows[0]) / own)]


def moves(
    begin: Mapping[str, float], rates: Mapping[str, float], way: float, seconds: float
) -> dict[str, Callable[[float], float]]:
    """Return inputs that drift: the speed by a share ``way``, temperatures at ``rates`` (K/s)."""
    speed = begin["shaft_speed"]
    found: dict[str, Callable[[float], float]] = {"shaft_speed": lambda t: speed * (1.0 + way * t / seconds)}
    for key, rate in rates.items():
        found[key] = lambda t, first=begin[key], rate=rate: first + rate * t
    return found


def names_of_loads(scene: Scene) -> list[str]:
    """Return the mean loads of the inner contacts of all bearings."""
    first = [name.removesuffix("inner_ring.velocity.x") for name in names_of(scene)[::8]]
    return [f"{one}contact.inner.load_mean" for one in first]


PARTS: dict[str, Callable[[], Iterator[Row]]] = {
    one.__name__: one
    for one in (
        across, run_up, limited_whirl, heavy_load, contact_loads, soft_pedestal, warm_jump, jumps,
        torque_renewed, stiff_preload, weak_damping, loose_tilt, bare_cages, weak_traction, small_waves,
        damped_waves, without_traction, drift,
    )
}  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure parts and write their rows."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--what", nargs="*", choices=list(PARTS), default=list(PARTS))
    parser.add_argument("--output", type=Path, required=True, help="folder for quick_limits.csv")
    given = parser.parse_args(arguments)
    found = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for part in given.what:
            for what, quantity, values in PARTS[part]():
                row = [what, quantity, *("" if np.isnan(one) else f"{one:.4g}" for one in values)]
                print(*row, sep=" | ", flush=True)
                found.append(row)
    given.output.mkdir(parents=True, exist_ok=True)
    write_csv(given.output / "quick_limits.csv", COLUMNS, found)


if __name__ == "__main__":
    main()
