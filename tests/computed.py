"""Sentences and rows of pages whose figures the package computes in moments, made from today's package.

Each function yields what its page has to say, as those of `tests.figures` do from tables; ``python -m
tests.figures`` writes them.
"""

import functools
import importlib
import math
import sys
import warnings

import numpy as np

from fmu_bearing import (
    error_motion,
    modes,
    new_scene,
    operating_point,
    read_scene,
    simulate,
    statics,
    verdicts,
    with_fidelity,
)  # fmt: skip
from fmu_bearing.engine.fidelities.condensed import uneven
from fmu_bearing.engine.fidelities.rings import frozen_points
from fmu_bearing.engine.layout import SD, P
from fmu_bearing.engine.statics import place
from fmu_bearing.instance import Instance
from fmu_bearing.modal.campbell import doubts
from fmu_bearing.prepare.model import land_clearance, pack, prepare
from fmu_bearing.prepare.surfaces import HIGHEST_BALL_ORDER
from fmu_bearing.scene import imperfections, nsk, read_scene_text
from fmu_bearing.vibration_test.lines import frequencies
from fmu_bearing.vibration_test.reading import reading
from fmu_bearing.vibration_test.rig import rig as vibration_rig
from fmu_bearing.vibration_test.subject import subject as vibration_subject
from tests.conftest import EXAMPLES, GATES, ROOT
from tests.engine.quasistatic import solve
from tests.spindle.test_flexible import first_frequency, spindle as study
from tests.tables import rounded, rows

SETS = ROOT / "examples" / "spindle_set"
PORT = ROOT / "examples" / "port" / "7003C-DB-port.toml"
RPM = math.pi / 30.0


@functools.cache
def example(name):
    """One of the example scenes of single bearings, silent."""
    return read_scene(EXAMPLES / f"{name}.toml").replace({"sound": None})


def perfect(**keys):
    """The spindle's scene without imperfections, with other values of ``operation``."""
    changes = {f"operation.{key}": value for key, value in keys.items()}
    return example("7003C-spindle").replace({"imperfections": None, **changes})


def bearing_at(scene):
    """The single bearing of a scene at its operating point."""
    return operating_point(scene).bearings[0]


def from_folder(folder, name):
    """A module of an example, imported as its script imports its neighbours."""
    sys.path.insert(0, str(folder))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.remove(str(folder))


def spindle():
    """Statics of the example's sets, and of the design study's."""
    scene = read_scene(SETS / "7003C-DB.toml")
    found = statics(scene)
    loads = []
    for one in found.table():
        cells = (
            f"{one['bearing']}, {one['carries']}", f"{one['position_mm']:g}", f"{one['axial_N']:.1f}",
            f"{one['force_z_N']:.1f}", f"{one['ball_load_max_N']:.1f}", f"{one['angle_inner_max_deg']:.2f}",
        )  # fmt: skip
        loads.append(cells)
    yield rows("loads", loads)
    yield (
        f"renewed when loads have moved by {100.0 * frozen_points._NEAR:g} %, speed by 1 %, or "
        f"temperatures have moved rings by {rounded(str(frozen_points._GROWN), 1)} m"
    )
    yield f"a ring is displaced by more than {place._FAR:g} of the pitch radius"
    yield from _lives(scene, found)
    yield from _preloads(scene)
    yield from _classes()
    point = operating_point(read_scene(SETS / "7003C-7002C.toml"))
    yield rows("different bearings", [
        (
            f"{one.load.number}, {one.scene.bearing.designation}", str(one.scene.bearing.ball_count),
            f"{one.axial:.1f}", f"{one.load.ball_loads.max():.1f}", f"{one.frequencies.f_o:.0f}",
            f"{1e3 * one.friction_torque:.1f}", f"{100 * round(one.life / 100):,}",
        )
        for one in point.bearings
    ])  # fmt: skip
    shafts = []
    for name, flexible in (("rigid", False), ("flexible", True)):
        one = study(flexible=flexible)
        nose = 1e-6 * statics(one, force=(0.0, 0.0, 0.0)).nose_stiffness
        shafts.append((name, f"{nose:.1f}", f"{first_frequency(one):.0f}"))
    yield rows("shafts", shafts)


