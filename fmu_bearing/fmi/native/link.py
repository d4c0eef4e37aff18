"""Shared libraries: the objects of the kernels and the C shim, linked for a platform and kept by hash.

For the machine that builds, its own C compiler is enough; for the others, and for a library that runs on
old Linux systems too, Zig's compiler (extra ``cross``).
"""

import hashlib
import importlib.util
import os
import shutil
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

from fmu_bearing import children
from fmu_bearing.compiled import BuildError, disk_cache
from fmu_bearing.compiled.make import folder, objects, prebuilt
from fmu_bearing.compiled.platforms import Platform, host
from fmu_bearing.compiled.units import SINGLE
from fmu_bearing.engine.layout import P
from fmu_bearing.engine.sources import digest, engine_digest
from fmu_bearing.extras import install_command
from fmu_bearing.files import no_room, own_folder
from fmu_bearing.progress import Tell, silent, work

__all__ = [
    "LINKED",
    "Compiler",
    "compiler_for",
    "headers",
    "kernels_of",
    "library",
    "library_name",
    "shim_sources",
]

#: Units of the kernels that an FMU needs.
LINKED = ("init", "step")
#: Strict C; contraction of a * b + c would change bits between processors.
FLAGS = ("-std=c99", "-O2", "-Wall", "-Wextra", "-ffp-contract=off", "-fvisibility=hidden")


#: Some hosts close the library between two instances and call what they opened before.
_KEPT = ("-Wl,-z,nodelete",)


@dataclass(frozen=True)
class Compiler:
    """A C compiler for one platform.

    Attributes
    ----------
    command : tuple of str
        Its call, without files.
    name : str
        Name and version, for messages and for the hash of the libraries it makes.
    """

    command: tuple[str, ...]
    name: str


def headers() -> Path:
    """Folder of the FMI 2.0 headers, which FMPy brings along."""
    spec = importlib.util.find_spec("fmpy")
    if spec is None or spec.origin is None:
        raise BuildError("FMPy, which holds the FMI headers, is not installed: pip install fmpy")
    return Path(spec.origin).parent / "c-code"


def shim_sources() -> list[Path]:
    """C files of the shim, in name order."""
    return sorted((Path(__file__).parent / "shim").glob("*.c"))


def compiler_for(platform: Platform, prefer: str = "auto") -> Compiler:
    """Compiler that can make a library for a platform.

    Parameters
    ----------
    platform : Platform
    prefer : str
        ``cc``, ``zig``, ``auto``: the machine's own compiler for its own platform, Zig for the others and
        where there is none; or ``portable``: Zig wherever it is installed, as the machine's own compiler
        asks for a C library as new as the machine's.

    Raises
    ------
    BuildError
        If there is none; the message names what to install.
    """
    own = platform == host()
    has_zig = importlib.util.find_spec("ziglang") is not None
    if own and (prefer in ("auto", "cc") or (prefer == "portable" and not has_zig)):
        command = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
        if command:
            return Compiler((command, *_own_flags()), _version(command))
    if prefer != "cc" and has_zig:
        zig = children.python("ziglang", "cc", "-target", platform.zig, "-s")
        return Compiler((*zig, *_zig_flags(platform)), f"zig {version('ziglang')}")
    if own:
        raise BuildError(
            f"{platform.name}: there is no C compiler; install one (Debian: gcc), or "
            + install_command("ziglang")
        )
    raise BuildError(
        f"{platform.name}: another platform than this machine's needs the package ziglang: "
        + install_command("ziglang")
    )


def _own_flags() -> tuple[str, ...]:
    if sys.platform.startswith("linux"):
        return ("-fPIC", "-s", "-Wl,--build-id=none", "-Wl,--no-undefined", "-Wl,-z,noexecstack", *_KEPT)
    return ()


def _zig_flags(platform: Platform) -> tuple[str, ...]:
    if platform.suffix == ".dylib":  # it would be named after the file, which lies in a folder of the moment
        return ("-Wl,-install_name,@rpath/bearing.dylib",)
    return _KEPT if platform.suffix == ".so" else ()


def _version(command: str) -> str:
    ran = children.run([command, "--version"], capture_output=True, text=True)
    return ran.stdout.splitlines()[0] if ran.returncode == 0 and ran.stdout else command


