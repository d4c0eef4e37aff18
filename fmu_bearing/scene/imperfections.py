"""Imperfections of manufacture; without them a lubricated bearing is silent."""

from collections import Counter
from collections.abc import Iterator

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part
from fmu_bearing.scene.defect import MOST_DEFECTS, Defect

RACES = ("inner", "outer")
#: Highest order of a race's waviness: on a 7003C a wave is then 0.07 mm long, a contact 0.10 mm wide.
HIGHEST_ORDER = 1000
_HARMONICS = 200  # most per race
#: Exponents p of the power law that surfaces are assumed to have.
ASSUMED_EXPONENTS = (1.0, 1.8)
#: What makes vibration and noise, and the keys that take it away.
_SOURCES = {
    "unbalance": ("unbalance_um",),
    "inner race": ("inner_race_amplitude_um", "inner_race_harmonic"),
    "outer race": ("outer_race_amplitude_um", "outer_race_harmonic"),
    "ball sizes": ("ball_diameter_spread_nm",),
    "form of the balls": ("ball_form_nm", "ball_waviness_nm"),
    "defects": ("defect",),
}
#: Keys of arrays, which are taken away by none in them.
_ARRAYS = (*(f"{race}_race_harmonic" for race in RACES), "defect")
_SEEDS = 2**31  # there are


class Harmonic(Part):
    """One harmonic of a race's waviness: amplitude times cos(order times angle + phase)."""

    order: int = Field(ge=1, le=HIGHEST_ORDER, examples=[2], description="Waves per turn.")
    amplitude_um: float = Field(ge=0, le=20, examples=[0.1], description="Amplitude of the harmonic, um.")
    phase_deg: float = Field(
        default=0.0, ge=-720, le=720, examples=[0.0], description="Phase at the race's own zero angle, deg."
    )


