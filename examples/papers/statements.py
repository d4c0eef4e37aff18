"""Statements of a paper that need no absolute level: judged seed by seed, then put into one of four classes.

================================  ========================================================================
*holds*                           for all seeds
*does not hold*                   for none
*chance*                          it depends on the draw: the paper's inputs have no cause for it, or it holds
                                  for some seeds; the count is given
*contradicts mechanics*           a proof of one line says why no such bearing can do it
================================  ========================================================================

A statement about an order (*above*, *largest*) holds where every margin is positive. A trend whose size the
paper prints holds only where ours has its sign and comes within 3 dB of it or within a factor of 1.5.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

HOLDS, NOT, UNSEEN = "holds", "does not hold", "not judged"
CHANCE, AGAINST = "chance", "contradicts mechanics"
CLASSES = (HOLDS, NOT, CHANCE, AGAINST)
FACTOR, WITHIN_DB = 1.5, 3.0
_NAMED = 3  # cases named that a statement fails in


@dataclass(frozen=True)
class Judged:
    """A statement, its verdict for one seed, and the figures it rests on."""

    statement: str
    verdict: str
    figures: str
    margins: tuple[float, ...] = ()


@dataclass(frozen=True)
class Reason:
    """Why a statement is chance or contradicts mechanics, in one line; decided before any run."""

    kind: str
    line: str

    def __post_init__(self) -> None:
        if self.kind not in (CHANCE, AGAINST) or not self.line.strip():
            raise ValueError(f"a reason is for {CHANCE} or {AGAINST}, and gives it: {self}")


@dataclass(frozen=True)
class Classed:
    """A statement with its class.

    Attributes
    ----------
    statement, kind : str
    holds, seeds : int
        For how many seeds it holds, of those it was judged for.
    share : float
        Share of single comparisons that hold, over all seeds.
    figures : str
        Of the first seed.
    reason : str
    """

    statement: str
    kind: str
    holds: int
    seeds: int
    share: float
    figures: str
    reason: str = ""


def verdict(statement: str, margins: Sequence[tuple[str, float]], unit: str = "dB") -> Judged:
    """Judge a statement that holds where every margin is positive; margins go by the name of their case."""
    if not margins:
        return Judged(statement, UNSEEN, "")
    numbers = tuple(margin for _, margin in margins)
    bad = [f"{name} ({margin:+.1f})" for name, margin in margins if not margin > 0.0]
    low, high = min(numbers), max(numbers)
    spread = f"{low:+.1f} to {high:+.1f} {unit}" if len(margins) > 1 else f"{low:+.1f} {unit}"
    if not bad:
        return Judged(statement, HOLDS, spread, numbers)
    if len(bad) == len(margins):
        return Judged(statement, NOT, spread if len(bad) == 1 else f"nowhere: {spread}", numbers)
    shown = ", ".join(bad[:_NAMED]) + (f" and {len(bad) - _NAMED} more" if len(bad) > _NAMED else "")
    share = f"in {len(margins) - len(bad)} of {len(margins)}"
    return Judged(statement, NOT, f"{share}: {spread}; not at {shown}", numbers)


def trend(statement: str, changes: Sequence[tuple[str, float, float]], unit: str = "dB") -> Judged:
    """Judge changes by sign and size: each is (name of its case, the paper's, ours).

    The margin of one is the smaller of ours in the paper's direction, and what is left of 3 dB or of the
    factor 1.5, whichever is more generous.
    """
    found = verdict(statement, [(name, _like(paper, ours)) for name, paper, ours in changes], unit)
    pairs = ", ".join(f"{name}: {paper:+.1f} / {ours:+.1f} {unit}" for name, paper, ours in changes)
    return Judged(statement, found.verdict, f"paper / ours {pairs}" if pairs else "", found.margins)


def both(order: Judged, size: Judged) -> Judged:
    """Join an order and the size of its trend under the order's words: it holds where both do."""
    if UNSEEN in (order.verdict, size.verdict):
        return order
    holds = order.verdict == size.verdict == HOLDS
    return Judged(
        order.statement, HOLDS if holds else NOT, f"{order.figures}; {size.figures}",
        order.margins + size.margins,
    )  # fmt: skip


def _like(paper: float, ours: float) -> float:
    """Margin by which a change is like the paper's."""
    size, along = abs(paper), ours if paper > 0.0 else -ours
    near = WITHIN_DB - abs(along - size)
    ratio = min(FACTOR * size - along, along - size / FACTOR)
    return min(along, max(near, ratio))


def classed(by_seed: Sequence[Sequence[Judged]], reasons: Mapping[str, Reason]) -> list[Classed]:
    """Put statements, judged for each seed in one order, into their classes.

    Raises
    ------
    ValueError
        When a reason belongs to no statement, or seeds judged different statements.
    """
    names = [one.statement for one in by_seed[0]]
    for judged in by_seed:
        if [one.statement for one in judged] != names:
            raise ValueError("every seed must be judged on the same statements")
    if unknown := set(reasons) - set(names):
        raise ValueError(f"a reason for what nobody states: {', '.join(sorted(unknown))}")
    return [_one([judged[k] for judged in by_seed], reasons.get(name)) for k, name in enumerate(names)]


def _one(same: Sequence[Judged], reason: Reason | None) -> Classed:
    """Class of one statement from its verdicts."""
    seen = [one for one in same if one.verdict != UNSEEN]
    count, holds = len(seen), sum(one.verdict == HOLDS for one in seen)
    margins = [margin for one in seen for margin in one.margins]
    share = sum(margin > 0.0 for margin in margins) / len(margins) if margins else 0.0
    if not seen:
        kind = UNSEEN
    else:
        kind = by_count(holds, count)
        if reason is not None and kind != HOLDS:  # what our own runs do is neither impossible nor a draw
            kind = reason.kind
    line = "" if reason is None or kind == HOLDS else reason.line
    return Classed(same[0].statement, kind, holds, count, share, same[0].figures, line)


def by_count(holds: int, count: int) -> str:
    """Class of a statement from the number of seeds it holds for: they have to agree."""
    if holds == count:
        return HOLDS
    return CHANCE if holds else NOT


def counts(found: Sequence[Classed]) -> str:
    """How many statements fall into each class."""
    classes = ", ".join(
        f"{number} *{kind}*"
        for kind in (*CLASSES, UNSEEN)
        if (number := sum(one.kind == kind for one in found)) or kind in (HOLDS, NOT)
    )
    return f"Of {len(found)} statements: {classes}"
