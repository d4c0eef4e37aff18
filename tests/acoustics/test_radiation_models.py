"""Every radiation model can be selected and makes sound; the papers' two others, and the user's tables."""

import itertools

import numpy as np
import pytest

from fmu_bearing.acoustics.filters.design import filter_errors
from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.circle import MicrophoneCircle
from fmu_bearing.acoustics.radiation.compact import compact_paths
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.paper_contacts import contact_paths
from fmu_bearing.acoustics.radiation.paper_scalars import paper_scalars
from fmu_bearing.acoustics.radiation.radiators import Air, Path, Radiators
from fmu_bearing.acoustics.radiation.table import Table, channels, read_table, select
from fmu_bearing.acoustics.registry import RECIPES, Radiation
from fmu_bearing.engine.choices import RADIATION_MODELS
from fmu_bearing.engine.layout import MO, SD, STRIDE
from fmu_bearing.engine.sound.channels import keep
from tests.acoustics.playback import (
    PAPER_POINTS,
    RHO,
    SMALL,
    C,
    Player,
    ball,
    build,
    chain,
    lines,
    raw_time,
    still,
)
from tests.oracles import radiation

PERIOD = 2048  # raw samples: 100 Hz
GRID = np.concatenate([np.arange(0.0, 1000.0, 10.0), np.arange(1000.0, 20_001.0, 100.0)])


class Mode:
    """As much of an elastic mode as sound asks for."""

    def __init__(self, body):
        self.body = body


def flexing(radiators, air, circle, harmonics, modes=(), plane=None):
    """Stand-in for boundary elements: compact bodies, and each flexural coordinate a monopole."""
    paths = compact_paths(radiators, air, circle, harmonics)
    f = fit_frequencies()
    sound = radiation.pulsating_sphere(f, circle.distance, 0.01, air.density, air.sound_speed)
    for i, mode in enumerate(mode for mode in modes for _ in range(2)):
        channel, flight = SD.c_flex(harmonics) + i, circle.flight(air)
        paths.append(Path(mode.body, channel, flight, sound, circle.uniform(), SD.FLEXURE))
    return paths


@pytest.fixture
def elements(monkeypatch):
    monkeypatch.setattr("fmu_bearing.acoustics.registry.bem_paths", flexing)


def table_of(points, inputs, frequencies=GRID):
    """The compact model's transfer functions as a user's table."""
    known = channels(2)
    response = np.zeros((len(points), len(inputs), len(frequencies)), dtype=complex)
    for m, (x, y, z) in enumerate(points):
        radius, azimuth = np.hypot(y, z), np.arctan2(-y, z)
        distance = np.hypot(radius, x)
        found = {
            path.channel: path.response * path.weights[0]
            for path in compact_paths(SMALL, Air(), MicrophoneCircle(radius, x, [azimuth]), 2)
        }
        f = fit_frequencies()
        for i, name in enumerate(inputs):
            still_there = found[known[name][1]] * np.exp(2j * np.pi * f * distance / C)
            real, imaginary = (
                np.interp(frequencies, f, part) for part in (still_there.real, still_there.imag)
            )
            response[m, i] = (real + 1j * imaginary) * np.exp(-2j * np.pi * frequencies * distance / C)
    names = tuple(f"P{m + 1}" for m in range(len(points)))
    return Table(np.asarray(frequencies), tuple(inputs), names, np.array(points), response)


def shaken():
    """All bodies in motion at tones of their own."""
    motion, t = still(SMALL, PERIOD), raw_time(PERIOD)
    for body in range(3):
        for k in range(3):
            omega = 2 * np.pi * 100.0 * (3 + 4 * body + 3 * k)
            motion[:, 12 * body + k] = 1e-3 * np.sin(omega * t)
            motion[:, 12 * body + 3 + k] = 1e-3 * omega * np.cos(omega * t)
        motion[:, 12 * body + 10] = 1e3 * np.sin(2 * np.pi * 900.0 * t)
    return motion


