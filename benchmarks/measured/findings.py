"""What each source says of the package: goals, what was found, misses first."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from benchmarks.measured import friction, stiffness
from benchmarks.measured.compared import Compared


@dataclass(frozen=True)
class Finding:
    """What a source says of the package: the goal, what was found, and ``missed``, ``met`` or ``beside``.

    ``beside``: there is nothing to miss, because the source has no such bearing or no such condition.
    """

    source: str
    what: str
    count: int
    goal: str
    found: str
    status: str


def _within(good: bool) -> str:
    return "met" if good else "missed"


def rms(values: np.ndarray) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(np.square(values))))


def span(values: Iterable[float], digits: int = 2) -> str:
    """Return the least and the largest value in words."""
    every = list(values)
    return f"{min(every):.{digits}f} to {max(every):.{digits}f}"


def _of_defects(rows: Callable[..., list[Compared]]) -> Iterator[Finding]:
    """Yield what records of defects say; goals were set before the comparison was made."""
    goals = (
        ("cwru_pits", "side bands", "side bands over line, pits of an inner race", 2.0),
        ("cwru_pits", "line of", "line at 3 and 12 over 6 o'clock, pits of an outer race", 4.0),
        ("mfpt", "line of", "line of the inner race over shaft", 1.005),
        ("mfpt", "side bands", "side bands over line of the inner race", 1.5),
        ("mfpt", "rms", "growth of the rms with the load, outer race", 1.5),
        ("mfpt", "kurtosis", "growth of the kurtosis with the load, outer race", 2.0),
    )
    for source, quantity, what, factor in goals:
        ratios = np.array([one.found for one in rows(source, quantity)])
        inside = np.abs(np.log(ratios)) <= np.log(factor)
        goal = "within 0.5 %" if factor < 1.1 else f"within a factor of {factor:g}"
        digits = 4 if factor < 1.1 else 2
        found = f"{inside.sum()} within, {span(ratios, digits)}"
        yield Finding(source, what, ratios.size, goal, found, _within(bool(inside.all())))


def findings(found: Mapping[str, list[Compared]]) -> list[Finding]:
    """Return what each source says, misses first."""

    def rows(source: str, quantity: str = "") -> list[Compared]:
        return [one for one in found[source] if one.counts and one.value.quantity.startswith(quantity)]

    def beside(source: str, quantity: str = "") -> np.ndarray:
        return np.array([one.found for one in rows(source, quantity)])

    old = stiffness.ratios("nsk", (0.52, 0.53))
    even = stiffness.ratios("tpi", stiffness.SYMMETRIC)
    closed = stiffness.offsets(stiffness.SYMMETRIC)
    ceramic = rows("tpi", "stiffness with")
    printed, ours = (np.array([getattr(one, key) for one in ceramic]) for key in ("theirs", "ours"))
    classes, lifts = beside("ibc", "radial"), beside("ibc", "lift-off")
    torque, heat = beside("skf"), beside("tp2275")
    inside = int(((torque > 0.8) & (torque < 1.25)).sum())
    light = np.array([one.ours for one in rows("asme")])
    (coefficient,) = rows("ntn")
    cage, slip, limit = beside("cwru") - 1.0, beside("paderborn"), rows("kyk")
    grows = [friction.exponent([one.value.speed_rpm for one in rows("tp2275")], heats) for heats in (
        [one.ours for one in rows("tp2275")], [one.theirs for one in rows("tp2275")])]  # fmt: skip
    every = [
        Finding("nsk", "stiffness of pairs, 0.52 and 0.53", len(old), "median within 5 %",
                f"median {np.median(old):.3f}, rms {100 * rms(old - 1):.1f} %",
                _within(abs(np.median(old) - 1.0) < 0.05)),
        Finding("tpi", "stiffness of pairs, 0.522 for both races", len(even), "rms below 1.5 %",
                f"median {np.median(even):.3f}, rms {100 * rms(even - 1):.1f} %",
                _within(rms(even - 1) < 0.015)),
        Finding("tpi", "offset of the faces, 0.522 for both races", len(closed), "rms below 0.4 um",
                f"rms {rms(closed):.2f} um, printed to 1 um (0.29)",
                _within(rms(closed) < 0.4)),
        Finding("tpi", "stiffness with ceramic over steel balls", len(ours), "1.096 within 0.015",
                f"{ours.mean():.4f} against {printed.mean():.3f} +- {printed.std():.3f}",
                _within(abs(ours.mean() - 1.096) < 0.015)),
        Finding("ibc", "radial over axial stiffness", len(classes), "within 10 %", span(classes),
                _within(bool(np.all(abs(classes - 1.0) < 0.1)))),
        Finding("ibc", "lift-off load over preload", len(lifts), "within 10 %", span(lifts),
                _within(bool(np.all(abs(lifts - 1.0) < 0.1)))),
        Finding("skf", "torque of rolling and sliding, 7210B", len(torque),
                "24 within 0.8 to 1.25, median 0.85 to 1.05",
                f"{inside} within, median {np.median(torque):.2f}, {span(torque)}",
                _within(inside >= 24 and 0.85 <= np.median(torque) <= 1.05)),
        Finding("tp2275", "heat, 35 mm", len(heat), "0.78 to 1.22 at all speeds",
                f"{', '.join(f'{one:.2f}' for one in heat)}; exponent of the speed {grows[0]:.2f} against "
                f"{grows[1]:.2f}", _within(bool(np.all((heat > 0.78) & (heat < 1.22))))),
        Finding("asme", "heat of hybrid over steel, 35 mm", len(light), "0.82 to 0.92 at all speeds",
                f"{', '.join(f'{one:.2f}' for one in light)} against 0.80 to 0.90",
                _within(bool(np.all((light > 0.82) & (light < 0.92))))),
        Finding("ntn", "friction coefficient", 1, "within 1.2 to 1.8e-3",
                f"median {coefficient.ours:.1f}e-3, {coefficient.low:.1f} to {coefficient.high:.1f}e-3",
                _within(1.2 <= coefficient.low and coefficient.high <= 1.8)),
        Finding("cwru", "cage over shaft speed", len(cage), "within 0.5 %",
                f"{100 * cage.min():+.2f} to {100 * cage.max():+.2f} %",
                _within(bool(np.all(abs(cage) < 5e-3)))),
        *_of_defects(rows),
        Finding("paderborn", "slip of the cage", len(slip), "within 0.5 %",
                f"{slip.min():+.2f} to {slip.max():+.2f} %", _within(bool(np.all(abs(slip) < 0.5)))),
        Finding("kyk", "vibration in three bands, steel 7003C P4 beside limit V3", len(limit),
                "none: limits of deep groove bearings",
                ", ".join(f"{one.found:.2f}" for one in limit), "beside"),
        Finding("tnd7870", "largest skid of the cage, 120 mm", 1, "none: the condition is not known",
                "6 %; not computed", "beside"),
    ]  # fmt: skip
    return sorted(every, key=lambda one: ("missed", "beside", "met").index(one.status))
