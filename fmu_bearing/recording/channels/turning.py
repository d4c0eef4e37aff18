"""How fast cage and balls turned in a recorded run, and how the cage whirled."""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, kinematic_frequencies
from fmu_bearing.results.defect_lines import DefectLine, defect_lines
from fmu_bearing.results.rates import by_cage, frequencies, rates_of
from fmu_bearing.scene import Scene, si

#: Variables that are kept of a cage that moves by itself.
WHIRL = ("cage.whirl_radius", "cage.whirl_speed")
_ANGLES = ("contact.inner.angle_mean", "contact.outer.angle_mean")
_RATIO = "cage.speed_ratio"
_STILL = 1e-6  # rad/s
_OFF_CENTRE = 1e-7  # m: nearer to the middle a cage does not whirl, it trembles
_ROUND = 0.5  # share of the radius by which a whirl may vary; of chance motion in the plane it is 0.52


def turned(
    scene: Scene, speed: NDArray[np.float64], outputs: Mapping[str, NDArray[np.float64]]
) -> tuple[KinematicFrequencies, ...] | None:
    """Return the frequencies (Hz) at which each bearing turned in a run; None where it does not say.

    ``speed``: of the shaft (rad/s); ``outputs``: other variables at the same points, by name. Cage and balls
    as they turned in the mean; where only the cage's speed was kept, balls that roll on circles of the size
    that this speed gives.
    """
    mean = float(np.mean(np.abs(speed)))
    if mean < _STILL:
        return None
    rates = rates_of(outputs, scene)
    if rates is not None:
        return tuple(
            frequencies(mean, orbit, spin, bearing.ball_count)
            for bearing, (orbit, spin) in zip(scene.geometries, rates.mean(axis=0).tolist(), strict=True)
        )
    ratios = [outputs.get(bearing.prefix + _RATIO) for bearing in scene.bearings()]
    kept = [values for values in ratios if values is not None]
    if len(kept) < len(ratios):
        return None
    return tuple(
        by_cage(bearing, mean, float(np.sum(values * np.abs(speed)) / np.sum(np.abs(speed))))
        for bearing, values in zip(scene.geometries, kept, strict=True)
    )


def rolling(
    scene: Scene, speed: float, outputs: Mapping[str, NDArray[np.float64]], contact_angle: float | None
) -> tuple[KinematicFrequencies, ...]:
    """Return frequencies (Hz) of each bearing in rolling without sliding at one contact angle (rad).

    Default: the mean of the computed angles where they were kept, of equal bearings over all of them, else
    the nominal one.
    """
    found = []
    for bearing in scene.bearings():
        b, angle, head = si(bearing.scene.bearing), contact_angle, bearing.prefix if scene.differing else ""
        if angle is None:
            kept = [values for name, values in outputs.items()
                    if name.startswith(head) and name.endswith(_ANGLES)]  # fmt: skip
            angle = float(np.mean(kept)) if kept else bearing.scene.bearing.nominal_angle
        found.append(
            kinematic_frequencies(speed, int(b.ball_count), b.ball_diameter, b.pitch_diameter, angle)
        )
    return tuple(found)


def whirls(scene: Scene, outputs: Mapping[str, NDArray[np.float64]]) -> tuple[float, ...]:
    """Return how often (Hz) the cage of each bearing went round off its middle; NaN where it did not.

    In a whirl the cage's centre goes round on a circle, whose radius varies less than that of motion by
    chance.
    """
    frequencies = []
    for bearing in scene.bearings():
        radius, speed = (outputs.get(bearing.prefix + name, np.zeros(1)) for name in WHIRL)
        middle = float(np.mean(radius))
        steady = middle > _OFF_CENTRE and float(np.std(radius)) < _ROUND * middle
        frequencies.append(abs(float(np.mean(speed))) / (2.0 * math.pi) if steady else math.nan)
    return tuple(frequencies)


