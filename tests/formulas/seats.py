"""Seats that tests share: rings of the catalogue on their partners, and their states in closed form."""

import math
from dataclasses import dataclass

from fmu_bearing.elastic.section import INNER, OUTER, Section, ring_section
from fmu_bearing.formulas.fits import Solid, fit
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.entries import catalogue
from tests.conftest import GATES

RPM = math.pi / 30.0  # rad/s
ALUMINIUM = Solid(70e9, 0.33, 2700.0, 23.4e-6)
SCENES = {"7003C": "7003C-bare", "7009C": "7009C-steel"}


def material(name):
    """A material of the catalogue, or aluminium."""
    if name == "aluminium":
        return ALUMINIUM
    found = catalogue("materials")[name]
    modulus, expansion = 1e9 * found["youngs_modulus_GPa"], 1e-6 * found["expansion_1e6_K"]
    return Solid(modulus, found["poisson_ratio"], found["density_kg_m3"], expansion)


@dataclass(frozen=True)
class Seat:
    """A ring of a bearing of the catalogue on its partner; the partner's other diameter in mm."""

    bearing: str
    kind: str
    ring: str
    partner: str
    partner_mm: float

    @property
    def dimensions(self):
        """Seat, effective and contact radius, width (m)."""
        b = catalogue("bearings")[self.bearing]
        reach = b["ball_diameter_mm"] * math.cos(math.radians(b["contact_angle_deg"]))
        if self.kind == "inner":
            diameters = b["bore_mm"], b["inner_ring_outer_diameter_mm"], b["pitch_diameter_mm"] - reach
        else:
            diameters = (
                b["outside_diameter_mm"],
                b["outer_ring_inner_diameter_mm"],
                b["pitch_diameter_mm"] + reach,
            )
        return (*(0.5e-3 * diameter for diameter in diameters), 1e-3 * b["width_mm"])

    @property
    def body(self):
        return INNER if self.kind == "inner" else OUTER

    def fit(self, long=True):
        """Its coefficients."""
        other = 0.5e-3 * self.partner_mm
        return fit(self.kind, *self.dimensions, material(self.ring), material(self.partner), other, long)

    def section(self):
        """Section of the ring with its groove."""
        return ring_section(read_scene(GATES / f"{SCENES[self.bearing]}.toml"), self.body)

    def rectangle(self):
        """Section of the ring as the closed form has it."""
        seat, effective, _, width = self.dimensions
        return Section(self.body, *sorted((seat, effective)), width)


@dataclass(frozen=True)
class Load:
    """What a seat is under: interference on the radius at 20 degC and standstill (um), r/min, degC."""

    d_0: float
    rpm: float = 0.0
    ring: float = 20.0
    partner: float = 20.0

    @property
    def kelvin(self):
        return self.ring + 273.15, self.partner + 273.15

    def of(self, seat):
        """State of a fit."""
        return seat.at(1e-6 * self.d_0, self.rpm * RPM, *self.kelvin)

    def loss(self, seat):
        """Speed of loss (r/min), or None."""
        speed = seat.loss_speed(1e-6 * self.d_0, *self.kelvin)
        return None if speed is None else speed / RPM


STEEL = Seat("7003C", "inner", "GCr15", "GCr15", 0.0)
CERAMIC = Seat("7003C", "inner", "Si3N4", "GCr15", 8.0)
LARGE = Seat("7009C", "inner", "GCr15", "GCr15", 32.0)
HOUSED = Seat("7003C", "outer", "GCr15", "aluminium", 60.0)
HOUSED_STEEL = Seat("7003C", "outer", "GCr15", "GCr15", 60.0)
#: Cases of the specification of fits, by the numbers that they have there.
CASES = {
    "1": (STEEL, Load(3.5)),
    "2": (STEEL, Load(3.5, 20000, 40, 40)),
    "4": (CERAMIC, Load(1.0)),
    "5": (CERAMIC, Load(1.0, 20000, 60, 60)),
    "7": (STEEL, Load(0.5, 20000, 45, 40)),
    "10": (LARGE, Load(5.25, 18000, 40, 40)),
    "12": (HOUSED, Load(2.0)),
    "15 shaft": (STEEL, Load(1.0, 20000, 45, 45)),
    "15 housing": (HOUSED_STEEL, Load(1.0, 20000, 40, 38)),
}
