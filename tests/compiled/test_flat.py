"""What kernels do with arrays has NumPy's answer, compiled the lean way and the plain way."""

import numpy as np
import pytest

from fmu_bearing.compiled import make
from fmu_bearing.compiled.settings import lean
from tests.compiled import both_ways

pytestmark = pytest.mark.skipif(
    not lean(make.version("numba")), reason="this Numba is compiled with the plain way only"
)

_CODE = """
CONSTANTS = np.arange(1.0, 6.0)

@kernel
def total(x):
    result = 0.0
    for i in range(len(x)):
        result += x[i] * (i + 1)
    return result

@kernel
def measure(x, b, at):
    b[at] = x.size
    b[at + 1] = len(x)
    b[at + 2] = total(x)

@kernel
def cut(x, first, last):
    return x[first:last]

@kernel
def fill(x, k):
    x[k] = 1
    x[k + 1] += 2.5

@kernel
def entry_of_arrays(a, table, b):
    measure(a[20:], b, 0)
    measure(cut(a, 3, 7), b, 3)
    measure(cut(a, 22, 1000), b, 6)
    measure(a[:4][2:], b, 9)
    measure(table[3], b, 12)
    measure(table[1][2:9], b, 15)
    b[18] = table[2, 4] + len(table)
    b[19] = table.shape[1]
    measure(CONSTANTS[1:4], b, 20)
    fill(b[23:], 0)

def entry(a, b, n):
    entry_of_arrays(carray(a, (n[0],)), carray(a, (5, n[0] // 5)), carray(b, (n[1],)))
    return 0
"""


@pytest.mark.heavy
def test_slices_rows_and_lengths_are_numpys():
    a = np.random.default_rng(7).standard_normal(25)
    table, constants = a.reshape(5, 5), np.arange(1.0, 6.0)
    parts = [a[20:], a[3:7], a[22:1000], a[:4][2:], table[3], table[1][2:9]]
    measured = [[x.size, len(x), (x * np.arange(1, x.size + 1)).sum()] for x in parts]
    x = constants[1:4]
    expected = np.array(
        [
            *np.ravel(measured), table[2, 4] + 5.0, 5.0,
            x.size, len(x), (x * np.arange(1, x.size + 1)).sum(), 1.0, 2.5,
        ]
    )  # fmt: skip
    found = {}
    for way in ("lean", "plain"):
        ran = both_ways.run(_CODE, way)
        assert ran.returncode == 0, ran.stderr
        found[way] = np.frombuffer(bytes.fromhex(ran.stdout.strip()))
    np.testing.assert_allclose(found["lean"], expected, rtol=1e-14, atol=1e-14)  # sums of 5 numbers
    assert found["lean"].tobytes() == found["plain"].tobytes()
