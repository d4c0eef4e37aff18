"""Three-dimensional boundary elements (bempp-cl) on a rigid ring: the peer of radiation model bem.

bempp-cl takes e^{-j omega t}; what it returns is conjugated here.
"""

import numpy as np

DENSITY, SPEED = 1.225, 340.0


def ring_grid(outer, inner, width, around, size):
    """Triangles of a ring of rectangular section: vertices (3, n), elements (3, m), outward normals.

    ``around``: divisions of the circumference; ``size``: largest division of the section's sides, m.
    """
    a, b, h = 0.5 * inner, 0.5 * outer, 0.5 * width
    corners = [(-h, a), (-h, b), (h, b), (h, a)]
    section = []
    for (x1, r1), (x2, r2) in zip(corners, corners[1:] + corners[:1], strict=True):
        count = max(2, int(np.ceil(np.hypot(x2 - x1, r2 - r1) / size)))
        # finer towards the edges
        t = 0.5 * (1.0 - np.cos(np.pi * np.arange(count) / count))
        section += [(x1 + s * (x2 - x1), r1 + s * (r2 - r1)) for s in t]
    points = np.array(section)
    n = len(points)
    angle = 2.0 * np.pi * np.arange(around) / around
    x = np.tile(points[:, 0], around)
    r = np.tile(points[:, 1], around)
    phi = np.repeat(angle, n)
    vertices = np.stack([x, -r * np.sin(phi), r * np.cos(phi)])
    elements = []
    for k in range(around):
        for i in range(n):
            j, m = (i + 1) % n, (k + 1) % around
            p, q, s, t = k * n + i, k * n + j, m * n + j, m * n + i
            elements += [(p, s, q), (p, t, s)]
    elements = np.array(elements).T
    first = vertices[:, elements[0]]
    normals = np.cross((vertices[:, elements[1]] - first).T, (vertices[:, elements[2]] - first).T)
    # the first side looks towards -X
    if normals[0, 0] > 0.0:
        elements = elements[[0, 2, 1]]
    return vertices, elements


def ring_pressures(outer, inner, width, frequency, points, around=48, size=1.2e-3):
    """Pressures per acceleration of a rigid ring along x and along z at ``points`` (n, 3); and unknowns."""
    from bempp_cl import api

    api.DEFAULT_DEVICE_INTERFACE = "numba"
    vertices, elements = ring_grid(outer, inner, width, around, size)
    grid = api.Grid(vertices, elements)
    pressure, velocity = api.function_space(grid, "P", 1), api.function_space(grid, "DP", 0)
    k = 2.0 * np.pi * frequency / SPEED
    identity = api.operators.boundary.sparse.identity(pressure, pressure, pressure)
    double = api.operators.boundary.helmholtz.double_layer(pressure, pressure, pressure, k)
    single = api.operators.boundary.helmholtz.single_layer(velocity, pressure, pressure, k)
    matrix = (0.5 * identity - double).weak_form().to_dense()
    into = single.weak_form().to_dense()
    normals = grid.normals
    driven = DENSITY * normals[:, [0, 2]]
    found = np.linalg.solve(matrix, into @ driven)
    field_double = api.operators.potential.helmholtz.double_layer(pressure, points.T, k)
    field_single = api.operators.potential.helmholtz.single_layer(velocity, points.T, k)
    heard = []
    for column in range(2):
        surface = api.GridFunction(pressure, coefficients=found[:, column])
        moved = api.GridFunction(velocity, coefficients=driven[:, column])
        heard.append((field_double * surface + field_single * moved)[0].conj())
    return np.array(heard), pressure.global_dof_count
