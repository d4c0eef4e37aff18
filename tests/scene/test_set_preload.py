"""Preload of a set by a class or an offset of the ring faces, against a law of Hertz of the test's own."""

import math

import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from fmu_bearing.scene import SceneError, read_scene_text
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.origins import origins
from fmu_bearing.scene.template import new_scene
from fmu_bearing.steady.statics import statics
from tests.marks import heavy_but
from tests.messages import says

PAIR = 390.0  # N: NSK's medium class of the 7010C


def text(arrangement, line='preload_class = "medium"', bearing="NSK-7010C", kind="steel"):
    made = new_scene("a", bearing, arrangement=arrangement, kind=kind, sound=False, preload_N=123.0)
    assert "preload_N = 123.0" in made
    return made.replace("preload_N = 123.0", line)


def read(*arguments, **keys):
    return read_scene_text(text(*arguments, **keys), "a")


def refused(arrangement, line, **keys):
    with pytest.raises(SceneError) as caught:
        read(arrangement, line, **keys)
    (problem,) = caught.value.problems
    return problem


def own_constant(along, across, elastic):
    """K (N/m^1.5) of Q = K d^1.5 of a contact with these sums of curvatures (1/m): Johnson (1985), 4.24 on.

    With semi-axes a and k a, p the peak pressure and 1 / E* the compliance: the sum of both halved curvatures
    is p E / (E* k a), and the approach p k a K / E*; the integrals K and E are computed by quadrature.
    """
    compliance = sum((1.0 - m.poisson_ratio**2) / (1e9 * m.youngs_modulus_GPa) for m in elastic)

    def integrals(k):
        def root(t):
            return math.sqrt(1.0 - (1.0 - k * k) * math.sin(t) ** 2)

        return quad(lambda t: 1.0 / root(t), 0.0, math.pi / 2)[0], quad(root, 0.0, math.pi / 2)[0]

    def mismatch(k):
        first, second = integrals(k)
        return (second / k**2 - first) / (first - second) - along / across

    k = brentq(mismatch, 1e-3, 1.0 - 1e-6, xtol=1e-14)
    first, second = integrals(k)
    # a^3 over Q, from p = 3 Q / (2 pi k a^2)
    cube = 3.0 * compliance * second / (math.pi * k**2 * (along + across))
    return (2.0 * math.pi * cube ** (1.0 / 3.0) / (3.0 * compliance * first)) ** 1.5


def own_load(scene):
    """Axial load (N) of one bearing at rest over the axial displacement of its rings (m)."""
    b, m = scene.bearing, scene.materials
    angle, d = math.radians(b.contact_angle_deg), 1e-3 * b.ball_diameter_mm
    g = b.ball_diameter_mm * math.cos(angle) / b.pitch_diameter_mm
    constants = [
        own_constant(2.0 / d / (1.0 + side * g), (2.0 - 1.0 / conformity) / d, (ring, m.balls))
        for side, conformity, ring in (
            (-1.0, b.inner_conformity, m.inner_ring), (1.0, b.outer_conformity, m.outer_ring),
        )
    ]  # fmt: skip
    series = sum(one ** (-2.0 / 3.0) for one in constants) ** -1.5
    free = (b.inner_conformity + b.outer_conformity - 1.0) * d

    def load(x):
        along, across = free * math.sin(angle) + max(x, 0.0), free * math.cos(angle)
        length = math.hypot(along, across)
        return b.ball_count * series * max(length - free, 0.0) ** 1.5 * along / length

    return load


def flush(load, pair, more, fewer):
    """Loads of a bearing of the side with more and with fewer, whose faces are flush: own search."""
    offset = brentq(lambda x: load(x) - pair, 0.0, 1e-3, xtol=1e-16)
    x = brentq(lambda x: more * load(x) - fewer * load(2.0 * offset - x), 0.0, 2.0 * offset, xtol=1e-16)
    return load(x), load(2.0 * offset - x)


@pytest.mark.parametrize(
    ("arrangement", "more", "fewer"),
    heavy_but([("DB", 1, 1), ("DF", 1, 1), ("QBC", 2, 2), ("TBT", 2, 1), ("QBT", 3, 1)], 0, 3),
)
@pytest.mark.parametrize("kind", heavy_but(["steel", "hybrid"], 1))
def test_a_class_is_the_offset_of_the_loose_pair(arrangement, more, fewer, kind):
    """The law agrees with the package's to 1e-9, the preloads that the statics find to 1e-6."""
    found = read(arrangement, kind=kind)
    low, high = flush(own_load(found), PAIR, more, fewer)
    assert found.spindle.preload.preload_N == pytest.approx(low, rel=1e-8)
    assert more * low == pytest.approx(fewer * high, rel=1e-9)
    by_side = {"+": low, "-": low if more == fewer else high}
    expected = [by_side[sign] for sign in found.spindle.directions]
    assert statics(found).preloads["cold"] == pytest.approx(expected, rel=1e-6)