def _lives(scene, found):
    lives = [float(one.value) for one in verdicts(operating_point(scene)) if one.key == "life"]
    together = sum(life ** (-10.0 / 9.0) for life in lives) ** -0.9
    first, second, both = (f"{100 * round(life / 100):,} h" for life in (*lives, together))
    pressure = found.table()[0]["pressure_inner_GPa"]
    yield (
        f"Bearing 1 has {pressure:.2f} GPa at its inner race and an L10r of {first}, bearing 2 {second}, "
        f"both together {both}"
    )
    yield f"over the axial load given: here {found.lift_off['+x'].load / scene.spindle.load.force_x_N:.1f}"


def _preloads(scene):
    """What the page's code prints over temperatures."""
    warm = []
    for celsius in (42.0, 52.0, 62.0):
        keys = {
            "operation.inner_ring_temperature_degC": celsius, "spindle.shaft.temperature_degC": celsius,
        }  # fmt: skip
        warm.append(statics(scene.replace(keys)))
    first, second, third = (round(one.preloads["running"][0]) for one in warm)
    yield (
        f"It prints {first}, {second} and {third} N, and a neutral spacing of "
        f"{1e3 * warm[-1].neutral_spacing:.1f} mm"
    )
    yield f"The bearings of the example are {1e3 * warm[-1].spacing:.0f} mm apart"


def _classes():
    """What the classes of a pair from one line give, and the loads of a triplet."""
    given = {"speed_rpm": 18e3, "sound": False}
    lost, lines = {}, []
    for name in nsk.CLASSES:
        point = operating_point(made("DB", preload_class=name, **given))
        found = point.statics
        loads = [found.preloads[state][0] for state in ("cold", "warm", "running")]
        lost[name] = loads[0] - loads[1]
        bad = {one.key: one for one in verdicts(point) if one.judgement not in ("good", "not judged")}
        (key,) = bad
        words = f"gyroscopic friction {bad[key].text}"
        if key == "speed":
            words = f"n d_m {bad[key].text} of {bad[key].limit}"
        cells = (f"{abs(load):.0f}" for load in (*loads, 1e-6 * found.nose_stiffness))
        lines.append((name, *cells, f"{100 * round(point.life / 100):,}", words))
    yield rows("preload classes", lines)
    yield f"takes {lost['medium']:.0f} N from the medium class and {lost['heavy']:.0f} N from the heavy one"
    low, _, high = statics(made("TBT", preload_class="medium", **given)).preloads["cold"]
    yield f"the medium class (390 N) against one carry {low:.0f} and {high:.0f} N"


def made(arrangement, **given):
    """A new scene of 7010C on one shaft."""
    return read_scene_text(
        new_scene("set", "NSK-7010C", arrangement=arrangement, **{"kind": "hybrid"} | given)
    )


def motor_spindle():
    """Preload and spacing of the motor spindle as its scene has it, its bending frequency."""
    cosimulate, run_up = (from_folder(SETS, name) for name in ("cosimulate", "run_up"))
    scene = read_scene(cosimulate.SCENE)
    found = statics(scene)
    cold, running = (np.mean(found.preloads[when]) for when in ("cold", "running"))
    near = np.mean(statics(cosimulate.closer(scene)).preloads["running"])
    yield (
        f"The middles of the pairs are {1e3 * found.spacing:.0f} mm apart and the neutral spacing is "
        f"{1e3 * found.neutral_spacing:.0f} mm"
    )
    yield f"Spacers that gave {cold:.0f} N leave {running:.0f} N at the temperatures of the scene"
    yield (
        "At the temperatures of the scene, where the housing is cooler than the shaft, it would be "
        f"{near:.0f} N"
    )
    yield f"**Springs** of {cosimulate.on_springs(scene).spindle.preload.force_N:.0f} N"
    bending = run_up.shaft_frequencies(scene)[1]
    yield f"The dashed line is the bending shaft in its bearings, {1e-3 * bending:.1f} kHz"


