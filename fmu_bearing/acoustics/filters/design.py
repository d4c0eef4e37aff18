"""The sound block of the engine's parameters: transfer functions turned into filters and packed flat."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.filters.blocks import Wire
from fmu_bearing.acoustics.filters.fir import band_limit, delay_of, fit
from fmu_bearing.acoustics.filters.pack import Group, Lines, Ray, pack
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies, spline_of
from fmu_bearing.acoustics.radiation.radiators import Air, Housing, Path, Radiators, Ring
from fmu_bearing.acoustics.radiation.table import Table, read_table, select
from fmu_bearing.acoustics.registry import Position, Radiation
from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.engine.layout import SD
from fmu_bearing.scene import Scene, si

__all__ = [
    "FilterError",
    "block_of",
    "filter_errors",
    "line_parameters",
    "radiation_of",
    "radiators_of",
    "silent_parameters",
    "sound_parameters",
    "table_of",
]

# Paths this far below their component's strongest one, at all frequencies, are left out.
_NEGLIGIBLE = 1e-7
# Worst deviation of a filter from its transfer function that is let pass, at any one frequency: 3 %, 0.27 dB.
# Bodies without sharp resonances keep -50 dB; `filter_errors` returns what each path has.
_TOLERANCE = 10 ** (-30 / 20)
_SILENT = 1e-12  # weight of a microphone on a node line, where rounding leaves a little
_ALIKE = 12  # decimals to which weights are compared


@dataclass(frozen=True)
class FilterError:
    """How well one filter follows its transfer function.

    Attributes
    ----------
    microphones : tuple of int
        Indices of the microphones that share it.
    component, kind : str
        Whose sound it carries, see ``engine.layout.sound_filters``.
    channel, taps : int
        Channel it filters and its length.
    error : float
        Largest deviation from 20 Hz to 20 kHz in dB, relative to the larger of the path's own magnitude and
        its component's strongest one minus 30 dB.
    """

    microphones: tuple[int, ...]
    component: str
    kind: str
    channel: int
    taps: int
    error: float


class Circle(NamedTuple):
    """Microphones that share filters: paths to them, the output and factor of each path."""

    paths: list[Path]
    targets: list[tuple[int, float]]
    group: Group


def sound_parameters(
    scene: Scene,
    modes: Sequence[Any] | None = None,
    radiators: Radiators | None = None,
    table: Table | None = None,
) -> NDArray[np.float64]:
    """Sound block of a scene for the kernels in `engine.sound`; empty when the scene has no sound.

    Parameters
    ----------
    modes
        Elastic modes of the rings in the order of the engine's coordinates, two channels each; by default
        the scene's.
    radiators, table
        What sounds, transfer functions of a set's bearing; by default as the scene says.

    Raises
    ------
    ValueError
        When a microphone lies inside a body, the table does not serve, or a filter does not follow its
        transfer function.
    """
    if scene.sound is None or not scene.microphones:
        return np.zeros(0)
    positions = [position for _, position in scene.microphones]
    radiation = radiation_of(scene, modes, radiators, table)
    return block_of(radiation, positions, details=scene.sound.details, thirds=scene.sound.third_octaves)


def line_parameters(
    scene: Scene,
    radiators: Radiators | None = None,
    table: Table | None = None,
    *,
    bearings: int = 0,
    metered: bool = True,
) -> NDArray[np.float64]:
    """Sound block of lines of a scene (fidelity response); empty when the scene has no sound.

    Parameters
    ----------
    radiators, table
        What sounds, transfer functions of a set's bearing; by default as the scene says.
    bearings
        Of the set that it belongs to, whose levels alone are kept.
    metered
        Whether this block's meters read the sum of the set; each set has one.

    Raises
    ------
    ValueError
        When a microphone lies inside a body, or the table does not serve.
    """
    if scene.sound is None or not scene.microphones:
        return np.zeros(0)
    radiation = radiation_of(scene, None, radiators, table)
    sources: list[tuple[int, int]] = []
    rays: list[list[Ray]] = []
    flights: list[float] = []
    circles = _circles(radiation, [position for _, position in scene.microphones], sources)
    for circle in circles:
        flight = min((path.flight for path in circle.paths), default=0.0)
        known: dict[int, NDArray[np.float64]] = {}  # a shared response has shared nodes
        for path in circle.paths:
            if id(path.response) not in known:
                known[id(path.response)] = nodes(path.response, flight)
        rays.append(
            [
                Ray(path.channel, target, factor, known[id(path.response)])
                for path, (target, factor) in zip(circle.paths, circle.targets, strict=True)
            ]
        )
        flights.append(flight)
    groups = [circle.group for circle in circles]
    lines = Lines(rays, flights, bearings, metered)
    details, thirds = scene.sound.details, scene.sound.third_octaves
    return pack(radiation, [], groups, sources, details=details, thirds=thirds, lengths=(), lines=lines)


def nodes(response: NDArray[np.complex128], flight: float) -> NDArray[np.float64]:
    """Values and slopes of a transfer function, band limit included: shape (``SD.NODES``, ``SD.NODE_SIZE``).

    ``response``: at `fit_frequencies`; ``flight``: time (s) taken out.
    """
    spline = spline_of(fit_frequencies(), response, flight)
    frequency: NDArray[np.float64] = SD.NODE_STEP * np.arange(SD.NODES, dtype=float)
    limit = band_limit(frequency)
    falls = band_limit(frequency + 0.5) - band_limit(frequency - 0.5)  # per Hz
    value = limit * spline(frequency)
    slope = SD.NODE_STEP * (falls * spline(frequency) + limit * spline(frequency, 1))
    return np.stack([value.real, value.imag, slope.real, slope.imag], axis=1)


def silent_parameters(scene: Scene, *, lines: bool = False) -> NDArray[np.float64]:
    """Sound block of a scene with microphones that hears nothing: no filters, no harmonics, few meters.

    ``lines``: one of lines, inside a set.
    """
    radiation = replace(radiation_of(scene, ()), harmonics=0)
    groups = [Group((k,), 0, np.zeros((0, 1))) for k in range(len(scene.microphones))]
    silent = Lines([[] for _ in groups], [0.0 for _ in groups], metered=False) if lines else None
    return pack(radiation, [], groups, [], details=False, thirds=False, lengths=(), lines=silent)


def filter_errors(scene: Scene, modes: Sequence[Any] | None = None) -> list[FilterError]:
    """How well the filters of a scene follow their transfer functions, the worst first; empty: no sound.

    Raises
    ------
    ValueError
        As `sound_parameters`.
    """
    if scene.sound is None or not scene.microphones:
        return []
    errors: list[FilterError] = []
    _design(radiation_of(scene, modes), [position for _, position in scene.microphones], errors)
    return sorted(errors, key=lambda found: -found.error)


def radiation_of(
    scene: Scene,
    modes: Sequence[Any] | None = None,
    radiators: Radiators | None = None,
    table: Table | None = None,
) -> Radiation:
    """Return what the paths of a scene with sound depend on besides its microphones.

    ``radiators``, ``table``: what sounds, its transfer functions; by default as the scene says.

    Raises
    ------
    ValueError
        When the scene has no sound, or its table does not serve.
    """
    if scene.sound is None:
        raise ValueError(f"{scene.name} has no sound: add [sound]")
    sound = si(scene.sound)
    if scene.sound.radiation_model == "table" and table is None:
        table = table_of(scene)
    return Radiation(
        scene.sound.radiation_model, radiators or radiators_of(scene),
        Air(sound.air_density, sound.sound_speed),
        int(scene.fidelity.ball_harmonics), ring_modes(scene) if modes is None else tuple(modes),
        None if scene.sound.reflecting_plane_mm is None else sound.reflecting_plane, table,
    )  # fmt: skip


def table_of(scene: Scene) -> Table:
    """Return the table of a scene, its microphones in the scene's order."""
    assert scene.sound is not None
    where = f"sound.table_file {scene.sound.table_file}"
    return select(read_table(str(scene.sound.table_file)), scene.microphones, where)


