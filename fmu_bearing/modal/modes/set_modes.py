"""Natural motions of a set of bearings: names by what moves, whirl at the nose, line of the shaft.

Kinetic energy of the shaft with the inner rings is told as that of its rigid motion along the axis, across
and tilting about the centre of mass, and of bending, which is what is left; that of the housing with the
rings in it likewise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import placed, shaft_model
from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import SP, Q
from fmu_bearing.extras import need
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.set_linearised import SetBlock, SetLinearised
from fmu_bearing.modal.modes.energies import BACKWARD, FORWARD, NEITHER, parts, whirl
from fmu_bearing.modal.modes.mode_shape import Shape
from fmu_bearing.modal.modes.natural_modes import DAMPED, MOVES, SLOW, Mode, Modes
from fmu_bearing.scene import Scene
from fmu_bearing.scene.spindle import Spindle

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_NEUTRAL = 0.02  # of the orbit: see ``modes``
_ORDERS = 2  # of the balls' patterns by which a neutral motion turns in fixed axes
_DRAWN = 6  # modes in the picture
_POINTS = 81  # of a line in it


@dataclass(frozen=True)
class SetModes(Modes):
    """Modes of a set at one operating point: as `Modes`, with the line of the shaft.

    `modes` are those in which shaft, housing or rings move; motions of balls alone are in `apart`.
    """

    linearised: SetLinearised  # type: ignore[assignment]

    @property
    def _bent(self) -> tuple[int, ...]:
        return tuple({order for own in self.linearised.coordinates for order in own.orders})

    @property
    def _spindle(self) -> Spindle:
        assert self.scene.spindle is not None
        return self.scene.spindle

    def alike(self, before: list[Mode], now: list[Mode]) -> NDArray[np.float64]:
        """Return the modal assurance criterion of modes before against modes now, by kinetic energy."""
        one, other = (np.array([mode.vector for mode in some]).T for some in (before, now))
        masses = self.linearised.masses
        products = one.conj().T @ masses @ other
        squares = [np.einsum("ik,ij,jk->k", a.conj(), masses, a).real for a in (one, other)]
        return np.asarray(abs(products) ** 2 / np.maximum(np.outer(*squares), 1e-300))

    def shape(self, mode: Mode | int) -> Shape:
        """Refuse (``ValueError``): a shape is that of one bearing; see `line` and `picture`."""
        raise ValueError(f"{self.scene.name}: a shape is that of one bearing: `line` has that of the shaft")

    def line(self, mode: Mode | int, places: Sequence[float] | None = None) -> NDArray[np.complex128]:
        """Return y and z of the shaft along it, shape (2, places), over the largest of both.

        ``places``: m from the nose; default: nose and bearings. Times e^(i w t) the real parts are
        the motion.
        """
        chosen = self.modes[mode] if isinstance(mode, int) else mode
        system = self.linearised
        shaft = shaft_model(self.scene, self._spindle)
        q = chosen.vector[system.places : system.places + system.block.shaft]
        at = (0.0, *system.block.positions) if places is None else places
        found = np.array([shaft.at(float(place))[1:3] @ q for place in at]).T
        largest = found.ravel()[int(np.argmax(abs(found)))]
        return np.asarray(found / largest if abs(largest) > 0.0 else found)

    def picture(self) -> "Figure":
        """Draw the line of the shaft in its lowest modes across; needs the extra ``plots``."""
        chosen = [mode for mode in self.modes if mode.order == 1][:_DRAWN]
        rows = max(len(chosen), 1)
        figure, axes = need("matplotlib.pyplot", "a picture").subplots(
            rows, 1, sharex=True, squeeze=False, figsize=(7.0, 1.2 * rows + 0.8), layout="constrained"
        )
        places = np.linspace(0.0, 1e-3 * self._spindle.shaft.length_mm, _POINTS)
        bearings = 1e3 * self.linearised.block.positions
        for ax, mode in zip(axes[:, 0], chosen, strict=False):
            y, z = self.line(mode, list(places))
            # both when each is largest
            for part, colour, dash, label in ((y, "#D55E00", "--", "y"), (z, "#0072B2", "-", "z")):
                turn = part[int(np.argmax(abs(part)))]
                turned = (part * np.conj(turn) / abs(turn)).real if abs(turn) > 0.0 else part.real
                ax.plot(1e3 * places, turned, color=colour, linestyle=dash, label=label)
            ax.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
            ax.plot(bearings, 0.0 * bearings, "k^", markersize=6)
            ax.set_ylim(-1.15, 1.15)
            words = f"{mode.frequency:,.0f} Hz, damping {100 * mode.damping:.2g} %, {mode.label}"
            ax.set_title(words, fontsize=8, loc="left", pad=2)
        if chosen:
            axes[0, 0].legend(fontsize=7, loc="upper right", frameon=False, ncols=2)
        axes[-1, 0].set_xlabel("from the nose, mm (triangles: bearings); y and z each at its largest")
        figure.suptitle(f"{self.scene.name}: line of the shaft at {self.rpm:,.0f} r/min", fontsize=9)
        return figure  # type: ignore[no-any-return]


def set_solved(scene: Scene, system: SetLinearised, friction: bool = True) -> SetModes:
    """Return the modes of a linearised set."""
    scale = _scale(system)
    values, vectors = _eigen(system.matrix, scale)
    bodies = _bodies(system.block)
    spreads = _spreads(system, values, scale)
    found: list[Mode] = []
    apart: list[Mode] = []
    for value, vector, spread in zip(values, vectors.T, spreads, strict=True):
        mode = _mode(system, bodies, value, vector, spread)
        (found if _rings(system, mode) else apart).append(mode)
    return SetModes(
        scene, system.speed / RPM, tuple(sorted(found, key=lambda mode: mode.frequency)),
        tuple(sorted(apart, key=lambda mode: mode.frequency)), system, friction,
    )  # fmt: skip


def _scale(system: SetLinearised) -> NDArray[np.float64]:
    """Return what makes numbers alike for the eigenvalues: roots of inertia, of places at 1 rad/s."""
    found = np.diag(system.masses).copy()
    for at, first in zip(system.coordinates, system.first, strict=False):
        found[first : first + 3 * at.balls] = found[first + 3 * at.balls : first + 6 * at.balls]
    found[system.places : system.rates] = found[system.rates :]
    found[found <= 0.0] = found[found > 0.0].min()
    return np.asarray(np.sqrt(found))


def _eigen(
    matrix: NDArray[np.float64], scale: NDArray[np.float64]
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    values, vectors = (part.astype(complex) for part in np.linalg.eig(matrix * scale[:, None] / scale))
    kept = values.imag >= 0.0
    return values[kept], vectors[:, kept] / scale[:, None]


def _spreads(
    system: SetLinearised, values: NDArray[np.complex128], scale: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Range of each frequency over the phases, over the frequency, by the nearest eigenvalue of each."""
    if system.equal_loads:
        return np.zeros(values.size)
    low = high = values.imag
    for matrix in system.phases:
        others = _eigen(matrix, scale)[0]
        nearest = others[abs(others[None, :] - values[:, None]).argmin(axis=1)].imag
        low, high = np.minimum(low, nearest), np.maximum(high, nearest)
    return np.asarray((high - low) / np.maximum(values.imag, SLOW))


