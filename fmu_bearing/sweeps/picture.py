"""Pictures of a sweep: curves over one axis, maps over two."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface.names import chosen_names
from fmu_bearing.results.picture_parts import empty, label, save
from fmu_bearing.scene.units import split_unit
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.result import REASON, SEED, WALL

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_map", "label_of", "save", "shown", "sweep_picture"]

#: Figures drawn by default, as far as the dataset has them.
DEFAULT = ("mic[1].leq_a", "outer_ring.velocity", "outer_ring.velocity:1x", "friction_torque")
MOST = 300  # panels: more make a picture of more points than Matplotlib draws
#: Factor and unit in pictures, where SI gives awkward numbers.
_SHOWN = {"m/s": (1e3, "mm/s"), "N.m": (1e3, "N.mm"), "Pa": (1e-9, "GPa"), "rad": (180.0 / math.pi, "deg")}


def sweep_picture(data: "xarray.Dataset", figures: Sequence[str] | None = None) -> "Figure":
    """Draw figures of a sweep, a panel each: curves over one axis, maps over two.

    An axis of texts, or one of fewer than three values beside a longer one, makes curves side by side. Axes
    of one value are left out.

    Parameters
    ----------
    data : xarray.Dataset
        Of `sweep`.
    figures : sequence of str, optional
        Names in the dataset, with ``*`` for any text, all drawn; default: all of `DEFAULT` that the
        dataset has.

    Raises
    ------
    SweepError
        For more than two axes: choose along the others with ``data.isel`` or ``data.sel``; for very many
        figures.
    """
    data = data.squeeze()
    there = [str(name) for name in data.data_vars if name not in (SEED, WALL, REASON)]
    default = [name for name in DEFAULT if name in there] or there[:4]
    names = chosen_names(figures, there, default)
    if len(names) > MOST:
        raise SweepError(f"{len(names)} figures do not fit a picture: choose at most {MOST}")
    over, beside = _roles(data)
    data = data.sortby([name for name in (over, beside) if name and data[name].dtype.kind in "iuf"])
    columns = min(len(names), 3 if len(names) > 4 else 2)
    rows = -(-len(names) // columns)
    figure = empty((6.2 * columns, 4.2 * rows))
    panels = np.ravel(figure.subplots(rows, columns, squeeze=False))
    for ax, name in zip(panels, names, strict=False):
        values, unit = shown(data[name])
        if beside is not None and _is_map(data, beside):
            colours = draw_map(ax, data, over, beside, values.transpose(beside, over).values)
            figure.colorbar(colours, ax=ax, label=unit)
        else:
            _curves(ax, data, over, beside, values)
            label(ax, label_of(data, over), unit, "")
        ax.set_title(name, fontsize=10)
    for ax in panels[len(names) :]:
        ax.remove()
    figure.suptitle(str(data.attrs.get("title", "")), fontsize=11)
    return figure


def shown(values: "xarray.DataArray") -> tuple["xarray.DataArray", str]:
    """Return values and unit as pictures have them."""
    unit = str(values.attrs.get("units", ""))
    factor, label = _SHOWN.get(unit, (1.0, unit))
    if str(values.name).endswith("_a"):
        label = "dB(A)"
    return values * factor, label


def draw_map(
    ax: "Axes", data: "xarray.Dataset", over: str, beside: str, values: NDArray[np.float64], **options: Any
) -> Any:
    """Draw values (rows along ``beside``) as a map; points without a figure stay grey. Return its colours."""
    ax.set_facecolor("0.75")
    x, y = (_edges(data[name].values.astype(float)) for name in (over, beside))
    colours = ax.pcolormesh(x, y, values, **({"cmap": "viridis"} | options))
    sides: tuple[tuple[Literal["x", "y"], str], ...] = (("x", over), ("y", beside))
    for axis, name in sides:
        getattr(ax, f"set_{axis}label")(label_of(data, name))
        if _is_geometric(data[name].values.astype(float)):
            getattr(ax, f"set_{axis}scale")("log")
        else:
            ax.locator_params(axis=axis, nbins=6)
    return colours


def label_of(data: "xarray.Dataset", name: str) -> str:
    """Name and unit of an axis."""
    unit = data[name].attrs.get("units", "")
    words = split_unit(name)[0].replace("_", " ")
    return f"{words}, {unit}" if unit else words


def _curves(
    ax: "Axes", data: "xarray.Dataset", over: str, beside: str | None, values: "xarray.DataArray"
) -> None:  # fmt: skip
    x = data[over].values
    if x.dtype.kind in "biuf" and _is_geometric(x.astype(float)):
        ax.set_xscale("log")
    members: list[Any] = [None] if beside is None else list(data[beside].values)
    for member in members:
        y = values.values if beside is None else values.sel({beside: member}).values
        name = None if beside is None else f"{member:g}" if isinstance(member, float) else str(member)
        ax.plot(x, y, marker="o", markersize=3, linewidth=1.2, label=name)
    if beside is not None:
        ax.legend(title=label_of(data, beside), frameon=False, fontsize=8)


def _roles(data: "xarray.Dataset") -> tuple[str, str | None]:
    """Return the axis along x, and the other one."""
    dims = [str(name) for name in data.dims]
    if not dims:
        raise SweepError("a single point has no picture")
    if len(dims) > 2:
        raise SweepError(
            f"a picture has two axes, the sweep {', '.join(dims)}: choose along the others, "
            f"for example data.isel({dims[0]}=0)"
        )
    # the longest axis of numbers goes along x; the sweep's first where they are equal
    dims.sort(key=lambda name: (data[name].values.dtype.kind not in "iuf", -data[name].size))
    return dims[0], dims[1] if len(dims) == 2 else None


def _is_map(data: "xarray.Dataset", beside: str) -> bool:
    return data[beside].values.dtype.kind in "iuf" and data[beside].size >= 3


def _edges(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Borders of the cells about rising values: half a step between them, or half a factor.

    The first and the last cell end at their points: beyond them nothing was computed.
    """
    steps = np.log(values) if _is_geometric(values) else values
    middles = 0.5 * (steps[1:] + steps[:-1])
    middles = np.exp(middles) if _is_geometric(values) else middles
    return np.concatenate([values[:1], middles, values[-1:]])


def _is_geometric(values: NDArray[np.float64]) -> bool:
    """Whether values grow by a factor rather than by a step."""
    if len(values) < 3 or values.min() <= 0.0:
        return False
    ratios = values[1:] / values[:-1]
    return bool(np.allclose(ratios, ratios[0], rtol=1e-3))  # people write few digits
