"""A bearing from its boundary dimensions, with rules of thumb for the dimensions that catalogues leave out.

Each rule names the bearings it was derived from, and their scatter. All its values are assumed.

Ball and number of balls: against NSK's 60 sizes of series 70 and 79 (`fmu_bearing.scene.nsk`), whose balls
follow from printed ratings, 0.29 of outside diameter minus bore is off by 4.0 % rms (0.25 to 0.31 occur;
0.27, the rule before, was off by 7.5 %), and 0.79 (70) and 0.73 (79) of a full circle by 4.2 % rms, 2 balls
at most; C is 0.997 of print in the mean. NSK's 11 sizes 7201 to 7206 and 7301 to 7305 BEA (40 deg) have 0.311
to 0.337 of it, and 0.84 to 0.90 of a full circle; 0.29 gives 0.71 to 0.82 of their C. The dimension series
chooses the rule.

Balls of one's own bearing follow from C and C0 as the maker prints them (`balls_of_ratings`): of those 11
sizes within 0.4 %, where the next other ball is off by 1.3 % or more.

Conformities 0.52 and 0.525: against 240 axial stiffnesses of pairs that NSK prints, with these balls, the
median is 1.01, rms 2.7 % (0.515 and 0.52, the rule before: 1.10, 11 %).
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

from fmu_bearing.formulas import iso76, iso281
from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.bearing import MOST_BALLS, most_balls
from fmu_bearing.scene.dimension_series import series_of


class _Rule(NamedTuple):
    """Ball over outside diameter minus bore, balls over a full circle, and of which bearings that is."""

    share: float
    filled: float
    remark: str
    whose: str
    angles: tuple[float, float]  # deg: of the bearings that it was derived from, 5 deg more on both sides
    bores: tuple[float, float]  # mm: of the same


_SPINDLE = (10.0, 30.0), (10.0, 70.0)  # deg, mm: of the catalogue
_PUMP = (35.0, 45.0), (12.0, 35.0)
_RULES = {
    "19": _Rule(0.29, 0.73, "series 79 has 0.26 to 0.31", "series 79, 15 and 25 deg", *_SPINDLE),
    "10": _Rule(0.29, 0.79, "series 70 has 0.26 to 0.30", "series 70, 15 and 25 deg", *_SPINDLE),
    "02": _Rule(0.32, 0.87, "series 72 has 0.31 to 0.34", "series 72, 40 deg", *_PUMP),
    "03": _Rule(0.32, 0.87, "series 73 has 0.31 to 0.33", "series 73, 40 deg", *_PUMP),
}
#: Of series without data: the next one that has some.
_NEXT_SERIES = {"18": "19", "": "03"}
#: Ball over outside diameter minus bore: what rings can hold.
_LEAST_SHARE, _MOST_SHARE = 0.2, 0.42
_BRIDGE = 1.03  # of a pocket, from one to the next at the cage's bore: chosen
_INCH = 25.4 / 64.0  # mm: balls come in steps of 1/64 inch and of 0.5 mm
_SURE, _MOST_MISFIT = 0.03, 0.2  # of C and C0: beyond the first a caution, beyond the second a refusal
_CLOSE = 0.005  # of C and C0: balls that meet them worse by less, or by less than twice, are as likely
_NEXT = 0.015  # of a ball's diameter: another ball, not the same in inches and millimetres


class Estimate(NamedTuple):
    """A value for a key of ``[bearing]`` or ``[bearing.cage]``, and the rule it comes from."""

    key: str
    value: float | int | str
    rule: str

    @property
    def text(self) -> str:
        """The value as TOML."""
        return f'"{self.value}"' if isinstance(self.value, str) else str(self.value)


class Balls(NamedTuple):
    """Balls of a bearing: diameter (mm), number, where both come from, and why they are in doubt."""

    diameter: float
    number: int
    diameter_rule: str
    number_rule: str
    doubt: str = ""


def balls_by_rule(bore: float, outside: float, angle: float) -> Balls:
    """Return the balls that the rule for a dimension series gives (mm, deg)."""
    series = series_of(bore, outside)
    rule = _RULES[_NEXT_SERIES.get(series, series)]
    (low, high), (least, most) = rule.angles, rule.bores
    doubt = ""
    if series not in _RULES:
        what = f"of dimension series {series}" if series else "of no dimension series that is known here"
        doubt = f"a bearing {what}"
    elif not low <= angle <= high:
        doubt = f"a bearing of dimension series {series} and {angle:g} deg"
    elif not least <= bore <= most:
        doubt = f"a bearing of dimension series {series} and {bore:g} mm of bore"
    if doubt:
        doubt = (
            f"the balls of {doubt} are estimated by a rule from {rule.whose}, bores of {least:g} to {most:g} "
            "mm: C may be off by 20 %, life by half; give the maker's C and C0 (--dynamic-rating, "
            "--static-rating)"
        )
    ball = round(rule.share * (outside - bore), 3)
    pitch = 0.5 * (bore + outside)
    return Balls(
        ball, round(rule.filled * most_balls(pitch, ball)),
        f"{rule.share} of outside diameter minus bore; {rule.remark}",
        f"{rule.filled:g} of a full circle of balls", doubt,
    )  # fmt: skip


def balls_of_ratings(
    bore: float, outside: float, angle: float, dynamic: float, static: float, ceramic: bool = False
) -> Balls:
    """Return the standard balls whose C and C0 by ISO 281 and ISO 76 are nearest to printed ones.

    Parameters
    ----------
    bore, outside : float
        mm.
    angle : float
        Contact angle (deg).
    dynamic, static : float
        C and C0 (N) as the maker prints them.
    ceramic : bool
        With ceramic balls, for which makers print C0 of steel balls or 0.7 of it: what fits better counts.

    Raises
    ------
    SceneError
        Where no balls give these ratings within 20 %.
    """
    for name, value in (("C", dynamic), ("C0", static)):
        if not (math.isfinite(value) and value > 0.0):
            raise SceneError(f"{name} = {value:g} N is refused: a load rating is above 0, in N")
    height, pitch, alpha = outside - bore, 0.5 * (bore + outside), math.radians(angle)
    low, high = _LEAST_SHARE * height, _MOST_SHARE * height
    sizes = [k * step for step in (_INCH, 0.5) for k in range(math.ceil(low / step), int(high / step) + 1)]
    candidates = []
    for ball in {round(size, 3) for size in sizes}:
        for number in range(3, min(most_balls(pitch, ball), MOST_BALLS) + 1):
            if _least_cage_bore(ball, number) >= pitch:
                continue  # pockets would leave no bridges
            size = (number, ball, pitch, alpha)
            c, c0 = iso281.dynamic_rating(*size), iso76.static_rating(*size)
            for share in (1.0, iso76.HYBRID) if ceramic else (1.0,):
                misfit = max(abs(math.log(c / dynamic)), abs(math.log(share * c0 / static)))
                candidates.append((misfit, ball, number, c, share * c0, share))
    candidates.sort()
    if not candidates or candidates[0][0] > _MOST_MISFIT:
        near = ""
        if candidates:
            _, ball, number, c, c0, _ = candidates[0]
            near = f": the nearest, {number} x {ball:g} mm, have {c:.0f} and {c0:.0f} N"
        raise SceneError(
            f"C = {dynamic:g} N and C0 = {static:g} N: no balls between a bore of {bore:g} and an outside "
            f"diameter of {outside:g} mm at {angle:g} deg have these ratings{near}; are they in N, of this "
            "bearing?"
        )
    misfit, ball, number, c, c0, share = candidates[0]
    other = next((one for one in candidates if abs(one[1] / ball - 1.0) > _NEXT or one[2] != number), None)
    rule = (
        f"derived from C {dynamic:g} N and C0 {static:g} N by ISO 281 and ISO 76, within "
        f"{100.0 * misfit:.1f} %"
        + (f", C0 read as {share:g} of that with steel balls" if share < 1.0 else "")
    )
    doubt = ""
    if misfit > _SURE:
        doubt = (
            f"{number} balls of {ball:g} mm come nearest to C = {dynamic:g} N and C0 = {static:g} N, with "
            f"{c:.0f} and {c0:.0f} N by ISO 281 and ISO 76: the maker rates otherwise, or these are of "
            "another bearing"
        )
    elif other is not None and other[0] < misfit + max(_CLOSE, misfit):
        doubt = (
            f"{number} balls of {ball:g} mm meet C and C0 within {100.0 * misfit:.1f} %, and {other[2]} of "
            f"{other[1]:g} mm within {100.0 * other[0]:.1f} %: set ball_diameter_mm and ball_count if you "
            "know them"
        )
    return Balls(ball, number, rule, rule, doubt)


def estimates(
    bore: float, outside: float, width: float, angle: float, balls: Balls | None = None
) -> Iterator[Estimate]:  # fmt: skip
    """Yield the values of ``[bearing]`` for these dimensions.

    Parameters
    ----------
    bore, outside, width : float
        Boundary dimensions (mm).
    angle : float
        Contact angle (deg).
    balls : Balls, optional
        Default: by the rule for the dimension series.

    Raises
    ------
    SceneError
        For dimensions that leave no room for balls.
    """
    check_dimensions(bore, outside, width)
    balls = balls or balls_by_rule(bore, outside, angle)
    ball = balls.diameter
    pitch = 0.5 * (bore + outside)
    land = 0.7 * ball
    yield Estimate("pitch_diameter_mm", pitch, "mean of bore and outside diameter")
    yield Estimate("ball_diameter_mm", ball, balls.diameter_rule)
    yield Estimate("ball_count", balls.number, balls.number_rule)
    yield Estimate("contact_angle_deg", angle, "")
    yield Estimate("inner_conformity", 0.52, "agrees with makers' printed stiffness of pairs")
    yield Estimate("outer_conformity", 0.525, "agrees with makers' printed stiffness of pairs")
    yield Estimate("inner_ring_outer_diameter_mm", round(pitch - land, 2), "0.7 ball diameters below pitch")
    yield Estimate("outer_ring_inner_diameter_mm", round(pitch + land, 2), "0.7 ball diameters above pitch")
    yield Estimate("contact_damping_us", 2.5, "Kraemer (1993): 2.5 to 25 us")
    yield Estimate("race_roughness_um", 0.02, "fine honing")
    yield Estimate("ball_roughness_um", 0.01, "grade 5 or better")


def check_dimensions(bore: float, outside: float, width: float) -> None:
    """Refuse boundary dimensions (mm) that leave no room for balls."""
    if not 0.0 < bore < outside or not width > 0.0:
        raise SceneError(
            f"bore {bore:g}, outside diameter {outside:g} and width {width:g} mm: the outside diameter must "
            "exceed the bore, and all must be positive"
        )


def _pocket(ball: float) -> float:
    """Return the diameter (mm) of a pocket for a ball (mm)."""
    return round(1.02 * ball, 3)


def _least_cage_bore(ball: float, number: int) -> float:
    """Return the smallest bore (mm) of a cage that leaves bridges between pockets for balls (mm)."""
    return _BRIDGE * _pocket(ball) / math.sin(math.pi / number)


def cage_estimates(
    bore: float, outside: float, width: float, ball: float, number: int = 0, pressed: bool = False
) -> Iterator[Estimate]:
    """Yield the values of ``[bearing.cage]`` for these dimensions and balls of a diameter (mm).

    ``number`` of balls: many balls leave room between the pockets at a larger bore alone; 0: not regarded.
    ``pressed``: of a ribbon, which has no lands, else machined.
    """
    pitch = 0.5 * (bore + outside)
    pocket = _pocket(ball)
    inner, rule = round(pitch - 0.55 * ball, 2), "0.55 ball diameters below pitch"
    if number and (least := _least_cage_bore(ball, number)) > inner:
        inner, rule = round(least, 2), f"{number} pockets leave bridges there, of 3 % of a pocket"
    if pressed:
        yield Estimate("guidance", "balls", "a pressed cage")
    else:
        guided = "makers guide many machined cages on the outer ring: see the print"
        yield Estimate("guidance", "inner", guided)
        yield Estimate("land_clearance_mm", round(0.025 + 0.001 * bore, 3), "25 um and 1 um per mm of bore")
    yield Estimate("outside_diameter_mm", round(pitch + 0.38 * ball, 2), "0.38 ball diameters above pitch")
    yield Estimate("bore_mm", inner, rule)
    yield Estimate("width_mm", round(0.9 * width, 2), "0.9 of the rings' width")
    yield Estimate("pocket_diameter_mm", pocket, "2 % larger than a ball")
    yield Estimate("mass_eccentricity_um", 5.0, "")
    yield Estimate("pocket_damping_N_s_m", 0.02, "")
    yield Estimate("pocket_friction", 0.05, "")
