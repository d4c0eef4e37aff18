"""`error_motion`: error motion of the axis of rotation of a scene, over speeds."""

import math
import os
import pathlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, get_args

from fmu_bearing.files import check_folder
from fmu_bearing.instance import number
from fmu_bearing.metrology.at_speed import DIRECTIONS, AtSpeed, MotionLine, Part, Values
from fmu_bearing.metrology.nose import FEWEST, MOST, nose_of_run
from fmu_bearing.modal.campbell.doubts import doubt
from fmu_bearing.modal.modes.points import given
from fmu_bearing.progress import keeping
from fmu_bearing.results.base import Result, table
from fmu_bearing.results.picture_parts import save
from fmu_bearing.results.table import Table, write_csv
from fmu_bearing.run.choose import resolve
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.scene.member import set_of
from fmu_bearing.scene.shaft import LONG
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What motion counts from.
Against = Literal["outer ring", "ground"]
#: Said with every result.
BOUND = (
    "the computed synchronous error is a lower bound: drive, seats out of round, artefact and heat add to it"
)
#: Files that `ErrorMotion.save` writes into its folder.
FILES = ("error-motion.csv", "lines.csv", "bearings.csv", "sources.csv", "polar.png")
_MOST_REVOLUTIONS = 2000
_LINES = 12  # of a table on a terminal
_LISTED = 60  # of a file


@dataclass(frozen=True)
class ErrorMotion(Result):
    """Error motion of the axis of rotation over speeds.

    Examples
    --------
    >>> from fmu_bearing import error_motion, with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
    >>> found = error_motion(scene, 20e3, at=-0.01, revolutions=20)
    >>> columns, rows = found.per_source()
    >>> [row[2] for row in rows]
    ['inner race', 'outer race', 'ball sizes, cage', 'ball form']
    >>> found.against, found.speeds[0].revolutions
    ('outer ring', 20)
    """

    quantities = "scene = scene.name", "at_m", "against", "speeds", "remarks"

    scene: Scene
    speeds: tuple[AtSpeed, ...]
    """Each with ``values`` by direction, ``lines``, ``per_bearing``, ``per_source``, ``remarks()``."""
    at: float
    """Place of the point (m): along X from the middle of a single bearing, from the nose of a set."""
    against: Against
    """What motion counts from: ``outer ring`` or ``ground``."""
    doubt: str = ""
    """Why values of fidelities rings and response are in doubt; "" where they are not."""

    def table(self) -> Table:
        """Columns and rows of a table: each direction at each speed; empty where there is no such value."""
        rows = [
            [f"{speed.rpm:g}", f"{speed.revolutions}", *row]
            for speed in self.speeds
            for row in table(Values, speed.values)[1]
        ]
        return ["r/min", "turns", *table(Values, ())[0]], rows

    def lines(self, count: int = _LINES) -> Table:
        """Columns and rows of the largest radial lines at each speed: order, amplitudes, source, bearing."""
        return self._over_speeds(MotionLine, lambda one: one.lines[:count])

    def per_bearing(self) -> Table:
        """Columns and rows: asynchronous error motion that the lines of each bearing make alone."""
        heads = ("bearing", "radial, um", "axial, um", "tilt, urad")
        return self._over_speeds(Part, lambda one: one.per_bearing, heads)

    def per_source(self) -> Table:
        """Columns and rows: asynchronous error motion that each source of each bearing makes alone."""
        return self._over_speeds(Part, lambda one: one.per_source)

    def polar(self, direction: str = "rotating") -> "Figure":
        """Return polar plots of a direction at each speed: revolutions pale, the mean contour bold.

        Of more than six speeds, six evenly among them are drawn.

        Raises
        ------
        ValueError
            For an unknown direction.
        MissingExtra
            Without Matplotlib (extra ``plots``).
        """
        from fmu_bearing.metrology.polar_plot import polar_plot

        if direction not in DIRECTIONS:
            raise ValueError(f"direction = {direction!r} is refused: it is {', '.join(DIRECTIONS)}")
        return polar_plot(self.speeds, direction)

    def remarks(self) -> list[str]:
        """Return what the values do not say: lines near whole orders, the lower bound, doubts."""
        sentences = [line for speed in self.speeds for line in speed.remarks()]
        return list(dict.fromkeys([*sentences, *([self.doubt] if self.doubt else []), BOUND]))

    def save(
        self, folder: str | os.PathLike[str], direction: str = "rotating", *, picture: bool = True
    ) -> list[pathlib.Path]:
        """Write tables, and a polar plot where ``picture`` says so, and return the files.

        Raises
        ------
        OSError
            Where the folder cannot be written to.
        ValueError, MissingExtra
            As `polar`.
        """
        target = check_folder(folder)
        tables = (self.table(), self.lines(_LISTED), self.per_bearing(), self.per_source())
        files = [write_csv(target / name, *rows) for name, rows in zip(FILES, tables, strict=False)]
        if picture:
            files.append(target / FILES[-1])
            save(self.polar(direction), files[-1])
        return files

    def _over_speeds(
        self,
        kind: type[Result],
        of: Callable[[AtSpeed], Sequence[Result]],
        heads: Sequence[str] | None = None,
    ) -> Table:
        """Return columns and rows of what there is at each speed."""
        rows = [[f"{speed.rpm:g}", *row] for speed in self.speeds for row in table(kind, of(speed), heads)[1]]
        return ["r/min", *table(kind, (), heads)[0]], rows