def test_every_model_makes_sound_and_none_is_another(elements):
    received = {}
    assert tuple(RECIPES) == RADIATION_MODELS
    for model in RADIATION_MODELS:
        table = table_of(PAPER_POINTS, ["housing.acceleration.y"]) if model == "table" else None
        modes = (Mode(1),) if model == "bem" else ()
        ps = build(model, SMALL, Air(), PAPER_POINTS, 2, table=table, modes=modes)
        motion = shaken()
        if modes:
            motion[:, MO.FLEXURES + 1] = 1.0
            motion[:, MO.FLEXURES] = 10 * np.sin(2 * np.pi * 1700 * raw_time(PERIOD))
        pressures = Player(ps).play(motion, 41 * PERIOD)
        received[model] = pressures[-512:]
        assert np.sqrt(np.mean(received[model][:, 0] ** 2)) > 1e-5, model
    for one, other in itertools.combinations(RADIATION_MODELS, 2):
        assert np.max(np.abs(received[one] - received[other])) > 1e-5, (one, other)


def test_flexure_makes_sound_of_its_kind(elements):
    ps = build("bem", SMALL, Air(), PAPER_POINTS[:1], 2, modes=(Mode(0), Mode(1)))
    assert ps[SD.H_CHANNELS] == SD.vector_channels(2, 4) == 15 + 2 + 12 + 4
    motion = still(SMALL, PERIOD)
    motion[:, MO.FLEXURES + 3] = np.cos(2 * np.pi * 1000 * raw_time(PERIOD))
    player = Player(ps)
    pressure = player.play(motion, 41 * PERIOD)[:, 0]
    expected = radiation.pulsating_sphere(1000.0, 0.105, 0.01, RHO, C) * chain([1000.0])[0]
    assert abs(lines(pressure, [1000.0])[0] - expected) < 10 ** (-50 / 20) * abs(expected)
    for name in ("spl_flexure", "spl_outer_ring"):
        assert player.reading(name) == pytest.approx(player.reading("spl"), abs=1e-6)
    assert player.reading("spl_inner_ring") < -100 and player.reading("spl_radial") < -100


def test_paper_vector_uses_real_direction_cosines():
    """Tones on y, x and a tilt of the outer ring: printed magnitudes times cosines, as pressures; 0.005."""
    point = np.array([0.06, -0.09, 0.05])
    distance = np.linalg.norm(point)
    t = raw_time(PERIOD)
    frequencies = np.array([500.0, 1000.0, 2000.0, 3000.0])
    motion = still(SMALL, PERIOD)
    motion[:, 12 + 4] = np.cos(2 * np.pi * 500 * t)
    motion[:, 12 + 3] = np.cos(2 * np.pi * 1000 * t)
    motion[:, 12 + 11] = np.cos(2 * np.pi * 2000 * t)
    angle = 1.1  # one ball at an angle, shaken radially
    motion[:, ball(2, MO.BALL_ACCELERATION, 1)] = np.cos(2 * np.pi * 3000 * t)
    motion[:, MO.COS + 2], motion[:, MO.SIN + 2] = np.cos(angle), np.sin(angle)
    pressure = Player(build("paper_vector", SMALL, Air(), [tuple(point)], 2)).play(motion, 41 * PERIOD)
    f, medium = frequencies, (RHO, C)
    radial = np.array([0.0, -np.sin(angle), np.cos(angle)])
    expected = np.array([
        sources.paper_cylinder_causal(f[0], distance, 17.5e-3, *medium) * point[1] / distance,
        sources.paper_piston(f[1], distance, 35e-3, 30e-3, *medium) * point[0] / distance,
        sources.paper_point(f[2], distance, 17.5e-3, *medium) * paper_scalars(SMALL)[2] * point[2] / distance,
        sources.paper_ball(f[3], distance, 2.25e-3, *medium) * radial @ point / distance,
    ])  # fmt: skip
    found = lines(pressure[:, 0], frequencies)
    assert np.max(np.abs(found - expected * chain(f)) / np.abs(expected)) < 0.005


