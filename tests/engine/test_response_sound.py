"""Sound of fidelity `response` from its lines against the same motion sampled at 51.2 kHz and filtered."""

import pathlib

import numpy as np
import pytest

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import SD, L, P, S, U
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.read import with_fidelity
from tests.spindle.test_sound import pair as set_of_two, sound

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples"
SCENES = ("7003C-bare", "7003C-impact", "7003C-spindle", "7009C-full-ceramic", "7009C-steel")
PLACES = [(-60.0, 0.0, 80.0), (60.0, 105.0, 0.0)]  # mm: microphones of a set
STEP = 1e-3
RPM = np.pi / 30


def pair(scene):
    """Return the scene's sampled run and that of its lines."""
    return [Instance(prepare(scene, fidelity="response", samples=samples)) for samples in (True, False)]


def levels(runs, names, duration, ramp=None):
    """Levels of both runs after each ms, shape (runs, times, names); ``ramp``: r/min over time (s)."""
    count = round(duration / STEP)
    found = np.empty((len(runs), count, len(names)))
    for rows, run in zip(found, runs, strict=True):
        if ramp is not None:
            run.set("shaft_speed", ramp(0.0) * RPM)
        run.initialise()
        for k in range(count):
            if ramp is not None:
                run.set("shaft_speed", ramp((k + 1) * STEP) * RPM)
            run.step(STEP)
            rows[k] = [run.get(name) for name in names]
    return found


def total(run, quantity="spl_fast"):
    """Names of one level at every microphone."""
    return [name for name in run.by_name if name.startswith("mic[") and name.endswith(f"].{quantity}")]


def example(name):
    """Scene of an example, with rigid rings."""
    return read_scene(EXAMPLES / "scenes" / f"{name}.toml").replace({"mounting.flexure": None})


@pytest.fixture
def bare(scene):
    """A scene whose sound is quickly prepared, with all meters."""
    return scene("7003C-bare").replace({"sound.radiation_model": "compact", "sound.third_octaves": True})


def test_levels_of_lines_are_those_of_samples(bare):
    """Every meter within 45 dB of its microphone's total, ahead too, where balls add coherently.

    Levels settle within 0.1 dB. The balls' own are sampled between states 19.5 us apart, whose cubics make
    them 0.2 to 0.4 dB quieter than steps of a few us do (fidelity rings).
    """
    runs = pair(bare)
    names = [name for name in runs[0].by_name if name.startswith("mic[") and not name.endswith("pressure")]
    found = levels(runs, names, 0.5)[:, 300:].mean(1)
    totals = {name: found[0, k] for k, name in enumerate(names) if name.endswith(".spl")}
    floor = np.array([totals[name.split(".")[0] + ".spl"] - 45.0 for name in names])
    loud = found[0] > floor
    assert loud.sum() > 60  # of 15 levels and 29 third octaves at each of four microphones
    assert (found[1][~loud] < floor[~loud] + 1.0).all()
    off = np.abs(found[1] - found[0])
    for k in np.flatnonzero(loud):
        bound = 0.5 if "balls" in names[k] or "octave" in names[k] else 0.1
        assert off[k] < bound, (names[k], found[:, k])


@pytest.mark.parametrize(
    ("model", "rpm", "load"),
    [("paper_contacts", 20_000.0, 0.0), ("paper_vector", 9_000.0, 0.0), ("compact", -12_000.0, -60.0)],
)
def test_other_sources_and_conditions(bare, model, rpm, load):
    """Sources at contacts that orbit, another vector model; backwards under a radial load.

    Sources at contacts nearly cancel, so that what samples lack of the balls' sound moves the sum by 0.09 dB.
    """
    changes = {"sound.radiation_model": model, "mounting.radial_load_z_N": load}
    runs = pair(bare.replace(changes))
    found = levels(runs, total(runs[0]), 0.5, lambda _: rpm)[:, 300:].mean(1)
    assert np.abs(found[1] - found[0]).max() < 0.12