def radiators_of(scene: Scene, housing: Housing | None = None) -> Radiators:
    """Return what sounds in a scene, in m.

    The housing's front face is ahead (-X) of the bearing's end face. ``housing``: in the place of the
    scene's.
    """
    bearing = si(scene.bearing)
    cage = None
    if scene.bearing.cage is not None:
        body = si(scene.bearing.cage)
        cage = Ring(body.outside_diameter, body.bore, body.width)
    if housing is None and scene.sound is not None and scene.sound.radiator == "housing":
        if scene.mounted.housing is None:
            raise ValueError('sound.radiator = "housing" needs a table [mounting.housing]')
        body = si(scene.mounted.housing)
        centre = -0.5 * bearing.width - body.front_face + 0.5 * body.length
        housing = Housing(body.diameter, body.length, centre)
    return Radiators(
        ball_count=int(bearing.ball_count),
        ball_diameter=bearing.ball_diameter,
        pitch_diameter=bearing.pitch_diameter,
        inner_ring=Ring(bearing.inner_ring_outer_diameter, bearing.bore, bearing.width),
        outer_ring=Ring(bearing.outside_diameter, bearing.outer_ring_inner_diameter, bearing.width),
        cage=cage,
        housing=housing,
        contact_angle=scene.bearing.nominal_angle,
        shaft=scene.mounted.rotor is not None,
        baffle=scene.sound is not None and scene.sound.radiator == "baffle",
    )


