"""Pages to learn from: their code runs and prints what they show, and their figures are the package's."""

import functools
import math
import re

import pytest

from fmu_bearing.design.fits import fits
from fmu_bearing.design.fresh import new_scene
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.rating import preload_classes
from fmu_bearing.design.temperatures import temperatures
from fmu_bearing.design.verdicts import GYROSCOPIC, HIGH_PRESSURE, verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas import clearances, iso76, iso281, makers, seals
from fmu_bearing.machining.stability import lobes
from fmu_bearing.modal.receptance.scene_receptance import receptance
from fmu_bearing.prepare.contacts import surfaces
from fmu_bearing.prepare.defect_blocks import of_scene
from fmu_bearing.prepare.fits import seats
from fmu_bearing.recording.record import record
from fmu_bearing.scene import read_scene, read_scene_text
from tests.conftest import EXAMPLES
from tests.engine.defects import left as left_by
from tests.pages import DOCS, run_page

pytestmark = pytest.mark.pages

LEARN = DOCS / "learn"
PAGES = sorted(path.name for path in LEARN.glob("*.md"))


@functools.cache
def whole(preload=500.0, name="7003C-spindle", **keys):
    """Operating point of an example; keys of a scene with their dots written as two underscores."""
    changed = {key.replace("__", "."): value for key, value in keys.items()}
    scene = read_scene(EXAMPLES / f"{name}.toml").replace({"mounting.preload_N": preload} | changed)
    return operating_point(scene)


def point(*given, **keys):
    """Its bearing."""
    return whole(*given, **keys).bearings[0]


def greased():
    return whole(lubricant__supply="grease")


def at_end(name, end, of=None):
    """Friction torque with one input at an end, N m."""
    (found,) = (one for one in (of or whole()).torque_range.inputs if one.name == name)
    return getattr(found, end).torques[0]


def pressure(found, ring="inner"):
    return 1e-9 * found.contacts[ring]["pressure_max"]


def radial(found):
    return 1e-6 * found.stiffness[1, 1]


def resonance(found):
    """Hz: rotor and housing of the scene against each other on the balls."""
    mounting = found.scene.mounting
    masses = 1.0 / mounting.rotor.mass_kg + 1.0 / mounting.housing.mass_kg
    return math.sqrt(found.stiffness[1, 1] * masses) / (2.0 * math.pi)


def heavy(found):
    """N: makers' heavy class."""
    return preload_classes(found.scene).loads["heavy"]


def warm(**keys):
    return point(operation__oil_temperature_degC=60.0, **keys)


def ball_load(mode, kelvin):
    found = point(100.0, mounting__preload_mode=mode, operation__inner_ring_temperature_degC=40.0 + kelvin)
    return found.contacts["inner"]["load_mean"]


def side(force, preload=500.0):
    return point(preload, mounting__radial_load_z_N=-force)


def static_safety(found):
    return found.rating.static / iso76.static_load(found.scene.bearing.contact_angle_deg, 500.0, 0.0)


CERAMIC = (350.0, "7009C-full-ceramic")


def ceramic():
    return point(*CERAMIC)


SPINDLE = EXAMPLES / "7003C-spindle.toml"
SET = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


@functools.cache
def settled(scene, preload=None, speed=None, water=None):
    """Steady temperatures and operating point by the package's network."""
    values = {"mounting.preload_N": preload, "operation.speed_rpm": speed}
    given = {key: value for key, value in values.items() if value is not None}
    found = temperatures(read_scene(scene).replace(given), cooling=water)
    return found.places, operating_point(found.scene)


@functools.cache
def sealed():
    """Steady temperatures with contact seals at 10,000 r/min."""
    return temperatures(
        read_scene(SPINDLE).replace({"bearing.seal.kind": "RS1", "operation.speed_rpm": 10e3})
    )


def lip():
    """Diameter on which the lips rub, mm."""
    return sealed().scene.bearing.lip_diameter


