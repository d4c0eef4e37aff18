"""Eqs. 1 to 6 of the multi-source paper run as printed, corrected, and beside the product.

``python -m examples.papers.printed_motion`` prints both tables of the page; with ``--speed``, ``--correct``
or ``--without`` the motion of one reading at one speed.

Runs of even balls (see :mod:`examples.papers.printed_runs`) cannot show the tilt rows, the lands' force on
the inner ring, Euler's terms and weights. Growth rates of the whole bearing and figures in closed form show
these.
"""

import argparse
import math
import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np

from examples.papers.printed_equations import Corrections, Equations
from examples.papers.printed_forces import CAGE, FIRST, OUTER
from examples.papers.printed_runs import (
    TURNS,
    all_round,
    bearing_at,
    equations,
    growth,
    of_run,
    ours,
    reading,
    run,
    settled,
)
from fmu_bearing.engine.constants import RPM
from fmu_bearing.results.table import markdown, show

SPEEDS = (10_000, 20_000, 40_000)
SLOWEST, FASTEST = 1_000, 60_000  # r/min
ALONE = 20_000  # r/min: where each correction is left out alone
#: Signs without which nothing runs for a tenth of a turn.
REPAIRED = ("pedestal_sign", "cage_rotation")


def alone(name: str, turns: float = TURNS) -> dict[str, Any]:
    """Figures at :data:`ALONE` of the corrected equations without one correction, and what grows.

    The run starts in the corrected steady state; tilts need all balls with their weights.
    """
    corrections = Corrections.all().changed(off=(name,))
    system = equations(ALONE, corrections, even=name != "inner_tilt")
    state = settled(ALONE).state
    begin = state if system.even else all_round(system, state)
    found = of_run(system, run(system, begin, turns * 60.0 / ALONE))
    rate, frequency = growth(ALONE, corrections)
    return found | {"growth": rate, "frequency": frequency, "note": note(name)}


def note(name: str) -> str:
    """Figure in closed form of a fault that the run of even balls does not show."""
    b, speed = bearing_at(ALONE), ALONE * RPM
    orbit = 0.42 * speed
    match name:
        case "gyroscopic_pair":
            return f"a ball without traction gains spin at {orbit:.0f} 1/s"
        case "single_inertia":
            return "a torque on a ball gives half the acceleration"
        case "orbit_terms":
            return f"{b.ball_mass * b.pitch_radius * orbit**2:.1f} N missing"
        case "fixed_axes":
            ratio = b.inner_polar / b.inner_transverse
            return f"a free inner ring nutates at {ratio - 1.0:.2f} of shaft speed, not {ratio:.2f}"
        case "land_reaction":
            system = equations(ALONE, Corrections.all().changed(off=(name,)), even=False)
            return f"{land_force(system, 0.5):.2f} N are missing with the cage half its clearance aside"
        case "pedestal_sign":
            return f"a free ring leaves at sqrt(K/m) = {math.sqrt(b.pedestal_axial / b.outer_mass):,.0f} 1/s"
        case "pedestal_damping":
            return "rings ring on: only contacts damp them"
        case "contact_radii":
            on, off = (outer_torque(Corrections.all().changed(off=names)) for names in ((), (name,)))
            return f"torque on the outer ring {1e3 * off:.1f} N mm, not {1e3 * on:.1f}: T_xi and F_xi cancel"
        case _:
            return ""


def land_force(system: Equations, share: float) -> float:
    """Sum of the lands' forces on inner ring and cage (N), the cage aside by a share of its clearance."""
    places, rates = np.zeros((17, 1)), np.zeros((17, 1))
    places[FIRST[CAGE] + 1] = share * system.bearing.land_clearance
    rates[FIRST[CAGE] + 3] = 0.42 * system.speed
    inner, cage = np.zeros((6, 1)), np.zeros((6, 1))
    system.lands(places, rates, inner, cage)
    return float(np.linalg.norm((inner + cage)[:3]))


def outer_torque(corrections: Corrections) -> float:
    """Moment of the balls on the outer ring about its axis (N m) in the corrected steady state."""
    system = equations(ALONE, corrections)
    state = settled(ALONE).state[:, None]
    balls, places, _ = system.split(state)
    seen, touching = system.contacts(state)
    return float(system.on_rings(system.angles(balls, places), touching, seen.of(slice(2)))[3, OUTER, 0])


def results(
    speeds: Sequence[int] = SPEEDS, names: Sequence[str] = Corrections.names(), turns: float = TURNS
) -> dict[str, Any]:
    """All figures of the page: plain numbers, texts, lists and dictionaries, the same in every run.

    Parameters
    ----------
    speeds : sequence of int
        r/min.
    names : sequence of str
        Corrections that are left out alone.
    turns : float
        Of the shaft: how long readings run that have no steady state.
    """
    by_speed = {}
    for rpm in speeds:
        system = equations(rpm, Corrections.all())
        running = Corrections.none().changed(on=REPAIRED)
        by_speed[str(rpm)] = {
            "printed": reading(rpm, Corrections.none(), turns),
            "running": reading(rpm, running, turns),
            "carried": reading(rpm, running.changed(on=("traction_law",)), turns),
            "corrected": of_run(system, settled(rpm)),
            "ours": ours(rpm),
        }
    return {"turns": turns, "speeds": by_speed, "alone": {name: alone(name, turns) for name in names}}


