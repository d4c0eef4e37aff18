"""Points, components and lines of the multi-source paper, and its statements on them."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from examples.papers.hearing import NAMES
from examples.papers.reduced import LINES, STEP
from examples.papers.statements import UNSEEN, WITHIN_DB, Judged, Remark, verdict
from examples.papers.values import Value

SPEEDS = tuple(range(10000, 40001, 1000))
SPECTRA = (20000, 25000, 28000, 30000)
POINTS = ("P1", "P2", "P3", "P4")
PARTS = ("outer_ring", "inner_ring", "balls", "cage")
PEAK_DB = 6.0  # chosen: what a peak stands out by
_BESIDE = 10  # steps of the spectrum: 200 Hz
HALF_DB = 3.0  # what a part of the sound adds to the rest when it has half of the energy
_DIPOLE = (
    "a rigid round body shaken across its axis is a dipole, silent on the axis (cos 90 deg): the scene has "
    "no foot, floor or front cover that break the symmetry"
)
_EQUAL = (
    "not from the form of the balls: order 2 sounds at 2 f_b, equal balls on perfect races at f_o; f_b needs "
    "odd orders or a dent, which the scene has none of"
)
#: Remarks on statements, decided before any run.
REMARKS = {
    "P4 between P2 and P1": Remark(_DIPOLE),
    "every point loudest at 28,000 r/min": Remark(_DIPOLE),
    "P1: every component loudest at 28,000 r/min": Remark(
        "in linear response f_b, f_c, f_i and f_o, which lead a component each (10, 13, 16, 18), would have "
        "to meet a mode at one speed; contacts are not linear"
    ),
    "f_r loudest line of the total at 28,000 r/min": Remark(
        "the pedestal's mode is set to f_r there, and the unbalance is identified from this line", built=True
    ),
    "balls: f_b largest": Remark(_EQUAL),
    "cage: f_b third": Remark(_EQUAL),
    "friction is the main component: over 3 dB of P1": Remark(
        "of traction, which is smooth; the noise of asperities that touch is not modelled"
    ),
}
BySpeed = Mapping[int, Mapping[str, Any]]


def ours(values: Iterable[Value], rpm: float, result: Mapping[str, Any]) -> dict[str, float]:
    """Our values of one run at a speed (r/min), by name."""
    return {
        value.name: result["levels"]["total"][POINTS.index(value.place)]
        if value.quantity == "leq"
        else result["lines"]["total"][value.quantity.removeprefix("line ")]
        for value in values
        if value.rpm == rpm
    }


def loudest_line(result: Mapping[str, Any]) -> tuple[str, float, float]:
    """Return the loudest line of a run at P1: its name, frequency (Hz), and level less the total's (dB).

    Beside `LINES` there are f_i - f_r and f_i + f_r, which orders N - 1 and N + 1 of an inner race with N
    balls excite across the axis. A line within one step of the spectrum from none of them is *other*.
    """
    at = dict(result["frequencies"])
    at |= {"f_i - f_r": at["f_i"] - at["f_r"], "f_i + f_r": at["f_i"] + at["f_r"]}
    spectrum = np.array(result["spectra"]["total"])
    spectrum[0] = -np.inf  # a mean is no line
    found = STEP * int(spectrum.argmax())
    name = min(at, key=lambda key: abs(at[key] - found))
    over = float(spectrum.max() - result["levels"]["total"][0])
    return (name if abs(at[name] - found) <= STEP else "other", found, over)


def orderings(results: BySpeed, frictionless: BySpeed | None = None) -> list[Judged]:
    """Judge the paper's statements for one seed and one radiation model.

    Parameters
    ----------
    results : mapping of int to result
        By speed.
    frictionless : mapping of int to result, optional
        The same bearing without friction, at some of the speeds; none: what needs it is not judged.
    """
    total = {rpm: dict(zip(POINTS, found["levels"]["total"], strict=True)) for rpm, found in results.items()}
    speeds = sorted(results)

    def at_all(chosen, margin):
        return [(f"{rpm:,}", margin(total[rpm])) for rpm in speeds if chosen(rpm)]

    found = [
        verdict("P2 below P1 at every speed", at_all(lambda n: True, lambda p: p["P1"] - p["P2"])),
        verdict(
            "P4 between P2 and P1",
            at_all(lambda n: True, lambda p: min(p["P1"] - p["P4"], p["P4"] - p["P2"])),
        ),
        verdict(
            "P3 above P1 at 16,000 to 27,000 r/min",
            at_all(lambda n: 16000 <= n <= 27000, lambda p: p["P3"] - p["P1"]),
        ),
        verdict(
            "P3 below P1 at other speeds",
            at_all(lambda n: not 16000 <= n <= 27000, lambda p: p["P1"] - p["P3"]),
        ),
        verdict(
            "P3 lowest of all above 32,000 r/min",
            at_all(lambda n: n > 32000, lambda p: min(p["P1"], p["P2"], p["P4"]) - p["P3"]),
        ),
        *_peaks(results, total, speeds),
        *_lines(results),
    ]
    for a, b, one, other in (
        ("outer_ring", "inner_ring", "outer", "inner"),
        ("inner_ring", "balls", "inner", "balls"),
        ("balls", "cage", "balls", "cage"),
    ):
        margins = [
            (f"{rpm:,}", results[rpm]["levels"][a][0] - results[rpm]["levels"][b][0]) for rpm in speeds
        ]
        found.append(verdict(f"P1: {one} above {other} at every speed", margins))
    gain = [
        (f"{rpm:,}", total[rpm]["P1"] - off["levels"]["total"][0] - HALF_DB)
        for rpm, off in sorted((frictionless or {}).items())
        if rpm in results
    ]
    friction = verdict("friction is the main component: over 3 dB of P1", gain)
    return [*found, *_trends(results), friction, *_seen(results, total)]


def _seen(results: BySpeed, total: Mapping[int, Mapping[str, float]]) -> list[Judged]:
    """Judge what the paper says of its measured peak and of the number of peaks in its spectra.

    A line is a peak where it is `PEAK_DB` above the median of the spectrum within 200 Hz of it.
    """
    near = [("28,000", WITHIN_DB - abs(total[n]["P1"] - total[n]["P3"])) for n in (28000,) if n in total]

    def over(component: str, keys: Iterable[str]) -> list[tuple[str, float]]:
        margins = []
        for rpm in (n for n in SPECTRA if n in results and "spectra" in results[n]):
            one = results[rpm]
            spectrum = np.array(one["spectra"][component])
            for key in keys:
                at = round(one["frequencies"][key] / STEP)
                floor = float(np.median(spectrum[max(at - _BESIDE, 0) : at + _BESIDE + 1]))
                margins.append((f"{key}, {rpm:,}", one["lines"][component][key] - floor - PEAK_DB))
        return margins

    return [
        verdict(f"measured: P1 and P3 within {WITHIN_DB:.0f} dB at 28,000 r/min", near),
        verdict("cage: three peaks, at f_c, f_r and f_b", over("cage", ("f_c", "f_r", "f_b"))),
        verdict("inner ring: six peaks, at each line", over("inner_ring", LINES)),
        verdict("outer ring: six peaks, at each line", over("outer_ring", LINES)),
    ]


def _peaks(results: BySpeed, total, speeds) -> list[Judged]:
    """Statements on the critical speed."""
    if 28000 not in results or len(speeds) < 3:
        return [Judged(words, UNSEEN, "") for words in _PEAK_WORDS]
    others = [rpm for rpm in speeds if rpm != 28000]
    at_peak = [
        (
            f"{p} (loudest at {max(speeds, key=lambda n: total[n][p]):,})",
            total[28000][p] - max(total[n][p] for n in others),
        )
        for p in POINTS
    ]
    part_peak = [
        (
            f"{NAMES[c]} (loudest at {max(speeds, key=lambda n: results[n]['levels'][c][0]):,})",
            results[28000]["levels"][c][0] - max(results[n]["levels"][c][0] for n in others),
        )
        for c in PARTS
    ]
    after = [(p, total[speeds[-1]][p] - total[speeds[0]][p]) for p in POINTS]
    tones = results[28000]["lines"]["total"]
    loudest = [("28,000", tones["f_r"] - max(tones[key] for key in LINES if key != "f_r"))]
    return [
        verdict(_PEAK_WORDS[0], at_peak),
        verdict(_PEAK_WORDS[1], part_peak),
        verdict(_PEAK_WORDS[2], after),
        verdict(_PEAK_WORDS[3], loudest),
    ]


_PEAK_WORDS = (
    "every point loudest at 28,000 r/min",
    "P1: every component loudest at 28,000 r/min",
    "40,000 r/min louder than 10,000 r/min",
    "f_r loudest line of the total at 28,000 r/min",
)


def _lines(results: BySpeed) -> list[Judged]:
    """Statements on the order of lines in the components' spectra at the paper's four speeds."""
    speeds = [rpm for rpm in SPECTRA if rpm in results]

    def over(component, margin):
        return [(f"{rpm:,}", margin(results[rpm]["lines"][component])) for rpm in speeds]

    def largest(key):
        return lambda tones: tones[key] - max(tones[other] for other in LINES if other != key)

    def smallest(key):
        return lambda tones: min(tones[other] for other in LINES if other != key) - tones[key]

    return [
        verdict("balls: f_b largest", over("balls", largest("f_b"))),
        verdict("balls: f_o above f_i", over("balls", lambda t: t["f_o"] - t["f_i"])),
        verdict(
            "balls: f_r above f_c and 2 f_r", over("balls", lambda t: t["f_r"] - max(t["f_c"], t["2 f_r"]))
        ),
        verdict("cage: f_c largest", over("cage", largest("f_c"))),
        verdict("cage: f_r next", over("cage", lambda t: t["f_r"] - max(t["f_b"], t["f_i"], t["f_o"]))),
        verdict("cage: f_b third", over("cage", lambda t: t["f_b"] - max(t["2 f_r"], t["f_i"], t["f_o"]))),
        verdict("inner ring: f_i largest", over("inner_ring", largest("f_i"))),
        verdict("inner ring: 2 f_r smallest", over("inner_ring", smallest("2 f_r"))),
        verdict("outer ring: f_o largest", over("outer_ring", largest("f_o"))),
        verdict("outer ring: f_c above 2 f_r", over("outer_ring", lambda t: t["f_c"] - t["2 f_r"])),
    ]


def _trends(results: BySpeed) -> list[Judged]:
    """Statements of sections 5.1 to 5.4 on single lines over the four speeds of the spectra.

    A line's share (the paper's *contribution*) is its level less the component's.
    """
    seen = all(rpm in results for rpm in SPECTRA)

    def lines_at(component: str, rpm: int) -> Mapping[str, float]:
        return results[rpm]["lines"][component]

    def shares(component: str, key: str) -> list[float]:
        return [lines_at(component, n)[key] - results[n]["levels"][component][0] for n in SPECTRA]

    def steps(component: str, sign: float, *keys: str) -> list[tuple[str, float]]:
        """Return the changes of shares with each step of speed, in the direction of ``sign``."""
        return [
            (f"{key}, {rpm:,}", sign * (after - before))
            for key in keys
            for rpm, before, after in zip(
                SPECTRA[1:], shares(component, key), shares(component, key)[1:], strict=False
            )
        ]

    def loudest(component: str, *keys: str) -> list[tuple[str, float]]:
        return [
            (
                key,
                lines_at(component, 28000)[key]
                - max(lines_at(component, n)[key] for n in SPECTRA if n != 28000),
            )
            for key in keys
        ]

    def second_order() -> list[tuple[str, float]]:
        low, high = lines_at("balls", 20000), lines_at("balls", 30000)
        return [("20,000", low["f_c"] - low["2 f_r"]), ("30,000", high["2 f_r"] - high["f_c"])]

    def between() -> list[tuple[str, float]]:
        low, middle, high = (lines_at("cage", n) for n in (20000, 25000, 30000))
        return [(key, min(middle[key] - low[key], high[key] - middle[key])) for key in ("f_c", "f_r", "f_b")]

    def near() -> list[tuple[str, float]]:
        tones = lines_at("outer_ring", 28000)
        return [
            ("f_r - f_b", tones["f_r"] - tones["f_b"]),
            ("3 dB less distance to f_o", WITHIN_DB - abs(tones["f_r"] - tones["f_o"])),
        ]

    def up_and_down() -> list[tuple[str, float]]:
        at = [lines_at("outer_ring", n)["f_i"] for n in SPECTRA]
        return [("20,000 to 25,000", at[1] - at[0]), ("28,000 to 30,000", at[2] - at[3])]

    def steady() -> list[tuple[str, float]]:
        found = {key: shares("outer_ring", key) for key in ("f_c", "2 f_r")}
        return [(key, WITHIN_DB - (max(one) - min(one))) for key, one in found.items()]

    stated = {
        "balls: 2 f_r below f_c at 20,000, above it at 30,000 r/min": second_order,
        "balls: every line loudest at 28,000 r/min": lambda: loudest("balls", *LINES),
        "cage: f_c, f_r, f_b loudest at 28,000 r/min": lambda: loudest("cage", "f_c", "f_r", "f_b"),
        "cage: f_c, f_r, f_b at 25,000 between 20,000 and 30,000 r/min": between,
        "inner ring: share of f_b falls with speed": lambda: steps("inner_ring", -1.0, "f_b"),
        "inner ring: shares of f_r and f_o grow": lambda: steps("inner_ring", 1.0, "f_r", "f_o"),
        "inner ring: share of f_c grows": lambda: steps("inner_ring", 1.0, "f_c"),
        "outer ring: share of f_r grows": lambda: steps("outer_ring", 1.0, "f_r"),
        "outer ring: f_r at 28,000 r/min above f_b and within 3 dB of f_o": near,
        "outer ring: share of f_o falls": lambda: steps("outer_ring", -1.0, "f_o"),
        "outer ring: f_i rises first, then falls": up_and_down,
        "outer ring: shares of f_c and 2 f_r vary by less than 3 dB": steady,
    }
    return [verdict(words, margins() if seen else []) for words, margins in stated.items()]
