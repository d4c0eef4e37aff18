"""Radiation model bem on a scene's bodies: paths to microphones, kept solutions, flush faces, refusals."""

import dataclasses
import types

import numpy as np
import pytest

from fmu_bearing.acoustics.filters.fir import fit
from fmu_bearing.acoustics.radiation.bem import solution as solved
from fmu_bearing.acoustics.radiation.bem.band import Band
from fmu_bearing.acoustics.radiation.bem.bodies import bodies_of
from fmu_bearing.acoustics.radiation.bem.paths import bem_paths, task_of
from fmu_bearing.acoustics.radiation.bem.task import BODIES, RADIAL, TILT
from fmu_bearing.acoustics.radiation.circle import MicrophoneCircle, check_outside
from fmu_bearing.acoustics.radiation.compact import compact_paths
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import BALLS, CAGE, INNER, OUTER, Air, Housing, Radiators, Ring
from fmu_bearing.engine.layout import SD
from tests.oracles import radiation

AIR = Air()
BARE = Radiators(
    ball_count=12,
    ball_diameter=0.0045,
    pitch_diameter=0.026,
    inner_ring=Ring(0.0226, 0.017, 0.01),
    outer_ring=Ring(0.035, 0.0296, 0.01),
)
HARMONICS = 2


@pytest.fixture(scope="module")
def paths():
    """Paths of the bare rings to three microphones at 105 mm, by channel."""
    found = bem_paths(BARE, AIR, MicrophoneCircle(0.105, 0.02, [0.0, 0.5, np.pi / 2]), HARMONICS)
    return {path.channel: path for path in found}


def at_frequency(path, frequency):
    return path.response[np.argmin(np.abs(fit_frequencies() - frequency))]


def test_channels_components_and_weights(paths):
    assert sorted(paths) == [*range(6), *range(9, 13), *range(SD.C_BALLS, SD.c_flex(HARMONICS))]
    assert {paths[channel].component for channel in (0, 1, 2, 9, 10)} == {INNER}
    assert {paths[channel].component for channel in (3, 4, 5, 11, 12)} == {OUTER}
    assert {path.component for channel, path in paths.items() if channel >= SD.C_BALLS} == {BALLS}
    # y is -r sin(phi), z is r cos(phi)
    assert paths[4].weights == pytest.approx([0.0, -np.sin(0.5), -1.0])
    assert paths[5].weights == pytest.approx([1.0, np.cos(0.5), 0.0])
    kinds = [SD.KINDS[paths[channel].kind] for channel in (3, 4, 5, 11, 12, SD.C_BALLS)]
    assert kinds == ["axial", "radial", "radial", "rotation", "rotation", "balls"]


def test_interpolation_between_solved_frequencies(paths):
    """At 7,333 Hz, solved again: -45 dB of each component's strongest path there."""
    frequency = 7333.0
    band = Band(task_of(BARE, AIR, HARMONICS), [frequency, 20_000.0])  # the mesh of the upper band
    band.surface[0] = band.solve(frequency)
    exact = AIR.density * band.field(np.array([[0.02, 0.105]]))[0, :, 0]
    f = fit_frequencies()
    drives = {0: 0, 3: 1, 2: 3, 5: 4, 9: 6, 11: 7}
    size = max(abs(exact[drive]) for drive in drives.values() if drive < TILT)
    for channel, drive in drives.items():
        path = paths[channel]
        still = path.response * np.exp(2j * np.pi * f * path.flight)
        near = np.interp(frequency, f, still.real) + 1j * np.interp(frequency, f, still.imag)
        found = near * np.exp(-2j * np.pi * frequency * path.flight)
        assert abs(found - exact[drive]) < 10 ** (-45 / 20) * size


def test_filters_follow_the_rings(paths):
    """-50 dB with at most 256 taps: a bare bearing has no resonance that rings longer than 5 ms."""
    for channel in (0, 2, 3, 5, SD.c_ball(1, 0)):
        path = paths[channel]
        family = [np.abs(other.response) for other in paths.values() if other.component == path.component]
        taps, error = fit(path.response, path.flight, np.max(family, axis=0))
        assert error < 10 ** (-50 / 20)
        assert len(taps) <= 256


