"""What radiates in a scene: its bearing, or every bearing of a set, with places in the axes of each."""

from collections.abc import Sequence

from fmu_bearing.acoustics.analysis.field import Position
from fmu_bearing.acoustics.filters.bearings import front_of_set
from fmu_bearing.acoustics.filters.design import radiators_of
from fmu_bearing.acoustics.radiation.radiators import Air, Radiators
from fmu_bearing.acoustics.registry import Radiation
from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.exclusions import TABLE_CHANNELS
from fmu_bearing.scene.member import radiating

Source = tuple[Radiation, list[Position]]


def air_of(scene: Scene) -> Air:
    """Return the scene's air, or that of the papers where the scene has no sound."""
    if scene.sound is None:
        return Air()
    sound = si(scene.sound)
    return Air(sound.air_density, sound.sound_speed)


def centre_of(scene: Scene | None) -> float:
    """Return where circles and spheres about what radiates have their centre (m along the axis).

    The centre of a single bearing, the middle between the first and the last bearing of a set, which has its
    origin at the nose.
    """
    if scene is None:
        return 0.0
    places = [bearing.position for bearing in scene.bearings()]
    return 0.5 * (places[0] + places[-1])


def bodies_of(scene: Scene) -> list[tuple[int, Radiators]]:
    """Return what radiates, each with the number of its bearing from 0.

    Where a housing or a rigid plane covers all but the front of a set, its first bearing alone.
    """
    radiator = "bare" if scene.sound is None else scene.sound.radiator
    if radiator == "bare" or not scene.assembly.joined:
        return [(k, radiators_of(radiating(scene, k))) for k in range(len(scene.bearings()))]
    return [(0, front_of_set(scene))]


def sources_of(scene: Scene, model: str, places: Sequence[Position], harmonics: int) -> list[Source]:
    """Return what paths depend on for everything that radiates in a scene, and places in its axes.

    Parameters
    ----------
    scene : Scene
    model : str
        Radiation model, any but ``"table"``, which knows its own microphones only.
    places : sequence of (x, y, z)
        In m: from the bearing's centre, of a set from the shaft's nose.
    harmonics : int
        Highest circumferential order of the balls among the channels.

    Raises
    ------
    ValueError
        On the radiation model ``table`` or an unknown one.
    """
    if model == "table":
        raise ValueError(f'sound.radiation_model = "table" {TABLE_CHANNELS.words()}')
    plane = None if scene.sound is None or scene.sound.reflecting_plane_mm is None else (
        si(scene.sound).reflecting_plane
    )  # fmt: skip
    sources: list[Source] = []
    for number, body in bodies_of(scene):
        own, moved, behind = radiating(scene, number), list(places), plane
        if scene.assembly.joined:
            moved = [(1e-3 * scene.assembly.own_mm(number, x), y, z) for x, y, z in places]
            behind = None if plane is None else 1e-3 * scene.assembly.own_mm(number, plane)
        sources.append(
            (Radiation(model, body, air_of(scene), harmonics, ring_modes(own), plane=behind), moved)
        )
    return sources
