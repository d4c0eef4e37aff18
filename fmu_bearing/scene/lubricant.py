"""Oil: viscosity, traction, films, drag."""

from typing import Literal, get_args

from pydantic import Field

from fmu_bearing.engine.choices import RollingLaw, TractionLaw, ViscosityLaw
from fmu_bearing.scene.base import Part

#: Classes of contamination by ISO 281, the cleanest first.
Cleanliness = Literal["extreme", "high", "normal", "slight", "typical", "severe"]


#: How oil comes to the contacts.
Supply = Literal["oil-air", "grease", "jet", "bath"]
SUPPLIES: tuple[Supply, ...] = get_args(Supply)
# Few drops and close conformity: a meniscus at the contact (Balan, Houpert, Tufescu and Olaru 2015); jet and
# bath flood it. Replenishment constants of SKF's friction model.
_ROLLING_LAWS: dict[Supply, RollingLaw] = {
    "oil-air": "starved", "grease": "starved", "jet": "flooded", "bath": "flooded",
}  # fmt: skip
# Assumed: the gaps hold ten minutes of an oil-air supply, whose mist does not fill them. Jet and bath do.
_MIST = 0.006  # Pa s
_LANDS: dict[Supply, float | None] = {"oil-air": _MIST, "grease": _MIST, "jet": None, "bath": None}
_AIR = 1.2  # kg/m3
# SKF has one constant for oil-air and grease that has settled (general catalogue, p. 97 f.), Schaeffler one
# factor for oil mist and grease (HR 1, 2006, p. 59). What fresh grease churns is in no model.
_REPLENISHMENT: dict[Supply, float] = {"oil-air": 6e-8, "grease": 6e-8, "jet": 3e-8, "bath": 3e-8}


#: What the oil is made of.
BaseOil = Literal["mineral", "synthetic", "traction fluid"]
# Friction coefficient of full films in SKF's friction model (SKF general catalogue, p. 101).
_TRACTION: dict[BaseOil, float] = {"mineral": 0.05, "synthetic": 0.04, "traction fluid": 0.1}


def meant_supply(name: object) -> str:
    """Return what a message adds where a supply is given in the place of an oil, as "grease"; else ""."""
    if name not in SUPPLIES:
        return ""
    return (
        f"; '{name}' is how the oil comes to the contacts: keep the oil, and give lubricant.supply = "
        f'"{name}" (`scene new --supply {name}`)'
    )


