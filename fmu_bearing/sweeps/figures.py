"""Figures of a sweep: those of the run of a point (`run.figures`), and error motion, of another run."""

import math
from collections.abc import Sequence

from fmu_bearing.metrology.at_speed import DIRECTIONS, AtSpeed
from fmu_bearing.metrology.nose import nose_of_run
from fmu_bearing.run import figures as of_run
from fmu_bearing.run.figures import STATISTICS, Figure
from fmu_bearing.scene import Scene
from fmu_bearing.scene.exclusions import exclusion

#: Default figures.
DEFAULT = (
    "mic[*].leq_a",
    "mic[*].leq",
    "inner_ring.velocity",
    "outer_ring.velocity",
    "outer_ring.velocity:1x",
    "cage.velocity",
    "cage.speed_ratio",
    "contact.*.load_mean",
    "contact.*.angle_mean",
    "contact.*.pressure_max",
    "contact.*.shoulder_margin",
    "film.lambda_min",
    "friction_torque",
    "heat.*",
    # of a set
    "shaft.nose.velocity",
    "bearing[*].force.x",
    "bearing[*].contact.*.pressure_max",
    "bearing[*].contact.*.shoulder_margin",
)
#: Of a run of its own, read by parts of a revolution: values of `AtSpeed` in each direction.
_ERROR_MOTION, _PREFIX = "error motion", "error_motion."
_VALUES = {
    "asynchronous": "Asynchronous error motion",
    "synchronous": "Synchronous error motion, averaged,",
    "synchronous_by_line": "Synchronous error motion by line",
}
#: How each figure is taken, in words.
HOW = STATISTICS | {_ERROR_MOTION: "over 20 to 120 whole revolutions of a run of its own"}


def figures_of(
    scene: Scene, patterns: Sequence[str] | None = None, *, strict: bool = True
) -> tuple[Figure, ...]:
    """Return figures as `run.figures.figures_of`, those of error motion, too.

    ``patterns``: default: those of `DEFAULT` that the scene has.
    """
    apart = {} if exclusion(scene, "error motion") else _error_motions()
    if patterns is None:
        return of_run.figures_of(scene, DEFAULT, apart, strict=False)
    return of_run.figures_of(scene, patterns, apart, strict=strict)


def error_motions(figures: Sequence[Figure], scene: Scene) -> dict[str, float]:
    """Return the figures of error motion by name (m, rad), from a run of their own; {} where none is wanted.

    At the middle of a single bearing against its outer ring, at the nose of a set against the ground. NaN
    where the shaft does not turn.
    """
    wanted = [figure.name for figure in figures if figure.statistic == _ERROR_MOTION]
    if not wanted:
        return {}
    if scene.operation.speed_rpm == 0.0:
        return dict.fromkeys(wanted, math.nan)
    values = AtSpeed(nose_of_run(scene, 0.0, None, not scene.assembly.joined)).values
    by_name = {_named(kind, value.direction): getattr(value, kind) for value in values for kind in _VALUES}
    return {name: by_name[name] for name in wanted}


def _named(kind: str, direction: str) -> str:
    return f"{_PREFIX}{kind}.{direction.replace(' ', '_')}"


def _error_motions() -> dict[str, Figure]:
    """Return all figures of error motion by name."""
    return {
        _named(kind, direction): Figure(
            _named(kind, direction), _ERROR_MOTION, (), "rad" if "tilt" in direction else "m",
            f"{words} {direction}",
        )
        for kind, words in _VALUES.items()
        for direction in DIRECTIONS
    }  # fmt: skip
