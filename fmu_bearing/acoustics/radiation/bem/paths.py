"""Radiation model ``bem``: from a scene's bodies to paths (`radiators.Path`)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.bem.bodies import bodies_of
from fmu_bearing.acoustics.radiation.bem.meridian import Body
from fmu_bearing.acoustics.radiation.bem.solution import solution
from fmu_bearing.acoustics.radiation.bem.task import AXIAL, BODIES, RADIAL, TILT, Task, shapes_of
from fmu_bearing.acoustics.radiation.circle import (
    SKIN,
    MicrophoneCircle,
    ball_paths,
    tilt_paths,
    translation_paths,
)
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import Air, Path, Radiators
from fmu_bearing.engine.layout import SD


def task_of(
    radiators: Radiators, air: Air, harmonics: int, modes: Sequence = (), plane: float | None = None
) -> Task:
    """Return what has to be solved for a scene.

    Raises
    ------
    ValueError
        When bodies intersect each other or the plane.
    """
    bodies = tuple(bodies_of(radiators))
    if radiators.baffle:
        wall = float(bodies[0].contour[0, 0])
        return Task(bodies, air.sound_speed, 0.0, 0, (), wall, True)
    if plane is not None:
        for body in bodies:
            low, high = body.contour[:, 0].min(), body.contour[:, 0].max()
            if low <= plane <= high or (low < plane) != (bodies[0].contour[0, 0] < plane):
                raise ValueError(
                    f"the reflecting plane at {1e3 * plane:g} mm cuts the {body.name}, from {1e3 * low:g} to "
                    f"{1e3 * high:g} mm: move sound.reflecting_plane_mm beyond it"
                )
    orbit = 0.5 * radiators.pitch_diameter
    return Task(bodies, air.sound_speed, orbit, harmonics, shapes_of(modes), plane)


def bem_paths(
    radiators: Radiators,
    air: Air,
    circle: MicrophoneCircle,
    harmonics: int,
    modes: Sequence = (),
    plane: float | None = None,
) -> list[Path]:
    """Paths of the radiation model ``bem`` to microphones on a circle.

    Parameters
    ----------
    radiators, air, circle
        Sources, medium and receivers.
    harmonics
        Highest circumferential order kept of the balls' sound.
    modes
        Flexural modes (`elastic.modes.RingMode`) in the order of the engine's coordinates.
    plane
        Axial place (m) of a rigid plane normal to the axis.

    Raises
    ------
    ValueError
        When the circle runs through a body or behind the plane, or bodies intersect.
    """
    if radiators.baffle and radiators.turned:
        ahead = replace(circle, axial=-circle.axial)
        all_paths = bem_paths(replace(radiators, turned=False), air, ahead, harmonics, modes)
        # mirrored along the axis: motion along it and tilts change their sign
        turned = (SD.AXIAL, SD.ROTATION)
        return [replace(path, weights=-path.weights) if path.kind in turned else path for path in all_paths]
    task = task_of(radiators, air, harmonics, modes, plane)
    _check_outside(task, circle)
    solved = solution(task)
    f = fit_frequencies()
    here = np.array([[circle.axial, circle.radius]])
    response = air.density * solved.transfer(here, f)[0]
    flight = float(solved.bands[-1].flights(here)[0])
    paths = _body_paths(response, flight, circle) + _mode_paths(response, flight, circle, modes, harmonics)
    if task.orbit > 0.0:
        radius = 0.5 * radiators.ball_diameter
        strength = 2.0 * np.pi * radius**3 * sources.sphere_factor(f, radius, air.sound_speed)
        orders = range(harmonics + 1)
        drives = np.array([[solved.ball_drive(m, axis) for m in orders] for axis in range(SD.AXES)])
        paths += ball_paths((response * strength)[drives], flight, circle)
    return paths


def _body_paths(response: NDArray[np.complex128], flight: float, circle: MicrophoneCircle) -> list[Path]:
    """Rigid motion that radiates; a turn about y lifts z, one about z lowers y."""
    paths: list[Path] = []
    for body in range(BODIES):
        paths += translation_paths(body, flight, response[AXIAL + body], response[RADIAL + body], circle)
        paths += tilt_paths(body, flight, response[TILT + body], circle.order(1))
    return [path for path in paths if np.any(path.response)]


def _mode_paths(
    response: NDArray[np.complex128],
    flight: float,
    circle: MicrophoneCircle,
    modes: Sequence,
    harmonics: int,
) -> list[Path]:
    """Two coordinates of every flexural mode: cos and sin of n times the angle."""
    paths = []
    first = SD.c_flex(harmonics)
    for i, mode in enumerate(modes):
        drive = response[3 * BODIES + i]
        for k, weights in enumerate(circle.order(mode.order)):
            paths.append(Path(int(mode.body), first + 2 * i + k, flight, drive, weights, SD.FLEXURE))
    return paths


def _check_outside(task: Task, circle: MicrophoneCircle) -> None:
    for body in task.bodies:
        inside: Body = body
        if task.baffled:
            continue
        here = np.array([[circle.axial, circle.radius]])
        distance, within = float(inside.distance(here)[0]), inside.contains(here)[0]
        if within or distance < SKIN:
            corners = 1e3 * inside.polygon()
            raise ValueError(
                f"{circle.words}, lies {'inside' if distance > SKIN else 'on'} the {body.name}, which "
                f"reaches to r = {corners[:, 1].max():g} mm from x = {corners[:, 0].min():g} to "
                f"{corners[:, 0].max():g} mm, {1e3 * distance:.3g} mm from its surface: move it out"
            )
    if task.plane is None:
        return
    front = -1.0 if task.baffled else np.sign(task.bodies[0].contour[0, 0] - task.plane)
    if (circle.axial - task.plane) * front <= 0.0:
        raise ValueError(
            f"{circle.words}, lies behind the rigid wall at {1e3 * task.plane:g} mm: move it to the other "
            "side"
        )
