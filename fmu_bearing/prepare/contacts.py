"""Contacts of the balls as numbers: oil, friction, and per race stiffness, rolling resistance and films."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe

from fmu_bearing.elastic.section import groove_circle
from fmu_bearing.engine.choices import ROLLING_LAWS, TRACTION_LAWS, VISCOSITY_LAWS
from fmu_bearing.engine.layout import P
from fmu_bearing.formulas.hertz import PointContact, effective_modulus, point_contact
from fmu_bearing.prepare import bodies
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.lubricant import Lubricant
from fmu_bearing.scene.material import Material

# SKF friction model (SKF rolling bearings catalogue 2018, p. 65 ff): inlet shear heating, starvation
_SHEAR_HEATING = 1.84e-9
_KZ = {"angular-contact": 4.4, "deep-groove": 3.1}  # single rows; that of deep groove ones from memory
_CHANGE = 6.6  # M at which rigid surfaces and EHL weigh the same (Biboulet and Houpert 2010, eq. 32)


def oil(scene: Scene, p: NDArray[np.float64]) -> None:
    """Write viscosity, traction, reduction of the rolling resistance, and drag."""
    b, values = si(scene.bearing), si(scene.lubricant)
    p[P.VISCOSITY] = values.viscosity
    p[P.PRESSURE_VISCOSITY] = values.pressure_viscosity
    p[P.OIL_DENSITY] = values.density
    p[P.OIL_CONDUCTIVITY] = values.conductivity
    p[P.VISCOSITY_LAW] = VISCOSITY_LAWS.index(values.viscosity_law)
    p[P.VOGEL_B], p[P.VOGEL_C] = values.vogel_B, values.vogel_C
    p[P.WALTHER_SLOPE] = values.walther_slope
    p[P.TRACTION_LAW] = TRACTION_LAWS.index(values.traction_law)
    p[P.EYRING_STRESS] = values.eyring_stress
    p[P.MU] = scene.lubricant.largest_traction
    p[P.THERMAL_TRACTION] = scene.fidelity.terms.thermal_traction
    p[P.SLIDE_TO_ROLL] = values.traction_slide_to_roll
    p[P.TRACTION_FLOOR] = values.traction_floor
    mean, bore, outside = 1e3 * b.pitch_diameter, 1e3 * b.bore, 1e3 * b.outside_diameter
    p[P.SHEAR_HEATING] = _SHEAR_HEATING * mean**1.28
    p[P.ROLLING_LAW] = ROLLING_LAWS.index(scene.lubricant.law_of_rolling)
    p[P.STARVATION] = (
        scene.lubricant.replenishment
        * (bore + outside)
        * math.sqrt(_KZ[scene.bearing.kind] / (2.0 * (outside - bore)))
    )
    p[P.STARVATION_HELD] = scene.lubricant.replenishment_held
    p[P.DRAG_FACTOR] = (
        0.5 * scene.lubricant.density_round_balls * values.drag_coefficient * math.pi * b.ball_diameter**2 / 4
    )


def balls(scene: Scene, p: NDArray[np.float64]) -> None:
    """Write size and mass of the balls and the constants that both contacts share."""
    b = si(scene.bearing)
    p[P.PITCH_RADIUS] = b.pitch_diameter / 2
    p[P.DIAMETER] = b.ball_diameter
    p[P.BALL_MASS], p[P.BALL_INERTIA] = bodies.ball(scene)
    p[P.BALL_EXPANSION] = si(scene.materials.balls).expansion
    p[P.CONTACT_DAMPING] = b.contact_damping if scene.fidelity.terms.contact_damping else 0.0
    p[P.ROUGHNESS] = math.hypot(b.race_roughness, b.ball_roughness)
    if scene.bearing.ball_springs is not None:
        springs = si(scene.bearing.ball_springs)
        p[P.SPRINGS], p[P.SPRING_DAMPING] = springs.stiffness, springs.damping


def races(scene: Scene, p: NDArray[np.float64]) -> None:
    """Write the blocks of inner and outer race; constants of the contact hold at the nominal angle."""
    b = si(scene.bearing)
    d = b.ball_diameter
    sides = (
        (-1.0, b.inner_conformity, scene.materials.inner_ring, b.inner_ring_outer_diameter),
        (1.0, b.outer_conformity, scene.materials.outer_ring, b.outer_ring_inner_diameter),
    )
    for race, (side, conformity, material, shoulder) in enumerate(sides):
        block = p[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]
        ring = si(material)
        rx, ry, modulus = surfaces(scene, race)
        hertz = race_contacts(scene)[race]
        block[P.RACE_STIFFNESS] = hertz.stiffness
        block[P.RACE_HALF_LENGTH] = hertz.half_length
        block[P.RACE_HALF_WIDTH] = hertz.half_width
        block[P.RACE_PRESSURE] = hertz.pressure
        inlet(block, hertz, rx, ry, modulus, scene.lubricant)
        films(block, hertz, rx, modulus, si(scene.lubricant).pressure_viscosity)
        if scene.fidelity.terms.thermal_traction:
            block[P.RACE_EFFUSIVITY] = _effusivity(material) + _effusivity(scene.materials.balls)
        if scene.fidelity.terms.rolling_hysteresis:
            lost = _lost(material, scene.materials.balls)
            block[P.RACE_HYSTERESIS] = 3.0 / 16.0 * lost / hertz.ellipticity
        block[P.RACE_PROFILE_RADIUS] = 2.0 * conformity * d / (2.0 * conformity + 1.0)
        block[P.RACE_GROOVE_X], block[P.RACE_GROOVE_RADIUS] = groove_circle(scene, race)
        block[P.RACE_GROOVE] = conformity * d
        block[P.RACE_EXPANSION] = ring.expansion
        height = side * (0.5 * shoulder - block[P.RACE_GROOVE_RADIUS]) / block[P.RACE_GROOVE]
        block[P.RACE_SHOULDER] = math.acos(max(-1.0, min(1.0, height)))


def race_contacts(scene: Scene) -> tuple[PointContact, PointContact]:
    """Hertzian contacts of a ball with inner and outer race, at the nominal contact angle."""
    return point_contact(*surfaces(scene, 0)), point_contact(*surfaces(scene, 1))


def surfaces(scene: Scene, race: int) -> tuple[float, float, float]:
    """Effective radii along and across rolling (m) and E' (Pa) of a ball on a race."""
    b, ball = si(scene.bearing), si(scene.materials.balls)
    ring = si((scene.materials.inner_ring, scene.materials.outer_ring)[race])
    conformity = (b.inner_conformity, b.outer_conformity)[race]
    gamma = b.ball_diameter * math.cos(scene.bearing.nominal_angle) / b.pitch_diameter
    curvature = gamma / (1.0 - gamma) if race == 0 else -gamma / (1.0 + gamma)
    modulus = effective_modulus(
        ring.youngs_modulus, ring.poisson_ratio, ball.youngs_modulus, ball.poisson_ratio
    )
    rx = b.ball_diameter / 2.0 / (1.0 + curvature)
    ry = 1.0 / (2.0 / b.ball_diameter - 1.0 / (conformity * b.ball_diameter))
    return rx, ry, modulus


