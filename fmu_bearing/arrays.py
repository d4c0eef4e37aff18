"""A bearing, or a set, as flat arrays: made, initialised, stepped, saved and restored; refusals in words."""

from collections.abc import Mapping, Sequence
from typing import Self

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.compiled import Calls
from fmu_bearing.engine.layout import SP, P, Q, S, U, Y
from fmu_bearing.engine.status import (
    BAD_INPUT,
    BAD_STEP,
    DEEP_DEFECT,
    NO_START,
    NOT_CONVERGED,
    OK,
    OTHER_FIDELITY,
    RIGID_ONLY,
    TOO_SOFT,
)
from fmu_bearing.interface.inputs import input_values
from fmu_bearing.prepare.lengths import lengths, parts_of
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import Scene, exclusions
from fmu_bearing.scene.imperfections import RACES

#: Places in ``y`` of the six ring velocities: inner x, y, z, outer x, y, z.
RINGS = np.array([Y.V0, Y.V0 + 1, Y.V0 + 2, *(Y.V0 + Q.OUTER + k for k in range(3))])

#: Messages for the status codes of the engine.
REASONS = {
    NOT_CONVERGED: "the equations could not be solved: even the shortest internal steps failed; "
    "change inputs by less at a time, or over more steps; where steps are refused at inputs that were good "
    "before, nothing leads on from this state: put an earlier one back (fmi2SetFMUstate), or begin again "
    "(fmi2Reset, reset())",
    BAD_INPUT: "an input is not finite or outside its range",
    BAD_STEP: "the communication step must be above 0 s and below 1e6 s; give a run in several steps",
    NO_START: "no quasi-static equilibrium was found for these inputs; give more preload, less radial load, "
    "a stiffer pedestal, or loads and a speed some per cent away",
    RIGID_ONLY: exclusions.BENDING.words(),
    OTHER_FIDELITY: "its numbers were prepared for another fidelity: a set in response, or with rings "
    "on pedestals of their own, has numbers for one; bearings on another model's shaft have fidelity full "
    "only; prepare the scene in the fidelity wanted (with_fidelity)",
    TOO_SOFT: "the loads push the outer ring sideways by more than 0.3 of the pitch radius; "
    "give a stiffer pedestal or less radial load",
    DEEP_DEFECT: "a local defect (imperfections.defect) drops the most loaded ball by more than it is "
    "pressed into both races, so that balls leave a race there, which fidelity rings does not follow; give "
    "fidelity full, a smaller defect, or more load",
}
# of a set these words differ: loads are those on its shaft
_OF_SETS = {
    NO_START: "no quasi-static equilibrium was found for these inputs; give more preload or less load "
    "on the shaft, and only in directions that a bearing carries, or a stiffer pedestal where there is one",
    TOO_SOFT: "the loads push an outer ring or the housing sideways by more than 0.3 of the pitch radius; "
    "give a stiffer pedestal or less load on the shaft",
}


_WAVES_HIGH = 5.0  # um: as much as loads of some hundred newtons press a contact together
_WAVY = (
    "; the waviness of its races rises by up to {:.3g} um, more than contacts are pressed together: some um. "
    "Give less (imperfections: amplitudes, waviness_exponent, harmonics), or check its unit"
)


def reasons(p: NDArray[np.float64]) -> dict[int, str]:
    """Return what the status codes of the engine mean for the parameters of a bearing, or of a set."""
    texts = REASONS | _OF_SETS if SP.has_shaft(p) else REASONS
    first, values = int(p[P.AT_WAVES]), len(RACES) * 2 * int(p[P.WAVE_INTERVALS])  # heights and slopes
    highest = 1e6 * float(np.abs(p[first : first + values : 2]).max()) if p[P.WAVINESS] else 0.0
    return texts | {NO_START: texts[NO_START] + _WAVY.format(highest)} if highest > _WAVES_HIGH else texts


class EngineError(ValueError):
    """The engine refused; the bearing is as it was before the call."""


