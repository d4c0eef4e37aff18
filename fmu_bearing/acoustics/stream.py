"""The sound block of the engine's parameters: transfer functions turned into filters and packed flat."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.fir import decimator, delay_of, fit
from fmu_bearing.acoustics.transfer import (
    Air,
    Housing,
    Path,
    Radiators,
    Ring,
    compact_paths,
    paper_paths,
    paper_scalars,
)
from fmu_bearing.acoustics.weighting import a_weighting_sections, high_pass_section
from fmu_bearing.engine.sound import places as at
from fmu_bearing.scene import Scene, si

Position = tuple[float, float, float]

MICROPHONE_LOW_LIMIT = 5.0  # Hz, second order: of a half-inch measurement microphone (assumed)
# Paths this far below their component's strongest one, at all frequencies, are left out.
_NEGLIGIBLE = 1e-7
_TOLERANCE = 10 ** (-50 / 20)  # worst deviation of a filter from its transfer function
_LONGEST_GAP = 4  # channels
_SAME_PLACE = 9  # decimals of a metre within which microphones share a circle


def sound_parameters(scene: Scene) -> NDArray[np.float64]:
    """Sound block of a scene for the kernels in `engine.sound`; empty when the scene has no sound.

    Raises
    ------
    ValueError
        When a microphone lies inside the bearing or its housing, or a filter does not follow its transfer
        function.
    """
    if scene.sound is None or not scene.microphones:
        return np.zeros(0)
    sound = si(scene.sound)
    air = Air(sound.air_density, sound.sound_speed)
    positions = [position for _, position in scene.microphones]
    return build(sound.rung, radiators_of(scene), air, positions, int(scene.fidelity.ball_harmonics))


def radiators_of(scene: Scene) -> Radiators:
    """Return what sounds in a scene, in m.

    The housing's front face stands ahead (-X) of the bearing's end face.
    """
    bearing = si(scene.bearing)
    cage = None
    if scene.bearing.cage is not None:
        body = si(scene.bearing.cage)
        cage = Ring(body.outside_diameter, body.bore, body.width)
    housing = None
    if scene.sound is not None and scene.sound.radiator == "housing":
        if scene.mounting.housing is None:
            raise ValueError('sound.radiator = "housing" needs a table [mounting.housing]')
        body = si(scene.mounting.housing)
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
    )


def build(
    rung: str, radiators: Radiators, air: Air, microphones: Sequence[Position], harmonics: int = 4
) -> NDArray[np.float64]:
    """Sound block from plain numbers.

    Parameters
    ----------
    rung
        ``"compact"`` or ``"paper"``, see `transfer`.
    microphones
        Places (x, y, z) in m, bearing centre at the origin.
    harmonics
        Highest circumferential order of the balls' sound (rung ``compact``).

    Raises
    ------
    ValueError
        On another rung, a microphone inside a body, or a filter that misses its transfer function by more
        than -50 dB.
    """
    if rung not in ("compact", "paper"):
        raise ValueError(f'rung must be "paper" or "compact", not {rung!r}')
    groups = _circles(rung, microphones)
    banks: list[list[float]] = []
    taps: list[NDArray[np.float64]] = []
    components: list[int] = []
    runs: dict[int, tuple[int, int, NDArray[np.float64]]] = {}
    compact = rung == "compact"
    for members in groups.values():
        paths = _paths(rung, radiators, air, [microphones[i] for i in members], harmonics)
        place = ", ".join(f"{1e3 * length:g}" for length in microphones[members[0]])
        first = len(components)
        order: list[Path | None] = []
        for run, rows in _runs(paths, _filters(paths, place)):
            first_path = next(path for path in run if path is not None)
            delay = delay_of(first_path.flight)
            banks.append([first_path.channel, len(run), delay, len(rows), len(components)])
            taps.append(rows)
            components += [0 if path is None else path.component for path in run]
            order += run
        for k, i in enumerate(members):
            weights = np.array([0.0 if path is None else path.weights[k] for path in order])
            runs[i] = (first, len(order), weights)
    head = np.zeros(at.HEAD_SIZE)
    head[at.H_RUNG] = at.RUNG_COMPACT if compact else at.RUNG_PAPER
    head[at.H_BALLS] = radiators.ball_count
    head[at.H_HARMONICS] = harmonics
    head[at.H_CHANNELS] = (
        at.compact_channels(harmonics) if compact else at.paper_channels(radiators.ball_count)
    )
    head[at.H_ROWS] = max(bank[at.BANK_DELAY] + bank[at.BANK_TAPS] for bank in banks)
    head[at.H_BANKS] = len(banks)
    head[at.H_OUTPUTS] = len(components)
    head[at.H_MICS] = len(microphones)
    head[at.H_LANES] = len(microphones) if compact else len(components)
    return _pack(head, radiators, banks, taps, components, [runs[i] for i in range(len(microphones))])


def _pack(
    head: NDArray[np.float64],
    radiators: Radiators,
    banks: list[list[float]],
    taps: list[NDArray[np.float64]],
    components: list[int],
    runs: list[tuple[int, int, NDArray[np.float64]]],
) -> NDArray[np.float64]:
    """Lay head and tables one after another; offsets count from the start of the block."""
    table: list[float] = []

    def put(numbers) -> int:
        place = at.HEAD_SIZE + len(table)
        table.extend(np.asarray(numbers, dtype=float).ravel())
        return place

    keep = [0, 1, 2, 4, 5]  # the leading denominator coefficient is 1
    head[at.H_AT_DECIMATOR] = put(decimator())
    head[at.H_AT_HIGH_PASS] = put(high_pass_section(at.RATE, MICROPHONE_LOW_LIMIT)[keep])
    head[at.H_AT_A_WEIGHTING] = put(a_weighting_sections(at.RATE)[:, keep])
    head[at.H_AT_SCALARS] = put(paper_scalars(radiators))
    head[at.H_AT_COMPONENTS] = put(components)
    head[at.H_AT_BANKS] = put([[*bank, put(rows)] for bank, rows in zip(banks, taps, strict=True)])
    head[at.H_AT_MICS] = put([[first, count, put(weights)] for first, count, weights in runs])
    return np.concatenate([head, table])


def _circles(rung: str, microphones: Sequence[Position]) -> dict[tuple[float, ...], list[int]]:
    """Return indices of microphones that share their transfer functions."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for i, (x, y, z) in enumerate(microphones):
        across = np.hypot(y, z)
        place = (np.hypot(across, x),) if rung == "paper" else (across, x)
        groups.setdefault(tuple(round(float(v), _SAME_PLACE) for v in place), []).append(i)
    return groups


