"""The one scalar of a page: a factor on the amplitudes of all imperfections, set at one measured point."""

from collections.abc import Callable
from dataclasses import dataclass

STEP_DB = 0.5  # the factor stands in half decibels: a finer one would only copy the measurement's own scatter
ROUNDS = 8
_GOOD = 0.5  # dB
_LIMIT_DB = 20.0  # either way: beyond ten times their size imperfections of 0.1 um are no tolerances any more


@dataclass(frozen=True)
class Calibration:
    """Result at the calibration point.

    Attributes
    ----------
    scale : float
        Factor on the amplitudes of all imperfections.
    target, untouched, reached : float
        Level there (dB): measured by the paper, with factor 1, with ``scale``.
    tries : tuple of (float, float)
        Factors (dB) tried and what they gave (dB).
    """

    scale: float
    target: float
    untouched: float
    reached: float
    tries: tuple[tuple[float, float], ...]

    @property
    def words(self) -> str:
        """Sentences, with a line for each try."""
        tried = ",\n".join(f"{db:+.1f} dB gives {found:.1f} dB" for db, found in self.tries)
        return (
            f"Factor on all imperfections: {self.scale:.3g}. Factors tried:\n{tried}.\n"
            f"Wanted: {self.target:.1f} dB; left over: {self.reached - self.target:+.1f} dB."
        )


def calibrate(target: float, level: Callable[[float], float], rounds: int = ROUNDS) -> Calibration:
    """Find the factor at which ``level(factor)`` (dB) comes closest to ``target`` (dB).

    Sound is nearly proportional to imperfections, so the first steps are the difference itself; once the
    target lies between two tries, they are halved. It ends where tries stand `STEP_DB` apart, or after
    ``rounds`` runs.
    """
    tries: dict[float, float] = {}
    db = 0.0
    while len(tries) < rounds and db not in tries:
        tries[db] = level(10.0 ** (db / 20.0))
        miss = target - tries[db]
        if abs(miss) <= _GOOD:
            break
        low = max((at for at, found in tries.items() if found <= target), default=None)
        high = min((at for at, found in tries.items() if found > target), default=None)
        wanted = db + miss if low is None or high is None else 0.5 * (low + high)
        db = min(max(STEP_DB * round(wanted / STEP_DB), -_LIMIT_DB), _LIMIT_DB)
    best = min(tries, key=lambda at: abs(tries[at] - target))
    return Calibration(10.0 ** (best / 20.0), target, tries[0.0], tries[best], tuple(tries.items()))
