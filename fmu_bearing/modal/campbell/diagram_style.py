"""What a Campbell diagram shows, and how: colours, widths and dashes of branches, lines, sizes of dots."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import PchipInterpolator

from fmu_bearing.acoustics.radiation.frequencies import BAND
from fmu_bearing.modal.campbell.diagram import Branch, Crossing, Diagram
from fmu_bearing.modal.campbell.excitation_lines import Line
from fmu_bearing.modal.modes.energies import BACKWARD, FORWARD, NEITHER
from fmu_bearing.modal.modes.mode import MARGIN

#: By what moves. Hues distinguish bodies for all kinds of colour vision (Okabe and Ito 2008), depths motions.
COLOURS = {
    "inner axial": "#56B4E9", "inner radial": "#0072B2", "inner tilt": "#1F3B8C",
    "outer axial": "#E69F00", "outer radial": "#D55E00", "outer tilt": "#8C2D04", "outer spin": "#B8860B",
    "inner flexure": "#00806B", "outer flexure": "#009E73", "ball": "#CC79A7",
    "shaft axial": "#56B4E9", "shaft radial": "#0072B2", "shaft tilt": "#1F3B8C", "shaft bending": "#00806B",
    "housing axial": "#E69F00", "housing radial": "#D55E00", "housing tilt": "#8C2D04",
    "housing spin": "#B8860B", "sliding rings": "#B8860B",
}  # fmt: skip
UNSTABLE = "#FF3B1F"
DASHES = {FORWARD: "solid", BACKWARD: "dash", NEITHER: "dot"}
SHORT = {FORWARD: "fw", BACKWARD: "bw", NEITHER: ""}
#: Damping ratios that part the widths, and the widths (pt), the weakest first.
LIMITS = (MARGIN, 0.01, 0.03, 0.1)
WIDTHS = (0.8, 1.1, 1.7, 2.4, 3.2)
WIDTH_WORDS = ("below 0.2 %", "below 1 %", "1 to 3 %", "3 to 10 %", "above 10 %")

ALIKE = 0.03  # of the height: branches of one name that end closer share a name
_FINE = 12  # points from one speed to the next
_ROOM = 1.12  # of the highest frequency that is shown
_SHARPEST = 120.0  # Q beyond which a dot grows no further
_PLAIN = 2  # multiples of a passing frequency that are shown where no surface says which count


class Content(NamedTuple):
    """What a diagram shows beside its branches."""

    speeds: NDArray[np.float64]  # r/min, rising
    highest: float  # Hz: upper end
    lines: list[tuple[Line, NDArray[np.float64], float]]  # each with Hz at the speeds, and how dark: 0 to 1
    crossings: list[Crossing]  # the largest Q first, so that small dots stay visible on large ones
    near: Crossing | None  # to the operating speed
    operation: float | None  # r/min, where the speeds hold it
    words: tuple[str, str]  # of the operating speed, and how far the nearest crossing is from it


class Run(NamedTuple):
    """A piece of a branch between two limits of damping."""

    weak: int  # place in WIDTHS
    rpm: NDArray[np.float64]
    frequency: NDArray[np.float64]


class End(NamedTuple):
    """What reaches the right edge: a branch or a line; Hz, name, direction, colour."""

    frequency: float
    name: str
    way: str
    tint: str


def content(campbell: Diagram) -> Content:
    """Return what a diagram shows; the strongest lines come first."""
    crossings, order = counted(campbell), np.argsort(np.abs(campbell.rpm))
    speeds, own = np.abs(campbell.rpm)[order], abs(campbell.scene.operation.speed_rpm)
    lines = drawn_lines(crossings).values()
    largest = max((velocity for _, velocity in lines), default=0.0)
    return Content(
        speeds, top(campbell, crossings),
        [(line, line.frequency[order], strength(velocity, largest)) for line, velocity in lines],
        sorted(crossings, key=lambda one: -one.quality), campbell.nearest(),
        own if speeds[0] <= own <= speeds[-1] else None,
        (f"operation, {own:,.0f} r/min", margin_words(campbell)),
    )  # fmt: skip


def colour(name: str) -> str:
    """Colour of a mode by its name: ``inner tilt``, ``outer flexure n = 2``, ``ball n = 3``."""
    return (
        COLOURS["ball"]
        if name.startswith("ball")
        else COLOURS[name.partition(" n = ")[0].partition(" of ")[0]]
    )


def width_class(damping: ArrayLike) -> NDArray[np.intp]:
    """Place in ``WIDTHS`` of each damping ratio."""
    return np.asarray(np.searchsorted(LIMITS, damping, side="right"))


def dot_area(quality: float) -> float:
    """Area (pt2) of the dot of a crossing by its Q."""
    return 10.0 + 1.6 * min(quality, _SHARPEST)


def runs(branch: Branch) -> Iterator[Run]:
    """Yield the pieces of a branch in each of which the width stays, on curves through the speeds."""
    # interpolation wants rising speeds
    order = np.argsort(np.abs(branch.rpm))
    rpm = np.abs(branch.rpm)[order]
    places = np.interp(np.arange(_FINE * (rpm.size - 1) + 1) / _FINE, np.arange(rpm.size), rpm)
    frequency = PchipInterpolator(rpm, branch.frequency[order])(places)
    classes = width_class(PchipInterpolator(rpm, branch.damping[order])(places))
    ends = np.flatnonzero(np.diff(classes)) + 1
    for first, last in zip([0, *ends], [*ends, places.size - 1], strict=True):
        # the piece goes on to where the next begins
        part = slice(first, last + 1)
        if last > first:
            yield Run(int(classes[first]), places[part], frequency[part])


def counted(campbell: Diagram) -> list[Crossing]:
    """Return the crossings that are drawn.

    Those that the scene contains, within 20 dB of the largest. A scene without imperfections contains none:
    the lowest multiples then.
    """
    if campbell.scene.imperfections is not None:
        return campbell.crossings(in_scene=True)
    return [crossing for crossing in campbell.crossings() if _is_low(crossing.line)]


def _is_low(line: Line) -> bool:
    if line.source == "ball form":
        return line.surface_order <= 2
    return line.surface_order <= _PLAIN * line.balls + line.order


def drawn_lines(crossings: list[Crossing]) -> "dict[str, tuple[Line, float]]":
    """Return the lines of crossings by name, each with its largest velocity (m/s), the largest first."""
    drawn: dict[str, tuple[Line, float]] = {}
    for crossing in crossings:
        name = crossing.line.name
        before = drawn.get(name, (crossing.line, 0.0))
        drawn[name] = (before[0], max(before[1], crossing.velocity))
    return dict(sorted(drawn.items(), key=lambda item: -item[1][1]))


def top(campbell: Diagram, crossings: list[Crossing]) -> float:
    """Hz: upper end of the diagram, above what is excited; all branches where nothing is."""
    heights = [crossing.frequency for crossing in crossings] or [
        float(branch.frequency.max()) for branch in campbell.branches
    ]
    return min(_ROOM * max(heights, default=campbell.highest), campbell.highest)


def unstable(branch: Branch) -> "NDArray[np.bool_]":
    """Speeds of a branch near or beyond the limit of stability."""
    return np.asarray(branch.damping < MARGIN)


def level_band(campbell: Diagram) -> tuple[float, float] | None:
    """Hz: the band of the scene's levels; None for a scene without sound."""
    return None if campbell.scene.sound is None else BAND