@functools.cache
def motor_scene():
    """The scene of the page on the bearing of a motor."""
    made = new_scene("motor", "6205", clearance="C3", radial_load_N=500.0, speed_rpm=3000.0)
    return read_scene_text(made).replace(
        {
            "lubricant.supply": "grease",
            "lubricant.viscosity_Pa_s": 0.3,
            "mounting.fit.shaft.interference_um": 10.0,
        }
    )


@functools.cache
def motor(kelvin=0.0, washer=200.0, group="C3", **keys):
    """Its operating point with an inner ring so much warmer than the outer one."""
    return operating_point(
        motor_scene().replace(
            {
                "operation.inner_ring_temperature_degC": 60.0 + kelvin,
                "operation.outer_ring_temperature_degC": 60.0,
                "operation.oil_temperature_degC": 60.0 + kelvin / 2.0,
                "mounting.preload_N": washer,
                "bearing.clearance": group,
            }
            | {key.replace("__", "."): value for key, value in keys.items()}
        )
    )


def largest(found):
    return found.bearings[0].load.ball_loads[0].max()


def left(found):
    """Clearance at the operating point, um."""
    (value,) = (one.value for one in verdicts(found) if one.key == "clearance")
    return 1e6 * value


@functools.cache
def rubbed(kind):
    """Steady temperatures of the motor's bearing with seals."""
    scene = motor_scene().replace({"mounting.preload_N": 200.0, "bearing.seal.kind": kind})
    return temperatures(scene, ambient=40.0, cooling=1.0)


CERAMIC_ON_SHAFT = EXAMPLES.parent / "fits" / "7003C-ceramic.toml"


@functools.cache
def fitted(kelvin=40.0, shaft_class="js5", **more):
    """Study of the ceramic bearing on its shaft, all parts at one temperature (degC)."""
    warm = {f"operation.{ring}_ring_temperature_degC": kelvin for ring in ("inner", "outer")}
    warm |= {f"mounting.fit.{seat}.temperature_degC": kelvin for seat in ("shaft", "housing")}
    more = {key.replace("__", "."): value for key, value in more.items()}
    scene = read_scene(CERAMIC_ON_SHAFT).replace(
        warm | {"mounting.fit.shaft.shaft_class": shaft_class} | more
    )
    return fits(scene)


def pair(take="mean", **keys):
    """Its bearing with one interference."""
    return fitted(**keys).column(take).bearings[0]


def at_seat(state, take="mean", **keys):
    return pair(take, **keys).seats["inner"].states[state]


def per_kelvin_of_the_shaft():
    one = seats(read_scene(CERAMIC_ON_SHAFT))[0].fit
    return one.hoop * one.pressure * one.partner


def degrees_per_um():
    """What 1 um of race radius takes off the free angle of the 7003C."""
    b = read_scene(SPINDLE).bearing
    apart = (b.inner_conformity + b.outer_conformity - 1.0) * b.ball_diameter_mm
    return b.contact_angle_deg - math.degrees(
        math.acos(math.cos(math.radians(b.contact_angle_deg)) + 1e-3 / apart)
    )


END_MILL = EXAMPLES.parent / "milling" / "7003C-QBC-end-mill.toml"


@functools.cache
def milled(**keys):
    """Lobes of the end mill with other keys, dots written as two underscores."""
    return lobes(read_scene(END_MILL).replace({key.replace("__", "."): value for key, value in keys.items()}))


def deepest(rpm, **keys):
    """Limit of its depth at a speed, mm."""
    found = milled(**keys)
    return 1e3 * min(found.limits, key=lambda one: abs(one.speed - rpm)).depth


def floor(**keys):
    """Least limit, mm."""
    return 1e3 * milled(**keys).least.depth


@functools.cache
def tip():
    """Peak of its tip along Y."""
    return receptance(END_MILL, at="tip").peaks()[1]


@functools.cache
def fan_scene():
    """The scene of the page on a spall."""
    made = new_scene("fan", "6205", clearance="CN", radial_load_N=500.0, speed_rpm=1500.0)
    return read_scene_text(made).replace({"mounting.preload_N": 100.0})


def fan():
    return operating_point(fan_scene()).bearings[0]


def sinks(length):
    """What a rigid ball sinks into a spall (mm) of the outer race that is as wide as the track, um."""
    along, _, _ = surfaces(fan_scene(), 1)
    return length**2 / (8.0 * along)