def limits():
    """Physics in closed form, the operating point, settled runs."""
    steel, radius, speed = example("7003C-spindle").materials.inner_ring, 9.9e-3, 40e3 * RPM
    growth = steel.density_kg_m3 * speed**2 * radius**3 / (1e9 * steel.youngs_modulus_GPa)
    yield f"A thin steel ring of 9.9 mm radius grows by {1e6 * growth:.1f} um at 40,000 r/min"
    scene = perfect()
    wide, narrow = (_clearance(scene, 0.1 * way) for way in (-1.0, 1.0))
    assert abs(wide - narrow) > 0.0
    yield (
        f"0.1 mm on it moves the 7003C's clearance of {_clearance(scene):.2f} mm by "
        f"{0.5 * (wide - narrow):.2f} mm"
    )
    p = pack(scene, np.empty(0))
    yield f"more room than the pockets ({1e3 * p[P.POCKET_CLEARANCE]:.2f} mm)"
    yield (
        f"from {_thickest(p, 20e3):.0f} mm2/s on at 20,000 r/min on the 7003C, "
        f"from {_thickest(p, 40e3):.0f} at 40,000"
    )
    yield f"up to {imperfections._HARMONICS} harmonics per race, to order {imperfections.HIGHEST_ORDER:,}"
    yield f"Pressure comes {SD.LATENCY} samples ({1e3 * SD.LATENCY / SD.RATE:.2f} ms) late"
    margins = [
        bearing_at(scene.replace({"mounting.preload_N": load})).contacts["inner"]["shoulder_margin"]
        for load in (800.0, 1000.0)
    ]
    assert margins[0] > 0.0 > margins[1], margins
    yield "Beyond about 1 kN preload the 7003C's contact is stiffer here than in reality"
    yield f"pushes the outer ring by more than {place._FAR:g} of the pitch radius"
    yield from _whirls()


def solution():
    """When what uneven balls add is renewed."""
    yield f"it is renewed at each {100.0 * uneven._MOVED:g} % of speed or load"


def rings():
    """Weak damping, skidding."""
    yield f"with a damping ratio below {doubts.LEAST:g}, or below {doubts.NARROW:g} with a line on it"
    yield from _skidding()


def _clearance(scene, more=0.0):
    """Clearance (mm) of the lands with so much more on the inner ring's effective diameter (mm)."""
    key = "bearing.inner_ring_outer_diameter_mm"
    changed = scene.replace({key: scene.bearing.inner_ring_outer_diameter_mm + more})
    return 1e3 * land_clearance(changed, changed.bearing.cage)


def _thickest(p, rpm):
    """Viscosity (mm2/s) at which the rolling resistance with SKF's factors is largest."""
    nu = np.geomspace(1.0, 500.0, 20_000)
    heating = 1.0 / (1.0 + p[P.SHEAR_HEATING] * rpm**1.28 * nu**0.64)
    return nu[np.argmax(nu**0.66 * heating * np.exp(-p[P.STARVATION] * nu * rpm))]


def _whirls():
    """Frequencies of the loose rings that whirl; speeds at which they do not."""
    found = {}
    for name, speeds in (("7009C-full-ceramic", (15e3, 18e3)), ("7009C-steel", (12e3, 18e3))):
        calm, whirling = (
            operating_point(example(name).replace({"operation.speed_rpm": rpm})).whirl for rpm in speeds
        )
        assert calm is None, name
        found[name] = f"{1e-3 * whirling[0]:.1f} kHz"
    yield f"at {found['7009C-full-ceramic']} (full ceramic) and {found['7009C-steel']} (steel)"
    yield "At 15,000 r/min (ceramic) and 12,000 r/min (steel) they do not"


def _skidding():
    """Cage speed over shaft speed after 60 ms with hardly any traction."""
    scene = example("7003C-bare").replace({"lubricant.traction_max": 5e-4})
    name = "cage.speed_ratio"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that balls skid, which the page says
        full, rings, response = (
            simulate(with_fidelity(scene, model=model), 0.06, step=1e-3, outputs=[name])[name][-1]
            for model in ("full", "rings", "response")
        )
    assert full > 0.5 > rings
    assert abs(rings - response) < 1e-3
    yield "with `traction_max` at 0.0005 the cage of the bare 7003C at 20,000 r/min runs at more than half"
    yield f"of the shaft's speed in `full`, at {rings:.2f} in both"


