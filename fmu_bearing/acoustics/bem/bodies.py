"""The bodies of revolution that a bearing shows to the air.

``bare``: both rings and the cage, each free in space; where a rotor is mounted, its shaft fills the inner
ring's bore, flush with the ring. ``housing``: outer ring and housing are one body with an open front, the
inner ring sits on a shaft stub that ends flush with the housing's front face; behind the bearing the bore is
closed half a bearing width further back (assumed: seals and spacers are not modelled). ``baffle``: the rings'
front faces lie flush in an infinite rigid wall, the gap between them is closed (assumed), balls and cage
are not heard.

Grooves, chamfers and the cage's pockets are left out.
"""

import itertools

import numpy as np

from fmu_bearing.acoustics.bem.meridian import Body, cylinder, ring
from fmu_bearing.acoustics.radiators import CAGE, INNER, OUTER, Radiators

_FLOOR = 0.5  # of the bearing's width: depth of the closed room behind the bearing
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
    found = []
    if radiators.housing is not None:
        found.append(_housing(radiators))
        front = radiators.housing.centre - 0.5 * radiators.housing.length
        found.append(_stub(inner.outer, inner.inner, half, min(front, -half)))
    else:
        found.append(ring("outer ring", OUTER, outer.outer, outer.inner, -half, half))
        if radiators.shaft:
            found.append(cylinder("inner ring", INNER, inner.outer, -half, half))
        else:
            found.append(ring("inner ring", INNER, inner.outer, inner.inner, -half, half))
    if radiators.cage is not None:
        cage = radiators.cage
        found.append(ring("cage", CAGE, cage.outer, cage.inner, -0.5 * cage.width, 0.5 * cage.width))
    for one, other in itertools.combinations(found, 2):
        _check_apart(one, other)
    return found


def _face(name: str, component: int, outer: float, inner: float, x: float) -> Body:
    """Annular face at x, looking towards -X; diameters in m."""
    return Body(name, np.array([[x, 0.5 * inner], [x, 0.5 * outer]]), (component,))


def _housing(radiators: Radiators) -> Body:
    """Outer ring and housing: a cylinder with a stepped bore, open towards -X."""
    housing, outer = radiators.housing, radiators.outer_ring
    assert housing is not None
    half = 0.5 * outer.width
    front, rear = housing.centre - 0.5 * housing.length, housing.centre + 0.5 * housing.length
    floor = half + _FLOOR * outer.width
    if front > half or rear <= floor:
        raise ValueError(
            f"the housing from x = {1e3 * front:g} to {1e3 * rear:g} mm does not hold the bearing and the "
            f"room behind it, x = {-1e3 * half:g} to {1e3 * floor:g} mm: change "
            "mounting.housing.front_face_mm or length_mm"
        )
    corners = [
        (floor, 0.0),
        (floor, 0.5 * outer.inner),
        (-half, 0.5 * outer.inner),
        (-half, 0.5 * outer.outer),
        (front, 0.5 * outer.outer),
        (front, 0.5 * housing.diameter),
        (rear, 0.5 * housing.diameter),
        (rear, 0.0),
    ]
    return _contour("housing", OUTER, corners)


def _stub(outer: float, bore: float, half: float, front: float) -> Body:
    """Inner ring on a shaft that ends at x = ``front``; diameters in m."""
    corners = [
        (front, 0.0),
        (front, 0.5 * bore),
        (-half, 0.5 * bore),
        (-half, 0.5 * outer),
        (half, 0.5 * outer),
        (half, 0.0),
    ]
    return _contour("inner ring", INNER, corners)


def _contour(name: str, component: int, corners: list[tuple[float, float]]) -> Body:
    """Body of one component; corners that coincide are one."""
    kept = [corners[0]] + [
        b for a, b in itertools.pairwise(corners) if np.hypot(b[0] - a[0], b[1] - a[1]) > 1e-9
    ]
    return Body(name, np.array(kept), (component,) * (len(kept) - 1))


def _check_apart(one: Body, other: Body) -> None:
    for first, second in ((one, other), (other, one)):
        t = (np.arange(_SAMPLES) + 0.5)[:, None] / _SAMPLES
        sides = [a + t * (b - a) for a, b in itertools.pairwise(first.contour)]
        points = np.concatenate(sides)
        inside = any(second.contains(*point) for point in points)
        if inside or float(second.distance(points).min()) < _TOUCH:
            raise ValueError(
                f"the {first.name} touches or intersects the {second.name}: change their diameters, widths "
                "or the housing's place"
            )
