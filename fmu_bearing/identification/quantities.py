"""Quantities of a measurement: levels, third octaves, lines, of sound pressure or of a body's velocity."""

import re
from dataclasses import dataclass, replace

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.acoustics.analysis.third_octave import centre_frequencies, nominal_frequency
from fmu_bearing.acoustics.filters.weighting import band_centre
from fmu_bearing.engine.layout import SD
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.interface.names import UnknownName, known
from fmu_bearing.run.figures import A_LEVEL, LEVEL, RINGS, THIRD_OCTAVE, rings_of
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import bearings_of, set_of

LINE, VELOCITY = "line", "velocity"
#: How a quantity is written, for messages.
EXAMPLES = (
    "leq", "leq_a", "third_octave[1000]", "line[f_r]", "line[f_i - 2 f_r]", "line[467 Hz]",
    "velocity[outer_ring.z]", "velocity_third_octave[outer_ring.z 1000]", "velocity_line[outer_ring.z f_r]",
)  # fmt: skip
_KINDS = (LEVEL, A_LEVEL, THIRD_OCTAVE, LINE, VELOCITY, f"{VELOCITY}_{THIRD_OCTAVE}", f"{VELOCITY}_{LINE}")
_SYNTAX = re.compile(r"(\w+)(?:\[\s*(.*?)\s*\])?")
#: A single bearing's housing is fixed to the outer ring and moves with it; that of a set moves with the outer
#: rings that are fixed in it.
_SINGLE = {ring: (0, k) for k, ring in enumerate(RINGS)} | {"housing": (0, 1)}
_EXAMPLE = "velocity[outer_ring.z]"
_RING_OF_SET = (
    "inner_ring or outer_ring with its bearing, such as velocity[bearing[1].outer_ring.z]: the shaft moves "
    "with the inner rings, the housing with the outer rings that are fixed in it"
)
_AXES = {"x": 0, "y": 1, "z": 2}
_TERM = re.compile(r"\s*([+-]?)\s*(\d*)\s*\*?\s*(f_[rcbio])\b\s*")
_HERTZ = re.compile(r"(\d+(?:\.\d+)?)\s*(k?)Hz")


@dataclass(frozen=True)
class Quantity:
    """One measured quantity.

    Attributes
    ----------
    text : str
        As it is written in the data.
    kind : str
        ``"leq"``, ``"leq_a"``, ``"third_octave"`` or ``"line"``.
    channel : int, optional
        Velocity of a body: place of its acceleration among its bearing's channels; None: sound pressure.
    frequency : float
        Centre of the third octave, or of a line of fixed frequency (Hz); 0 for others.
    terms : tuple of (int, str)
        A line that follows the speed: factors of kinematic frequencies, ``((1, "f_i"), (-2, "f_r"))``.
    bearing : int
        Whose body it is, from 0.
    """

    text: str
    kind: str
    channel: int | None = None
    frequency: float = 0.0
    terms: tuple[tuple[int, str], ...] = ()
    bearing: int = 0

    def line(self, kinematics: KinematicFrequencies) -> float:
        """Frequency (Hz) of the line."""
        if not self.terms:
            return self.frequency
        return sum(factor * float(getattr(kinematics, name)) for factor, name in self.terms)


def parse_quantity(text: str, scene: Scene | None = None) -> Quantity:
    """Read a quantity, such as ``line[2 f_r]``.

    ``scene``: a set's bodies are named with their bearing, as in ``velocity[bearing[2].outer_ring.z]``;
    default: a scene of one bearing.

    Raises
    ------
    IdentifyError
        With the quantities that there are.
    """
    match = _SYNTAX.fullmatch(text.strip())
    try:
        kind = known(match[1] if match else text, _KINDS, "quantity")
    except UnknownName as problem:
        raise IdentifyError(f"{problem}; write for example {', '.join(EXAMPLES)}") from None
    assert match is not None
    inside = match[2] or ""
    channel, bearing = None, 0
    if kind.startswith(VELOCITY):
        body, _, inside = inside.partition(" ")
        bearing, channel = _channel(text, body, scene)
        kind = kind.removeprefix(VELOCITY).lstrip("_") or LEVEL
    inside = inside.strip()
    if kind in (LEVEL, A_LEVEL):
        if inside:
            raise IdentifyError(f"quantity '{text}': '{inside}' is too much; write {_like(kind, channel)}")
        return Quantity(text, kind, channel, bearing=bearing)
    if kind == THIRD_OCTAVE:
        return Quantity(text, kind, channel, _band(text, inside), bearing=bearing)
    return replace(_line(text, channel, inside), bearing=bearing)