@one_thread
def error_motion(
    scene: SceneSource,
    speeds: Sequence[float] | float | None = None,
    at: float = 0.0,
    revolutions: int | None = None,
    against: Against | None = None,
    *,
    inputs: Mapping[str, float] | None = None,
    track: Callable[[Sequence[float]], Iterable[float]] | None = None,
) -> ErrorMotion:
    """Return the error motion of the axis of rotation: radial, axial and tilt, at a point and over speeds.

    Each speed is a run from the steady state, read 256 times per revolution; 12 revolutions are left out.
    *Synchronous* is what repeats with the shaft: the radial value and the tilt without order 1, which is how
    far the artefact is off centre. *Asynchronous* is the largest width of the polar plot at any angle.

    Parameters
    ----------
    scene : Scene or path
        Fidelity ``auto`` is resolved, once, for the scene's own speed.
    speeds : float or sequence of float, optional
        r/min, not 0; default: the scene's own.
    at : float
        Place of the point along X (m): from the middle of the balls of a single bearing; of a set from the
        nose, negative ahead of it. The point moves with the nose as with a rigid body.
    revolutions : int, optional
        20 or more; default: 20 to 120, in which the cages turn most wholly.
    against : str, optional
        What motion counts from: ``outer ring`` (default of a single bearing) or ``ground`` (of a set).
    inputs : mapping, optional
        Other inputs of the model by name, SI units.
    track : callable, optional
        Wraps the speeds, to show progress.

    Raises
    ------
    SceneError
        If the scene cannot be read, or another model owns its shaft.
    ValueError
        For a speed, place or number that is refused.
    EngineError
        Where there is no equilibrium, or a step is refused; a ``ValueError``.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with what is finished as ``found``.

    Notes
    -----
    Terms follow ISO 230-7 and ASME B89.3.4, from memory. Waves of the inner race are asynchronous, too: they
    meet the balls, which do not turn with the shaft. What is computed as synchronous is a lower bound for a
    machine, whose drive, seats and heat are not in the model.

    Examples
    --------
    >>> from fmu_bearing import error_motion, with_fidelity
    >>> found = error_motion(with_fidelity("examples/scenes/7003C-bare.toml", model="rings"), 2000.0)
    >>> [f"{one.direction} {1e6 * one.asynchronous:.2f} um" for one in found.speeds[0].values[:3]]
    ['fixed y 0.18 um', 'fixed z 0.19 um', 'rotating 0.20 um']
    >>> found.speeds[0].lines[0].origin.name, found.speeds[0].lines[0].origin.source
    ('2 f_b - f_c', 'ball form')
    """
    found = scene_of(scene)
    require(found, "error motion")
    if against is not None and against not in get_args(Against):
        raise ValueError(f"against = {against!r} is refused: it is {' or '.join(get_args(Against))}")
    if against == "outer ring":
        require(found, "against")
    rpm = _speeds(found, speeds)
    place, count = _place(found, at), _revolutions(revolutions)
    fixed = dict(inputs or {})
    if "shaft_speed" in fixed:
        raise ValueError("shaft_speed is an axis of the table: give speeds, in r/min")
    given(found, fixed)
    resolved = resolve(found)[0]
    from_ring = not found.assembly.joined and against != "ground"
    scenes = {speed: resolved.replace({"operation.speed_rpm": speed}) for speed in rpm}
    done: list[AtSpeed] = []

    def study() -> ErrorMotion:
        doubted = next(filter(None, (doubt(one, fixed) for one in scenes.values())), "")
        return ErrorMotion(found, tuple(done), place, "outer ring" if from_ring else "ground", doubted)

    with keeping(done, study):
        for speed in track(rpm) if track else rpm:
            done.append(AtSpeed(nose_of_run(scenes[speed], place, count, from_ring, fixed)))
    return study()


