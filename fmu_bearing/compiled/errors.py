"""What can go wrong while kernels or libraries are built."""

__all__ = ["BuildError"]


class BuildError(RuntimeError):
    """Kernels or a library that could not be built, and why."""