def spaced(wanted: NDArray[np.float64], least: float, low: float, high: float) -> NDArray[np.float64]:
    """Return places nearest to the wanted ones, in rising order, ``least`` or more apart.

    Pool adjacent violators (Barlow et al. 1972): neighbours too close share the mean of what they want.
    """
    steps = least * np.arange(wanted.size)
    pools: list[list[float]] = []
    for value in wanted - steps:
        pools.append([float(value)])
        while len(pools) > 1 and np.mean(pools[-2]) >= np.mean(pools[-1]):
            last = pools.pop()
            pools[-1] += last
    flat = np.array([np.mean(pool) for pool in pools for _ in pool])
    return np.asarray(np.clip(flat, low, max(low, high - least * (wanted.size - 1))) + steps)


def last_of(branch: Branch) -> int:
    """Return the place of the largest speed of a branch."""
    return int(np.argmax(np.abs(branch.rpm)))


def end_of(branch: Branch) -> End:
    """Return where a branch ends."""
    frequency = float(branch.frequency[last_of(branch)])
    return End(frequency, branch.name, branch.direction, colour(branch.name))


def names_beside(
    ends: Sequence[End], highest: float, height: float, least: float
) -> Iterator[tuple[float, str, list[End]]]:
    """Yield where a name is beside the axes (Hz), its words, and the ends that share it.

    Both directions of a mode share a name where they end close together. Names are in the order of the ends,
    and ``least`` apart, in the unit of the axes' ``height``, which ends at ``highest`` (Hz).
    """
    groups: list[list[End]] = []
    for end in sorted(ends):
        own = (
            g for g in groups if g[0].name == end.name and end.frequency - g[0].frequency < ALIKE * highest
        )
        group = next(own, None)
        if group is None:
            groups.append([end])
        else:
            group.append(end)
    middles = [float(np.mean([end.frequency for end in group])) for group in groups]
    order = np.argsort(middles, kind="stable")
    places = spaced(np.array(middles)[order] * height / highest, least, 0.0, height) * highest / height
    for k, place in zip(order, places, strict=True):
        ways = " + ".join(sorted({SHORT[end.way] for end in groups[k] if end.way}, reverse=True))
        yield float(place), f"{groups[k][0].name} {ways}".rstrip(), groups[k]


def strength(velocity: float, largest: float) -> float:
    """Return how dark a line is drawn: 1 for the largest velocity, 0 for 20 dB less."""
    return float(np.clip(1.0 + np.log10(max(velocity, 1e-30) / largest), 0.0, 1.0)) if largest > 0.0 else 0.0


def margin_words(campbell: Diagram) -> str:
    """Return how far the nearest crossing is from the operating speed; empty where there is none."""
    near, own = campbell.nearest(), abs(campbell.scene.operation.speed_rpm)
    if near is None:
        return ""
    share = 100.0 * (abs(near.rpm) / own - 1.0)
    return (
        f"{share:+.1f} % to {near.line.name} with {near.branch.name} {SHORT[near.branch.direction]}".rstrip()
    )


def quality_words(quality: float) -> str:
    """Q in words."""
    return f"{quality:.0f}" if math.isfinite(quality) else "infinite"
