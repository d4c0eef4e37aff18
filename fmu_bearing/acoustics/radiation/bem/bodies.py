"""The bodies of revolution that a bearing shows to the air.

``bare``: both rings and the cage, each free in space; where a rotor is mounted, its shaft fills the inner
ring's bore, flush with the ring. ``housing``: outer ring and housing move together, the inner ring sits on a
shaft stub that ends flush with the housing's front face; the slot between the rings is open to the front and
closed where the bearing ends (assumed: seals and spacers are not modelled). ``baffle``: the rings'
front faces lie flush in an infinite rigid wall, the gap between them is closed (assumed), balls and cage
make no sound.

Grooves, chamfers and the cage's pockets are left out.
"""

import itertools

import numpy as np

from fmu_bearing.acoustics.radiation.bem.meridian import Body, cylinder, ring
from fmu_bearing.acoustics.radiation.radiators import CAGE, INNER, OUTER, Radiators

_TOUCH = 1e-5  # m: bodies closer than this count as touching
_SAMPLES = 40  # along each side, when looking for bodies that intersect


def bodies_of(radiators: Radiators) -> list[Body]:
    """Bodies that radiate and scatter, in the bearing's coordinates, m.

    Raises
    ------
    ValueError
        When two bodies touch or intersect, or a housing does not hold its bearing.
    """
    inner, outer = radiators.inner_ring, radiators.outer_ring
    half = 0.5 * outer.width
    if radiators.baffle:
        bore = 0.0 if radiators.shaft else inner.inner
        return [
            _face("inner ring", INNER, inner.outer, bore, -half),
            _face("outer ring", OUTER, outer.outer, outer.inner, -half),
        ]
    bodies = []
    if radiators.housing is not None:
        bodies.append(_housing(radiators))
    else:
        bodies.append(ring("outer ring", OUTER, outer.outer, outer.inner, -half, half))
        if radiators.shaft:
            bodies.append(cylinder("inner ring", INNER, inner.outer, -half, half))
        else:
            bodies.append(ring("inner ring", INNER, inner.outer, inner.inner, -half, half))
    if radiators.cage is not None:
        cage = radiators.cage
        bodies.append(ring("cage", CAGE, cage.outer, cage.inner, -0.5 * cage.width, 0.5 * cage.width))
    for one, other in itertools.combinations(bodies, 2):
        _check_apart(one, other)
    return bodies


def _face(name: str, component: int, outer: float, inner: float, x: float) -> Body:
    """Annular face at x, looking towards -X; diameters in m."""
    return Body(name, np.array([[x, 0.5 * inner], [x, 0.5 * outer]]), (component,))


def _housing(radiators: Radiators) -> Body:
    """Return housing, outer ring, inner ring and shaft stub as one body with a slot open to its front."""
    housing, outer, inner = radiators.housing, radiators.outer_ring, radiators.inner_ring
    assert housing is not None
    half = 0.5 * outer.width
    way = -1.0 if housing.turned else 1.0
    centre = way * housing.centre  # drawn with its front towards -X, then mirrored
    front, rear = centre - 0.5 * housing.length, centre + 0.5 * housing.length
    if front > half or rear <= half:
        raise ValueError(
            f"the housing from x = {1e3 * front:g} to {1e3 * rear:g} mm does not hold the bearing, "
            f"x = {-1e3 * half:g} to {1e3 * half:g} mm: change mounting.housing.front_face_mm or length_mm"
        )
    corners = [
        ((min(front, -half), 0.0), INNER),
        ((min(front, -half), 0.5 * inner.inner), INNER),
        ((-half, 0.5 * inner.inner), INNER),
        ((-half, 0.5 * inner.outer), INNER),
        ((half, 0.5 * inner.outer), OUTER),
        ((half, 0.5 * outer.inner), OUTER),
        ((-half, 0.5 * outer.inner), OUTER),
        ((-half, 0.5 * outer.outer), OUTER),
        ((front, 0.5 * outer.outer), OUTER),
        ((front, 0.5 * housing.diameter), OUTER),
        ((rear, 0.5 * housing.diameter), OUTER),
    ]
    contour, sides = [(rear, 0.0)], list[int]()
    for corner, component in reversed(corners):
        if np.hypot(corner[0] - contour[0][0], corner[1] - contour[0][1]) > 1e-9:
            contour.insert(0, corner)
            sides.insert(0, component)
    if housing.turned:
        # walked the other way round, so that the body stays on the right-hand side
        return Body("housing", np.array(contour[::-1]) * [-1.0, 1.0], tuple(sides[::-1]))
    return Body("housing", np.array(contour), tuple(sides))


def _check_apart(one: Body, other: Body) -> None:
    for first, second in ((one, other), (other, one)):
        t = (np.arange(_SAMPLES) + 0.5)[:, None] / _SAMPLES
        sides = [a + t * (b - a) for a, b in itertools.pairwise(first.contour)]
        points = np.concatenate(sides)
        if second.contains(points).any() or float(second.distance(points).min()) < _TOUCH:
            raise ValueError(
                f"the {first.name} touches or intersects the {second.name}: change their diameters, widths "
                "or the housing's place"
            )
