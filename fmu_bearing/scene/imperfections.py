"""Imperfections of manufacture; without them a lubricated bearing is silent."""

from pydantic import Field, model_validator

from fmu_bearing.scene.base import Part


class Imperfections(Part):
    """Race waviness by orders with random phases, ball spread and unbalance, drawn from a seed."""

    seed: int = Field(ge=0, le=2**31 - 1, examples=[1], description="seed of phases and ball sizes")
    unbalance_um: float = Field(ge=0, le=100, examples=[0.5], description="eccentricity of the rotating mass")
    ball_diameter_spread_nm: float = Field(
        ge=0, le=5000, examples=[50.0], description="half range of diameters"
    )
    inner_race_amplitude_um: float = Field(ge=0, le=5, examples=[0.1], description="amplitude per order")
    outer_race_amplitude_um: float = Field(ge=0, le=5, examples=[0.1], description="amplitude per order")
    lowest_order: int = Field(ge=1, le=200, examples=[2], description="lowest order, waves per turn")
    highest_order: int = Field(ge=1, le=200, examples=[20], description="highest order, waves per turn")

    @model_validator(mode="after")
    def _orders(self) -> "Imperfections":
        if self.highest_order < self.lowest_order:
            raise ValueError(
                f"highest_order = {self.highest_order} must not be below lowest_order = {self.lowest_order}"
            )
        return self