def bridged(length):
    """What a round pit (mm) takes off an approach of 5 um, um."""
    pit = {"on": "outer", "shape": "pit", "length_mm": length, "depth_um": 100.0, "angle_deg": 180.0}
    (one,) = of_scene(fan_scene().replace({"imperfections.defect": [pit]}), [0])
    return 1e6 * (5e-6 - left_by(one.tables[1], 5e-6, 0.0))


SOFT = {"spindle__preload__preload_N": 60.0}
STIFF = {"spindle__preload__preload_N": 240.0}
#: Its inner rings have 44 degC.
WARM, COOL = ({"operation__inner_ring_temperature_degC": degC} for degC in (54.0, 34.0))

#: Figures of each page in words, and where they come from.
FIGURES = {
    "tutorial.md": {
        "0.52 |": lambda: 1e-6 * point().speed_number,
        "2.19:": lambda: 1e-6 * point().speed_limit,
        "5.4 N:": lambda: point().least_preload,
        "0.084 C |": lambda: 500.0 / point().rating.dynamic,
        "179 N here": lambda: heavy(point()),
        "2.8 times heavy": lambda: 500.0 / heavy(point()),
        "1.89 GPa": lambda: pressure(point()),
        "1.50 GPa": lambda: 1e-9 * makers.CLASS_PRESSURE["hybrid"],
        "11.8 |": lambda: point().film,
        "1199 h |": lambda: iso281.hours(point().reference_life, 20_000.0),
        "974 |": lambda: point().rating.life,
        "1.17 GPa": lambda: pressure(point(100.0)),
        "59903 |": lambda: point(100.0).rating.life,
        "159.5 | 100.8": lambda: radial(point()),
        "100.8 |": lambda: radial(point(100.0)),
        "57.5 | 24.1": lambda: 1e-6 * point().stiffness[0, 0],
        "24.1 |": lambda: 1e-6 * point(100.0).stiffness[0, 0],
        "1987 Hz": lambda: point().frequencies.f_i - point().frequencies.f_r,
        "1672 Hz": lambda: point(100.0).frequencies.f_o,
        "1738 Hz": lambda: 2.0 * point(100.0).frequencies.f_b - point(100.0).frequencies.f_c,
        "1994 Hz": lambda: point(100.0).frequencies.f_i - point(100.0).frequencies.f_r,
        "1986 Hz": lambda: resonance(point()),
        "1579 Hz": lambda: resonance(point(100.0)),
        "1720 Hz": lambda: resonance(point(175.0)),
        "0.77 instead": lambda: warm().viscosity_ratio,
        "1.79 (": lambda: point().viscosity_ratio,
        "1.93 GPa": lambda: pressure(side(300.0, 100.0)),
    },
    "preload.md": {
        "5.4 N.": lambda: point().least_preload,
        "0.084 C": lambda: 500.0 / point().rating.dynamic,
        "2.8 times": lambda: 500.0 / heavy(point()),
        "179 N": lambda: heavy(point()),
        "1.89 GPa": lambda: pressure(point()),
        "1.34 steel": lambda: 1e-9 * makers.CLASS_PRESSURE["steel"],
        "1.50 hybrid": lambda: 1e-9 * makers.CLASS_PRESSURE["hybrid"],
        "2.0 | races": lambda: 1e-9 * HIGH_PRESSURE,
        "2.16 GPa": lambda: pressure(side(300.0)),
        "0.0012 here": lambda: point().gyroscopic_friction,
        "0.02 (Harris": lambda: GYROSCOPIC,
        "0.0209 there": lambda: ceramic().gyroscopic_friction,
        "25.2 N": lambda: ball_load("force", 0.0),
        "27.4 N": lambda: ball_load("force", 10.0),
        "16.1 N": lambda: ball_load("rigid", 0.0),
        "34.4 N": lambda: ball_load("rigid", 10.0),
        "0.98 GPa": lambda: pressure(ceramic(), "outer"),
        "111 N against": lambda: ceramic().least_preload,
        "93 % of the": lambda: 100.0 * (1.0 - point().rating.life / point(179.0).rating.life),
    },
    "life.md": {
        "5958 N": lambda: point().rating.dynamic,
        "566 N": lambda: point().rating.equivalent,
        "974 h,": lambda: point().rating.life,
        "519 h": lambda: side(300.0).rating.life,
        "1199 h": lambda: iso281.hours(point().reference_life, 20_000.0),
        "11.8 |": lambda: point().film,
        "1.79 |": lambda: point().viscosity_ratio,
        "0.77 here": lambda: warm().viscosity_ratio,
        "6.7 times": lambda: warm().film,
        "3461 N": lambda: point().rating.static,
        "230 N": lambda: iso76.static_load(15.0, 500.0, 0.0),
        "15.0 with": lambda: static_safety(point()),
        "10.5 with": lambda: 0.7 * static_safety(point()),
        "0.98 GPa": lambda: pressure(ceramic(), "outer"),
        "28.5 times": lambda: ceramic().film,
    },
    "heat.md": {
        "44.23 W with": lambda: point().heat.total,
        "73 % of": lambda: 100.0 * point().heat.rolling / point().heat.total,
        "29.66 N mm, 40": lambda: 1e3 * at_end("supply", "high"),
        "40 % more": lambda: 100.0 * (at_end("supply", "high") / point().friction_torque - 1.0),
        "1 % of the torque": lambda: 100.0 * (at_end("drag_density", "high") / point().friction_torque - 1.0),
        "43.96 W in": lambda: greased().bearings[0].heat.total,
        "21.71 29.53": lambda: 1e3 * at_end("grease", "low", greased()),
        "29.53 ```": lambda: 1e3 * at_end("grease", "high", greased()),
        "1.54 times": lambda: 2.0 / 1.3,
        "1.49 times": lambda: 2.0 / 1.34,
        "18.2 N mm by": lambda: sealed().scene.bearing.seal_torque,
        "55.2 degC, without": lambda: sealed().places[1, "inner_ring"],
        "31.7 degC, where": lambda: settled(SPINDLE, speed=10e3)[0][1, "inner_ring"],
        "21.38 W. A": lambda: settled(SPINDLE, speed=10e3)[1].heat.total,
        "25.3 m/s,": lambda: lip() / 2e3 * 20e3 * RPM,
        "11049 r/min": lambda: seals.LIP_SPEED / (lip() / 2e3 * RPM),
        "32.7 degC, its": lambda: settled(SET)[0][0, "shaft"],
        "22.8 degC. The": lambda: settled(SET)[0][0, "housing"],
        "9.9 K.": lambda: settled(SET)[0][0, "shaft"] - settled(SET)[0][0, "housing"],
        "211 N instead": lambda: settled(SET)[1].bearings[0].axial,
        "167 N, and": lambda: operating_point(SET).bearings[0].axial,
        "10537 h instead": lambda: settled(SET)[1].bearings[0].life,
        "21553 h.": lambda: operating_point(SET).bearings[0].life,
        "15.8 K warmer": lambda: settled(SPINDLE)[0][1, "inner_ring"] - settled(SPINDLE)[0][1, "outer_ring"],
        "32.1 degC instead": lambda: settled(SPINDLE, water=2.0)[0][1, "outer_ring"],
        "44.3 degC instead": lambda: settled(SPINDLE, water=2.0)[0][1, "oil"],
    },
    "fits.md": {
        "1.5 of its 15": lambda: degrees_per_um(),
        "3.7 times as": lambda: 11.8 / 3.2,
        "24 MPa after": lambda: 1e-6 * at_seat("mounted").hoop,
        "61 MPa at 40": lambda: 1e-6 * at_seat("running").hoop,
        "134 MPa for": lambda: 1e-6 * at_seat("running", "max").hoop,
        "255 N instead": lambda: pair().preloads["running"],
        "390 N. The": lambda: pair("max").preloads["running"],
        "97 MPa are": lambda: 1e-6 * at_seat("running", kelvin=60.0).hoop,
        "170 MPa at most": lambda: 1e-6 * at_seat("running", "max", kelvin=60.0).hoop,
        "66 MPa and": lambda: 1e-6 * at_seat("running", kelvin=60.0, shaft_class="h4").hoop,
        "265 N, the": lambda: pair(kelvin=60.0, shaft_class="h4").preloads["running"],
        "121 MPa and": lambda: 1e-6 * at_seat("running", "max", kelvin=60.0, shaft_class="h4").hoop,
        "365 N |": lambda: pair("max", kelvin=60.0, shaft_class="h4").preloads["running"],
        "2.4 MPa off": lambda: 1e-6 * per_kelvin_of_the_shaft(),
        "320 N in the mean": lambda: pair(kelvin=60.0).preloads["running"],
        "458 N at most": lambda: pair("max", kelvin=60.0).preloads["running"],
    },
    "motor-bearing.md": {
        "125 to 250 N": lambda: 5.0 * motor().scene.bearing.bore_mm,
        "250 N.": lambda: 10.0 * motor().scene.bearing.bore_mm,
        "253 N to": lambda: largest(motor(washer=0.0)),
        "217 N.": lambda: largest(motor()),
        "3.64 with": lambda: motor().bearings[0].viscosity_ratio,
        "4.4 um: each": lambda: -left(motor(20.0, group="CN")),
        "3.6 um. Each": lambda: left(motor(20.0)),
        "7.5 um either": lambda: clearances.limits("C3", 25.0).high - clearances.limits("C3", 25.0).middle,
        "3.9 um, so": lambda: -left(motor(20.0, bearing__radial_clearance_um=13.0, group=None)),
        "9 K above": lambda: rubbed("RSH").places[1, "inner_ring"] - rubbed("RSH").places[1, "outer_ring"],
        "3.6 um and": lambda: left(motor(20.0)),
        "75995 h": lambda: motor(20.0).bearings[0].life,
        "20.9 W in": lambda: rubbed("RSH").heats[0].seals,
        "1.3 W.**": lambda: rubbed("RSL").heats[0].seals,
    },
    "chatter.md": {
        "2.4 N/um, at": lambda: 1e-6 * tip().stiffness,
        "1472 Hz": lambda: tip().frequency,
        "0.04 N/um": lambda: 1e-6 * tip().dynamic,
        "0.40 of its": lambda: tip().cross,
        "0.103 mm, three": lambda: floor(**SOFT),
        "0.65 mm at": lambda: deepest(18e3, **SOFT),
        "0.045 and": lambda: floor(**STIFF),
        "0.12 mm.": lambda: deepest(18e3, **STIFF),
        "0.120 mm in": lambda: deepest(18e3, **WARM),
        "1520 Hz in": lambda: milled(**WARM).own.frequency,
        "1.78 mm, because": lambda: deepest(18e3, **COOL),
        "0.4 of the limit": lambda: 0.5 / deepest(20_250.0),
        "7 % less": lambda: (
            100.0 * (1.0 - deepest(20_250.0, bearing__contact_damping_us=1.25) / deepest(20_250.0))
        ),
        "0.07 mm, 0.7": lambda: 0.7 * deepest(18e3, bearing__contact_damping_us=1.25),
    },
    # what runs with strokes give is in test_learn_spall.py
    "spall.md": {
        "90.0 Hz in": lambda: fan().frequencies.f_o,
        "0.400 of the": lambda: fan().frequencies.f_c / fan().frequencies.f_r,
        "6.5 um over": lambda: sinks(0.5),
        "104 um deep": lambda: sinks(2.0),
        "0.7 um.": lambda: bridged(0.5),
        "0.16 mm here": lambda: (
            fan_scene().bearing.cage.pocket_diameter_mm - fan_scene().bearing.ball_diameter_mm
        ),
    },
    "noise.md": {
        "159.5 N/um": lambda: radial(point()),
        "1986 Hz": lambda: resonance(point()),
        "1987 Hz": lambda: point().frequencies.f_i - point().frequencies.f_r,
    },
}


