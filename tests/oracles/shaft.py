"""Several bearings on one rigid shaft at standstill: five equations of equilibrium, a general root finder.

Each bearing is the independent one of `jones_harris`. One that carries the other way is seen in a mirror: in
the plane x = 0 of its own centre, axial displacements and the tilts (axial vectors along the mirror) change
sign. Displacement of its centre is that of the nose plus the shaft's rotation times the way there.
"""

import numpy as np
from scipy.optimize import root

from . import Bearing
from .jones_harris import MICRO, JonesHarris


def shaft(bearings, places, signs, offsets, force, at):
    """Return the displacement of the nose (m, rad) and per bearing force and moment on it, shaft axes.

    ``bearings``: one of all, or one for each place; ``places`` (m), ``signs``, ``offsets`` (m, own axial
    displacement at zero), ``force`` x y z (N) at the plane ``at`` (m).
    """
    each = [bearings] * len(places) if isinstance(bearings, Bearing) else bearings
    models = [JonesHarris(bearing, "outer", control="outer") for bearing in each]
    lever = 0.5 * each[0].pitch_diameter

    def carried(q):
        found = []
        for model, x, sign, offset in zip(models, places, signs, offsets, strict=True):
            centre = q[:3] + np.cross([0.0, q[3], q[4]], [x, 0.0, 0.0])
            own = np.array([sign * centre[0] + offset, *centre[1:], sign * q[3], sign * q[4]])
            on_ring = model.at_displacement(own).force
            found.append(-np.array([sign, 1.0, 1.0, sign, sign]) * on_ring)
        return np.array(found)

    def balance(u):
        q = np.array([*u[:3], *(u[3:] / lever)]) * MICRO
        left = np.array(force, dtype=float)
        about = np.cross([at, 0.0, 0.0], force)
        for x, one in zip(places, carried(q), strict=True):
            left -= one[:3]
            about -= np.array([0.0, *one[3:]]) + np.cross([x, 0.0, 0.0], one[:3])
        return np.array([*left, *(about[1:] / lever)])

    found = root(balance, np.zeros(5), tol=1e-10, options={"eps": 1e-6})
    if np.abs(balance(found.x)).max() > 1e-4:
        raise ValueError(found.message)
    q = np.array([*found.x[:3], *(found.x[3:] / lever)]) * MICRO
    return q, carried(q)
