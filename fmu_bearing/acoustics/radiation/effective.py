"""Effective volumes of compact bodies: how much air a shaken ring or cylinder sets in motion.

A compact body shaken with acceleration a sounds like a dipole of strength rho V a, where V is its displaced
volume plus its added mass over the air density. The added mass comes from boundary elements (`bem`) at a
frequency whose wavelength is a thousand times the body. Over the displaced volume:

=================  ======  =====
body               radial  axial
=================  ======  =====
ring 30-35 x 10 mm 2.79    1.38
ring 17-22 x 10 mm 2.60    1.38
cage 23.4-27.6x9.1 2.88    1.36
disc d35 x 10      1.30    2.85
sphere             1.50    1.50
=================  ======  =====
"""

from functools import lru_cache

import numpy as np

from fmu_bearing.acoustics.radiation.bem.meridian import NODES, Body, cylinder, ring
from fmu_bearing.acoustics.radiation.bem.solver import Scatterer

_WAVELENGTHS = 1e-3  # size of the body over the wavelength
_DIVISIONS = 12  # elements along the section's smaller extent: volumes are converged to 0.2 %
_MOST_ELEMENTS = 150  # along the largest extent, for hoops and needles


@lru_cache(maxsize=64)
def ring_volumes(outer_diameter: float, inner_diameter: float, width: float) -> tuple[float, float]:
    """Effective volumes (radial, axial) in m3 of a solid ring of rectangular section, lengths in m.

    Raises
    ------
    ValueError
        When the diameters do not leave a positive wall or the width is not positive.
    """
    wall = 0.5 * (outer_diameter - inner_diameter)
    if wall <= 0.0 or width <= 0.0 or inner_diameter <= 0.0:
        raise ValueError(
            f"a ring needs 0 < inner < outer diameter and a width, not {outer_diameter=}, "
            f"{inner_diameter=}, {width=} m"
        )
    body = ring("ring", 0, outer_diameter, inner_diameter, -0.5 * width, 0.5 * width)
    displaced = np.pi / 4.0 * (outer_diameter**2 - inner_diameter**2) * width
    radial, axial = added_volumes(body, min(wall, width) / _DIVISIONS * 2.0)
    return displaced + radial, displaced + axial


@lru_cache(maxsize=64)
def cylinder_volumes(diameter: float, length: float) -> tuple[float, float]:
    """Effective volumes (radial, axial) in m3 of a closed cylinder, lengths in m.

    Raises
    ------
    ValueError
        When a length is not positive.
    """
    if diameter <= 0.0 or length <= 0.0:
        raise ValueError(f"a cylinder needs a diameter and a length, not {diameter=}, {length=} m")
    body = cylinder("cylinder", 0, diameter, -0.5 * length, 0.5 * length)
    radial, axial = added_volumes(body, min(diameter / 2.0, length) / _DIVISIONS)
    displaced = np.pi / 4.0 * diameter**2 * length
    return displaced + radial, displaced + axial


def added_volumes(body: Body, size: float) -> tuple[float, float]:
    """Return added masses (radial, axial) over the air's density, m3, with elements of ``size`` m."""
    extent = float(np.ptp(body.contour, axis=0).max())
    size = max(size, extent / _MOST_ELEMENTS)
    k = 2.0 * np.pi * _WAVELENGTHS / extent
    scatterer = Scatterer([body], k, 2, size)
    system, mesh = scatterer.at(k), scatterer.mesh
    normals, radii = mesh.node_normals(), mesh.points[:, 1]
    lengths = np.hypot(mesh.ends[:, 2] - mesh.ends[:, 0], mesh.ends[:, 3] - mesh.ends[:, 1])
    rings = 2.0 * np.pi * radii * np.repeat(lengths, NODES) / NODES
    axial = system.pressure(0, normals[:, :1])[:, 0].real @ (normals[:, 0] * rings)
    radial = system.pressure(1, normals[:, 1:])[:, 0].real @ (normals[:, 1] * rings) / 2.0
    return float(radial), float(axial)
