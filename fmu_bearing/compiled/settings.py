"""Settings under which Numba generates code for no machine in particular, and the Numbas of the lean way."""

__all__ = ["SETTINGS", "TESTED", "lean"]

#: Environment of the process that compiles.
SETTINGS = {
    "NUMBA_OPT": "0",
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_DISABLE_INTEL_SVML": "1",
    # Numba colours the messages of all the overloads it tries and drops: a tenth of its time
    "NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING": "1",
    "FMU_BEARING_KEEP_KERNELS": "",  # there is no machine code of single kernels to be kept
}
#: Versions of Numba (major.minor) whose lean code was compared to that of the plain way.
TESTED = ("0.68",)


def lean(version: str) -> bool:
    """Whether a Numba of that version is compiled with in the lean way."""
    return ".".join(version.split(".")[:2]) in TESTED
