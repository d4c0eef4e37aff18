"""From kernels to LLVM code for no machine in particular, in a process whose Numba does nothing else.

What Numba generates depends on settings that it reads when it is loaded. With its optimisation off and no
processor named, the code is the same wherever it is made; `optimise` turns it into each target's.
"""

import contextlib
import gc
import os
import re
import warnings
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

from fmu_bearing.compiled.settings import SETTINGS
from fmu_bearing.compiled.units import ENTRIES, functions, symbol

__all__ = ["portable_code"]


def portable_code(unit: str, tell: Callable[[float], None], lean: bool) -> bytes:
    """LLVM bitcode of a unit's entries in one module; what they share is in it once.

    Parameters
    ----------
    unit : str
    tell : callable
        Takes the part (0 to 1) of the kernels that are through.
    lean : bool
        Whether to use `lean`; the plain way optimises each kernel and makes it executable on the way.

    Raises
    ------
    RuntimeError
        If Numba was loaded with other settings than `settings.SETTINGS`.
    """
    if any(os.environ.get(key) != value for key, value in SETTINGS.items()):
        raise RuntimeError("portable code needs Numba loaded under the settings of this module")
    gc.disable()  # millions of small objects stay: looking through them often is vain
    import llvmlite.binding as llvm

    if lean:
        from fmu_bearing.compiled import lean as front

        front.install()
    made = functions(unit)
    with _counted(list(made.values()), tell):
        compiled = {name: _c_function(name, function) for name, function in made.items()}
    if lean:
        parts = front.modules(compiled.values())
    else:
        parts = [llvm.parse_assembly(_uncounted(one.inspect_llvm())) for one in compiled.values()]
    names = {one.native_name: symbol(name) for name, one in compiled.items()}
    for part in parts:
        # Of the machine that generated it: `optimise` sets each target's. Read with it, as the layout gives
        # loads and stores their alignment, which is the same on all platforms.
        part.triple = part.data_layout = ""
        for function in part.functions:
            if function.name in names:
                function.name = names[function.name]
    whole = _linked(parts)
    whole.verify()
    return whole.as_bitcode()


def _linked(parts: list[Any]) -> Any:
    """Link modules in pairs, then what they gave in pairs: one by one costs the square of their number."""
    while len(parts) > 1:
        for part, other in zip(parts[::2], parts[1::2], strict=False):
            part.link_in(other)
        parts = parts[::2]
    return parts[0]


def _uncounted(code: str) -> str:
    """Let counting of references do nothing: kernels do not allocate, and LLVM cannot drop all of it.

    A kernel that returns a part of an array, called in a loop, hands on a count that is in memory.
    """
    counting = r"(?ms)^(define [^\n]*@NRT_(?:incref|decref)\([^\n]*\{\n).*?^\}"
    return re.sub(counting, r"\1  ret void\n}", code)


def _c_function(name: str, function: Callable[..., Any]) -> Any:
    """Compile an entry for pointers."""
    import numba
    from numba import types

    from fmu_bearing.engine.jit import FLAGS

    entry = ENTRIES[name]
    pointers = [types.CPointer(types.float64)] * len(entry.arrays)
    arguments = [*pointers, types.CPointer(types.int64), *[types.float64] * entry.scalars]
    flags: dict[str, Any] = dict(FLAGS)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", numba.core.errors.NumbaWarning)
        return numba.cfunc(types.int32(*arguments), **flags)(function)


@contextlib.contextmanager
def _counted(entries: list[Any], tell: Callable[[float], None]) -> Iterator[None]:
    """Report the part of the kernels reached by ``entries`` whose compilation has ended."""
    from numba.core import event

    total = len(_reached(entries)) or 1
    through = set()

    class Listener(event.Listener):
        def on_start(self, found: Any) -> None:
            pass

        def on_end(self, found: Any) -> None:
            dispatcher = found.data["dispatcher"]
            if dispatcher.py_func not in through:
                through.add(dispatcher.py_func)
                tell(min(1.0, len(through) / total))

    with event.install_listener("numba:compile", Listener()):
        yield


def _reached(entries: list[Any]) -> set[Any]:
    """Python functions of all kernels that functions reach through globals, modules' names and closures."""
    kernels: set[Any] = set()
    due = list(entries)
    while due:
        function = due.pop()
        names = function.__code__.co_names
        values = [function.__globals__.get(name) for name in names]
        values += [vars(one).get(name) for one in values if isinstance(one, ModuleType) for name in names]
        values += [cell.cell_contents for cell in function.__closure__ or ()]
        for value in values:
            kernel = getattr(value, "py_func", None)
            if kernel is not None and kernel not in kernels:
                kernels.add(kernel)
                due.append(kernel)
    return kernels