def _lost(one: Material, other: Material) -> float:
    """Share of the elastic work of two bodies in contact that is lost: each yields as its compliance."""
    yields = [(1.0 - body.poisson_ratio**2) / body.youngs_modulus_GPa for body in (one, other)]
    return (one.loss * yields[0] + other.loss * yields[1]) / sum(yields)


def _effusivity(body: Material) -> float:
    """Thermal effusivity sqrt(k rho c) of a body, W s^0.5/(m2 K)."""
    values = si(body)
    return math.sqrt(values.conductivity * values.density * values.specific_heat)


def inlet(
    block: NDArray[np.float64], hertz: PointContact, rx: float, ry: float, modulus: float, oil: Lubricant
) -> None:
    """Write rolling resistance by the oil at the inlet of one race, as factors at viscosity 1 Pa s.

    Houpert (1987) over the ratio of the radii R_y/R_x (Balan, Houpert, Tufescu and Olaru 2015, doi
    10.3390/lubricants3020222), and Biboulet and Houpert (2010, doi 10.1243/13506501JET791), eqs. 28 to 32.
    ``rx``, ``ry`` in m, ``modulus`` E' in Pa.
    """
    speed, load, ratio = modulus * rx, modulus * rx**2, ry / rx
    kappa = 1.0 / hertz.ellipticity
    beta = 4.0 / math.pi * float(ellipe(1.0 - kappa**2)) / (1.0 + 1.0 / ratio)
    double = 2.0 / speed  # their U at 1 Pa s and 1 m/s
    if oil.law_of_rolling == "flooded":
        axis = 2.0 * hertz.half_length * hertz.stiffness ** (-1.0 / 3.0)  # m/N^(1/3)
        elastic = 1.8 * beta**-0.25 * speed * axis * double**0.75
        rigid = 0.77 * beta ** (-1.0 / 3.0) * kappa**0.12 * speed * axis * double ** (2.0 / 3.0)
    else:
        material = si(oil).pressure_viscosity * modulus
        elastic = 2.86 * load * ratio**0.348 * material**0.022 * speed**-0.66 * load**-0.47
        rigid = 0.835 * load * ratio**0.358 * double**0.636 * load**-0.364
    # the moment pair that dissipates the inlet force on both surfaces at the entrainment speed
    block[P.RACE_ROLLING] = 2.0 * rx * elastic
    block[P.RACE_RIGID] = 2.0 * rx * rigid
    block[P.RACE_REGIME] = beta**0.25 * kappa / load * double**-0.75 / _CHANGE


def films(block: NDArray[np.float64], hertz: PointContact, rx: float, modulus: float, alpha: float) -> None:
    """Write films of one race, as factors at viscosity 1 Pa s.

    Hamrock and Dowson (1977), over the ellipticity, so that with the entrainment speed u (m/s) and the load
    Q (N) the minimum film is ``RACE_FILM (eta u)^0.68 Q^-0.073`` and the central one
    ``RACE_CENTRAL_FILM (eta u)^0.67 Q^-0.067`` (m). ``rx`` in m, ``modulus`` E' in Pa, ``alpha`` in 1/Pa.
    """
    k = hertz.ellipticity
    material = alpha * modulus
    speed, load = modulus * rx, modulus * rx**2
    block[P.RACE_FILM] = 3.63 * rx * speed**-0.68 * material**0.49 * load**0.073 * (1.0 - math.exp(-0.68 * k))
    block[P.RACE_CENTRAL_FILM] = (
        2.69 * rx * speed**-0.67 * material**0.53 * load**0.067 * (1.0 - 0.61 * math.exp(-0.73 * k))
    )
