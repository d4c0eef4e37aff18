"""`Surface`: the law of a bearing's surfaces with its uncertainty, as found from measured vibration."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.imperfections import RACES, Imperfections
from fmu_bearing.scene.scene import Tables

Given = TypeVar("Given", bound=Tables)
#: Share of the draws between the ends of a range.
_SHARE = 0.95
#: Keys of a scene that a surface gives.
KEYS = (*(f"{race}_race_amplitude_um" for race in RACES), "waviness_exponent", "ball_form_nm")
#: Unknown numbers, in the order of `Surface.covariance`.
NUMBERS = ("ln A_1", "p", "ln of the form of the balls")
_ORDER = 12  # waves per turn: the order that races' amplitudes are compared at


class Range(NamedTuple):
    """Median of a quantity, and the ends between which 95 % of its draws lie."""

    median: float
    low: float
    high: float


class Law(NamedTuple):
    """Numbers of the law: amplitude A_1 (um) and exponent p of both races, form of the balls (nm)."""

    amplitude_um: Range
    exponent: Range
    ball_form_nm: Range


@dataclass(frozen=True, eq=False)
class Surface:
    """Surfaces that explain a measurement: equally likely draws of their law, races and balls.

    Attributes
    ----------
    bearing : str
        What was measured.
    measured : str
        What was measured of it, in words.
    amplitude_um, exponent, ball_form_nm : ndarray, shape (draws,)
        A_1 (um) and p of the law of both races, deviation of the balls from spherical form (nm).
    seed : ndarray of int, shape (draws,)
        Seed of phases and of the axes of the balls.
    order_scatter_seed : ndarray of int, shape (draws,), or None
        Seed from which orders scatter about the law; None: the law holds exactly.
    remarks : tuple of str
        How far the measurement decides, and what to measure next.

    Examples
    --------
    >>> import numpy as np
    >>> from fmu_bearing import Surface, read_scene
    >>> three, law = np.full(3, 0.3), np.array([1.3, 1.4, 1.5])
    >>> found = Surface("7003C", "L = 41 um/s", three, law, 200.0 * three, np.arange(3))
    >>> round(found.order(12).median, 1)  # nm
    9.3
    >>> found.scene(read_scene("examples/scenes/7003C-bare.toml")).imperfections.waviness_exponent
    1.4
    """

    bearing: str
    measured: str
    amplitude_um: NDArray[np.float64]
    exponent: NDArray[np.float64]
    ball_form_nm: NDArray[np.float64]
    seed: NDArray[np.int64]
    order_scatter_seed: NDArray[np.int64] | None = None
    remarks: tuple[str, ...] = ()

    def __len__(self) -> int:
        """How many draws there are."""
        return len(self.amplitude_um)

    @property
    def words(self) -> str:
        """What was measured, of which bearing."""
        return f"{self.bearing} with {self.measured}"

    @property
    def law(self) -> Law:
        """Median and 95 % of each number of the law."""
        return Law(*(_range(of) for of in (self.amplitude_um, self.exponent, self.ball_form_nm)))

    @property
    def covariance(self) -> NDArray[np.float64]:
        """Covariance of `NUMBERS`, shape (3, 3)."""
        return np.cov([np.log(self.amplitude_um), self.exponent, np.log(self.ball_form_nm)])

    @property
    def correlation(self) -> NDArray[np.float64]:
        """Correlation of `NUMBERS`, shape (3, 3)."""
        covariance = self.covariance
        deviations = np.sqrt(np.diag(covariance))
        return covariance / np.maximum(np.outer(deviations, deviations), 1e-300)

    def order(self, n: int = _ORDER) -> Range:
        """Median and 95 % of the law's amplitude (nm) of an order n of a race, without scatter."""
        return _range(1e3 * self.amplitude_um * float(n) ** -self.exponent)

    def draws(
        self, count: int | None = None, flaws: Imperfections | None = None
    ) -> tuple[Imperfections, ...]:
        """Return imperfections that explain the measurement, equally likely ones.

        Parameters
        ----------
        count : int, optional
            How many, from the first on; default: all.
        flaws : Imperfections, optional
            What is no part of the law (unbalance, ball sizes, band) is taken from these; default: there is no
            unbalance, and balls are equal.

        Raises
        ------
        ValueError
            For more than there are.
        """
        count = len(self) if count is None else count
        if not 1 <= count <= len(self):
            raise ValueError(f"{count} draws of a surface that holds {len(self)}: give 1 to {len(self)}")
        base = flaws or Imperfections.model_validate(
            {"seed": 0, "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0} | self._values(0)
        )
        return tuple(base.model_copy(update=self._values(k) | self._seeds(k)) for k in range(count))

    def median(self) -> dict[str, float]:
        """Return the median law by key of a scene's ``[imperfections]``."""
        law = self.law
        values = (law.amplitude_um, law.amplitude_um, law.exponent, law.ball_form_nm)
        return {key: float(f"{of.median:.5g}") for key, of in zip(KEYS, values, strict=True)}

    def scene(self, scene: Given) -> Given:
        """Return a scene with the median law in the place of its own; its seeds stay.

        Raises
        ------
        SceneError
            For a scene without imperfections, or with explicit harmonics.
        """
        flaws = scene.imperfections
        check_taken(flaws, scene.name)
        assert flaws is not None
        return scene.model_copy(update={"imperfections": flaws.model_copy(update=self.median())})

    def rows(self) -> tuple[list[str], list[list[str]]]:
        """Columns and rows of a table of the law: order 12 first, which A_1 and p together decide."""
        law = self.law
        named = [
            (f"order {_ORDER} of the races, nm", self.order()),
            ("amplitude A_1 of the races, um", law.amplitude_um),
            ("exponent p", law.exponent),
            ("form of the balls, nm", law.ball_form_nm),
        ]
        return ["value", "median", "95 %"], [
            [name, f"{of.median:.3g}", f"{of.low:.3g} to {of.high:.3g}"] for name, of in named
        ]

    def _values(self, k: int) -> dict[str, float]:
        amplitude = float(self.amplitude_um[k])
        values = (amplitude, amplitude, float(self.exponent[k]), float(self.ball_form_nm[k]))
        return dict(zip(KEYS, values, strict=True))

    def _seeds(self, k: int) -> dict[str, int | None]:
        scatter = None if self.order_scatter_seed is None else int(self.order_scatter_seed[k])
        return {"seed": int(self.seed[k]), "order_scatter_seed": scatter}


def check_taken(flaws: Imperfections | None, name: str) -> None:
    """Refuse imperfections that have no law whose numbers a surface could replace.

    Raises
    ------
    SceneError
        Without imperfections, and for explicit harmonics.
    """
    if flaws is None:
        raise SceneError(f'{name}: imperfections is missing, for example grade = "P4": a surface is its law')
    explicit = [f"{race}_race_harmonic" for race in RACES if getattr(flaws, f"{race}_race_harmonic")]
    if explicit:
        raise SceneError(
            f"{name}: [[imperfections.{explicit[0]}]] says what the waves are, and a surface is a law: leave "
            "the harmonics out"
        )


def _range(values: NDArray[np.float64] | Sequence[float]) -> Range:
    low, median, high = np.quantile(values, [0.5 - 0.5 * _SHARE, 0.5, 0.5 + 0.5 * _SHARE])
    return Range(float(median), float(low), float(high))
