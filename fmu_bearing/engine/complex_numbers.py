"""Complex numbers in flat arrays, and operations that Numba makes slow or lets raise.

A real factor would become a complex one, with four products; a division would raise where it divides by zero.
"""

import numpy as np

from fmu_bearing.engine.jit import kernel


@kernel
def complex_at(x, at, count):
    """``count`` complex numbers at ``x[at:]``, each its real part, then its imaginary one."""
    return x[at : at + 2 * count].view(np.complex128)


@kernel
def pair(x, at):
    """Complex number at ``x[at:]``."""
    return complex(x[at], x[at + 1])


@kernel
def square(z):
    """Square of the size of a complex number."""
    return z.real * z.real + z.imag * z.imag


@kernel
def real_times(factor, z):
    """Real ``factor`` times a complex number."""
    return complex(factor * z.real, factor * z.imag)


@kernel
def over(a, b):
    """Complex a / b; no number where b is zero."""
    return real_times(1.0 / square(b), a * b.conjugate())
