"""Receptance of the nose against statics, modes, the engine's own motion, and a direct solution."""

import csv

import numpy as np
import pytest
from scipy.linalg import expm

from fmu_bearing import modes, new_scene, read_scene, receptance, statics, stiffness
from fmu_bearing.engine.layout import U
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.receptance import transfer
from fmu_bearing.scene import SceneError, read_scene_text
from tests.conftest import EXAMPLES
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene

SETS = EXAMPLES.parent / "spindle_set"
DB, QBC = SETS / "7003C-DB.toml", SETS / "7003C-QBC.toml"
#: Bearing, and arrangement of a set: small and large, one to three to a shaft.
DRAWN = [
    ("NSK-7906C", "DB"), ("NSK-7012C", "DT"), ("7009C", None), ("NSK-7010AC", "TBT"), ("6205", None),
    ("NSK-7902AC", "DF"), ("NSK-7014C", None),
]  # fmt: skip


def drawn(bearing, arrangement):
    return read_scene_text(new_scene("drawn", bearing, arrangement=arrangement, sound=False))


@pytest.mark.heavy
@pytest.mark.parametrize(("bearing", "arrangement"), DRAWN)
def test_at_20_hz_it_is_the_static_stiffness(bearing, arrangement):
    """Within 1 %; the rest is inertia, of the lowest modes some 1e-4, and the slow turning over of balls."""
    given = drawn(bearing, arrangement)
    (_, across, up) = receptance(given, [20.0]).peaks()
    found = statics(given)
    assert up.stiffness == pytest.approx(found.nose_stiffness, rel=0.01)
    assert across.stiffness == pytest.approx(1.0 / np.linalg.inv(found.stiffness)[1, 1], rel=0.01)


@pytest.mark.heavy
def test_over_speed_and_preload_it_is_the_nose_of_stiffness():
    speeds, preloads, warm = [5e3, 15e3], [60.0, 200.0], {"bearing[1].inner_ring_temperature": 330.0}
    found = receptance(QBC, [20.0], speeds=speeds, preloads=preloads, inputs=warm)
    table = stiffness(QBC, speeds, [100.0], preloads=preloads, inputs=warm)
    own = 1.0 / np.abs(found.G[:, :, 0, 2, 2])
    np.testing.assert_allclose(own, table.named("nose_stiffness"), rtol=0.01)
    assert np.ptp(own) > 0.05 * own.max()


def rational_poles(s, values, order):
    """Poles of the rational function that fits values near a peak: linear least squares, scaled (Levy)."""
    middle, width = s.mean(), np.ptp(s.imag)
    x, scaled = (s - middle) / width, values / np.abs(values).max()
    powers = x[:, None] ** np.arange(order + 1)
    system = np.hstack([powers, -scaled[:, None] * powers[:, :order]])
    found = np.linalg.lstsq(system, scaled * powers[:, order], rcond=None)[0]
    return middle + width * np.roots([1.0, *found[order + 1 :][::-1]])


@pytest.mark.parametrize(
    ("source", "names", "motion"),
    [
        (DB, ["shaft axial"], (0, 0)),
        (DB, ["shaft tilt", "shaft radial"], (1, 1)),
        (QBC, ["shaft bending"], (2, 1)),
        (EXAMPLES / "7003C-spindle.toml", ["inner axial"], (0, 0)),
        (EXAMPLES / "7003C-spindle.toml", ["inner radial", "inner tilt"], (1, 1)),
        (EXAMPLES / "7009C-spindle.toml", ["inner radial"], (2, 1)),
    ],
)
def test_its_peaks_are_those_of_modes(source, names, motion):
    """Frequency within 0.1 %, damping within 1 %: poles fitted to the curve about each peak."""
    wanted = [mode for mode in modes(source).modes if mode.name in names and mode.frequency < 6e3]
    assert wanted
    for mode in wanted:
        # a band of some half widths about the peak holds both whirls, and little of other modes
        half = max(8.0 * mode.damping * mode.frequency, 40.0)
        hertz = np.linspace(max(mode.frequency - half, 20.0), mode.frequency + half, 161)
        g = receptance(source, hertz).G[0, 0][:, motion[0], motion[1]]
        poles = rational_poles(2j * np.pi * hertz, g, 6)
        nearest = poles[np.argmin(abs(poles - mode.value))]
        assert abs(nearest.imag) / (2.0 * np.pi) == pytest.approx(mode.frequency, rel=1e-3)
        assert -nearest.real / abs(nearest) == pytest.approx(mode.damping, rel=0.01)


def test_a_step_of_force_moves_the_nose_of_the_engine_so():
    """5 N at the nose for 4 ms in fidelity full without cage, less the run without; all five motions."""
    pair = scene("+-", (40.0, 70.0), rpm=10_000.0)
    force, h, count = 5.0, 2e-5, 200
    moved, quiet = (SetRun(pair, CAGE=0.0, TOLERANCE=1e-7).init() for _ in range(2))
    moved.u[U.NOSE + 1] += force
    own = []
    for _ in range(count):
        assert moved.step(h) == 0
        assert quiet.step(h) == 0
        own.append(moved.vector(0)[:5] - quiet.vector(0)[:5])
    system = linearised(pair)
    out, into = transfer._ports(system)
    n = len(system.matrix)
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n] = system.matrix, force * into[:, 1]
    ahead, state, wanted = expm(whole * h), np.eye(n + 1)[n], []
    for _ in range(count):
        state = ahead @ state
        wanted.append(out @ state[:n])
    own, wanted = np.array(own), np.array(wanted)
    # contacts are stiffer under more load: 5 N beside 500 N of preload move it by some 1e-3
    for k in (1, 2, 3, 4):
        assert np.abs(own[:, k] - wanted[:, k]).max() < 5e-3 * np.abs(wanted[:, k]).max(), k