def test_pressures_of_lines_are_those_of_samples(bare):
    """Sample by sample, with the other fidelities' latency: 0.3 to 0.9 % of the rms, measured.

    Filters follow their transfer functions within -50 dB (0.3 %), and samples lack some of the balls' sound.
    """
    runs = pair(bare)
    names = total(runs[0], "pressure")
    found = np.empty((2, 400, len(names)))
    for rows, run in zip(found, runs, strict=True):
        run.initialise()
        for _ in range(200):
            run.step(STEP)
        for row in rows:
            run.step(1 / SD.RATE)
            row[:] = [run.get(name) for name in names]
    off = np.sqrt(((found[1] - found[0]) ** 2).mean(0) / (found[0] ** 2).mean(0))
    assert off.max() < 0.015, off


@pytest.mark.parametrize("bearings", [1, 2])
def test_states_restored_within_a_run_up_give_equal_bits(bare, bearings):
    """The work space holds nothing that a later step needs: it is spoilt before every one."""
    given = bare if bearings == 1 else set_of_two(sound("compact", *PLACES), flaws=True)
    scene = with_fidelity(given, model="response")
    run = Arrays.of(scene, *sound_blocks(scene))
    run.init()

    def found(s):
        return s[S.CONDENSED + L.FROZEN_SPEED]

    def speed_up(begin, spoil=False):
        for k in range(40):
            run.u[U.SPEED] = (begin + 40 * k) * RPM
            if spoil:
                run.w[:] = np.nan
            run.step(STEP)

    speed_up(20_000)
    kept = run.s.copy()
    speed_up(21_600)
    wanted = run.s.copy()
    assert found(wanted) > 1.05 * found(kept)  # lines were renewed
    run.s[:] = kept
    speed_up(21_600, spoil=True)
    np.testing.assert_array_equal(run.s, wanted)


def test_lines_come_into_use_without_a_click(bare):
    """A preload 0.11 % higher renews them and moves what is sampled by little: rings and balls go on.

    Balls put back to where they were when the renewal began would be out of step by its 10 ms. The march of
    their motion begins again: for one sample that moves the pressure ahead by 0.21 of its rms.
    """
    runs = [Instance(prepare(bare, fidelity="response", samples=True)) for _ in range(2)]
    names = total(runs[0], "pressure")
    found = np.empty((2, 400, len(names)))
    for rows, run in zip(found, runs, strict=True):
        run.initialise()
        for _ in range(60):
            run.step(STEP)
        if run is runs[1]:
            run.set("preload", 1.0011 * run.get("preload"))
        for row in rows:
            run.step(0.1 * STEP)
            row[:] = [run.get(name) for name in names]
    off = np.abs(found[1] - found[0]).max(0) / np.sqrt((found[0] ** 2).mean(0))
    assert 1e-6 < off.max() < 0.3, off


def test_metering_begins_where_the_scene_says(bare):
    """In the midst of a step, as with samples: the equivalent level has no ms of silence."""
    runs = pair(bare.replace({"sound.metering_start_s": 0.2503}))
    found = levels(runs, total(runs[0], "leq"), 0.4)
    assert (found[:, :249] < -100.0).all()
    assert np.abs(found[1, -1] - found[0, -1]).max() < 0.1


def test_without_speed_there_is_silence(bare):
    run = Instance(prepare(bare, fidelity="response"))
    run.set("shaft_speed", 0.0)
    run.initialise()
    for _ in range(5):
        run.step(STEP)
    assert max(run.get(name) for name in total(run)) < -100.0
    run.set("shaft_speed", 20_000 * RPM)
    for _ in range(20):  # metering begins after 20 ms
        run.step(STEP)
    assert min(run.get(name) for name in total(run)) > 20.0


def test_models_that_are_not_linear_are_sampled(scene):
    """The multi-source paper's magnitudes |v|: there is no sum of lines."""
    model = prepare(scene("7003C-bare").replace({"sound.radiation_model": "paper"}), fidelity="response")
    assert model.parameters[int(model.parameters[P.AT_SOUND]) + SD.H_LINES] == 0.0


