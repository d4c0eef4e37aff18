"""A run-up of either build, which a child process repeats."""

from .conftest import OK

SIZE = 1e-4  # s
STEPS = 60
FROM, TO = 200.0, 2000.0  # rad/s


def speed(i):
    """Of the shaft at the end of step i: it rises each step."""
    return FROM + (TO - FROM) * (i + 1) / STEPS


def run_up(bearing, begin=0, end=STEPS):
    """All values after each step; the preload changes on the way as well."""
    taken = []
    for i in range(begin, end):
        assert bearing.set("shaft_speed", speed(i)) == OK
        assert bearing.set("preload", 500.0 - i) == OK
        assert bearing.step(i * SIZE, SIZE) == OK
        taken.append(bearing.everything())
    return taken