def coupling():
    """Torque over speed, heat over temperature, ripple of the torque, derivatives at a port."""
    inertia, balls = 1.64e-4, 1.19e-7  # kg m2, of docs/results/coupling.md
    lines = []
    for rpm in (2e3, 1e4, 2e4, 4e4):
        low, torque, high = (
            bearing_at(perfect(speed_rpm=share * rpm)).friction_torque for share in (0.98, 1.0, 1.02)
        )
        slope = (high - low) / (0.04 * rpm * RPM)
        longest = rounded(str(2.0 * (inertia - balls) / slope))
        lines.append((f"{rpm:,.0f}", f"{1e3 * torque:.1f}", rounded(str(slope)), f"{longest} s"))
    yield rows("torque", lines)
    lines = []
    for celsius in (20.0, 30.0, 40.0, 60.0):
        low, heat, high = (_heat(celsius + change) for change in (-1.0, 0.0, 1.0))
        slope = 0.5 * (high - low)
        lines.append((f"{celsius:.0f}", f"{heat:.0f}", f"{slope:.2f}" if abs(slope) > 5e-3 else "0"))
    yield rows("heat", lines)
    ripples = [share for name in ("bare", "spindle") for rpm in (1e4, 2e4) for share in _ripple(name, rpm)]
    yield (
        f"on the scenes of the 7003C by at most {math.ceil(100.0 * max(ripples))} % either "
        "way at 10,000 and 20,000 r/min"  # 6.3 and 6.6 by the rounding of two processors
    )
    yield from _derivatives()


def _heat(celsius):
    """Heat (W) of the perfect spindle over the oil's temperature."""
    scene = perfect(oil_temperature_degC=celsius)
    return bearing_at(scene).friction_torque * scene.operation.speed_rpm * RPM


def _ripple(name, rpm):
    """How far the torque goes above and below its mean, over 40 ms after 20 ms."""
    scene = example(f"7003C-{name}").replace({"operation.speed_rpm": rpm})
    name = "friction_torque"
    torque = simulate(scene, 0.06, step=1e-4, outputs=[name])[name][200:]
    return torque.max() / torque.mean() - 1.0, 1.0 - torque.min() / torque.mean()


def _derivatives():
    """Radial derivatives of the force at the example's port over the step."""
    one = Instance(prepare(read_scene(PORT).replace({"fidelity.model": "full"})), tell=lambda _: None)
    one.initialise()
    found = [one.port_derivatives(1e-6 * step) for step in (1, 2, 5, 10, 20, 50, 100, 1000)]
    place = (f"{1e-6 * by_place[2, 2]:.0f}" for by_place, _ in found)
    rate = (f"{by_rate[2, 2]:.0f}" for _, by_rate in found)
    yield f"| dF/dx, N/um | {' | '.join(place)} |"
    yield f"| dF/dv, N s/m | {' | '.join(rate)} |"


def gallery():
    """The strongest line of the spectrum, the rotor on the balls."""
    point = bearing_at(perfect())
    found = point.frequencies
    yield f"The strongest line, at {found.f_i - found.f_r:.0f} Hz, is f_i - f_r"
    yield f"the radial one at {_rings_at(point)} kHz"


def _rings_at(point):
    """Frequency (kHz) of the rotor on the balls."""
    return f"{1e-3 * from_folder(ROOT / 'examples' / 'gallery', 'gallery').resonance(point):.1f}"


def error_motion_page():
    """Values and sources of the 7003C alone in fidelity rings."""
    scene = with_fidelity(example("7003C-bare"), model="rings")
    one = error_motion(scene, 2000.0, revolutions=50).speeds[0]
    values = []
    for found in one.values[:4]:
        figures = (found.asynchronous, found.synchronous, found.synchronous_by_line)
        cells = [f"{1e6 * value:.{digits}f}" for value, digits in zip(figures, (3, 4, 4), strict=True)]
        values.append((found.direction, *cells))
    yield rows("values", values)
    sources = (
        (part.source, *(f"{1e6 * x:.3f}" for x in (part.radial, part.axial))) for part in one.per_source
    )
    yield rows("sources", sources)
    yield f"The lines hold {100.0 * one.explained:.0f} % of the energy"
    race = one.nose.rates[0].f_o / one.nose.rates[0].f_r
    yield f"On the 7003C of this page it is {race:.2f} f_r"
    left = abs(np.sin(16 * np.pi * race) / (16 * np.sin(np.pi * race)))
    yield f"Over 16 revolutions an average takes {100.0 * left:.0f} % of such a line"


