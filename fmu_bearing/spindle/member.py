"""One bearing of a set: forces and stiffness where the shaft puts it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.compiled import call
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE, RPM
from fmu_bearing.engine.layout import EQ, C, P, U, W
from fmu_bearing.engine.status import OK
from fmu_bearing.instance import REASONS, EngineError
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.member import HELD, one_of
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.spindle import SetBearing

_FREEDOMS = EQ.FREEDOMS
_CLOSE = 1e-13  # m: places found by bisection; 1e-13 m is 1e-5 N at the stiffness of a spindle bearing
_FAR = 1e-3  # m: no bearing is pushed so far
_TOUCHING = 0.01  # N: without preload the rings stand where the balls just touch, as for rigid preload


@dataclass(frozen=True)
class Held:
    """A bearing whose rings are held, in its own axes, SI units.

    Attributes
    ----------
    force : ndarray, shape (5,)
        Of the balls on the inner ring: x y z (N), moments about y, z (N m).
    stiffness : ndarray, shape (5, 5)
        Inner ring against outer; centrifugal and friction forces of the balls held.
    loads, angles, pressures : ndarray, shape (2, balls)
        Ball loads (N), contact angles (rad), peak pressures (Pa) at inner and outer race.
    """

    force: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    loads: NDArray[np.float64]
    angles: NDArray[np.float64]
    pressures: NDArray[np.float64]


class Member:
    """A bearing on the shaft: perfect, rigid rings.

    Parameters
    ----------
    scene : Scene
        With a set.
    place : SetBearing
    speed : float
        Of the shaft, rad/s.
    """

    def __init__(self, scene: Scene, place: SetBearing, speed: float) -> None:
        self.place = place
        self.sign = float(place.sign)
        self.position = 1e-3 * place.position_mm  # m
        self.inputs = np.zeros(U.SIZE)
        self.inputs[U.SPEED] = speed
        self.inputs[U.PEDESTAL] = HELD
        operation, own = si(scene.operation), si(place)
        self.inputs[U.OIL_T] = operation.oil_temperature
        for index, ring in ((U.INNER_T, "inner_ring_temperature"), (U.OUTER_T, "outer_ring_temperature")):
            given = getattr(own, ring)
            self.inputs[index] = getattr(operation, ring) if given is None else given
        self.parameters = pack(_alone(scene), np.empty(0))
        self._c, self._out = np.zeros(C.SIZE), np.zeros(EQ.SIZE)
        self._force, self._w = np.zeros(_FREEDOMS), np.zeros(W.size(self.parameters))
        self.mirror = np.array([self.sign, 1.0, 1.0, self.sign, self.sign])

    def at(self, own: NDArray[np.float64], inputs: NDArray[np.float64] | None = None) -> Held:
        """Return the bearing with its inner ring held at ``own`` (m, rad) in its own axes.

        ``inputs``: of the engine, ``layout.U``; default: those of the operating point.

        Raises
        ------
        EngineError
            Where the balls find no place.
        """
        ring = np.ascontiguousarray(own, dtype=np.float64)
        inputs = self.inputs if inputs is None else inputs
        status = call("held", self.parameters, inputs, self._c, ring, self._force, self._out, self._w)
        if status != OK:
            raise EngineError(f"bearing at {1e3 * self.position:g} mm: {REASONS[status]}")
        balls = int(self.parameters[P.BALLS])
        rows = [self._out[at : at + balls] for at in (EQ.LOAD_I, EQ.LOAD_O, EQ.ANGLE_I, EQ.ANGLE_O)]
        loads = np.array(rows[:2])
        races = [self.parameters[P.RACES + k * P.RACE_SIZE : P.RACES + (k + 1) * P.RACE_SIZE] for k in (0, 1)]
        hertz = np.array([race[P.RACE_STIFFNESS] for race in races])
        peak = np.array([race[P.RACE_PRESSURE] for race in races])
        # Q = K d^1.5 and p = P d^0.5 with the approach d
        pressures = peak[:, None] * np.cbrt(loads / hertz[:, None])
        stiffness = self._out[EQ.STIFFNESS : EQ.STIFFNESS + _FREEDOMS**2].reshape(_FREEDOMS, _FREEDOMS)
        return Held(self._force.copy(), stiffness.copy(), loads, np.array(rows[2:]), pressures)

    def still(self) -> NDArray[np.float64]:
        """Return inputs of standstill at the scene's temperatures."""
        inputs = self.inputs.copy()
        inputs[U.SPEED] = 0.0
        return inputs

    def cold(self) -> NDArray[np.float64]:
        """Return inputs of standstill at 20 degC."""
        return self.warmer(0.0)

    def warmer(self, rise: float) -> NDArray[np.float64]:
        """Return inputs of standstill at 20 degC with an inner ring that is warmer by ``rise`` (K)."""
        inputs = self.still()
        inputs[[U.OIL_T, U.INNER_T, U.OUTER_T]] = REFERENCE_TEMPERATURE
        inputs[U.INNER_T] += rise
        return inputs

    def carried(self, shift: float, inputs: NDArray[np.float64] | None = None) -> float:
        """Axial load (N) that the bearing carries at an axial displacement (m) in its own axes."""
        return -float(self.at(np.array([shift, 0.0, 0.0, 0.0, 0.0]), inputs).force[0])

    def place_under(self, load: float, inputs: NDArray[np.float64] | None = None) -> float:
        """Axial displacement (m) under an axial load (N); without load that where the balls just touch."""
        load = max(load, _TOUCHING)
        low, high = self._bracket(load, inputs)
        while high - low > _CLOSE:
            middle = 0.5 * (low + high)
            if self.carried(middle, inputs) < load:
                low = middle
            else:
                high = middle
        return self._polished(0.5 * (low + high), load, inputs)

    def lifted(self) -> float:
        """Axial displacement (m) at which the bearing ceases to carry, at standstill."""
        still = self.still()
        low, high = self._bracket(_TOUCHING, still)
        while high - low > _CLOSE:
            middle = 0.5 * (low + high)
            if self.carried(middle, still) > 0.0:
                high = middle
            else:
                low = middle
        return low

    def _polished(self, shift: float, load: float, inputs: NDArray[np.float64] | None) -> float:
        """One step of Newton's method, which takes bisection to rounding."""
        here = self.at(np.array([shift, 0.0, 0.0, 0.0, 0.0]), inputs)
        return shift + (load + float(here.force[0])) / max(float(here.stiffness[0, 0]), 1.0)

    def _bracket(self, load: float, inputs: NDArray[np.float64] | None) -> tuple[float, float]:
        """Displacements (m) that carry nothing, and at least ``load``."""
        low, high = -1e-5, 1e-5
        while self.carried(high, inputs) < load:
            high *= 2.0
            if high > _FAR:
                raise EngineError(f"no bearing of this kind carries {load:g} N along its axis")
        while self.carried(low, inputs) > 0.0:
            low *= 2.0
            if low < -_FAR:
                raise EngineError(
                    "the balls are clamped at any place of the ring: rings far too warm or cold"
                )
        return low, high


def _alone(scene: Scene) -> Scene:
    """Return the scene of one perfect bearing of the set."""
    return one_of(with_fidelity(scene, model="full").model_copy(update={"imperfections": None}))


def shaft_speed(scene: Scene) -> float:
    """Speed (rad/s) of a scene's shaft."""
    return scene.operation.speed_rpm * RPM
