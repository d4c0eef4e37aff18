"""Four balls at a time: a type of four doubles, and sums over lanes in a fixed order.

A kernel on four lanes reads like its formula for one ball and is always compiled to vector instructions::

    for j in range(0, lanes, FOUR):
        pressed = max(load(w, approach + j), 0.0)
        store(w, elastic + j, hertz * pressed * math.sqrt(pressed))

Arithmetic, comparisons, ``abs``, ``min``, ``max`` and ``math.sqrt`` act on each lane; a number beside four
lanes counts for each of them; a comparison gives a mask for :func:`select`. Every operation is one of IEEE
754, none is contracted and sums have a fixed order: the bits equal those of the plain loop on any processor.

Each operation is one template of its types and one instruction for LLVM, not an ``overload``, which Numba
would compile again for each kernel. The bodies of the functions here say what the operations mean; compiled
kernels never run them.
"""

import math
import operator

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.cgutils import get_or_insert_function
from numba.core.datamodel import PrimitiveModel
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin, lower_cast, register_model

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import FOUR

_DOUBLE = ir.DoubleType()
_INDEX = ir.IntType(32)
_ALIGNED = 8  # bytes: rows may begin at any double


class Lanes(types.Type):
    """Four values of one kind side by side."""


four = Lanes("four doubles")
bits = Lanes("four words of 64 bits")
mask = Lanes("four truths")
_VECTORS = {
    four: ir.VectorType(_DOUBLE, FOUR),
    bits: ir.VectorType(ir.IntType(64), FOUR),
    mask: ir.VectorType(ir.IntType(1), FOUR),
}


@register_model(Lanes)
class _LanesModel(PrimitiveModel):
    """Four values as one LLVM vector, wherever they are."""

    def __init__(self, manager, kind):
        super().__init__(manager, kind, _VECTORS[kind])


# What the functions mean; what is compiled in their place follows.


def load(x, at):
    """Return the four numbers at ``x[at:]``; ``x``: a contiguous array of float64."""
    return x[at : at + FOUR].copy()


def store(x, at, value):
    """Write four numbers, or one four times, to ``x[at:]``."""
    x[at : at + FOUR] = value


def splat(value):
    """Return four times ``value``."""
    return np.full(FOUR, float(value))


def consecutive(first):
    """Return the whole number ``first`` and the three after it, as doubles."""
    return np.arange(first, first + FOUR, dtype=float)


def select(where, one, other):
    """Return ``one`` in the lanes where the mask holds, ``other`` elsewhere."""
    return np.where(where, one, other)


def sum_four(value):
    """Return the sum of the lanes: first and second, third and fourth, then both."""
    first, second, third, fourth = value
    return (first + second) + (third + fourth)


def lane(value, j):
    """Return lane ``j`` of four doubles."""
    return value[j]


def transposed(first, second, third, fourth):
    """Return lane 0 of four times four doubles, then lanes 1, 2 and 3: rows become columns."""
    return tuple(np.array([first, second, third, fourth]).T)


def to_bits(value):
    """Return the bits of four doubles, as unsigned words."""
    return value.view(np.uint64)


def from_bits(value):
    """Return the doubles of which these are the bits."""
    return value.view(np.float64)


def gather(x, at, index):
    """Return the four numbers ``x[at + index]`` of a table; ``index``: four words."""
    return x[at + index.astype(np.int64)]


def _splat(builder, kind, value):
    """Vector of four times a scalar."""
    vector = _VECTORS[kind]
    if isinstance(value, ir.Constant):
        return ir.Constant(vector, [value] * FOUR)
    nothing = ir.Constant(vector, ir.Undefined)
    single = builder.insert_element(nothing, value, ir.Constant(_INDEX, 0))
    return builder.shuffle_vector(single, nothing, ir.Constant(ir.VectorType(_INDEX, FOUR), [0] * FOUR))


@lower_cast(types.Float, four)
def _number_beside_four(context, builder, given, wanted, value):
    return _splat(builder, four, context.cast(builder, value, given, types.float64))


@lower_cast(types.Integer, bits)
def _integer_beside_bits(context, builder, given, wanted, value):
    return _splat(builder, bits, context.cast(builder, value, given, types.int64))


def _fits(given, wanted):
    """Whether an argument serves where ``wanted`` is asked for: scalars become four lanes."""
    scalar = {four: types.Float, bits: types.Integer}.get(wanted, wanted)
    return given == wanted or isinstance(scalar, type) and isinstance(given, scalar)


