"""Stiffness and damping of one bearing over speed, preload and frequency, with its files and picture."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

from fmu_bearing.steady.stiffness.ross import write
from fmu_bearing.steady.stiffness.stiffness_files import dataset, save
from fmu_bearing.steady.stiffness.stiffness_limits import limits_of
from fmu_bearing.steady.stiffness.stiffness_picture import picture
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


class BearingStiffness(StiffnessTable):
    """Stiffness and damping of a bearing's inner ring against the fixed outer ring, SI units.

    Forces on the ring are -K q - C q' with q = x, y, z (m) and tilts about y, z (rad), at the centre of the
    circle of balls. The balls' inertia and friction are in K and C; mass, gyroscopic moment and supports of
    the ring are not. Cage, imperfections and sound are left out. All is in the bearing's own axes: the axes
    of the shaft, with x and tilts reversed where it carries towards -X.

    Examples
    --------
    >>> from fmu_bearing import stiffness
    >>> (found,) = stiffness("examples/scenes/7003C-spindle.toml", [10e3, 20e3], [200.0, 1000.0]).bearings
    >>> found.K.shape, f"{found.K[1, 0, 1, 1, 1] / 1e6:.0f} N/um"
    ((2, 1, 2, 5, 5), '159 N/um')
    """

    quantities = (
        "bearing [1] = number", "K [N/m, N, N m/rad]", "C [N s/m, N s, N m s/rad]",
        "static [N/m, N, N m/rad]",
        "f_c_Hz = orbit", "spread [1]", "steady", "against_static [1]",
    )  # fmt: skip

    def cautions(self) -> list[str]:
        """Return what limits these numbers, in sentences."""
        return [*limits_of(self)]

    def to_xarray(self) -> "xarray.Dataset":
        """Return all as a dataset over speed, preload and frequency, the scene as TOML text in ``scene``.

        Raises
        ------
        MissingExtra
            Without xarray.
        """
        return dataset(self)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write to ``.csv`` (a row per matrix, SI units) or ``.nc`` (netCDF).

        Raises
        ------
        ValueError
            For another ending.
        MissingExtra
            For netCDF without xarray.
        """
        return save(self, path)

    def to_ross(
        self, path: str | os.PathLike[str], preload: float | None = None, *, mirrored: bool = False,
        nodes: tuple[int, int, int] = (0, 1, 2),
    ) -> tuple[Path, Path, Path]:  # fmt: skip
        """Write three bearing elements for ROSS 3, each a file, that are the bearing together; see ``ross``.

        Parameters
        ----------
        path : path
            ``NAME.toml`` makes ``NAME-1.toml`` to ``NAME-3.toml``, for the planes of `planes` in order.
        preload, mirrored
            As for `planes`.
        nodes : tuple of int
            Nodes of the rotor at the planes.

        Raises
        ------
        ValueError
            As for `planes`, for another ending, and for an axis of two to four values.
        """
        return write(self, path, preload, mirrored, nodes)

    def picture(self, frequency: float | None = None) -> "Figure":
        """Draw K and C over speed, a curve per preload, K for frequency to 0 dashed.

        Parameters
        ----------
        frequency : float, optional
            Hz: the nearest one of the table is drawn; default: the middle one.

        Raises
        ------
        MissingExtra
            Without Matplotlib.
        """
        return picture(self, frequency)