def _paths(
    rung: str, radiators: Radiators, air: Air, microphones: Sequence[Position], harmonics: int
) -> list[Path]:
    """Paths to the microphones of one circle, without the negligible ones."""
    x, y, z = microphones[0]
    if rung == "paper":
        return paper_paths(radiators, air, float(np.linalg.norm((x, y, z))), len(microphones))
    azimuths = [np.arctan2(-y, z) for _, y, z in microphones]
    paths = compact_paths(radiators, air, float(np.hypot(y, z)), x, azimuths, harmonics)
    strongest = [
        max(np.abs(p.response).max() for p in paths if p.component == path.component) for path in paths
    ]
    return [
        path
        for path, limit in zip(paths, strongest, strict=True)
        if np.abs(path.response).max() > _NEGLIGIBLE * limit
    ]


def _filters(paths: list[Path], place: str) -> list[NDArray[np.float64]]:
    """Filter of each path; each component's errors count against its strongest path where its own is weak."""
    filters: list[NDArray[np.float64]] = []
    known: dict[int, NDArray[np.float64]] = {}  # sources that share a response share their filter
    strongest = {
        component: np.max([np.abs(p.response) for p in paths if p.component == component], axis=0)
        for component in {path.component for path in paths}
    }
    for path in paths:
        if id(path.response) not in known:
            taps, error = fit(path.response, path.flight, strongest[path.component])
            if error > _TOLERANCE:
                off, most = 20 * np.log10(error), 20 * np.log10(_TOLERANCE)
                body = at.COMPONENTS[path.component].replace("_", " ")
                raise ValueError(
                    f"no filter follows the sound of the {body} at ({place}) mm: it is off by {off:.0f} dB, "
                    f"allowed are {most:.0f}; move that microphone or choose another sound.rung"
                )
            known[id(path.response)] = taps
        filters.append(known[id(path.response)])
    return filters


def _runs(
    paths: list[Path], filters: list[NDArray[np.float64]]
) -> list[tuple[list[Path | None], NDArray[np.float64]]]:
    """Gather paths of one delay into banks of neighbouring channels, with their taps side by side.

    A short gap between two channels is filled with a silent path: one long vector loop beats two short ones.
    """
    runs: list[tuple[list[Path | None], list[NDArray[np.float64]]]] = []
    last = None
    for path, taps in sorted(
        zip(paths, filters, strict=True), key=lambda pair: (pair[0].flight, pair[0].channel)
    ):
        gap = (
            path.channel - last.channel - 1
            if last is not None and last.flight == path.flight
            else _LONGEST_GAP + 1
        )
        if gap > _LONGEST_GAP:
            runs.append(([], []))
            gap = 0
        members, rows = runs[-1]
        members += [None] * gap + [path]
        rows += [np.zeros(0)] * gap + [taps]
        last = path
    return [(members, _side_by_side(rows)) for members, rows in runs]


def _side_by_side(filters: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    table = np.zeros((max(len(taps) for taps in filters), len(filters)))
    for column, taps in enumerate(filters):
        table[: len(taps), column] = taps
    return table
