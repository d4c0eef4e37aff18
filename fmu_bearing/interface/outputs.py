"""Outputs and local variables of a scene, computed in each step: of shaft, housing and each bearing.

Each bearing of a set has the variables of a single one, under a name of its own.
"""

from collections.abc import Iterable
from dataclasses import replace

from fmu_bearing.engine.layout import SP, Z
from fmu_bearing.interface.accelerometers import accelerometers
from fmu_bearing.interface.bearing_outputs import AXES, internals, outputs
from fmu_bearing.interface.microphones import FLOOR, microphones
from fmu_bearing.interface.variable import Variable, read
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import one_of, set_of

_SMALL = {"display_unit": "um"}
_BOTH_SIGNS = {"min": -1e7, "max": 1e7}
_AXIS = "along the axis, +X from nose to rear"
_DIRECTIONS = (_AXIS, "horizontal", "upwards")


def outputs_of(scene: Scene) -> list[Variable]:
    """Return the outputs: the shaft's, sums over the bearings, then outputs of each bearing."""
    if not scene.assembly.joined:
        return outputs(scene)
    each = [outputs(one_of(scene, b)) for b in range(_count(scene))]
    shared = [variable for variable in each[0] if variable.name in SP.OUTPUTS]
    table = [
        *(_port(scene) if scene.on_other_shaft else _nose(scene)),
        *_housing(scene, "output"),
        *(_sum(scene, one) for one in shared),
    ]
    for b, single in enumerate(each):
        table += [*_forces(scene, b), *_of_bearing(scene, b, single)]
    table += _microphone_variables(scene, "output")
    bands = len(Z.BANDS) if scene.sound is not None and scene.sound.third_octaves else 0
    place = SP.z_accelerometers(_count(scene), len(scene.microphones), bands)
    return table + accelerometers(scene, _own(scene, place))


def internals_of(scene: Scene) -> list[Variable]:
    """Return the local variables: the housing's and the solver's, then variables of each bearing."""
    if not scene.assembly.joined:
        return internals(scene)
    each = [internals(one_of(scene, b)) for b in range(_count(scene))]
    own = [variable for variable in each[0] if variable.name in SP.OUTPUTS]
    table = [*_stiffness(scene), *_housing(scene, "local"), *(_shared(scene, one) for one in own)]
    for b, single in enumerate(each):
        table += _of_bearing(scene, b, [variable for variable in single if variable not in own])
    return [*table, *_microphone_variables(scene, "local"), *_alone(scene)]


def first_output(scene: Scene, number: int) -> int:
    """Return the place in ``z`` where the outputs of a bearing begin, from 0; behind the last, the set's own.

    ``prepare`` lays them out so, each as of a single bearing without sound.
    """
    modes = scene.flexural_modes
    bearings = enumerate(scene.geometries[:number])
    return sum(Z.size(one.ball_count, 0, 0, modes, len(scene.defects_of(k))) for k, one in bearings)


def _count(scene: Scene) -> int:
    return len(set_of(scene).bearing)


def _own(scene: Scene, place: int) -> int:
    """Place in ``z`` of one of the set's own outputs."""
    return first_output(scene, _count(scene)) + place


def _of_bearing(scene: Scene, number: int, single: Iterable[Variable]) -> list[Variable]:
    """Return variables of a single bearing as variables of one of the set."""
    first = first_output(scene, number)
    return [
        replace(
            one,
            name=f"bearing[{number + 1}].{one.name}",
            description=f"Bearing {number + 1}: {one.description[0].lower()}{one.description[1:]}",
            index=first + one.index,
        )
        for one in single
    ]


def _shared(scene: Scene, one: Variable) -> Variable:
    """Return a variable of a single bearing as that of the whole set."""
    return replace(one, index=_own(scene, SP.OUTPUTS.index(one.name)))


def _sum(scene: Scene, one: Variable) -> Variable:
    """Return the sum of a variable over the bearings, with what shaft and housing add to it."""
    words = f"{one.description}; sum over the bearings"
    spindle = set_of(scene)
    if one.name == "heat.inner_ring" and spindle.shaft.flexible:
        words += ", with what the bending shaft loses"
    if one.name == "heat.outer_ring" and spindle.housing.moves:
        words += ", with what the housing's pedestal loses"
    return replace(_shared(scene, one), description=words)


def _nose(scene: Scene) -> list[Variable]:
    """Return where the nose is, and its velocity."""
    table = []
    for motion, unit, more in (("displacement", "m", _SMALL), ("velocity", "m/s", {"display_unit": "mm/s"})):
        for (axis, _), words in zip(AXES, _DIRECTIONS, strict=True):
            name = f"shaft.nose.{motion}.{axis}"
            place = _own(scene, SP.OUTPUTS.index(name))
            text = f"{motion.capitalize()} of the shaft's nose {words}"
            table.append(read(name, "output", text, unit, place, **more))
        if motion == "displacement":
            for axis in "yz":
                name = f"shaft.nose.tilt.{axis}"
                place = _own(scene, SP.OUTPUTS.index(name))
                text = f"Tilt of the shaft's nose about +{axis.upper()}"
                table.append(read(name, "output", text, "rad", place, nominal=1e-4))
    return table


