"""Four lanes at a time: every operation against NumPy, bit for bit."""

import math

import numpy as np
import pytest

from fmu_bearing.engine import lanes
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import (
    consecutive,
    dot_lanes,
    from_bits,
    gather,
    in_groups,
    lane,
    load,
    select,
    splat,
    store,
    sum_four,
    sum_lanes,
    to_bits,
    transposed,
)
from fmu_bearing.engine.layout import FOUR

SIZE = 4096
X, Y = np.random.default_rng(0).normal(size=(2, SIZE))
X[:6] = Y[:6] = [0.0, -0.0, math.inf, -math.inf, math.nan, 5e-324]
Y[2:8] = [1.0, math.nan, 1.0, 1.0, -0.0, 0.0]


def on_lanes(operation):
    """Array of ``operation`` on two arrays, four lanes at a time."""
    act = kernel(operation)

    @kernel
    def run(x, y, out):
        for j in range(0, x.size, FOUR):
            store(out, j, act(load(x, j), load(y, j)))

    out = np.full(SIZE, math.nan)
    run(X, Y, out)
    return out


OPERATIONS = {
    "sum": (lambda a, b: a + b, lambda a, b: a + b),
    "difference": (lambda a, b: a - b, lambda a, b: a - b),
    "product": (lambda a, b: a * b, lambda a, b: a * b),
    "quotient": (lambda a, b: a / b, lambda a, b: a / b),
    "negative": (lambda a, b: -a, lambda a, b: -a),
    "numbers beside": (lambda a, b: 2.0 * a + 1.0 / b - 3.0, lambda a, b: 2.0 * a + 1.0 / b - 3.0),
    # rounded twice: a contraction would keep the product's lower half
    "no contraction": (lambda a, b: a * b - a * b * 1.0, lambda a, b: a * b - a * b * 1.0),
    "abs": (lambda a, b: abs(a), lambda a, b: np.abs(a)),
    "root": (lambda a, b: math.sqrt(abs(a)), lambda a, b: np.sqrt(np.abs(a))),
    # as Python's: the second where neither is larger
    "max": (lambda a, b: max(a, b), lambda a, b: np.where(a > b, a, b)),
    "min": (lambda a, b: min(a, b), lambda a, b: np.where(a < b, a, b)),
    "clipped": (lambda a, b: max(a, 0.0), lambda a, b: np.where(a > 0.0, a, 0.0)),
    "select": (lambda a, b: select(a < b, a, 1.0), lambda a, b: np.where(a < b, a, 1.0)),
    "orders": (
        lambda a, b: select((a <= b) & (b > 0.5) | (a >= 1.0) | (a == b), a, -b),
        lambda a, b: np.where((a <= b) & (b > 0.5) | (a >= 1.0) | (a == b), a, -b),
    ),
    "words": (
        lambda a, b: from_bits(((to_bits(a) >> 3) & 0x000FFFFFFFFFFFFF | 0x3FF0000000000000) + 7 << 1),
        lambda a, b: (((a.view(np.uint64) >> 3) & 0x000FFFFFFFFFFFFF | 0x3FF0000000000000) + 7 << 1).view(
            float
        ),
    ),
}


@pytest.mark.parametrize("name", OPERATIONS)
def test_operations_have_the_bits_of_numpy(name):
    operation, expected = OPERATIONS[name]
    with np.errstate(all="ignore"):
        wanted = expected(X, Y)
    got = on_lanes(operation)
    either = np.isnan(wanted)  # a NaN's sign and payload mean nothing
    np.testing.assert_array_equal(np.isnan(got), either)
    np.testing.assert_array_equal(got[~either].view(np.int64), wanted[~either].view(np.int64))