class Turning(ABC):
    """What a recording says of turning: its part of `ChannelHistory`."""

    scene: Scene | None
    start: float
    output_time: NDArray[np.float64]
    speed_points: NDArray[np.float64]
    outputs: dict[str, NDArray[np.float64]]

    @property
    @abstractmethod
    def speed(self) -> NDArray[np.float64]:
        """Shaft speed at each sample (rad/s)."""

    def kinematics(
        self, speed: float | None = None, contact_angle: float | None = None
    ) -> KinematicFrequencies:
        """Return frequencies (Hz) of the scene's bearing as it turned, of a set the mean of its bearings.

        Parameters
        ----------
        speed : float, optional
            Shaft speed (rad/s); default: mean of the recording.
        contact_angle : float, optional
            In rad: frequencies of rolling at that angle instead of the run's.

        Notes
        -----
        Cage and balls turn as they did in the mean of the run. Of pressures whose run kept neither the rates
        of the balls nor ``cage.speed_ratio`` they are those of rolling at the mean of the contact angles that
        were kept, else at the nominal one.

        Raises
        ------
        ValueError
            When the recording has no scene, and so no bearing, or bearings that differ: see
            `bearing_kinematics`.
        """
        if self._known().differing:
            raise ValueError(
                f"{self._known().name}: its bearings differ, and so do their frequencies: read those of "
                "each (bearing_kinematics)"
            )
        every = self.bearing_kinematics(speed, contact_angle)
        return KinematicFrequencies(*np.mean(every, axis=0).tolist())

    def kinematics_by_name(self, speed: float | None = None) -> dict[str, KinematicFrequencies]:
        """Return frequencies (Hz) by whose they are; ``speed`` as for `kinematics`.

        Of equal bearings their mean, under ""; of bearings that differ each one's, ``bearing 1`` and so on.
        """
        if not self._known().differing:
            return {"": self.kinematics(speed)}
        every = self.bearing_kinematics(speed)
        return {f"bearing {number}": one for number, one in enumerate(every, start=1)}

    @property
    def common_kinematics(self) -> KinematicFrequencies | None:
        """`kinematics`; None without a scene, and where its bearings differ."""
        return None if self.scene is None or self.scene.differing else self.kinematics()

    def bearing_kinematics(
        self, speed: float | None = None, contact_angle: float | None = None
    ) -> tuple[KinematicFrequencies, ...]:
        """Return frequencies (Hz) of each bearing; parameters and errors as for `kinematics`."""
        scene, mean = self._known(), float(np.mean(self.speed))
        w = mean if speed is None else speed
        found = None if contact_angle is not None else self._turned
        if found is None:
            return rolling(scene, w, self.outputs, contact_angle)
        return tuple(
            KinematicFrequencies(*(abs(w) / (2.0 * math.pi) * f / each.f_r for f in each)) for each in found
        )

    def defect_lines(self) -> tuple[DefectLine, ...]:
        """Return the lines (Hz) of the scene's local defects as cage and balls turned; none without scene."""
        if self.scene is None or not self.scene.has_defects:
            return ()
        return defect_lines(self.scene, self.bearing_kinematics())

    @property
    def turning_known(self) -> bool:
        """Whether `kinematics` are those of the run, not of rolling at a contact angle."""
        return self.scene is not None and self._turned is not None

    def whirls(self) -> tuple[float, ...]:
        """Return how often (Hz) the cage of each bearing whirled; NaN: it did not, or was not watched."""
        scene = self._known()
        return whirls(scene, self._kept()[1])

    @property
    def _turned(self) -> tuple[KinematicFrequencies, ...] | None:
        """Frequencies (Hz) of each bearing in the run; None where it does not say."""
        return turned(self._known(), *self._kept())

    def _kept(self) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
        """Return speed and variables at the communication points of the recording, its start left out."""
        kept = self.output_time >= self.start - 1e-9
        kept |= ~kept.any()  # pressures of an FMU come late: a short run may have no later point
        return self.speed_points[kept], {name: values[kept] for name, values in self.outputs.items()}

    def _known(self) -> Scene:
        if self.scene is None:
            raise ValueError(
                "this recording has no scene: give one to Recording.from_fmu, or the frequencies"
            )
        return self.scene
