"""Imperfections of manufacture; without them a lubricated bearing is silent."""

from collections.abc import Iterator

from pydantic import Field

from fmu_bearing.scene.base import Conflict, Part


class Imperfections(Part):
    """Race waviness by orders with random phases, ball spread and unbalance, drawn from a seed."""

    seed: int = Field(
        ge=0, le=2**31 - 1, examples=[1], description="Seed from which phases and ball sizes are drawn."
    )
    unbalance_um: float = Field(
        ge=0, le=100, examples=[0.5], description="Eccentricity of the rotating mass, um."
    )
    ball_diameter_spread_nm: float = Field(
        ge=0, le=5000, examples=[50.0], description="Half the range of ball diameters, nm."
    )
    inner_race_amplitude_um: float = Field(
        ge=0, le=5, examples=[0.1], description="Waviness amplitude of the inner race in each order, um."
    )
    outer_race_amplitude_um: float = Field(
        ge=0, le=5, examples=[0.1], description="Waviness amplitude of the outer race in each order, um."
    )
    lowest_order: int = Field(
        ge=1, le=200, examples=[2], description="Lowest order of waviness, in waves per turn."
    )
    highest_order: int = Field(
        ge=1, le=200, examples=[20], description="Highest order of waviness, in waves per turn."
    )

    def conflicts(self) -> Iterator[Conflict]:
        """Yield orders that stand the wrong way round."""
        if self.highest_order < self.lowest_order:
            yield Conflict("highest_order", f"must not be below lowest_order = {self.lowest_order}")