@dataclass(frozen=True)
class _Body:
    """Rigid motions of a body about its centre of mass in columns: shape (n, motions), and its mass."""

    name: str
    numbers: slice
    mass: NDArray[np.float64]
    motions: NDArray[np.float64]
    words: tuple[tuple[str, int, tuple[int, ...]], ...]
    bends: bool


def _bodies(block: SetBlock) -> list[_Body]:
    """Return shaft and housing."""
    own = slice(0, block.shaft)
    total = block.total
    planes = [block.nose[:, own]]
    wanted = [placed(1.0, 0.0)]
    for motion, sign, position in zip(block.motions, block.signs, block.positions, strict=True):
        planes.append(placed(sign, 0.0) @ motion[:FREEDOMS, own])
        wanted.append(placed(1.0, float(position)))
    rigid = np.linalg.lstsq(np.vstack(planes), np.vstack(wanted), rcond=1e-12)[0]
    mass = total[own, own]
    words = (("axial", 0, (0,)), ("radial", 1, (1, 2)), ("tilt", 1, (3, 4)))
    found = [_Body("shaft", own, mass, _about_centre(rigid, mass, 1, 2, 3, 4), words, block.shaft > FREEDOMS)]
    if block.housed:
        six = slice(block.shaft, block.shaft + SP.HOUSING)
        names = (
            ("axial", 0, (Q.X,)), ("radial", 1, (Q.Y, Q.Z)), ("spin", 0, (Q.TURN,)),
            ("tilt", 1, (Q.BY, Q.BZ)),
        )  # fmt: skip
        mass = total[six, six]
        motions = _about_centre(np.eye(SP.HOUSING), mass, Q.Y, Q.Z, Q.BY, Q.BZ)
        found.append(_Body("housing", six, mass, motions, names, False))
    return found


