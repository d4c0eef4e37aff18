"""A scene in a line: what the bearings are of, and how they run."""

import functools

from fmu_bearing.scene.entries import catalogue
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.read import Scene


@functools.cache
def _named() -> tuple[tuple[str, Material], ...]:
    return tuple((name, Material.model_validate(values)) for name, values in catalogue("materials").items())


def bearings_words(scene: Scene) -> str:
    """Return the bearing's designation; of a set their number and arrangement, too: ``2 x 7003C, DB (O)``."""
    members, designation = scene.assembly.members, scene.bearing.designation
    return f"{len(members)} x {designation}, {scene.assembly.arrangement}" if members else designation


def material_name(material: Material) -> str:
    """Return the name of a material in the catalogue, else its Young's modulus."""
    names = (name for name, known in _named() if known == material)
    return next(names, f"own material of {material.youngs_modulus_GPa:g} GPa")


def materials_words(scene: Scene) -> str:
    """Return kind and materials: ``hybrid: rings GCr15, balls Si3N4, cage bakelite``."""
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
