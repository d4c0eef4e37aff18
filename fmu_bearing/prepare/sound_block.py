"""The sound block of a scene, kept on disk: fitting its filters takes seconds."""

import functools
import hashlib
import io
import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.engine.layout import SD
from fmu_bearing.engine.sources import rooms_digest, source_hash
from fmu_bearing.files import cache_root, write_whole
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import sound_scene
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from fmu_bearing.acoustics.radiation.radiators import Radiators
    from fmu_bearing.acoustics.radiation.table import Table

__all__ = ["silenced", "sound_block", "sound_blocks", "sound_key"]

#: Packages whose code computes the numbers, beside the engine.
_ROOMS = ("acoustics", "elastic", "formulas", "prepare", "scene")
#: Parts of a scene that its sound block depends on, with microphones' places and one number of its fidelity.
_PARTS: Any = {"bearing": True, "materials": True, "mounting": {"rotor", "housing", "flexure"}, "sound": True}
_LEFT_OUT: Any = {"sound": {"microphone", "circle"}}  # names of microphones


@dataclass(frozen=True)
class Block:
    """Which sound block of a scene is wanted.

    ``radiators``, ``table``: in the place of the scene's; ``lines``: one of lines, with ``bearings`` and
    ``metered`` as in `acoustics.filters.design.line_parameters`.
    """

    radiators: "Radiators | None" = None
    lines: bool = False
    bearings: int = 0
    metered: bool = True
    table: "Table | None" = None


def from_lines(scene: Scene, fidelity: str | None = None) -> bool:
    """Whether the sound of a scene is made of lines: in fidelity response, by sources linear in velocity.

    ``fidelity``: in the place of the scene's.
    """
    if scene.sound is None or (fidelity or scene.fidelity.model) != "response":
        return False
    from fmu_bearing.acoustics.registry import RECIPES

    return RECIPES[scene.sound.radiation_model].form != "scalars"


@one_thread
def sound_parameters(scene: Scene, wanted: Block) -> NDArray[np.float64]:
    """Compute the block. SciPy is imported here, because that takes half a second."""
    from fmu_bearing.acoustics.filters import design as stream

    if wanted.lines:
        return stream.line_parameters(
            scene, wanted.radiators, wanted.table, bearings=wanted.bearings, metered=wanted.metered
        )
    return stream.sound_parameters(scene, radiators=wanted.radiators, table=wanted.table)


def sound_block(scene: Scene, wanted: Block | None = None) -> NDArray[np.float64]:
    """Sound block of a scene (`sound_parameters`), from the cache if possible.

    ``wanted``: default: of the scene as it is, of lines where `from_lines` says so.

    Raises
    ------
    ValueError
        As `acoustics.filters.design.sound_parameters` and `line_parameters` there.
    """
    if scene.sound is None or not scene.microphones:
        return np.zeros(0)
    wanted = wanted or Block(lines=from_lines(scene))
    if scene.sound.radiation_model == "table":  # a table may change under its name
        return sound_parameters(scene, wanted)
    path = cache_root() / "sound" / f"block-{_key(scene, wanted)}.npy"
    try:
        kept: NDArray[np.float64] = np.load(path, allow_pickle=False)
        return kept
    except Exception:  # not there, or damaged, for which NumPy raises what it comes upon: made again
        block = sound_parameters(scene, wanted)
    buffer = io.BytesIO()
    np.save(buffer, block, allow_pickle=False)
    try:
        write_whole(path, buffer.getvalue())
    except OSError:
        pass  # a cache that cannot be written costs time, not results
    return block


def sound_blocks(scene: Scene, *, lines: bool | None = None) -> list[NDArray[np.float64]]:
    """Return the sound block of every bearing of a scene: of a set one each, else one.

    ``lines``: whether they are of lines or for samples; default: as `from_lines` says.

    A housing that radiates belongs to the first bearing, which it shows, as does a rigid plane; the others
    are behind and have blocks without sources.

    Raises
    ------
    ValueError
        As `sound_block`.
    """
    if lines is None:
        lines = from_lines(scene)
    if not scene.assembly.joined or scene.sound is None:
        return [sound_block(scene, Block(lines=lines))]
    count = len(scene.assembly.members)
    alone = [sound_scene(scene, b) for b in range(count)]
    own = [Block(None, lines, count if lines and b == 0 else 0, metered=b == 0) for b in range(count)]
    if scene.sound.radiation_model == "table":
        from fmu_bearing.acoustics.filters.bearings import tables_of

        own = [replace(block, table=table) for block, table in zip(own, tables_of(scene), strict=True)]
    if scene.sound.radiator == "bare" or own[0].table is not None:
        return [sound_block(one, block) for one, block in zip(alone, own, strict=True)]
    from fmu_bearing.acoustics.filters.bearings import front_of_set
    from fmu_bearing.acoustics.filters.design import silent_parameters

    first, *inside = alone
    radiating = sound_block(first, replace(own[0], radiators=front_of_set(scene)))
    return [radiating, *(silent_parameters(one, lines=lines) for one in inside)]