def test_outer_ring_shields_what_is_inside(paths):
    """At 1 kHz compact, where nothing scatters, is within 3 dB for the outer ring, too loud for balls."""
    circle = MicrophoneCircle(0.105, 0.02, [0.0])
    compact = {path.channel: path for path in compact_paths(BARE, AIR, circle, HARMONICS)}
    outer = abs(at_frequency(compact[5], 1000.0) / at_frequency(paths[5], 1000.0))
    assert 1.0 < outer < 1.41
    radial_ball = SD.c_ball(1, 1)
    assert abs(at_frequency(compact[radial_ball], 1000.0)) > 5.0 * abs(
        at_frequency(paths[radial_ball], 1000.0)
    )


def test_housing_moves_as_its_compact_twin_at_low_frequency():
    """Radially beside a housing: 1.1 dB at 200 Hz, as the closed cylinder does; its recess hardly shows."""
    radiators = dataclasses.replace(
        BARE, housing=Housing(0.06, 0.05, 0.015), inner_ring=Ring(0.0226, 0.017, 0.01), shaft=True
    )
    bodies = bodies_of(radiators)
    assert [body.name for body in bodies] == ["housing"]
    assert set(bodies[0].sides) == {INNER, OUTER}
    task = dataclasses.replace(task_of(radiators, AIR, 0), orbit=0.0)
    band = Band(task, [200.0])
    band.surface[0] = band.solve(200.0)
    found = AIR.density * abs(band.field(np.array([[0.0, 0.105]]))[0, RADIAL + OUTER, 0])
    twin = compact_paths(radiators, AIR, MicrophoneCircle(0.105, 0.0, [0.0]), 0)
    exact = abs(at_frequency(next(path for path in twin if path.channel == SD.C_OUTER + 2), 200.0))
    assert abs(20.0 * np.log10(found / exact)) < 1.1


@pytest.mark.parametrize("turned", [False, True])
def test_flush_faces_on_the_axis(turned):
    """Rayleigh's integral in closed form; moving towards +X, a face that looks to -X draws air in."""
    radiators = dataclasses.replace(BARE, baffle=True, turned=turned)
    way = 1.0 if turned else -1.0  # of the face
    axis = MicrophoneCircle(0.0, 0.085 * way, [0.0])
    paths = {path.channel: path for path in bem_paths(radiators, AIR, axis, HARMONICS)}
    assert all(path.component in (INNER, OUTER) for path in paths.values())
    assert not {1, 2, 4, 5} & set(paths)  # sideways motion of a flush face is silent
    f = fit_frequencies()
    for channel, ring in ((0, BARE.inner_ring), (3, BARE.outer_ring)):
        exact = way * radiation.baffled_ring_on_axis(f, 0.08, ring.outer / 2, ring.inner / 2, 1.225, 340.0)
        found = paths[channel].response * paths[channel].weights[0]
        assert np.abs(found / exact - 1.0).max() < 2e-3


def test_flexural_shape_radiates_through_its_normal_part():
    """A shape that is rigid translation (n = 1, psi = 1) sounds as the translation does."""
    corners = np.array([[x, r] for x in np.linspace(-0.005, 0.005, 41) for r in (0.0148, 0.0175)])
    walls = np.array([[x, r] for r in np.linspace(0.0148, 0.0175, 21) for x in (-0.005, 0.005)])
    points = np.concatenate([corners, walls])
    shape = np.tile([0.0, 1.0, -1.0], (len(points), 1))
    mode = types.SimpleNamespace(body=OUTER, order=1, skin_points=points, skin_shape=shape)
    task = task_of(BARE, AIR, 0, (mode,))
    band = Band(dataclasses.replace(task, orbit=0.0), [3000.0])
    band.surface[0] = band.solve(3000.0)
    received = band.field(np.array([[0.0, 0.105]]))[0, :, 0]
    assert received[3 * BODIES] == pytest.approx(received[RADIAL + OUTER], rel=1e-9)


