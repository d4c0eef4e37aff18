"""Complex numbers in flat arrays, and operations that Numba makes slow or lets raise.

A real factor would become a complex one, with four products; a division would raise where it divides by zero.
"""

import math

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin
from numba.np import arrayobj

from fmu_bearing.engine.jit import kernel

_BYTES = 16  # of a complex number


def complex_at(x, at, count):
    """``count`` complex numbers at ``x[at:]``, each its real part, then its imaginary one.

    ``x``: a contiguous array of float64. What is compiled in its place follows: Numba's ``view`` raises where
    lengths do not fit.
    """
    return x[at : at + 2 * count].view(np.complex128)


@infer_global(complex_at)
class _ComplexAt(AbstractTemplate):
    def generic(self, args, kws):
        return signature(types.Array(types.complex128, 1, "C"), args[0], types.intp, types.intp)


@lower_builtin(complex_at, types.Array, types.intp, types.intp)
def _emit_complex_at(context, builder, sig, args):
    given = arrayobj.make_array(sig.args[0])(context, builder, args[0])
    made = arrayobj.make_array(sig.return_type)(context, builder)
    arrayobj.populate_array(
        made,
        data=builder.bitcast(builder.gep(given.data, [args[1]], inbounds=True), made.data.type),
        shape=(args[2],),
        strides=(ir.Constant(args[2].type, _BYTES),),
        itemsize=ir.Constant(args[2].type, _BYTES),
        meminfo=given.meminfo,
    )
    return arrayobj.impl_ret_borrowed(context, builder, sig.return_type, made._getvalue())


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


@kernel
def root(z):
    """Square root of a complex number, its real part not negative."""
    half = math.sqrt(0.5 * (abs(z.real) + math.hypot(z.real, z.imag)))
    if half == 0.0:
        return 0j
    if z.real >= 0.0:
        return complex(half, z.imag / (2.0 * half))
    return complex(abs(z.imag) / (2.0 * half), math.copysign(half, z.imag))
