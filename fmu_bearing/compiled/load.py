"""Compiled entries as Python functions: an object file in memory, its addresses, calls through ctypes.

LLVM links the object; no C compiler is needed. A call releases the interpreter. Around the kernel it takes
0.6 us where the arrays' addresses are known (:class:`Calls`), and 9 us where they are looked up
(:func:`call`): the thread's own time of a step that is refused at once, best of nine series, Python 3.11, on
an AMD EPYC that had other work.
"""

import ctypes
import threading
from collections.abc import Callable
from typing import Any

import llvmlite.binding as llvm
import numpy as np
from numpy.typing import NDArray

from fmu_bearing.compiled.make import kept, objects
from fmu_bearing.compiled.platforms import instruction_set, own
from fmu_bearing.compiled.units import ENTRIES, SINGLE, symbol
from fmu_bearing.engine.layout import P

__all__ = ["Calls", "bound", "call", "ready"]

_lock = threading.RLock()
_engines: dict[str, Any] = {}  # by unit; kept, because functions point into them
_functions: dict[tuple[str, str], Any] = {}  # by unit and entry


def ready(*units: str) -> None:
    """Load units, and compile them before if need be."""
    with _lock:
        missing = [unit for unit in units if unit not in _engines]
        if not missing:
            return
        platform = own()
        suffix = instruction_set(platform)
        made = objects(platform, missing, [suffix])
        for unit in missing:
            _engines[unit] = _linked(made[unit, suffix])
            for name, entry in ENTRIES.items():
                if unit in (entry.unit, SINGLE.get(entry.unit)):
                    address = _engines[unit].get_function_address(symbol(name, suffix))
                    pointers = [ctypes.c_void_p] * (len(entry.arrays) + 1)
                    scalars = [ctypes.c_double] * entry.scalars
                    _functions[unit, name] = ctypes.CFUNCTYPE(ctypes.c_int32, *pointers, *scalars)(address)


def _linked(data: bytes) -> Any:
    """Return the execution engine of an object file."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    engine = llvm.create_mcjit_compiler(
        llvm.parse_assembly(""), llvm.Target.from_default_triple().create_target_machine()
    )
    engine.add_object_file(llvm.ObjectFileRef.from_data(data))
    engine.finalize_object()
    return engine


def _function(name: str, p: NDArray[np.float64]) -> Any:
    """Return an entry for the parameters ``p``.

    For a single bearing its own units are compiled, unless those that serve every scene are there.
    """
    unit = ENTRIES[name].unit
    units = tuple(SINGLE) if unit in SINGLE else (unit,)
    if unit in SINGLE and unit not in _engines and p[P.ALONE] != 0.0:
        platform = own()
        if SINGLE[unit] in _engines or not kept(platform, units, instruction_set(platform)):
            unit, units = SINGLE[unit], tuple(SINGLE.values())
    ready(*units)
    return _functions[unit, name]


def _address(array: NDArray[np.float64]) -> int:
    """Address of an array's numbers; it must be float64 without gaps."""
    if array.dtype != np.float64 or not array.flags.c_contiguous:
        raise TypeError(f"the engine takes float64 arrays without gaps, not {array.dtype} {array.strides}")
    return array.ctypes.data


def call(name: str, *arguments: Any) -> int:
    """Call an entry once; the addresses of its arrays are looked up again.

    Parameters
    ----------
    name : str
        Of an entry in `units.ENTRIES`, whose unit is compiled and loaded if need be.
    arguments : ndarray, then float
        The entry's arrays in its order (float64 without gaps, of any shape; an entry takes the length from
        each), then its numbers.

    Returns
    -------
    int
        Status (`engine.status`).

    Raises
    ------
    TypeError
        For an array of another kind.
    ValueError
        For too few arrays.
    BuildError
        If the unit cannot be compiled.
    """
    count = len(ENTRIES[name].arrays)
    return bound(name, *arguments[:count])(*arguments[count:])


def bound(name: str, *arrays: NDArray[np.float64]) -> Callable[..., int]:
    """Return `call` of an entry with arrays that stay where they are; it takes the numbers behind them."""
    entry, function = ENTRIES[name], _function(name, arrays[0])
    lengths = np.zeros(max(entry.places()) + 1, dtype=np.int64)
    for place, array in zip(entry.places(), arrays, strict=True):
        lengths[place] = array.size
    addresses = [*map(_address, arrays), lengths.ctypes.data]

    def again(*scalars: float, _alive: object = (arrays, lengths)) -> int:
        return int(function(*addresses, *scalars))

    return again


class Calls:
    """``init``, ``step`` and ``outputs`` of one bearing, whose arrays stay where they are.

    Addresses and lengths are taken once, when the object is made; it keeps the arrays alive. Values are read
    and written in place at each call. Two threads must not call with the same arrays at once.

    Parameters
    ----------
    p, u, s, z, w : ndarray
        Parameters, inputs, state, outputs, work space (`engine.layout`); float64 without gaps.

    Raises
    ------
    TypeError
        For an array of another kind.
    BuildError
        If the kernels cannot be compiled.
    """

    def __init__(
        self,
        p: NDArray[np.float64],
        u: NDArray[np.float64],
        s: NDArray[np.float64],
        z: NDArray[np.float64],
        w: NDArray[np.float64],
    ) -> None:
        self._arrays = (p, u, s, z, w)  # the addresses point into these
        self._lengths = np.array([one.size for one in self._arrays], dtype=np.int64)
        at_p, at_u, at_s, at_z, at_w = map(_address, self._arrays)
        n = self._lengths.ctypes.data
        self._all, self._read = (at_p, at_u, at_s, at_z, at_w, n), (at_p, at_s, at_z, n)
        self._init, self._step, self._outputs = (_function(name, p) for name in ("init", "step", "outputs"))

    def init(self, time: float) -> int:
        """Put the state to the quasi-static one at ``time`` (s) and fill the outputs; return the status."""
        return self._init(*self._all, time)

    def step(self, h: float) -> int:
        """Advance the state by ``h`` (s) and fill the outputs; return the status."""
        return self._step(*self._all, h)

    def copier(self, source: NDArray[np.float64], target: NDArray[np.float64]) -> Callable[[], int]:
        """Return what copies what later steps need of one state to another array of its size."""
        addresses = (self._all[0], _address(source), _address(target), self._lengths.ctypes.data)
        function = _function("copy", self._arrays[0])

        def again(_alive: object = (self, source, target)) -> int:
            return int(function(*addresses))

        return again

    def outputs(self) -> int:
        """Fill the outputs from the state; return the status."""
        return self._outputs(*self._read)
