"""Warnings about the state that a bearing has reached: what a number beyond its threshold means.

The library and both kinds of FMU give the same ones, each once.
"""

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.layout import SP, P, U, Z
from fmu_bearing.interface.outputs import first_output
from fmu_bearing.prepare.model import Model
from fmu_bearing.scene import Scene
from fmu_bearing.scene.fit import interferences
from fmu_bearing.scene.words import loose_words


@dataclass(frozen=True)
class Caution:
    """A warning where a number is below a threshold, or ``above`` it: ``before``, it scaled, ``after``.

    Attributes
    ----------
    index : int
        Place of the number in its array.
    threshold : float
    scale : float
        Factor on the number in the text.
    before, after : str
        Text around the number.
    decimals : int
        Digits of the number behind the point.
    array : str
        ``z`` or ``u``.
    above : bool
        Whether the warning is due above the threshold.
    """

    index: int
    threshold: float
    scale: float
    before: str
    after: str
    decimals: int = 1
    array: str = "z"
    above: bool = False

    def due(self, value: float) -> bool:
        """Whether the warning belongs to this value."""
        return value > self.threshold if self.above else value < self.threshold


def _shoulder(ring: str, other: str) -> Caution:
    return Caution(
        Z.BEARING_OUTPUTS.index(f"contact.{ring}.shoulder_margin"),
        0.0,
        -180.0 / math.pi,
        f"the ellipse of the most loaded contact of the {ring} race reaches ",
        f" deg beyond its shoulder (bearing.{ring}_ring_{other}_diameter_mm): the edge cuts in there, while "
        "loads and stiffness are computed for an unbroken groove; reduce preload or load",
    )


_WAVES = Caution(
    Z.BEARING_OUTPUTS.index("solver.wave_time"),
    7.9e-6,  # s: 20.1 kHz, the audible range
    1e6,
    "the fastest wave of races and balls turns by one radian in ",
    " us, which internal steps have to follow: its frequency lies above 20 kHz; for speed give a lower "
    "imperfections.highest_order or highest_frequency_kHz, or one scene for low and one for high speeds",
)
_SHOULDERS = (_shoulder("inner", "outer"), _shoulder("outer", "inner"))
RESTARTS = "solver.restarts"
_RESTARTS = Caution(
    Z.BEARING_OUTPUTS.index(RESTARTS),
    0.0,
    1.0,
    "the model of this fidelity had no step from the state reached, as where balls leave both races; ",
    " times so far (solver.restarts) rings and balls were restarted from rest at the present inputs; clock, "
    "angles, heats and sound go on, but vibration and levels just after are meaningless; fidelity full steps "
    "through it, and with more preload no ball leaves its races",
    decimals=0,
    above=True,
)
GROWTH = "solver.growth"
#: 1/s: slower growth is not reported. The mean over one ball pitch gives neutral motions of balls under a
#: radial load up to 2.7 1/s; growth of 5 1/s must be reported.
GROWS = 3.0
_GROWTH = Caution(
    Z.BEARING_OUTPUTS.index(GROWTH),
    GROWS,
    1.0,
    "by the linear equations of this fidelity a motion of the rings grows by itself at the present inputs, ",
    " 1/s (solver.growth): in rings it becomes a whirl, response leaves it out, and in fidelity full a "
    "cage whose balls leave their pockets mostly holds it; velocities and levels are in doubt from here on, "
    "by the model of this fidelity, not by your inputs; take fidelity full",
    decimals=0,
    above=True,
)
_RADIALLY_TIGHT = Caution(
    Z.FREE_ANGLE,
    1e-6,  # rad: the outputs of an angle that has no cosine are zero
    180.0 / math.pi,
    "fits leave no radial clearance, so that unloaded balls touch both races at ",
    " deg: preload and loads then follow from the fits more than from what is asked; give less interference "
    "({}), or a larger bearing.contact_angle_deg",
)
_ALWAYS = (*_SHOULDERS, _WAVES, _RESTARTS, _GROWTH)
_UNLOADED = Caution(
    Z.BEARING_OUTPUTS.index("contact.inner.load_mean"),
    1.0,  # N, assumed: at speed balls are thrown outwards and their load goes to zero only by and by
    1.0,
    "its inner race carries ",
    " N per ball: the bearing is unloaded; loose balls skid or lift off, and what they then do depends on "
    "gravity and chance more than on the bearing; give more preload or less load",
)
_IDLE = replace(
    _UNLOADED, after=_UNLOADED.after.replace("give more preload or less load", "give it a load, or a preload")
)
_PRESSED = Caution(
    Z.CLEARANCE,
    0.0,
    1e6,
    "fits and heat leave a radial clearance of ",
    " um, so that balls are pressed between the races without load, more with each kelvin that the inner "
    "ring is warmer; give less interference, cooler rings, or a larger clearance",
)
_BACKWARD = Caution(  # of a set that carries one way: another has bearings for the other one
    Z.BEARING_OUTPUTS.index("contact.inner.angle_mean"),
    -0.02,  # rad: more than a free bearing's balls sway
    180.0 / math.pi,
    "bearing 1: its contact angle is ",
    " deg: the load pushes the shaft the way that nothing holds, where races have no shoulder, while loads "
    "and stiffness are computed for a whole groove; turn a bearing, or reverse the load",
)
_FRICTIONLESS = 1e-6  # N m: below it a torque is rounding, of a bearing without friction


