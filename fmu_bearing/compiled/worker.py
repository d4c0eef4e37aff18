"""Units, compiled in turn by a process of its own.

Called as ``python -m fmu_bearing.compiled.worker lean|plain PLATFORM UNIT=SET,...=SIZE ...``.

Numba and LLVM hold the interpreter, so units are compiled side by side by several processes, which the parent
can end at once. A process that compiles two units keeps the kernels that both use. What is made goes through
standard output, so that no disk is needed: lines of JSON, each with the part of the work that is done or with
the name and size of a file whose bytes follow. Where a unit's bitcode is there already, it comes through
standard input, SIZE bytes of it.
"""

import functools
import json
import os
import sys
from collections.abc import Callable

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import OWN, Platform, own, platform_named
from fmu_bearing.compiled.units import object_name

__all__ = ["main"]

#: Part of the processor's time that goes into portable code, made the lean way, where one object is made from
#: it. Measured on x86-64-v3: 0.53 for the unit step (28.3 s of 53.3 s), 0.71 for init (21.3 s of 30.2 s) and
#: 0.23 for study (3.1 s of 13.2 s), most of whose kernels have come with init.
_PORTABLE = 0.55


def _send(message: dict[str, object], data: bytes = b"") -> None:
    out = sys.stdout.buffer
    out.write(json.dumps(message).encode() + b"\n" + data)
    out.flush()


def _tell(job: int, jobs: int, share: float) -> None:
    """Send that a share of one of several jobs is done."""
    _send({"done": (job + share) / jobs})


def _between(part: Callable[[float], None], begin: float, k: int, count: int) -> Callable[[float], None]:
    """Return a callable that reports ``part`` of the ``k``-th of ``count`` equal pieces behind ``begin``."""
    return lambda share: part(begin + (1.0 - begin) * (k + share) / count)


def _compile(
    unit: str, code: bytes, sets: list[str], platform: Platform, lean: bool, part: Callable[[float], None]
) -> None:
    """Compile one unit and send its bitcode, unless ``code`` is that, and its objects."""
    begin = 0.0
    if not code:
        from fmu_bearing.compiled.lower import portable_code

        begin = _PORTABLE if sets else 1.0
        code = portable_code(unit, lambda share: part(begin * share), lean)
        _send({"file": f"{unit}.bc", "size": len(code)}, code)
    for k, one in enumerate(sets):
        made = object_code(code, platform, one, _between(part, begin, k, len(sets)))
        _send({"file": object_name(unit, platform.name, one), "size": len(made)}, made)


def main() -> None:
    """Compile units for instruction sets of a platform."""
    way, name, *jobs = sys.argv[1:]
    try:
        platform = own() if name == OWN else platform_named(name)
        for k, job in enumerate(jobs):
            unit, sets, size = job.split("=")
            code = sys.stdin.buffer.read(int(size))
            part = functools.partial(_tell, k, len(jobs))
            _compile(unit, code, sets.split(",") if sets else [], platform, way == "lean", part)
    except BuildError as problem:
        sys.exit(str(problem))
    _send({"done": 1.0})


if __name__ == "__main__":
    main()
    # all is sent; taking millions of Numba's objects apart one by one would take three seconds
    sys.stdout.flush()
    os._exit(0)
