"""The kept sound block: the same numbers, made once, and made again where it matters."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import SD
from fmu_bearing.prepare import sound_block


@pytest.fixture
def made(monkeypatch, tmp_path):
    """Scenes that were computed rather than read, with an empty cache."""
    scenes = []
    compute = sound_block.sound_parameters

    def counted(scene, wanted):
        scenes.append(scene)
        return compute(scene, wanted)

    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setattr(sound_block, "sound_parameters", counted)
    return scenes


def test_a_block_is_made_once(made, scene):
    spindle = scene("7003C-spindle")
    first, second = sound_block.sound_block(spindle), sound_block.sound_block(spindle)
    assert len(made) == 1
    assert first.size > 1000
    assert np.array_equal(first, second)


def changed(scene, part, **values):
    return scene.model_copy(update={part: getattr(scene, part).model_copy(update=values)})


def test_what_does_not_sound_does_not_matter(made, scene):
    spindle = scene("7003C-spindle")
    first = sound_block.sound_block(spindle)
    again = sound_block.sound_block(changed(spindle, "operation", speed_rpm=5000.0))
    assert len(made) == 1 and np.array_equal(again, first)
    sound_block.sound_block(changed(spindle, "mounting", preload_N=200.0, pedestal_stiffness_N_m=3e7))
    renamed = tuple(
        one.model_copy(update={"name": f"M{i}"}) for i, one in enumerate(spindle.sound.microphone)
    )
    sound_block.sound_block(changed(spindle, "sound", microphone=renamed))
    assert len(made) == 1
    moved = tuple(one.model_copy(update={"x_mm": one.x_mm + 10.0}) for one in spindle.sound.microphone)
    sound_block.sound_block(changed(spindle, "sound", microphone=moved))
    assert len(made) == 2
    lighter = sound_block.sound_block(changed(spindle, "sound", air_density_kg_m3=0.6))
    assert len(made) == 3 and not np.array_equal(lighter, first)


def test_lines_and_samples_have_blocks_of_their_own(made, scene):
    bare = scene("7003C-bare").replace({"sound.radiation_model": "compact"})
    lines = bare.replace({"fidelity.model": "response"})
    for one in (bare, lines, bare, lines):
        sound_block.sound_block(one)
    assert len(made) == 2
    assert sound_block.sound_key(bare) != sound_block.sound_key(lines)
    both = sound_block.Sounds(bare)
    assert both.at("response")[0][SD.H_LINES] > 0 == both.at("rings")[0][SD.H_LINES]
    assert both.at("full") is both.at("rings")


def test_a_damaged_block_is_made_again(made, scene, tmp_path):
    first = sound_block.sound_block(scene("7003C-spindle"))
    (kept,) = tmp_path.glob("sound/block-*.npy")
    kept.write_bytes(kept.read_bytes()[:100])
    assert np.array_equal(sound_block.sound_block(scene("7003C-spindle")), first)
    assert len(made) == 2
