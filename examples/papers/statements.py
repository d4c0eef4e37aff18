"""Statements of a paper that need no absolute level: judged seed by seed, then put into one class.

The classes and their rules are `CLASSES`, the one definition of all pages; :func:`classed` applies it. A
statement about an order (*above*, *largest*) holds where every margin is positive. A trend whose size the
paper prints holds only where ours has its sign and comes within 3 dB of it or within a factor of 1.5.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fmu_bearing.results.table import markdown

HOLDS, NOT, CHANCE = "holds", "does not hold", "chance"
BUILT, UNSEEN = "by construction", "not decidable"
#: Each class and its rule. No class is given by an argument: what mechanics says is a remark beside it.
CLASSES = {
    HOLDS: "for every seed",
    NOT: "for no seed",
    CHANCE: "for some seeds and not for others: the draw of waves, sizes and angles decides",
    BUILT: "an input of the scene was set to it before any run; counts neither way",
    UNSEEN: "nothing in these runs can show it; counts neither way",
}
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
class Remark:
    """One line beside a statement, decided before any run; ``built``: it holds by an input of the scene."""

    line: str
    built: bool = False


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
    remark : str
    """

    statement: str
    kind: str
    holds: int
    seeds: int
    share: float
    figures: str
    remark: str = ""

    @property
    def refutable(self) -> bool:
        """Whether our runs could have shown the opposite."""
        return self.kind not in (BUILT, UNSEEN)


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


def classed(by_seed: Sequence[Sequence[Judged]], remarks: Mapping[str, Remark]) -> list[Classed]:
    """Put statements, judged for each seed in one order, into their classes.

    Raises
    ------
    ValueError
        When a remark belongs to no statement, or seeds judged different statements.
    """
    names = [one.statement for one in by_seed[0]]
    for judged in by_seed:
        if [one.statement for one in judged] != names:
            raise ValueError("every seed must be judged on the same statements")
    if unknown := set(remarks) - set(names):
        raise ValueError(f"a remark on what nobody states: {', '.join(sorted(unknown))}")
    return [_one([judged[k] for judged in by_seed], remarks.get(name)) for k, name in enumerate(names)]


def _one(same: Sequence[Judged], remark: Remark | None) -> Classed:
    """Class of one statement from its verdicts."""
    seen = [one for one in same if one.verdict != UNSEEN]
    count, holds = len(seen), sum(one.verdict == HOLDS for one in seen)
    margins = [margin for one in seen for margin in one.margins]
    share = sum(margin > 0.0 for margin in margins) / len(margins) if margins else 0.0
    kind = by_count(holds, count)
    if remark is not None and remark.built and kind != UNSEEN:
        kind = BUILT
    return Classed(
        same[0].statement, kind, holds, count, share, same[0].figures, "" if remark is None else remark.line
    )


def by_count(holds: int, count: int) -> str:
    """Class of a statement from the number of seeds it holds for: they have to agree."""
    if not count:
        return UNSEEN
    if holds == count:
        return HOLDS
    return CHANCE if holds else NOT


def counts(found: Sequence[Classed]) -> str:
    """How many statements fall into each class; those that no run can refute are counted apart."""
    number = {kind: sum(one.kind == kind for one in found) for kind in CLASSES}
    refutable = sum(one.refutable for one in found)
    judged = [f"{number[kind]} *{kind}*" for kind in (HOLDS, NOT, CHANCE)]
    apart = [f"{number[kind]} *{kind}*" for kind in (BUILT, UNSEEN) if number[kind]]
    beside = f"; beside them {', '.join(apart)}" if apart else ""
    return f"Of {refutable} statements that runs can refute: {', '.join(judged)}{beside}"


def classes_table() -> str:
    """Return the one definition of the classes, as a table."""
    return markdown(["class", "rule"], [[f"*{kind}*", rule] for kind, rule in CLASSES.items()])
