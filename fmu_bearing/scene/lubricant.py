"""Oil and what it does in contacts, lands and around the balls."""

from pydantic import Field

from fmu_bearing.scene.base import Part


class Lubricant(Part):
    """Lubricant; viscosity follows Vogel's law through its value at 20 degC."""

    viscosity_Pa_s: float = Field(ge=1e-3, le=2, examples=[0.03], description="dynamic viscosity at 20 degC")
    pressure_viscosity_1_GPa: float = Field(ge=1, le=50, examples=[20.0], description="pressure-viscosity")
    density_kg_m3: float = Field(ge=500, le=2000, examples=[870.0], description="density of the oil")
    vogel_B_K: float = Field(ge=0, le=3000, examples=[879.0], description="Vogel constant B")
    vogel_C_K: float = Field(ge=50, le=220, examples=[178.0], description="Vogel constant C")
    traction_max: float = Field(ge=0, le=0.5, examples=[0.05], description="largest traction over load")
    traction_slide_to_roll: float = Field(
        ge=1e-4, le=0.5, examples=[0.005], description="slide-to-roll ratio at which traction saturates"
    )
    traction_floor_m_s: float = Field(
        ge=1e-4, le=1, examples=[1e-3], description="floor of the sliding speed at which traction saturates"
    )
    land_viscosity_Pa_s: float = Field(
        ge=0, le=2, examples=[0.006], description="viscosity between the lands"
    )
    replenishment_constant: float = Field(
        ge=0, le=1e-6, examples=[6e-8], description="kinematic replenishment constant K_rs (SKF)"
    )
    oil_air_density_kg_m3: float = Field(
        ge=0, le=1000, examples=[5.0], description="density around the balls"
    )
    drag_coefficient: float = Field(ge=0, le=5, examples=[0.5], description="drag coefficient of a ball")
