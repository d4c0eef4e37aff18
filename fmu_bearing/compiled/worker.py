"""One unit, compiled by a process of its own.

Called as ``python -m fmu_bearing.compiled.worker UNIT lean|plain PLATFORM SET ...``.

Numba and LLVM hold the interpreter, so units are compiled side by side by several processes, which the parent
can end at once. What is made goes through standard output, so that no disk is needed: lines of JSON, each
with the part of the work that is done or with the name and size of a file whose bytes follow. Where the
bitcode is there already, it comes through standard input.
"""

import json
import sys
from collections.abc import Callable

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import OWN, own, platform_named
from fmu_bearing.compiled.units import object_name

__all__ = ["main"]

#: Part of the processor's time that goes into portable code, made the lean way, where one object is made from
#: it. Measured on x86-64-v3: 0.67 for the unit init (21.5 s of 32.2 s), 0.63 for step (34.0 s of 53.7 s),
#: 0.60 for study (12.5 s of 20.8 s).
_PORTABLE = 0.65


def _send(message: dict[str, object], data: bytes = b"") -> None:
    out = sys.stdout.buffer
    out.write(json.dumps(message).encode() + b"\n" + data)
    out.flush()


def _part(begin: float, end: float) -> Callable[[float], None]:
    return lambda share: _send({"done": begin + (end - begin) * share})


def main() -> None:
    """Compile one unit for instruction sets of a platform."""
    unit, lean, name, *sets = sys.argv[1:]
    given = sys.stdin.buffer.read()
    begin = 0.0
    try:
        platform = own() if name == OWN else platform_named(name)
        if not given:
            from fmu_bearing.compiled.lower import portable_code

            begin = _PORTABLE if sets else 1.0
            given = portable_code(unit, _part(0.0, begin), lean == "lean")
            _send({"file": f"{unit}.bc", "size": len(given)}, given)
        for k, one in enumerate(sets):
            share = (1.0 - begin) / len(sets)
            made = object_code(given, platform, one, _part(begin + k * share, begin + (k + 1) * share))
            _send({"file": object_name(unit, platform.name, one), "size": len(made)}, made)
    except BuildError as problem:
        sys.exit(str(problem))
    _send({"done": 1.0})


if __name__ == "__main__":
    main()
