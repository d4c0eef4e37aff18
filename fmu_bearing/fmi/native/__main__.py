"""Make libraries before any FMU: ``python -m fmu_bearing.fmi.native [PLATFORM ...]``."""

import sys
import time

from fmu_bearing.fmi.native.link import library
from fmu_bearing.fmi.native.optimise import BuildError
from fmu_bearing.fmi.native.platforms import PLATFORMS, host


def main() -> None:
    """Build each platform named, in turn; without a name, this machine's."""
    own = host()
    names = sys.argv[1:] or ([own.name] if own else [])
    for name in names:
        begin = time.perf_counter()
        try:
            if name not in PLATFORMS:
                raise BuildError(f"there is no platform '{name}': choose from {', '.join(PLATFORMS)}")
            path = library(PLATFORMS[name], tell=print)
        except BuildError as problem:
            sys.exit(f"error: {problem}")
        print(f"{name}: {path}, after {time.perf_counter() - begin:.1f} s")


if __name__ == "__main__":
    main()
