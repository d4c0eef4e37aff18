"""`fits`: what tolerances of the seats do to a scene's bearings, in five columns, each computed in full."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np

from fmu_bearing.design.mounted import (
    RINGS,
    Mounted,
    axial_gaps,
    mounted,
    preloads,
    with_fit,
    with_interference,
)
from fmu_bearing.design.operating_point import BearingPoint, OperatingPoint, operating_point
from fmu_bearing.engine.constants import RPM
from fmu_bearing.formulas.fits import Kind, State, mounting_kelvin
from fmu_bearing.instance import EngineError
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
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
class SeatPoint(Result):
    """The seat of one ring with one interference, SI units."""

    quantities = (
        "words", "interference_m", Quantity("pressure_Pa", of=lambda one: one.of_state("pressure")),
        Quantity("hoop_stress_Pa", of=lambda one: one.of_state("hoop")),
        Quantity("race_growth_m", of=lambda one: one.of_state("race")),
        Quantity("loss_speed_rpm", factor=1.0 / RPM),
        Quantity("mounting_kelvin [K]", of=lambda k: {"ring": k.ring_kelvin, "partner": k.partner_kelvin}),
        "breaking_chance [1] = breaking",
    )  # fmt: skip

    words: str
    """Where the interference comes from."""
    drawn: float
    """Interference on *diameter* by the diameters at 20 degC, before loss by roughness (m)."""
    states: dict[str, State]
    """By ``mounted`` (20 degC, still), ``warm`` (still) and ``running``: interference on the *radius*,
    pressure, hoop stress, growth of the race."""
    loss_speed: float | None
    """rad/s at which the fit lets go at the scene's temperatures; None where no speed loosens it."""
    ring_kelvin: float | None
    partner_kelvin: float | None
    """K by which the inner ring is warmed or the shaft cooled, or the outer ring cooled or the housing
    warmed, to slip on without force; None of a material that does not expand."""
    breaking: dict[str, float] | None
    """By state the chance that a ceramic inner ring breaks at once; None without strength and modulus."""

    @property
    def interference(self) -> dict[str, float]:
        """On diameter (m), as drawn and by state."""
        return {"drawn": self.drawn} | {key: 2.0 * state.interference for key, state in self.states.items()}

    def of_state(self, name: str) -> dict[str, float]:
        """Return ``pressure``, ``hoop`` (Pa) or ``race`` (m) by state."""
        return {key: getattr(state, name) for key, state in self.states.items()}


@dataclass(frozen=True)
class FitPoint(Result):
    """One bearing with one interference of its seats, SI units."""

    quantities = (
        "bearing [1] = number", "seats", "free_angle_rad = free_angles", "preload_N = preloads",
        "gap_m = gaps", Quantity("clearance_m", of=lambda one: one.clearances or None),
        "axial_load_N = point.axial",
        Quantity("contact_angle_rad", of=lambda one: one.point.at_races("angle_mean")),
        Quantity("pressure_max_Pa", of=lambda one: one.point.at_races("pressure_max")),
        "axial_stiffness_N_m", "radial_stiffness_N_m", "life_h = point.life",
    )  # fmt: skip

    number: int
    """From 1."""
    seats: dict[Kind, SeatPoint]
    """By ``inner`` and ``outer``, those rings that have a seat."""
    free_angles: dict[str, float]
    """Contact angle (rad) of unloaded balls: ``drawing``, ``mounted``, ``warm``, ``running``."""
    preloads: dict[str, float]
    """N, without other loads: the same states; ``drawing`` where it is that of the loose bearing. Empty where
    a spring holds it."""
    gaps: dict[str, float]
    """By those states in which a rigid preload is lost: how far (m) the balls are loose along the axis."""
    point: BearingPoint
    """The operating point."""
    apart: Mounted
    together: Mounted
    """In closed form, with each seat's own interference of the column, and with those of the operating point;
    they differ in probable columns of two seats."""

    @property
    def clearances(self) -> dict[str, float]:
        """Radial clearance (m) of a deep groove bearing by the states of `free_angles`; empty of others."""
        bearing, seated = self.together.scene.bearing, self.together
        if not bearing.is_deep_groove:
            return {}
        left = {key: seated.clearance(share * seated.speed, warm) for key, (share, warm) in STATES.items()}
        return {"drawing": bearing.radial_clearance} | left

    @property
    def axial_stiffness(self) -> float:
        """Of the bearing at its operating point, N/m."""
        return float(self.point.stiffness[0, 0])

    @property
    def radial_stiffness(self) -> float:
        """Of the bearing at its operating point, mean of both directions, N/m."""
        return 0.5 * float(self.point.stiffness[1, 1] + self.point.stiffness[2, 2])