def block_of(
    radiation: Radiation,
    microphones: Sequence[Position],
    *,
    details: bool,
    thirds: bool,
    lengths: Sequence[int] | None = None,
) -> NDArray[np.float64]:
    """Sound block of what radiates, for samples; parameters and errors: see `pack.pack`.

    Raises
    ------
    ValueError
        Also where a microphone lies inside a body or a filter misses its transfer function by over -30 dB.
    """
    wires, groups, sources = _design(radiation, microphones, [])
    return pack(radiation, wires, groups, sources, details=details, thirds=thirds, lengths=lengths)


def _design(
    radiation: Radiation, microphones: Sequence[Position], errors: list[FilterError]
) -> tuple[list[Wire], list[Group], list[tuple[int, int]]]:
    """Design filters; groups of microphones; component and kind of every output. Adds to ``errors``."""
    wires: list[Wire] = []
    sources: list[tuple[int, int]] = []
    circles = _circles(radiation, microphones, sources)
    for number, (paths, targets, group) in enumerate(circles):
        place = ", ".join(f"{1e3 * length:g}" for length in microphones[group.members[0]])
        filters = _filters(paths, place, group.members, errors)
        for path, taps, (target, factor) in zip(paths, filters, targets, strict=True):
            wires.append(Wire(number, path.channel, delay_of(path.flight), factor * taps, target))
    return wires, [circle.group for circle in circles], sources


def _circles(
    radiation: Radiation, microphones: Sequence[Position], sources: list[tuple[int, int]]
) -> list[Circle]:
    """Paths to each circle of microphones and their outputs, whose sources are appended."""
    circles: list[Circle] = []
    for members in radiation.circles(microphones):
        paths = _audible(radiation.paths(microphones, members))
        first = len(sources)
        targets, rows = _outputs(radiation, paths, sources)
        weights = np.array(rows).reshape(-1, len(members))
        circles.append(Circle(paths, targets, Group(tuple(members), first, weights)))
    return circles


def _audible(paths: list[Path]) -> list[Path]:
    """Leave out negligible paths and those on whose node lines all microphones are."""
    strongest = _strongest(paths)
    return [
        path
        for path in paths
        if np.abs(path.response).max() > _NEGLIGIBLE * strongest[path.component].max()
        and np.abs(path.weights).max() > _SILENT
    ]


def _strongest(paths: list[Path]) -> dict[int, NDArray[np.float64]]:
    """Magnitude of each component's strongest path at every frequency."""
    return {
        component: np.max([np.abs(path.response) for path in paths if path.component == component], axis=0)
        for component in {path.component for path in paths}
    }


def _outputs(
    radiation: Radiation, paths: list[Path], sources: list[tuple[int, int]]
) -> tuple[list[tuple[int, float]], list[NDArray[np.float64]]]:
    """Output and factor of each path, and the weights of the new outputs, whose sources are appended.

    Paths of one component and kind whose weights are multiples of one another add up in one output: at a
    single microphone all of them. The printed method squares each by itself.
    """
    known: dict[tuple[Any, ...], int] = {}
    targets: list[tuple[int, float]] = []
    rows: list[NDArray[np.float64]] = []
    for number, path in enumerate(paths):
        factor = float(path.weights[np.abs(path.weights).argmax()])
        row = path.weights / factor
        key = (
            (number,)
            if radiation.form == "scalars"
            else (path.component, path.kind, tuple(np.round(row, _ALIKE) + 0.0))
        )
        if key not in known:
            known[key] = len(sources)
            sources.append((path.component, path.kind))
            rows.append(row)
        targets.append((known[key], factor))
    return targets, rows


def _filters(
    paths: list[Path], place: str, members: Sequence[int], errors: list[FilterError]
) -> list[NDArray[np.float64]]:
    """Filter of each path; each component's errors count against its strongest path where its own is weak."""
    filters: list[NDArray[np.float64]] = []
    known: dict[int, tuple[NDArray[np.float64], float]] = {}  # a shared response has a shared filter
    strongest = _strongest(paths)
    for path in paths:
        if id(path.response) not in known:
            taps, error = fit(path.response, path.flight, strongest[path.component])
            off = 20 * np.log10(max(error, 1e-15))
            component, kind = SD.COMPONENTS[path.component], SD.KINDS[path.kind]
            errors.append(FilterError(tuple(members), component, kind, path.channel, len(taps), off))
            if error > _TOLERANCE:
                raise ValueError(
                    f"no filter follows the sound of the {component.replace('_', ' ')} at ({place}) mm: it "
                    f"is off by {off:.0f} dB, allowed are {20 * np.log10(_TOLERANCE):.0f}; move that "
                    "microphone or choose another sound.radiation_model"
                )
            known[id(path.response)] = (taps, error)
        filters.append(known[id(path.response)][0])
    return filters
