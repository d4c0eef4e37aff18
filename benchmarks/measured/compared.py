"""All values beside what the package computes, with the range over what is assumed, source by source."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from benchmarks.measured import defects, friction, motion, stiffness
from benchmarks.measured.sources import NAN, OTHER_BALLS, Value, of
from fmu_bearing.progress import Tell, silent


@dataclass(frozen=True)
class Compared:
    """A value of others and ours.

    ``low`` and ``high``: what ours is at the ends of the range of what is assumed, each input moved alone;
    ``difference``: whether ours less theirs says more than ours over theirs; ``counts``: whether the value is
    part of the source's figures.
    """

    value: Value
    ours: float
    low: float
    high: float
    difference: bool = False
    counts: bool = True

    @property
    def theirs(self) -> float:
        """The value, the middle of a range."""
        one = self.value
        return one.published if math.isnan(one.published_to) else 0.5 * (one.published + one.published_to)

    def beside(self, ours: float) -> float:
        """Return one of ours over theirs, or less theirs."""
        return ours - self.theirs if self.difference else ours / self.theirs

    @property
    def found(self) -> float:
        """Ours over theirs, or less theirs."""
        return self.beside(self.ours)


def _moved(
    value: Value, compute: Callable[..., float], moves: Mapping[str, friction.Moved], difference: bool = False
) -> Compared:  # fmt: skip
    ours = compute(value)
    every = [ours, *(compute(value, one) for one in moves.values())]
    return Compared(value, ours, min(every), max(every), difference)


def _by_grooves(
    found: Iterable[Value], compute: Callable[[Value, tuple[float, float]], float], difference: bool = False
) -> list[Compared]:
    rows = []
    for one in found:
        ours, *ends = (compute(one, grooves) for grooves in (stiffness.RULE, *stiffness.ENDS))
        counts = not (one.source == "tpi" and OTHER_BALLS in one.bearing)
        rows.append(Compared(one, ours, min(ours, *ends), max(ours, *ends), difference, counts))
    return rows


def nsk() -> list[Compared]:
    """Return NSK's pairs."""
    return _by_grooves(of("nsk"), stiffness.pair_stiffness)


def tpi() -> list[Compared]:
    """Return TPI's pairs: stiffness, offset of the faces, ceramic over steel balls."""
    found = _by_grooves(of("tpi", "pair"), stiffness.pair_stiffness)
    found += _by_grooves(of("tpi", "face"), stiffness.face_offset, difference=True)
    for one, printed, ours in stiffness.ceramic_over_steel():
        value = dataclasses.replace(
            one, quantity="stiffness with ceramic over steel balls", unit="-", published=printed,
            place="tables 5 to 9, two rows at equal load",
        )  # fmt: skip
        found.append(Compared(value, ours, ours, ours))
    return found


def ibc() -> list[Compared]:
    """Return the rules of thumb: radial over axial stiffness, lift-off over preload."""
    choices = (stiffness.RULE, *stiffness.ENDS)
    every = [stiffness.radial_over_axial(grooves) for grooves in choices]
    found = []
    for one in of("ibc", "radial"):
        grades = [key for key in every[0] if key[0] == one.angle_deg and one.grade in (key[1], "EL-H")]
        for key in grades:
            each = [ratios[key] for ratios in every]
            value = dataclasses.replace(one, grade=key[1])
            found.append(Compared(value, each[0], min(each), max(each)))
    (rule,) = of("ibc", "lift-off")
    lifts = [stiffness.lift_off(grooves) for grooves in choices]
    for angle, load in lifts[0]:
        each = [one[angle, load] for one in lifts]
        value = dataclasses.replace(rule, angle_deg=angle, load_N=load)
        found.append(Compared(value, each[0], min(each), max(each)))
    return found


def skf() -> list[Compared]:
    """Return the torque of the 7210B."""
    return [_moved(one, friction.contact_torque, friction.MOVES_7210B) for one in of("skf")]


def ntn() -> list[Compared]:
    """Return the friction coefficient of the 7210B at 4,000 N beside NTN's range."""
    (one,) = of("ntn")
    at = [value for value in of("skf") if value.load_N == 4000.0 and value.speed_rpm >= 1500.0]
    each = [friction.friction_coefficient(value) for value in at]
    return [Compared(one, float(np.median(each)), min(each), max(each))]


def tp2275() -> list[Compared]:
    """Return the heat of the 35 mm bearing."""
    return [_moved(one, friction.heat_35, friction.MOVES_35) for one in of("tp2275")]


def asme() -> list[Compared]:
    """Return the heat of the 35 mm bearing with ceramic over that with steel balls."""
    return [_moved(one, friction.hybrid_over_steel, friction.MOVES_35) for one in of("asme")]


def cwru() -> list[Compared]:
    """Return the cage's speed of the 6205."""
    found = []
    for one in of("cwru"):
        ours, steep = (motion.cage_ratio(one, angle) for angle in motion.ANGLES)
        found.append(Compared(one, ours, ours, steep))
    return found


def cwru_pits() -> list[Compared]:
    """Return side bands and places of the pits of the 6205."""
    found = []
    for one in of("cwru_pits"):
        each = [defects.cwru_value(one, loads) for loads in defects.LOADS]
        found.append(Compared(one, each[0], min(each), max(each)))
    return found


def mfpt() -> list[Compared]:
    """Return how a bearing with faults follows its load."""
    found = []
    for one in of("mfpt"):
        each = [defects.mfpt_value(one, size) for size in defects.SIZES]
        base = one.quantity.startswith(("rms", "kurtosis")) and one.load_N == defects.LEAST
        found.append(Compared(one, each[0], min(each), max(each), counts=not base))
    return found


def paderborn() -> list[Compared]:
    """Return the slip of cages."""
    bound = motion.SLIP_BOUND
    return [Compared(one, 0.0, -bound, bound, difference=True) for one in of("paderborn")]


def kyk() -> list[Compared]:
    """Return the vibration of a 7003C beside limits of deep groove bearings, bore 15."""
    found = []
    for one in of("kyk"):
        band = one.quantity.split(", ")[1].split()[0]
        each = [motion.bands(grade, seed)[band] for grade, seed in
                (("P4", 1), ("P4", 2), ("P4", 3), ("P2", 1), ("P5", 1))]  # fmt: skip
        near = one.bearing.endswith("15")
        found.append(Compared(one, each[0], min(each), max(each), counts=near and one.grade == "V3"))
    return found


def tnd7870() -> list[Compared]:
    """Return the skid of the 120 mm bearing, which is not computed."""
    return [Compared(one, NAN, NAN, NAN, counts=False) for one in of("tnd7870")]


#: Sources in the order of the table of values.
SOURCES = (nsk, tpi, ibc, skf, tp2275, asme, ntn, cwru, cwru_pits, mfpt, paderborn, kyk, tnd7870)


def everything(tell: Tell = silent) -> dict[str, list[Compared]]:
    """Return all values beside ours by source; about four minutes of a processor."""
    found = {}
    for source in SOURCES:
        tell(f"{source.__name__} ...")
        found[source.__name__] = source()
    return found
