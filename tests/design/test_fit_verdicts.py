"""Verdicts on the seats: at, below and above each limit, and what is not judged."""

import math
from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing import operating_point, verdicts
from fmu_bearing.design.fit_pictures import limit
from fmu_bearing.design.fit_verdicts import SAFE, UNSAFE, fit_verdicts
from fmu_bearing.design.mounted import GROOVE, mounted
from fmu_bearing.formulas.fits import State, breaking_chance
from tests.design.test_fits import HOUSING, SHAFT, STEEL, bearing, tight

GOOD, WATCH, CHANGE, NONE = "good", "watch", "change", "not judged"
STRONG = {"bending_strength_MPa": 900.0, "weibull_modulus": 12.0}
SI3N4 = {"youngs_modulus_GPa": 310.0, "poisson_ratio": 0.26, "density_kg_m3": 3200.0, "expansion_1e6_K": 3.2}


def found(point):
    return {one.key: one for one in fit_verdicts(point)}


@pytest.fixture(scope="module")
def steel():
    return operating_point(bearing(shaft=SHAFT))


@pytest.fixture(scope="module")
def ceramic():
    return operating_point(bearing(SI3N4 | STRONG, "Si3N4", 60.0, shaft=tight(2.0, bore_mm=8.0))).bearings[0]


def changed(point, **values):
    return replace(point, scene=point.scene.replace(values))


@pytest.mark.parametrize(
    ("strength", "modulus", "chances"),
    [(900.0, 12.0, (7e-10, 9e-8, 3e-6, 4e-5)), (600.0, 7.0, (5e-4, 8e-3, 6e-2, 0.25))],
)
def test_chances_of_the_page(ceramic, strength, modulus, chances):
    """Hoop at the bore of 100, 150, 200, 250 MPa, as the page rounds it; `limit` is their inverse."""
    fit = mounted(ceramic.scene).seats["inner"].fit
    for stress, chance in zip((100e6, 150e6, 200e6, 250e6), chances, strict=True):
        state = State(0.0, stress / fit.hoop, stress, 0.0)
        exact = breaking_chance(fit, state, 0.0, 1e6 * strength, modulus)
        assert exact == pytest.approx(chance, rel=0.17)  # half of the last digit of 3e-6
        assert limit(fit, exact, 1e6 * strength, modulus) == pytest.approx(stress, rel=1e-6)


@pytest.mark.parametrize(
    ("share", "judgement"), [(1.001, GOOD), (0.999, WATCH), (None, WATCH), (-0.999, CHANGE)]
)
def test_chance_of_a_ceramic_ring(ceramic, share, judgement):
    """Strength is set so that 1.07 times the hoop stress at speed has a chance beside a limit."""
    own = mounted(ceramic.scene)
    fit, state = own.seats["inner"].fit, own.at("inner", own.speed)

    def chance(strength):
        return breaking_chance(fit, state, own.speed, strength / GROOVE, 12.0)

    strength = 900e6
    target = {1.001: SAFE / 1.01, 0.999: SAFE * 1.01, None: UNSAFE / 1.01, -0.999: UNSAFE * 1.01}[share]
    for _ in range(5):  # chances this small go with the power of the modulus
        strength *= (chance(strength) / target) ** (1.0 / 12.0)
    verdict = found(changed(ceramic, **{"materials.inner_ring.bending_strength_MPa": 1e-6 * strength}))[
        "hoop_inner"
    ]
    assert verdict.value == pytest.approx(target, rel=1e-3)
    assert verdict.judgement == judgement and ("hoop stress" in verdict.advice) == (judgement != GOOD)
    assert f"{GROOVE:g}" in verdict.source and "assumed" in verdict.source


def test_the_largest_interference_decides(ceramic):
    """At 2 um the ring is safe, at the 8 um that js5 allows it is not with weaker material."""
    by_class = {
        "mounting.fit.shaft.interference_um": None, "mounting.fit.shaft.shaft_class": "js5",
        "materials.inner_ring.bending_strength_MPa": 700.0,
    }  # fmt: skip
    verdict = found(changed(ceramic, **by_class))["hoop_inner"]
    assert verdict.value < UNSAFE / 100.0 and verdict.judgement == WATCH and "at max" in verdict.text


def test_rings_without_strength_and_rings_of_steel_are_not_judged(ceramic, steel):
    weak = found(changed(ceramic, **{"materials.inner_ring.weibull_modulus": None}))["hoop_inner"]
    assert weak.judgement == NONE and "ask the maker for bending strength and Weibull modulus" in weak.source
    assert weak.value == pytest.approx(GROOVE * 96.77e6, rel=1e-3)
    (point,) = steel.bearings
    hard = found(point)["hoop_inner"]
    assert hard.judgement == NONE and "no limit of hardened steel rings was read" in hard.source
    # of the interference taken, not of the largest of the class: cold and warm at rest, warm at speed
    own = mounted(point.scene)
    hoops = [own.at("inner", speed, warm).hoop for speed, warm in ((0.0, 0.0), (0.0, 1.0), (own.speed, 1.0))]
    assert hard.value == pytest.approx(GROOVE * max(hoops), rel=1e-12)
    assert f"{1e-6 * hard.value:.0f} MPa" in hard.text


@pytest.mark.parametrize(
    ("share", "judgement"), [(1.201, GOOD), (1.199, WATCH), (1.001, WATCH), (0.999, CHANGE)]
)
def test_speed_of_loss(steel, share, judgement):
    (point,) = steel.bearings
    given = changed(
        point, **{"mounting.fit.shaft.shaft_class": None, "mounting.fit.shaft.interference_um": 2.0}
    )
    at = mounted(given.scene).loss_speed("inner") * 30.0 / math.pi
    verdict = found(changed(given, **{"operation.speed_rpm": at / share}))["fit_loss"]
    assert verdict.value == pytest.approx(share) and verdict.judgement == judgement
    assert ("lets go" in verdict.advice) == (judgement != GOOD)


