"""Rung ``bem``: from a scene's bodies to the paths of `transfer.Path`."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.bem.bodies import bodies_of
from fmu_bearing.acoustics.radiation.bem.meridian import Body
from fmu_bearing.acoustics.radiation.bem.solution import (
    AXIAL,
    BODIES,
    RADIAL,
    TILT,
    Solution,
    Task,
    shapes_of,
    solution,
)
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies
from fmu_bearing.acoustics.radiation.radiators import BALLS, Air, Path, Radiators
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
        return Task(bodies, air.sound_speed, air.density, 0.0, 0, (), wall, True)
    if plane is not None:
        for body in bodies:
            low, high = body.contour[:, 0].min(), body.contour[:, 0].max()
            if low <= plane <= high or (low < plane) != (bodies[0].contour[0, 0] < plane):
                raise ValueError(
                    f"the reflecting plane at {1e3 * plane:g} mm cuts the {body.name}, from {1e3 * low:g} to "
                    f"{1e3 * high:g} mm: move sound.reflecting_plane_mm beyond it"
                )
    orbit = 0.5 * radiators.pitch_diameter
    return Task(bodies, air.sound_speed, air.density, orbit, harmonics, shapes_of(modes), plane)


def bem_paths(
    radiators: Radiators,
    air: Air,
    radius: float,
    axial: float,
    azimuths: Sequence[float],
    harmonics: int,
    modes: Sequence = (),
    plane: float | None = None,
) -> list[Path]:
    """Paths of the rung ``bem`` to microphones on a circle, in the order of channels.

    Parameters
    ----------
    radius, axial
        Distance of the circle from the axis and place along it, m.
    azimuths
        Angles of its microphones from 12 o'clock in rad, growing with positive rotation about X.
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
    task = task_of(radiators, air, harmonics, modes, plane)
    _check_outside(task, radius, axial)
    solved = solution(task)
    field = solved.field(np.array([[axial, radius]]))[0]
    nearest = float(np.hypot(*(solved.points - (axial, radius)).T).min())
    flight = nearest / air.sound_speed
    field *= np.exp(2j * np.pi * solved.frequencies * flight)  # smooth enough to interpolate
    f = fit_frequencies()
    response = CubicSpline(solved.frequencies, field, axis=1)(f) * np.exp(-2j * np.pi * f * flight)
    angles = np.asarray(azimuths, dtype=float)
    paths = _body_paths(response, flight, angles) + _mode_paths(response, flight, angles, modes, harmonics)
    if task.orbit > 0.0:
        radius_of_ball = 0.5 * radiators.ball_diameter
        strength = 2.0 * np.pi * radius_of_ball**3 * sources.sphere_factor(f, radius_of_ball, air.sound_speed)
        paths += _ball_paths(solved, response * strength, flight, angles, harmonics)
    return sorted(paths, key=lambda path: path.channel)


def _body_paths(response: NDArray[np.complex128], flight: float, angles: NDArray[np.float64]) -> list[Path]:
    """Rigid motion: y is -r sin(phi), z is r cos(phi); a turn about y lifts z, one about z lowers y."""
    one, cosine, sine = np.ones(len(angles)), np.cos(angles), np.sin(angles)
    paths = []
    for body in range(BODIES):
        parts = (
            (3 * body, AXIAL + body, one, SD.AXIAL),
            (3 * body + 1, RADIAL + body, -sine, SD.RADIAL),
            (3 * body + 2, RADIAL + body, cosine, SD.RADIAL),
            (SD.C_TILTS + 2 * body, TILT + body, cosine, SD.ROTATION),
            (SD.C_TILTS + 2 * body + 1, TILT + body, sine, SD.ROTATION),
        )
        for channel, drive, weights, kind in parts:
            if np.any(response[drive]):
                paths.append(Path(body, channel, flight, response[drive], weights, kind))
    return paths


def _mode_paths(
    response: NDArray[np.complex128],
    flight: float,
    angles: NDArray[np.float64],
    modes: Sequence,
    harmonics: int,
) -> list[Path]:
    """Two coordinates of every flexural mode: cos and sin of n times the angle."""
    paths = []
    first = SD.c_flex(harmonics)
    for i, mode in enumerate(modes):
        for k, weights in enumerate((np.cos(mode.order * angles), np.sin(mode.order * angles))):
            drive = response[3 * BODIES + i]
            paths.append(Path(int(mode.body), first + 2 * i + k, flight, drive, weights, SD.FLEXURE))
    return paths


def _ball_paths(
    solved: Solution,
    response: NDArray[np.complex128],
    flight: float,
    angles: NDArray[np.float64],
    harmonics: int,
) -> list[Path]:
    """Circumferential harmonics of the balls' accelerations, as in `transfer.ball_harmonics`."""
    paths = []
    for m in range(harmonics + 1):
        cosine, sine = np.cos(m * angles), np.sin(m * angles)
        for axis in range(3):
            if m == 0 and axis == 2:
                continue  # tangential accelerations alike all round make no sound
            drive = response[solved.ball_drive(m, axis)]
            first, second = (sine, -cosine) if axis == 2 else (cosine, sine)
            channel = SD.C_BALLS + axis if m == 0 else SD.C_BALLS + 2 + 6 * (m - 1) + 2 * axis
            paths.append(Path(BALLS, channel, flight, drive, first, SD.BALLS_KIND))
            if m > 0:
                paths.append(Path(BALLS, channel + 1, flight, drive, second, SD.BALLS_KIND))
    return paths


def _check_outside(task: Task, radius: float, axial: float) -> None:
    where = f"microphone at {1e3 * radius:g} mm from the axis, {1e3 * axial:g} mm along it"
    for body in task.bodies:
        inside: Body = body
        if not task.baffled and inside.contains(axial, radius):
            raise ValueError(f"{where}, lies inside the {body.name}")
    if task.plane is None:
        return
    front = -1.0 if task.baffled else np.sign(task.bodies[0].contour[0, 0] - task.plane)
    if (axial - task.plane) * front <= 0.0:
        raise ValueError(
            f"{where}, lies behind the rigid wall at {1e3 * task.plane:g} mm: move it to the other side"
        )
