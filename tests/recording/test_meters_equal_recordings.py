"""A meter and a recording of one motion read the same: sound rich up to 100 kHz, library and FMUs.

Meters once counted 20 to 25.6 kHz, where their filters were not fitted, and read up to 7.3 dB more than a
recording of the same motion.
"""

import numpy as np
import pytest
import scipy

from fmu_bearing import record, simulate
from fmu_bearing.acoustics.filters.weighting import band_sections, level
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.engine.layout import SD, Z
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.recording.recording import Recording
from fmu_bearing.scene.imperfections import Harmonic
from fmu_bearing.scene.read import with_fidelity
from tests.marks import heavy_but
from tests.native_builds import no_native_fmu
from tests.recording.third_octaves import fast_levels

# third octaves are filtered from the run's first sample on, before sound has arrived
pytestmark = pytest.mark.filterwarnings("ignore:sound takes")

STEP = 20 / SD.RATE  # s: a whole number of samples
STEPS = 205  # 80 ms
SAME = 0.05  # dB
#: dB below the loudest third octave to which bands are compared. A recording's pressures begin at its first
#: row, where a band limit without delay has already begun to sound: low bands remember that for 50 ms, at
#: -45 dB and less of the loudest.
HEARD = 40.0


def rich(bare):
    """Return a scene with waves up to order 200: the ball passes them at up to 40 kHz (20,000 r/min)."""
    rng = np.random.default_rng(5)

    def waves():
        phases = rng.uniform(0.0, 360.0, 199)
        return tuple(
            Harmonic(order=n, amplitude_um=0.02, phase_deg=float(phase))
            for n, phase in enumerate(phases, start=2)
        )

    flaws = bare.imperfections.model_copy(
        update={"inner_race_amplitude_um": None, "outer_race_amplitude_um": None}
        | {"highest_order": None}
        | {"inner_race_harmonic": waves(), "outer_race_harmonic": waves()}
    )
    return bare.model_copy(update={"imperfections": flaws})


def with_bands(quiet):
    """Return the scene with third octaves metered, and no more than needed beside them."""
    sound = quiet.sound.model_copy(update={"third_octaves": True, "details": False})
    return quiet.model_copy(update={"sound": sound})


def meters(scene):
    """Names of the meters, shape (microphones, 2 + bands): Leq, LAeq, third octaves."""
    bands = [f"third_octave[{int(band)}]" for band in Z.BANDS]
    return [
        [f"mic[{k + 1}].{name}" for name in ("leq", "leq_a", *bands)] for k in range(len(scene.microphones))
    ]


def recorded(scene, **options):
    """A recording of the span that the meters cover at its last row, and what meters read then."""
    begin = round(scene.sound.metering_start_s * SD.RATE)
    count = 20 * STEPS + 1  # samples at the last communication point
    duration, settle = (count - begin) / SD.RATE, (begin - SD.LATENCY) / SD.RATE
    recording = record(scene, duration, settle=settle, step=STEP, radiation_model="compact", **options)
    assert recording.size == count - begin and recording.first == begin - SD.LATENCY
    read = [[recording.outputs[name][STEPS] for name in row] for row in meters(scene) if options]
    return recording, np.array(read)


def agree(recording, read):
    """Compare meters with the recording: Leq, LAeq, and Fast third octaves."""
    assert read[:, 0] == pytest.approx(recording.levels(), abs=SAME)
    assert read[:, 1] == pytest.approx(recording.levels(weighting="A"), abs=SAME)
    expected = fast_levels(recording)
    # the chain of balls on the impact scene sounds at 20.4 kHz, above the last band, and moves the quiet ones
    counted = expected > recording.levels()[:, None] - HEARD
    assert counted.sum(axis=1).min() >= 5
    assert read[:, 2:][counted] == pytest.approx(expected[counted], abs=SAME)


@pytest.mark.parametrize(
    ("name", "fidelity", "waves"),
    heavy_but(
        [
            ("7003C-bare", "rings", True),
            ("7003C-bare", "response", True),
            ("7003C-bare", "full", True),
            ("7003C-impact", "full", True),
            ("7003C-impact", "full", False),
        ],
        2,
    ),
)
def test_runs_rich_in_ultrasound(scene, name, fidelity, waves):
    given = with_bands(with_fidelity(scene(name), model=fidelity))
    given = rich(given) if waves else given
    names = [one for row in meters(given) for one in row]
    agree(*recorded(given, microphones=True, outputs=names))


@pytest.mark.heavy
@pytest.mark.parametrize("flavour", FLAVOURS)
def test_fmus(scene, flavour, tmp_path):
    """The meters of both builds, run by FMPy, against a recording by the library."""
    given = rich(with_bands(with_fidelity(scene("7003C-bare"), model="rings")))
    try:
        path = build(prepare(given), tmp_path / "Rich.fmu", flavour).path
    except BuildError as problem:
        no_native_fmu(problem)
    names = meters(given)
    run = simulate(
        path, STEPS * STEP, step=STEP, outputs=[one for row in names for one in row], progress=False
    )
    read = np.array([[run[name][-1] for name in row] for row in names])
    agree(recorded(given)[0], read)


@pytest.mark.heavy
def test_the_motion_is_rich(scene):
    """Without the band limit these scenes would tell: from 22 kHz on there is as much as below 20 kHz."""
    given = rich(with_fidelity(scene("7003C-bare"), model="rings"))
    recording, _ = recorded(given)
    frequency, power = scipy.signal.welch(recording.channels[:, SD.c_body(1, 2)], SD.RATE, nperseg=1024)
    beyond, below = (power[part].sum() for part in (frequency > 22_000.0, frequency < 20_000.0))
    assert beyond > 0.1 * below


def test_fast_levels_of_a_tone():
    """The comparison's own arithmetic: 1 Pa at 1 kHz, latest samples weighted most."""
    t = np.arange(8192) / SD.RATE
    tone = Recording(
        None, "recorded", SD.RATE, 0.0, 8192, t, np.ones(8192),
        recorded=np.sqrt(2.0) * np.sin(2000.0 * np.pi * t)[None], microphones=(("one", (0.0, 0.1, 0.0)),),
    )  # fmt: skip
    sections = band_sections(SD.RATE, 1000.0)
    filtered = scipy.signal.sosfilt(sections, tone.recorded[0]) ** 2
    mean, weight, share = 0.0, 0.0, 1.0 - np.exp(-1.0 / (SD.RATE * 0.125))
    for value in filtered:
        mean += share * (value - mean)
        weight += share * (1.0 - weight)
    found = fast_levels(tone)[0, Z.BANDS.index(1000.0)]
    assert found == pytest.approx(float(level(mean / weight)), abs=1e-9)
    assert found == pytest.approx(93.98, abs=1.0)
