"""Names, directions, what is put apart, cautions and refusals."""

import numpy as np
import pytest

from fmu_bearing import modes
from fmu_bearing.engine.layout import P
from fmu_bearing.instance import EngineError

RPM = np.pi / 30.0


def test_forward_is_with_the_shaft(gate):
    """Turned the other way round the bearing is its own mirror image."""
    scene = gate("7003C-bare")
    one, other = (modes(scene, {"shaft_speed": sign * 10_000 * RPM}) for sign in (1.0, -1.0))
    assert [mode.label for mode in one.modes] == [mode.label for mode in other.modes]
    own, mirrored = (np.array([mode.frequency for mode in found.modes]) for found in (one, other))
    assert mirrored == pytest.approx(own, rel=1e-6)


def test_shares_of_energy_add_up_to_one(gate):
    found = modes(gate("7009C-full-ceramic"), {"shaft_speed": 12_000 * RPM})
    for mode in found.modes:
        assert sum(mode.participation.values()) == pytest.approx(1.0, rel=1e-9)
        assert list(mode.participation.values()) == sorted(mode.participation.values(), reverse=True)
        assert 0.0 <= mode.ring_share <= 1.0 + 1e-12


def test_neutral_and_overdamped_motions_are_apart(gate):
    """Balls that are free along their orbits would be lines at multiples of the cage's frequency."""
    found = modes(gate("7003C-bare"), {"shaft_speed": 10_000 * RPM})
    cage = abs(found.linearised.orbit) / (2.0 * np.pi)
    assert min(mode.frequency for mode in found.modes) > 10.0 * cage
    multiples = [mode.frequency / cage for mode in found.apart if mode.damping < 0.01]
    assert len(multiples) >= 5
    assert multiples == pytest.approx(np.round(multiples), abs=1e-3)
    assert any(mode.damping > 0.5 for mode in found.apart)


def test_rigid_preload_holds_the_inner_ring(gate):
    scene = gate("7003C-spindle", **{"mounting.preload_mode": "rigid"})
    found = modes(scene)
    assert not any(mode.name == "inner axial" for mode in found.modes)
    axial = found.named("outer axial")
    assert axial.participation.get("inner axial", 0.0) < 1e-9
    # the ring presses from its place: stiffer than the pedestal alone
    assert axial.frequency > 1.5 * modes(gate("7003C-spindle")).named("outer axial").frequency


def test_springs_between_balls_give_the_chain(gate):
    """(1/pi) sqrt(k/m) cos(pi/N) sin(pi j/N), as races hold the radii; these and rings move them a little."""
    scene = gate("7003C-impact")
    found = modes(scene, {"shaft_speed": 10_000 * RPM})
    spring, p = 2.5e7, found.linearised.bearings[0].arrays.p
    assert p[P.SPRINGS] == spring
    chain = np.sqrt(spring / p[P.BALL_MASS]) * np.sin(np.pi * np.arange(2, 7) / 12) / np.pi
    chain *= np.cos(np.pi / 12)
    orbits = [mode for mode in found.modes if mode.name.startswith("ball orbit")]
    for j, hertz in zip(range(2, 7), chain, strict=True):
        own = [mode.orbiting.imag / (2.0 * np.pi) for mode in orbits if mode.order == j]
        assert own and np.abs(own) == pytest.approx(hertz, rel=0.03)


def test_unequal_loads_are_told(gate):
    scene = gate("7009C-full-ceramic")
    loaded = modes(scene, {"shaft_speed": 12_000 * RPM, "radial_load.z": -300.0})
    assert all(mode.spread == 0.0 for mode in modes(scene).modes)
    assert max(mode.spread for mode in loaded.modes if mode.ring_share > 0.05) > 0.0
    spread = max(mode.spread for mode in loaded.modes if mode.ring_share > 0.05)
    assert ("one ball pitch" in " ".join(loaded.cautions())) == (spread > 0.01)


def test_hardly_damped_tilting_is_named(gate):
    """7009C at 18,000 r/min: damping of the forward tilting mode near zero."""
    found = modes(gate("7009C-full-ceramic"), {"shaft_speed": 18_000 * RPM})
    (weak,) = found.weak()
    assert weak.label == "inner tilt forward" and abs(weak.damping) < 1e-3
    assert [mode.name for mode in found.records() if mode.remark] == ["inner tilt"]
    assert any("inner tilt forward" in line and "instability" in line for line in found.cautions())
    assert not modes(gate("7009C-full-ceramic"), {"shaft_speed": 12_000 * RPM}).weak()


