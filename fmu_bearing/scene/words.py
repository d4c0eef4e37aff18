"""A scene in a line: what the bearings are of, how they run, and that nothing preloads them."""

import functools
from collections import Counter

from fmu_bearing.scene.entries import catalogue
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.read import Scene

_LOOSE = "preload = 0 N: no axial force holds balls and races together: loose balls skid or lift off; "
_ROLLS = {
    "full": "what they then do depends on gravity, loads and chance more than on the bearing",
    "rings": "fidelity rings has balls that always roll: its loads and levels then mean little, its torque "
    "is that of balls at rest under the loads across",
    "response": "fidelity response has balls that always roll and contacts that never open: its loads may be "
    "wrong by orders of magnitude",
}


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


def type_words(scene: Scene) -> str:
    """Return the type of the bearings, as ``deep groove ball bearing``; of a set of both ``ball bearing``."""
    kinds = {one.kind for one in scene.geometries}
    return "ball bearing" if len(kinds) > 1 else f"{kinds.pop().replace('-', ' ')} ball bearing"


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
    """Return supply and temperatures: ``supply oil-air; oil 40, inner ring 40, outer ring 40 degC``.

    Of bearings whose rings differ each: ``inner rings 49.3 / 48.1``.
    """
    return f"supply {scene.lubricant.supply}; {temperature_words(scene)}"


def temperature_words(scene: Scene) -> str:
    """Return the temperatures: ``oil 40, inner ring 40, outer ring 40 degC``."""
    words = [f"oil {scene.operation.oil_temperature_degC:.4g}"]
    members = scene.assembly.members or (None,)
    for ring in ("inner", "outer"):
        key = f"{ring}_ring_temperature_degC"
        own = [getattr(member, key, None) for member in members]
        each = [f"{getattr(scene.operation, key) if one is None else one:.4g}" for one in own]
        equal = len(set(each)) == 1
        words.append(f"{ring} ring {each[0]}" if equal else f"{ring} rings {' / '.join(each)}")
    return f"{', '.join(words)} degC"


def is_loose(scene: Scene) -> bool:
    """Whether a single bearing has no preload; a deep groove one has a radial load in its place."""
    return (
        scene.mounting is not None and not scene.bearing.is_deep_groove and not scene.mounting.preload_N > 0.0
    )


def loose_words(fidelity: str) -> str:
    """Return the warning about a bearing without preload at a fidelity."""
    words = _LOOSE + _ROLLS[fidelity]
    return f"{words}; give a preload (mounting.preload_N, input preload), or expect no more than a trend"
