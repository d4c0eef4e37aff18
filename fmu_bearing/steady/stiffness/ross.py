"""Bearing elements for the rotor program ROSS, release 3, written without it.

A bearing element of ROSS has stiffness and damping of three translations at one node, and none of tilt. Three
elements in the planes of ``planes`` have tilt and coupling of the bearing, too; ROSS takes coefficients below
0. Each is in a file of its own, because ``BearingElement.load`` reads the first element of a file alone.

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
from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.steady.stiffness.planes import Planes
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable

RELEASE = "3.1.0"  # the one whose reading and writing was tried
FEWEST = 5  # values of an axis, below which ROSS warns of its interpolation
#: Coefficients of an element by our force and motion: x, y, z of ROSS are Y, Z, X.
_ENTRIES = {"xx": ("y", "y"), "xy": ("y", "z"), "yx": ("z", "y"), "yy": ("z", "z"), "zz": ("x", "x")}


def check_axes(speeds: int, frequencies: int) -> None:
    """Raise ``ValueError`` unless both axes have one value or enough to interpolate; by their lengths."""
    for name, count in (("speeds", speeds), ("frequencies", frequencies)):
        if 1 < count < FEWEST:
            raise ValueError(
                f"{count} {name} are refused: ROSS interpolates between at least {FEWEST}; give one, or "
                f"{FEWEST} and more"
            )


def write(
    table: StiffnessTable, path: str | os.PathLike[str], preload: float | None, mirrored: bool,
    nodes: tuple[int, int, int],
) -> tuple[Path, Path, Path]:  # fmt: skip
    """Write the elements; see `BearingStiffness.to_ross`."""
    target = check_file(path, ".toml", "an element for ROSS")
    check_axes(len(table.speeds), len(table.frequencies))
    planes = table.planes(preload, mirrored)
    of = f"preload {table.preloads[table.at_preload(preload)]:g} N{', mirrored' if mirrored else ''}"
    files = []
    for k, node in enumerate(nodes):
        text = _element(table, of, planes, k, node)
        files.append(write_whole(target.with_name(f"{target.stem}-{k + 1}.toml"), text.encode()))
    return files[0], files[1], files[2]


def _element(table: StiffnessTable, of: str, planes: Planes, k: int, node: int) -> str:
    """Return the text of the file for the ``k``-th plane."""
    tag = f"{table.scene.bearing.designation} {k + 1} of 3"
    remarks = (
        f"Element {k + 1} of 3 of a bearing for ROSS {RELEASE}; release 2 cannot read it.",
        f"Scene {table.scene.name}, {of}.",
        f"The node is {1e3 * planes.places[k]:+.4f} mm from the centre of the circle of balls along z, the",
        "axis of ROSS that is X of the scene. All three together are the bearing, its tilt included.",
    )
    lines = [f"# {remark}" for remark in remarks]
    lines += [f'["BearingElement_{tag}"]', f'tag = "{tag}"', f"n = {node}"]
    if len(table.speeds) > 1:
        lines.append(f"speed = {_list(table.speeds * RPM)}")
    if len(table.frequencies) > 1:
        lines.append(f"frequency = {_list(2.0 * np.pi * table.frequencies)}")
    for letter, matrices in (("k", planes.K[k]), ("c", planes.C[k])):
        for name, (force, motion) in _ENTRIES.items():
            values = matrices[..., FREEDOMS.index(force), FREEDOMS.index(motion)]
            shape = tuple(size for size in values.shape if size > 1)
            lines.append(f"{letter}{name} = {_list(values.reshape(shape))}")
    return "\n".join(lines) + "\n"


def _list(values: NDArray[np.float64]) -> str:
    """Write a number or nested lists as TOML has them."""
    if values.ndim == 0:
        return repr(float(values))
    return f"[{', '.join(map(_list, values))}]"
