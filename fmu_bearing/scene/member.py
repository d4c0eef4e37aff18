"""The bearings of a scene, each as the scene of a single one; its share of the preload, and what it hears."""

from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from fmu_bearing.scene.assembly import assembly_of, usual_loads
from fmu_bearing.scene.base import SceneError
from fmu_bearing.scene.fit import fit_of_member
from fmu_bearing.scene.mounting import Mounting, Rotor
from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.sound import Microphone
from fmu_bearing.scene.spindle import Spindle
from fmu_bearing.scene.units import si

Given = TypeVar("Given", bound=Tables)

#: Radial stiffness (N/m) under an outer ring that its seat holds, so read by nothing.
HELD = 1e8


@dataclass(frozen=True)
class SceneBearing(Generic[Given]):
    """One bearing of a scene: the single one, or one of a set.

    Attributes
    ----------
    number : int
        From 1, of a set from the nose on.
    sign : int
        1 where it carries force on the shaft towards +X, else -1.
    position : float
        Plane of its ball centres from the shaft's nose (m); 0 of a single bearing, which is in the origin.
    seat : str
        What its outer ring is on: fixed in the housing, sliding in it, or a pedestal of its own.
    prefix : str
        Of its variables: ``bearing[1].`` and so on in a set, nothing for a single bearing.
    scene : Scene
        The scene of this bearing alone, see `one_of`; that of a single bearing is the whole one.
    """

    number: int
    sign: int
    position: float
    seat: Literal["fixed", "sliding", "pedestal"]
    prefix: str
    scene: Given


def bearings_of(scene: Given) -> tuple[SceneBearing[Given], ...]:
    """Return the bearings of a scene, see `Scene.bearings`."""
    return tuple(
        SceneBearing(k + 1, one.sign, si(one).position, one.seat, f"bearing[{k + 1}].", one_of(scene, k))
        for k, one in enumerate(scene.members)
    ) or (SceneBearing(1, 1, 0.0, "pedestal", "", scene),)


def set_of(scene: Tables) -> Spindle:
    """Return the set of a scene.

    Raises
    ------
    SceneError
        For the scene of one bearing.
    """
    if scene.spindle is None:
        raise SceneError(
            f"{scene.name}: has one bearing on its mounting; a set of bearings needs [spindle] in the place "
            "of [mounting]"
        )
    return scene.spindle


def one_of(scene: Given, number: int = 0) -> Given:
    """Return the scene of one bearing of a set, without its place: no load, no sound.

    ``number``: from 0; each bearing has its own seeds of imperfections. Its preload is its share of the
    set's, for what depends on the width of a contact.
    """
    spindle = set_of(scene)
    tables = {"bearing": scene.geometries[number], "materials": scene.materials_of_each[number]}
    housing, one = spindle.housing, spindle.bearing[number]
    mounting = Mounting(
        preload_N=0.0,
        pedestal_stiffness_N_m=housing.pedestal_stiffness_N_m or HELD,
        pedestal_stiffness_ratio=housing.pedestal_stiffness_ratio,
        pedestal_axis_angle_deg=housing.pedestal_axis_angle_deg,
        pedestal_axial_ratio=housing.pedestal_axial_ratio,
        pedestal_rotational_ratio_mm2=housing.pedestal_rotational_ratio_mm2,
        pedestal_damping_ratio=housing.pedestal_damping_ratio,
        # a mirror across the axis changes the sign of tilts
        misalignment_y_mrad=one.sign * one.misalignment_y_mrad,
        misalignment_z_mrad=one.sign * one.misalignment_z_mrad,
        flexure=spindle.flexure,
    )
    fit = fit_of_member(scene.model_copy(update=tables), number)
    own = {"preload_N": usual_loads(spindle)[number], "fit": fit}
    mounting = mounting.model_copy(update=own)
    flaws = scene.imperfections
    if flaws is not None:
        flaws = flaws.reseeded(number).of_bearing(number + 1)
    changes = {"spindle": None, "mounting": mounting, "imperfections": flaws, "sound": None}
    return scene.model_copy(update=tables | changes | {"accelerometer": None})


def still_of(scene: Given) -> Given:
    """Return a set without what runs alone read: sound, imperfections and their lowest speed, the FMU."""
    operation = scene.operation.model_copy(update={"lowest_speed_rpm": None})
    changes = {"sound": None, "accelerometer": None, "imperfections": None, "fmu": None}
    return scene.model_copy(update=changes | {"operation": operation})


def radiating(scene: Given, number: int) -> Given:
    """Return the scene of one bearing of a set, from 0, as its body radiates, bare and without microphones.

    A rotor without mass replaces the shaft, also one of another model, and fills its bore; its length, which
    does not radiate, is read by nothing. A single bearing is returned as it is.
    """
    if not scene.members:
        return scene
    alone = one_of(scene, number)
    length = set_of(scene).shaft.length_mm or alone.bearing.width_mm
    shaft = Rotor(mass_kg=0.0, length_mm=length, diameter_mm=alone.bearing.bore_mm)
    return alone.model_copy(update={"mounting": alone.mounted.model_copy(update={"rotor": shaft})})


def sound_scene(scene: Given, number: int) -> Given:
    """Return the scene of one bearing of a set, from 0, with microphones at their places in its own axes.

    For its sound alone, see `radiating`. It is bare: a housing of the set that radiates is
    `acoustics.filters.bearings.housing_of_set`. A single bearing is returned as it is.
    """
    if not scene.members:
        return scene
    sound, assembly = scene.sound, assembly_of(scene)
    assert sound is not None, "a set without sound"

    def own(along: float) -> float:
        return assembly.own_mm(number, along)

    microphones = tuple(
        Microphone(name=place.name, x_mm=own(x), y_mm=1e3 * y, z_mm=1e3 * z)
        for place in scene.microphones
        for x, y, z in (place.position_m,)
    )
    plane = sound.reflecting_plane_mm
    moved = {
        "microphone": microphones,
        "circle": None,
        "reflecting_plane_mm": None if plane is None else own(1e-3 * plane),
        "radiator": "bare",
    }
    return radiating(scene, number).model_copy(update={"sound": sound.model_copy(update=moved)})
