"""A new scene at a sound operating point: speed and preload by makers' rules where they are not given."""

import math
from collections.abc import Callable
from typing import Any

from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.rating import speed_limit
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.modal.equations.remarks import LOOSE, UNSTEADY
from fmu_bearing.progress import Tell, silent
from fmu_bearing.scene import Scene, SceneError, read_scene_text, template
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.own_bearing import Dimensions, is_deep_groove
from fmu_bearing.scene.preload import CLASS, OFFSET, PreloadError, preload

_SPEED_SHARE = 0.5  # of the limiting speed
_SPEED_NUMBER = 0.75e6  # mm r/min, where no maker gives a limit
_PRELOAD_SHARE = 1.2  # of the least preload, which scatters by 9 %
_RAISED, _LOWERED = 1.1, 0.9  # a step of the preload, of the speed
_SLOWEST = 0.6  # of the speed by the rule: the search for one without cautions ends there
#: mm r/min: n d_m of deep groove bearings with grease that makers allow (from memory), and a light load over
#: C (chosen), by which a new scene of one is made.
_DEEP_SPEED_NUMBER, _LIGHT = 0.5e6, 0.05
_SPRING = "spring_N"
_WHIRL = "whirl"
#: Cautions that more preload cures.
_CURED = {"gyroscopic": "gyroscopic slip", _WHIRL: "a whirl by itself"}


def new_scene(
    name: str,
    bearing: str | Dimensions,
    *,
    speed_rpm: float | None = None,
    preload_N: float | None = None,
    tell: Tell = silent,
    **given: Any,
) -> str:
    """Return the text of a new scene file; what is not given is assumed, marked, with its rule.

    The speed is half of the maker's limit with oil, or with grease where that is the supply, else of the one
    by n d_m; it is lower where no preload would keep all verdicts good. The preload is the light class or 1.2
    times the least one against skidding, whichever is larger, and more where the balls would slip by their
    gyroscopic moment or a mode of the rings would grow by itself. At a speed that is given the preload stays
    below what makers would caution of. Sets follow the same rules: the class is that of a pair, of which the
    load of each bearing follows.

    A deep groove bearing has no preload unless one is given, but a radial load: 0.05 C where none is given.

    Parameters
    ----------
    name : str
        Of the scene.
    bearing : str or Dimensions
        A bearing of the catalogue, or dimensions from which the rest is estimated.
    speed_rpm, preload_N : float, optional
    tell : callable
        Takes a line where the preload of a set is searched for, which may take a minute.
    **given
        As of `scene.template.new_scene`: ``kind``, ``grade``, ``lubricant``, ``supply``, ``sound``,
        ``designation``, ``preload_class``, ``preload_offset_um``, ``folder``, ``radial_load_N``,
        ``clearance``; ``stiffness_N_um``, ``stiffness_preload_N``, ``stiffness_of``; for a set
        ``arrangement``, ``distance_mm``, ``spring_N``; ``spall_mm``.

    Raises
    ------
    SceneError
        For names that are not in the catalogue and values outside their range.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import new_scene
    >>> from fmu_bearing.scene import read_scene_text
    >>> text = new_scene("my", "NSK-7010C", kind="hybrid", sound=False)
    >>> for line in text.splitlines():
    ...     if line.startswith(("preload_N", "speed_rpm")):
    ...         print(line)
    preload_N = 242.0 # assumed: light class of NSK: 150 N, raised from 150 N against gyroscopic slip
    speed_rpm = 13500.0 # assumed: half of NSK's limiting speed with oil
    >>> pair = new_scene("pair", "NSK-7010C", arrangement="DB", preload_class="medium", speed_rpm=18e3)
    >>> read_scene_text(pair).spindle.arrangement, read_scene_text(pair).spindle.preload.preload_N
    ('DB (O)', 390.0)
    """

    def text(speed: float, force: float, **rules: Any) -> str:
        return template.new_scene(name, bearing, speed_rpm=speed, preload_N=force, **(given | rules))

    others = [key for key in (CLASS, OFFSET, _SPRING) if given.get(key) is not None]
    if preload_N is not None and others:
        raise SceneError(f"preload_N = {preload_N:g} cannot be given with {others[0]}: give one of both")
    preloaded = preload_N is not None or bool(others)
    if is_deep_groove(bearing):
        return _deep_groove(text, name, speed_rpm, preload_N, given)
    if speed_rpm is not None and preloaded:
        return text(speed_rpm, preload_N or 0.0)
    # speed and force of the draft are replaced below
    draft = read_scene_text(text(1e3, preload_N or 1.0), name, given.get("folder"))
    speed_rule = preload_rule = ""
    speed = speed_rpm
    if speed is None:
        speed, speed_rule = _speed(draft, bearing)
    if preloaded:
        return text(speed, preload_N or 0.0, speed_rule=speed_rule)
    if draft.assembly.joined:
        tell("looking for a preload with good verdicts, up to a minute; a given one takes none ...")
    force, preload_rule, good = _preload(_at(draft, speed))
    slower = speed
    while speed_rpm is None and not good and slower > _SLOWEST * speed:
        slower = _rounded(_LOWERED * slower)
        lighter, rule, good = _preload(_at(draft, slower))
        if good:
            force, preload_rule = lighter, rule
            speed_rule += (
                f", lowered from {speed:g} r/min for good verdicts at a preload within makers' classes"
            )
            speed = slower
    return text(speed, force, speed_rule=speed_rule, preload_rule=preload_rule)


