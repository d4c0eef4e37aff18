"""The sound block of a scene, kept on disk: fitting its filters takes seconds."""

import functools
import hashlib
import io
import json
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.engine.sources import rooms_digest, source_hash
from fmu_bearing.files import cache_root, write_whole
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import sound_scene

if TYPE_CHECKING:
    from fmu_bearing.acoustics.radiation.radiators import Housing

__all__ = ["sound_block", "sound_blocks", "sound_key"]

#: Packages whose code computes the numbers, beside the engine.
_ROOMS = ("acoustics", "elastic", "formulas", "prepare", "scene")
#: Parts of a scene that its sound block depends on, with microphones' places and one number of its fidelity.
_PARTS: Any = {"bearing": True, "materials": True, "mounting": {"rotor", "housing", "flexure"}, "sound": True}
_LEFT_OUT: Any = {"sound": {"microphone", "circle"}}  # names of microphones


def sound_parameters(scene: Scene, housing: "Housing | None" = None) -> NDArray[np.float64]:
    """Compute the block. SciPy is imported here, because that takes half a second."""
    from fmu_bearing.acoustics.filters import design as stream

    return stream.sound_parameters(scene, housing=housing)


def sound_block(scene: Scene, housing: "Housing | None" = None) -> NDArray[np.float64]:
    """Sound block of a scene (`acoustics.filters.design.sound_parameters`), from the cache if possible.

    ``housing``: in the place of the scene's.

    Raises
    ------
    ValueError
        As `acoustics.filters.design.sound_parameters`.
    """
    if scene.sound is None or not scene.microphones:
        return np.zeros(0)
    if scene.sound.radiation_model == "table":  # a table may change under its name
        return sound_parameters(scene)
    path = cache_root() / "sound" / f"block-{_key(scene, housing)}.npy"
    try:
        kept: NDArray[np.float64] = np.load(path, allow_pickle=False)
        return kept
    except (OSError, ValueError, EOFError):  # not there, or damaged: made again
        block = sound_parameters(scene, housing)
    buffer = io.BytesIO()
    np.save(buffer, block, allow_pickle=False)
    try:
        write_whole(path, buffer.getvalue())
    except OSError:
        pass  # a cache that cannot be written costs time, not results
    return block


def sound_blocks(scene: Scene) -> list[NDArray[np.float64]]:
    """Return the sound block of every bearing of a scene: of a set one each, else one.

    A housing that radiates belongs to the first bearing, which it shows; the others are inside and have
    blocks without sources.

    Raises
    ------
    ValueError
        As `sound_block`.
    """
    if scene.spindle is None or scene.sound is None:
        return [sound_block(scene)]
    alone = [sound_scene(scene, b) for b in range(len(scene.spindle.bearing))]
    if scene.sound.radiator != "housing":
        return [sound_block(one) for one in alone]
    from fmu_bearing.acoustics.filters.design import housing_of_set, silent_parameters

    first, *inside = alone
    return [sound_block(first, housing_of_set(scene)), *(silent_parameters(one) for one in inside)]


def sound_key(scene: Scene) -> str:
    """Key of a scene's sound block; empty without sound.

    It does not depend on speed, loads, oil, springs and imperfections: a sweep over those prepares the sound
    once.
    """
    from fmu_bearing.acoustics.filters.design import housing_of_set, radiators_of

    if scene.sound is None:
        return ""
    if scene.spindle is not None:
        count = len(scene.spindle.bearing)
        if scene.sound.radiator != "housing":
            return repr([sound_key(sound_scene(scene, b)) for b in range(count)])
        # bearings inside make no sound, they are only counted
        first, housing = sound_scene(scene, 0), housing_of_set(scene)
        radiating = (first.sound, radiators_of(first, housing), scene.fidelity.ball_harmonics)
        return repr((radiating, count))
    flexure = scene.mounted.flexure
    bending = (flexure, scene.materials, scene.bearing) if flexure is not None else ()
    return repr((scene.sound, radiators_of(scene), scene.fidelity.ball_harmonics, bending))


def _key(scene: Scene, housing: "Housing | None" = None) -> str:
    parts = scene.model_dump(mode="json", include=_PARTS, exclude=_LEFT_OUT)
    places = [list(place) for _, place in scene.microphones]
    digest = hashlib.sha256(json.dumps([parts, places], sort_keys=True).encode())
    digest.update(f"{scene.fidelity.ball_harmonics} {_code()}".encode())
    if housing is not None:
        digest.update(repr(housing).encode())
    return digest.hexdigest()[:24]


@functools.cache
def _code() -> str:
    """Versions of the code that computes the numbers: sources and libraries."""
    return f"{source_hash()} {np.__version__} {scipy.__version__} {rooms_digest(*_ROOMS)}"