def _channel(text: str, body: str, scene: Scene | None) -> tuple[int, int]:
    """Bearing, from 0, and place among its channels."""
    of_set = scene if scene is not None and scene.assembly.joined else None
    bodies = _SINGLE if of_set is None else rings_of(of_set)
    name, _, axis = body.rpartition(".")
    if name not in bodies or axis not in _AXES:
        where, way = "a body", f"one of {', '.join(bodies)}, a dot and x, y or z, such as {_EXAMPLE}"
        if of_set is not None:
            where, way = f"a ring of this set of {len(of_set.assembly.members)} bearings", _RING_OF_SET
        raise IdentifyError(f"quantity '{text}': '{body}' is not a direction of {where}; write {way}")
    bearing, ring = bodies[name]
    if of_set is not None and RINGS[ring] == "outer_ring":
        seat = bearings_of(of_set)[bearing].seat
        seated = seat == "fixed" or (seat == "sliding" and axis != "x")
        if seated and not set_of(of_set).housing.moves:
            raise IdentifyError(
                f"quantity '{text}': this ring is held in a housing that does not move; give the housing's "
                "mass_kg in [spindle.housing], or measure inner_ring, which moves with the shaft"
            )
    return bearing, SD.c_body(ring, _AXES[axis])


def _like(kind: str, channel: int | None) -> str:
    return kind if channel is None else _EXAMPLE


def _band(text: str, inside: str) -> float:
    try:
        nominal = float(inside.removesuffix("Hz"))
        centre = band_centre(nominal)
    except (ValueError, ArithmeticError):
        raise IdentifyError(
            f"quantity '{text}': '{inside}' is not a centre of a third octave; write third_octave[1000] (Hz)"
        ) from None
    there = [nominal_frequency(f) for f in centre_frequencies(SD.RATE)]
    if nominal not in there:
        near = min(there, key=lambda f: abs(f - nominal))
        raise IdentifyError(
            f"quantity '{text}': {nominal:g} Hz is not a nominal centre of a third octave between 20 Hz and "
            f"20 kHz; the nearest is {near:g}"
        )
    return centre


def _line(text: str, channel: int | None, inside: str) -> Quantity:
    hertz = _HERTZ.fullmatch(inside)
    if hertz is not None:
        frequency = float(hertz[1]) * (1e3 if hertz[2] else 1.0)
        if not 20.0 <= frequency <= 20_000.0:
            raise IdentifyError(f"quantity '{text}': {frequency:g} Hz lies outside 20 Hz to 20 kHz")
        return Quantity(text, LINE, channel, frequency)
    terms: list[tuple[int, str]] = []
    end = 0
    while inside and end < len(inside):
        match = _TERM.match(inside, end)
        if match is None or (terms and not match[1]):
            break
        terms.append((int(f"{match[1]}{match[2] or 1}"), match[3]))
        end = match.end()
    if not terms or end < len(inside):
        raise IdentifyError(
            f"quantity '{text}': '{inside}' is not a line; write a frequency with its unit, line[467 Hz], or "
            "kinematic frequencies f_r, f_c, f_b, f_i, f_o: line[2 f_r], line[f_i - 2 f_r]"
        )
    return Quantity(text, LINE, channel, 0.0, tuple(terms))
