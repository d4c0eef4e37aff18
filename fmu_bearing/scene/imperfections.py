"""Imperfections of manufacture; without them a lubricated bearing is silent."""

from collections import Counter
from collections.abc import Iterator

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part

RACES = ("inner", "outer")
_HARMONICS = 200  # most per race, and the highest order


class Harmonic(Part):
    """One harmonic of a race's waviness: amplitude times cos(order times angle + phase)."""

    order: int = Field(ge=1, le=_HARMONICS, examples=[2], description="Waves per turn.")
    amplitude_um: float = Field(ge=0, le=5, examples=[0.1], description="Amplitude of the harmonic, um.")
    phase_deg: float = Field(
        default=0.0, ge=-720, le=720, examples=[0.0], description="Phase at the race's own zero angle, deg."
    )


class Imperfections(Part):
    """Race waviness, ball spread, ball waviness and unbalance; random values are drawn from a seed.

    Each race's waviness is either one amplitude for all orders from ``lowest_order`` to ``highest_order``
    with random phases, or a list of harmonics.
    """

    seed: int = Field(
        ge=0, le=2**31 - 1, examples=[1], description="Seed from which phases and ball sizes are drawn."
    )
    unbalance_um: float = Field(
        ge=0, le=100, examples=[0.5], description="Eccentricity of the rotating mass, um."
    )
    ball_diameter_spread_nm: float = Field(
        ge=0, le=5000, examples=[50.0], description="Half the range of ball diameters, nm."
    )
    inner_race_amplitude_um: float | None = Field(
        default=None,
        ge=0,
        le=5,
        examples=[0.1],
        description="Waviness amplitude of the inner race in each order, um.",
    )
    outer_race_amplitude_um: float | None = Field(
        default=None,
        ge=0,
        le=5,
        examples=[0.1],
        description="Waviness amplitude of the outer race in each order, um.",
    )
    lowest_order: int | None = Field(
        default=None, ge=1, le=200, examples=[2], description="Lowest order of waviness, in waves per turn."
    )
    highest_order: int | None = Field(
        default=None, ge=1, le=200, examples=[20], description="Highest order of waviness, in waves per turn."
    )
    # A file's array arrives as a list: the one conversion that strictness may let pass.
    inner_race_harmonic: tuple[Harmonic, ...] = Field(
        default=(), max_length=_HARMONICS, strict=False, description="Harmonics of the inner race."
    )
    outer_race_harmonic: tuple[Harmonic, ...] = Field(
        default=(), max_length=_HARMONICS, strict=False, description="Harmonics of the outer race."
    )
    ball_waviness_nm: float = Field(
        default=0.0,
        ge=0,
        le=5000,
        examples=[20.0],
        description="Waviness amplitude of the balls; 0: round balls, nm.",
    )
    ball_waviness_order: int = Field(
        default=2,
        ge=1,
        le=8,
        examples=[2],
        description="Order of the balls' waviness, a zonal harmonic about one axis fixed in each ball.",
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield waviness that is incomplete or given twice, and orders in the wrong sequence."""
        amplitudes = []
        for race in RACES:
            key, table = f"{race}_race_amplitude_um", f"{race}_race_harmonic"
            amplitude, harmonics = getattr(self, key), getattr(self, table)
            if amplitude is not None and harmonics:
                yield Conflict(key, f"stands beside [[imperfections.{table}]]: leave out one of the two")
            elif amplitude is None and not harmonics:
                yield Conflict(
                    key,
                    f"is missing, for example {key} = 0.1; or give [[imperfections.{table}]], or "
                    'grade = "P4" for all',
                )
            if amplitude is not None:
                amplitudes.append(amplitude)
            yield from self._repeated(table)
        yield from self._order_conflicts(amplitudes)

    def _repeated(self, table: str) -> Iterator[Conflict]:
        counted = Counter(harmonic.order for harmonic in getattr(self, table))
        for order, count in sorted(counted.items()):
            if count > 1:
                yield Conflict(table, f"order {order} stands more than once")

    def _order_conflicts(self, amplitudes: list[float]) -> Iterator[Conflict]:
        for key, example in (("lowest_order", 2), ("highest_order", 20)):
            given = getattr(self, key) is not None
            if any(amplitudes) and not given:
                yield Conflict(key, f"is missing, for example {key} = {example}")
            elif given and all((self.inner_race_harmonic, self.outer_race_harmonic)):
                yield Conflict(key, "has no meaning where both races have explicit harmonics: leave it out")
        low, high = self.lowest_order, self.highest_order
        if low is not None and high is not None and high < low:
            yield Conflict("highest_order", f"must not be below lowest_order = {low}")