@pytest.mark.heavy
@pytest.mark.parametrize("name", SCENES)
def test_levels_at_every_microphone_of_the_examples(name):
    """Settled, at the scene's own radiation model: 0.1 dB, and where close lines beat 0.3 dB."""
    for rpm, bound in ((20_000.0, 0.1), (1_500.0, 0.3)):
        scene = example(name).replace({"operation.speed_rpm": rpm})
        runs = pair(scene)
        found = levels(runs, total(runs[0]), 0.8)[:, 400:]
        assert np.abs(found[1] - found[0]).max() < bound, (name, rpm)


@pytest.mark.heavy
@pytest.mark.parametrize("name", SCENES)
def test_run_ups_of_the_examples(name):
    """5,000 r/min per s: 0.5 dB."""
    runs = pair(example(name))
    found = levels(runs, total(runs[0]), 0.8, lambda t: 18_000 + 5_000 * t)[:, 300:]
    assert np.abs(found[1] - found[0]).max() < 0.5, name


@pytest.mark.heavy
def test_a_run_up_through_a_narrow_resonance():
    """The Fast level is that of an average over levels settled at 31 speeds."""
    scene = example("7009C-steel")
    speeds = np.arange(21_200.0, 21_801.0, 20.0)
    settled = np.empty(len(speeds))
    for k, rpm in enumerate(speeds):
        run = Instance(prepare(scene, fidelity="response"))
        run.set("shaft_speed", rpm * RPM)
        run.initialise()
        name = total(run)[0]
        for _ in range(20):
            run.step(0.05)
        settled[k] = run.get(name)
    squares = np.interp(np.arange(0.0, 600.0), speeds - speeds[0], 10 ** (settled / 10.0))
    wanted = [squares[0]]
    for square in squares[1:]:  # of 0.2 ms each
        wanted.append(wanted[-1] + (1.0 - np.exp(-0.2e-3 / 0.125)) * (square - wanted[-1]))
    run = Instance(prepare(scene, fidelity="response"))
    run.set("shaft_speed", speeds[0] * RPM)
    run.initialise()
    for _ in range(1_000):
        run.step(STEP)
    found = np.empty(120)
    for k in range(120):
        run.set("shaft_speed", (speeds[0] + 5.0 * (k + 1)) * RPM)
        run.step(STEP)
        found[k] = run.get(name)
    off = found - 10.0 * np.log10(wanted[4::5])
    # the cage damps the resonance that is 0.5 % wide without it
    assert np.ptp(settled) > 0.3
    assert np.abs(off).max() < 0.25, off


@pytest.mark.heavy
def test_a_set_and_its_bearings_alone():
    """A DB pair on its shaft: total, and each bearing alone."""
    runs = pair(set_of_two(sound("compact", *PLACES), flaws=True))
    names = [name for name in runs[0].by_name if name.startswith("mic[") and "pressure" not in name]
    found = levels(runs, names, 0.8)[:, 400:].mean(1)
    loud = found[0] > found[0].max() - 60.0
    off = np.abs(found[1] - found[0])
    sums = np.array([name.split(".")[1] in ("spl", "spl_a", "leq", "spl_fast", "spl_slow") for name in names])
    alone = np.array(["spl_bearing" in name for name in names])
    assert (loud & alone).sum() == 4  # two bearings at two microphones
    assert off[loud & (sums | alone)].max() < 0.1
    # the balls' own, which samples have too quiet
    assert off[loud].max() < 0.5, [(names[k], found[:, k]) for k in np.flatnonzero(loud & (off > 0.5))]


def test_levels_are_numbers_where_metering_begins_at_a_step(bare):
    """Twenty steps of 1 ms are 3e-18 s longer than 20 ms: averages that have not moved have no level."""
    run = Instance(prepare(bare.replace({"sound.metering_start_s": 0.02}), fidelity="response"))
    run.initialise()
    names = [name for quantity in ("spl_slow", "spl_fast", "spl", "leq") for name in total(run, quantity)]
    for _ in range(22):
        run.step(STEP)
        assert np.isfinite([run.get(name) for name in names]).all()
    assert min(run.get(name) for name in names) > 0.0