def _define(function, result, *wanted, beside=False):
    """Let kernels call ``function`` on ``wanted`` types; the decorated function emits its instructions.

    ``wanted`` are types, or classes of types. ``beside``: one operand at least has to be four lanes.
    """

    class Operation(AbstractTemplate):
        def generic(self, args, kws):
            if kws or len(args) != len(wanted) or beside and wanted[0] not in args:
                return None
            if not all(_fits(given, kind) for given, kind in zip(args, wanted, strict=True)):
                return None
            taken = (a if isinstance(k, type) else k for a, k in zip(args, wanted, strict=True))
            return signature(result, *taken)

    infer_global(function)(Operation)
    return lower_builtin(function, *wanted)


def _instruction(name, *first):
    """Emit one instruction of LLVM, as the builder calls it."""

    def emit(context, builder, sig, args):
        return getattr(builder, name)(*first, *args)

    return emit


def _intrinsic(name):
    """Emit one intrinsic of LLVM on four doubles."""
    kind = ir.FunctionType(_VECTORS[four], [_VECTORS[four]])

    def emit(context, builder, sig, args):
        return builder.call(get_or_insert_function(builder.module, kind, f"{name}.v{FOUR}f64"), args)

    return emit


def _operators():
    """Operators on doubles, on words and on masks."""
    for name, instruction in {"add": "fadd", "sub": "fsub", "mul": "fmul", "truediv": "fdiv"}.items():
        for one in (getattr(operator, name), getattr(operator, f"i{name}")):
            _define(one, four, four, four, beside=True)(_instruction(instruction))
    for name, sign in {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "=="}.items():
        _define(getattr(operator, name), mask, four, four, beside=True)(_instruction("fcmp_ordered", sign))
    words = {"and_": "and_", "or_": "or_", "add": "add", "lshift": "shl", "rshift": "lshr"}
    for name, instruction in words.items():
        _define(getattr(operator, name), bits, bits, bits, beside=True)(_instruction(instruction))
    for name in ("and_", "or_"):
        _define(getattr(operator, name), mask, mask, mask)(_instruction(name))
    _define(operator.neg, four, four, beside=True)(_instruction("fneg"))
    _define(math.sqrt, four, four, beside=True)(_intrinsic("llvm.sqrt"))
    _define(abs, four, four, beside=True)(_intrinsic("llvm.fabs"))
    _define(select, four, mask, four, four)(_instruction("select"))


_operators()


@_define(max, four, four, four, beside=True)
def _emit_max(context, builder, sig, args):
    return builder.select(builder.fcmp_ordered(">", *args), *args)


@_define(min, four, four, four, beside=True)
def _emit_min(context, builder, sig, args):
    return builder.select(builder.fcmp_ordered("<", *args), *args)


@_define(splat, four, four)
def _emit_splat(context, builder, sig, args):
    return args[0]


@_define(to_bits, bits, four, beside=True)
def _emit_to_bits(context, builder, sig, args):
    return builder.bitcast(args[0], _VECTORS[bits])


@_define(from_bits, four, bits, beside=True)
def _emit_from_bits(context, builder, sig, args):
    return builder.bitcast(args[0], _VECTORS[four])


@_define(consecutive, four, types.Integer)
def _emit_consecutive(context, builder, sig, args):
    first = builder.sitofp(context.cast(builder, args[0], sig.args[0], types.int64), _DOUBLE)
    numbers = ir.Constant(_VECTORS[four], [float(i) for i in range(FOUR)])
    return builder.fadd(_splat(builder, four, first), numbers)


@_define(sum_four, types.float64, four, beside=True)
def _emit_sum(context, builder, sig, args):
    nothing = ir.Constant(_VECTORS[four], ir.Undefined)
    pair = ir.VectorType(_INDEX, 2)
    odd, even = (builder.shuffle_vector(args[0], nothing, ir.Constant(pair, [i, i + 2])) for i in range(2))
    pairs = builder.fadd(odd, even)
    return builder.fadd(*(builder.extract_element(pairs, ir.Constant(_INDEX, i)) for i in range(2)))


@_define(lane, types.float64, four, types.Integer, beside=True)
def _emit_lane(context, builder, sig, args):
    return builder.extract_element(*args)