@dataclass(frozen=True)
class Column(Result):
    """A scene's bearings with one interference of their seats."""

    quantities = "take", "bearings", "life_h"

    take: Take
    """``min``, ``probable min``, ``mean``, ``probable max`` or ``max``."""
    bearings: tuple[FitPoint, ...]
    point: OperatingPoint
    """Its scene has these interferences."""

    @property
    def life(self) -> float | None:
        """L10r (h) of all bearings together; None where no standard rates them."""
        return self.point.life


@dataclass(frozen=True)
class Fits(Result):
    """What the tolerances of the seats do, in five columns."""

    quantities = "scene = scene.name", "speed_rpm = scene.operation.speed_rpm", "columns", "remarks"

    scene: Scene
    columns: tuple[Column, ...]
    """From the loosest fit to the tightest, those with an equilibrium. With two seats of a tolerance the
    probable columns of figures that depend on both rings have a pair of interferences of which 0.135 % are
    looser or tighter."""
    remarks: tuple[str, ...]
    """How the columns were found."""

    def column(self, take: Take) -> Column:
        """Return the column of a take."""
        return next(one for one in self.columns if one.take == take)

    def words(self, number: int) -> str:
        """Return where the interferences of a bearing come from; ``number``: from 1."""
        middle = self.columns[len(self.columns) // 2]
        (mean,) = [bearing for bearing in middle.bearings if bearing.number == number]
        return "; ".join(f"{ring} ring {seat.words}" for ring, seat in mean.seats.items())


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
    require(whole, "fits")
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
    still = still_of(scene_of(scene))
    if still.fit is None:
        table = f"{still.assembly.table}.fit"
        raise SceneError(
            f"{still.name}: has no fit, its rings are as drawn: add [{table}] with [{table}.shaft] or "
            f'[{table}.housing], as shaft_class = "js4" with bearing_class = "P4", or interference_um = 2.0'
        )
    return still


def _tolerated(fit: Fit) -> list[Side]:
    """Seats whose interference follows from classes."""
    seats = [(side, getattr(fit, side.seat)) for side in SIDES]
    return [side for side, seat in seats if seat is not None and getattr(seat, side.class_key) is not None]


def _scenes(scene: Scene) -> tuple[dict[Take, Scene], tuple[str, ...]]:
    """Return the scene of each column, and how they were found."""
    fit = scene.fit
    assert fit is not None
    scenes = {take: with_interference(scene, take) for take in TAKES}
    sides = _tolerated(fit)
    if not sides:
        return scenes, ("interferences are given, not classes: all columns are equal",)
    if len(sides) == 1:
        return scenes, ()
    for take, pair in _probable(scene).items():
        changes = {
            side.seat: getattr(fit, side.seat).model_copy(
                update={"interference_um": um, side.class_key: None}
            )
            for side, um in zip(sides, pair, strict=True)
        }
        scenes[take] = with_fit(scene, fit.model_copy(update=changes))
    return scenes, (
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
    if not scene.assembly.joined:
        return scene
    spindle = set_of(scene)
    none = dict.fromkeys(f"{side.seat}_interference_um" for side in SIDES)
    bearings = tuple(bearing.model_copy(update=none) for bearing in spindle.bearing)
    return scene.model_copy(update={"spindle": spindle.model_copy(update={"bearing": bearings})})


def _um(scene: Scene, side: Side, take: Take) -> float:
    """Return the interference (um) of a seat after loss by roughness."""
    interference_um = interferences(scene, take)[SIDES.index(side)]
    assert interference_um is not None
    return interference_um.um


def column_at(scene: Scene, take: Take, point: OperatingPoint) -> Column:
    """Return a column from its operating point; each seat has its own interference of that take."""
    bearings = []
    for k, (bearing, member) in enumerate(zip(point.bearings, scene.bearings(), strict=True)):
        fit = member.scene.fit
        assert fit is not None
        own = mounted(with_fit(bearing.scene, fit.model_copy(update={"take": take})))
        seats = {ring: _seat(own, scene, k, ring, take) for ring in own.seats}
        joint = mounted(bearing.scene)
        angles = {key: joint.free_angle(share * joint.speed, warm) for key, (share, warm) in STATES.items()}
        drawing = {"drawing": joint.scene.bearing.free_angle}
        loads, apart = preloads(point, k), axial_gaps(point)
        bearings.append(FitPoint(k + 1, seats, drawing | angles, loads, apart, bearing, own, joint))
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