def test_standstill_is_told(gate):
    found = modes(gate("7003C-bare"), {"shaft_speed": 0.0})
    assert any("contacts stick" in line for line in found.cautions())
    assert {mode.direction for mode in found.modes} == {""}


def test_nearest_mode_and_mode_by_name(gate):
    found = modes(gate("7003C-spindle"))
    axial = found.named("inner axial")
    assert found.near(1.05 * axial.frequency) is axial
    with pytest.raises(ValueError, match="there is no mode 'inner wobble'; there are .*inner axial"):
        found.named("inner wobble")
    with pytest.raises(ValueError, match="positive number of hertz"):
        found.near(-1.0)


def test_a_single_bearing_has_no_line_of_a_shaft(gate):
    found = modes(gate("7003C-spindle"))
    for ask in (lambda: found.line(0), found.picture):
        with pytest.raises(ValueError, match="for the shaft of a set: `shape` returns a bearing's motion"):
            ask()


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        ({"shaft_sped": 1.0}, "did you mean 'shaft_speed'"),
        ({"preload": -1.0}, "allowed are 0 to 10000 N"),
        ({"preload": "much"}, "give a number"),
        ({"shaft_speed": float("nan")}, "is refused"),
    ],
)
def test_refused_inputs(gate, inputs, words):
    with pytest.raises(ValueError, match=words):
        modes(gate("7003C-bare"), inputs)


def test_a_bearing_without_equilibrium_is_refused_with_the_reason(gate):
    with pytest.raises(EngineError, match="7003C-spindle.*pitch radius"):
        modes(gate("7003C-spindle"), {"pedestal_stiffness": 1e4, "radial_load.z": -3e3})


def test_shape_of_the_axial_mode(gate):
    """Rings move against each other along the axis, balls between them, all equally; nothing else moves."""
    found = modes(gate("7003C-spindle"))
    axial = found.named("inner axial")
    shape = found.shape(axial)
    assert found.shape(found.modes.index(axial)).inner == pytest.approx(shape.inner)
    inner, outer = shape.inner[0], shape.outer[0]
    assert inner == pytest.approx(1.0) and -0.3 < outer.real < -0.05
    # momentum: rotor and housing are as heavy as each other but for the pedestal's force
    balls = shape.balls(0.3)
    assert balls.shape == (3, found.linearised.bearings[0].coordinates.balls)
    assert np.ptp(balls[0].real) < 1e-9 and min(outer.real, 1.0) < balls[0, 0].real < 1.0
    assert np.abs(np.concatenate([shape.inner[2:], shape.outer[2:]])).max() < 1e-9


def test_balls_of_a_shape_stand_at_their_angles(gate):
    """In a radial mode a ball at 12 o'clock moves as the pattern says there."""
    found = modes(gate("7003C-bare"), {"shaft_speed": 10_000 * RPM})
    shape = found.shape(found.named("inner radial", "forward"))
    first = shape.balls()[1, 0]
    assert first == pytest.approx(shape.patterns[1, 0] + shape.patterns[1, 1::2].sum(), abs=1e-9)
    # a forward wave reaches the next ball later
    later = shape.balls()[1, 1] / first
    assert np.angle(later) == pytest.approx(-2.0 * np.pi / 12.0, abs=1e-3)


def test_table_has_rows_of_balls_alone_once(gate):
    found = modes(gate("7009C-full-ceramic").with_rigid_rings(), {"shaft_speed": 12_000 * RPM})
    rows = found.records(60e3)
    (row,) = [row for row in rows if row.name.startswith("ball n = 2 to ")]
    assert row.name == "ball n = 2 to 8" and row.direction == ""
    assert [row.frequency for row in rows] == sorted(row.frequency for row in rows)
    assert max(row.frequency for row in found.records(5e3)) <= 5e3
    assert all(row.frequency < 5e3 for row in found.records(5e3, apart=True))


def test_modes_are_those_of_fidelity_full_whatever_the_scene_takes(gate):
    known = [mode.frequency for mode in modes(gate("7003C-spindle")).modes]
    for fidelity in ("rings", "auto"):
        found = modes(gate("7003C-spindle").replace({"fidelity.model": fidelity}))
        assert [mode.frequency for mode in found.modes] == pytest.approx(known, rel=1e-9)
