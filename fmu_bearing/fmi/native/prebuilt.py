"""What a wheel brings along for one platform: ``python -m fmu_bearing.fmi.native.prebuilt FOLDER PLATFORM``.

Objects for Python, bitcode for the libraries of other platforms, and the linked library of native FMUs, so
that on its own platform nothing is compiled.
"""

import sys
from pathlib import Path

from fmu_bearing.compiled import BuildError
from fmu_bearing.compiled.make import PREBUILT, bitcode, objects, sources_key
from fmu_bearing.compiled.platforms import Platform, host, platform_named
from fmu_bearing.compiled.units import UNITS, object_name
from fmu_bearing.fmi.native.link import LINKED, library, library_name

__all__ = ["WHEEL_TAGS", "fill"]

#: Tags of wheels: the oldest systems that the compilers were set to serve.
WHEEL_TAGS = {
    "linux64": "py3-none-manylinux_2_17_x86_64",
    "aarch64-linux": "py3-none-manylinux_2_17_aarch64",
    "win64": "py3-none-win_amd64",
    "darwin64": "py3-none-macosx_11_0_x86_64",
    "aarch64-darwin": "py3-none-macosx_11_0_arm64",
}


def fill(folder: Path, platform: Platform) -> None:
    """Write the files of one platform into a folder.

    Raises
    ------
    BuildError
        If the kernels cannot be compiled, or there is no compiler for the platform.
    """
    if PREBUILT.exists():
        raise BuildError(f"{PREBUILT} is there: wheels are made from a checkout, not from a wheel")
    folder.mkdir(parents=True, exist_ok=True)
    sets = [suffix for suffix, _ in platform.instruction_sets]
    for (unit, one), data in objects(platform, UNITS, sets).items():
        (folder / object_name(unit, platform.name, one)).write_bytes(data)
    for unit in LINKED:  # the other units serve Python, which runs on this platform alone
        (folder / f"{unit}.bc").write_bytes(bitcode(unit))
    (folder / library_name(platform)).write_bytes(library(platform, "portable", print))
    (folder / "key").write_text(f"{sources_key()}\n", encoding="ascii")
    (folder / "tag").write_text(f"{WHEEL_TAGS[platform.name]}\n", encoding="ascii")
    ran = "the tests ran these kernels" if platform == host() else "these kernels were never run"
    (folder / "about.txt").write_text(
        f"Kernels of fmu-bearing for {platform.name}, compiled on {_words()}: {ran}.\n", encoding="utf-8"
    )


def _words() -> str:
    own = host()
    return own.name if own else sys.platform


def main() -> None:
    """Fill the folder named on the command line."""
    folder, name = sys.argv[1:]
    try:
        fill(Path(folder), platform_named(name))
    except BuildError as problem:
        sys.exit(f"error: {problem}")


if __name__ == "__main__":
    main()
