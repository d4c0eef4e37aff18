"""Natural motions of a mounted bearing: what moves, at which frequency, how damped, in which direction."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.equations.remarks import remarks
from fmu_bearing.modal.modes.energies import BACKWARD, FORWARD, NEITHER, participation, parts, wave
from fmu_bearing.modal.modes.mode_shape import Shape, shape
from fmu_bearing.scene import Scene

SLOW = 1.0  # rad/s: slower in the axes in which it stands, a motion is neutral
DAMPED = 0.5  # damping ratio beyond which a motion does not ring
MARGIN = 0.002  # damping ratio below which a mode is named as near the limit of stability (chosen)
_LOWEST = 100.0  # Hz: slower motions that grow belong to the mounting
#: 1/s: slower growth is not named. The mean over one ball pitch gives neutral motions of balls under a radial
#: load up to 2.7 1/s; what grows by 5 1/s must be named.
GROWS = 3.0
MOVES = 0.05  # of the kinetic energy: with less of it in the rings, a motion is one of the balls alone
SPREAD = 0.01  # of the frequency over one ball pitch, beyond which it is told
_NEUTRAL = 0.02  # of the orbit: the balls' spins turn over so slowly at high speed
STICKING = 1e-3  # of a revolution per second: slower, contacts stick


@dataclass(frozen=True)
class Mode:
    """A natural motion of the bearing.

    Attributes
    ----------
    name : str
        What moves most, by kinetic energy: ``inner radial``, ``outer axial``, ``ball n = 3``...
    frequency : float
        Hz, in fixed axes.
    damping : float
        Damping ratio; negative: the motion grows by itself.
    order : int
        Waves round the bearing: 0 axial and turning, 1 radial and tilting, n of a ring's flexure.
    direction : str
        ``forward`` with the shaft, ``backward`` or empty: order 0, or neither whirl dominates threefold.
    participation : dict
        Shares of the kinetic energy by component, the largest first.
    spread : float
        Range of the frequency over one ball pitch, over the frequency; 0 where balls carry equal loads.
    value, orbiting : complex
        Eigenvalues (1/s) in fixed axes, and in the axes that orbit with the balls.
    vector : ndarray
        Eigenvector in the order of ``Modes.linearised.coordinates``.
    """

    name: str
    frequency: float
    damping: float
    order: int
    direction: str
    participation: dict[str, float]
    spread: float
    value: complex
    orbiting: complex
    vector: NDArray[np.complex128]

    @property
    def label(self) -> str:
        """Name with direction."""
        return f"{self.name} {self.direction}".rstrip()

    @property
    def ring_share(self) -> float:
        """Share of the rings in the kinetic energy."""
        return sum(share for name, share in self.participation.items() if not name.startswith("ball"))

    @property
    def remark(self) -> str:
        """``unstable`` or ``instability margin`` for modes of the rings with hardly any damping, or empty."""
        if self.damping >= MARGIN or self.ring_share <= MOVES:
            return ""
        if self.name.startswith("ball"):
            # balls have most of the energy of the fastest whirls of a ring; those that rings hardly take
            # part in are free along their orbits, and neutral
            return "unstable" if self.growth > GROWS else ""
        return "unstable" if self.damping < 0.0 else "instability margin"

    @property
    def growth(self) -> float:
        """Rate (1/s) at which the motion grows by itself; negative where it dies away."""
        return float(self.value.real)

    @property
    def quality(self) -> float:
        """Q, the magnification at resonance, 1/(2 zeta); infinite for a mode without damping."""
        return 0.5 / self.damping if self.damping > 0.0 else math.inf


@dataclass(frozen=True)
class Modes:
    """Modes of a bearing at one operating point.

    Attributes
    ----------
    scene : Scene
    rpm : float
        Speed (r/min).
    modes : tuple of Mode
        Those that ring, by frequency.
    apart : tuple of Mode
        Neutral and overdamped motions, which show as no peak.
    linearised : Linearised
        The equations they belong to.
    friction : bool
        Whether contacts have friction.

    Examples
    --------
    >>> from fmu_bearing import modes
    >>> found = modes("examples/scenes/7003C-spindle.toml", {"preload": 300.0})
    >>> mode = found.near(2000.0)
    >>> mode.name, mode.order, bool(mode.damping > 0.0)
    ('inner radial', 1, True)
    """

    scene: Scene
    rpm: float
    modes: tuple[Mode, ...]
    apart: tuple[Mode, ...]
    linearised: Linearised
    friction: bool = True

    def near(self, frequency: float) -> Mode:
        """Return the mode nearest to a frequency (Hz), by ratio."""
        if not (math.isfinite(frequency) and frequency > 0.0):
            raise ValueError(f"frequency = {frequency} Hz is refused: give a positive number of hertz")
        if not self.modes:
            raise ValueError(f"{self.scene.name}: nothing rings at {self.rpm:,.0f} r/min; see `apart`")
        return min(self.modes, key=lambda mode: abs(math.log(mode.frequency / frequency)))

    def shape(self, mode: Mode | int) -> Shape:
        """Return how rings and balls move in a mode, or in the one of that place in `modes`."""
        chosen = self.modes[mode] if isinstance(mode, int) else mode
        return shape(self.linearised, chosen.vector, chosen.value)

    def named(self, name: str, direction: str = "") -> Mode:
        """Return the lowest mode of a name, such as ``inner radial``, and a direction if one is given."""
        for mode in self.modes:
            if mode.name == name and direction in ("", mode.direction):
                return mode
        names = ", ".join(dict.fromkeys(mode.label for mode in self.modes))
        wanted = f"{name} {direction}".rstrip()
        raise ValueError(f"there is no mode '{wanted}'; there are {names}")

    def weak(self) -> tuple[Mode, ...]:
        """Return the modes near or beyond the limit of stability: a damping ratio below ``MARGIN``.

        Balls that move alone are left out, unless rings move with them and the motion grows: they are free
        along their orbits.
        """
        return tuple(mode for mode in self.modes if mode.remark)

    def cautions(self) -> list[str]:
        """Return what limits these modes, in sentences."""
        found = [_weak_words(mode) for mode in self.weak()] if self.friction else []
        found += remarks(self.scene, self.linearised)
        of_rings = [mode for mode in self.modes if mode.ring_share > MOVES]
        spread = max((mode.spread for mode in of_rings), default=0.0)
        if spread > SPREAD:
            worst = max(of_rings, key=lambda mode: mode.spread)
            found.append(
                f"loads differ from ball to ball: '{worst.label}' moves by {100 * spread:.1f} % of its "
                "frequency while one ball pitch passes, so lines stand beside it; frequencies are means"
            )
        if self.friction and abs(self.rpm) < 60.0 * STICKING:
            found.append(
                "the shaft stands still, so contacts stick; once they slide, modes are those without friction"
            )
        if self.scene.bearing.cage is not None:
            found.append("the cage and its films are left out: it touches balls and lands with clearance")
        return found

    def table(self, highest: float = 50e3, apart: bool = False) -> list[dict[str, Any]]:
        """Return rows: frequency (Hz), damping ratio, order, direction, name, kinetic energy, remark.

        Rows of balls alone that differ by their order only are one row.

        Parameters
        ----------
        highest : float
            Hz: modes above it are left out.
        apart : bool
            The neutral and overdamped motions instead.
        """
        chosen = [mode for mode in (self.apart if apart else self.modes) if mode.frequency <= highest]
        rows = []
        alone: list[Mode] = []
        for mode in chosen:
            if mode.name.startswith("ball") and mode.order > 1 and mode.order not in self._bent:
                alone.append(mode)
            else:
                rows.append(_row(mode))
        rows += [_group(group) for group in _alike(alone)]
        return sorted(rows, key=lambda row: row["frequency_Hz"])

    def alike(self, before: list[Mode], now: list[Mode]) -> NDArray[np.float64]:
        """Return the modal assurance criterion of modes before against modes now, by kinetic energy."""
        one, other = (np.array([mode.vector for mode in some]).T for some in (before, now))
        return like(one, other, self.linearised.coordinates.masses)

    @property
    def _bent(self) -> tuple[int, ...]:
        """Orders in which rings bend."""
        return self.linearised.coordinates.orders


def may_grow(matrix: NDArray[np.float64]) -> bool:
    """Whether a motion above 100 Hz grows by itself, from the eigenvalues alone."""
    values = np.linalg.eigvals(matrix)
    return bool(np.any((values.real > GROWS) & (values.imag > 2.0 * math.pi * _LOWEST)))


def self_excited(found: "Modes") -> Mode | None:
    """Return the mode in which rings move that grows fastest by itself, by `GROWS` or more; None: none does.

    Its largest part may be the balls' orbits: at 7008AC, 20,000 r/min, 150 N balls have 85 % of its energy.
    One that takes long to grow beside a multiple of the orbit's speed is among `Modes.apart`.
    """
    growing = [
        one
        for one in (*found.modes, *found.apart)
        if one.growth > GROWS and one.ring_share > MOVES and one.frequency > _LOWEST
    ]
    return max(growing, key=lambda one: one.growth, default=None)


def solved(scene: Scene, system: Linearised, friction: bool = True) -> Modes:
    """Return the modes of a linearised bearing."""
    values, vectors = _eigen(system, system.matrix)
    spreads = _spreads(system, values, vectors)
    found: list[Mode] = []
    apart: list[Mode] = []
    for value, vector, spread in zip(values, vectors.T, spreads, strict=True):
        mode = _mode(system, value, vector, spread)
        (found if _is_ringing(system, mode) else apart).append(mode)
    by_frequency = sorted(found, key=lambda mode: mode.frequency)
    return Modes(
        scene, system.speed / RPM, tuple(by_frequency),
        tuple(sorted(apart, key=lambda mode: mode.frequency)), system, friction,
    )  # fmt: skip


def _eigen(
    system: Linearised, matrix: NDArray[np.float64]
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return eigenvalues with no negative imaginary part, and their vectors, of unit kinetic energy."""
    scale = np.sqrt(_weights(system))
    values, vectors = (part.astype(complex) for part in np.linalg.eig(matrix * scale[:, None] / scale))
    kept = values.imag >= 0.0
    return values[kept], vectors[:, kept] / scale[:, None]


