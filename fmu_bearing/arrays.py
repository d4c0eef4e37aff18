"""A bearing, or a set, as flat arrays, for loops that save and restore the state."""

from collections.abc import Mapping
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.compiled import Calls
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE, RPM
from fmu_bearing.engine.layout import SP, P, Q, S, U, Y
from fmu_bearing.engine.status import OK
from fmu_bearing.instance import reasons
from fmu_bearing.interface.table import input_values
from fmu_bearing.prepare.lengths import lengths, parts_of
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import Scene

#: Places in ``y`` of the six ring velocities: inner x, y, z, outer x, y, z.
RINGS = np.array([Y.V0, Y.V0 + 1, Y.V0 + 2, *(Y.V0 + Q.OUTER + k for k in range(3))])


class Refused(RuntimeError):
    """The engine returned a status other than OK."""


class Arrays:
    """Parameters, inputs, state, outputs and work space of one bearing.

    Parameters
    ----------
    scene : Scene
    rpm : float
        Shaft speed (r/min), held.
    load_y, load_z : float
        Radial load on the inner ring (N).
    sound : ndarray, optional
        The scene's sound block (``prepare.sound.sound_block``); default: no sound.
    parameters : float
        Values for places of ``p`` by their names in ``layout.p``, for example ``TOLERANCE=1e-5``.
    """

    def __init__(
        self, scene: Scene, rpm: float, load_y: float = 0.0, load_z: float = 0.0,
        sound: NDArray[np.float64] | None = None, **parameters: float,
    ) -> None:  # fmt: skip
        self.p: NDArray[np.float64] = pack(scene, np.empty(0) if sound is None else sound)
        for name, value in parameters.items():
            self.p[getattr(P, name)] = value
        self.u = np.zeros(len(U.INPUTS))
        self.u[U.SPEED] = rpm * RPM
        self.u[U.PRELOAD] = scene.mounted.preload_N
        self.u[U.PEDESTAL] = scene.mounted.pedestal_stiffness_N_m
        self.u[U.LOAD_Y], self.u[U.LOAD_Z] = load_y, load_z
        self.u[U.OIL_T : U.HOUSING_T + 1] = REFERENCE_TEMPERATURE
        self._allocate()

    def _allocate(self) -> None:
        """Make state, outputs and work space, and bind all arrays."""
        sizes = lengths(self.p)
        self.s, self.z, self.w = (np.zeros(n) for n in (sizes.state, sizes.outputs, sizes.work))
        self._freeze()

    def _freeze(self) -> None:
        """Bind the arrays to the compiled entries; they stay where they are."""
        self.p.setflags(write=False)
        self._calls = Calls(self.p, self.u, self.s, self.z, self.w)

    @classmethod
    def of(cls, scene: Scene, *sounds: NDArray[np.float64], **parameters: float) -> Self:
        """Return the arrays of a scene, of a set too, at its own speed, loads and temperatures.

        ``sounds``: the sound block of each bearing (``prepare.sound.sound_blocks``); default: no sound.
        """
        made = cls.__new__(cls)
        made.p = pack(scene, *(sounds or [np.empty(0)]))
        for name, value in parameters.items():
            made.p[getattr(P, name)] = value
        made.u = input_values(scene)
        made._allocate()
        return made

    @classmethod
    def started(cls, scene: Scene, inputs: Mapping[int, float], *sounds: NDArray[np.float64]) -> Self:
        """Return the arrays of a scene, initialised at its inputs or at those given by their places in ``u``.

        SI units; ``sounds`` as for `of`; ``Refused`` where there is no equilibrium.
        """
        made = cls.of(scene, *sounds)
        for place, value in inputs.items():
            made.u[place] = value
        made.init()
        return made

    def init(self) -> None:
        """Quasi-static state at the inputs; ``Refused`` if there is none."""
        status = self._calls.init(0.0)
        if status != OK:
            raise Refused(f"initialisation: {self._reason(status)}")

    def step(self, h: float) -> None:
        """Advance by ``h`` (s); ``Refused`` if the engine does."""
        begin = self.s[S.TIME]
        status = self._calls.step(h)
        if status != OK:
            raise Refused(f"step to {begin + h:.6g} s: {self._reason(status)}")

    def _reason(self, status: int) -> str:
        return reasons(self.p)[status]

    def run(self, duration: float, h: float) -> None:
        """Advance by ``duration`` in communication steps of ``h`` (s)."""
        for _ in range(round(duration / h)):
            self.step(h)

    def rings(self, duration: float, sample: float) -> NDArray[np.float64]:
        """Ring velocities (m/s) after each of the communication steps ``sample`` (s).

        Six columns, of a set six for each bearing.
        """
        places = np.concatenate([first + np.arange(RINGS.size) for first in self.outputs_of_bearings])
        rows = np.empty((round(duration / sample), places.size))
        for row in rows:
            self.step(sample)
            row[:] = self.z[places]
        return rows

    @property
    def temperatures(self) -> NDArray[np.int64]:
        """Places in ``u`` of all temperatures."""
        if not SP.has_shaft(self.p):
            return np.arange(U.OIL_T, U.HOUSING_T + 1)
        return np.array([SP.U_SHAFT_T, SP.U_HOUSING_T, *range(SP.U_BEARINGS, self.u.size)])

    @property
    def outputs_of_bearings(self) -> list[int]:
        """Where the outputs of each bearing begin in ``z``."""
        p = self.p
        first, count = SP.first(p, SP.AT_ROWS), int(p[int(p[P.SET]) + SP.BEARINGS])
        return [int(p[first + b * SP.ROW + SP.ROW_Z]) for b in range(count)]

    def with_parameters(self, **parameters: float) -> "Arrays":
        """Copy with other parameters and the same inputs and state; it works on its own arrays."""
        other = object.__new__(Arrays)
        other.p = self.p.copy()
        for name, value in parameters.items():
            other.p[getattr(P, name)] = value
        other.u, other.s, other.z, other.w = (a.copy() for a in (self.u, self.s, self.z, self.w))
        other._freeze()
        # Newton's memory belongs to the old parameters: no factors, a first step that suits the new bound
        for _, part in parts_of(other.p):
            other.s[part][[S.FACTOR_STEP, S.JACOBIAN_TIME]] = 0.0, -1e300
        other.s[S.STEP] = min(other.s[S.STEP], other.p[P.MAX_STEP])
        return other
