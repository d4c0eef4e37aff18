"""A verdict: figure, limit, source of the limit, judgement, way out."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from fmu_bearing.formulas import iso281
from fmu_bearing.results.base import Quantity, Result

Judgement = Literal["good", "watch", "change", "not judged"]

#: From the gravest on.
JUDGEMENTS: tuple[Judgement, ...] = ("change", "watch", "good", "not judged")

#: h: life that is asked for where the scene asks for none: assumed, as machine tools are often laid out.
ASSUMED_LIFE = 20_000.0


@dataclass(frozen=True)
class Verdict(Result):
    """The judgement of one figure."""

    quantities = (
        "key", Quantity("label", ""), "value [as in the label]", Quantity("text", "value"),
        Quantity("judgement", "verdict"), Quantity("limit", "limit"),
        Quantity("source", "source of the limit"), "advice", "bearing [1]",
    )  # fmt: skip

    key: str
    """For machines."""
    label: str
    value: float | None
    """SI units, or the unit in the label."""
    text: str
    """The value as it is shown, with its unit."""
    limit: str
    """The limit in words."""
    source: str
    """Where the limit comes from."""
    judgement: Judgement
    """``good``, ``watch``, ``change`` or ``not judged``."""
    advice: str = ""
    """One sentence with figure, limit and way out; empty where all is good."""
    bearing: int | None = None
    """Of which bearing, from 1; None: of all together."""


def overall(verdicts: Iterable[Verdict]) -> Judgement:
    """Return the gravest of the judgements; ``not judged`` where no figure has a limit."""
    return min((one.judgement for one in verdicts), key=JUDGEMENTS.index, default="not judged")


def unjudged(key: str, label: str, why: str, value: float | None = None, text: str = "-") -> Verdict:
    """Return a figure that no limit is known for, with the reason in place of the source."""
    return Verdict(key, label, value, text, "none", why, "not judged")


def shown_hours(hours: float, figure: str = "") -> str:
    """Return a rating life (h) as ``figure`` or in whole hours, beyond `iso281.MOST_HOURS` without either."""
    return iso281.BEYOND_HOURS if hours > iso281.MOST_HOURS else figure or f"{hours:.0f}"


def judged_life(
    key: str, name: str, hours: float, required: float | None, source: str,
    remedy: str = "reduce preload or load, or take a larger bearing",
) -> Verdict:  # fmt: skip
    """Return the verdict on a rating life (h) by that asked for; None: by `ASSUMED_LIFE`."""
    wanted = ASSUMED_LIFE if required is None else required
    origin = "assumed" if required is None else "asked for"
    advice = ""
    if hours < wanted:
        way = "" if required else "give operation.required_life_h, "
        advice = (
            f"rating life {name} {shown_hours(hours)} h: below the {wanted:.0f} h that are {origin} "
            f"({source}): {way}{remedy}"
        )
    judgement: Judgement = "change" if advice else "good"
    limit = f"{wanted:.0f} {origin}"
    return Verdict(key, f"{name}, h", hours, shown_hours(hours), limit, source, judgement, advice)
