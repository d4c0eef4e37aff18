"""Eqs. 1 to 3 of the sound-field paper: as printed, corrected, and beside the product.

They are the multi-source paper's in another notation (x, y across the bearing, z along it), without its
eq. 5: the outer ring is fixed. Some rows are right here that are wrong there, and some the other way round,
so that :class:`FieldEquations` changes these alone. The azimuth is read in the paper's favour: a ball lies at
(-sin phi, cos phi), which makes eq. 2's force rows and tilt rows and four of eq. 3's five rows right.
"""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from examples.papers.case import Changes
from examples.papers.printed_equations import Corrections, Equations
from examples.papers.printed_forces import INNER, OM, Array, Contact, Pose, R
from examples.papers.printed_motion import COLUMNS, READINGS, apart, cells
from examples.papers.printed_runs import (
    TURNS,
    Printed,
    all_round,
    equations,
    growth,
    of_run,
    ours,
    reading,
    run,
    settled,
)
from fmu_bearing.results.table import markdown

SCENE = "7009C-full-ceramic"
#: What holds the bare bearing, both assumed. Without it the inner ring whirls by itself, ceramic from 18,000
#: r/min on, steel from 15,000. The far bearing of the spindle is as in its scene; a seat that holds the outer
#: ring axially all round has R^2 / 2 = 700 mm2 of rotational over radial stiffness.
HELD: Changes = (
    ("mounting.tilt_support.stiffness_N_m_rad", 1e5),
    ("mounting.tilt_support.damping_ratio", 0.05),
    ("mounting.pedestal_rotational_ratio_mm2", 700.0),
)
SPEEDS = (3000, 9000, 18000)
ALONE = 18000  # r/min: where each correction is left out alone
#: Faults of the multi-source paper's equations that these have not, or that belong to its eq. 5.
RIGHT = (
    "traction_moments", "pocket_moments", "cage_tilt", "inner_tilt", "pedestal_sign", "pedestal_damping",
)  # fmt: skip
_OUTER = slice(5, 11)  # rows of the outer ring among the bodies' coordinates


@dataclass(frozen=True)
class FieldCorrections(Corrections):
    """One switch per fault of eqs. 1 to 3, beside those that `Corrections` has.

    Attributes
    ----------
    inner_side : bool
        Eq. 3, row x: signs of Q and T_eta, which otherwise push the ring the way it moves.
    drag_sign : bool
        Eq. 1: the drag F_w is taken off, not added.
    outer_free : bool
        The outer ring has equations of motion, eq. 5 of the multi-source paper, and is not fixed.
    """

    inner_side: bool = True
    drag_sign: bool = True
    outer_free: bool = True

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """All faults of these equations."""
        return tuple(name for name in super().names() if name not in RIGHT)


class FieldEquations(Equations):
    """Eqs. 1 to 3 of the sound-field paper at one shaft speed."""

    on: FieldCorrections

    def ball_rows(self, balls: Array, angle: Array, force: Array, moment: Array) -> Array:
        """Eq. 1."""
        found = super().ball_rows(balls, angle, force, moment)
        b = self.bearing
        if b.drag and not self.on.drag_sign:
            radius = b.pitch_radius + balls[R]
            around = radius * balls[OM]
            found[2] += 2.0 * b.drag_factor * around * np.abs(around) / (b.ball_mass * radius)
        return found

    def on_rings(self, angle: Array, contact: Contact, seen: Pose) -> Array:
        """Eq. 3, and eq. 5 of the multi-source paper."""
        found = super().on_rings(angle, contact, seen)
        if not self.on.inner_side and not self.even:
            found[1, INNER] -= 2.0 * (np.sin(angle) * contact.force[1, INNER]).sum(axis=0)
        return found

    def on_cage(self, angle: Array, pose: Pose, force: Array, moment: Array) -> Array:
        """Eq. 2: printed, Q_cx turns the cage with the wrong sign: x Q_cy + y Q_cx, not x Q_cy - y Q_cx."""
        found = super().on_cage(angle, pose, force, moment)
        if not self.on.cage_rotation:
            c, s = np.cos(angle), np.sin(angle)
            pushed = self.bearing.pitch_radius * (2.0 * s * c * force[1] + (c * c - s * s) * force[2])
            rubbed = -self.count / self.balls * (moment * pose.n).sum(axis=0).sum(axis=0)
            found[3] = rubbed + (0.0 if self.even else pushed.sum(axis=0))
        return found

    def body_rows(self, places: Array, speeds: Array, inner: Array, outer: Array, cage: Array) -> Array:
        """Eqs. 2 and 3; the outer ring stays where it is unless it has equations."""
        found = super().body_rows(places, speeds, inner, outer, cage)
        if not self.on.outer_free:
            found[_OUTER] = 0.0
        return found


PAPER = Printed(SCENE, FieldEquations, FieldCorrections, HELD)
#: Without which nothing runs on.
REPAIRED = ("cage_rotation", "inner_side")
EQUATIONS = {
    "gyroscopic_pair": "1", "single_inertia": "1", "contact_couples": "1", "orbit_terms": "1",
    "cage_rotation": "2", "land_reaction": "2, 3", "fixed_axes": "2, 3", "contact_radii": "3",
    "traction_law": "1", "inner_side": "3", "drag_sign": "1", "outer_free": "none",
}  # fmt: skip