def examples():
    """Settings of the example scripts that the page repeats."""
    tolerance = from_folder(ROOT / "examples" / "tolerance_study", "tolerance")
    yield f"{tolerance.SEEDS} bearings of each class are drawn from seeds"
    where = _rings_at(bearing_at(perfect()))
    yield f"where they come to {where} kHz, at which the rotor rings on the balls"


def vibration():
    """Modes of the rig, where the waves of balls end, and a line on an edge."""
    tested = {name: vibration_rig(vibration_subject(name), rigid=True) for name in ("7003C", "7009C")}
    found = {name: modes(scene).modes for name, scene in tested.items()}
    first = {
        (name, kind): min(one.frequency for one in found[name] if one.name.startswith(f"outer {kind}"))
        for name in found for kind in ("tilt", "radial")
    }  # fmt: skip
    yield f"on the 7003C at {1e-3 * first['7003C', 'tilt']:.2f} kHz"
    high, higher = (1e-3 * first[name, "radial"] for name in ("7009C", "7003C"))
    yield f"on the 7009C at {high:.1f} kHz (7003C: {higher:.1f})"
    turned = reading(with_fidelity(tested["7003C"], model="rings"))
    rates = frequencies(tested["7003C"], turned)
    yield f"2 f_o of the 7003C is at {2.0 * rates.f_o:.1f} Hz"
    yield f"order {HIGHEST_BALL_ORDER}, on the 7003C {1e-3 * HIGHEST_BALL_ORDER * rates.f_b:.1f} kHz"


#: By bearing: gate scene, preload (N), design values (N/m^1.5 over 1e10; N, deg, um).
DESIGN = {
    "7003C": ("7003C-bare", 500.0, (2.541, 2.407), (115.62, 21.12, 18.01)),
    "7009C": ("7009C-full-ceramic", 350.0, (3.575, 3.361), (70.11, 17.08, 11.58)),
}


def validation():
    """Design values beside those of the engine at rest."""
    races, loads = [], []
    for bearing, (name, preload, stiffness, values) in DESIGN.items():
        scene = read_scene(GATES / f"{name}.toml").replace({"sound": None})
        p, found = pack(scene, np.empty(0)), solve(scene, 0.0, preload)
        for race, at, design in zip(("inner", "outer"), (0, P.RACE_SIZE), stiffness, strict=True):
            own = 1e-10 * p[P.RACES + at + P.RACE_STIFFNESS]
            races.append((f"{bearing}, {race}", f"{design:.3f}e10", f"{own:.3f}e10"))
        computed = found["load_i"], found["angle_i"], 1e6 * found["shift"]
        names = ("ball load", "N"), ("contact angle", "deg"), ("axial displacement", "um")
        for (quantity, unit), design, value in zip(names, values, computed, strict=True):
            loads.append(
                (f"{bearing}, {preload:.0f} N: {quantity}", f"{design:.2f} {unit}", f"{value:.2f} {unit}")
            )
        if bearing == "7003C":
            axial, radial, tilt, _ = found["stiffness"]
            loads += [
                (f"{bearing}, 500 N: {name} stiffness", design, f"{value:.3f}e{power} {unit}")
                for name, design, value, power, unit in (
                    ("axial", "5.57e7 N/m", 1e-7 * axial, 7, "N/m"),
                    ("radial", "1.63e8 N/m", 1e-8 * radial, 8, "N/m"),
                    ("tilt", "4.73e3 N m/rad", 1e-3 * tilt, 3, "N m/rad"),
                )
            ]
    yield rows("races", races)
    yield rows("at rest", loads)


PAGES = {
    "coupling.md": coupling, "error-motion.md": error_motion_page,
    "examples.md": examples, "fidelities/rings.md": rings, "gallery.md": gallery, "limits.md": limits,
    "motor-spindle.md": motor_spindle, "solution.md": solution, "spindle.md": spindle,
    "validation.md": validation, "vibration.md": vibration,
}  # fmt: skip
