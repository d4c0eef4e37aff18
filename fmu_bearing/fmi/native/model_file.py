"""A model as the bytes of ``resources/model.bin``, which the C shim reads (``shim/model.h``).

The lower half is independent of bearings: :class:`Contents` holds the data of the file for any model, and
:func:`contents_bytes` lays them out. :func:`model_bytes` fills it from a model.
"""

import hashlib
import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from fmu_bearing.arrays import reasons
from fmu_bearing.cautions import Caution, cautions
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.layout import P, S, U
from fmu_bearing.fmi.description import LOG_CATEGORIES
from fmu_bearing.fmi.resources import fingerprint
from fmu_bearing.interface import Variable
from fmu_bearing.interface.inputs import led_inputs

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model

__all__ = ["MODEL_FILE", "Contents", "contents_bytes", "model_bytes"]

MODEL_FILE = "model.bin"

_MAGIC = b"fbmodel\n"
_VERSION = 1
_NOWHERE = 2**64 - 1
_DIGEST_SIZE = 32

# In the order of the numbers in shim/model.h.
_TYPES = ("Real", "Integer", "Boolean", "String")
_CAUSALITIES = ("input", "output", "local", "parameter")
_VARIABILITIES = ("constant", "fixed", "discrete", "continuous", "tunable")
_ARRAYS = ("", "u", "z", "p")

_NUMBERS = struct.Struct("<10Qd5Q")
_VARIABLE = struct.Struct("<8I3d")
_REASON = struct.Struct("<2I")
_CAUTION = struct.Struct("<6I2d")
_CATEGORY = struct.Struct("<2I")

# What steps need of a state takes 0.06 to 0.6 MB: to copy it costs 0.003 to 0.05 ms, more than many a step.
# One copy for so many steps makes that small. A refused step then repeats what these steps took: of full the
# 2 ms of the bearing are some 2 ms of the processor; of the others 32 ms are 0.2 ms (response), 3 in a
# run-up, and 6 ms (rings), 15 of four bearings.
_JOURNAL = 32
_JOURNAL_SPAN = {"full": 2e-3, "rings": 32e-3, "response": 32e-3}  # s, chosen

#: The fmi2Status whose messages belong to a category.
_STATUS_OF_CATEGORY = {"logAll": 0, "logStatusWarning": 1, "logStatusDiscard": 2, "logStatusError": 3}


@dataclass(frozen=True)
class Contents:
    """Contents of the file.

    Attributes
    ----------
    guid : str
    kernels : str
        64 hexadecimal digits that identify the equations; a library with other equations refuses the file.
    fingerprint : str
        64 hexadecimal digits that bind states to the model.
    parameters, inputs : array_like
        Array ``p`` and starts of ``u``.
    state_size, output_size, work_size : int
        Lengths of ``s``, ``z`` and ``w``.
    time : int
        Place in ``s`` of the time reached.
    tunables : int
        Numbers at the head of ``p`` that can be set.
    variables : sequence of Variable
        In the order of the value references.
    ramped : int or None
        Input that the engine ramps over a step while it holds the others.
    led : range
        Inputs that the engine leads to their values over a step; directional derivatives are by these.
    journal : int
        Most steps that are repeated to go back behind a refused one; 1: the state is copied for each step.
    journal_span : float
        Longest time (s) that they take together.
    reasons : dict of int to str
        What a status of the kernels means.
    cautions : sequence of Caution
    categories : sequence of (str, int)
        Log categories and the fmi2Status of their messages; that of fmi2OK (0) means all.
    """

    guid: str
    kernels: str
    fingerprint: str
    parameters: ArrayLike
    inputs: ArrayLike
    state_size: int
    output_size: int
    work_size: int
    time: int
    tunables: int
    variables: Sequence[Variable]
    ramped: int | None = None
    led: range = range(0)
    journal: int = 1
    journal_span: float = math.inf
    reasons: dict[int, str] = field(default_factory=dict)
    cautions: Sequence[Caution] = ()
    categories: Sequence[tuple[str, int]] = tuple(_STATUS_OF_CATEGORY.items())


class _Texts:
    """Texts by offset; equal ones are stored once, the empty one at 0."""

    def __init__(self) -> None:
        self.data = bytearray(b"\0")
        self._places = {"": 0}

    def place(self, text: str) -> int:
        if text not in self._places:
            if "\0" in text:
                raise ValueError(f"the text {text!r} holds a zero character, which ends a text in C")
            self._places[text] = len(self.data)
            self.data += text.encode("utf-8") + b"\0"
        return self._places[text]

    def padded(self) -> bytes:
        return bytes(self.data) + b"\0" * (-len(self.data) % 8)


