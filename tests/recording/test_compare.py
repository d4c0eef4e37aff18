"""Two scenes, recordings or runs side by side: what differs was changed, levels are those measured."""

import numpy as np
import pytest

from fmu_bearing import Run, SceneError, compare, record, simulate, with_fidelity
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.recording.studies.comparison_data import FIGURES

DURATION, SETTLE = 0.05, 0.02


@pytest.fixture(scope="module")
def plain(scene):
    return with_fidelity(scene("7003C-bare"), model="rings")


@pytest.fixture(scope="module")
def other(plain):
    return plain.replace({"mounting.preload_N": 200.0, "fidelity.terms.drag": False, "name": "other"})


@pytest.fixture(scope="module")
def found(plain, other):
    return compare(plain, other, duration=DURATION, settle=SETTLE, progress=False)


@pytest.mark.heavy
def test_the_keys_that_differ(found, plain):
    assert found.keys == {
        "mounting.preload_N": (plain.mounting.preload_N, 200.0),
        "fidelity.terms.drag": (True, False),
    }
    columns, rows = found.keys_table()
    assert columns == ["key of the scene", "A", "B", "unit"]
    assert ["mounting.preload_N", f"{plain.mounting.preload_N:g}", "200", "N"] in rows
    assert repr(found) == "Comparison(A: 7003C-bare, B: other, 2 keys differ)"


@pytest.mark.heavy
def test_a_key_of_one_scene_alone(plain):
    perfect = plain.replace({"imperfections": None})
    keys = compare(perfect, plain, duration=0.02, settle=0.01, progress=False).keys
    assert keys["imperfections.seed"] == (None, plain.imperfections.seed)
    assert all(pair[0] is None for pair in keys.values())


def test_levels_are_those_of_the_recordings(found, plain, other):
    for side, scene in ((found.a, plain), (found.b, other)):
        made = record(scene, DURATION, settle=SETTLE, progress=False)
        recorded = analyse_sound(made)
        pairs = zip(recorded.names, recorded.levels.tolist(), strict=True)
        assert side.levels == {name: tuple(pair) for name, pair in pairs}
        assert list(side.third_octaves["P2"].values()) == recorded.third_octaves[1].tolist()
        assert np.array_equal(side.spectrum["P3"], recorded.spectra["total"][2])
        kept = made.output_time >= SETTLE
        torque = made.outputs["friction_torque"][kept].mean()
        assert side.figures["friction_torque"] == pytest.approx(torque, rel=1e-12)  # the order of a sum
        assert set(side.figures) == set(FIGURES)


def test_differences_are_b_less_a(found):
    assert found.loudest() == max(found.a.levels, key=lambda name: found.a.levels[name][1])
    columns, rows = found.levels_table()
    row = dict(zip(columns[:4], rows[0][:4], strict=True))
    a, b = found.a.levels["P1"][0], found.b.levels["P1"][0]
    assert row == {"microphone": "P1", "A, dB": f"{a:.1f}", "B, dB": f"{b:.1f}", "B - A, dB": f"{b - a:+.1f}"}
    load = next(row for row in found.figures_table()[1] if row[0] == "contact.inner.load_mean")
    assert float(load[4]) < 0.0 and float(load[5]) < -20.0  # less preload, less load
    torque = next(row for row in found.figures_table()[1] if row[0] == "friction_torque")
    # four digits are shown
    assert float(torque[2]) == pytest.approx(1e3 * found.a.figures["friction_torque"], rel=1e-3)
    assert torque[1] == "N mm"
    columns, rows = found.third_octaves_table("P1")
    assert rows[17][0] == "1000" and len(rows) == 31


def test_tables_are_narrow_and_written(found, tmp_path):
    titles = list(found.tables())
    assert titles == [
        "what differs in the scenes", "levels", "loads, angles, torque",
        f"third octaves at {found.loudest()}",
    ]  # fmt: skip
    for title, (columns, rows) in found.tables().items():
        widths = [max(map(len, cells)) for cells in zip(columns, *rows, strict=True)]
        assert sum(widths) + 3 * len(widths) + 1 <= 80, title
    files = found.save(tmp_path / "tables", "P1")
    assert [file.name for file in files] == [
        "what-differs-in-the-scenes.csv", "levels.csv", "loads-angles-torque.csv", "third-octaves.csv",
    ]  # fmt: skip
    assert files[1].read_text().startswith('microphone,"A, dB"')
    page = found._repr_html_()
    assert page.count("<table>") == 4 and "B minus A" in page


