"""Materials of rings, balls and cage."""

from typing import Literal

from pydantic import Field

from fmu_bearing.scene.base import Part

#: Loss of bearing steel: Houpert (1999), as in Balan, Houpert, Tufescu and Olaru (2015), eq. 9, on a circular
#: contact. Sources have 0.003 to 0.05.
_STEEL_LOSS = 0.021
#: Steels of bearings, and ceramics, by density (kg/m3) and Young's modulus (GPa).
_STEEL_DENSITY, _STEEL_MODULUS = (7000.0, 8500.0), (180.0, 230.0)
_CERAMIC_DENSITY, _CERAMIC_MODULUS = 6500.0, 180.0


class Material(Part):
    """An isotropic elastic material."""

    youngs_modulus_GPa: float = Field(ge=0.5, le=1200, description="Young's modulus, GPa.", examples=[208.0])
    poisson_ratio: float = Field(ge=0.05, le=0.49, description="Poisson's ratio.", examples=[0.3])
    density_kg_m3: float = Field(ge=500, le=20000, description="Density, kg/m3.", examples=[7800.0])
    expansion_1e6_K: float = Field(
        ge=0, le=200, description="Linear thermal expansion from 20 degC, 1e-6/K.", examples=[11.8]
    )
    bending_strength_MPa: float | None = Field(
        default=None, ge=1, le=10000, examples=[900.0],
        description="Mean bending strength of bars of 3 x 4 x 30 mm in three points, for the chance that a "
        "ceramic ring breaks (absent: not judged), MPa.",
    )  # fmt: skip
    weibull_modulus: float | None = Field(
        default=None, ge=1, le=100, examples=[12.0],
        description="Weibull modulus of the strength: the larger, the less it scatters (absent: not judged).",
    )  # fmt: skip
    hysteresis_loss: float | None = Field(
        default=None, ge=0, le=1, examples=[0.021],
        description="Share of the elastic work of a rolling contact that the material does not give back "
        "(absent: 0.021 for steel, 0 for others).",
    )  # fmt: skip

    conductivity_W_mK: float | None = Field(
        default=None, ge=0.01, le=1000, examples=[46.0],
        description="Thermal conductivity (needed by thermal traction alone), W/(m K).",
    )  # fmt: skip
    specific_heat_J_kgK: float | None = Field(
        default=None, ge=1, le=10000, examples=[460.0],
        description="Specific heat capacity (needed by thermal traction alone), J/(kg K).",
    )  # fmt: skip

    @property
    def loss(self) -> float:
        """Share of the elastic work that is lost: the one given, or that of steel, or none."""
        if self.hysteresis_loss is not None:
            return self.hysteresis_loss
        return _STEEL_LOSS if _is_steel(self) else 0.0


Kind = Literal["steel", "hybrid", "full ceramic", "other"]


class Materials(Part):
    """Material of each component: a catalogue name or a table of constants."""

    inner_ring: Material = Field(examples=["GCr15"], description="Material of the inner ring.")
    outer_ring: Material = Field(examples=["GCr15"], description="Material of the outer ring.")
    balls: Material = Field(examples=["Si3N4"], description="Material of the balls.")
    cage: Material | None = Field(
        default=None, examples=["bakelite"], description="Material of the cage; needed where there is one."
    )

    @property
    def kind(self) -> Kind:
        """What the bearing is called by its materials: hybrid has steel rings and ceramic balls."""
        parts = (self.inner_ring, self.outer_ring, self.balls)
        steel, ceramic = [_is_steel(part) for part in parts], [_is_ceramic(part) for part in parts]
        if all(steel):
            return "steel"
        if all(steel[:2]) and ceramic[2]:
            return "hybrid"
        return "full ceramic" if all(ceramic) else "other"

    @property
    def steel_rings(self) -> bool:
        """Whether standards and makers' limits are for such a bearing: steel, or hybrid."""
        return self.kind in ("steel", "hybrid")


class OwnMaterials(Part):
    """Materials of one bearing of a set; those that are absent are the scene's."""

    inner_ring: Material | None = Field(
        default=None, examples=["GCr15"], description="Material of its inner ring (absent: the scene's)."
    )
    outer_ring: Material | None = Field(
        default=None, examples=["GCr15"], description="Material of its outer ring (absent: the scene's)."
    )
    balls: Material | None = Field(
        default=None, examples=["Si3N4"], description="Material of its balls (absent: the scene's)."
    )
    cage: Material | None = Field(
        default=None, examples=["bakelite"], description="Material of its cage (absent: the scene's)."
    )

    def over(self, common: Materials) -> Materials:
        """Return the scene's materials with these in their places."""
        own = {key: getattr(self, key) for key in OwnMaterials.model_fields}
        return common.model_copy(update={key: one for key, one in own.items() if one is not None})


def _is_steel(one: Material) -> bool:
    dense = _STEEL_DENSITY[0] < one.density_kg_m3 < _STEEL_DENSITY[1]
    return dense and _STEEL_MODULUS[0] < one.youngs_modulus_GPa < _STEEL_MODULUS[1]


def _is_ceramic(one: Material) -> bool:
    return one.density_kg_m3 < _CERAMIC_DENSITY and one.youngs_modulus_GPa > _CERAMIC_MODULUS
