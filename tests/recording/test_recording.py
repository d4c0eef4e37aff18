"""Recordings: any microphone after the run, as exact as the engine's own."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import SD
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.scene.read import with_fidelity

HEARD = ("mic[1].pressure", "mic[2].pressure", "mic[3].pressure", "mic[4].pressure")
SHORT = 0.04


@pytest.fixture(scope="module")
def spindle(scene):
    """Return the 7003C in its spindle, the rings alone: a tenth of a second in no time."""
    return with_fidelity(scene("7003C-spindle"), model="rings")


@pytest.fixture(scope="module")
def own(spindle):
    return record(spindle, SHORT, microphones=True, outputs=(*HEARD, "mic[1].leq"), radiation_model="compact")


def test_pressures_equal_the_engines(own):
    """The engine's filters are allowed -50 dB (acoustics.stream); its pressures come LATENCY late."""
    rows = np.floor(own.output_time * SD.RATE + 1e-6).astype(int) - SD.LATENCY - own.first
    inside = (rows >= 0) & (rows < own.size)
    found = own.pressure()[:, rows[inside]]
    for mic, name in enumerate(HEARD):
        engine = own.outputs[name][inside]
        error = 20 * np.log10(np.linalg.norm(found[mic] - engine) / np.linalg.norm(engine))
        print(f"{name}: {error:.1f} dB")
        assert error < -50


def test_who_listens_changes_nothing(spindle, own):
    """One far microphone in place of four: the same channels, bit for bit.

    Other communication steps: the start's steps, which grow from a sixteenth, end elsewhere. They move the
    rings by 5e-5 where the integration's own error is 2.5e-4, and the pressures by -82 dB.
    """
    other = record(spindle, SHORT)
    assert np.array_equal(other.channels, own.channels)
    assert np.array_equal(other.pressure(own.positions, "compact"), own.pressure())
    finer = record(spindle, SHORT, step=2e-4).pressure() - own.pressure()
    assert np.linalg.norm(finer) < 2e-4 * np.linalg.norm(own.pressure())


def test_parts_sum_to_the_whole(own):
    total = own.pressure([(0.05, -0.12, 0.17)])
    for by, names in (("component", set(SD.COMPONENTS)), ("kind", {"radial", "axial", "balls"})):
        parts = own.partial([(0.05, -0.12, 0.17)], by=by)
        assert names <= set(parts)
        assert sum(parts.values()) == pytest.approx(total, abs=1e-12)
    with pytest.raises(ValueError, match="component"):
        own.partial(by="colour")


def test_save_and_load(own, tmp_path):
    own.save(tmp_path / "run.npz")
    back = Recording.load(tmp_path / "run.npz")
    assert np.array_equal(back.pressure(), own.pressure())
    assert back.scene == own.scene and back.microphones == own.microphones
    assert np.array_equal(back.outputs["mic[1].leq"], own.outputs["mic[1].leq"])
    for name in ("run.mat", "run", "run.NPZ"):
        with pytest.raises(ValueError, match="a recording is written as .npz or .uff"):
            own.save(tmp_path / name)
    assert [file.name for file in tmp_path.iterdir()] == ["run.npz"]
    np.savez(tmp_path / "other.npz", x=np.zeros(3))
    with pytest.raises(ValueError, match="not a recording"):
        Recording.load(tmp_path / "other.npz")


def test_far_places(spindle, own):
    """At 30 and 45 m sound has fallen by 20 lg 1.5; a recording that starts before it arrives says so."""
    before = own.pressure()
    with pytest.warns(UserWarning, match="longer settle"):
        assert np.abs(own.pressure([(0.0, 0.0, 45.0)])).max() < 1e-3 * np.abs(before).max()
    assert np.array_equal(own.pressure(), before)
    late = record(spindle, 0.1, settle=0.15)
    near, far = late.levels([(0.0, 0.0, 30.0), (0.0, 0.0, 45.0)])
    # not the same 0.1 s of sound: the farther microphone hears 44 ms earlier ones
    assert near - far == pytest.approx(20 * np.log10(1.5), abs=0.3)


def test_boundary_elements_are_asked_by_name(own, monkeypatch):
    """Radiation model bem gets what all radiation models get."""
    from fmu_bearing.acoustics.radiation.compact import compact_paths

    asked = []

    def bem_paths(*arguments, **options):
        asked.append(((arguments[2].radius, arguments[2].axial), options))
        return compact_paths(*arguments)

    monkeypatch.setattr("fmu_bearing.acoustics.registry.bem_paths", bem_paths)
    assert np.array_equal(own.pressure([(0.05, -0.12, 0.16)], "bem"), own.pressure([(0.05, -0.12, 0.16)]))
    assert asked == [((pytest.approx(0.2), 0.05), {"modes": (), "plane": None})]