def test_in_place_operators_and_numbers_alone():
    @kernel
    def run(x, out):
        total = splat(1.0)
        total += load(x, 1)
        total -= 0.5
        total *= load(x, 5)
        total /= 3.0
        store(out, 3, total)
        store(out, 8, 2.0)
        return lane(total, 2)

    out = np.zeros(13)
    third = run(X, out)
    X1, X5 = X[9:13], X[13:17]
    run(X[8:], out)  # a slice, at a place that is no multiple of four
    wanted = (1.0 + X1 - 0.5) * X5 / 3.0
    np.testing.assert_array_equal(out, [0.0] * 3 + [*wanted] + [0.0] + [2.0] * 4 + [0.0])
    assert third == (1.0 + X[3] - 0.5) * X[7] / 3.0


def test_tables_are_read_at_their_places():
    table = np.arange(100.0) ** 2
    table.setflags(write=False)  # as parameters are

    @kernel
    def run(x, first, out):
        store(out, 0, gather(x, first, to_bits(consecutive(3)) >> 52 & 1) + consecutive(first))

    out = np.zeros(4)
    run(table, 10, out)
    exponents = np.arange(3.0, 7.0).view(np.uint64) >> 52 & 1
    np.testing.assert_array_equal(out, table[10 + exponents.astype(int)] + np.arange(10, 14))


def test_sums_add_four_partial_sums_in_order():
    @kernel
    def run(x, y):
        return sum_four(load(x, 8)), sum_lanes(x, 8, 24), dot_lanes(x, 8, y, 12, 24)

    x, y = X[8:32].reshape(6, 4), Y[12:36].reshape(6, 4)
    one, total, product = run(X, Y)
    sums, products = np.zeros(4), np.zeros(4)
    for i in range(6):
        sums, products = sums + x[i], products + x[i] * y[i]
    assert one == (x[0, 0] + x[0, 1]) + (x[0, 2] + x[0, 3])
    assert total == (sums[0] + sums[1]) + (sums[2] + sums[3])
    assert product == (products[0] + products[1]) + (products[2] + products[3])


def test_places_in_groups_of_four_lanes():
    @kernel
    def place(j):
        return in_groups(j, 100)

    assert [place(j) for j in range(9)] == [0, 1, 2, 3, 100, 101, 102, 103, 200]


def test_bodies_say_what_the_operations_mean():
    """The Python bodies, which no kernel runs, agree with what is compiled."""
    v = lanes.load(X, 20)
    out = X[:40].copy()
    lanes.store(out, 3, lanes.select(v > 0.0, v, lanes.splat(7.0)) + lanes.consecutive(5))
    lanes.store(out, 9, lanes.from_bits(lanes.to_bits(v) & np.uint64(2**64 - 2**20)))
    lanes.store(out, 13, lanes.gather(X, 50, lanes.to_bits(v) & np.uint64(7)))
    lanes.store(out, 17, lanes.sum_four(v) + lanes.lane(v, 1))

    @kernel
    def run(x, out):
        v = load(x, 20)
        store(out, 3, select(v > 0.0, v, splat(7.0)) + consecutive(5))
        store(out, 9, from_bits(to_bits(v) & (2**64 - 2**20)))
        store(out, 13, gather(x, 50, to_bits(v) & 7))
        store(out, 17, sum_four(v) + lane(v, 1))

    compiled = X[:40].copy()
    run(X, compiled)
    np.testing.assert_array_equal(compiled, out)


def test_what_lanes_cannot_do_is_refused():
    @kernel
    def strided(x):
        return sum_four(load(x, 0))

    with pytest.raises(Exception, match="contiguous"):
        strided(X[::2])

    @kernel
    def integers(x):
        return sum_four(load(x, 0) * 2)

    with pytest.raises(Exception, match="No implementation"):
        integers(X)


def test_rows_become_columns():
    @kernel
    def turn(x, out):
        a, b, c, d = transposed(load(x, 0), load(x, 4), load(x, 8), load(x, 12))
        store(out, 0, a)
        store(out, 4, b)
        store(out, 8, c)
        store(out, 12, d)

    out = np.zeros(16)
    turn(X[:16].copy(), out)
    assert np.array_equal(out, X[:16].reshape(4, 4).T.ravel(), equal_nan=True)
