"""Portable code of units, made in turn, or one unit optimised, by a process of its own.

Called as ``python -m fmu_bearing.compiled.worker lean|plain UNIT ...`` or, with the unit's portable code on
standard input, ``python -m fmu_bearing.compiled.worker PLATFORM UNIT SET``.

Numba and LLVM hold the interpreter, so several processes work side by side, which the parent can end at once.
A process that makes portable code of several units keeps the kernels that they share. What is made goes
through standard output, so that no disk is needed: lines of JSON, each with the number of units that are done
(with fractions) or with the name and size of a file whose bytes follow.
"""

import json
import os
import sys
from collections.abc import Callable

from fmu_bearing.children import end_with_parent
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import OWN, own, platform_named
from fmu_bearing.compiled.units import object_name

__all__ = ["main"]


def _send(message: dict[str, object], data: bytes = b"") -> None:
    out = sys.stdout.buffer
    out.write(json.dumps(message).encode() + b"\n" + data)
    out.flush()


def _part(units: int) -> Callable[[float], None]:
    """Return what sends how many units are done, from the share of the next one that is."""
    return lambda share: _send({"done": units + share})


def _translate(units: list[str], lean: bool) -> None:
    """Make portable code of units and send it."""
    from fmu_bearing.compiled.lower import portable_code

    for k, unit in enumerate(units):
        code = portable_code(unit, _part(k), lean)
        _send({"file": f"{unit}.bc", "size": len(code)}, code)


def _optimise(name: str, unit: str, suffix: str) -> None:
    """Make the object of a unit for an instruction set of a platform and send it."""
    platform = own() if name == OWN else platform_named(name)
    made = object_code(sys.stdin.buffer.read(), platform, suffix, _part(0))
    _send({"file": object_name(unit, platform.name, suffix), "size": len(made)}, made)


def main() -> None:
    """Do what the command line asks for."""
    what, *names = sys.argv[1:]
    end_with_parent()
    try:
        if what in ("lean", "plain"):
            _translate(names, what == "lean")
        else:
            _optimise(what, *names)
    except BuildError as problem:
        sys.exit(str(problem))


if __name__ == "__main__":
    main()
    # all is sent; taking millions of Numba's objects apart one by one would take three seconds
    sys.stdout.flush()
    os._exit(0)
