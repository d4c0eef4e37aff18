"""How far computed figures were from what others measured or printed, in a line each.

The figures are those of the page `Measured by others` (docs/measured.md), of which `make measured` makes the
tables; a test holds them beside docs/results/measured.csv.
"""

from typing import NamedTuple

#: The page by its title: who installed a wheel has no folder docs.
PAGE = 'page "Measured by others" of the documentation'


class Range(NamedTuple):
    """The least and the largest of some values."""

    low: float
    high: float

    @property
    def words(self) -> str:
        """In words."""
        return f"{self.low:.2f} to {self.high:.2f}"


# Computed over measured or printed values.
#: Axial stiffness of 408 pairs of NSK and TPI, with the conformities of a bearing from dimensions.
STIFFNESS = Range(0.95, 1.10)
#: Torque of rolling and sliding of a 7210B to 3,000 r/min, over SKF's model: 27 values.
TORQUE = Range(0.84, 1.42)
#: Heat of a 35 mm bearing with jets at 28,000 to 72,000 r/min, over NASA's measurement: 4 values.
HEAT = Range(0.85, 1.24)


def measured_elsewhere() -> dict[str, str]:
    """Return computed figures over what others measured or print, in a line each by figure.

    Returns
    -------
    dict of str to str
        ``torque``, ``stiffness``, ``life and level``, and ``all values``: the page that has them.
    """
    return {
        "torque": f"{TORQUE.words} of SKF's, heat {HEAT.words} of NASA's",
        "stiffness": f"{STIFFNESS.words} of NSK's and TPI's pairs",
        "life and level": "no measured values are known",
        "all values": PAGE,
    }
