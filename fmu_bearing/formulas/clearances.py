"""Radial internal clearance of deep groove ball bearings by its group (ISO 5753-1, cylindrical bore).

The limits are those that KTA prints for bores up to 120 mm (ktaiballbearing.com, internal clearance); a
print of another maker, JFB, has the same but for misprints. The standard itself was not read.
"""

from typing import Literal, NamedTuple

#: Groups of clearance, from the smallest on; CN is the normal one.
Group = Literal["C2", "CN", "C3", "C4"]
GROUPS: tuple[Group, ...] = ("C2", "CN", "C3", "C4")
#: Bore (mm) up to which a row holds, the row before being below; limits (um) of each of `GROUPS`.
_ROWS = (
    (10.0, (0, 7), (2, 13), (8, 23), (14, 29)),
    (18.0, (0, 9), (3, 18), (11, 25), (18, 33)),
    (24.0, (0, 10), (5, 20), (13, 28), (20, 36)),
    (30.0, (1, 11), (5, 20), (13, 28), (23, 41)),
    (40.0, (1, 11), (6, 20), (15, 33), (28, 46)),
    (50.0, (1, 11), (6, 23), (18, 36), (30, 51)),
    (65.0, (1, 15), (8, 28), (23, 43), (38, 61)),
    (80.0, (1, 15), (10, 30), (25, 51), (46, 71)),
    (100.0, (1, 18), (12, 36), (30, 58), (53, 84)),
    (120.0, (2, 20), (15, 41), (36, 66), (61, 97)),
)
#: mm: bores for which groups are known.
LEAST_BORE, MOST_BORE = 2.5, _ROWS[-1][0]


class Limits(NamedTuple):
    """Least and largest radial clearance (um) of a group."""

    low: float
    high: float

    @property
    def middle(self) -> float:
        """Middle of both, um."""
        return 0.5 * (self.low + self.high)


def limits(group: Group, bore: float) -> Limits | None:
    """Return the limits (um) of a group at a bore (mm); None for bores of which none are known."""
    if not LEAST_BORE <= bore <= MOST_BORE:
        return None
    row = next(row for row in _ROWS if bore <= row[0])
    return Limits(*row[1:][GROUPS.index(group)])
