"""A scene in a line: what the bearings are of, and how they run."""

import functools
from collections import Counter

from fmu_bearing.scene.entries import catalogue
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.read import Scene


@functools.cache
def _named() -> tuple[tuple[str, Material], ...]:
    return tuple((name, Material.model_validate(values)) for name, values in catalogue("materials").items())


def bearings_words(scene: Scene) -> str:
    """Return the bearing's designation; of a set their number and arrangement, too: ``2 x 7003C, DB (O)``.

    Of bearings that differ: ``2 x 7003C + 1 x 7002C, TBT (O)``.
    """
    if not scene.assembly.joined:
        return scene.bearing.designation
    counts = Counter(designations(scene))
    several = " + ".join(f"{count} x {designation}" for designation, count in counts.items())
    return f"{several}, {scene.assembly.arrangement}"


def designations(scene: Scene) -> list[str]:
    """Return the designation of each bearing; where bearings of one name differ, with their balls."""
    names: list[str] = []
    for one, materials in zip(scene.geometries, scene.materials_of_each, strict=True):
        name = one.designation
        if scene.differing and len({other.designation for other in scene.geometries}) == 1:
            name += f" with {one.ball_count} balls of {material_name(materials.balls)}"
        names.append(name)
    return names


def material_name(material: Material) -> str:
    """Return the name of a material in the catalogue, else its Young's modulus."""
    names = (name for name, known in _named() if known == material)
    return next(names, f"own material of {material.youngs_modulus_GPa:g} GPa")


def designation_words(scene: Scene) -> str:
    """Return the designation of the bearings; of a set of different ones each once: ``7003C and 7002C``."""
    return " and ".join(dict.fromkeys(designations(scene)))


def materials_words(scene: Scene) -> str:
    """Return kind and materials: ``hybrid: rings GCr15, balls Si3N4, cage bakelite``.

    Of bearings that differ those of each: ``bearings 1, 2 hybrid: ...``.
    """
    if scene.differing:
        each = [materials_words(one.scene) for one in scene.bearings()]
        at = {words: [str(k) for k, one in enumerate(each, start=1) if one == words] for words in each}
        if len(at) == 1:
            return each[0]
        return "; ".join(
            f"bearing{'s' * (len(numbers) > 1)} {', '.join(numbers)} {words}" for words, numbers in at.items()
        )
    of = scene.materials
    inner, outer, balls = (material_name(one) for one in (of.inner_ring, of.outer_ring, of.balls))
    rings = f"rings {inner}" if inner == outer else f"inner ring {inner}, outer ring {outer}"
    cage = "no cage" if scene.bearing.cage is None or of.cage is None else f"cage {material_name(of.cage)}"
    return f"{of.kind}: {rings}, balls {balls}, {cage}"


def conditions_words(scene: Scene) -> str:
    """Return supply and temperatures: ``supply oil-air; oil 40, inner ring 40, outer ring 40 degC``."""
    at = scene.operation
    return (
        f"supply {scene.lubricant.supply}; oil {at.oil_temperature_degC:.4g}, inner ring "
        f"{at.inner_ring_temperature_degC:.4g}, outer ring {at.outer_ring_temperature_degC:.4g} degC"
    )
