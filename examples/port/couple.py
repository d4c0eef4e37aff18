"""Three couplings of a rotor with bearings at their mechanical port, in communication steps of one size.

``extrapolated``  Gauss-Seidel: the rotor steps with the bearings' force extrapolated, then the bearings
``derivative``    the rotor's trapezoidal rule has the force's derivatives in it
``rollback``      the bearings step twice: after the first the rotor's equations are solved again (Newton)

    python examples/port/couple.py derivative 2e-5
"""

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rotor import PORT, Rotor, cylinder

from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import Scene, read_scene

SCENE = Path(__file__).parent / "7003C-DB-port.toml"
SCHEMES = ("extrapolated", "derivative", "rollback")
Vector = NDArray[np.float64]

_AXES = [f"displacement.{axis}" for axis in "xyz"] + ["tilt.y", "tilt.z"]
_RATES = [f"velocity.{axis}" for axis in "xyz"] + ["tilt_rate.y", "tilt_rate.z"]
_FORCES = [f"force.{axis}" for axis in "xyz"] + ["moment.y", "moment.z"]


class Bearings:
    """Bearings of a scene with a port, as a master sees them: an FMU answers the same calls."""

    def __init__(self, scene: Scene) -> None:
        self.one = Instance(prepare(scene), tell=lambda _: None)

    def start(self, place: Vector) -> Vector:
        """Rest with the shaft at ``place`` (5); force and moment on the rotor."""
        self._lead(place, np.zeros(PORT))
        self.one.initialise()
        return self.force()

    def step(self, place: Vector, rate: Vector, h: float) -> Vector:
        """Go to place and rate in ``h`` (s); force and moment there."""
        self._lead(place, rate)
        self.one.step(h)
        return self.force()

    def _lead(self, place: Vector, rate: Vector) -> None:
        for names, values in ((_AXES, place), (_RATES, rate)):
            for name, value in zip(names, values, strict=True):
                self.one.set(f"port.{name}", float(value))

    def force(self) -> Vector:
        """Force and moment on the rotor (5)."""
        return np.array([self.one.get(f"port.{name}") for name in _FORCES])

    def rings(self) -> tuple[float, float, float]:
        """Mass, static moment and transverse inertia of the inner rings."""
        mass, static, across = ("port.mass", "port.static_moment", "port.inertia.transverse")
        return self.one.get(mass), self.one.get(static), self.one.get(across)


def rest(bearings: Bearings, rotor: Rotor) -> Vector:
    """Return the rotor's place at rest: Newton's method with the bearings' own derivatives."""
    place = np.zeros(rotor.count)
    for _ in range(20):
        force = bearings.start(place[:PORT])
        total = rotor.weight - rotor.stiffness @ place
        total[:PORT] += force
        matrix = rotor.stiffness.copy()
        matrix[:PORT, :PORT] -= bearings.one.port_derivatives(1e-3)[0]
        change = np.linalg.solve(matrix, total)
        place += change
        if np.abs(change).max() < 1e-13:
            break
    bearings.start(place[:PORT])
    return place


def run(
    bearings: Bearings, rotor: Rotor, scheme: str, h: float, duration: float, push: Vector
) -> NDArray[np.float64]:
    """Return the rotor's places over time, shape (steps, n), after an impulse ``push`` (N s, n) at rest.

    ``rotor`` has the inner rings' inertia. Stops where it runs away (10 um).
    """
    place = rest(bearings, rotor)
    rate = np.linalg.solve(rotor.mass, push)
    force = before = bearings.force()
    begin, rows = place.copy(), []
    derivatives, resting = None, bearings.one.port_derivatives(1e-3)[0]
    for k in range(round(duration / h)):
        if derivatives is None or k % 10 == 0:  # the bearings change little in so many steps
            derivatives = bearings.one.port_derivatives(h)
        # the force that the bearings give at the end: extrapolated, or as if the rates were held
        ahead = 2.0 * force - before if scheme == SCHEMES[0] else force + h * resting @ rate[:PORT]
        inside = None if scheme == SCHEMES[0] else derivatives
        to_place, to_rate = _rotor_step(rotor, place, rate, force, ahead, h, inside)
        kept = bearings.one.s.copy()
        after = bearings.step(to_place[:PORT], to_rate[:PORT], h)
        if scheme == "rollback":
            to_place, to_rate = _corrected(
                rotor, place, rate, force, after, to_place, to_rate, h, derivatives
            )
            bearings.one.s[:] = kept
            after = bearings.step(to_place[:PORT], to_rate[:PORT], h)
        place, rate, before, force = to_place, to_rate, force, after
        rows.append(place - begin)
        if np.abs(rows[-1][:3]).max() > 1e-5:
            break
    return np.array(rows)


