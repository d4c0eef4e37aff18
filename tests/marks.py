"""Parameters of a test of which some are quick and the others, which repeat it for other cases, are heavy."""

import pytest


def heavy_but(values, *quick):
    """Return parameters, all heavy but those in ``quick``.

    These are named by their place (int) or their text, for tuples the texts joined by hyphens.
    """
    rows = [value if isinstance(value, tuple) else (value,) for value in values]
    names = ["-".join(map(str, row)) for row in rows]
    places = {one if isinstance(one, int) else names.index(one) for one in quick}
    assert max(places) < len(rows)
    return [pytest.param(*row, marks=[pytest.mark.heavy] * (k not in places)) for k, row in enumerate(rows)]
