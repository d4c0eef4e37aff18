"""Oil and what it does in contacts, lands and around the balls."""

from pydantic import Field

from fmu_bearing.scene.base import Part


class Lubricant(Part):
    """Lubricant; viscosity follows Vogel's law through its value at 20 degC."""

    viscosity_Pa_s: float = Field(
        ge=1e-3, le=2, examples=[0.03], description="Dynamic viscosity at 20 degC, Pa s."
    )
    pressure_viscosity_1_GPa: float = Field(
        ge=1, le=50, examples=[20.0], description="Pressure-viscosity coefficient, 1/GPa."
    )
    density_kg_m3: float = Field(ge=500, le=2000, examples=[870.0], description="Density of the oil, kg/m3.")
    vogel_B_K: float = Field(
        ge=0, le=3000, examples=[879.0], description="Constant B of Vogel's viscosity exp(B/(T - C)), K."
    )
    vogel_C_K: float = Field(
        ge=50, le=220, examples=[178.0], description="Constant C of Vogel's viscosity exp(B/(T - C)), K."
    )
    traction_max: float = Field(
        ge=0, le=0.5, examples=[0.05], description="Largest traction over the contact's load."
    )
    traction_slide_to_roll: float = Field(
        ge=1e-4, le=0.5, examples=[0.005], description="Slide-to-roll ratio at which traction saturates."
    )
    traction_floor_m_s: float = Field(
        ge=1e-4,
        le=1,
        examples=[1e-3],
        description="Least sliding speed at which traction saturates, however slow the rolling, m/s.",
    )
    land_viscosity_Pa_s: float = Field(
        ge=0, le=2, examples=[0.006], description="Effective viscosity between cage and lands, Pa s."
    )
    replenishment_constant: float = Field(
        ge=0, le=1e-6, examples=[6e-8], description="Replenishment constant K_rs of SKF's friction model."
    )
    oil_air_density_kg_m3: float = Field(
        ge=0, le=1000, examples=[5.0], description="Density of the oil-air mixture around the balls, kg/m3."
    )
    drag_coefficient: float = Field(
        ge=0, le=5, examples=[0.5], description="Drag coefficient of a ball in that mixture."
    )