#: Variables that say whether the figures of a run are in doubt, see `in_doubt`.
DOUBTS = (RESTARTS, GROWTH)


def in_doubt(largest: Mapping[str, float], known: str = "") -> str:
    """Return why figures of a run are in doubt by its ``largest`` values of `DOUBTS`, or what is ``known``.

    ``known``: why they are at the values of its start, or "".
    """
    count, growth = (largest.get(name, 0.0) for name in DOUBTS)
    if count > 0.0:
        restarted = (
            "rings and balls were restarted from rest where no step was possible "
            f"({RESTARTS} = {count:.0f}): vibration and levels of this run mean nothing; take fidelity full"
        )
        return f"{restarted}; {known}" if known else restarted
    if growth > GROWS and not known:
        return (
            "by the linear equations of this fidelity a motion of the rings grew by itself in this run "
            f"({GROWTH} up to {growth:.0f} 1/s), which in fidelity full a cage mostly holds: velocities "
            "and levels are in doubt; take fidelity full"
        )
    return known


def largest_of(kept: Collection[str], values: Callable[[str], NDArray[np.float64]]) -> dict[str, float]:
    """Return the largest values of `DOUBTS` in a run, of those ``kept``; ``values``: those of a name."""
    return {name: float(values(name).max(initial=0.0)) for name in DOUBTS if name in kept}


def cautions(model: Model, growth: bool = True) -> tuple[Caution, ...]:
    """Return the warnings checked after initialisation and after each step, each given once.

    ``growth``: with that of a motion that grows by itself.
    """
    warnings = _cautions(model)
    return warnings if growth else tuple(one for one in warnings if one.before != _GROWTH.before)


def _cautions(model: Model) -> tuple[Caution, ...]:
    fidelity = FIDELITIES[int(model.parameters[P.FIDELITY])]
    if SP.has_shaft(model.parameters):
        return (*_skids(model, fidelity), *_cautions_of_set(model.scene))
    if model.scene.bearing.is_deep_groove:
        return (_IDLE, *_skids(model, fidelity), *_ALWAYS, *_fits(model.scene), *_tight(model.scene))
    before, nothing, after = loose_words(fidelity).partition("0")
    smallest = math.ulp(float(nothing))
    without = Caution(U.PRELOAD, smallest, 1.0, before, after, decimals=0, array="u")
    return (without, *_skids(model, fidelity), *_ALWAYS, *_fits(model.scene))


def _fits(scene: Scene, table: str = "mounting.fit") -> tuple[Caution, ...]:
    """Return the warnings about fits of one bearing: tight ones that let go, and no radial clearance.

    ``table``: of the file, in which they are given.
    """
    tight = replace(_RADIALLY_TIGHT, after=_RADIALLY_TIGHT.after.format(table))
    warnings = [] if scene.fit is None or scene.bearing.is_deep_groove else [tight]
    for race, (seat, interference) in enumerate(zip(("shaft", "housing"), interferences(scene), strict=True)):
        if interference is not None and interference.um > 0.0:
            ring = ("inner", "outer")[race]
            place = Z.FIT + Z.FIT_SIZE * race + Z.FIT_INTERFERENCE
            before = f"the fit of the {ring} ring lets go of the {seat} (gap now "
            after = (
                " um on diameter): the ring is computed as centred and growing by itself; give more "
                f"interference ({table}.{seat}), less speed, or a cooler ring"
            )
            warnings.append(Caution(place, 0.0, -1e6, before, after, decimals=2))
    return tuple(warnings)


