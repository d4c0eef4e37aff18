"""Figures and the plotting library in few bytes: one compressed text each, which the page unpacks.

Gzip makes a third of the library. Numbers of figures shrink most where bytes of equal weight stand side by
side, so arrays are taken out of the figures' JSON and their bytes are put in that order first.
"""

import base64
import gzip
import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np

#: What `figures` puts in place of an array: type, place in the bytes, length, shape.
ARRAY = "packed"


def text_of(data: bytes) -> str:
    """Return bytes as compressed text: gzip, then base64."""
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode("ascii")


def figures(charts: Mapping[str, Any]) -> bytes:
    """Return Plotly figures by key as bytes: the JSON's length (4 bytes), the JSON, all arrays.

    Arrays are little-endian; of each, the first bytes of all numbers come first, then the second ones.
    """
    arrays = bytearray()

    def taken(value: Any) -> Any:
        if isinstance(value, list):
            return [taken(one) for one in value]
        if not isinstance(value, dict):
            return value
        if "bdata" not in value:
            return {key: taken(one) for key, one in value.items()}
        kind = np.dtype(value["dtype"])
        numbers = np.frombuffer(base64.b64decode(value["bdata"]), dtype=kind)
        shape = [int(n) for n in str(value.get("shape", len(numbers))).split(",")]
        place = len(arrays)
        arrays.extend(numbers.view(np.uint8).reshape(-1, kind.itemsize).T.tobytes())
        return {ARRAY: [value["dtype"], place, len(numbers), shape]}

    packed_figures = {key: taken(json.loads(figure.to_json())) for key, figure in charts.items()}
    words = json.dumps(packed_figures, separators=(",", ":")).encode("utf-8")
    return struct.pack("<I", len(words)) + words + bytes(arrays)
