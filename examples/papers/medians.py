"""Medians of results over neighbouring speeds and seeds."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from examples.papers.case import Case


def median(results: Sequence[Any]) -> Any:
    """Return the median of each number in results of one form: numbers in mappings and lists of one shape.

    Raises
    ------
    ValueError
        When the forms differ.
    """
    first = results[0]
    if isinstance(first, dict):
        if any(set(one) != set(first) for one in results):
            raise ValueError("results of different forms have no median")
        return {key: median([one[key] for one in results]) for key in first}
    return np.median(np.array(results, dtype=float), axis=0).tolist()


def by_seed(found: Iterable[tuple[Case, dict[str, Any]]]) -> dict[int, dict[int, dict[str, Any]]]:
    """Return the median over the speeds around each speed, by seed and speed (r/min)."""
    grouped: dict[int, dict[int, list[dict[str, Any]]]] = {}
    for case, result in found:
        grouped.setdefault(case.seed, {}).setdefault(int(case.rpm), []).append(result)
    return {
        seed: {rpm: median(results) for rpm, results in sorted(speeds.items())}
        for seed, speeds in sorted(grouped.items())
    }
