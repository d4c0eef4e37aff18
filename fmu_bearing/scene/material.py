"""Materials of rings, balls and cage."""

from pydantic import Field

from fmu_bearing.scene.base import Part


class Material(Part):
    """An isotropic elastic material."""

    youngs_modulus_GPa: float = Field(ge=0.5, le=1200, description="Young's modulus, GPa.", examples=[208.0])
    poisson_ratio: float = Field(ge=0.05, le=0.49, description="Poisson's ratio.", examples=[0.3])
    density_kg_m3: float = Field(ge=500, le=20000, description="Density, kg/m3.", examples=[7800.0])
    expansion_1e6_K: float = Field(
        ge=0, le=200, description="Linear thermal expansion from 20 degC, 1e-6/K.", examples=[11.8]
    )


class Materials(Part):
    """Material of each component: a catalogue name or a table of constants."""

    inner_ring: Material = Field(examples=["GCr15"], description="Material of the inner ring.")
    outer_ring: Material = Field(examples=["GCr15"], description="Material of the outer ring.")
    balls: Material = Field(examples=["Si3N4"], description="Material of the balls.")
    cage: Material | None = Field(
        default=None, examples=["bakelite"], description="Material of the cage; needed where there is one."
    )
