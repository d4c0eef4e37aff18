"""Vectors of four balls against NumPy."""

import numpy as np

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE
from fmu_bearing.engine.mechanics.triples import added, along, cross, dot, scaled, store_three, three


def test_products_and_sums_of_vectors():
    @kernel
    def run(x, out):
        a = three(x, 1)
        b = three(x, 3 * STRIDE)
        c = three(x, 6 * STRIDE)
        s = dot(a, b)
        store_three(out, 0, cross(a, b))
        store_three(out, 3 * STRIDE, added(scaled(2.0, a), scaled(s, b)))
        store_three(out, 6 * STRIDE, along(s, a, 3.0, b, -s, c))

    x = np.random.default_rng(6).normal(size=9 * STRIDE + 4)
    out = np.zeros(9 * STRIDE)
    run(x, out)
    a, b, c = (x[at : at + 3 * STRIDE].reshape(3, STRIDE)[:, :4] for at in (1, 3 * STRIDE, 6 * STRIDE))
    s = (a * b).sum(0)
    rows = out.reshape(3, 3, STRIDE)
    np.testing.assert_allclose(rows[0, :, :4], np.cross(a.T, b.T).T, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(rows[1, :, :4], 2.0 * a + s * b, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(rows[2, :, :4], s * a + 3.0 * b - s * c, rtol=1e-13, atol=1e-15)
    assert not rows[:, :, 4:].any()


def test_they_serve_a_single_ball_too():
    @kernel
    def run(a, b):
        return dot(cross(a, b), added(a, scaled(2.0, b)))

    assert abs(run((1.0, 2.0, 3.0), (-0.5, 0.25, 4.0))) < 1e-14
