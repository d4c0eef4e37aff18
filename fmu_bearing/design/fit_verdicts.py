"""Verdicts on a bearing's seats: hoop stress, loss of the fit, creep, free angle, mounting.

The interference is the one that the scene takes, and the least or largest that its classes allow where that
is the worse one. Hoop stress counts 1.07 times, see `mounted.GROOVE`.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from fmu_bearing.design.mounted import GROOVE, Mounted, mounted, with_interference
from fmu_bearing.design.operating_point import BearingPoint
from fmu_bearing.design.verdict import Judgement, Verdict, overall, unjudged
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas.fits import REFERENCE, creep_interference, creep_torque, mounting_kelvin
from fmu_bearing.scene.fit import shaft_partner

#: Chance that a ring breaks at once which is good, and from which on the design is changed: assumed.
SAFE, UNSAFE = 1e-6, 1e-4
#: Speed at which the fit lets go over the speed, below which it is watched (assumed).
LOSS_MARGIN = 1.2
#: rad off the drawing from which on a free angle is watched: assumed, twice a maker's tolerance or so.
_ANGLE_OFF = math.radians(2.0)
_FRICTION = 0.12  # of dry steel seats, assumed
_STATES = ((0.0, 0.0), (0.0, 1.0), (1.0, 1.0))  # share of speed, warmth: cold, warm, at speed


def fit_verdicts(point: BearingPoint) -> Iterator[Verdict]:
    """Yield the verdicts on the seats of one bearing; none for rings as drawn."""
    if point.scene.fit is None:
        return
    own, low, high = (
        mounted(one)
        for one in (point.scene, with_interference(point.scene, "min"), with_interference(point.scene, "max"))
    )
    if "inner" in own.seats:
        yield _hoop(own, high)
        yield _loss(own, low)
        yield from _creep(point, own)
    if "outer" in own.seats:
        yield _gap(own, low, high)
    yield (_clearance if point.scene.bearing.is_deep_groove else _free_angle)(own, low, high)
    if "inner" in own.seats:
        yield _mounting(own, high)


def mounted_preload(
    point: BearingPoint, loads: Mapping[str, float], judged: Iterable[Verdict]
) -> Iterator[Verdict]:
    """Yield the verdict on the preload from drawing to speed: that on the pressure and life it leads to.

    ``loads``: see `mounted.preloads`; ``judged``: the verdicts on this bearing.
    """
    if not loads:
        return
    key, label = "mounted_preload", f"preload {', '.join(loads)}, N"
    text, running = ", ".join(f"{force:.0f}" for force in loads.values()), loads["running"]
    relevant = [one for one in judged if one.key in ("pressure", "life")]
    worst = overall(relevant)
    if worst == "not judged":
        one = unjudged(key, label, "judged by pressure and life, which have no limit here", running, text)
        yield replace(one, bearing=point.load.number)
        return
    advice, first = "", next(iter(loads))
    if worst != "good":
        beyond = " and ".join(one.label for one in relevant if one.judgement == worst)
        advice = (
            f"preload {loads[first]:.0f} N {first} is {running:.0f} N at the operating point, where {beyond} "
            "is beyond its limit: take looser fits, or ask for a lighter preload of the loose bearing"
        )
    yield Verdict(
        key, label, running, text, "by pressure and life", "as pressure and life", worst, advice,
        point.load.number,
    )  # fmt: skip


def _hoop(own: Mounted, high: Mounted) -> Verdict:
    stresses = [
        max(GROOVE * one.at("inner", share * one.speed, warm).hoop for share, warm in _STATES)
        for one in (own, high)
    ]
    shown = f"{1e-6 * stresses[0]:.0f} MPa, {1e-6 * stresses[1]:.0f} at max"
    if own.scene.materials.steel_rings:
        why = "no limit of hardened steel rings was read: ask the maker"
        return unjudged("hoop_inner", "hoop stress, inner ring, MPa", why, stresses[0], shown)
    chances = [
        [one.breaking_chance(share * one.speed, warm) for share, warm in _STATES] for one in (own, high)
    ]
    known = [[chance for chance in row if chance is not None] for row in chances]
    if not all(known):
        why = "ask the maker for bending strength and Weibull modulus (materials.inner_ring)"
        return unjudged("hoop_inner", "hoop stress, inner ring, MPa", why, stresses[0], shown)
    at_take, worst = max(known[0]), max(max(known[0]), max(known[1]))
    judgement: Judgement = "good" if worst < SAFE else "watch" if worst <= UNSAFE else "change"
    advice = ""
    if judgement != "good":
        advice = (
            f"hoop stress: the inner ring breaks at once with a chance of {at_take:.1g}, of {worst:.1g} at "
            f"the largest interference ({shown}), above {SAFE if judgement == 'watch' else UNSAFE:g} "
            "(assumed): take a looser class, a shaft that is hollow, cooler or expands less, or a stronger "
            "material"
        )
    return Verdict(
        "hoop_inner", "chance that the inner ring breaks", at_take,
        f"{at_take:.1g}, {worst:.1g} at max ({shown})", f"{SAFE:g} good, {UNSAFE:g} change",
        "assumed; Weibull over the volume, closed form times 1.07, no slow cracks", judgement, advice,
    )  # fmt: skip


def _loss(own: Mounted, low: Mounted) -> Verdict:
    label, source = "speed of fit loss over speed, inner", "computed at the least interference"
    speed = abs(own.speed)
    speeds = [one.loss_speed("inner") for one in (own, low)]
    shares = [math.inf if at is None or (at > 0.0 and speed == 0.0) else _over(at, speed) for at in speeds]
    margin = min(shares)
    text = ", ".join(
        ("never" if math.isinf(share) else f"{share:.2f}") + words
        for share, words in zip(shares, ("", " at min"), strict=True)
    )
    judgement: Judgement = "good" if margin >= LOSS_MARGIN else "watch" if margin >= 1.0 else "change"
    advice = ""
    if judgement != "good":
        least = 2e6 * low.at("inner", low.speed).interference
        at = speeds[1] if speeds[1] is not None else 0.0
        advice = (
            f"the fit of the inner ring lets go at {at / RPM:.0f} r/min with the least interference "
            f"({least:+.1f} um at the operating point): take a tighter class, pair shafts and rings by their "
            "measured diameters, or clamp the ring along its axis"
        )
    hot = _hotter(own)
    if hot:
        judgement = "watch" if judgement == "good" else judgement
        advice = "; ".join(part for part in (advice, hot) if part)
    return Verdict(
        "fit_loss", label, margin if math.isfinite(margin) else None, text, f"{LOSS_MARGIN:g}, 1 change",
        source, judgement, advice,
    )  # fmt: skip


def _hotter(own: Mounted) -> str:
    """Return what an inner ring that is hotter than its shaft takes off its fit; empty: it is not."""
    ring, shaft = own.temperatures("inner")
    seat = own.seats["inner"].fit
    taken = -2e6 * (seat.ring * (ring - REFERENCE) + seat.partner * (shaft - REFERENCE))
    if ring - shaft <= 0.0 or taken <= 0.0:
        return ""
    return (
        f"the inner ring is {ring - shaft:.3g} K hotter than the shaft that holds it, which takes "
        f"{taken:.2g} um off its fit: give both temperatures as they will be"
    )


def _over(at: float, speed: float) -> float:
    return at / speed if speed > 0.0 else 0.0


def _gap(own: Mounted, low: Mounted, high: Mounted) -> Verdict:
    """Return how the outer ring sits: a loose one is wanted where it has to slide."""
    interferences = [2e6 * one.at("outer", one.speed).interference for one in (own, low, high)]
    text = f"{interferences[0]:+.1f} ({interferences[1]:+.1f} to {interferences[2]:+.1f})"
    why = "+ tight; an outer ring that slides needs a gap, one that is fixed none"
    return unjudged("fit_loss_outer", "outer ring in its housing, um", why, 1e-6 * interferences[0], text)


def _creep(point: BearingPoint, own: Mounted) -> Iterator[Verdict]:
    seat, state = own.seats["inner"].fit, own.at("inner", own.speed)
    tight, needed = (
        2.0 * state.interference,
        2.0 * creep_interference(seat.seat_radius, seat.width, point.radial),
    )
    advice = ""
    if tight < needed:
        advice = (
            f"creep: the inner ring has {1e6 * tight:+.2f} um of interference at the operating point, below "
            f"the {1e6 * needed:.2f} um that a radial load of {point.radial:.0f} N takes off (makers): take "
            "a tighter class, or clamp the ring"
        )
    yield Verdict(
        "creep", "interference against creep, um", tight, f"{1e6 * tight:+.2f}", f"{1e6 * needed:.2f}",
        "0.08 sqrt(d F / B): a maker's catalogue, Fits and internal clearances, eq. 9.1",
        "watch" if advice else "good", advice,
    )  # fmt: skip
    torque = creep_torque(state.pressure, seat.seat_radius, seat.width, _FRICTION)
    friction = abs(point.friction_torque)
    if friction == 0.0:
        return
    advice = ""
    if torque < friction:
        advice = (
            f"creep: the seat of the inner ring holds {1e3 * torque:.3g} N mm by friction, less than the "
            f"bearing's own {1e3 * friction:.3g} N mm (friction {_FRICTION:g} of the seat, assumed): take a "
            "tighter class, or clamp the ring"
        )
    yield Verdict(
        "creep_torque", "torque that the seat holds over friction", torque / friction,
        f"{torque / friction:.3g}", "1", f"computed; friction {_FRICTION:g} of the seat assumed, no clamping",
        "watch" if advice else "good", advice,
    )  # fmt: skip


def _clearance(own: Mounted, low: Mounted, high: Mounted) -> Verdict:
    left, loosest, tightest = (1e6 * one.clearance(one.speed) for one in (own, low, high))
    text, advice = f"{left:.1f}", ""
    if tightest < 0.0:
        worst = text if left < 0.0 else f"{tightest:.1f} um with the tightest of the fits, {text}"
        advice = (
            f"radial clearance {worst} um at the operating point: balls are pressed between the races, more "
            "with each kelvin that the inner ring is warmer: take looser fits, or a larger clearance"
        )
    judgement: Judgement = "change" if left < 0.0 else "watch" if advice else "good"
    return Verdict(
        "clearance", "clearance at the operating point, um", 1e-6 * left,
        f"{text} ({tightest:.1f} to {loosest:.1f})", "0", "rule of the field, no standard", judgement, advice,
    )  # fmt: skip


def _free_angle(own: Mounted, low: Mounted, high: Mounted) -> Verdict:
    drawn = own.scene.bearing.nominal_angle_deg
    angle, loosest, tightest = (one.free_angle(one.speed) for one in (own, low, high))
    text, off = f"{math.degrees(angle):.1f}", angle - math.radians(drawn)
    judgement: Judgement = "change" if angle == 0.0 else "watch" if abs(off) > _ANGLE_OFF else "good"
    advice = ""
    if judgement == "change":
        advice = (
            "free contact angle 0: the fits leave no radial clearance, and the bearing is pressed radially: "
            "take looser fits, or a larger contact angle"
        )
    elif judgement == "watch":
        advice = (
            f"free contact angle {text} deg, mounted and at speed: {math.degrees(off):+.1f} deg off the "
            f"{drawn:.4g} deg of the drawing, more than 2 (assumed): take other fits, or another angle"
        )
    shown = f"{text} ({math.degrees(tightest):.1f} to {math.degrees(loosest):.1f})"
    return Verdict(
        "free_angle", "free angle at the operating point, deg", angle, shown, f"{drawn:.4g} +- 2", "assumed",
        judgement, advice,
    )  # fmt: skip


def _mounting(own: Mounted, high: Mounted) -> Verdict:
    label = "to slip the inner ring on, K"
    ring, shaft = own.scene.materials.inner_ring, shaft_partner(own.scene)[0]
    parts = []
    value = None
    for words, one in (("ring warmed", ring), ("shaft cooled", shaft)):
        if one.expansion_1e6_K == 0.0:
            parts.append(f"{words}: does not expand")
            continue
        kelvins = [
            mounting_kelvin(
                made.at("inner", 0.0, 0.0).interference,
                made.seats["inner"].fit.seat_radius,
                1e-6 * one.expansion_1e6_K,
            )
            for made in (own, high)
        ]
        value = kelvins[0] if value is None else value
        parts.append(f"{words} {kelvins[0]:.0f}, {kelvins[1]:.0f} at max")
    return unjudged("mounting", label, "computed: without force and without play", value, "; ".join(parts))
