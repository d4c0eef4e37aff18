"""Style of the figures: colours for all kinds of colour vision, for light and dark pages."""

from typing import Any

from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import COLOURS, coincident, series as drawn

#: Colours of things that are no component of sound.
FURTHER = {
    "x": "#0072B2", "y": "#D55E00", "z": "#009E73", "inner": "#0072B2", "outer": "#D55E00",
    "nose": "#0072B2", "housing": "#D55E00",
    "first": "#E69F00", "second": "#56B4E9", "grey": "#7F7F7F", "mark": "#8C6D1F",
}  # fmt: skip
#: The same on a dark ground; figures are made with the light ones, the page exchanges them.
ON_DARK = {
    "#000000": "#F5F5F5",
    "#0072B2": "#5CB8F2",
    "#D55E00": "#FF8F45",
    "#009E73": "#35D0A5",
    "#CC79A7": "#F0A3CD",
    "#E69F00": "#FFC247",
    "#56B4E9": "#8FD0F7",
    "#7F7F7F": "#A8A8A8",
    "#8C6D1F": "#D9BC6B",
    "#1F3B8C": "#93A8F2",
    "#8C2D04": "#E08A5F",
    "#B8860B": "#E0B84A",
    "#00806B": "#2FB8A0",
    "rgba(255,255,255,0.75)": "rgba(27,33,40,0.75)",
}
#: Ground of names that lie on curves.
BEHIND = "rgba(255,255,255,0.75)"
_DASHES = {"-": "solid", "--": "dash", "-.": "dashdot", ":": "dot"}
#: The toolbar of a figure that has a scale of colours or an axis to the right: in a row on top.
TOOLS_ABOVE = {"orientation": "h"}
_TOOLS = 44  # px: the toolbar's width, so that it covers neither curves nor the legend
_FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"


def colour(name: str) -> str:
    """Colour of a component, body (``bearing[1].cage`` as ``cage``), axis or race."""
    own = name.rpartition(".")[2]
    return COLOURS.get(own) or FURTHER[own]


def faint(name: str, alpha: float = 0.18) -> str:
    """Return the colour for areas, seen through."""
    text = colour(name).lstrip("#")
    red, green, blue = (int(text[k : k + 2], 16) for k in (0, 2, 4))
    return f"rgba({red},{green},{blue},{alpha})"


def series(place: int) -> dict[str, Any]:
    """Return colour and dashes of a curve by its place, dashed where all colours are taken."""
    return _plotly(drawn(place))


def microphone(place: int, count: int) -> dict[str, Any]:
    """Return colour, dashes and width of one of ``count`` microphones, whose curves may coincide."""
    return _plotly(coincident(place, count))


def _plotly(style: dict[str, Any]) -> dict[str, Any]:
    line_style = {"color": style["color"], "dash": _DASHES[style["linestyle"]]}
    return line_style | ({"width": style["linewidth"]} if "linewidth" in style else {})


def words(name: str) -> str:
    """Name of a component or body in words: ``bearing[1].inner_ring``, inner ring of bearing 1."""
    owner, _, own = name.rpartition(".")
    text = "all together" if own == "total" else own.replace("_", " ")
    owner = owner.replace("[", " ").removesuffix("]").replace("shaft", "the shaft")
    return f"{text} of {owner}" if owner else text


def styles() -> dict[str, Any]:
    """Return the page's two styles of Plotly layouts and its exchange of colours, as plain data."""
    return {
        "light": {"layout": _style("#1D2329", "#E3E7EB", "#9AA4AE", "#FFFFFF", "#F6F8FA")},
        "dark": {"layout": _style("#E4E8EC", "#333B44", "#66717C", "#1B2128", "#20272F")},
        "exchange": ON_DARK,
    }


def _style(ink: str, grid: str, line: str, ground: str, panel: str) -> dict[str, Any]:
    axis = {"gridcolor": grid, "linecolor": line, "zerolinecolor": line, "tickcolor": line, "showline": True}
    solid = {"gridcolor": grid, "zerolinecolor": line, "showbackground": True, "backgroundcolor": panel}
    return {
        "font": {"color": ink, "family": _FONT, "size": 13},
        "paper_bgcolor": ground, "plot_bgcolor": ground,
        "xaxis": axis, "yaxis": axis,
        "polar": {"bgcolor": panel, "angularaxis": axis, "radialaxis": axis},
        "scene": {"xaxis": solid, "yaxis": solid, "zaxis": solid},
        "hoverlabel": {"font": {"family": _FONT}},
        "legend": {"bgcolor": "rgba(0,0,0,0)"},
    }  # fmt: skip


def figure(height: int = 380, **layout: Any) -> Any:
    """Return an empty Plotly figure: room for axes, its legend above, the toolbar upright to the right."""
    go = need("plotly.graph_objects", "a report")
    base = {
        "template": {}, "height": height, "margin": {"l": 62, "r": _TOOLS, "t": 36, "b": 52},
        "modebar": {"orientation": "v"},
        "legend": {"orientation": "h", "x": 0.0, "y": 1.0, "xanchor": "left", "yanchor": "bottom"},
        "hovermode": "closest",
    }  # fmt: skip
    return go.Figure(layout=base | layout)


def polar(height: int, radial: dict[str, Any] | None = None) -> Any:
    """Return an empty polar figure as seen from +X: 12 o'clock on top, positive rotation anticlockwise."""
    return figure(
        height, margin={"l": _TOOLS, "r": _TOOLS, "t": 30, "b": 70},
        legend={"orientation": "h", "x": 0.5, "y": -0.1, "xanchor": "center", "yanchor": "top"},
        polar={
            "angularaxis": {
                "rotation": 90, "direction": "counterclockwise", "dtick": 30, "ticksuffix": "\u00b0",
            },
            "radialaxis": radial_axis(radial or {}),
        },
    )  # fmt: skip


def radial_axis(more: dict[str, Any]) -> dict[str, Any]:
    """Return the radial axis of a polar figure."""
    return {"angle": 15, "tickangle": 15} | more


def bar(title: str, length: float = 1.0) -> dict[str, Any]:
    """Return the scale of colours beside a map."""
    return {"title": {"text": title, "side": "top"}, "thickness": 14, "len": length, "outlinewidth": 0}


def axis(title: str, **more: Any) -> dict[str, Any]:
    """Return an axis with a title that keeps clear of its numbers."""
    return {"title": {"text": title, "standoff": 8}, "automargin": True, **more}