def contents_bytes(contents: Contents) -> bytes:
    """Lay the contents out as the file.

    Raises
    ------
    ValueError
        If a hash is not 64 hexadecimal digits, or a text holds a zero character.
    """
    texts = _Texts()
    parameters = np.ascontiguousarray(contents.parameters, "<f8")
    inputs = np.ascontiguousarray(contents.inputs, "<f8")
    variables = b"".join(_variable(variable, texts) for variable in contents.variables)
    reasons = b"".join(_REASON.pack(code, texts.place(text)) for code, text in contents.reasons.items())
    cautions = b"".join(_caution(caution, texts) for caution in contents.cautions)
    categories = b"".join(_CATEGORY.pack(texts.place(name), code) for name, code in contents.categories)
    tolerance = [i for i, variable in enumerate(contents.variables) if variable.name == "tolerance"]
    guid = texts.place(contents.guid)
    strings = texts.padded()
    numbers = _NUMBERS.pack(
        parameters.size,
        inputs.size,
        contents.state_size,
        contents.output_size,
        contents.work_size,
        contents.tunables,
        contents.time,
        tolerance[0] if tolerance else _NOWHERE,
        _NOWHERE if contents.ramped is None else contents.ramped,
        contents.journal,
        contents.journal_span,
        len(contents.variables),
        len(contents.reasons),
        len(contents.cautions),
        len(contents.categories),
        len(strings),
    )
    hashes = _hash(contents.kernels, "kernels") + _hash(contents.fingerprint, "fingerprint")
    body = (
        hashes
        + numbers
        + struct.pack("<3Q", guid, contents.led.start, len(contents.led))
        + parameters.tobytes()
        + inputs.tobytes()
    )
    body += variables + reasons + cautions + categories + strings
    checksum = hashlib.blake2b(body, digest_size=_DIGEST_SIZE).digest()
    return _MAGIC + struct.pack("<Q", _VERSION) + checksum + body


def _hash(digits: str, name: str) -> bytes:
    data = bytes.fromhex(digits)
    if len(data) != _DIGEST_SIZE:
        raise ValueError(f"{name} = {digits!r} must be {2 * _DIGEST_SIZE} hexadecimal digits")
    return data


def _variable(variable: Variable, texts: _Texts) -> bytes:
    value = variable.start if variable.value is None else variable.value
    text = value if isinstance(value, str) else ""
    causality = "local" if variable.causality == "constant" else variable.causality
    return _VARIABLE.pack(
        _TYPES.index(variable.type),
        _CAUSALITIES.index(causality),
        _VARIABILITIES.index(variable.variability),
        _ARRAYS.index(variable.array),
        variable.index,
        texts.place(variable.name),
        texts.place(variable.unit),
        texts.place(text),
        -math.inf if variable.min is None else variable.min,
        math.inf if variable.max is None else variable.max,
        0.0 if text or value is None else float(value),
    )


def _caution(caution: Caution, texts: _Texts) -> bytes:
    return _CAUTION.pack(
        caution.index,
        texts.place(caution.before),
        texts.place(caution.after),
        caution.decimals,
        _ARRAYS.index(caution.array),
        caution.above,
        caution.threshold,
        caution.scale,
    )


def model_bytes(model: "Model", guid: str, kernels_hash: str) -> bytes:
    """Return ``resources/model.bin`` of a model.

    Parameters
    ----------
    model : Model
    guid : str
        As in ``modelDescription.xml``.
    kernels_hash : str
        64 hexadecimal digits that name the equations of the library.

    Returns
    -------
    bytes
    """
    sizes = model.lengths
    return contents_bytes(
        Contents(
            guid=guid,
            kernels=kernels_hash,
            fingerprint=fingerprint(model),
            parameters=model.parameters,
            inputs=model.inputs,
            state_size=sizes.state,
            output_size=sizes.outputs,
            work_size=sizes.work,
            time=S.TIME,
            tunables=P.TUNABLE,
            variables=model.variables,
            ramped=U.SPEED,
            led=led_inputs(model.scene),
            journal=_JOURNAL,
            journal_span=_JOURNAL_SPAN[FIDELITIES[int(model.parameters[P.FIDELITY])]],
            reasons=reasons(model.parameters),
            cautions=cautions(model),
            categories=[(name, _STATUS_OF_CATEGORY[name]) for name in LOG_CATEGORIES],
        )
    )