def _about_centre(
    motions: NDArray[np.float64], mass: NDArray[np.float64], y: int, z: int, by: int, bz: int
) -> NDArray[np.float64]:
    """Return motions with tilts about the centre of mass, so that energies add up."""
    found = motions.copy()
    heavy = float(found[:, y] @ mass @ found[:, y])
    found[:, bz] -= found[:, y] * float(found[:, y] @ mass @ found[:, bz]) / heavy
    found[:, by] -= found[:, z] * float(found[:, z] @ mass @ found[:, by]) / heavy
    return found


def _energies(
    system: SetLinearised, bodies: list[_Body], vector: NDArray[np.complex128]
) -> list[tuple[str, int, float]]:
    """Return names, orders and mean kinetic energies of what moves."""
    found: list[tuple[str, int, float]] = []
    v = vector[system.rates :]
    for body in bodies:
        own = v[body.numbers]
        rest = own.copy()
        for word, order, columns in body.words:
            moved = body.motions[:, columns]
            inertia = moved.T @ body.mass @ moved
            amount = np.linalg.solve(inertia, moved.T @ (body.mass @ own))
            found.append((f"{body.name} {word}", order, _energy(inertia, amount)))
            rest -= moved @ amount
        if body.bends:
            found.append((f"{body.name} bending", 1, _energy(body.mass, rest)))
    sliding = system.block.shaft + (SP.HOUSING if system.block.housed else 0)
    if sliding < system.block.count:
        mass = system.block.total[sliding:, sliding:]
        found.append(("sliding rings", 0, _energy(mass, v[sliding:])))
    for k, at in enumerate(system.coordinates):
        for part in parts(at, _alone(system, k, at, vector), 1.0):
            ball = part.name.startswith("ball")
            if part.name.startswith("inner") and not part.name.endswith("flexure"):
                continue  # it is the shaft's
            numbered = f" n = {part.order}" if ball or part.name.endswith("flexure") else ""
            found.append(
                (f"{part.name}{numbered} of bearing {k + 1}", part.order, part.forward + part.backward)
            )
    return found


def _energy(mass: NDArray[np.float64], rates: NDArray[Any]) -> float:
    return 0.25 * float((rates.conj() @ mass @ rates).real)


def _alone(
    system: SetLinearised, k: int, at: Coordinates, vector: NDArray[np.complex128]
) -> NDArray[np.complex128]:
    """Return a bearing's own part of a vector in its own order; driven rows are zero."""
    found = np.zeros(at.size, dtype=complex)
    first, last = system.first[k], system.first[k + 1]
    driven = len(system.block.inertia[k])
    kept = np.ones(at.size, dtype=bool)
    for begin in (at.rings, at.ring_rates):
        kept[begin : begin + driven] = False
    found[kept] = vector[first:last]
    return found


def _mode(
    system: SetLinearised, bodies: list[_Body], value: complex, vector: NDArray[np.complex128], spread: float
) -> Mode:
    energies = _energies(system, bodies, vector)
    total = sum(energy for _, _, energy in energies) or 1.0
    ranked = sorted(energies, key=lambda one: -one[2])
    name, order, _ = ranked[0]
    direction = NEITHER
    if order == 1 and system.speed:
        nose = system.block.nose @ vector[system.rates :]
        direction = whirl(abs(nose[1] + 1j * nose[2]), abs(nose[1] - 1j * nose[2]))
        if system.speed < 0.0:
            direction = {FORWARD: BACKWARD, BACKWARD: FORWARD}.get(direction, direction)
    size = abs(value)
    shares = {word: float(energy / total) for word, _, energy in ranked}
    damping = float(-value.real / size) if size else 1.0
    frequency = float(value.imag) / (2.0 * math.pi)
    return Mode(
        name, frequency, damping, order, direction, shares, float(spread), complex(value), complex(value),
        vector,
    )  # fmt: skip


def _rings(system: SetLinearised, mode: Mode) -> bool:
    """Whether a motion of shaft, housing or rings swings by itself, neither overdamped nor neutral."""
    if mode.frequency <= 0.0 or mode.damping > DAMPED or mode.ring_share < MOVES:
        return False
    orbit = float(np.max(abs(system.orbits)))
    for own, at in zip(system.orbits, system.coordinates, strict=True):
        orders = np.arange(-(at.balls // 2), at.balls // 2 + 1)
        apart = abs(mode.value - 1j * orders * own)
        wide = abs(orders) <= (_ORDERS if mode.ring_share > DAMPED else at.balls)
        if apart.min() < SLOW or apart[wide].min() < max(SLOW, _NEUTRAL * orbit):
            return False
    return True
