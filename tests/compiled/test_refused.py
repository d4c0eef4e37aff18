"""Kernels that raise, or return nothing at times, are refused by name: their calls have no status."""

import pytest

from fmu_bearing.compiled import make
from fmu_bearing.compiled.settings import lean
from tests.compiled import both_ways
from tests.marks import heavy_but

pytestmark = pytest.mark.skipif(
    not lean(make.version("numba")), reason="this Numba is compiled with the plain way only"
)


@pytest.mark.parametrize(
    "statement", heavy_but(["raise ValueError('negative')", "assert x > 0.0", "raise ValueError(x)"], 0)
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


def test_a_kernel_that_allocates_is_refused():
    """What a step calls can take no memory: the allocator is none of the functions that objects may call."""
    code = """
@kernel
def total(n):
    return np.zeros(n).sum()

def entry(a, b, n):
    b[0] = total(3)
    return 0
"""
    ran = both_ways.run(code, "lean")
    assert ran.returncode == 1
    assert "the kernels are not free of Python: they call NRT_MemInfo_alloc" in ran.stderr
