"""Flat arrays in Numba as pointer and length, instead of the seven fields that go with every call.

Reaches into Numba as `lean` does, which calls it. Differs from NumPy where kernels never go: places, and
starts of slices, are neither negative nor beyond the end. Ends of slices beyond the array are clamped.
"""

import functools
import operator
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils, datamodel
from numba.extending import lower_builtin
from numba.np import arrayobj

__all__ = ["install"]

_FLAT = tuple(types.Array(types.float64, 1, "C", readonly=constant) for constant in (False, True))
_DATA, _LENGTH, _BYTES = 0, 1, 8
_NOTHING = ir.Constant(cgutils.voidptr_t, None)


def install() -> None:
    """Let arrays of `_FLAT` be pointer and length from now on."""
    arrayobj.make_array, arrayobj.populate_array = _with_shape(arrayobj.make_array), _populate
    manager = datamodel.default_manager
    manager.register(types.Array, functools.partial(_model, manager._handlers[types.Array]))
    for kind in _FLAT:
        manager._cache.pop(kind, None)
        lower_builtin(operator.getitem, kind, types.intp)(_read)
        lower_builtin(operator.getitem, kind, types.slice2_type)(_cut)
    lower_builtin(operator.setitem, _FLAT[0], types.intp, types.float64)(_write)


def _model(whole: Any, manager: Any, kind: Any) -> Any:
    """Return the fields of an array; ``whole``: Numba's own."""
    if kind not in _FLAT:
        return whole(manager, kind)
    fields = [("data", types.CPointer(kind.dtype)), ("nitems", types.intp)]
    return datamodel.models.StructModel(manager, kind, fields)


def _with_shape(make_array: Any) -> Any:
    """Numba's `make_array`, whose structure of a flat array answers for fields that are left out."""

    def make(kind: Any) -> Any:
        if kind not in _FLAT:
            return make_array(kind)
        proxy: Any = cgutils.create_struct_proxy(kind)

        class Flat(proxy):
            itemsize, meminfo, parent = cgutils.intp_t(_BYTES), _NOTHING, _NOTHING
            strides = ir.Constant(ir.ArrayType(cgutils.intp_t, 1), [itemsize])
            shape = property(lambda self: cgutils.pack_array(self._builder, [self.nitems]))

        return Flat

    return make


def _populate(
    array: Any, data: Any, shape: Any, strides: Any, itemsize: Any, meminfo: Any, parent: Any = None
) -> Any:
    """Fill an array's structure, as Numba's `populate_array`, which asks flat ones for seven fields."""
    builder = array._builder
    shape, strides = (
        cgutils.pack_array(builder, one, cgutils.intp_t) if isinstance(one, tuple | list) else one
        for one in (shape, strides)
    )
    array.data = data
    array.nitems = functools.reduce(builder.mul, cgutils.unpack_tuple(builder, shape, shape.type.count))
    if array._fe_type not in _FLAT:
        array.shape, array.strides = shape, strides
        array.itemsize = cgutils.intp_t(itemsize) if isinstance(itemsize, int) else itemsize
        array.meminfo, array.parent = meminfo or _NOTHING, parent or _NOTHING
    return array


def _address(builder: Any, array: Any, place: Any) -> Any:
    return builder.gep(builder.extract_value(array, _DATA), [place], inbounds=True)


def _read(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    """``x[i]``, where i is never negative."""
    return builder.load(_address(builder, *args))


def _write(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    """``x[i] = value``, where i is never negative."""
    builder.store(args[2], _address(builder, *args[:2]))
    return context.get_dummy_value()


def _cut(context: Any, builder: Any, signature: Any, args: Any) -> Any:
    """``x[a:]``, ``x[:b]``, ``x[a:b]``: without an end Numba gives `maxint`, clamped to the array's."""
    array, end = args[0], builder.extract_value(args[0], _LENGTH)
    start, stop = (builder.extract_value(args[1], k) for k in range(2))
    end = builder.select(builder.icmp_signed("<", stop, end), stop, end)
    made = ir.Constant(context.get_value_type(signature.return_type), ir.Undefined)
    made = builder.insert_value(made, _address(builder, array, start), _DATA)
    return builder.insert_value(made, builder.sub(end, start), _LENGTH)
