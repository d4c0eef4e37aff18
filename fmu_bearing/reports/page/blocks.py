"""Parts of a section, as data; the page's template turns them into HTML."""

import base64
import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: dB: step of levels in charts.
DECIBELS = 1.0 / 64.0
#: Pixels of a table on a page of 390 pixels; of a letter in it, and between its columns.
_NARROW, _LETTER, _GAP = 310.0, 7.4, 11.2
_LONG = 60  # rows up to which a table is stacked
#: Half of the last of the 15 binary digits that `small` keeps: five decimal ones.
_HALF = np.uint32(1 << 7)


class Absent(ValueError):
    """A section, or part of one, cannot be made of this recording; the message says why."""


@dataclass(frozen=True)
class Words:
    """A paragraph; ``kind`` is ``"text"``, ``"note"`` (small), ``"warning"`` or ``"absent"``."""

    text: str
    kind: str = "text"
    sort: str = "words"


@dataclass(frozen=True)
class Table:
    """Rows of texts under a caption; cells that look like numbers have digits of one width."""

    caption: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    folded: bool = False
    sort: str = "table"

    @property
    def stacked(self) -> bool:
        """Whether on a narrow page each row is a block, its cells under each other with their columns' names.

        So is a table whose longest words have no room beside each other there; a long one is scrolled.
        """
        columns = list(zip(self.columns, *self.rows, strict=True))
        words = sum(max(len(word) for cell in column for word in cell.split() or [""]) for column in columns)
        wide = _LETTER * words + _GAP * len(columns) > _NARROW
        return wide and any(self.columns) and not self.long

    @property
    def long(self) -> bool:
        """Whether it has too many rows to be stacked."""
        return len(self.rows) > _LONG


@dataclass(frozen=True)
class Overall:
    """The gravest judgement, how many figures have it, and which figures exceed a limit, gravest first."""

    judgement: str
    words: str
    beyond: Sequence[str]


@dataclass(frozen=True)
class Card:
    """Figures of one thing on the first screen: a title, its judgement, rows of name, value and unit."""

    title: str
    judgement: str
    rows: Sequence[tuple[str, str, str]]


@dataclass(frozen=True)
class Option:
    """One entry of a `Choice`: what it is called, the ``meta`` value it shows, what it sets in the layout."""

    text: str
    value: str = ""
    layout: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Choice:
    """A selection above a chart.

    Among traces whose ``meta`` has ``key``, those with the value of the chosen option are shown.
    """

    key: str
    label: str
    options: Sequence[Option]


@dataclass(frozen=True)
class Chart:
    """A Plotly figure with a description for screen readers.

    ``solid``: drawn by WebGL, so that print takes a picture of it.
    """

    key: str
    title: str
    figure: Any
    words: str
    choices: Sequence[Choice] = ()
    note: str = ""
    solid: bool = False
    sort: str = "chart"

    @property
    def height(self) -> int:
        """Of the figure, in CSS pixels."""
        return int(self.figure.layout.height)


@dataclass(frozen=True)
class Sound:
    """A WAV file that the page can play."""

    name: str
    words: str
    wav: bytes
    sort: str = "sound"

    @property
    def address(self) -> str:
        """Return the file as a ``data:`` address."""
        return "data:audio/wav;base64," + base64.b64encode(self.wav).decode("ascii")


@dataclass(frozen=True)
class Folded:
    """Text, unchanged, shown on request."""

    title: str
    text: str
    sort: str = "folded"


@dataclass(frozen=True)
class Shapes:
    """Shapes of modes that the page moves; ``data`` is what its script takes."""

    key: str
    title: str
    data: dict[str, Any]
    words: str
    sort: str = "shapes"

    @property
    def json(self) -> str:
        """The numbers for a ``<script>`` element."""
        return packed(self.data)


Block = Words | Table | Chart | Sound | Folded | Shapes


#: Why a section is missing that Ctrl-C ended or came before.
CUT = "interrupted before it was computed"


@dataclass(frozen=True)
class Section:
    """A heading and its blocks; ``missing``: why there are none."""

    key: str
    title: str
    blocks: Sequence[Block]
    missing: str = ""


def for_script(text: str) -> str:
    """JSON that cannot end the ``<script>`` element around it."""
    return text.replace("</", "<\\/").replace("<!--", "<\\!--")


def packed(data: Any) -> str:
    """Plain data as JSON for a ``<script>`` element."""
    return for_script(json.dumps(data))


def small(values: Any, step: float = 0.0) -> NDArray[np.float32]:
    """Numbers for a chart as 32-bit floats of five digits, or in multiples of ``step``: they pack better.

    ``step`` is a power of two, so that its multiples end in zeros.
    """
    if step > 0.0:
        return (step * np.round(np.asarray(values, dtype=float) / step)).astype(np.float32)
    bits = np.ascontiguousarray(values, dtype=np.float32).view(np.uint32)
    return ((bits + _HALF) & ~(2 * _HALF - np.uint32(1))).view(np.float32)


def thinned(values: ArrayLike, most: int = 6000) -> tuple[NDArray[np.float64], float]:
    """Return at most ``most`` values and the number of samples each represents.

    A longer signal is cut into equal spans; of each, the smallest and the largest value are kept in the order
    in which they come, so an envelope stays what it is and no peak is lost.
    """
    signal = np.asarray(values, dtype=float)
    if len(signal) <= most:
        return signal, 1.0
    span = int(np.ceil(2 * len(signal) / most))
    whole = len(signal) // span
    rows = signal[: whole * span].reshape(whole, span)
    low, high = rows.argmin(axis=1), rows.argmax(axis=1)
    first, second = np.minimum(low, high), np.maximum(low, high)
    pairs = np.stack([rows[np.arange(whole), first], rows[np.arange(whole), second]], axis=1)
    return pairs.ravel(), span / 2.0