def test_picture_has_both_spectra(found):
    figure = found.plot(highest=8000.0)
    assert figure.get_suptitle() == f"microphone {found.loudest()}"
    one, other = figure.axes
    assert one.get_ylim() == other.get_ylim() and one.get_xlim() == other.get_xlim()
    for ax, name in ((one, "A: 7003C-bare"), (other, "B: other")):
        (curve,) = [line for line in ax.lines if line.get_gid() is None]
        (behind,) = [line for line in ax.lines if line.get_gid() == "other"]
        assert curve.get_label() == ax.get_title(loc="left") == name
        assert behind.get_color() == "0.8" and ax.lines.index(behind) < ax.lines.index(curve)
        assert curve.get_xdata()[-1] <= 8000.0
    with pytest.raises(ValueError, match="not both have a microphone 'P9'; both have P1, P2, P3, P4"):
        found.plot("P9")


def test_machines_get_the_same(found):
    data = found.summary()
    own = found.keys["mounting.preload_N"][0]
    assert data["keys"]["mounting.preload_N"] == {
        "key": "mounting.preload_N", "a": own, "b": 200.0, "unit": "N",
    }  # fmt: skip
    assert data["b"]["levels"]["P4"]["laeq_dB"] == found.b.levels["P4"][1]
    assert data["a"]["third_octaves_dB"]["P1"]["1000"] == pytest.approx(found.a.third_octaves["P1"][1000.0])


@pytest.mark.heavy
def test_files_of_scenes_and_recordings_are_taken(plain, found, tmp_path):
    (tmp_path / "scene.toml").write_text(plain.to_toml(), "utf-8")
    record(plain, DURATION, settle=SETTLE, progress=False).save(tmp_path / "run.npz")
    said = []
    again = compare(
        tmp_path / "run.npz", str(tmp_path / "scene.toml"), duration=DURATION, settle=SETTLE,
        tell=said.append, progress=False,
    )  # fmt: skip
    assert again.a.name == "run" and again.b.name == "scene" and not again.keys
    assert again.a.levels == again.b.levels == found.a.levels
    assert said[1] == "B: running 7003C-bare, fidelity rings, for 0.07 s"
    assert "what differs in the scenes" not in again.tables()


def test_a_run_is_read_by_its_meters(plain, other, tmp_path):
    scene = plain.replace({"sound.third_octaves": True})
    kept = ["mic[*].leq", "mic[1].leq_a", "mic[*].third_octave[*]", "friction_torque"]
    run = simulate(scene, 0.1, outputs=kept, progress=False)
    changed = simulate(other, 0.1, outputs=["mic[*].leq", "mic[1].leq_a"], progress=False)
    changed.save(tmp_path / "other.csv")
    found = compare(run, tmp_path / "other.csv", settle=0.05)
    assert found.a.levels["P1"] == (run["mic[1].leq"][-1], run["mic[1].leq_a"][-1])
    assert np.isnan(found.a.levels["P2"][1])
    assert found.a.third_octaves["P1"][1000.0] == run["mic[1].third_octave[1000]"][-1]
    assert found.a.figures == {"friction_torque": run["friction_torque"][run.time >= 0.05].mean()}
    assert found.b.scene is None and not found.keys
    # a file does not say how its microphones are called
    assert list(found.b.levels) == ["mic[1]", "mic[2]", "mic[3]", "mic[4]"]
    with pytest.raises(ValueError, match="no microphone with the same name"):
        found.loudest()
    light = simulate(scene.replace({"mounting.preload_N": 300}), 0.1, outputs=kept, progress=False)
    both = compare(run, light)
    (ax,) = both.plot("P1").axes
    assert ax.get_xlabel() == "third-octave band, Hz"
    assert both.levels_table()[1][1][4:] == ["-", "-", "-"]  # dB(A) was kept at the first microphone alone


def test_pressures_of_a_run_are_measured(plain):
    step = type(record(plain, 0.01, progress=False)).PRESSURE_STEP
    run = simulate(plain, 0.08, step=step, outputs=["mic[*].pressure"], progress=False)
    found = compare(run, run, settle=0.03)
    assert found.a.spectrum is not None and found.a.levels == found.b.levels
    assert set(found.a.levels) == {"P1", "P2", "P3", "P4"}


def test_scenes_without_sound_have_loads(plain):
    mute = plain.replace({"sound": None})
    light = mute.replace({"mounting.preload_N": 300})
    found = compare(mute, light, duration=0.02, settle=0.01, progress=False)
    assert list(found.tables()) == ["what differs in the scenes", "loads, angles, torque"]
    with pytest.raises(ValueError, match="no microphone with the same name"):
        found.plot()


def test_refusals(plain, tmp_path):
    recording = record(plain, 0.02, progress=False)
    with pytest.raises(ValueError, match="A is a finished run, whose fidelity cannot be changed"):
        compare(recording, plain, fidelity="full")
    run = Run("any", np.zeros(3, dtype=[("time", float)]))
    with pytest.raises(ValueError, match="radiation model of a finished run cannot be changed"):
        compare(run, run, radiation_model="bem")
    with pytest.raises(ValueError, match="no such scene file"):
        compare("none.toml", plain)
    with pytest.raises(SceneError, match="Scene.from_dict takes tables"):
        compare({}, plain)
