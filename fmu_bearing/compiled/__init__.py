"""The engine's kernels compiled ahead of time: the one library that Python, tests, benchmarks and FMUs run.

==============  ====================================================================================
``platforms``   targets of FMI 2.0, this process, and the instruction set that its processor runs
``errors``      what can go wrong
``settings``    settings of Numba for portable code, and the versions of the lean way
``single``     kernels without what only sets need
``units``       entries with C's calling convention, in units that are compiled side by side
``lean``        Numba as a front end alone
``flat``        flat arrays in it as pointer and length
``lower``       a unit as LLVM code for no machine in particular
``optimise``    that code optimised for one instruction set, as an object file
``worker``      both, in a process of its own
``disk_cache``  files of the user's cache: whole, checked, never needed
``show``        progress: a bar on a terminal, lines in a log
``make``        objects: from the wheel, from the cache, or compiled now
``load``        entries as Python functions
==============  ====================================================================================
"""

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.load import Calls, bound, call, ready

__all__ = ["BuildError", "Calls", "bound", "call", "ready"]