COLUMNS = (
    "Q_i, N", "Q_o, N", "alpha_i, deg", "alpha_o, deg", "orbit", "cage", "spin, rad/s", "its pitch, deg",
    "sliding along i, o, m/s", "sliding across i, o, m/s", "ring, mm/s",
)  # fmt: skip
READINGS = {
    "running": "printed, two signs repaired",
    "carried": "the same, traction repaired",
    "corrected": "corrected",
    "ours": "ours",
}
EQUATIONS = {
    "gyroscopic_pair": "1", "single_inertia": "1", "traction_moments": "1", "pocket_moments": "1",
    "contact_couples": "1", "orbit_terms": "1", "cage_rotation": "2", "cage_tilt": "2",
    "land_reaction": "2, 3", "inner_tilt": "3", "fixed_axes": "2, 3, 5", "contact_radii": "3 to 6",
    "pedestal_sign": "5", "pedestal_damping": "5", "traction_law": "1",
}  # fmt: skip


def cells(found: dict[str, Any]) -> list[str]:
    """Cells of :data:`COLUMNS`."""
    return [
        *(f"{value:.2f}" for value in found["load"]),
        *(f"{value:.2f}" for value in found["angle"]),
        f"{found['orbit']:.4f}", f"{found['cage']:.4f}", f"{found['spin']:,.0f}", f"{found['pitch']:.1f}",
        ", ".join(f"{value:+.3f}" for value in found["slide_along"]),
        ", ".join(f"{value:+.3f}" for value in found["slide_across"]),
        f"{1e3 * found['ring_velocity']:.2f}",
    ]  # fmt: skip


def speed_table(found: dict[str, Any]) -> tuple[list[str], list[list[str]]]:
    """Head and rows of the table over speed."""
    rows = [
        [f"{int(rpm):,}", title, *cells(of_speed[key])]
        for rpm, of_speed in found["speeds"].items()
        for key, title in READINGS.items()
    ]
    return ["r/min", "equations", *COLUMNS], rows


def alone_table(found: dict[str, Any]) -> tuple[list[str], list[list[str]]]:
    """Head and rows of the table of corrections left out alone."""
    rows = []
    for name, one in found["alone"].items():
        grows = "" if one["growth"] == 0.0 else f"{one['growth']:,.0f}"
        if 2.0 * math.pi * one["frequency"] > one["growth"]:
            grows += f" at {one['frequency']:,.0f} Hz"
        numbers = ["", "", "", "", ""]
        if not one["ended"]:
            numbers = [
                "{:.2f}, {:.2f}".format(*one["load"]), "{:.2f}, {:.2f}".format(*one["angle"]),
                f"{one['orbit']:.4f}", f"{one['spin']:,.0f} at {one['pitch']:.1f}",
                f"{max(map(abs, one['slide_along'] + one['slide_across'])):.3f}",
            ]  # fmt: skip
        end = f"{one['ended']} after {1e3 * one['seconds']:.2f} ms" if one["ended"] else ""
        words = "; ".join(text for text in (end, one["note"]) if text)
        rows.append([f"`{name}`", EQUATIONS[name], *numbers, grows, words])
    columns = [
        "left out alone", "eq.", "Q_i, Q_o, N", "alpha_i, alpha_o, deg", "orbit", "spin, rad/s at deg",
        "largest sliding, m/s", "grows, 1/s", "and",
    ]  # fmt: skip
    return columns, rows


def page_of(found: dict[str, Any]) -> str:
    """Return the page: the finding, then both tables; ``found`` is what :func:`results` returned."""
    over_speed, single = markdown(*speed_table(found)), markdown(*alone_table(found))
    runs, alone = _conditions(found)
    return (
        "# The printed equations of motion, run as printed\n\n"
        "Written by `python -m examples.papers.run multi-source` (`make papers`); figures are of that run.\n"
        "Equations 1 to 6 of the [multi-source paper](multi-source.md), with and without what [mechanics\n"
        "contradicts](../printed-equations.md): `python -m examples.papers.printed_motion` runs them at any\n"
        "speed with any of the corrections.\n\n"
        f"## Verdict\n\n{_finding(found)}\n\n## Over speed\n\n{over_speed}\n{runs}\n\n"
        f"## Each correction left out\n\n{alone}\n\n{single}"
    )


def apart(found: dict[str, Any], one: str, other: str) -> tuple[float, float, float]:
    """Largest differences of two readings over all speeds: loads (N), angles (deg), orbit (share)."""
    pairs = [(of_speed[one], of_speed[other]) for of_speed in found["speeds"].values()]

    def largest(key: str) -> float:
        return max(abs(p - q) for a, b in pairs for p, q in zip(a[key], b[key], strict=True))

    return largest("load"), largest("angle"), max(abs(a["orbit"] / b["orbit"] - 1.0) for a, b in pairs)