def _speeds(scene: Scene, speeds: Sequence[float] | float | None) -> list[float]:
    """Return speeds (r/min) in the order given, checked."""
    if callable(speeds):
        raise ValueError(
            "speeds: a speed that changes is refused, because no revolution repeats another; give constant "
            "ones, in r/min"
        )
    if speeds is None:
        asked: Sequence[Any] = [scene.operation.speed_rpm]
    else:
        asked = list(speeds) if isinstance(speeds, Iterable) and not isinstance(speeds, str) else [speeds]
    distinct = list(dict.fromkeys(number("speeds", one) for one in asked))
    if not distinct:
        raise ValueError("speeds: none is given; give r/min, or leave speeds out for the scene's own")
    most = scene.most_speed
    for speed in distinct:
        if abs(speed) > most:
            raise ValueError(f"speeds: {speed:g} r/min is refused: allowed are {-most:g} to {most:g} r/min")
        if speed == 0.0:
            raise ValueError("speeds: 0 r/min is refused: an axis of rotation needs a shaft that turns")
    return distinct


def _place(scene: Scene, at: float) -> float:
    """Return the place of the point (m), checked."""
    place = number("at", at)
    longest = 1e-3 * LONG
    low, high, whence = -longest, longest, "the middle of the bearing"
    if scene.assembly.joined:
        shaft = set_of(scene).shaft
        # the nose of a shaft that bends says nothing about places behind it
        high = 0.0 if shaft.flexible else 1e-3 * shaft.length_mm
        whence = "the nose of the shaft" + (", which bends behind it" if shaft.flexible else "")
    if not (math.isfinite(place) and low <= place <= high):
        raise ValueError(
            f"at = {1e3 * place:g} mm is refused, no place of the shaft or ahead of it: allowed are "
            f"{1e3 * low:g} to {1e3 * high:g} mm from {whence}"
        )
    return place


def _revolutions(revolutions: int | None) -> int | None:
    """Return the number of revolutions, checked; None: by the cages."""
    if revolutions is None:
        return None
    value = number("revolutions", revolutions)
    if value != round(value) or not FEWEST <= value <= _MOST_REVOLUTIONS:
        raise ValueError(
            f"revolutions = {value:g} is refused: allowed are whole numbers from {FEWEST}, below which the "
            f"width of a polar plot is no asynchronous value, to {_MOST_REVOLUTIONS}; leave it out for "
            f"{FEWEST} to {MOST} in which the cage turns wholly"
        )
    return int(value)