class Lubricant(Part):
    """Lubricant; viscosity follows Vogel's or Walther's law through its value at 20 degC."""

    viscosity_Pa_s: float = Field(
        ge=1e-3, le=2, examples=[0.03], description="Dynamic viscosity at 20 degC, Pa s."
    )
    pressure_viscosity_1_GPa: float = Field(
        ge=1, le=50, examples=[20.0], description="Pressure-viscosity coefficient, 1/GPa."
    )
    density_kg_m3: float = Field(ge=500, le=2000, examples=[870.0], description="Density of the oil, kg/m3.")
    viscosity_law: ViscosityLaw = Field(
        default="vogel",
        examples=["vogel"],
        description="How viscosity falls with temperature: Vogel's law or Walther's (ASTM D341).",
    )
    vogel_B_K: float = Field(
        ge=0, le=3000, examples=[879.0],
        description="Constant B of Vogel's viscosity exp(B/(T - C)); 0: the same at any temperature, K.",
    )  # fmt: skip
    vogel_C_K: float = Field(
        ge=50, le=220, examples=[178.0], description="Constant C of Vogel's viscosity exp(B/(T - C)), K."
    )
    # Assumed: a mineral oil of viscosity index about 100.
    walther_slope: float = Field(
        default=3.7, ge=0, le=8, examples=[3.7],
        description="Slope B of Walther's lg lg(v + 0.7) = A - B lg T, v in mm2/s; 0: the same viscosity at "
        "any temperature.",
    )  # fmt: skip
    traction_law: TractionLaw = Field(
        default="regularised", examples=["regularised"],
        description="Traction: regularised Coulomb friction, Eyring's law with Roelands' viscosity, or the "
        "papers' viscosity times speed over film, which alone drives no cage.",
    )  # fmt: skip
    # Assumed: the papers name no oil.
    eyring_stress_MPa: float = Field(
        default=5.0, ge=0.1, le=100, examples=[5.0], description="Shear stress of Eyring's law, MPa."
    )
    base_oil: BaseOil = Field(
        default="mineral", examples=["synthetic"], description="Kind of oil, which limits traction."
    )
    traction_max: float | None = Field(
        default=None, ge=0, le=0.5, examples=[0.05],
        description="Largest traction over the contact's load, in every law; 0: no traction (absent: 0.05 of "
        "mineral oil, 0.04 of synthetic oil, 0.1 of traction fluid).",
    )  # fmt: skip
    traction_slide_to_roll: float = Field(
        ge=1e-4, le=0.5, examples=[0.005], description="Slide-to-roll ratio at which traction saturates."
    )
    traction_floor_m_s: float = Field(
        ge=1e-4, le=1, examples=[1e-3],
        description="Least sliding speed at which traction saturates, however slow the rolling, m/s.",
    )  # fmt: skip
    land_viscosity_Pa_s: float | None = Field(
        default=None, ge=0, le=2, examples=[0.006],
        description="Effective viscosity between cage and lands (absent: 0.006 with oil-air or grease; with "
        "jet or bath that of the oil at its temperature, heated by its own shear), Pa s.",
    )  # fmt: skip
    conductivity_W_mK: float = Field(
        default=0.14, ge=0.01, le=2, examples=[0.14], description="Thermal conductivity of the oil, W/(m K).",
    )  # fmt: skip
    supply: Supply = Field(
        default="oil-air", examples=["jet"],
        description="How oil comes to the contacts; gives the law of rolling resistance and the "
        "replenishment constant.",
    )  # fmt: skip
    rolling_law: RollingLaw | None = Field(
        default=None, examples=["starved"],
        description="Law of rolling resistance: Houpert's EHL force of 1987 alone, his forces with the "
        "change to rigid surfaces, or those of a flooded inlet (absent: starved with oil-air or grease, "
        "flooded with jet or bath).",
    )  # fmt: skip
    replenishment_constant: float | None = Field(
        default=None, ge=0, le=1e-6, examples=[6e-8],
        description="Replenishment constant K_rs of SKF's friction model; 0: no starvation (absent: 6e-8 "
        "with oil-air or grease, 3e-8 with jet or bath).",
    )  # fmt: skip
    replenishment_held: bool = Field(
        default=True, examples=[True],
        description="Starvation in cold oil no further than to the largest rolling resistance; false: the "
        "resistance falls again as the oil gets thicker.",
    )  # fmt: skip
    oil_air_density_kg_m3: float = Field(
        ge=0, le=1000, examples=[5.0],
        description="Density of the oil-air mixture around the balls; with grease no more than that of air, "
        "1.2 counts, kg/m3.",
    )  # fmt: skip
    drag_coefficient: float = Field(
        ge=0, le=5, examples=[0.5], description="Drag coefficient of a ball in that mixture."
    )
    cleanliness: Cleanliness | None = Field(
        default=None,
        examples=["high"],
        description="Contamination by ISO 281, for the modified life of steel bearings (absent: high).",
    )

    @property
    def greased(self) -> bool:
        """Whether grease holds the oil: limits of speed are lower, and no mist is round the balls."""
        return self.supply == "grease"

    @property
    def density_round_balls(self) -> float:
        """Density (kg/m3) of what the balls go through: with grease, which leaves their path, that of air."""
        return min(self.oil_air_density_kg_m3, _AIR) if self.greased else self.oil_air_density_kg_m3

    @property
    def law_of_rolling(self) -> RollingLaw:
        """Law of rolling resistance: the one given, or that of the supply."""
        return self.rolling_law or _ROLLING_LAWS[self.supply]

    @property
    def largest_traction(self) -> float:
        """Largest traction over load: the one given, or that of the base oil."""
        return _TRACTION[self.base_oil] if self.traction_max is None else self.traction_max

    @property
    def viscosity_of_lands(self) -> float | None:
        """Viscosity between cage and lands (Pa s): given, or of the supply; None: the heated oil's."""
        return _LANDS[self.supply] if self.land_viscosity_Pa_s is None else self.land_viscosity_Pa_s

    @property
    def replenishment(self) -> float:
        """Replenishment constant: the one given, or that of the supply."""
        given = self.replenishment_constant
        return _REPLENISHMENT[self.supply] if given is None else given
