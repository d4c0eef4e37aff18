"""One bearing of a set by itself: what it carries at a prescribed displacement of its rings."""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from fmu_bearing.arrays import REASONS
from fmu_bearing.compiled import call
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.layout import EQ, SP, C, P, Q, S, U, W
from fmu_bearing.engine.status import OK
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.scene.member import HELD, set_of
from fmu_bearing.steady.rest import TOUCHING, parts, per_bearing

_FREEDOMS = EQ.FREEDOMS
_CLOSE = 1e-13  # m: where a bearing ceases to carry; 1e-5 N at the stiffness of a spindle bearing
_FAR = 1e-3  # m: no bearing is pushed so far


class Member:
    """A bearing of a set, with the parameters and temperatures that a started engine has.

    Parameters
    ----------
    run : Instance
        Of a set, see `rest.started`.
    number : int
        From 0.

    Attributes
    ----------
    sign : float
        1 where it carries force on the shaft towards +X, else -1.
    offset : float
        Axial place (m) of its inner ring in its own axes with the shaft at its zero.
    spring : (float, float), optional
        Force (N) and stiffness (N/m) behind an outer ring that gives way along its axis by itself: one that
        slides, or on a pedestal of its own.
    """

    def __init__(self, run: Instance, number: int) -> None:
        part = parts(run)[number]
        row = run.p[SP.first(run.p, SP.AT_ROWS) + number * SP.ROW :]
        self.sign = float(row[SP.ROW_SIGN])
        self.offset = float(per_bearing(run, SP.OFFSET)[number])
        self.spring: tuple[float, float] | None = None
        if row[SP.ROW_SEAT] == SP.SLIDING:
            self.spring = _behind(run)
        elif row[SP.ROW_SEAT] == SP.PEDESTAL:
            self.spring = 0.0, float(part.s[S.C + C.PEDESTAL_AXIAL])
        self.still = np.zeros(U.SIZE)  # inputs at standstill
        self.still[U.PEDESTAL] = HELD
        self.still[U.SHAFT_T : U.BEARINGS] = run.u[U.SHAFT_T : U.BEARINGS]
        self.still[U.BEARINGS :] = run.u[U.BEARINGS + number * U.ROW :][: U.ROW]
        self.parameters = part.p.copy()
        self.parameters[P.SET] = 0.0
        self._c, self._out = np.zeros(C.SIZE), np.zeros(EQ.SIZE)
        self._force, self._w = np.zeros(_FREEDOMS), np.zeros(W.size(self.parameters))

    def warmer(self, rise: float) -> NDArray[np.float64]:
        """Return inputs of standstill at 20 degC with inner ring and shaft warmer by ``rise`` (K)."""
        inputs = self.still.copy()
        inputs[U.SHAFT_T :] = REFERENCE_TEMPERATURE
        inputs[[U.INNER_T, U.SHAFT_T]] += rise
        return inputs

    def carried(self, shift: float, inputs: NDArray[np.float64] | None = None) -> float:
        """Axial load (N) that the bearing carries at an axial place (m) of its inner ring against the outer.

        ``inputs``: of the engine, ``layout.U``; default: standstill at its temperatures.

        Raises
        ------
        EngineError
            Where the balls find no place.
        """
        ring = np.array([shift, 0.0, 0.0, 0.0, 0.0])
        inputs = self.still if inputs is None else inputs
        status = call(
            "forces_at_displacement", self.parameters, inputs, self._c, ring, self._force, self._out, self._w
        )
        if status != OK:
            raise EngineError(REASONS[status])
        return -float(self._force[Q.X])

    def place_under(self, load: float, inputs: NDArray[np.float64]) -> float:
        """Axial place (m) under an axial load (N); without load the place where the balls just touch."""
        load = max(load, TOUCHING)
        low, high = self._between(load, inputs)
        return float(brentq(lambda place: self.carried(place, inputs) - load, low, high, xtol=1e-15))

    def lifted(self) -> float:
        """Axial place (m) at which the bearing ceases to carry, at standstill."""
        low, high = self._between(TOUCHING, self.still)
        while high - low > _CLOSE:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self.carried(middle) > 0.0 else (middle, high)
        return low

    def _between(self, load: float, inputs: NDArray[np.float64]) -> tuple[float, float]:
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


def _behind(run: Instance) -> tuple[float, float]:
    """Force (N) and stiffness (N/m) of the springs behind sliding rings; none: they carry nothing."""
    preload = set_of(run.model.scene).preload
    if preload is None or preload.kind != "spring":
        return 0.0, 0.0
    return float(run.u[U.PRELOAD]), preload.stiffness_N_m or 0.0