def dense_contact_pressure(motion_of, frequency, point):
    """Eqs. 7 and 8 of the sound-field paper with every patch by itself, for balls at rest on their circle."""
    k = 2 * np.pi * frequency / C
    theta = 2 * np.pi * np.arange(12) / 12
    e_r = np.stack([0 * theta, -np.sin(theta), np.cos(theta)], axis=1)
    e_t = np.stack([0 * theta, -np.cos(theta), -np.sin(theta)], axis=1)
    e_x = np.array([1.0, 0.0, 0.0])
    out = np.cos(np.pi / 12) * e_r + np.sin(np.pi / 12) * e_x
    orbit, ball = 13e-3, 2.25e-3
    near, far = orbit - ball * np.cos(np.pi / 12), orbit + ball * np.cos(np.pi / 12)
    share = np.pi / 6
    families = [  # body, radius, normals, area
        ("inner", near, out, share * near * 10e-3), ("outer", far, -out, share * far * 10e-3),
        ("balls", far, out, 2 * np.pi * ball**2), ("balls", near, -out, 2 * np.pi * ball**2),
        ("cage", orbit, e_t, share * orbit * 9.1e-3),
    ]  # fmt: skip
    places = np.concatenate([radius * e_r for _, radius, _, _ in families])
    normals = np.concatenate([normal for _, _, normal, _ in families])
    area = np.repeat([a for *_, a in families], 12)
    moving = np.concatenate([normal @ np.asarray(motion_of.get(body, np.zeros(3)))
                             for body, _, normal, _ in families])  # fmt: skip
    apart = places[:, None] - places[None]
    r = np.linalg.norm(apart, axis=2)
    together = r < 1e-9
    r[together] = 1.0
    green = np.exp(-1j * k * r) / (4 * np.pi * r)
    flat = np.where(np.arange(60)[:, None] < 48, normals, 0.0)  # the cage's double layer is left out
    slope = -(apart * flat[None]).sum(axis=2) / r
    double = -(1j * k + 1 / r) * green * slope * area
    single = green * area
    single[together] = double[together] = 0.0
    disc = np.sqrt(area / np.pi)
    single[np.diag_indices(60)] = (1 - np.exp(-1j * k * disc)) / (2j * k)
    surface = np.linalg.solve(0.5 * np.eye(60) - double, single @ moving)
    offset = np.asarray(point) - places
    r = np.linalg.norm(offset, axis=1)
    green = np.exp(-1j * k * r) / (4 * np.pi * r)
    slope = -(offset * flat).sum(axis=1) / r
    return RHO * np.sum(area * (green * moving - (1j * k + 1 / r) * green * slope * surface))


@pytest.mark.parametrize("frequency", [300.0, 3000.0])
@pytest.mark.parametrize("point", [(0.0, 0.105, 0.02), (0.05, -0.1, 0.18)])
def test_contact_model_is_the_papers_system_of_equations(frequency, point):
    """Harmonic by harmonic against all patches at once; balls at rest. 1 %: filters, orders beyond 8."""
    motions = {"inner": (0.3, 1.0, -0.5), "outer": (-0.2, 0.4, 1.0)}
    t = raw_time(PERIOD)
    motion = still(SMALL, PERIOD)
    for body, name in enumerate(motions):
        for axis in range(3):
            motion[:, 12 * body + 3 + axis] = motions[name][axis] * np.cos(2 * np.pi * frequency * t)
    pressure = Player(build("paper_contacts", SMALL, Air(), [point], 8)).play(motion, 41 * PERIOD)[:, 0]
    expected = dense_contact_pressure(motions, frequency, point) * chain([frequency])[0]
    assert abs(lines(pressure, [frequency])[0] - expected) < 0.01 * abs(expected)


def test_contact_sources_that_orbit_keep_their_strength():
    """A ring at constant velocity: its normal velocity at an orbiting contact turns, and that sounds.

    v_y = 1 m/s, contacts at 200 turns/s: each patch's strength is a tone at 200 Hz; evenly spaced, they
    are a standing pattern, so that only harmonics of the ball passage remain.
    """
    motion, t = still(SMALL, PERIOD), raw_time(PERIOD)
    motion[:, 13] = 1.0
    omega = 2 * np.pi * 200.0
    for j in range(12):
        angle = 2 * np.pi * j / 12 + omega * t
        motion[:, ball(j, MO.BALL_VELOCITY, 2)] = omega * 13e-3
        motion[:, MO.COS + j], motion[:, MO.SIN + j] = np.cos(angle), np.sin(angle)
        motion[:, ball(j, MO.BALL_ACCELERATION, 1)] = (
            -(omega**2) * 13e-3
        )  # the balls' own motion makes no sound: v_n is 0
    one = motion.copy()
    for j in range(1, 12):
        one[:, MO.BALL_VELOCITY + j : MO.FLEXURES : STRIDE] = 0.0
    ps = build("paper_contacts", SMALL, Air(), [(0.0, 0.15, 0.0)], 8)
    frequencies = [200.0, 400.0, 2400.0]
    whole = np.abs(lines(Player(ps).play(motion, 41 * PERIOD)[:, 0], frequencies))
    single = np.abs(lines(Player(ps).play(one, 41 * PERIOD)[:, 0], frequencies))
    assert single[0] > 1e-6 and single[1] > 1e-8
    assert np.all(whole[:2] < 1e-6 * single[:2])


