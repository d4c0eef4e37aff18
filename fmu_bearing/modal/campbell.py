"""Campbell diagram: natural frequencies over speed, what excites them, and the speeds where both meet."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.optimize import linear_sum_assignment

from fmu_bearing.engine.constants import RPM
from fmu_bearing.modal.conditions import given
from fmu_bearing.modal.lines import Line, Rates, lines, rates, unbalance
from fmu_bearing.modal.modes import MARGIN, MOVES, Mode, Modes, self_excited
from fmu_bearing.modal.picture import campbell_picture
from fmu_bearing.modal.points import at_point
from fmu_bearing.modal.remarks import UNSTEADY
from fmu_bearing.modal.set_linearised import need_shaft
from fmu_bearing.modal.shapes import NEITHER
from fmu_bearing.progress import Tell, silent
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.member import one_of
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGHEST = 20e3  # Hz
WITHIN = 20.0  # dB below the largest: crossings that count
_SAME = 0.5  # modal assurance criterion from which a mode is the one of the speed before
_FEWEST = 3  # speeds that make a curve
_SHARES = tuple(0.1 * tenths for tenths in range(1, 15))  # of the scene's own speed
_SPIN = "spin"  # waves press along the contacts' normals, which have no lever about the axis


@dataclass(frozen=True)
class Branch:
    """One mode over speed, followed by its shape.

    Attributes
    ----------
    name, direction : str
        Of the mode at the middle of its speeds.
    order : int
    rpm, frequency, damping : ndarray
        r/min, Hz and damping ratio where the mode was found.
    modes : tuple of Mode
    """

    name: str
    direction: str
    order: int
    rpm: NDArray[np.float64]
    frequency: NDArray[np.float64]
    damping: NDArray[np.float64]
    modes: tuple[Mode, ...]

    @property
    def label(self) -> str:
        """Name with direction."""
        return f"{self.name} {self.direction}".rstrip()


@dataclass(frozen=True)
class Crossing:
    """A speed at which an excitation has the frequency of a mode that it can move.

    Attributes
    ----------
    rpm, frequency, damping : float
        r/min, Hz, damping ratio.
    branch : Branch
    line : Line
    velocity : float
        m/s: amplitude of the surface times angular frequency times Q, an estimate that ranks crossings; 0
        where the scene does not contain the line.
    """

    rpm: float
    frequency: float
    damping: float
    branch: Branch
    line: Line
    velocity: float

    @property
    def quality(self) -> float:
        """Q, 1/(2 zeta)."""
        return 0.5 / self.damping if self.damping > 0.0 else math.inf

    def as_dict(self) -> dict[str, Any]:
        """Numbers and names, for tables."""
        return {
            "speed_rpm": self.rpm, "frequency_Hz": self.frequency, "damping_ratio": self.damping,
            "mode": self.branch.name, "direction": self.branch.direction, "line": self.line.name,
            "source": self.line.source, "surface_order": self.line.surface_order,
            "in_scene": self.line.present, "velocity_um_s": 1e6 * self.velocity,
        }  # fmt: skip


@dataclass(frozen=True)
class Campbell:
    """Branches, lines and crossings over speed.

    Attributes
    ----------
    scene : Scene
    points : tuple of Modes
        One per speed, in order.
    branches : tuple of Branch
        Modes in which rings move, up to ``highest``.
    lines : tuple of Line
        Excitations of their orders.
    rates : Rates
        Kinematic frequencies by the states, not by the nominal contact angle.
    highest : float
        Hz: what lies above is left out.
    skipped : tuple of (float, str)
        Speeds (r/min) without equilibrium, and why.

    Examples
    --------
    >>> from fmu_bearing import campbell
    >>> found = campbell("examples/scenes/7003C-spindle.toml", [5e3, 10e3, 15e3, 20e3, 25e3])
    >>> len(found.points), found.crossings()[0].branch.name
    (5, 'inner tilt')
    """

    scene: Scene
    points: tuple[Modes, ...]
    branches: tuple[Branch, ...]
    lines: tuple[Line, ...]
    rates: Rates
    highest: float
    skipped: tuple[tuple[float, str], ...] = ()

    @property
    def rpm(self) -> NDArray[np.float64]:
        """Speeds (r/min) in order."""
        return np.array([point.rpm for point in self.points])

    def crossings(self, in_scene: bool = False) -> list[Crossing]:
        """Return the crossings by speed.

        Parameters
        ----------
        in_scene : bool
            Those only that the scene contains and that come within 20 dB of the largest.
        """
        found = self._all_crossings
        if in_scene:
            largest = max((crossing.velocity for crossing in found), default=0.0)
            return [one for one in found if one.velocity > largest * 10.0 ** (-WITHIN / 20.0)]
        return list(found)

    @cached_property
    def _all_crossings(self) -> list[Crossing]:
        found = [
            crossing
            for branch in self.branches
            for line in self.lines
            if can_move(line, branch)
            for crossing in _meet(branch, line, self.rpm)
        ]
        return sorted(found, key=lambda crossing: crossing.rpm)

    def nearest(self) -> Crossing | None:
        """Return the crossing of the scene nearest to its operating speed, by ratio; None: there is none."""
        own = abs(self.scene.operation.speed_rpm)
        found = self.crossings(in_scene=True)
        if not found or own == 0.0:
            return None
        return min(found, key=lambda crossing: abs(math.log(abs(crossing.rpm) / own)))

    def verdict(self) -> str:
        """Return the nearest crossing of the scene in a sentence."""
        near, own = self.nearest(), abs(self.scene.operation.speed_rpm)
        if near is None:
            low, high = np.abs(self.rpm[[0, -1]])
            return (
                f"No line that the scene contains meets a mode between {low:,.0f} and {high:,.0f} r/min "
                f"below {1e-3 * self.highest:g} kHz."
            )
        share = abs(near.rpm) / own - 1.0
        side = "above" if share >= 0.0 else "below"
        return (
            f"Nearest: {near.line.name} ({near.line.source}) with {near.branch.label}, "
            f"{abs(near.rpm):,.0f} r/min, {100.0 * abs(share):.1f} % {side} operation, damping ratio "
            f"{100.0 * near.damping:.2g} %."
        )

    def cautions(self) -> list[str]:
        """Return weak damping over the speeds, and speeds that could not be computed, in sentences."""
        found = []
        for branch in self.branches:
            least = int(np.argmin(branch.damping))
            if branch.damping[least] < MARGIN:
                word = "grows by itself" if branch.damping[least] < 0.0 else "is hardly damped"
                found.append(
                    f"instability margin: '{branch.label}' {word} at {branch.rpm[least]:,.0f} r/min "
                    f"({branch.frequency[least]:.0f} Hz, damping ratio {branch.damping[least]:.4f})"
                )
        found += self._unseen()
        found += [
            f"{point.rpm:,.0f} r/min: {UNSTEADY}" for point in self.points if not point.linearised.steady
        ]
        return found + [f"{rpm:,.0f} r/min is left out: {why}" for rpm, why in self.skipped]

    def _unseen(self) -> list[str]:
        """Return the fastest whirl that no branch shows, because balls have most of its energy."""
        grown = [(point.rpm, self_excited(point)) for point in self.points if point.linearised.steady]
        rings = [(rpm, mode) for rpm, mode in grown if mode is not None and not is_of_rings(mode)]
        if not rings:
            return []
        rpm, mode = max(rings, key=lambda one: one[1].growth)
        body = "ring" if self.points[0].scene.spindle is None else "set"
        return [
            f"instability: the {body} whirls by itself at {rpm:,.0f} r/min ({mode.frequency:.0f} Hz, growth "
            f"{mode.growth:.0f} 1/s); balls have most of its energy, and no branch shows it"
        ]

    def picture(self) -> "Figure":
        """Draw the Campbell diagram as a Matplotlib figure; needs the extra ``plots``.

        Branches are coloured by what moves; width tells damping (thin: weak), dashes the direction. Lines are
        those that meet a mode; dots are crossings, sized by Q; a bar marks the operating speed.
        """
        return campbell_picture(self)

    def table(self) -> list[dict[str, Any]]:
        """Return a row per branch and speed: what `campbell.csv` holds."""
        return [
            {
                "speed_rpm": float(rpm), "frequency_Hz": float(frequency), "damping_ratio": float(damping),
                "mode": branch.name, "direction": branch.direction, "order": branch.order,
            }
            for branch in self.branches
            for rpm, frequency, damping in zip(branch.rpm, branch.frequency, branch.damping, strict=True)
        ]  # fmt: skip


@one_thread
def campbell(
    scene: SceneSource,
    speeds: Sequence[float] | None = None,
    *,
    inputs: Mapping[str, float] | None = None,
    highest: float = HIGHEST,
    tell: Tell = silent,
    track: Callable[[Sequence[float]], Iterable[float]] | None = None,
) -> Campbell:
    """Return natural frequencies and excitations of a scene's bearing over speed.

    Parameters
    ----------
    scene : Scene or path
    speeds : sequence of float, optional
        r/min, at least three of one sign; default: 14 in steps of a tenth of the scene's own.
        Standstill is left out, because contacts stick there.
    inputs : mapping, optional
        Inputs of the model by name, SI units, as for `modes`; not ``shaft_speed``.
    highest : float, optional
        Hz: modes and lines above it are left out.
    tell : callable, optional
        Takes a line of text for a speed that has no equilibrium.
    track : callable, optional
        Wraps the speeds, to show progress.

    Raises
    ------
    ValueError
        For speeds or inputs that are refused, or where too few speeds have an equilibrium.

    Examples
    --------
    >>> from fmu_bearing import campbell
    >>> found = campbell("examples/scenes/7003C-spindle.toml", [5e3, 10e3, 15e3, 20e3, 25e3])
    >>> found.verdict().partition(",")[0]
    'Nearest: f_i - f_r (inner race) with inner radial backward'
    """
    scene = scene_of(scene)
    need_shaft(scene)
    chosen = _speeds(scene, speeds)
    if inputs and "shaft_speed" in inputs:
        raise ValueError("shaft_speed is not an input of a Campbell diagram: give speeds, in r/min")
    if not (math.isfinite(highest) and highest > 0.0):
        raise ValueError(f"highest = {highest} Hz is refused: give a positive number of hertz")
    points: list[Modes] = []
    skipped: list[tuple[float, str]] = []
    for rpm in track(chosen) if track else chosen:
        values = given(scene, dict(inputs or {}) | {"shaft_speed": rpm * RPM})
        try:
            points.append(at_point(scene, values))
        except ValueError as problem:
            skipped.append((rpm, str(problem)))
            tell(f"{rpm:,.0f} r/min is left out: {problem}")
    if len(points) < _FEWEST:
        raise ValueError(
            f"{scene.name}: only {len(points)} of {len(chosen)} speeds have an equilibrium; "
            + (skipped[0][1] if skipped else "give other speeds")
        )
    systems = [point.linearised for point in points]
    at = rates(
        np.array([one.speed for one in systems]), np.array([one.orbit for one in systems]),
        np.array([one.spin for one in systems]), scene.bearing.ball_count,
    )  # fmt: skip
    branches = _branches(points, highest)
    alone = scene if scene.spindle is None else one_of(scene)
    orders = {branch.order for branch in branches}
    found = lines(alone, at, orders, highest, unbalance(scene))
    return Campbell(scene, tuple(points), tuple(branches), tuple(found), at, highest, tuple(skipped))


def _speeds(scene: Scene, speeds: Sequence[float] | None) -> list[float]:
    if speeds is None:
        own = scene.operation.speed_rpm or 10_000.0
        return [own * share for share in _SHARES]
    try:
        numbers = sorted({float(value) for value in speeds if float(value) != 0.0}, key=abs)
    except (TypeError, ValueError):
        raise ValueError(f"speeds = {speeds!r} is refused: give numbers, in r/min") from None
    if len(numbers) < _FEWEST or min(numbers) * max(numbers) < 0.0:
        raise ValueError(
            f"speeds are refused: give at least {_FEWEST} different ones beside 0 in one direction, in r/min"
        )
    return numbers


def _branches(points: Sequence[Modes], highest: float) -> list[Branch]:
    """Follow modes from speed to speed by the likeness of their rates."""
    open_ones: list[list[tuple[Modes, Mode]]] = []
    done: list[list[tuple[Modes, Mode]]] = []
    for point in points:
        modes = [mode for mode in point.modes if mode.frequency <= 1.5 * highest and is_of_rings(mode)]
        pairs = _pairs([chain[-1][1] for chain in open_ones], modes, point)
        going = []
        for k, chain in enumerate(open_ones):
            if k in pairs:
                chain.append((point, modes[pairs[k]]))
                going.append(chain)
            else:
                done.append(chain)
        taken = set(pairs.values())
        open_ones = going + [[(point, mode)] for i, mode in enumerate(modes) if i not in taken]
    chains = [chain for chain in done + open_ones if len(chain) >= _FEWEST]
    found = [_branch(chain) for chain in chains]
    kept = [branch for branch in found if branch.frequency.min() <= highest]
    return sorted(kept, key=lambda branch: float(branch.frequency[branch.frequency.size // 2]))


def is_of_rings(mode: Mode) -> bool:
    """Whether rings move, not only the turning of the balls."""
    return mode.ring_share > MOVES and not mode.name.startswith(("ball spin", "ball orbit"))


def _pairs(before: list[Mode], now: list[Mode], point: Modes) -> dict[int, int]:
    if not before or not now:
        return {}
    alike = point.alike(before, now)
    rows, columns = linear_sum_assignment(-alike)
    return {int(i): int(k) for i, k in zip(rows, columns, strict=True) if alike[i, k] >= _SAME}


def _branch(chain: list[tuple[Modes, Mode]]) -> Branch:
    middle = chain[len(chain) // 2][1]
    return Branch(
        middle.name, middle.direction, middle.order, np.array([point.rpm for point, _ in chain]),
        np.array([mode.frequency for _, mode in chain]), np.array([mode.damping for _, mode in chain]),
        tuple(mode for _, mode in chain),
    )  # fmt: skip


def can_move(line: Line, branch: Branch | Mode) -> bool:
    """Whether order and direction agree; a mode without direction answers to both, turning to none."""
    agree = line.order == branch.order and branch.direction in (line.direction, NEITHER)
    return agree and _SPIN not in branch.name.split()


def _meet(branch: Branch, line: Line, rpm: NDArray[np.float64]) -> list[Crossing]:
    """Crossings of a branch and a line, on curves through the computed speeds."""
    # interpolation wants rising speeds
    order = np.argsort(branch.rpm)
    speeds = branch.rpm[order]
    by_speed = np.argsort(rpm)
    at_speeds = np.interp(speeds, rpm[by_speed], line.frequency[by_speed])
    # the curves have no extremes between the speeds, so without a change of sign there is no root
    if abs(np.sign(branch.frequency[order] - at_speeds).sum()) == speeds.size:
        return []
    excitation = PchipInterpolator(rpm[by_speed], line.frequency[by_speed])
    apart = PchipInterpolator(speeds, branch.frequency[order] - excitation(speeds))
    damping = PchipInterpolator(speeds, branch.damping[order])
    found = []
    for root in np.unique(apart.roots(extrapolate=False)):
        frequency, zeta = float(excitation(root)), float(damping(root))
        magnified = 0.5 / max(zeta, MARGIN)  # below it the size of the motion limits itself
        velocity = line.amplitude * 2.0 * math.pi * frequency * magnified
        found.append(Crossing(float(root), frequency, zeta, branch, line, velocity))
    return found