def _forces(rotor: Rotor, place: Vector, rate: Vector, force: Vector) -> Vector:
    total = rotor.weight - rotor.stiffness @ place - rotor.damping @ rate
    total[:PORT] += force
    return total


def _matrix(rotor: Rotor, h: float, derivatives: tuple[Vector, Vector] | None) -> Vector:
    """Matrix of the trapezoidal rule over the change of rates."""
    found = rotor.mass + 0.5 * h * rotor.damping + 0.25 * h * h * rotor.stiffness
    if derivatives is not None:
        by_place, by_rate = derivatives
        found[:PORT, :PORT] -= 0.5 * h * by_rate + 0.25 * h * h * by_place
    return found


def _rotor_step(
    rotor: Rotor, place: Vector, rate: Vector, force: Vector, end: Vector, h: float,
    derivatives: tuple[Vector, Vector] | None,
) -> tuple[Vector, Vector]:  # fmt: skip
    """One step of the rotor by the trapezoidal rule; ``end``: the bearings' force where rates are held.

    ``derivatives``: of that force, by place and by rate at the end; None: it stays as it is.
    """
    start = _forces(rotor, place, rate, force)
    ahead = _forces(rotor, place + h * rate, rate, end)
    change = np.linalg.solve(_matrix(rotor, h, derivatives), 0.5 * h * (start + ahead))
    return place + h * rate + 0.5 * h * change, rate + change


def _corrected(
    rotor: Rotor, place: Vector, rate: Vector, force: Vector, after: Vector, to_place: Vector,
    to_rate: Vector, h: float, derivatives: tuple[Vector, Vector],
) -> tuple[Vector, Vector]:  # fmt: skip
    """One step of Newton's method on the trapezoidal rule with the force that the bearings gave."""
    both = _forces(rotor, place, rate, force) + _forces(rotor, to_place, to_rate, after)
    wrong = 0.5 * h * both - rotor.mass @ (to_rate - rate)
    change = np.linalg.solve(_matrix(rotor, h, derivatives), wrong)
    return to_place + 0.5 * h * change, to_rate + change


def damped(row: NDArray[np.float64], h: float, low: float = 0.0) -> tuple[float, float]:
    """Return frequency (Hz) and damping ratio of the strongest decaying oscillation in a row.

    Matrix pencil of order 12 (Hua and Sarkar 1990), on samples about 12 to a period of the strongest line.
    """
    spectrum = np.abs(np.fft.rfft((row - row.mean()) * np.hanning(len(row))))
    peak = np.fft.rfftfreq(len(row), h)[np.argmax(spectrum)]
    every = max(1, round(1.0 / (12.0 * max(peak, low, 1.0) * h)))
    x, dt = row[::every], every * h
    window = len(x) // 2
    hankel = np.array([x[k : k + len(x) - window] for k in range(window + 1)])
    _, _, right = np.linalg.svd(hankel.T, full_matrices=False)
    basis = right[:12].T
    roots = np.linalg.eigvals(np.linalg.lstsq(basis[:-1], basis[1:], rcond=None)[0])
    powers = np.vander(roots, len(x), increasing=True).T
    amounts = np.abs(np.linalg.lstsq(powers, x.astype(complex), rcond=None)[0])
    swinging = np.abs(np.angle(roots)) > 0.05
    root = np.log(roots[np.argmax(np.where(swinging, amounts, 0.0))]) / dt
    return abs(root) / (2.0 * np.pi), -root.real / abs(root)


def main(scheme: str, h: float) -> None:
    """Couple the rigid rotor, and return frequency and damping of its first mode."""
    scene = read_scene(SCENE)
    bearings = Bearings(scene.replace({"fidelity.model": "full"}))
    bearings.start(np.zeros(PORT))
    speed = bearings.one.get("shaft_speed")
    rotor = cylinder(0.2, 0.0085, speed).with_rings(*bearings.rings())
    rows = run(bearings, rotor, scheme, h, 5e-3, np.array([0.0, 0.0, 1e-3, 0.0, 0.0]))
    frequency, ratio = damped(rows[:, 2], h)
    print(f"{scheme}, {1e6 * h:g} us: {frequency:.0f} Hz, damping ratio {ratio:.4f}")


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