@pytest.mark.heavy
def test_normal_velocities_at_orbiting_contacts_change_as_motion_in_vectors_says():
    """d/dt (v . n) by a difference: rings and cage in even acceleration, normals that turn with the balls.

    Normals of the rings point from the inner race to the outer, those of the cage along the orbit. Balls
    have x'' and r'' at their contacts.
    """
    rng, number, h = np.random.default_rng(2), SMALL.ball_count, 1e-6
    start, omega = 2 * np.pi * np.arange(number) / number + 0.3, 1200.0 * rng.uniform(0.8, 1.2, number)
    sine, cosine = np.sin(SMALL.contact_angle), np.cos(SMALL.contact_angle)
    velocity, acceleration = rng.normal(size=(3, 3)), 1e3 * rng.normal(size=(3, 3))
    speeds, rates = rng.normal(size=(2, number)), 1e3 * rng.normal(size=(2, number))  # of balls along x, r

    def normal_velocities(t):
        y, z = -np.sin(start + omega * t), np.cos(start + omega * t)
        outwards, ahead = np.array([0.0 * y, y, z]), np.array([0.0 * y, -z, y])
        slanted = np.array([[sine], [0.0], [0.0]]) + cosine * outwards
        rings = [v @ n for v, n in zip(velocity + t * acceleration, (slanted, slanted, ahead), strict=True)]
        return np.array([*rings, (sine, cosine) @ (speeds + t * rates)])

    motion, radius = np.zeros(MO.SIZE), 0.5 * SMALL.pitch_diameter
    for body in range(3):
        at = MO.PER_BODY * body
        motion[at + MO.VELOCITY : at + MO.ACCELERATION] = velocity[body]
        motion[at + MO.ACCELERATION : at + MO.SPIN] = acceleration[body]
    along = [*speeds, radius * omega, rates[0], rates[1] - radius * omega**2]
    rows = [ball(0, first, axis) for first in (MO.BALL_VELOCITY, MO.BALL_ACCELERATION) for axis in range(3)]
    along += [np.cos(start), np.sin(start)]
    for first, values in zip([*rows[:5], MO.COS, MO.SIN], along, strict=True):
        motion[first : first + number] = values
    ps = build("paper_contacts", SMALL, Air(), [(0.0, 0.15, 0.0)], 2)
    row = np.zeros(int(ps[SD.H_RAW]))
    keep(ps, motion, row)
    found = row.reshape(SD.FAMILIES, SD.FAMILY_ROWS, -1)[:, :, :number]
    turning = omega * normal_velocities(0.0)
    assert found[:, SD.FAMILY_TURN] == pytest.approx(turning, rel=1e-12)
    # of 1000 m/s2; the error of the difference is (omega h)^2 / 6 of omega v
    rate = (normal_velocities(h) - normal_velocities(-h)) / (2.0 * h)
    assert found[:, SD.FAMILY_RATE] == pytest.approx(rate, abs=1e-2)