def _stiffness(scene: Scene) -> list[Variable]:
    """Return what resists the shaft at its nose: contacts alone, friction and centrifugal forces held."""
    when = (
        "where the set rested at initialisation"
        if scene.fidelity.model == "full"
        else "where the set rested last: computed again when loads, speed or temperatures have changed"
    )
    words = (
        ("axial", "Axial stiffness of the shaft on its contacts at X = 0, other motions held,", "N/m"),
        ("radial", "Radial stiffness of the shaft on its contacts at X = 0, tilts held,", "N/m"),
        ("tilt", "Stiffness of the shaft on its contacts against tilts at X = 0,", "N.m/rad"),
    )
    return [
        read(
            f"shaft.stiffness.{name}", "local", f"{text} {when}", unit,
            _own(scene, SP.OUTPUTS.index(f"shaft.stiffness.{name}")),
        )
        for name, text, unit in words
    ]  # fmt: skip


def _port(scene: Scene) -> list[Variable]:
    """Return force and moment on the rotor at the port, at the communication point and as mean before it."""
    table = []
    for end, words in (("", ""), ("_mean", ", mean over the last communication step")):
        for (axis, _), way in zip(AXES, _DIRECTIONS, strict=True):
            name = f"port.force{end}.{axis}"
            text = f"Force of the bearings on the rotor {way}, without inertia and weight of the rings{words}"
            table.append(read(name, "output", text, "N", _own(scene, SP.OUTPUTS.index(name)), **_BOTH_SIGNS))
        for axis in "yz":
            name = f"port.moment{end}.{axis}"
            text = f"Moment of the bearings on the rotor about +{axis.upper()} at X = 0{words}"
            place = _own(scene, SP.OUTPUTS.index(name))
            table.append(read(name, "output", text, "N.m", place, nominal=1.0))
    return table


def _housing(scene: Scene, causality: str) -> list[Variable]:
    """Return velocity (outputs) or displacement (local) of a housing that moves, at its pedestal's plane."""
    if not set_of(scene).housing.moves:
        return []
    motion, unit, more = ("velocity", "m/s", {"display_unit": "mm/s"})
    if causality == "local":
        motion, unit, more = ("displacement", "m", _SMALL)
    return [
        read(
            f"housing.{motion}.{axis}",
            causality,
            f"{motion.capitalize()} of the housing in the plane of its pedestal {words}",
            unit,
            _own(scene, SP.OUTPUTS.index(f"housing.{motion}.{axis}")),
            **more,
        )
        for (axis, _), words in zip(AXES, _DIRECTIONS, strict=True)
    ]


def _microphone_variables(scene: Scene, causality: str) -> list[Variable]:
    """Return the variables of the microphones: as for a single bearing, of the sum over the set."""
    variables = microphones(scene, causality, _own(scene, SP.z_mics(_count(scene))))
    if scene.sound is None or scene.sound.radiator != "housing":
        return variables
    shown = tuple(f".spl_{part}" for part in ("inner_ring", "cage", "balls"))
    return [
        replace(one, description=one.description.replace(" at microphone", " of bearing 1 at microphone"))
        if one.name.endswith(shown)
        else one
        for one in variables
    ]


def _alone(scene: Scene) -> list[Variable]:
    """Return the level of every bearing alone at every microphone.

    A housing that radiates moves by what all bearings do to it: there its sound is no bearing's own.
    """
    if scene.sound is None or scene.sound.radiator == "housing":
        return []
    bearings, bands = _count(scene), len(Z.BANDS) if scene.sound.third_octaves else 0
    first = _own(scene, SP.z_alone(bearings, len(scene.microphones), bands))
    return [
        read(
            f"mic[{k + 1}].spl_bearing[{b + 1}]",
            "local",
            f"Time-weighted level of bearing {b + 1} alone at microphone {name}{FLOOR}",
            "dB",
            first + k * bearings + b,
        )
        for k, (name, _) in enumerate(scene.microphones)
        for b in range(bearings)
    ]


def _forces(scene: Scene, number: int) -> list[Variable]:
    """Return force and moment of the shaft on one bearing."""
    first = _own(scene, SP.Z_FORCES + number * SP.Z_FORCE)
    table = []
    for place, name in enumerate(SP.BEARING_OUTPUTS):
        kind, _, axis = name.partition(".")
        if kind == "force":
            words = f"force of the shaft on the bearing {_DIRECTIONS['xyz'.index(axis)]}"
            if axis == "x":
                words += ": positive where it carries +x"
            unit, more = "N", dict(_BOTH_SIGNS)
        else:
            words = f"moment of the shaft on the bearing about +{axis.upper()} through its ball plane"
            unit, more = "N.m", {"nominal": 1.0}
        text = f"Bearing {number + 1}: {words}"
        table.append(read(f"bearing[{number + 1}].{name}", "output", text, unit, first + place, **more))
    return table
