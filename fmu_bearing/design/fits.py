"""`fits`: what tolerances of the seats do to a scene's bearings, in five columns, each computed in full."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np

from fmu_bearing.design.mounted import RINGS, Mounted, gaps, mounted, preloads, taken, with_fit
from fmu_bearing.design.operating_point import BearingPoint, OperatingPoint, operating_point
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas.fits import Kind, State, mounting_kelvin
from fmu_bearing.instance import EngineError
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.fit import (
    SIDES,
    Fit,
    Side,
    Take,
    by_classes,
    housing_partner,
    interferences,
    shaft_partner,
)
from fmu_bearing.scene.member import set_of, still_of
from fmu_bearing.threads import one_thread

#: States of a mounted bearing: speed (share of the scene's) and warmth (share of its temperatures).
STATES = {"mounted": (0.0, 0.0), "warm": (0.0, 1.0), "running": (1.0, 1.0)}
#: Draws of both interferences, in closed form; 200 would have no quantile at 3 sigma.
DRAWS = 20_000
SEED = 1
TAKES: tuple[Take, ...] = get_args(Take)
_TAIL = 0.5 * math.erfc(3.0 / math.sqrt(2.0))  # 0.135 %: beyond 3 sigma on one side


@dataclass(frozen=True)
class SeatPoint:
    """The seat of one ring with one interference, SI units.

    Attributes
    ----------
    words : str
        Where the interference comes from.
    drawn : float
        Interference on *diameter* by the diameters at 20 degC, before loss by roughness (m).
    states : dict
        By ``mounted`` (20 degC, still), ``warm`` (still) and ``running``: interference on the *radius*,
        pressure, hoop stress, growth of the race.
    loss_speed : float, optional
        rad/s at which the fit lets go at the scene's temperatures; None where no speed loosens it.
    ring_kelvin, partner_kelvin : float, optional
        K by which the inner ring is warmed or the shaft cooled, or the outer ring cooled or the housing
        warmed, to slip on without force; None of a material that does not expand.
    breaking : dict, optional
        By state the chance that a ceramic inner ring breaks at once; None without strength and modulus.
    """

    words: str
    drawn: float
    states: dict[str, State]
    loss_speed: float | None
    ring_kelvin: float | None
    partner_kelvin: float | None
    breaking: dict[str, float] | None

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units, for machines; interference on diameter."""
        return {
            "words": self.words,
            "interference_m": {"drawn": self.drawn}
            | {k: 2.0 * s.interference for k, s in self.states.items()},
            "pressure_Pa": {key: one.pressure for key, one in self.states.items()},
            "hoop_stress_Pa": {key: one.hoop for key, one in self.states.items()},
            "race_growth_m": {key: one.race for key, one in self.states.items()},
            "loss_speed_rpm": None if self.loss_speed is None else self.loss_speed / RPM,
            "mounting_kelvin": {"ring": self.ring_kelvin, "partner": self.partner_kelvin},
            "breaking_chance": self.breaking,
        }


@dataclass(frozen=True)
class FitPoint:
    """One bearing with one interference of its seats, SI units.

    Attributes
    ----------
    number : int
        From 1.
    seats : dict
        By ``inner`` and ``outer``, those rings that have a seat.
    free_angles : dict
        Contact angle (rad) of unloaded balls: ``drawing``, ``mounted``, ``warm``, ``running``.
    preloads : dict
        N, without other loads: the same states; ``drawing`` where it is that of the loose bearing. Empty
        where a spring holds it.
    gaps : dict
        By those states in which a rigid preload is lost: how far (m) the balls are loose along the axis.
    point : BearingPoint
        The operating point.
    apart, together : Mounted
        In closed form, with each seat's own interference of the column, and with those of the operating
        point; they differ in probable columns of two seats.
    """

    number: int
    seats: dict[Kind, SeatPoint]
    free_angles: dict[str, float]
    preloads: dict[str, float]
    gaps: dict[str, float]
    point: BearingPoint
    apart: Mounted
    together: Mounted

    @property
    def axial_stiffness(self) -> float:
        """Of the bearing at its operating point, N/m."""
        return float(self.point.stiffness[0, 0])

    @property
    def radial_stiffness(self) -> float:
        """Of the bearing at its operating point, mean of both directions, N/m."""
        return 0.5 * float(self.point.stiffness[1, 1] + self.point.stiffness[2, 2])

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units, for machines."""
        contacts = self.point.contacts
        return {
            "bearing": self.number,
            "seats": {ring: seat.summary() for ring, seat in self.seats.items()},
            "free_angle_rad": self.free_angles,
            "preload_N": self.preloads,
            "gap_m": self.gaps,
            "axial_load_N": self.point.axial,
            "contact_angle_rad": {ring: contacts[ring]["angle_mean"] for ring in contacts},
            "pressure_max_Pa": {ring: contacts[ring]["pressure_max"] for ring in contacts},
            "axial_stiffness_N_m": self.axial_stiffness,
            "radial_stiffness_N_m": self.radial_stiffness,
            "life_h": self.point.life,
        }


@dataclass(frozen=True)
class Column:
    """A scene's bearings with one interference of their seats.

    Attributes
    ----------
    take : str
        ``min``, ``probable min``, ``mean``, ``probable max`` or ``max``.
    bearings : tuple of FitPoint
    point : OperatingPoint
        Its scene has these interferences.
    """

    take: Take
    bearings: tuple[FitPoint, ...]
    point: OperatingPoint

    @property
    def life(self) -> float | None:
        """L10r (h) of all bearings together; None where no standard rates them."""
        return self.point.life

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units, for machines."""
        return {
            "take": self.take,
            "bearings": [one.summary() for one in self.bearings],
            "life_h": self.life,
        }