def test_the_least_interference_decides_when_the_fit_lets_go(steel, ceramic):
    assert found(steel.bearings[0])["fit_loss"].judgement == CHANGE  # js5 on P4 may be loose
    thin = changed(ceramic, **{"mounting.fit.shaft.bore_mm": 16.0})
    verdict = found(thin)["fit_loss"]  # a thin shaft of steel grows faster than the ring
    assert verdict.value is None and verdict.text == "never, never at min" and verdict.judgement == GOOD


def test_a_ring_hotter_than_its_shaft_is_to_be_watched(steel):
    """10 K on 17 mm of steel take 2.0 um off; a shaft as warm as its ring takes nothing."""
    tight = {"mounting.fit.shaft.shaft_class": None, "mounting.fit.shaft.interference_um": 20.0}
    given = changed(steel.bearings[0], **tight, **{"operation.inner_ring_temperature_degC": 50.0})
    hot = changed(given, **{"mounting.fit.shaft.temperature_degC": 40.0})
    verdict = found(hot)["fit_loss"]
    assert (
        verdict.judgement == WATCH and "10 K hotter" in verdict.advice and "takes 2 um off" in verdict.advice
    )
    even = found(changed(given, **{"mounting.fit.shaft.temperature_degC": 50.0}))["fit_loss"]
    assert even.judgement == GOOD and not even.advice


@pytest.mark.parametrize(("share", "judgement"), [(0.99, GOOD), (1.01, WATCH)])
def test_creep(steel, share, judgement):
    """0.08 um sqrt(d F / B) on diameter, d and B in mm: here 1.705 um at speed."""
    (point,) = steel.bearings
    left = 2e6 * mounted(point.scene).at("inner", 20e3 * math.pi / 30.0).interference
    load = (left * share / 0.08) ** 2 * 10.0 / 17.0
    loaded = replace(point, load=replace(point.load, force=np.array([150.0, load, 0.0])))
    verdict = found(loaded)["creep"]
    assert verdict.judgement == judgement and float(verdict.limit) == pytest.approx(left * share, abs=0.006)


@pytest.mark.parametrize(("share", "judgement"), [(0.99, GOOD), (1.01, WATCH)])
def test_torque_that_the_seat_holds(steel, share, judgement):
    (point,) = steel.bearings
    pressure = mounted(point.scene).at("inner", 20e3 * math.pi / 30.0).pressure
    held = 0.12 * pressure * math.pi * 17e-3**2 * 10e-3 / 2.0
    verdict = found(replace(point, friction_torque=-share * held))["creep_torque"]
    assert verdict.judgement == judgement and verdict.value == pytest.approx(1.0 / share)


@pytest.mark.parametrize(("um", "judgement"), [(2.0, GOOD), (4.0, WATCH), (16.0, CHANGE)])
def test_free_angle(um, judgement):
    point = operating_point(bearing(shaft=tight(um))).bearings[0]
    verdict = found(point)["free_angle"]
    off = abs(math.degrees(verdict.value) - 15.0)
    assert (off < 2.0) == (judgement == GOOD) and (verdict.value == 0.0) == (judgement == CHANGE)
    assert verdict.judgement == judgement and bool(verdict.advice) == (judgement != GOOD)


def test_preload_is_judged_by_the_pressure_and_life_that_it_leads_to(steel, ceramic):
    judged = {one.key: one for one in verdicts(steel)}
    assert judged["life"].judgement == CHANGE  # 10,500 h of 20,000 assumed
    one = judged["mounted_preload"]
    assert (one.judgement, one.text, one.bearing) == (CHANGE, "150, 207, 207, 214", 1)
    assert "ask for a lighter preload" in one.advice
    assert judged["preload_class"].text.startswith("150")  # the class stays that of the loose bearing
    pair = {one.key: one for one in verdicts(operating_point(ceramic.scene))}
    assert pair["mounted_preload"].judgement == NONE
    measured = operating_point(steel.scene.replace({"mounting.fit.preload": "mounted"}))
    measured = {one.key: one for one in verdicts(measured)}
    assert measured["mounted_preload"].label == "preload mounted, warm, running, N"
    assert measured["preload_class"].judgement == NONE


def test_mounting_and_the_outer_ring_are_told_without_a_limit():
    point = operating_point(bearing(shaft=tight(2.0), housing=HOUSING)).bearings[0]
    judged = found(point)
    assert judged["mounting"].judgement == NONE and judged["mounting"].value == pytest.approx(9.97, abs=0.01)
    assert judged["fit_loss_outer"].text == "-3.0 (-11.5 to +5.5)"
    assert judged["fit_loss_outer"].judgement == NONE


def test_a_part_that_does_not_expand_is_named(steel):
    rigid = changed(steel.bearings[0], **{"mounting.fit.shaft.material": STEEL | {"expansion_1e6_K": 0.0}})
    assert "shaft cooled: does not expand" in found(rigid)["mounting"].text


def test_rings_as_drawn_have_none_of_these(steel):
    drawn = steel.scene.replace({"mounting.fit": None})
    point = operating_point(drawn)
    assert not list(fit_verdicts(point.bearings[0]))
    assert not {"mounted_preload", "fit_loss", "creep"} & {one.key for one in verdicts(point)}


def test_every_verdict_has_limit_source_and_advice(steel, ceramic):
    for point in (steel.bearings[0], ceramic):
        for one in fit_verdicts(point):
            assert one.limit and one.source and one.text and one.label
            assert bool(one.advice) == (one.judgement in (WATCH, CHANGE))