def test_both_ways_of_solving_agree(monkeypatch):
    hertz = np.linspace(50.0, 5000.0, 40)
    fast = receptance(QBC, hertz).G[0, 0, :, 1:, 1:]
    monkeypatch.setattr(transfer, "_EXACT", -1.0)
    slow = receptance(QBC, hertz).G[0, 0, :, 1:, 1:]
    assert np.all(np.abs(slow - fast).max(axis=0) < 1e-7 * np.abs(slow).max(axis=0))


def test_a_force_across_moves_it_too_as_reciprocity_of_gyroscopes_has_it():
    """G(-speed) = G(speed) transposed of conservative gyroscopes; friction of balls breaks it a little."""
    still = read_scene(QBC).replace({"fidelity.terms.gravity": False, "spindle.load.force_z_N": 0.0})
    hertz = np.linspace(500.0, 3000.0, 101)
    one, other = (receptance(still, hertz, speeds=[rpm]).G[0, 0][:, 1:3, 1:3] for rpm in (2e4, -2e4))
    apart = np.abs(one - np.swapaxes(other, 1, 2)).max() / np.abs(one).max()
    assert apart < 0.02 < 0.4 < np.abs(one[:, 0, 1]).max() / np.abs(one[:, 0, 0]).max()


def test_a_ring_held_along_its_axis_does_not_move_there(gate):
    held = gate("7003C-spindle", **{"mounting.preload_mode": "rigid"})
    found = receptance(held, [100.0])
    along = np.abs([found.G[0, 0, 0, 0], found.G[0, 0, 0, :, 0]])
    assert along.max() < 1e-20 * np.abs(found.G).max() / 1e-8  # rounding
    assert np.isinf(found.peaks()[0].stiffness)


def test_unequal_loads_are_said(gate):
    loaded = gate("7003C-spindle", **{"mounting.preload_N": 60.0, "mounting.radial_load_z_N": -400.0})
    found = receptance(loaded, [50.0])
    assert found.spread[0, 0] > 0.01 and "single phases of a ball pitch" in " ".join(found.cautions())
    assert receptance(gate("7003C-spindle"), [50.0]).spread[0, 0] == 0.0


def test_a_motion_that_grows_is_said():
    found = receptance(EXAMPLES / "7009C-full-ceramic.toml", [50.0])
    assert found.growing[0, 0] > 1.0 and "grows by itself" in " ".join(found.cautions())


def test_files(tmp_path):
    found = receptance(DB, np.linspace(100.0, 300.0, 5), preloads=[100.0, 150.0])
    with found.save(tmp_path / "g.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 10
    assert float(rows[7]["frequency_Hz"]) == 200.0 and float(rows[7]["preload_N"]) == 150.0
    entry = complex(*(float(rows[7][f"{part}_y_bz [1/N]"]) for part in ("real", "imag")))
    assert entry == found.G[0, 1, 2, 1, 4]
    text = found.save(tmp_path / "g.uff").read_text("ascii")
    assert text.count("\n    58\n") == 2 * 25 and text.startswith("    -1\n   164\n")
    with pytest.raises(ValueError, match=r"a receptance is written as \.csv or \.uff"):
        found.save(tmp_path / "g.txt")
    uneven = receptance(DB, [100.0, 150.0, 300.0])
    with pytest.raises(ValueError, match="evenly"):
        uneven.save(tmp_path / "h.uff")
    assert not (tmp_path / "h.uff").exists()


@pytest.mark.parametrize(
    ("words", "given"),
    [
        ("frequencies: 0 Hz is refused: a receptance is over frequencies above 0", {"frequencies": [0.0]}),
        ("shaft_speed is an axis of the table", {"inputs": {"shaft_speed": 1.0}}),
        ("allowed are -", {"speeds": [1e6]}),
    ],
)
def test_what_is_refused(words, given):
    with pytest.raises(ValueError, match=words):
        receptance(DB, **({"frequencies": [100.0]} | given))


def test_another_models_shaft_has_none():
    with pytest.raises(SceneError, match="cannot have receptance of the nose and milling stability"):
        receptance(SETS.parent / "port" / "7003C-DB-port.toml", [100.0])


def test_neutral_motions_of_the_balls_are_no_needles():
    """The axes of their spins turn over so slowly that nothing damps them: five times as much at f_c."""
    pair = new_scene(
        "pair",
        "NSK-7010C",
        arrangement="DB",
        kind="steel",
        preload_class="medium",
        speed_rpm=18e3,
        sound=False,
    )
    scene = read_scene_text(pair).replace({"lubricant.supply": "grease"})
    hertz = np.concatenate([[20.0], np.arange(120.0, 150.0, 0.25), np.linspace(1e3, 3e3, 101)])
    found = receptance(scene, hertz).G[0, 0, :, 1, 1]
    whole = transfer.transfer(linearised(scene), hertz)[:, 1, 1]
    near = (hertz > 120.0) & (hertz < 150.0)
    assert np.abs(whole[near]).max() > 4.0 * np.abs(found[near]).max()
    assert np.abs(found[near]).max() < 1.05 * np.abs(found[near]).min()
    # neither the static stiffness nor the peaks of shaft and rings are others
    assert 1.0 / abs(found[0]) == pytest.approx(statics(scene).nose_stiffness, rel=0.01)
    assert np.abs(found / whole - 1.0)[hertz >= 1e3].max() < 1e-3
