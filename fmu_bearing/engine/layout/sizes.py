"""Lengths that several arrays share, and :class:`Places`, which hands out places one after the other."""

STRIDE = 40  # lanes per ball quantity: no power of two, so that rows spread over cache sets
MAX_BALLS = 36
FOUR = 4  # balls computed at a time: numbers of lanes are multiples of it
STAGES = 6  # of a Runge-Kutta method at most
BALL_ORDERS = 80  # zonal orders of a ball's form at most
MAX_MODES = 16  # flexural modes of both rings
MAX_DEFECTS = 8  # local defects of a scene


class Places:
    """Hands out places one after the other: ``MASS = at()``, ``AXIS = at(3)``.

    Parameters
    ----------
    first : int
        The first place.

    Attributes
    ----------
    next : int
        The first place not handed out yet.
    """

    def __init__(self, first: int = 0) -> None:
        self.next = first

    def __call__(self, count: int = 1) -> int:
        """Return the first of ``count`` places and move on behind them."""
        place = self.next
        self.next += count
        return place