def silenced(block: NDArray[np.float64], component: str) -> NDArray[np.float64]:
    """Return a copy of a sound block for samples in which one of ``SD.COMPONENTS`` makes no sound."""
    silent = block.copy()
    if not block.size:
        return silent
    kinds = silent[int(silent[SD.H_AT_SOURCES]) :][: 2 * int(silent[SD.H_SOURCES])].reshape(-1, 2)
    outputs = silent[int(silent[SD.H_AT_OUTPUTS]) :][: int(silent[SD.H_OUTPUTS])].astype(int)
    quiet = kinds[outputs, 0] == SD.COMPONENTS.index(component)
    for group in range(int(silent[SD.H_GROUPS])):
        row = silent[int(silent[SD.H_AT_GROUPS]) + SD.GROUP_SIZE * group :][: SD.GROUP_SIZE]
        first, count, mics, weights = (
            int(row[k]) for k in (SD.GROUP_FIRST, SD.GROUP_COUNT, SD.GROUP_MICS, SD.GROUP_AT_WEIGHTS)
        )
        table = silent[weights : weights + count * mics].reshape(count, mics)
        table[quiet[first : first + count]] = 0.0
    return silent


class Sounds:
    """Sound blocks of one scene at any fidelity, each made once: those for samples and those of lines.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._made: dict[bool, list[NDArray[np.float64]]] = {}

    def at(self, fidelity: str) -> list[NDArray[np.float64]]:
        """Return the blocks of the scene at a fidelity; raises as `sound_blocks`."""
        lines = from_lines(self._scene, fidelity)
        if lines not in self._made:
            self._made[lines] = sound_blocks(self._scene, lines=lines)
        return self._made[lines]


def sound_key(scene: Scene) -> str:
    """Key of a scene's sound block; empty without sound.

    It does not depend on speed, loads, oil, springs and imperfections: a sweep over those prepares the sound
    once.
    """
    if scene.sound is None:
        return ""
    return f"{'lines' if from_lines(scene) else 'samples'} {_source_key(scene)}"


def _source_key(scene: Scene) -> str:
    """Key of what radiates in a scene with sound, and how."""
    from fmu_bearing.acoustics.filters.bearings import front_of_set
    from fmu_bearing.acoustics.filters.design import radiators_of

    if count := len(scene.assembly.members):
        if scene.sound is None or scene.sound.radiator == "bare":
            return repr([_source_key(sound_scene(scene, b)) for b in range(count)])
        # bearings behind make no sound, they are only counted
        first, shown = sound_scene(scene, 0), front_of_set(scene)
        return repr((first.sound, shown, scene.fidelity.ball_harmonics, count))
    flexure = scene.mounted.flexure
    bending = (flexure, scene.materials, scene.bearing) if flexure is not None else ()
    return repr((scene.sound, radiators_of(scene), scene.fidelity.ball_harmonics, bending))


def _key(scene: Scene, wanted: Block) -> str:
    parts = scene.model_dump(mode="json", include=_PARTS, exclude=_LEFT_OUT)
    places = [list(place) for _, place in scene.microphones]
    digest = hashlib.sha256(json.dumps([parts, places], sort_keys=True).encode())
    digest.update(f"{scene.fidelity.ball_harmonics} {_code()}".encode())
    if wanted != Block():
        digest.update(repr(wanted).encode())
    return digest.hexdigest()[:24]


@functools.cache
def _code() -> str:
    """Versions of the code that computes the numbers: sources and libraries."""
    return f"{source_hash()} {np.__version__} {scipy.__version__} {rooms_digest(*_ROOMS)}"
