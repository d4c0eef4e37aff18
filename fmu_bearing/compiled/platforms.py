"""The machines a library can be built for."""

import os
import platform as machine
import sys
from dataclasses import dataclass, field, replace

from fmu_bearing.compiled.errors import BuildError

__all__ = [
    "OWN",
    "PLATFORMS",
    "Platform",
    "host",
    "instruction_set",
    "narrowed",
    "own",
    "platform_named",
]

# Levels of the x86-64 psABI: v2 (2009) is the least asked for, v3 (2015, AVX2) is used where it is there.
_X86 = (("v2", "x86-64-v2"), ("v3", "x86-64-v3"))


@dataclass(frozen=True)
class Platform:
    """A system and processor.

    Attributes
    ----------
    name : str
        Folder under ``binaries`` in the FMU.
    triple : str
        LLVM's name.
    zig : str
        Zig's name; the C library's version is the oldest one asked for.
    suffix : str
        Of shared libraries.
    instruction_sets : tuple of (str, str)
        Suffix of the symbols, and LLVM's name of a processor that has just these instructions.
    """

    name: str
    triple: str
    zig: str
    suffix: str
    instruction_sets: tuple[tuple[str, str], ...] = field(default=_X86, compare=False)


PLATFORMS = {
    one.name: one
    for one in (
        Platform("linux64", "x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17", ".so"),
        Platform("win64", "x86_64-w64-windows-gnu", "x86_64-windows-gnu", ".dll"),
        Platform("darwin64", "x86_64-apple-macosx11.0.0", "x86_64-macos.11.0", ".dylib"),
        Platform(
            "aarch64-linux", "aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17", ".so",
            (("base", "generic"),),
        ),
        Platform(
            "aarch64-darwin", "arm64-apple-macosx11.0.0", "aarch64-macos.11.0", ".dylib",
            (("base", "apple-m1"),),
        ),
    )
}  # fmt: skip


#: Name of a machine that is none of these: it compiles for itself alone.
OWN = "own"


def platform_named(name: str) -> Platform:
    """Return a platform of FMUs by its name.

    Raises
    ------
    BuildError
        For an unknown name, with the known ones.
    """
    if name not in PLATFORMS:
        raise BuildError(f"there is no platform '{name}': choose from {', '.join(PLATFORMS)}")
    return PLATFORMS[name]


def host() -> Platform | None:
    """Return the platform of this process; ``None`` where no library can be built for it."""
    arm = machine.machine().lower() in ("arm64", "aarch64")
    if not arm and machine.machine().lower() not in ("x86_64", "amd64"):
        return None
    systems = {"linux": ("linux64", "aarch64-linux"), "darwin": ("darwin64", "aarch64-darwin")}
    names = systems.get(sys.platform, ("win64", None))
    name = names[arm]
    return PLATFORMS[name] if name else None


def own() -> Platform:
    """Return what this process needs kernels for, on machines without an FMU platform too."""
    import llvmlite.binding as llvm

    return host() or Platform(OWN, llvm.get_process_triple(), "", "", (("base", ""),))


def instruction_set(platform: Platform) -> str:
    """Return the instruction set of a platform that this processor runs; ``FMU_BEARING_ISA=v2`` takes v2.

    The same rule as in the shim (``kernels.c``).
    """
    sets = [suffix for suffix, _ in platform.instruction_sets]
    if "v3" not in sets:
        return sets[0]
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features()
    needed = ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
    fits = all(features.get(one, False) for one in needed)
    return "v3" if fits and os.environ.get("FMU_BEARING_ISA") != "v2" else "v2"


def narrowed(platform: Platform) -> Platform:
    """Return this machine's platform with the newest instruction set alone, where the processor runs it."""
    found = instruction_set(platform)
    newest = platform.instruction_sets[-1]
    return replace(platform, instruction_sets=(newest,)) if found == newest[0] else platform
