"""Logarithm and exponential to base 2 of four balls, without a branch or a table.

Coefficients are multiplied, not divided by: a division takes five times as long.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import from_bits, select, to_bits

# 1.5 * 2^52: adding it to a number below 2^51 rounds to an integer, whose low bits are then the sum's.
ROUND = 6755399441055744.0
_LN2 = 0.6931471805599453
_TWO_OVER_LN2 = 2.8853900817779268
_ROOT_TWO = 1.4142135623730951
_MANTISSA = 0x000FFFFFFFFFFFFF
_ONE = 0x3FF0000000000000  # bits of 1.0
_TWO_52 = 0x4330000000000000  # bits of 2^52


@kernel
def log2(x):
    """Logarithm to base 2 of positive normal numbers: exponent bits and an atanh series (1e-15)."""
    bits = to_bits(x)
    exponent = from_bits((bits >> 52) | _TWO_52) - (4503599627370496.0 + 1023.0)
    mantissa = from_bits((bits & _MANTISSA) | _ONE)
    upper = mantissa > _ROOT_TWO
    m = select(upper, 0.5 * mantissa, mantissa)
    e = select(upper, exponent + 1.0, exponent)
    t = (m - 1.0) / (m + 1.0)  # at most 0.172: the next term of the series is 4e-18
    t2 = t * t
    t4 = t2 * t2
    low = (1.0 + t2 * (1.0 / 3.0)) + t4 * (1.0 / 5.0 + t2 * (1.0 / 7.0))
    high = (1.0 / 9.0 + t2 * (1.0 / 11.0)) + t4 * (1.0 / 13.0 + t2 * (1.0 / 15.0) + t4 * (1.0 / 17.0))
    return e + _TWO_OVER_LN2 * t * (low + t4 * t4 * high)


@kernel
def exp2(x):
    """2 to the powers ``x``, |x| below 1000: Taylor series on [-1/2, 1/2] and exponent bits (2e-16)."""
    shifted = x + ROUND
    t = (x - (shifted - ROUND)) * _LN2
    t2 = t * t
    t4 = t2 * t2
    a = (1.0 + t) + t2 * (1.0 / 2.0 + t * (1.0 / 6.0))
    b = (1.0 / 24.0 + t * (1.0 / 120.0)) + t2 * (1.0 / 720.0 + t * (1.0 / 5040.0))
    c = (1.0 / 40320.0 + t * (1.0 / 362880.0)) + t2 * (
        1.0 / 3628800.0 + t * (1.0 / 39916800.0) + t2 * (1.0 / 479001600.0)
    )
    scale = from_bits((to_bits(shifted) << 52) + _ONE)
    return (a + t4 * (b + t4 * c)) * scale
