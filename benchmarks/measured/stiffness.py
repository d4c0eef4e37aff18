"""Stiffness of pairs, offset of their faces, and makers' rules on both."""

import functools
import math
import statistics
from collections.abc import Iterator

import numpy as np

from benchmarks.measured.sources import CERAMIC, OTHER_BALLS, STEEL, Value, of
from fmu_bearing import new_scene, statics
from fmu_bearing.formulas.axial import Axial, axial, axial_displacement, axial_load, axial_stiffness
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.entries import entries
from fmu_bearing.scene.estimate import estimates
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.nsk import CLASSES, CONFORMITIES, PREFIX, Size, sizes
from fmu_bearing.scene.preload import elastic_of

#: Materials of the catalogue.
_MATERIALS = {STEEL: "GCr15", CERAMIC: "Si3N4"}
#: Modulus of elasticity (Pa) and Poisson's ratio.
ELASTIC = {
    name: elastic_of(Material.model_validate(entries("materials")[key].values))
    for name, key in _MATERIALS.items()
}
_RULE = {one.key: one.value for one in estimates(40.0, 68.0, 15.0, 15.0)}
#: Conformities that `scene new` takes for a bearing from dimensions.
RULE = (float(_RULE["inner_conformity"]), float(_RULE["outer_conformity"]))
#: One number for both races, as fits TPI's pairs.
SYMMETRIC = (0.522, 0.522)
#: Inner and outer conformity, with the place where the package takes them or took them.
CHOICES = {
    (0.515, 0.52): "the papers' bearings; bearings from dimensions, before",
    RULE: "bearings from dimensions, now",
    (0.52, 0.53): "NSK's sizes, before",
    CONFORMITIES: "NSK's sizes, now: fitted to NSK's values",
    SYMMETRIC: "one number for both races, near TPI's values",
}
#: Ends of the range that is assumed for a bearing of unknown grooves.
ENDS = ((0.515, 0.52), (0.52, 0.53))
#: Preloads (N) of the pair 7008 by contact angle (deg) of which makers give a rule on lift-off.
LIFT_OFF = {15.0: (125.0, 640.0), 25.0: (175.0, 1035.0)}


def kept(source: str, quantity: str) -> list[Value]:
    """Return the values of a source but those of the size whose balls are others."""
    return [one for one in of(source, quantity) if OTHER_BALLS not in one.bearing or source != "tpi"]


def size_of(value: Value) -> Size:
    """Return NSK's size with the dimensions and the angle of a maker's."""
    digits = "".join(sign for sign in value.bearing.removeprefix("5S1-") if sign.isdigit())
    return sizes()[f"{PREFIX}{digits}{'C' if value.angle_deg == 15.0 else 'AC'}"]


@functools.cache
def _axial(name: str, balls: str, conformities: tuple[float, float]) -> Axial:
    size, steel = sizes()[name], ELASTIC[STEEL]
    return axial(
        size.balls, size.ball, size.pitch, size.angle, conformities, (steel, steel, ELASTIC[balls])
    )  # fmt: skip


def pair_stiffness(value: Value, conformities: tuple[float, float]) -> float:
    """Return the axial stiffness of a rigid pair, N/um: twice that of a bearing."""
    return 2.0 * axial_stiffness(_axial(size_of(value).name, value.balls, conformities), value.load_N)


def face_offset(value: Value, conformities: tuple[float, float]) -> float:
    """Return by how much more the faces of a pair close at the measuring load than at its preload, um."""
    bearing = _axial(size_of(value).name, value.balls, conformities)
    at = (axial_displacement(bearing, load) for load in (value.measuring_load_N, value.load_N))
    measured, preloaded = at
    return 2e3 * (measured - preloaded)


def ratios(source: str, conformities: tuple[float, float]) -> np.ndarray:
    """Return computed over printed stiffness of a maker's pairs, shape (values,)."""
    found = kept(source, "pair axial stiffness")
    return np.array([pair_stiffness(one, conformities) / one.published for one in found])


def offsets(conformities: tuple[float, float]) -> np.ndarray:
    """Return computed less printed offset of TPI's pairs, um, shape (values,)."""
    found = kept("tpi", "face offset")
    return np.array([face_offset(one, conformities) - one.published for one in found])


def ceramic_over_steel() -> Iterator[tuple[Value, float, float]]:
    """Yield TPI's ceramic pairs with printed and computed stiffness over that of steel balls at equal load.

    The steel pair is printed at other loads: between them the logarithm of its stiffness is a parabola in the
    logarithm of the load through its four classes.
    """
    printed = of("tpi", "pair axial stiffness")
    for one in printed:
        if one.balls != CERAMIC:
            continue
        steel = [other for other in printed if other.bearing == one.bearing.removeprefix("5S1-")]
        loads, found = ([getattr(other, key) for other in steel] for key in ("load_N", "published"))
        curve = np.polynomial.Polynomial.fit(np.log(loads), np.log(found), 2)
        name = size_of(one).name
        ours = (axial_stiffness(_axial(name, balls, RULE), one.load_N) for balls in (CERAMIC, STEEL))
        ceramic, usual = ours
        yield one, one.published / math.exp(curve(math.log(one.load_N))), ceramic / usual


def radial_over_axial(conformities: tuple[float, float]) -> dict[tuple[float, str], float]:
    """Return radial over axial stiffness by contact angle and class: median of NSK's 30 sizes each.

    Of a steel bearing at 100 r/min, where nothing but the preload loads it: both bearings of a pair are as
    stiff as each alone.
    """
    found: dict[tuple[float, str], list[float]] = {}
    for size in sizes().values():
        scene = read_scene_text(
            new_scene(
                size.name, size.name, kind="steel", sound=False, speed_rpm=100.0, preload_N=100.0
            )  # fmt: skip
        )
        races = dict(zip(("inner", "outer"), conformities, strict=True))
        given = {f"bearing.{race}_conformity": value for race, value in races.items()}
        for name, one in size.preload.items():
            (load,) = statics(scene.replace(given | {"mounting.preload_N": one.force})).bearings
            ratio = float(load.stiffness[1, 1] / load.stiffness[0, 0])
            found.setdefault((size.angle, CLASSES[name]), []).append(ratio)
    return {key: statistics.median(each) for key, each in found.items()}


def lift_off(conformities: tuple[float, float]) -> dict[tuple[float, float], float]:
    """Return the axial load that unloads one bearing of the pair 7008 over its preload, by angle and preload.

    The other bearing then has twice the displacement of the preload.
    """
    found = {}
    for angle, preloads in LIFT_OFF.items():
        bearing = _axial(f"{PREFIX}7008{'C' if angle == 15.0 else 'AC'}", STEEL, conformities)
        for preload in preloads:
            moved = axial_displacement(bearing, preload)
            found[angle, preload] = axial_load(bearing, 2.0 * moved) / preload
    return found