def _studied(page):
    """The page; fits has three studies of five columns, 5 s each, chatter five of lobes, 10 s each."""
    heavy = page in ("fits.md", "chatter.md")
    return pytest.param(page, marks=pytest.mark.heavy) if heavy else page


@pytest.mark.heavy
def test_strength_decides_whether_a_ring_breaks():
    """Chances on the page, at 60 degC and speed: mean and tightest pair, one digit each."""
    text = " ".join((LEARN / "fits.md").read_text(encoding="utf-8").split())
    assert "that is still 9e-7" in text
    assert "with 600 MPa and 7 the mean pair breaks with 6e-4, and the tightest with 3 in 100" in text
    ring = "materials__inner_ring__"
    weak = {f"{ring}bending_strength_MPa": 600.0, f"{ring}weibull_modulus": 7.0}
    chances = [
        pair(take, kelvin=60.0, **more).seats["inner"].breaking["running"]
        for take, more in (("max", {}), ("mean", weak), ("max", weak))
    ]
    assert [f"{chance:.0e}" for chance in chances] == ["9e-07", "6e-04", "3e-02"]


@pytest.mark.parametrize("page", [_studied(page) for page in PAGES])
def test_figures_of_a_page_are_those_of_the_package(page):
    text = " ".join((LEARN / page).read_text(encoding="utf-8").split())
    for shown, value in FIGURES[page].items():
        assert shown in text, shown
        number = re.match(r"\d+(?:\.(\d+))?", shown)
        # rounded once, where a last digit may fall either way
        allowed = 0.51 * 10.0 ** -len(number[1] or "")
        assert value() == pytest.approx(float(number[0]), abs=allowed), shown


