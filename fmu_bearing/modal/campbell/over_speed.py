"""Campbell diagram: natural frequencies over speed, what excites them, and the speeds where both meet."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import linear_sum_assignment

from fmu_bearing.engine.constants import RPM
from fmu_bearing.modal.campbell.diagram import Branch, Diagram, is_of_rings
from fmu_bearing.modal.campbell.diagram_picture import campbell_picture
from fmu_bearing.modal.campbell.excitation_lines import (
    Line,
    Rates,
    kinds,
    lines,
    lines_of_defects,
    rates,
    unbalance,
)
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.modal.modes.points import at_point, given
from fmu_bearing.progress import Tell, silent
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGHEST = 20e3  # Hz
_SAME = 0.5  # modal assurance criterion from which a mode is the one of the speed before
_FEWEST = 3  # speeds that make a curve
_SHARES = tuple(0.1 * tenths for tenths in range(1, 15))  # of the scene's own speed


class Campbell(Diagram):
    """Branches, lines and crossings over speed.

    Examples
    --------
    >>> from fmu_bearing import campbell
    >>> found = campbell("examples/scenes/7003C-spindle.toml", [5e3, 10e3, 15e3, 20e3, 25e3])
    >>> len(found.points), found.crossings()[0].branch.name
    (5, 'inner tilt')
    """

    def picture(self) -> "Figure":
        """Draw the Campbell diagram as a Matplotlib figure; needs the extra ``plots``.

        Branches are coloured by what moves; width shows damping (thin: weak), dashes the direction. Lines are
        the ones that meet a mode; dots are crossings, sized by Q; a bar marks the operating speed.
        """
        return campbell_picture(self)


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
    require(scene, "modes")
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
    branches = _branches(points, highest)
    orders = {branch.order for branch in branches}
    excitations: list[Line] = []
    every = {words: _rates(systems, numbers, scene) for words, numbers in kinds(scene).items()}
    for (words, numbers), at in zip(kinds(scene).items(), every.values(), strict=True):
        own = scene.bearings()
        found = lines(own[numbers[0]].scene, at, orders, highest, unbalance(scene))
        if scene.assembly.joined:  # those of local defects are of one bearing each
            found = [one for one in found if not one.source.startswith("defect")]
            for k in numbers:
                found += lines_of_defects(own[k].scene, at, orders, highest, f" of bearing {k + 1}")
        if words:  # the unbalance is one of all
            found = [
                one if one.name == "f_r" else replace(one, name=f"{one.name} of {words}")
                for one in found
                if one.name != "f_r" or not excitations
            ]
        excitations += found
    return Campbell(
        scene, tuple(points), tuple(branches), tuple(excitations), next(iter(every.values())), highest,
        tuple(skipped),
    )  # fmt: skip


def _rates(systems: Sequence[Linearised], numbers: Sequence[int], scene: Scene) -> Rates:
    """Return the frequencies of bearings, from 0, of one kind: the mean of them."""
    own = list(numbers)
    return rates(
        np.array([system.speed for system in systems]),
        np.array([float(system.orbits[own].mean()) for system in systems]),
        np.array([float(system.spins[own].mean()) for system in systems]),
        scene.geometries[own[0]].ball_count,
    )


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
    """Follow modes from speed to speed by the modal assurance criterion of their rates."""
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
    branches = [_branch(chain) for chain in chains]
    kept = [branch for branch in branches if branch.frequency.min() <= highest]
    return sorted(kept, key=lambda branch: float(branch.frequency[branch.frequency.size // 2]))


def _pairs(before: list[Mode], now: list[Mode], point: Modes) -> dict[int, int]:
    if not before or not now:
        return {}
    assurance = point.modal_assurance(before, now)
    rows, columns = linear_sum_assignment(-assurance)
    return {int(i): int(k) for i, k in zip(rows, columns, strict=True) if assurance[i, k] >= _SAME}


def _branch(chain: list[tuple[Modes, Mode]]) -> Branch:
    middle = chain[len(chain) // 2][1]
    return Branch(
        middle.name, middle.direction, middle.order, np.array([point.rpm for point, _ in chain]),
        np.array([mode.frequency for _, mode in chain]), np.array([mode.damping for _, mode in chain]),
        tuple(mode for _, mode in chain),
    )  # fmt: skip