class Imperfections(Part):
    """Race waviness, ball form, ball spread, unbalance and local defects; random values are drawn by a seed.

    Each race's waviness is a power law or a list of harmonics. The power law gives order n the amplitude
    A_1 n^-p times the contact filter, with a random phase, from ``lowest_order`` up to ``highest_order``, or
    to the order that sounds at ``highest_frequency_kHz`` at the scene's speed. With ``order_scatter_seed``
    each order lies above or below the law by chance, as on a ring.
    """

    seed: int = Field(
        default=1, ge=0, le=_SEEDS - 1, examples=[1],
        description="Seed from which phases and ball sizes are drawn (absent: 1).",
    )  # fmt: skip
    unbalance_um: float = Field(
        ge=0, le=100, examples=[0.5], description="Eccentricity of the rotating mass, um."
    )
    ball_diameter_spread_nm: float = Field(
        ge=0, le=5000, examples=[50.0], description="Half the range of ball diameters, nm."
    )
    inner_race_amplitude_um: float | None = Field(
        default=None, ge=0, le=20, examples=[0.3],
        description="Waviness of the inner race: amplitude A_1 of order 1 in A_n = A_1 n^-p W(n), um.",
    )  # fmt: skip
    outer_race_amplitude_um: float | None = Field(
        default=None, ge=0, le=20, examples=[0.3],
        description="Waviness of the outer race: amplitude A_1 of order 1 in A_n = A_1 n^-p W(n), um.",
    )  # fmt: skip
    waviness_exponent: float | None = Field(
        default=None, ge=0, le=4, examples=[1.35],
        description="Exponent p of the law A_n = A_1 n^-p W(n) for races and balls; 0: all orders equal.",
    )  # fmt: skip
    order_scatter_seed: int | None = Field(
        default=None, ge=0, le=_SEEDS - 1, examples=[1],
        description="Seed from which each order's energy is drawn about the law of a race, by an exponential "
        "distribution; absent: each order has the law's amplitude.",
    )  # fmt: skip
    lowest_order: int = Field(
        default=2, ge=1, le=HIGHEST_ORDER, examples=[2],
        description="Lowest order of waviness, waves per turn.",
    )  # fmt: skip
    highest_order: int | None = Field(
        default=None, ge=1, le=HIGHEST_ORDER, examples=[60],
        description="Highest order of the races' waviness; absent: by highest_frequency_kHz, waves per turn.",
    )  # fmt: skip
    highest_frequency_kHz: float = Field(
        default=10.0, ge=0.1, le=100, examples=[10.0],
        description="Frequency up to which waves of races and balls excite the bearing at its speed, kHz.",
    )  # fmt: skip
    contact_filter: bool = Field(
        default=True,
        examples=[True],
        description="W(n): a contact does not follow waves that are shorter than itself; false: W = 1.",
    )
    # A file's array arrives as a list: the one conversion that strictness may let pass.
    inner_race_harmonic: tuple[Harmonic, ...] = Field(
        default=(), max_length=_HARMONICS, strict=False, description="Harmonics of the inner race."
    )
    outer_race_harmonic: tuple[Harmonic, ...] = Field(
        default=(), max_length=_HARMONICS, strict=False, description="Harmonics of the outer race."
    )
    ball_form_nm: float = Field(
        default=0.0, ge=0, le=5000, examples=[80.0],
        description="Deviation of the balls from spherical form, peak to valley; 0: round balls, nm.",
    )  # fmt: skip
    ball_waviness_nm: float = Field(
        default=0.0, ge=0, le=5000, examples=[20.0],
        description="Amplitude of one order of the balls' waviness beside that of ball_form_nm; 0: none, nm.",
    )  # fmt: skip
    ball_waviness_order: int = Field(
        default=2, ge=1, le=8, examples=[2],
        description="Order of ball_waviness_nm, a zonal harmonic about one axis fixed in each ball.",
    )  # fmt: skip

    defect: tuple[Defect, ...] = Field(
        default=(), max_length=MOST_DEFECTS, strict=False, description="Local defects of races and balls."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield waviness that is incomplete or given twice, and orders in the wrong sequence."""
        for race in RACES:
            key, table = f"{race}_race_amplitude_um", f"{race}_race_harmonic"
            amplitude, harmonics = getattr(self, key), getattr(self, table)
            if amplitude is not None and harmonics:
                yield Conflict(
                    key, f"cannot be given with [[imperfections.{table}]]: leave out one of the two"
                )
            elif amplitude is None and not harmonics:
                yield Conflict(
                    key,
                    f"is missing, for example {key} = 0.3; or give [[imperfections.{table}]], or "
                    'grade = "P4" for all',
                )
            yield from self._repeated(table)
        yield from self._law_conflicts()

    @property
    def follows_law(self) -> bool:
        """Whether a race or the balls have waviness by the power law."""
        return bool(self.inner_race_amplitude_um or self.outer_race_amplitude_um or self.ball_form_nm)

    @property
    def sources(self) -> tuple[str, ...]:
        """Names of the imperfections that are there: unbalance, races, sizes and form of balls, defects."""
        return tuple(name for name, keys in _SOURCES.items() if any(getattr(self, key) for key in keys))

    def alone(self, source: str) -> "Imperfections":
        """Return one of `sources` without the others; for a name that is not there none is left."""
        gone = [key for name in self.sources if name != source for key in _SOURCES[name]]
        return self.model_copy(update={key: () if key in _ARRAYS else 0.0 for key in gone})

    def of_bearing(self, number: int) -> "Imperfections":
        """Return them with the defects of one bearing of a set alone, as those of a single bearing."""
        if not self.defect:
            return self
        own = (one.model_copy(update={"bearing": None}) for one in self.defect if one.bearing == number)
        return self.model_copy(update={"defect": tuple(own)})

    def redrawn(self, count: int, apart: int = 1) -> "Iterator[Imperfections]":
        """Yield the same imperfections with ``count`` other seeds after its own; by `Scene.seeds_apart`."""
        for k in range(count):
            yield self.reseeded((1 + k) * apart)

    def reseeded(self, by: int) -> "Imperfections":
        """Return the same imperfections with each of its seeds moved by ``by``; defects are as they were."""
        seeds = {"seed": self.seed, "order_scatter_seed": self.order_scatter_seed}
        moved = {key: (seed + by) % _SEEDS for key, seed in seeds.items() if seed is not None}
        return self.model_copy(update=moved)

    def _repeated(self, table: str) -> Iterator[Conflict]:
        counted = Counter(harmonic.order for harmonic in getattr(self, table))
        for order, count in sorted(counted.items()):
            if count > 1:
                yield Conflict(table, f"order {order} is given more than once")

    def _law_conflicts(self) -> Iterator[Conflict]:
        if self.follows_law and self.waviness_exponent is None:
            yield Conflict(
                "waviness_exponent",
                "is missing, for example waviness_exponent = 1.35: amplitudes are A_1 of the law "
                "A_n = A_1 n^-p; 0 gives every order the same amplitude, as files before the law had",
            )
        both_explicit = all((self.inner_race_harmonic, self.outer_race_harmonic))
        if self.order_scatter_seed is not None and both_explicit:
            yield Conflict(
                "order_scatter_seed", "has no meaning where both races have explicit harmonics: leave it out"
            )
        if self.highest_order is not None:
            if both_explicit:
                yield Conflict(
                    "highest_order", "has no meaning where both races have explicit harmonics: leave it out"
                )
            elif self.highest_order < self.lowest_order:
                yield Conflict("highest_order", f"must not be below lowest_order = {self.lowest_order}")