def test_scalars_of_the_paper_are_rates_of_magnitudes():
    """Eqs. 16, 19, 28 and 41 by a difference: |v| across the axis, |2 w_x, w_y, w_z| times half a radius."""
    rng, number, h = np.random.default_rng(4), SMALL.ball_count, 1e-6
    places = [MO.PER_BODY * body + first for body in range(3) for first in (MO.VELOCITY, MO.SPIN)]
    places += [ball(j, first) for first in (MO.BALL_VELOCITY, MO.BALL_SPIN) for j in range(number)]
    steps = [1] * 6 + [STRIDE] * 2 * number
    behind = [MO.ACCELERATION - MO.VELOCITY] * 6 + [MO.BALL_ACCELERATION - MO.BALL_VELOCITY] * 2 * number
    values, rates = rng.normal(size=(2, len(places), 3))
    motion = np.zeros(MO.SIZE)
    for at, step, rate_at, value, rate in zip(places, steps, behind, values, rates, strict=True):
        motion[at : at + 3 * step : step] = value
        motion[at + rate_at : at + rate_at + 3 * step : step] = rate
    ps = build("paper", SMALL, Air(), [(0.0, 0.15, 0.0)])
    row = np.zeros(int(ps[SD.H_RAW]))
    keep(ps, motion, row)
    before, after = (values + way * h * rates for way in (-1.0, 1.0))

    def rate_of(rows, weights):
        sizes = [np.linalg.norm(one[rows] * weights, axis=1) for one in (before, after)]
        return (sizes[1] - sizes[0]) / (2.0 * h)

    bodies, balls = slice(0, 6), slice(6, None)
    outer = np.array([SMALL.inner_ring.outer, SMALL.outer_ring.outer, SMALL.cage.outer])
    across, turning = rate_of(bodies, [0.0, 1.0, 1.0])[::2], rate_of(bodies, [2.0, 1.0, 1.0])[1::2]
    # of 1 m/s2: the difference errs by h squared, and by rounding of 1e-16 over h
    assert row[SD.C_CYLINDERS : SD.C_CYLINDERS + 3] == pytest.approx(across, abs=1e-8)
    assert row[SD.C_POINTS : SD.C_POINTS + 3] == pytest.approx(0.25 * outer * turning, abs=1e-8)
    assert row[SD.C_PISTONS : SD.C_PISTONS + 3] == pytest.approx(rates[bodies][::2, 0], rel=1e-15)
    own = row[SD.C_PAPER_BALLS :][: SD.PAPER_BALL * number].reshape(number, SD.PAPER_BALL).T
    moving, spinning = rate_of(balls, [1.0, 1.0, 1.0]).reshape(2, number)
    assert own[0] == pytest.approx(moving, abs=1e-8)
    assert own[1] == pytest.approx(0.25 * SMALL.ball_diameter * spinning, abs=1e-8)


def test_contact_paths_need_a_place_outside():
    with pytest.raises(ValueError, match="inside the bearing"):
        contact_paths(SMALL, Air(), MicrophoneCircle(0.01, 0.0, [0.0]), 4)


def test_table_makes_the_sound_of_its_transfer_functions(tmp_path):
    """The compact model sent round by a file: -45 dB, of which the linear interpolation makes the most."""
    inputs = ["outer_ring.acceleration.x", "housing.acceleration.y", "cage.acceleration.z"]
    inputs += ["balls.acceleration.r.cos[1]", "balls.acceleration.t.sin[2]"]
    table = table_of(PAPER_POINTS, inputs)
    file = tmp_path / "housing.npz"
    np.savez(
        file, frequencies=table.frequencies, inputs=table.inputs, microphones=table.microphones,
        positions=table.positions, H=table.response,
    )  # fmt: skip
    names = [(name, tuple(place)) for name, place in zip(table.microphones, PAPER_POINTS, strict=True)]
    read = select(read_table(file), names[::-1], "file")
    assert read.microphones == table.microphones[::-1]
    ps = build("table", SMALL, Air(), PAPER_POINTS[::-1], 2, table=read)
    motion = still(SMALL, PERIOD)
    t = raw_time(PERIOD)
    for column, frequency in (
        (15, 500.0),
        (16, 1200.0),
        (29, 4300.0),
        (ball(1, MO.BALL_ACCELERATION, 1), 7000.0),
    ):
        motion[:, column] = np.cos(2 * np.pi * frequency * t)
    found = Player(ps).play(motion, 41 * PERIOD)
    only = still(SMALL, PERIOD)
    only[:, [15, 16, 29]] = motion[:, [15, 16, 29]]
    expected = Player(build("compact", SMALL, Air(), PAPER_POINTS[::-1], 2)).play(only, 41 * PERIOD)
    tones = [500.0, 1200.0, 4300.0]
    for mic in range(4):
        a, b = lines(found[:, mic], tones), lines(expected[:, mic], tones)
        assert np.max(np.abs(a - b)) < 10 ** (-45 / 20) * np.max(np.abs(b))
    loudest = max(abs(lines(found[:, mic], [7000.0])[0]) for mic in range(4))
    assert loudest > 1e-8  # the ball's harmonic radiates too


