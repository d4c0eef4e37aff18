"""Points, components and lines of the multi-source paper, and its statements on them."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from examples.papers.hearing import NAMES, Ear
from examples.papers.statements import AGAINST, UNSEEN, Judged, Reason, verdict
from examples.papers.values import Value

SPEEDS = tuple(range(10000, 40001, 1000))
SPECTRA = (20000, 25000, 28000, 30000)
POINTS = ("P1", "P2", "P3", "P4")
PARTS = ("outer_ring", "inner_ring", "balls", "cage")
STEP, LAST = 20.0, 4000.0  # Hz, as the paper's figures 11 to 14
LINES = ("f_r", "2 f_r", "f_c", "f_b", "f_i", "f_o")
_ALL_MODES = (
    "where f_b, f_c, f_i and f_o each lead a component (10, 13, 16, 18), all four, each one number times the "
    "speed, must meet a mode at one speed, and f_r a fifth"
)
_SUM = (
    "energies of the components add (eq. 46): a line that is weaker in the loudest components than another "
    "one cannot lead their sum by more than the sum of such lines, so f_r cannot lead (9)"
)
_EQUAL = (
    "form of order 2 sounds at 2 f_b, equal balls on perfect races at f_o: f_b needs a dent or odd orders"
)
#: Statements that no bearing can meet, with the proof; the page names what they contradict.
REASONS = {
    "every point loudest at 28,000 r/min": Reason(
        AGAINST, "a body shaken across its axis is a dipole: cos 90 deg = 0 on the axis, at P4"
    ),
    "P1: every component loudest at 28,000 r/min": Reason(AGAINST, _ALL_MODES),
    "balls: f_b largest": Reason(AGAINST, _EQUAL),
    "cage: f_b third": Reason(AGAINST, _EQUAL),
    "inner ring: f_i largest": Reason(AGAINST, _SUM),
    "outer ring: f_o largest": Reason(AGAINST, _SUM),
}


def frequencies(ear: Ear) -> dict[str, float]:
    """Frequencies (Hz) of `LINES`, from the cage's mean speed in the recording."""
    recording = ear.recording
    ratio = float(np.mean(recording.outputs["cage.speed_ratio"][recording.output_time >= recording.start]))
    rolling = recording.kinematics()
    balls = recording.scene.bearing.ball_count
    f_r, f_c = rolling.f_r, ratio * rolling.f_r
    return {"f_r": f_r, "2 f_r": 2 * f_r, "f_c": f_c, "f_b": rolling.f_b, "f_i": balls * (f_r - f_c),
            "f_o": balls * f_c}  # fmt: skip


def ours(values: Iterable[Value], results: dict[int, dict[str, Any]]) -> dict[str, float]:
    """Our values of one seed, by name; results by speed."""
    found = {}
    for value in values:
        if value.rpm in results:
            own = results[int(value.rpm)]
            found[value.name] = (
                own["levels"]["total"][POINTS.index(value.place)]
                if value.quantity == "leq"
                else own["lines"]["total"][value.quantity.removeprefix("line ")]
            )
    return found


def orderings(results: dict[int, dict[str, Any]]) -> list[Judged]:
    """Judge the paper's statements for one radiation model; results by speed."""
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
    ranks = [
        (f"{rpm:,} {one} > {other}", results[rpm]["levels"][a][0] - results[rpm]["levels"][b][0])
        for rpm in speeds
        for a, b, one, other in (
            ("outer_ring", "inner_ring", "outer", "inner"),
            ("inner_ring", "balls", "inner", "balls"),
            ("balls", "cage", "balls", "cage"),
        )
    ]
    for one, other in (("outer", "inner"), ("inner", "balls"), ("balls", "cage")):
        margins = [(n.split()[0], m) for n, m in ranks if f"{one} > {other}" in n]
        found.append(verdict(f"P1: {one} above {other} at every speed", margins))
    return found


def _peaks(results: dict[int, dict[str, Any]], total, speeds) -> list[Judged]:
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


def _lines(results: dict[int, dict[str, Any]]) -> list[Judged]:
    """Statements on lines of the components' spectra at the paper's four speeds."""
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
