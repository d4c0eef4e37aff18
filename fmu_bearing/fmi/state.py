"""The state of an FMU instance: copied, restored, written to bytes and read again.

Layout of the bytes: magic and version, the engine's hash, the model's fingerprint, a checksum of what
follows, then the arrays, little-endian, each with its length. The fingerprint depends on the engine, too: the
engine's own hash is there for the reason of a refusal.
"""

import hashlib
import struct
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.sources import engine_digest

__all__ = ["State", "StateError"]

_MAGIC = b"fmu-bearing state 2\n"
_DIGEST = 32  # bytes of a hash
_SHOWN = 8  # bytes of a hash that a message gives, as the shim does
_BODY = len(_MAGIC) + 3 * _DIGEST  # where it begins
_HEAD = struct.Struct("<d7Q")  # time; phase, settled, lengths of the arrays and of the notes


class StateError(ValueError):
    """Bytes that are not a state of this model."""


@dataclass(frozen=True)
class State:
    """All that a later call depends on.

    Attributes
    ----------
    phase : int
        Place of the phase in the life of an instance.
    time : float
        Time reached (s).
    inputs, tunables, outputs, engine : ndarray
        Arrays ``u``, head of ``p``, ``z`` and ``s`` of the engine.
    settled : bool
        Whether the engine has been initialised.
    wrong : tuple of (int, str)
        Values that were refused, by reference, and why.
    """

    phase: int
    time: float
    inputs: NDArray[np.float64]
    tunables: NDArray[np.float64]
    outputs: NDArray[np.float64]
    engine: NDArray[np.float64]
    settled: bool = False
    wrong: tuple[tuple[int, str], ...] = ()

    def to_bytes(self, fingerprint: str) -> bytes:
        """Return the state as bytes, bound to the model with that fingerprint."""
        arrays = (self.inputs, self.tunables, self.outputs, self.engine)
        notes = "".join(f"{key}\t{text}\x00" for key, text in self.wrong).encode("utf-8")
        sizes = (array.size for array in arrays)
        head = _HEAD.pack(self.time, self.phase, self.settled, *sizes, len(notes))
        body = head + b"".join(array.astype("<f8").tobytes() for array in arrays) + notes
        return _MAGIC + engine_digest() + bytes.fromhex(fingerprint) + hashlib.sha256(body).digest() + body

    @classmethod
    def from_bytes(cls, data: bytes, fingerprint: str) -> "State":
        """Read a state back.

        Raises
        ------
        StateError
            If the bytes are no state, of another version, of another engine, of another model, or damaged.
        """
        if not data.startswith(_MAGIC):
            raise StateError("these bytes are not a state that this version of fmu-bearing can read")
        made_by, model, checksum = (data[at : at + _DIGEST] for at in range(len(_MAGIC), _BODY, _DIGEST))
        if made_by != engine_digest():
            raise StateError(
                f"the state was made by another version of the engine, {made_by[:_SHOWN].hex()}, and this "
                f"FMU has {engine_digest()[:_SHOWN].hex()}: set it in the FMU that made it, or take a new "
                "one here"
            )
        if model != bytes.fromhex(fingerprint):
            raise StateError(
                f"the state belongs to another model, {model[:_SHOWN].hex()}, and this is "
                f"{fingerprint[: 2 * _SHOWN]}: its scene is another, or was prepared by another version of "
                "fmu-bearing; set it in an FMU of that model, or take a new one here"
            )
        body = data[_BODY:]
        if hashlib.sha256(body).digest() != checksum:
            raise StateError("the state is damaged: its checksum does not hold")
        if len(body) < _HEAD.size:
            raise StateError("the state is cut off")
        time, phase, settled, *sizes, notes_size = _HEAD.unpack_from(body)
        position = _HEAD.size
        if len(body) != (wanted := position + 8 * sum(sizes) + notes_size):
            raise StateError(f"the state is damaged: it has {len(body)} bytes, its arrays take {wanted}")
        arrays = []
        for size in sizes:
            arrays.append(np.frombuffer(body, "<f8", size, position).astype(np.float64))
            position += 8 * size
        notes = body[position : position + notes_size].decode("utf-8").split("\x00")[:-1]
        pairs = (note.split("\t", 1) for note in notes)
        wrong = tuple((int(key), text) for key, text in pairs)
        inputs, tunables, outputs, engine = arrays
        return cls(phase, time, inputs, tunables, outputs, engine, settled=bool(settled), wrong=wrong)