def alone(name: str, turns: float = TURNS) -> dict[str, Any]:
    """Figures of the corrected equations without one correction, and what grows."""
    corrections = FieldCorrections.all().changed(off=(name,))
    system = equations(ALONE, corrections, even=name != "inner_side", paper=PAPER)
    state = settled(ALONE, PAPER).state
    begin = state if system.even else all_round(system, state)
    found = of_run(system, run(system, begin, turns * 60.0 / ALONE))
    rate, frequency = growth(ALONE, corrections, PAPER)
    return found | {"growth": rate, "frequency": frequency}


def results(
    speeds: Sequence[int] = SPEEDS, names: Sequence[str] = FieldCorrections.names(), turns: float = TURNS
) -> dict[str, Any]:
    """All figures of the page: plain numbers, texts, lists and dictionaries, the same in every run."""
    running = FieldCorrections.none().changed(on=REPAIRED)
    by_speed = {
        str(rpm): {
            "printed": reading(rpm, FieldCorrections.none(), turns, PAPER),
            "running": reading(rpm, running, turns, PAPER),
            "carried": reading(rpm, running.changed(on=("traction_law",)), turns, PAPER),
            "corrected": of_run(equations(rpm, FieldCorrections.all(), paper=PAPER), settled(rpm, PAPER)),
            "ours": ours(rpm, PAPER),
        }
        for rpm in speeds
    }
    rate, frequency = growth(ALONE, FieldCorrections.all(), PAPER)
    own = {"growth": rate, "frequency": frequency}
    return {
        "turns": turns, "speeds": by_speed, "own": own, "alone": {name: alone(name, turns) for name in names}
    }  # fmt: skip


def _end(one: dict[str, Any]) -> str:
    return f"{one['ended']} after {1e3 * one['seconds']:.2f} ms" if one["ended"] else ""


def page_of(found: dict[str, Any]) -> str:
    """Return the page: the finding, then both tables; ``found`` is what :func:`results` returned."""
    titles = {"printed": "printed"} | READINGS
    over_speed = [
        [f"{int(rpm):,}", titles[key],
         *([""] * len(COLUMNS) if of_speed[key]["ended"] else cells(of_speed[key])), _end(of_speed[key])]
        for rpm, of_speed in found["speeds"].items()
        for key in titles
    ]  # fmt: skip
    single = []
    for name, one in found["alone"].items():
        more = one["growth"] > 2.0 * found["own"]["growth"] + 1.0
        grows = f"{one['growth']:,.0f} at {one['frequency']:,.0f} Hz" if more else ""
        numbers = [""] * 4 if one["ended"] else [
            "{:.2f}, {:.2f}".format(*one["load"]), "{:.2f}, {:.2f}".format(*one["angle"]),
            f"{one['orbit']:.4f}, {one['cage']:.4f}", f"{one['spin']:,.0f} at {one['pitch']:.1f}",
        ]  # fmt: skip
        single.append([f"`{name}`", EQUATIONS[name], *numbers, grows, _end(one)])
    heads = [
        "left out alone", "eq.", "Q_i, Q_o, N", "alpha_i, alpha_o, deg", "orbit, cage", "spin, rad/s at deg",
        "grows, 1/s", "and",
    ]  # fmt: skip
    load, angle, orbit = apart(found, "corrected", "ours")
    return (
        "# Equations 1 to 3 of the sound-field paper, run as printed\n\n"
        "Written by `python -m examples.papers.run sound-field` (`make papers`); figures are of that run.\n"
        "What is wrong in them and why is on the page of the [printed equations](../printed-equations.md).\n"
        "Those of the multi-source paper have [their own page](printed-motion.md).\n\n"
        f"## Verdict\n\n{_finding(found, load, angle, 100.0 * orbit)}\n\n## Over speed\n\n"
        f"{markdown(['r/min', 'equations', *COLUMNS, 'and'], over_speed)}\n"
        f"## Each correction left out\n\n{_single(found)}\n\n{markdown(heads, single)}"
    )


def _filled(text: str) -> str:
    return textwrap.fill(" ".join(text.split()), 110)


def _single(found: dict[str, Any]) -> str:
    own = found["own"]
    return _filled(
        f"""At {ALONE:,} r/min, for {found["turns"]:.0f} turns from the corrected steady state. Growth is
        about that state, of 17 balls with all rows. With all corrections {own["growth"]:.0f} 1/s at
        {own["frequency"]:.0f} Hz remain; a cell is empty where no correction more than doubles it."""
    )


def _finding(found: dict[str, Any], load: float, angle: float, orbit: float) -> str:
    fast = found["speeds"][max(found["speeds"], key=int)]
    off = max(abs(a - b) for a, b in zip(fast["carried"]["load"], fast["corrected"]["load"], strict=True))
    printed, right = fast["printed"], fast["corrected"]
    side = found["alone"].get("inner_side", {"growth": float("nan")})
    return _filled(
        f"""As printed, even balls run on, at {max(found["speeds"], key=int)} r/min with the orbit at
        {printed["orbit"]:.3f} and the cage at {printed["cage"]:.3f} of shaft speed, not {right["orbit"]:.3f}:
        in the rotation row of eq. 2 the sign of Q_cx is wrong, so that normal pocket forces do not turn the
        cage on average and its lands drive it alone. In row x of eq. 3 the loads push the inner ring the way
        it moves: once aside, it leaves by {side["growth"]:,.0f} 1/s. With both signs repaired balls gain
        spin, as in the multi-source paper. With the traction repaired too, balls roll, and loads are up to
        {off:.1f} N off, because the centrifugal force is missing. With all corrections the plain equations
        give the product's motion: loads within {load:.2f} N, angles within {angle:.3f} deg, orbit within
        {orbit:.3f} %. The outer ring is fixed and has no equation, so that it could not sound; in ours it
        is the loudest part."""
    )
