"""The recording of a report, with checks for values that it may lack."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.design.operating_point import OperatingPoint, operating_point
from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import EngineError
from fmu_bearing.recording.record import Recording
from fmu_bearing.reports.page.blocks import Absent
from fmu_bearing.scene import Scene
from fmu_bearing.scene.origins import Origin


@dataclass(eq=False)
class Subject:
    """A recording with its origin, remarks and warnings.

    Attributes
    ----------
    recording : Recording
    radiation_model : str
        Used in this report.
    source : str
        Where it came from, in words.
    scene_text : str
        The scene file as it was read, with its remarks; empty where there is none.
    origins : list of Origin
        Where each value of that file comes from.
    warnings : list of str
        Warnings of the run.
    radius : float
        Of the sphere on which directivity is shown (m).
    """

    recording: Recording
    radiation_model: str
    source: str = ""
    scene_text: str = ""
    origins: list[Origin] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    radius: float = 1.0

    @property
    def scene(self) -> Scene:
        """The scene; `Absent` without."""
        if self.recording.scene is None:
            raise Absent("the recording does not say which scene it is of")
        return self.recording.scene

    @property
    def several(self) -> bool:
        """Whether the scene is of bearings on a shaft."""
        return self.recording.scene is not None and self.recording.scene.assembly.joined

    @property
    def prefixes(self) -> dict[str, str]:
        """Prefixes of the variables of each bearing by words for it; of a single bearing both are empty."""
        if not self.several:
            return {"": ""}
        return {f"bearing {bearing.number}": bearing.prefix for bearing in self.scene.bearings()}

    @property
    def at_speed(self) -> Scene:
        """The scene at the mean speed of the run; `Absent` without."""
        return self.scene.replace({"operation.speed_rpm": self.speed / RPM})

    @cached_property
    def point(self) -> OperatingPoint:
        """Operating point at the mean speed, of perfect bearings; `Absent` without scene or equilibrium."""
        scene = self.at_speed
        try:
            return operating_point(scene)
        except EngineError as problem:
            raise Absent(str(problem)) from None

    @property
    def fidelity(self) -> str:
        """Fidelity; empty without scene."""
        return "" if self.recording.scene is None else self.recording.scene.fidelity.model

    @cached_property
    def within(self) -> NDArray[np.bool_]:
        """Which communication points are within the recording, shape (points,)."""
        time, start = self.recording.output_time, self.recording.start
        end = start + self.recording.size / self.recording.rate
        within: NDArray[np.bool_] = (time >= start - 1e-9) & (time <= end + 1e-9)
        return within

    @property
    def time(self) -> NDArray[np.float64]:
        """Communication points within the recording (s after initialisation)."""
        return np.asarray(self.recording.output_time[self.within])

    @property
    def step(self) -> float:
        """Time (s) between communication points."""
        return float(np.mean(np.diff(self.time)))

    def has(self, *names: str) -> bool:
        """Whether all of these variables were kept."""
        return all(name in self.recording.outputs for name in names)

    def output(self, name: str) -> NDArray[np.float64]:
        """Variable at `time`, SI units; `Absent` where it was not kept."""
        if name not in self.recording.outputs:
            raise Absent(
                f"the recording did not keep {name}: make the report from the scene, or record with "
                f'outputs=("{name}", ...)'
            )
        return np.asarray(self.recording.outputs[name][self.within])

    def whole(self, name: str) -> NDArray[np.float64]:
        """Variable of all bearings together: as it was kept, else the sum over them."""
        if self.has(name) or not self.several:
            return self.output(name)
        return np.sum([self.output(prefix + name) for prefix in self.prefixes.values()], axis=0)

    def mean(self, name: str) -> float:
        """Mean of a variable over the recording."""
        return float(np.mean(self.output(name)))

    @cached_property
    def kinematics(self) -> dict[str, KinematicFrequencies]:
        """Kinematic frequencies (Hz) by whose they are, see `kinematics_by_name`; `Absent` without scene."""
        assert self.scene is not None
        return self.recording.kinematics_by_name()

    @property
    def speed(self) -> float:
        """Mean shaft speed (rad/s)."""
        return float(np.mean(self.recording.speed))

    @property
    def turn(self) -> float:
        """Time of one turn of the shaft (s); infinite at rest."""
        return 2.0 * math.pi / abs(self.speed) if abs(self.speed) > 1e-6 else math.inf