@pytest.fixture
def short(monkeypatch, tmp_path):
    """A cache of its own, and narrow bands."""
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setattr(
        solved, "BASE_FREQUENCIES", ((20.0, 500.0, 1000.0, 1500.0), (1500.0, 1750.0, 2000.0, 2250.0))
    )
    solved._remembered.cache_clear()
    yield tmp_path
    solved._remembered.cache_clear()


POINTS, WANTED = np.array([[0.0, 0.105], [0.1, 0.02]]), np.array([20.0, 777.0, 1500.0, 1501.0, 2250.0])


def test_solutions_are_kept_on_disk_and_damaged_ones_made_again(short, monkeypatch):
    task = dataclasses.replace(task_of(BARE, AIR, 0), orbit=0.0)
    first = solved.solution(task)
    received = first.transfer(POINTS, WANTED)
    assert solved.solution(task) is first
    (kept,) = (short / "sound").glob("*.npz")
    solved._remembered.cache_clear()
    with monkeypatch.context() as patch:
        patch.setattr(Band, "solve", lambda *_: pytest.fail("solved although a solution is kept"))
        again = solved.solution(task)
    assert np.array_equal(again.transfer(POINTS, WANTED), received)
    solved._remembered.cache_clear()
    kept.write_bytes(kept.read_bytes()[:1000])
    assert np.array_equal(solved.solution(task).transfer(POINTS, WANTED), received)
    other = dataclasses.replace(task, sound_speed=343.0)
    assert other.key() != task.key()


def test_air_names_and_microphones_share_one_solution(short, monkeypatch):
    """What bodies and speed of sound do not depend on solves nothing again; pressures follow the density."""
    circle = MicrophoneCircle(0.105, 0.02, [0.0])
    first = bem_paths(BARE, AIR, circle, 1)
    solved._remembered.cache_clear()
    monkeypatch.setattr(Band, "solve", lambda *_: pytest.fail("solved again"))
    renamed = dataclasses.replace(AIR, density=1.1)
    for path, lighter in zip(first, bem_paths(BARE, renamed, circle, 1), strict=True):
        assert lighter.response == pytest.approx(path.response * 1.1 / 1.225, rel=1e-12)
    bem_paths(BARE, AIR, MicrophoneCircle(0.3, -0.1, [1.0]), 1)
    assert len(list((short / "sound").glob("*.npz"))) == 1


def test_refusals():
    with pytest.raises(ValueError, match="105 mm.*lies inside the outer ring|lies inside the outer ring"):
        bem_paths(BARE, AIR, MicrophoneCircle(0.016, 0.0, [0.0]), HARMONICS)
    on = "lies on the outer ring, which reaches to r = 17.5 mm from x = -5 to 5 mm, 0 mm from its surface"
    with pytest.raises(ValueError, match=on):
        bem_paths(BARE, AIR, MicrophoneCircle(0.0175, 0.0, [0.0]), HARMONICS)
    with pytest.raises(
        ValueError, match="lies on the bearing, which reaches to r = 17.5 mm from x = -5 to 5 mm"
    ):
        check_outside(BARE, MicrophoneCircle(0.0175, 0.0, [0.0]))
    touching = dataclasses.replace(BARE, cage=Ring(0.0297, 0.0234, 0.0091))
    with pytest.raises(ValueError, match="the outer ring touches or intersects the cage"):
        bem_paths(touching, AIR, MicrophoneCircle(0.105, 0.0, [0.0]), HARMONICS)
    with pytest.raises(ValueError, match="the reflecting plane at 2 mm cuts the outer ring"):
        bem_paths(BARE, AIR, MicrophoneCircle(0.105, 0.0, [0.0]), HARMONICS, plane=0.002)
    with pytest.raises(ValueError, match="lies behind the rigid wall at 20 mm"):
        bem_paths(BARE, AIR, MicrophoneCircle(0.105, 0.03, [0.0]), HARMONICS, plane=0.02)
    with pytest.raises(ValueError, match="does not hold the bearing"):
        bodies_of(dataclasses.replace(BARE, housing=Housing(0.06, 0.05, 0.2)))
    assert CAGE == BODIES - 1  # the cage is the last of the bodies: its nodes are left out for balls