def _tight(scene: Scene) -> tuple[Caution, ...]:
    """Return the warning about a deep groove bearing that fits and heat make tight; none of one drawn so."""
    own = scene.bearing.is_deep_groove and scene.bearing.radial_clearance > 0.0
    return (_PRESSED,) if own else ()


def _skids(model: Model, fidelity: str) -> tuple[Caution, ...]:
    """Return the warnings about balls that roll in a fidelity although traction cannot drive them.

    The traction of all inner contacts at the preload, at their distance from the axis, is the most torque
    that rolling balls can take from the shaft: a bearing whose friction asks for more skids. The preload is
    the scene's, as the text says: a warning has one threshold, and the input may change. Of a set, and of a
    deep groove bearing, loads depend on the statics: there the warnings come where there is no traction.
    """
    p = model.parameters
    b = model.scene.bearing
    arm = 5e-4 * (b.pitch_diameter_mm - b.ball_diameter_mm * math.cos(b.nominal_angle))
    apart = SP.has_shaft(p) or b.is_deep_groove
    along = 0.0 if apart else model.inputs[U.PRELOAD] / math.sin(b.nominal_angle)
    most = float(p[P.MU] * along * arm)
    if fidelity == "full" or (most == 0.0 and p[P.MU] > 0.0):
        return ()
    at = f" at the scene's preload, {model.inputs[U.PRELOAD]:g} N, in proportion at another" if most else ""
    before = (
        f"lubricant.traction_max = {p[P.MU]:g}: contacts carry {1e3 * most:.3g} N mm of friction torque at "
        f"most{at}, and balls that roll, as in fidelity {fidelity}, need "
    )
    # the drive turns the seals, not the balls
    seals = sum(bearing.scene.bearing.seal_torque for bearing in model.scene.bearings())
    rubbed = f" N mm, of which the seals take {seals:.3g}: " if seals else " N mm: "
    after = (
        f"{rubbed}in fidelity full they skid; cage speed, torque and the lines of cage and balls mean little "
        "here; give more traction or preload, or fidelity full"
    )
    place = Z.TORQUE
    if SP.has_shaft(p):
        place = first_output(model.scene, len(model.scene.bearings())) + SP.Z_TORQUE
    limit = max(most, _FRICTIONLESS) + seals / 1e3
    return tuple(Caution(place, sign * limit, 1e3, before, after, above=sign > 0.0) for sign in (1.0, -1.0))


def _cautions_of_set(scene: Scene) -> tuple[Caution, ...]:
    """Return the warnings about a set: of each bearing its shoulders and that it is unloaded."""
    bearings = scene.bearings()
    # one for all: their waves have the same orders
    own = first_output(scene, len(bearings))
    warnings = [
        replace(_WAVES, index=own + SP.Z_WAVE_TIME), replace(_RESTARTS, index=own + SP.Z_RESTARTS),
        replace(_GROWTH, index=own + SP.Z_GROWTH),
    ]  # fmt: skip
    for bearing in bearings:
        own_fits = *_fits(bearing.scene, "spindle.fit"), *_tight(bearing.scene)
        unloaded = _IDLE if bearing.scene.bearing.is_deep_groove else _UNLOADED
        for one in (unloaded, *_SHOULDERS, *own_fits):
            place = first_output(scene, bearing.number - 1) + one.index
            warnings.append(replace(one, index=place, before=f"bearing {bearing.number}: {one.before}"))
    if len({bearing.sign for bearing in bearings}) == 1 and not scene.bearing.is_deep_groove:
        warnings.append(replace(_BACKWARD, index=first_output(scene, 0) + _BACKWARD.index))
    return tuple(warnings)
