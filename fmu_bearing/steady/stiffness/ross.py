"""Bearing elements for the rotor program ROSS, release 3, written without it.

A bearing element of ROSS has stiffness and damping of three translations at one node, and none of tilt. Two
elements, each with half of the bearing, in the planes of ``planes`` carry tilt and coupling, too. Each is
in a file of its own, because ``BearingElement.load`` reads the first element of a file alone.

Layout of a file, as ROSS 3.1.0 saves and loads it: one table ``BearingElement_TAG`` with the names of the
arguments as keys; ``n`` is the node; ``kxx`` to ``czz`` are numbers, lists over ``speed`` or ``frequency``,
or tables over both, a list per speed. Units are N/m, N s/m and rad/s, axes rise. The axes x, y, z of ROSS are
Y, Z, X of this program. Release 2 called the axis of the speed ``frequency``: it cannot read these files.
"""

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.files import check_file, write_whole
from fmu_bearing.steady.impedance import FREEDOMS
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable

RELEASE = "3.1.0"  # the one whose reading and writing was tried
FEWEST = 5  # values of an axis, below which ROSS warns of its interpolation
#: Coefficients of an element by our force and motion: x, y, z of ROSS are Y, Z, X.
_ENTRIES = {"xx": ("y", "y"), "xy": ("y", "z"), "yx": ("z", "y"), "yy": ("z", "z"), "zz": ("x", "x")}


def check_element(path: str | os.PathLike[str]) -> Path:
    """Return the path from which the names of both files are made; called before a long computation.

    Raises
    ------
    ValueError
        For an ending other than ``.toml``.
    OSError
        Where it cannot be written.
    """
    target = check_file(path)
    if target.suffix != ".toml":
        raise ValueError(f"{target}: elements for ROSS are written as .toml")
    return target


def check_axes(speeds: int, frequencies: int) -> None:
    """Raise ``ValueError`` unless both axes have one value or enough to interpolate; by their lengths."""
    for name, count in (("speeds", speeds), ("frequencies", frequencies)):
        if 1 < count < FEWEST:
            raise ValueError(
                f"{count} {name} are refused: ROSS interpolates between at least {FEWEST}; give one, or "
                f"{FEWEST} and more"
            )


def write(
    found: StiffnessTable, path: str | os.PathLike[str], preload: float | None, mirrored: bool,
    nodes: tuple[int, int],
) -> tuple[Path, Path]:  # fmt: skip
    """Write both elements; see `BearingStiffness.to_ross`."""
    target = check_element(path)
    check_axes(len(found.speeds), len(found.frequencies))
    at, planes = found.at_preload(preload), found.planes(preload, mirrored)
    files = []
    for part, (place, node) in enumerate(zip(planes.places, nodes, strict=True), 1):
        text = _element(found, at, part, place, node, mirrored)
        files.append(write_whole(target.with_name(f"{target.stem}-{part}.toml"), text.encode()))
    return files[0], files[1]


def _element(
    found: StiffnessTable, at: int, part: int, place: float, node: int, mirrored: bool
) -> str:  # fmt: skip
    """Return the text of one file."""
    tag = f"{found.scene.bearing.designation} {part} of 2"
    remarks = (
        f"Half of a bearing for ROSS {RELEASE}; release 2 cannot read it.",
        f"Scene {found.scene.name}, preload {found.preloads[at]:g} N{', mirrored' if mirrored else ''}.",
        f"The node is {1e3 * place:+.4f} mm from the centre of the circle of balls along z, the axis of",
        "ROSS that is X of the scene. Both halves together have the static tilt stiffness and coupling.",
    )
    lines = [f"# {remark}" for remark in remarks]
    lines += [f'["BearingElement_{tag}"]', f'tag = "{tag}"', f"n = {node}"]
    if len(found.speeds) > 1:
        lines.append(f"speed = {_list(found.speeds * RPM)}")
    if len(found.frequencies) > 1:
        lines.append(f"frequency = {_list(2.0 * np.pi * found.frequencies)}")
    for letter, matrices in (("k", found.K[:, at]), ("c", found.C[:, at])):
        for name, (force, motion) in _ENTRIES.items():
            half = 0.5 * matrices[..., FREEDOMS.index(force), FREEDOMS.index(motion)]
            shape = tuple(size for size in half.shape if size > 1)
            lines.append(f"{letter}{name} = {_list(half.reshape(shape))}")
    return "\n".join(lines) + "\n"


def _list(values: NDArray[np.float64]) -> str:
    """Write a number or nested lists as TOML has them."""
    if values.ndim == 0:
        return repr(float(values))
    return f"[{', '.join(map(_list, values))}]"