class Arrays:
    """Parameters, inputs, state, outputs and work space of one bearing, or of a set.

    Parameters
    ----------
    p, u : ndarray
        Parameters (`prepare.model.pack`) and inputs, kept as they are.
    """

    def __init__(self, p: NDArray[np.float64], u: NDArray[np.float64]) -> None:
        self.p, self.u = p, u
        sizes = lengths(p)
        self.s, self.z, self.w = (np.zeros(n) for n in (sizes.state, sizes.outputs, sizes.work))
        #: The compiled entries, bound to the arrays: these stay where they are.
        self.calls = Calls(self.p, self.u, self.s, self.z, self.w)

    @classmethod
    def of(cls, scene: Scene, *sounds: NDArray[np.float64], **parameters: float) -> Self:
        """Return the arrays of a scene at its own speed, loads and temperatures.

        ``sounds``: the sound block of each bearing (``prepare.sound_block.sound_blocks``); default: no sound.
        ``parameters``: values for places of ``p`` by their names in ``layout.p``, as ``TOLERANCE=1e-5``.
        """
        return cls.sensing(scene, sounds, None, **parameters)

    @classmethod
    def sensing(
        cls,
        scene: Scene,
        sounds: Sequence[NDArray[np.float64]],
        sensors: Sequence[NDArray[np.float64]] | None,
        /,
        **parameters: float,
    ) -> Self:
        """As `of`; ``sensors``: `prepare.accelerometers.sensor_blocks`; None: no accelerometers."""
        packed = pack(scene, *(sounds or [np.empty(0)]), sensors=sensors)
        return cls(_fixed(packed, parameters), input_values(scene))

    def at(self, inputs: Mapping[int, float]) -> Self:
        """Return these arrays with inputs set, by their places in ``u``, SI units."""
        for place, value in inputs.items():
            self.u[place] = value
        return self

    def init(self) -> Self:
        """Return these arrays in the quasi-static state at the inputs; ``EngineError`` if there is none."""
        status = self.calls.init(0.0)
        if status != OK:
            raise EngineError(f"initialisation: {self.reason(status)}")
        return self

    def step(self, h: float) -> None:
        """Advance by ``h`` (s); ``EngineError`` if the engine refuses."""
        begin = self.s[S.TIME]
        status = self.calls.step(h)
        if status != OK:
            raise EngineError(f"step to {begin + h:.6g} s: {self.reason(status)}")

    def reason(self, status: int) -> str:
        """Return what a status code of the engine means for this bearing, or this set."""
        return reasons(self.p)[status]

    def run(self, duration: float, h: float) -> None:
        """Advance by ``duration`` in communication steps of ``h`` (s)."""
        for _ in range(round(duration / h)):
            self.step(h)

    def rings(self, duration: float, sample: float) -> NDArray[np.float64]:
        """Ring velocities (m/s) after each of the communication steps ``sample`` (s).

        Six columns, of a set six for each bearing.
        """
        p, first = self.p, SP.first(self.p, SP.AT_ROWS)
        begins = p[first : first + int(p[int(p[P.SET]) + SP.BEARINGS]) * SP.ROW][SP.ROW_Z :: SP.ROW]
        places = (begins.astype(int)[:, None] + np.arange(RINGS.size)).ravel()
        rows = np.empty((round(duration / sample), places.size))
        for row in rows:
            self.step(sample)
            row[:] = self.z[places]
        return rows

    @property
    def temperatures(self) -> NDArray[np.int64]:
        """Places in ``u`` of all temperatures."""
        return np.arange(U.SHAFT_T, self.u.size)

    def with_parameters(self, **parameters: float) -> "Arrays":
        """Copy with other parameters and the same inputs and state; it works on its own arrays."""
        other = Arrays(_fixed(self.p.copy(), parameters), self.u.copy())
        other.s[:], other.z[:] = self.s, self.z
        # Newton's memory belongs to the old parameters: no factors, a first step that suits the new bound
        for _, part in parts_of(other.p):
            other.s[part][[S.FACTOR_STEP, S.JACOBIAN_TIME]] = 0.0, -1e300
        other.s[S.STEP] = min(other.s[S.STEP], other.p[P.MAX_STEP])
        return other


def _fixed(p: NDArray[np.float64], values: Mapping[str, float]) -> NDArray[np.float64]:
    """Return parameters with values by their names in ``layout.p``; from then on they stay."""
    for name, value in values.items():
        p[getattr(P, name)] = value
    p.setflags(write=False)
    return p
