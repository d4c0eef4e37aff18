"""A tool on the nose by receptance coupling: the tip of a free beam, whose other end moves as the nose does.

H is the receptance of the free tool with its holder, Timoshenko beams of their sections, at its tip (1) and
where it is fixed (2); G is that of the nose. Equal motions and opposite forces there give
G_tip = H_11 - H_12 (H_22 + G)^-1 H_21 (Schmitz and Donaldson, CIRP Annals 49, 2000, 303-308), with all five
motions: displacements and tilts of both planes, which the gyroscopic effect of nose and tool couples, and the
axis, along which the tool is rigid. The joint is rigid, and its damping is in that of the tool.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import rigid_transform
from fmu_bearing.elastic.shaft.flexible import flexible_model
from fmu_bearing.elastic.shaft.sections import Section, sections_of
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.tool import Tool

_MODES = 10  # with tip and nose clamped, per plane: beyond them frequencies are far above those asked for
_FIVE = 5


def tool_of(scene: Scene) -> Tool:
    """Return the tool of a scene.

    Raises
    ------
    SceneError
        Where it has none.
    """
    if scene.tool is None:
        raise SceneError(
            f"{scene.name}: there is no tip without a tool: give [tool] with sections_mm and material, or "
            "take the nose"
        )
    return scene.tool


def tool_sections(scene: Scene) -> list[Section]:
    """Return the cylinders of tool and holder from the tip to the nose."""
    tool = tool_of(scene)
    sections = sections_of(tool.sections_mm, tool.material)
    if tool.holder is not None:
        behind = sections[-1].start + sections[-1].length
        material = tool.holder.material or scene.materials.inner_ring
        sections += sections_of(tool.holder.sections_mm, material, behind)
    return sections


def fixed_at(scene: Scene) -> float:
    """Return where the tool is fixed (m from the nose; of a single bearing from its middle)."""
    given = tool_of(scene).position_mm
    if given is not None:
        return 1e-3 * given
    rotor = None if scene.mounting is None else scene.mounting.rotor
    return 0.0 if rotor is None else -0.5e-3 * rotor.length_mm


def at_tip(
    scene: Scene, nose: NDArray[np.complex128], frequencies: NDArray[np.float64], speed: float
) -> NDArray[np.complex128]:
    """Return the receptance at the tip of a scene's tool, shape (frequencies, 5, 5).

    Parameters
    ----------
    scene : Scene
    nose : ndarray, shape (frequencies, 5, 5)
        Receptance of the nose.
    frequencies : ndarray
        Hz.
    speed : float
        rad/s of the shaft.
    """
    h = free_tool(tool_sections(scene), tool_of(scene).damping_ratio, frequencies, speed)
    moved = rigid_transform(1.0, fixed_at(scene))
    g = moved @ nose @ moved.T
    tip, end = slice(0, _FIVE), slice(_FIVE, 2 * _FIVE)
    return np.asarray(h[:, tip, tip] - h[:, tip, end] @ np.linalg.solve(h[:, end, end] + g, h[:, end, tip]))


def free_tool(
    sections: list[Section], damping: float, frequencies: NDArray[np.float64], speed: float
) -> NDArray[np.complex128]:
    """Return the receptance of a free tool, shape (frequencies, 10, 10): five motions of its tip, then end.

    ``damping``: ratio, the same at all frequencies: the stiffness is times 1 + 2 i damping.
    """
    model = flexible_model(sections, [sections[-1].start + sections[-1].length], fixed_modes=_MODES)
    both = np.vstack([model.nose, model.planes[0]])
    w = 2.0 * math.pi * frequencies[:, None, None]
    dynamic = (1.0 + 2.0j * damping) * model.stiffness - w**2 * model.mass + 1j * w * speed * model.gyroscopic
    return np.asarray(both @ np.linalg.solve(dynamic, np.broadcast_to(both.T, (len(w), *both.T.shape))))