def _weights(system: Linearised) -> NDArray[np.float64]:
    """Return inertia for rates, and for places what they weigh at 1 rad/s: enough to tell neutral motions."""
    at = system.coordinates
    weights = at.masses.copy()
    places = 3 * at.balls
    weights[:places] = weights[places : 2 * places]
    weights[at.rings : at.ring_rates] = weights[at.ring_rates : at.flexure]
    weights[at.flexure : at.flexure_rates] = weights[at.flexure_rates :]
    return weights


def _spreads(
    system: Linearised, values: NDArray[np.complex128], vectors: NDArray[np.complex128]
) -> NDArray[np.float64]:
    """Range of each frequency over the phases, over the frequency; modes are followed by their shapes."""
    if system.equal_loads:
        return np.zeros(values.size)
    masses = system.coordinates.masses
    low = high = values.imag
    for matrix in system.phases:
        others, shapes = _eigen(system, matrix)
        found = others.imag[like(vectors, shapes, masses).argmax(axis=1)]
        low, high = np.minimum(low, found), np.maximum(high, found)
    return np.asarray((high - low) / np.maximum(values.imag, SLOW))


def like(
    one: NDArray[np.complex128], other: NDArray[np.complex128], masses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Modal assurance criterion of the rates of each column of one set against each of another.

    Allemang (2003): squared product over the product of squares, here weighed by inertia, so that the
    products are energies.
    """
    a, b = (np.sqrt(masses)[:, None] * vectors for vectors in (one, other))
    squares = np.outer((abs(a) ** 2).sum(axis=0), (abs(b) ** 2).sum(axis=0))
    return np.asarray(abs(a.conj().T @ b) ** 2 / np.maximum(squares, 1e-300))


def _mode(system: Linearised, value: complex, vector: NDArray[np.complex128], spread: float) -> Mode:
    """Return the mode of an eigenvalue."""
    at = system.coordinates
    turning = math.copysign(1.0, system.speed)
    moving = parts(at, vector, turning)
    energy = sum(part.forward + part.backward for part in moving)
    share = participation(moving)
    if energy < 1e-12 * float(_weights(system) @ abs(vector) ** 2):
        # nothing moves in the balls' own axes: told by the places
        vector = _as_rates(system, vector)
        moving = parts(at, vector, turning)
        share = participation(moving)
    order, direction = wave(moving)
    if system.speed == 0.0:
        direction = NEITHER
    shift = {FORWARD: 1.0, BACKWARD: -1.0}.get(direction, 0.0) * order * abs(system.orbit)
    if at.balls % 2 == 0 and order == at.balls // 2:
        shift = 0.0
    size = abs(value)
    damping = -value.real / size if size else 1.0
    name = next(iter(share))
    return Mode(
        name, float(value.imag) / (2.0 * math.pi), float(damping), order, direction, share, float(spread),
        complex(value), complex(value - 1j * shift), vector,
    )  # fmt: skip


def _is_ringing(system: Linearised, mode: Mode) -> bool:
    """Whether a motion swings by itself, neither overdamped nor neutral in the axes in which it stands."""
    own = mode.orbiting
    if mode.frequency <= 0.0 or mode.damping > DAMPED:
        return False
    # what is overdamped for the balls swings in fixed axes at multiples of the cage's frequency
    if mode.ring_share <= DAMPED and -own.real > DAMPED * abs(own):
        return False
    alone = mode.ring_share < MOVES and mode.name.startswith(("ball orbit", "ball spin"))
    if alone and not system.arrays.p[P.SPRINGS]:
        return False  # along their orbits the cage holds the balls, which is left out
    # Unequal loads mix the patterns, so a neutral motion of the balls is looked for at other orders, too: at
    # low ones where rings take most of the little that moves.
    most = 2 if mode.ring_share > DAMPED else system.coordinates.balls // 2
    nearest = float(np.min(abs(mode.value - 1j * np.arange(-most, most + 1) * system.orbit)))
    return nearest >= max(SLOW, _NEUTRAL * abs(system.orbit))


def _as_rates(system: Linearised, vector: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return a vector with its places in the place of the rates."""
    at = system.coordinates
    found = vector.copy()
    found[3 * at.balls : 6 * at.balls] = vector[: 3 * at.balls]
    found[at.ring_rates : at.flexure] = vector[at.rings : at.ring_rates]
    found[at.flexure_rates :] = vector[at.flexure : at.flexure_rates]
    return found


def _weak_words(mode: Mode) -> str:
    where = f"'{mode.label}' at {mode.frequency:.0f} Hz"
    if mode.damping < 0.0:
        return (
            f"instability: {where} grows by itself (damping ratio {mode.damping:.4f}): the bearing whirls "
            "until its motion is large enough to limit itself; more preload or less speed may hold it"
        )
    return (
        f"instability margin: {where} has a damping ratio of {mode.damping:.4f} only: a little less preload "
        "or more speed may make it whirl by itself"
    )


def _row(mode: Mode) -> dict[str, Any]:
    return {
        "frequency_Hz": mode.frequency,
        "damping_ratio": mode.damping,
        "order": mode.order,
        "direction": mode.direction,
        "name": mode.name,
        "participation": mode.participation,
        "spread": mode.spread,
        "remark": mode.remark,
    }


def _alike(alone: list[Mode]) -> list[list[Mode]]:
    """Group motions of the balls alone that differ in fixed axes by the turning of their pattern only."""
    groups: list[list[Mode]] = []
    for mode in sorted(alone, key=lambda mode: (_what(mode), abs(mode.orbiting.imag))):
        last = groups[-1][-1] if groups else None
        if last and _what(last) == _what(mode):
            apart = abs(mode.orbiting.imag) - abs(last.orbiting.imag)
            if apart <= SPREAD * abs(mode.orbiting.imag):
                groups[-1].append(mode)
                continue
        groups.append([mode])
    return groups


def _what(mode: Mode) -> str:
    """Name of a mode without its order."""
    return mode.name.partition(" n = ")[0]


def _group(group: list[Mode]) -> dict[str, Any]:
    """Row of motions of the balls alone that are one motion in orbiting axes: its numbers there."""
    if len(group) == 1:
        return _row(group[0])
    orders = sorted({mode.order for mode in group})
    value = complex(np.mean([mode.orbiting.real + 1j * abs(mode.orbiting.imag) for mode in group]))
    words = f"{orders[0]} to {orders[-1]}" if len(orders) > 1 else str(orders[0])
    return _row(group[0]) | {
        "frequency_Hz": value.imag / (2.0 * math.pi),
        "damping_ratio": -value.real / abs(value),
        "name": f"{_what(group[0])} n = {words}",
        "direction": "",
    }