@_define(transposed, types.UniTuple(four, FOUR), four, four, four, four, beside=True)
def _emit_transposed(context, builder, sig, args):
    def mixed(one, other, *places):
        return builder.shuffle_vector(one, other, ir.Constant(ir.VectorType(_INDEX, FOUR), places))

    first, second, third, fourth = args
    even = mixed(first, second, 0, 4, 2, 6), mixed(third, fourth, 0, 4, 2, 6)
    odd = mixed(first, second, 1, 5, 3, 7), mixed(third, fourth, 1, 5, 3, 7)
    rows = [
        mixed(*even, 0, 1, 4, 5),
        mixed(*odd, 0, 1, 4, 5),
        mixed(*even, 2, 3, 6, 7),
        mixed(*odd, 2, 3, 6, 7),
    ]
    return context.make_tuple(builder, sig.return_type, rows)


def _row(array):
    """Whether lanes can be loaded from an array of this type."""
    return array.ndim == 1 and array.dtype == types.float64 and array.layout == "C"


def _place(context, builder, array, value, at, number):
    """Pointer to ``value[at]`` of an array."""
    if not _row(array):
        raise TypeError(f"lanes need contiguous arrays of float64, not {array}")
    position = context.data_model_manager[array].get_field_position("data")
    at = context.cast(builder, at, number, types.intp)
    return builder.gep(builder.extract_value(value, position), [at], inbounds=True)


@_define(load, four, types.Array, types.Integer)
def _emit_load(context, builder, sig, args):
    place = _place(context, builder, sig.args[0], *args, sig.args[1])
    return builder.load(builder.bitcast(place, _VECTORS[four].as_pointer()), align=_ALIGNED)


@_define(store, types.none, types.Array, types.Integer, four)
def _emit_store(context, builder, sig, args):
    place = _place(context, builder, sig.args[0], *args[:2], sig.args[1])
    builder.store(args[2], builder.bitcast(place, _VECTORS[four].as_pointer()), align=_ALIGNED)
    return context.get_dummy_value()


@_define(gather, four, types.Array, types.Integer, bits)
def _emit_gather(context, builder, sig, args):
    first = _place(context, builder, sig.args[0], *args[:2], sig.args[1])
    vector = ir.Constant(_VECTORS[four], ir.Undefined)
    for i in range(FOUR):
        number = ir.Constant(_INDEX, i)
        place = builder.gep(first, [builder.extract_element(args[2], number)], inbounds=True)
        vector = builder.insert_element(vector, builder.load(place), number)
    return vector


@kernel
def sum_lanes(x, at, lanes):
    """Sum of ``lanes`` numbers, a multiple of four, at ``x[at:]``."""
    total = splat(0.0)
    for j in range(at, at + lanes, FOUR):
        total += load(x, j)
    return sum_four(total)


@kernel
def dot_lanes(x, at, y, to, lanes):
    """Sum of the products of ``lanes`` numbers, a multiple of four, at ``x[at:]`` and ``y[to:]``."""
    total = splat(0.0)
    for j in range(0, lanes, FOUR):
        total += load(x, at + j) * load(y, to + j)
    return sum_four(total)


@kernel
def in_groups(j, size):
    """Place of lane ``j`` among groups of four lanes with ``size`` numbers each."""
    return (j >> 2) * size + (j & (FOUR - 1))


@kernel
def six(x, at, step):
    """Load four lanes each of six rows of ``x``, ``step`` apart."""
    return (
        load(x, at),
        load(x, at + step),
        load(x, at + 2 * step),
        load(x, at + 3 * step),
        load(x, at + 4 * step),
        load(x, at + 5 * step),
    )


@kernel
def store_six(x, at, step, values):
    """Write six times four lanes into rows ``step`` apart."""
    v0, v1, v2, v3, v4, v5 = values
    store(x, at, v0)
    store(x, at + step, v1)
    store(x, at + 2 * step, v2)
    store(x, at + 3 * step, v3)
    store(x, at + 4 * step, v4)
    store(x, at + 5 * step, v5)


@kernel
def scaled_six(x, a):
    """``x`` times six numbers."""
    a0, a1, a2, a3, a4, a5 = a
    return x * a0, x * a1, x * a2, x * a3, x * a4, x * a5


@kernel
def plus_scaled(a, x, b):
    """Six numbers plus ``x`` times another six."""
    a0, a1, a2, a3, a4, a5 = a
    b0, b1, b2, b3, b4, b5 = b
    return a0 + x * b0, a1 + x * b1, a2 + x * b2, a3 + x * b3, a4 + x * b4, a5 + x * b5


@kernel
def dot_six(a, b):
    """Sum of six products, as three pairs."""
    a0, a1, a2, a3, a4, a5 = a
    b0, b1, b2, b3, b4, b5 = b
    return (a0 * b0 + a1 * b1) + (a2 * b2 + a3 * b3) + (a4 * b4 + a5 * b5)