def test_a_triplet_has_0_68_and_1_36_of_the_pair():
    """Both displacements add up to two offsets: x and 2^(2/3) x with loads by the power 1.5.

    Contact angles that grow with the load raise both a little: by 3.5 % in the heaviest classes.
    """
    constant_angle = (2.0 / (1.0 + 2.0 ** (2.0 / 3.0))) ** 1.5
    assert constant_angle == pytest.approx(0.680, abs=5e-4)
    for name in list(sizes())[::6]:
        for line in ("extra light", "light", "medium", "heavy"):
            found = read("TBT", f'preload_class = "{line}"', bearing=name)
            ratio = found.spindle.preload.preload_N / sizes()[name].preload[line].force
            assert constant_angle < ratio < 1.035 * constant_angle, (name, line)
    least = read("TBT", "preload_offset_um = 0.01")
    assert least.spindle.preload.preload_N == pytest.approx(
        constant_angle * own_load(least)(1e-8), rel=1e-4
    )  # no angle grows


@pytest.mark.parametrize("arrangement", ["DB", "TBT"])
def test_an_offset_in_um_is_the_class_that_it_makes(arrangement):
    by_class = read(arrangement)
    offset = 1e6 * brentq(lambda x: own_load(by_class)(x) - PAIR, 0.0, 1e-3, xtol=1e-16)
    by_offset = read(arrangement, f"preload_offset_um = {offset!r}")
    assert by_offset.spindle.preload.preload_N == pytest.approx(by_class.spindle.preload.preload_N, rel=1e-8)
    assert 3.0 < offset < 20.0


def test_a_class_is_read_as_newtons_and_replaced_as_a_key():
    found = read("DB")
    assert found.spindle.preload.preload_N == PAIR and "preload_class" not in found.to_toml()
    heavy = found.replace({"spindle.preload.preload_class": "heavy"})
    assert heavy.spindle.preload.preload_N == 780.0
    loose = heavy.replace({"spindle.preload.preload_offset_um": 5}).spindle.preload.preload_N
    assert loose == pytest.approx(own_load(found)(5e-6), rel=1e-8)
    with pytest.raises(SceneError, match=r"spindle.preload.preload_class = 'heavy' cannot be given with"):
        found.replace({"spindle.preload.preload_class": "heavy", "spindle.preload.preload_N": 3.0})
    # the places decide: two of three bearings the other way
    members = [one.model_dump() for one in read("TBT").spindle.bearing]
    turned = [one | {"carries": way} for one, way in zip(members, ("+x", "-x", "-x"), strict=True)]
    sets = [
        read("TBT").replace({"spindle.bearing": bearings, "spindle.preload.preload_class": "light"})
        for bearings in (members, turned)
    ]
    assert sets[0].spindle.preload.preload_N == sets[1].spindle.preload.preload_N < 0.7 * 150.0


def test_refusals_name_the_keys():
    for arrangement in ("DB", "TBT"):
        line = refused(arrangement, 'preload_class = "no"')
        assert says(line, "a: spindle.preload.preload_class = 'no' ... extra light, light, medium, heavy")
        line = refused(arrangement, "preload_offset_um = -1")
        assert says(line, "a: spindle.preload.preload_offset_um = -1 ... 0 to 200 um")
    assert "cannot be given with preload_N: the preload is given by one of" in refused(
        "DB", 'preload_class = "light"\npreload_N = 3.0'
    )
    assert 'or preload_class = "light", or preload_offset_um = 10.0' in refused("DB", "")
    assert "did you mean 'preload_class'?" in refused("DB", 'preload_N = 1.0\npreload_clas = "light"')
    spring = text("DB", 'preload_class = "light"').replace(
        'kind = "spacer"', 'kind = "spring"\nforce_N = 9.0'
    )
    with pytest.raises(SceneError) as caught:
        read_scene_text(spring.replace('carries = "-x"', 'carries = "-x"\nseat = "sliding"'))
    (line,) = caught.value.problems
    assert says(line, "spindle.preload.preload_class = 'light' ... springs ... force_N ... kind = \"spacer\"")


def test_origin_is_reported_in_words(tmp_path):
    file = tmp_path / "a.toml"
    for arrangement, line, words in (
        ("DB", 'preload_class = "medium"', "medium class of NSK: 390 N"),
        (
            "TBT",
            'preload_class = "medium"',
            "medium class of NSK: 390 N; faces flush: 2 bearings of 267.2 N against 1 of 534.4 N",
        ),
    ):
        file.write_text(text(arrangement, line))
        (one,) = [one for one in origins(file) if one.key == "spindle.preload.preload_N"]
        assert one.origin == "file" and one.remark == words and not one.assumed
