"""Signals of a recording as a universal file, for programs of modal analysis."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.recorded_signals import RecordedSignal, recorded_signal, signal_names
from fmu_bearing.results.uff import Function, Place, place_of, signal, write_uff


def write_signals(
    recording: ChannelHistory, path: str | os.PathLike[str], names: Sequence[str] | None = None,
    radiation_model: str | None = None,
) -> Path:  # fmt: skip
    """Write signals as functions over time, with the places of microphones and bearings as nodes.

    Parameters
    ----------
    recording : ChannelHistory
    path : path
        Ending in ``.uff``.
    names : sequence of str, optional
        Of signals; default: microphones and accelerations.

    Raises
    ------
    ValueError
        For another ending, an unknown name, and where there are no signals.
    OSError
        Where it cannot be written.
    """
    usual = [name for name in signal_names(recording) if name not in recording.outputs]
    chosen = usual if names is None else names
    if not chosen:
        raise ValueError(f"{path}: there are neither microphones nor accelerations in this recording")
    scene = recording.scene
    nodes = {} if scene is None else {
        number: (one.position, 0.0, 0.0) for number, one in enumerate(scene.bearings(), start=1)
    }  # fmt: skip
    signals = [recorded_signal(recording, name, radiation_model) for name in chosen]
    functions = list(_functions(signals, nodes))
    return write_uff(path, functions, nodes, "" if scene is None else scene.name)


def _functions(
    signals: Sequence[RecordedSignal], nodes: dict[int, tuple[float, float, float]]
) -> Iterator[Function]:
    """Yield signals as functions; microphones become nodes behind those that there are."""
    for one in signals:
        place = place_of(one.name, one.unit)._replace(node=one.bearing or 0)
        if one.place is not None:
            place = Place(one.name, one.unit, max(nodes, default=0) + 1)
            if one.place[0] == one.place[0]:  # NaN: of an FMU's run without a scene
                nodes[place.node] = one.place
        yield signal(place, one.time, one.values)
