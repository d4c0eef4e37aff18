"""Tables of transfer functions for sets: the sound of the paths that they hold, and what is refused."""

import numpy as np
import pytest

from fmu_bearing import simulate
from fmu_bearing.acoustics.analysis.field import Transfer, joined
from fmu_bearing.acoustics.filters.bearings import check_table
from fmu_bearing.acoustics.radiation.table import channels
from fmu_bearing.recording.channels.sources import sources_of
from tests.spindle.test_sound import pair, sound

PLACES = ((-100.0, 0.0, 30.0), (55.0, 105.0, 0.0))
GRID = np.linspace(0.0, 22_000.0, 221)


@pytest.fixture(scope="module")
def given():
    """A pair, one bearing of which carries towards -X, so that its own axes are mirrored."""
    return pair(sound("compact", *PLACES), flaws=True).replace(
        {"fidelity.model": "rings", "fidelity.tolerance": 2e-3}
    )


def written(scene, file, heads=("bearing[1].", "bearing[2].")):
    """The compact model's paths of every bearing as a table in the axes of the shaft."""
    places = [place.position_m for place in scene.microphones]
    inputs, rows = [], []
    for number, source in enumerate(sources_of(scene, "compact", places, 4)):
        radiation, _ = source
        found = np.concatenate([Transfer(one, radiation.channels)(GRID) for one in joined([source])])
        for name, (_, channel, _) in channels(4).items():
            if name.startswith("housing") or not np.abs(found[:, channel]).any():
                continue
            along = name.endswith(".acceleration.x") or "acceleration.x." in name or "angular" in name
            sign = scene.spindle.bearing[number].sign if along else 1
            inputs.append(heads[number] + name)
            rows.append(sign * found[:, channel])
    np.savez(
        file, frequencies=GRID, inputs=inputs, microphones=[place.name for place in scene.microphones],
        positions=places, H=np.array(rows).transpose(1, 0, 2),
    )  # fmt: skip
    return scene.replace({"sound.radiation_model": "table", "sound.table_file": str(file)})


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_table_sounds_as_the_paths_that_it_holds(given, fidelity, tmp_path):
    scenes = [
        one.replace({"fidelity.model": fidelity}) for one in (given, written(given, tmp_path / "a.npz"))
    ]
    names = [f"mic[{k}].{name}" for k in (1, 2) for name in ("leq", "leq_a", "spl_bearing[2]")]
    read = []
    for scene in scenes:
        kept = simulate(scene, 0.02, step=1e-3, outputs=names, progress=False)
        read.append([kept[name][-1] for name in names])
    # filters are fitted to either: -50 dB
    assert read[1] == pytest.approx(read[0], abs=0.1) and min(read[0]) > 20.0


def test_a_bearing_without_inputs_is_silent(given, tmp_path):
    made = written(given, tmp_path / "a.npz")
    data = dict(np.load(tmp_path / "a.npz"))
    first = [k for k, name in enumerate(data["inputs"]) if name.startswith("bearing[1].")]
    np.savez(tmp_path / "a.npz", **data | {"inputs": data["inputs"][first], "H": data["H"][:, first]})
    names = ["mic[2].spl_bearing[1]", "mic[2].spl_bearing[2]"]
    kept = simulate(made, 0.01, step=1e-3, outputs=names, progress=False)
    assert kept[names[0]][-1] > 40.0 > -100.0 > kept[names[1]][-1]


@pytest.mark.parametrize("heads", [("", "bearing[2]."), ("bearing[1].", "bearing[3].")])
def test_inputs_that_name_no_bearing_are_refused(given, heads, tmp_path):
    made = written(given, tmp_path / "a.npz", heads)
    with pytest.raises(ValueError, match=r"names none of the 2 bearings; an example: bearing\[1\]"):
        check_table(made)


def test_places_count_from_the_nose(given, tmp_path):
    made = written(given, tmp_path / "a.npz")
    check_table(made)
    moved = made.replace({"sound.microphone[1].x_mm": -95.0})
    with pytest.raises(ValueError, match=r"is at \(-100, 0, 30\) mm, in the scene at \(-95, 0, 30\) mm"):
        check_table(moved)