def rows(page, columns):
    """Rows of numbers of the table of a page whose head begins with ``columns``."""
    lines = (LEARN / page).read_text(encoding="utf-8").splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith(f"| {columns}")) + 2
    found = []
    for line in lines[first:]:
        if not line.startswith("|"):
            break
        found.append([float(cell) for cell in line.strip("|").split("|")])
    return found


def test_table_of_preloads():
    table = rows("preload.md", "preload, N | share")
    assert len(table) == 4
    for preload, share, gigapascal, axial, across, life in table:
        found = point(preload)
        assert share == pytest.approx(preload / found.rating.dynamic, abs=6e-5)
        assert gigapascal == pytest.approx(pressure(found), abs=6e-3)
        assert axial == pytest.approx(1e-6 * found.stiffness[0, 0], abs=0.06)
        assert across == pytest.approx(radial(found), abs=0.06)
        assert life == pytest.approx(1e-3 * found.rating.life, abs=0.06)


@pytest.mark.heavy
def test_table_of_damping():
    """Rows by their words; the floor of the lobes moves by what the sentence below says, in a ratio of 90."""
    rows = {
        "as it is": {},
        "contacts 1.25 us": {"bearing__contact_damping_us": 1.25},
        "contacts 5 us": {"bearing__contact_damping_us": 5.0},
        "shaft 0.0025": {"spindle__shaft__damping_ratio": 0.0025},
        "shaft 0.01": {"spindle__shaft__damping_ratio": 0.01},
        "tool 0.005": {"tool__damping_ratio": 0.005},
        "tool 0.02": {"tool__damping_ratio": 0.02},
    }
    text = (LEARN / "chatter.md").read_text(encoding="utf-8")
    for words, keys in rows.items():
        cells = re.search(rf"\| {re.escape(words)} \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|", text).groups()
        found = floor(**keys), deepest(18e3, **keys), deepest(20_250.0, **keys)
        for cell, value, digits in zip(cells, found, (3, 3, 2), strict=True):
            assert float(cell) == pytest.approx(value, abs=0.51 * 10.0**-digits), words
    assert milled().pockets()[0].depth / milled().least.depth == pytest.approx(90.0, rel=0.05)


