"""The shaft of a scene's set: rigid, with the coordinates of its nose, or flexible."""

import numpy as np

from fmu_bearing.elastic.shaft.flexible import flexible_model
from fmu_bearing.elastic.shaft.model import FREEDOMS, ShaftModel, rigid_transform
from fmu_bearing.elastic.shaft.sections import shaft_sections
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.spindle import Spindle


def shaft_model(scene: Scene, spindle: Spindle) -> ShaftModel:
    """Return the shaft of a scene's set: one that bends where the scene says so, else a rigid body.

    The coordinates of a rigid one are x y z, tilts about y and z of its nose; those of one that bends follow
    the same five with coordinates of bearings and modes: see ``flexible``.
    """
    bearings = [si(bearing).position for bearing in spindle.bearing]
    spots = [si(spot).position for spot in spindle.shaft.unbalance]
    sections = shaft_sections(scene, spindle.shaft)
    if spindle.shaft.flexible:
        given = spindle.shaft
        return flexible_model(sections, bearings, spots, given.fixed_modes, given.damping_ratio)
    mass, across = np.zeros((FREEDOMS, FREEDOMS)), np.zeros((2, FREEDOMS))
    gyroscopic, polar = np.zeros((FREEDOMS, FREEDOMS)), 0.0
    for section in sections:
        middle = rigid_transform(1.0, section.start + 0.5 * section.length)
        mass += middle.T @ np.diag([section.mass] * 3 + [section.transverse] * 2) @ middle
        across += section.mass * middle[1:3]
        polar += section.polar
    # I_t b'' + I_p Omega x b': about y the rate about z, about z minus that about y
    gyroscopic[3, 4], gyroscopic[4, 3] = polar, -polar
    none = np.zeros((FREEDOMS, FREEDOMS))
    planes, heavy_spots = (
        tuple(rigid_transform(1.0, place) for place in places) for places in (bearings, spots)
    )
    return ShaftModel(
        mass, none, none, gyroscopic, across, rigid_transform(1.0, 0.0), planes, heavy_spots, polar
    )