def library(platform: Platform, prefer: str = "auto", tell: Tell = silent, units: str = "all") -> bytes:
    """Shared library for a platform: from the wheel, from the cache, or made now.

    Where there is no compiler now, a cached library from another compiler is used.

    Parameters
    ----------
    platform : Platform
        With the instruction sets that the library holds (`platforms.narrowed`).
    prefer : str
        See `compiler_for`.
    tell : callable, optional
    units : str
        ``all``: serves every scene; ``single``: single bearings alone.

    Raises
    ------
    BuildError
        If it is not there and cannot be made.
    CacheError
        If others can write to the folder that libraries are kept in.
    """
    if prefer in ("auto", "portable") and (brought := prebuilt(library_name(platform))) is not None:
        return brought
    sets = "-".join(suffix for suffix, _ in platform.instruction_sets)
    made = own_folder(folder() / f"{platform.name}-{sets}-{units}")
    try:
        compiler = compiler_for(platform, prefer)
    except BuildError:
        libraries = (
            disk_cache.read(path, tell) for path in sorted(made.glob(f"{_shim_key()}-*{platform.suffix}"))
        )
        for data in libraries:
            if data is not None and prefer in ("auto", "portable"):
                return data
        raise
    made_by = hashlib.sha256(f"{compiler.name} {compiler.command[1:]}".encode()).hexdigest()[:8]
    path = made / f"{_shim_key()}-{made_by}{platform.suffix}"
    data = disk_cache.read(path, tell)
    if data is None:
        kernels = kernels_of(platform, units)
        what = f"linking {platform.name} ({compiler.name})"
        tell(what)
        alone = units == "single"
        with work(what):
            data = link(compiler, platform, shim_sources(), kernels, engine_digest().hex(), alone)
        disk_cache.write(path, data, tell)
    return data


def kernels_of(platform: Platform, units: str = "all") -> list[bytes]:
    """Object files of the kernels that a library of a platform holds; ``units`` as for `library`."""
    sets = [suffix for suffix, _ in platform.instruction_sets]
    linked = [SINGLE[unit] for unit in LINKED] if units == "single" else LINKED
    return list(objects(platform, linked, sets).values())


def library_name(platform: Platform) -> str:
    """Name of a linked library in a wheel, with the hash of the C sources that it was made from."""
    return f"{platform.name}-{_shim_key()}{platform.suffix}"


def _shim_key() -> str:
    return digest(Path(__file__).parent / "shim", suffixes=(".c", ".h")).hex()[:16]


def link(
    compiler: Compiler,
    platform: Platform,
    sources: Sequence[Path],
    kernels: Sequence[bytes],
    digest: str,
    alone: bool = False,
) -> bytes:
    """Compile C sources, link them with objects, and return the shared library.

    ``digest`` (64 hex digits) names the equations of the objects; the library refuses models of others, and
    those of sets where the objects serve single bearings ``alone``.

    Raises
    ------
    BuildError
        With the messages of the compiler.
    """
    defines = [f'-DFB_KERNELS="{digest}"']
    sets = dict(platform.instruction_sets)
    if "v3" in sets:
        defines += ["-DFB_X86"] if "v2" in sets else ["-DFB_X86", "-DFB_NEWER_ONLY"]
    if alone:
        defines.append(f"-DFB_ALONE={P.ALONE}")
    with tempfile.TemporaryDirectory() as temporary:
        made = Path(temporary) / f"bearing{platform.suffix}"
        files = [Path(temporary) / f"kernels{k}.o" for k in range(len(kernels))]
        try:
            for file, data in zip(files, kernels, strict=True):
                file.write_bytes(data)
        except OSError as problem:
            words = no_room(tempfile.gettempdir(), problem) or str(problem)
            raise BuildError(f"{platform.name}: the kernels cannot be linked: {words}") from None
        command = [
            *compiler.command, *FLAGS, *defines, f"-I{headers()}", "-shared",
            *map(str, sources), *map(str, files), "-o", str(made), "-lm",
        ]  # fmt: skip
        ran = children.run(command, capture_output=True, text=True)
        if ran.returncode != 0:
            raise BuildError(f"{platform.name}: {compiler.name} failed: {ran.stderr.strip()[-2000:]}")
        return made.read_bytes()