def test_table_of_lives():
    for load, equivalent, life in rows("life.md", "axial load, N | P"):
        found = point(load).rating
        assert (equivalent, life) == pytest.approx((found.equivalent, found.life), abs=0.6)


def test_table_of_temperatures():
    table = rows("heat.md", "preload, N | speed")
    assert len(table) == 6
    for preload, speed, heat, oil, ring, ratio, life in table:
        found, at = settled(SPINDLE, preload, speed)
        reached = (at.heat.total, found[1, "oil"], found[1, "inner_ring"])
        assert reached == pytest.approx((heat, oil, ring), abs=0.06)
        (one,) = at.bearings
        assert one.viscosity_ratio == pytest.approx(ratio, abs=6e-3)
        assert one.life == pytest.approx(life, rel=1e-3, abs=0.51)  # whole hours, 0.001 K of the last round


def test_shares_of_makers():
    text = " ".join((LEARN / "preload.md").read_text(encoding="utf-8").split())
    for angle, shares in makers.PRELOAD_CLASSES.items():
        cells = re.search(rf"\| {angle:g} deg \| ([\d.]+) C \| ([\d.]+) C \| ([\d.]+) C \|", text)
        assert tuple(map(float, cells.groups())) == shares
    speeds = [makers.RIGID_SPEED[name] for name in makers.CLASS_NAMES]
    assert "GMN allows them {}, {} and {} of".format(*speeds) in text


