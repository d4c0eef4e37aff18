"""Kernels that raise, or return nothing at times, are refused by name: their calls have no status."""

import pytest

from fmu_bearing.compiled import make
from fmu_bearing.compiled.settings import lean
from tests.compiled import both_ways

pytestmark = pytest.mark.skipif(
    not lean(make.version("numba")), reason="this Numba is compiled with the plain way only"
)


@pytest.mark.parametrize(
    "statement", ["raise ValueError('negative')", "assert x > 0.0", "raise ValueError(x)"]
)
def test_a_kernel_that_raises_is_refused_by_name(statement):
    code = f"""
@kernel
def root(x):
    if x < 0.0:
        {statement}
    return x

def entry(a, b, n):
    b[0] = root(a[0])
    return 0
"""
    ran = both_ways.run(code, "lean")
    assert ran.returncode == 1
    assert "kernels raise nothing: __main__.root does in line" in ran.stderr


def test_a_kernel_that_may_return_nothing_is_refused_by_name():
    code = """
@kernel
def root(x):
    if x < 0.0:
        return None
    return x

def entry(a, b, n):
    if root(a[0]) is not None:
        b[0] = 1.0
    return 0
"""
    ran = both_ways.run(code, "lean")
    assert ran.returncode == 1
    assert "kernels return one type: __main__.root may return nothing" in ran.stderr