@dataclass(frozen=True)
class Fits:
    """What the tolerances of the seats do, in five columns.

    Attributes
    ----------
    scene : Scene
    columns : tuple of Column
        From the loosest fit to the tightest, those with an equilibrium. With two seats of a tolerance the
        probable columns of figures that depend on both rings have a pair of interferences of which 0.135 %
        are looser or tighter.
    remarks : tuple of str
        How the columns were found.
    """

    scene: Scene
    columns: tuple[Column, ...]
    remarks: tuple[str, ...]

    def column(self, take: Take) -> Column:
        """Return the column of a take."""
        return next(one for one in self.columns if one.take == take)

    def words(self, number: int) -> str:
        """Return where the interferences of a bearing come from; ``number``: from 1."""
        middle = self.columns[len(self.columns) // 2]
        (mean,) = [one for one in middle.bearings if one.number == number]
        return "; ".join(f"{ring} ring {seat.words}" for ring, seat in mean.seats.items())

    def summary(self) -> dict[str, Any]:
        """Return all figures by name, SI units, for machines."""
        return {
            "scene": self.scene.name,
            "speed_rpm": self.scene.operation.speed_rpm,
            "columns": [one.summary() for one in self.columns],
            "remarks": self.remarks,
        }


@one_thread
def fits(scene: SceneSource, track: Callable[[Sequence[Take]], Iterable[Take]] = iter) -> Fits:
    """Return what the tolerances of the seats do to a scene's bearings.

    Parameters
    ----------
    scene : Scene or path
        With ``[mounting.fit]``, of a set ``[spindle.fit]``.
    track : callable
        Watches the columns.

    Raises
    ------
    SceneError
        If the file cannot be read, for a scene without a fit, and where another model owns the shaft.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Notes
    -----
    Each column is computed in full: another interference, another operating point. First order would be
    wrong where a fit opens: from there on it moves its race no more.

    Examples
    --------
    >>> from fmu_bearing import fits, read_scene
    >>> seat = {"shaft_class": "js5", "material": "GCr15"}
    >>> scene = read_scene("examples/scenes/7003C-bare.toml").replace(
    ...     {"mounting.fit": {"bearing_class": "P4", "shaft": seat}}
    ... )
    >>> for column in fits(scene).columns:
    ...     (one,) = column.bearings
    ...     print(f"{column.take}: {1e-6 * one.seats['inner'].states['running'].hoop:.0f} MPa")
    min: 4 MPa
    probable min: 4 MPa
    mean: 21 MPa
    probable max: 64 MPa
    max: 79 MPa
    """
    whole = fitted(scene)
    scenes, remarks = _scenes(whole)
    several = whole.fit is not None and bool(_tolerated(whole.fit))
    columns, missing = [], []
    point = None
    for take in track(TAKES):
        if several or point is None:
            try:
                point = operating_point(scenes[take])
            except EngineError as problem:
                missing.append(f"{problem}; at the {take} interference of the fits: give others")
                continue
        columns.append(column_at(whole, take, point))
    if not columns:
        raise EngineError(missing[0])
    return Fits(whole, tuple(columns), (*remarks, *(f"no column: {reason}" for reason in missing)))


def fitted(scene: SceneSource) -> Scene:
    """Return a scene that has a fit, without what runs alone read.

    Raises
    ------
    SceneError
        For one without.
    """
    found = still_of(scene_of(scene))
    if found.fit is None:
        table = f"{found.assembly.table}.fit"
        raise SceneError(
            f"{found.name}: has no fit, its rings are as drawn: add [{table}] with [{table}.shaft] or "
            f'[{table}.housing], as shaft_class = "js4" with bearing_class = "P4", or interference_um = 2.0'
        )
    return found


def _tolerated(fit: Fit) -> list[Side]:
    """Seats whose interference follows from classes."""
    found = [(side, getattr(fit, side.seat)) for side in SIDES]
    return [side for side, seat in found if seat is not None and getattr(seat, side.class_key) is not None]


def _scenes(scene: Scene) -> tuple[dict[Take, Scene], tuple[str, ...]]:
    """Return the scene of each column, and how they were found."""
    fit = scene.fit
    assert fit is not None
    found = {take: taken(scene, take) for take in TAKES}
    sides = _tolerated(fit)
    if not sides:
        return found, ("interferences are given, not classes: all columns are equal",)
    if len(sides) == 1:
        return found, ()
    for take, pair in _probable(scene).items():
        changes = {
            side.seat: getattr(fit, side.seat).model_copy(
                update={"interference_um": um, side.class_key: None}
            )
            for side, um in zip(sides, pair, strict=True)
        }
        found[take] = with_fit(scene, fit.model_copy(update=changes))
    return found, (
        "two seats: at min and max both are at their limits; probable figures that depend on both rings are "
        f"those of the pair of interferences than which 0.135 % of {DRAWS} draws are looser or tighter",
    )


def _probable(scene: Scene) -> dict[Take, tuple[float, float]]:
    """Return the probable pairs of interferences (um): mean of the draws around 0.135 % of both ends.

    Draws are sorted by what both races take from the clearance at the operating point, which angle, preload
    and all that follows from them depend on.
    """
    one = _without_own(scene).bearings()[0].scene
    found = mounted(one)
    draw = np.random.default_rng(SEED)
    drawn, taken_away = [], np.zeros(DRAWS)
    for ring, side in zip(RINGS, SIDES, strict=True):
        mean, high = (_um(one, side, take) for take in ("mean", "probable max"))
        um = draw.normal(mean, (high - mean) / 3.0, DRAWS)
        seat = found.seats[ring].fit
        still = seat.at(0.0, found.speed, *found.temperatures(ring)).interference
        drawn.append(um)
        taken_away += abs(seat.share) * np.maximum(0.0, still + 0.5e-6 * um)
    order = np.argsort(taken_away, kind="stable")
    window = 2 * round(_TAIL * DRAWS)

    def middle(places: Any) -> tuple[float, float]:
        return float(drawn[0][places].mean()), float(drawn[1][places].mean())

    return {"probable min": middle(order[:window]), "probable max": middle(order[-window:])}


def _without_own(scene: Scene) -> Scene:
    """Return a set whose bearings have no interference of their own; a single bearing as it is."""
    if not scene.assembly.members:
        return scene
    spindle = set_of(scene)
    none = dict.fromkeys(f"{side.seat}_interference_um" for side in SIDES)
    bearings = tuple(one.model_copy(update=none) for one in spindle.bearing)
    return scene.model_copy(update={"spindle": spindle.model_copy(update={"bearing": bearings})})


def _um(scene: Scene, side: Side, take: Take) -> float:
    """Return the interference (um) of a seat after loss by roughness."""
    found = interferences(scene, take)[SIDES.index(side)]
    assert found is not None
    return found.um


def column_at(scene: Scene, take: Take, point: OperatingPoint) -> Column:
    """Return a column from its operating point; each seat has its own interference of that take."""
    bearings = []
    for k, (one, member) in enumerate(zip(point.bearings, scene.bearings(), strict=True)):
        fit = member.scene.fit
        assert fit is not None
        own = mounted(with_fit(one.scene, fit.model_copy(update={"take": take})))
        found = {ring: _seat(own, scene, k, ring, take) for ring in own.seats}
        joint = mounted(one.scene)
        angles = {key: joint.free_angle(share * joint.speed, warm) for key, (share, warm) in STATES.items()}
        drawing = {"drawing": math.radians(joint.scene.bearing.contact_angle_deg)}
        loads, apart = preloads(point, k), gaps(point)
        bearings.append(FitPoint(k + 1, found, drawing | angles, loads, apart, one, own, joint))
    return Column(take, tuple(bearings), point)


def _seat(own: Mounted, scene: Scene, number: int, ring: Kind, take: Take) -> SeatPoint:
    """Return the seat of a ring with its own interference; ``number``: of the bearing, from 0."""
    side, seat = SIDES[RINGS.index(ring)], own.seats[ring]
    states = {key: own.at(ring, share * own.speed, warm) for key, (share, warm) in STATES.items()}
    tight = states["mounted"].interference
    fit, materials = own.scene.fit, own.scene.materials
    by_class = getattr(getattr(fit, side.seat), side.class_key) is not None
    drawn = 1e-6 * by_classes(own.scene, side, take) if by_class else 2.0 * seat.interference
    partner = (shaft_partner if ring == "inner" else housing_partner)(own.scene)[0]
    body = materials.inner_ring if ring == "inner" else materials.outer_ring

    def kelvin(expansion: float) -> float | None:
        return mounting_kelvin(tight, seat.fit.seat_radius, expansion) if expansion > 0.0 else None

    chances = {}
    if ring == "inner":
        for key, (share, warm) in STATES.items():
            chance = own.breaking_chance(share * own.speed, warm)
            if chance is not None:
                chances[key] = chance
    return SeatPoint(
        seat.words, drawn, states, own.loss_speed(ring), kelvin(1e-6 * body.expansion_1e6_K),
        kelvin(1e-6 * partner.expansion_1e6_K), chances or None,
    )  # fmt: skip