def _deep_groove(
    text: Callable[..., str], name: str, speed: float | None, preload_N: float | None, given: dict[str, Any]
) -> str:
    """Return the text of a scene of a deep groove bearing; ``text``: makes it of a speed and a preload."""
    force, rules = preload_N or 0.0, dict[str, Any]()
    bearing = read_scene_text(text(1e3, force), name, given.get("folder")).bearing
    if speed is None:
        speed = min(
            _rounded(_SPEED_SHARE * _DEEP_SPEED_NUMBER / bearing.pitch_diameter_mm), bearing.most_speed
        )
        rules["speed_rule"] = f"half of n d_m of {1e-6 * _DEEP_SPEED_NUMBER:g}e6 mm r/min, usual with grease"
    if force == 0.0 and given.get("radial_load_N") is None:
        rules["radial_load_N"] = _rounded(_LIGHT * bearing.dynamic_rating)
        rules["radial_rule"] = f"{_LIGHT:g} C, a light load"
    return text(speed, force, **rules)


def _speed(scene: Scene, bearing: str | Dimensions) -> tuple[float, str]:
    """Return the assumed speed (r/min) of a bearing, and its rule."""
    size = sizes().get(bearing) if isinstance(bearing, str) else None
    pitch, limit = scene.bearing.pitch_diameter_mm, speed_limit(scene)
    greased = scene.lubricant.greased
    printed = math.inf if size is None else size.grease_speed if greased else size.oil_speed
    supply = "grease" if greased else "oil"
    if math.isfinite(printed):
        speed, rule = _SPEED_SHARE * printed, f"half of NSK's limiting speed with {supply}"
    elif limit is not None:
        speed = _SPEED_SHARE * limit / pitch
        rule = f"half of makers' n d_m with {supply}, {1e-6 * limit:.3g}e6 mm r/min"
    else:
        speed, rule = _SPEED_NUMBER / pitch, f"n d_m of {1e-6 * _SPEED_NUMBER:g}e6 mm r/min, no maker's limit"
    return min(_rounded(speed), scene.bearing.most_speed), rule


def _preload(scene: Scene) -> tuple[float, str, bool]:
    """Return the assumed preload (N) at the scene's speed, its rule, and whether it cures all it can."""
    try:
        light = preload({CLASS: "light"}, scene.bearing, scene.materials, scene.assembly.carries)
    except PreloadError:  # no classes at this angle
        light = None
    force, rule = (0.0, "") if light is None else light
    # the least preload depends on the contact angles, and so a little on the preload
    least = _PRELOAD_SHARE * operating_point(_at(scene, force=max(force, 1.0))).bearings[0].least_preload
    if force < least:
        force, rule = _rounded(least), f"{_PRELOAD_SHARE:g} times the least preload at this speed"
    most = scene.bearing.most_preload
    first, cured = force, set[str]()
    at_first = found = _wrong(_at(scene, force=force))
    while found & _CURED.keys():
        more = min(_rounded(_RAISED * force), most)
        after = _wrong(_at(scene, force=more))
        if more == force or after - _CURED.keys() - at_first:
            return force, _raised(rule, first, force, cured | (found & _CURED.keys())), False
        cured |= found & _CURED.keys()
        force, found = more, after
    return force, _raised(rule, first, force, cured), True


def _raised(rule: str, first: float, force: float, cured: set[str]) -> str:
    if force == first:
        return rule
    return f"{rule}, raised from {first:.4g} N against {' and '.join(_CURED[key] for key in sorted(cured))}"


def _wrong(scene: Scene) -> set[str]:
    """Return what is not good at a scene's operating point: keys of verdicts, and that it is not steady."""
    point = operating_point(scene)
    keys = {verdict.key for verdict in verdicts(point) if verdict.judgement in ("watch", "change")}
    return keys | ({_WHIRL} if {UNSTEADY, LOOSE} & set(point.remarks) else set())


def _at(scene: Scene, speed: float | None = None, force: float | None = None) -> Scene:
    """Return a scene at another speed (r/min), and under another preload (N) of each bearing."""
    assembly = scene.assembly
    given = {"operation.speed_rpm": speed, assembly.preload_key: force}
    if force is not None and not assembly.can_preload:
        given = {"operation.speed_rpm": speed, "spindle.load.force_x_N": force * len(assembly.members)}
    return scene.replace({key: value for key, value in given.items() if value is not None})


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