@pytest.mark.parametrize("page", PAGES)
def test_a_page_ends_in_a_decision(page):
    text = (LEARN / page).read_text(encoding="utf-8")
    assert "\n**Decision: " in text
    after = text.split("\n**Decision: ")[1].split("**")[1]
    assert "#" not in after and len(after) < 200  # links to what comes next at most


def test_no_life_where_no_standard_gives_one():
    """What the pages say of full ceramic bearings is what the package prints."""
    assert ceramic().rating is None and ceramic().reference_life is None
    reported = {one.key: one.judgement for one in verdicts(whole(*CERAMIC))}
    for key in ("life", "static_safety", "pressure", "preload_class", "speed", "kappa", "spin"):
        assert reported[key] == "not judged"
    assert reported["gyroscopic"] == "watch" and reported["least_preload"] == reported["film"] == "good"
    assert "life_modified" not in {one.key for one in verdicts(whole())}  # hybrid


def test_a_wanted_life_is_judged():
    """Decision of the page on life: 20,000 h are not met at 500 N, and are at 150 N."""
    for preload, judgement in ((500.0, "change"), (150.0, "good")):
        for found in (whole(preload), whole(preload, operation__required_life_h=20_000.0)):
            assert {one.key: one.judgement for one in verdicts(found)}["life"] == judgement


def weighed(page):
    """The page; tutorial (a report), noise and spall (many runs), fits, chatter (studies): some 20 s each."""
    heavy = page in ("tutorial.md", "noise.md", "fits.md", "chatter.md", "spall.md")
    return pytest.param(page, marks=pytest.mark.heavy) if heavy else page


@pytest.mark.parametrize("page", [weighed(page) for page in PAGES])
def test_a_page_shows_what_its_code_prints(page, tmp_path, monkeypatch):
    run_page(LEARN / page, tmp_path, monkeypatch, shown=True)
    if page == "preload.md":
        assert read_scene(tmp_path / "nsk.toml").mounting.preload_N == 150.0
    if page == "tutorial.md":
        reported = re.sub(r"<[^>]+>", " ", (tmp_path / "out" / "asked.html").read_text(encoding="utf-8"))
        assert re.search(r"largest contact pressure\s+2\.02\s+GPa", reported)
        assert re.search(r"friction power\s+44\.2\s+W", reported)
        assert "at 1987 Hz" in reported


def test_a_preload_in_between_is_as_loud():
    """175 N, in words on the page: the mean of eight draws in fidelity response."""
    scene = read_scene(EXAMPLES / "7003C-spindle.toml").replace(
        {"fidelity.model": "response", "mounting.preload_N": 175.0}
    )
    levels = [
        record(
            scene.replace({"imperfections.seed": seed}),
            0.2,
            settle=0.05,
            radiation_model="compact",
            progress=False,
        ).levels(["P1"], weighting="A")[0]
        for seed in range(1, 9)
    ]
    assert sum(levels) / len(levels) == pytest.approx(71.4, abs=0.1)
    assert "mean of 71.4 dB(A)" in (LEARN / "tutorial.md").read_text(encoding="utf-8")