GOOD = {
    "frequencies": GRID,
    "inputs": np.array(["outer_ring.acceleration.y"]),
    "microphones": np.array(["P1", "P2"]),
    "positions": np.array(PAPER_POINTS[:2]),
    "H": np.exp(-2j * np.pi * GRID * 3e-4)[None, None] * np.ones((2, 1, 1)),
}


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"H": None}, "has no array H; it needs frequencies, inputs"),
        ({"H": GOOD["H"][:1]}, r"H has the shape \(1, 1, 291\); .* make \(2, 1, 291\)"),
        ({"H": np.where(GRID == 500.0, np.nan, GOOD["H"])}, "not finite for microphone P1, input.* 500 Hz"),
        ({"frequencies": GRID[::-1]}, "must ascend"),
        ({"frequencies": np.linspace(50.0, 20_000.0, len(GRID))}, "reaches from 50 to 20000 Hz; 20 to 20000"),
        ({"frequencies": np.linspace(0.0, 8000.0, len(GRID))}, "reaches from 0 to 8000 Hz; 20 to 20000"),
        ({"positions": np.zeros((2, 2))}, r"positions has the shape \(2, 2\)"),
        ({"microphones": np.array(["P1", "P1"])}, "microphone P1 is given more than once"),
        ({"microphones": np.array(["P1", "X"])}, r"has no microphone 'P2' \(it has P1, X\); add it"),
        ({"positions": np.array([PAPER_POINTS[0], (0.0, 0.2, 0.0)])}, r"is at \(0, 200, 0\) mm"),
        ({"inputs": np.array(["outer.acceleration.y"])}, "not an input of .* did you mean 'outer_ring"),
        ({"inputs": np.array(["flexure[1]"])}, "'flexure.1.' is not an input of this scene"),
        ({"frequencies": np.array(["a"] * len(GRID))}, "must be numbers"),
        ({"H": np.exp(2j * np.pi * np.sin(GRID**2)) * np.ones((2, 1, 1))}, "too far apart for outer"),
    ],
)  # fmt: skip
def test_tables_that_do_not_serve(changed, message, tmp_path):
    file = tmp_path / "t.npz"
    np.savez(file, **{name: value for name, value in (GOOD | changed).items() if value is not None})
    places = [("P1", PAPER_POINTS[0]), ("P2", PAPER_POINTS[1])]
    with pytest.raises(ValueError, match=message) as refusal:
        table = select(read_table(file), places, "file")
        build("table", SMALL, Air(), PAPER_POINTS[:2], 2, table=table)
    assert "\n" not in str(refusal.value)


def test_files_that_are_no_tables(tmp_path):
    with pytest.raises(ValueError, match="there is no such file"):
        read_table(tmp_path / "absent.npz")
    (tmp_path / "text.npz").write_text("hello")
    np.save(tmp_path / "one.npy", np.ones(3))
    for name in ("text.npz", "one.npy"):
        with pytest.raises(
            ValueError, match="not a NumPy archive of plain arrays, or damaged; make one by nump"
        ):
            read_table(tmp_path / name)


def test_refusals():
    with pytest.raises(ValueError, match="sound.radiation_model must be one of paper, paper_vector"):
        Radiation("none", SMALL)
    with pytest.raises(ValueError, match="needs a table"):
        Radiation("table", SMALL)
    with pytest.raises(ValueError, match="only boundary elements have rigid planes"):
        Radiation("compact", SMALL, plane=0.1)
    baffled = Radiators(**{**SMALL.__dict__, "baffle": True})
    with pytest.raises(ValueError, match="only boundary elements have rigid planes"):
        build("paper", baffled, Air(), PAPER_POINTS)
    for model in ("compact", "paper_vector", "paper_contacts"):
        with pytest.raises(ValueError, match="inside the bearing"):
            build(model, SMALL, Air(), [(0.0, 0.0, 0.01)])


def test_filters_say_how_well_they_follow(scene):
    """The catalogue's scenes keep -50 dB; the worst is first."""
    for name in ("7003C-bare", "7003C-spindle", "7009C-full-ceramic"):
        found = filter_errors(scene(name))
        assert found and found[0].error == max(e.error for e in found) < -50
        assert {e.component for e in found} == {"inner_ring", "outer_ring", "cage", "balls"}
        assert all(48 <= e.taps <= 256 and e.kind in ("radial", "axial", "balls") for e in found)
