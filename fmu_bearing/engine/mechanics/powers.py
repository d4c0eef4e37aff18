"""Logarithm and exponential to base 2 without a branch or a table: the C library's keep loops scalar."""

import numpy as np

from fmu_bearing.engine.jit import inlined

# 1.5 * 2^52: adding it to a number below 2^51 rounds to an integer, whose low bits then stand in the sum's.
ROUND = 6755399441055744.0
_LN2 = 0.6931471805599453
_TWO_OVER_LN2 = 2.8853900817779268
_ROOT_TWO = 1.4142135623730951
_MANTISSA = 0x000FFFFFFFFFFFFF
_ONE = 0x3FF0000000000000  # bits of 1.0
_TWO_52 = 0x4330000000000000  # bits of 2^52


@inlined
def log2(x):
    """Logarithm to base 2 of a positive normal number: exponent bits and an atanh series (1e-15)."""
    bits = np.float64(x).view(np.int64)
    exponent = np.int64((bits >> 52) | _TWO_52).view(np.float64) - (4503599627370496.0 + 1023.0)
    mantissa = np.int64((bits & _MANTISSA) | _ONE).view(np.float64)
    upper = mantissa > _ROOT_TWO
    m = 0.5 * mantissa if upper else mantissa
    e = exponent + 1.0 if upper else exponent
    t = (m - 1.0) / (m + 1.0)  # at most 0.172: the next term of the series is 4e-18
    t2 = t * t
    t4 = t2 * t2
    low = (1.0 + t2 / 3.0) + t4 * (1.0 / 5.0 + t2 / 7.0)
    high = (1.0 / 9.0 + t2 / 11.0) + t4 * (1.0 / 13.0 + t2 / 15.0 + t4 / 17.0)
    return e + _TWO_OVER_LN2 * t * (low + t4 * t4 * high)


@inlined
def exp2(x):
    """2 to the power ``x``, |x| below 1000: Taylor series on [-1/2, 1/2] and exponent bits (2e-16)."""
    shifted = x + ROUND
    t = (x - (shifted - ROUND)) * _LN2
    t2 = t * t
    t4 = t2 * t2
    a = (1.0 + t) + t2 * (1.0 / 2 + t / 6)
    b = (1.0 / 24 + t / 120) + t2 * (1.0 / 720 + t / 5040)
    c = (1.0 / 40320 + t / 362880) + t2 * (1.0 / 3628800 + t / 39916800 + t2 / 479001600)
    scale = np.int64((np.float64(shifted).view(np.int64) << 52) + _ONE).view(np.float64)
    return (a + t4 * (b + t4 * c)) * scale