def _filled(text: str) -> str:
    return textwrap.fill(" ".join(text.split()), 110)


def _finding(found: dict[str, Any]) -> str:
    printed = max((one["printed"] for one in found["speeds"].values()), key=lambda one: one["seconds"])
    # half the orbit speed, 0.42 of the shaft's, over a turn
    per_turn = math.exp(math.pi * next(iter(found["speeds"].values()))["corrected"]["orbit"])
    weak = found["alone"]["traction_law"]
    sliding = max(map(abs, weak["slide_along"]))
    load, angle, orbit = apart(found, "corrected", "ours")
    ended, lasted = printed["ended"], 1e3 * printed["seconds"]
    traction, orbit = max(weak["traction"]), 100.0 * orbit
    off_load, off_angle, _ = apart(found, "carried", "corrected")
    return _filled(
        f"""As printed no run lasts: {ended} after {lasted:.2f} ms at each speed (F = +K x). With that sign
        repaired, and the one of Q_cy in the rotation row of eq. 2, the equations run, but to no steady
        state: traction by eta V S / h, {traction:.0e} of the load at {sliding:.0f} m/s of sliding, cannot
        hold a ball against the gyroscopic pair, which has the same sign twice. Spin grows at half the
        orbit speed (half, since the inertia counts twice), {per_turn:.1f} times in a turn of the shaft.
        With the traction repaired too, balls roll, but loads and angles are equal at both races, because
        the centrifugal force is missing: up to {off_load:.1f} N and {off_angle:.1f} deg off. With all
        corrections the plain equations give the product's motion: loads within {load:.3f} N, angles
        within {angle:.4f} deg, orbit within {orbit:.4f} %."""
    )


def _conditions(found: dict[str, Any]) -> tuple[str, str]:
    """Say what was run for each of the two tables."""
    turns, rpm = f"{found['turns']:.0f} turns", f"{ALONE:,} r/min"
    runs = f"""Repaired readings are shown {turns} of the shaft after a start in rolling, because growing spin
        soon means nothing; the others are steady. Orbit and cage are over shaft speed, spin is seen from
        the orbit, its pitch is from the axis. The ring's velocity is the largest along the axis in the
        second half of the run. Forces that the paper leaves to its references, contact damping included,
        are the product's. One ball represents twelve, and no ring can tilt."""
    single = f"""At {rpm}, for {turns} from the corrected steady state. Growth is about that state, of twelve
        balls with all rows. Traction that carries a load holds the balls, and faults in their moments then
        hardly show; of the faults that last, only the missing centrifugal force changes loads."""
    return _filled(runs), _filled(single)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the tables, or the motion of one reading."""
    parser = argparse.ArgumentParser(
        prog="python -m examples.papers.printed_motion", description="The printed equations of motion, run."
    )
    parser.add_argument(
        "--speed", type=float, metavar="RPM", help=f"one speed, {SLOWEST:,} to {FASTEST:,} r/min"
    )
    parser.add_argument("--turns", type=float, help=f"turns of the shaft to run, default {TURNS:.0f}")
    some = parser.add_mutually_exclusive_group()
    some.add_argument(
        "--correct", nargs="+", metavar="NAME", default=[], help="put into the printed equations"
    )
    some.add_argument(
        "--without", nargs="+", metavar="NAME", default=[], help="left out of the corrected equations"
    )
    given = parser.parse_args(arguments)
    if given == parser.parse_args([]):
        found = results()
        show("The printed equations of motion", *speed_table(found))
        show(f"Each correction left out alone, {ALONE:,} r/min", *alone_table(found))
        return
    rpm = float(ALONE) if given.speed is None else given.speed
    turns = TURNS if given.turns is None else given.turns
    if not SLOWEST <= rpm <= FASTEST:
        parser.error(f"--speed {rpm:g}: not within {SLOWEST:,} to {FASTEST:,} r/min")
    if not 0.0 < turns <= 100.0:
        parser.error(f"--turns {turns:g}: not above 0 and up to 100")
    base = Corrections.all() if given.without else Corrections.none()
    try:
        corrections = base.changed(on=tuple(given.correct), off=tuple(given.without))
    except ValueError as problem:
        parser.error(str(problem))
    found = reading(rpm, corrections, turns)
    rate, frequency = growth(rpm, corrections)
    title = f"{rpm:,.0f} r/min, after {1e3 * found['seconds']:.2f} ms"
    show(title, ["quantity", "value"], list(zip(COLUMNS, cells(found), strict=True)))
    if found["ended"]:
        print(f"The run ended: {found['ended']}.")
    print(
        f"About the corrected steady state something grows by {rate:,.0f} 1/s at {frequency:,.0f} Hz."
        if rate
        else "About the corrected steady state nothing grows."
    )


if __name__ == "__main__":
    main()
