"""The impact-noise paper: dry 7003C, outer ring held all round, springs between the balls for a cage."""

from typing import Any

import numpy as np
from scipy.signal import find_peaks

from examples.papers import charts, page, values
from examples.papers.case import Case, Changes
from examples.papers.hearing import NAMES, Ear, a_weighted
from examples.papers.identification import Answer, by_bracket
from examples.papers.page import Output
from examples.papers.runs import Results, Runs
from examples.papers.statements import AGAINST, Judged, Reason, both, classed, counts, trend, verdict
from fmu_bearing.acoustics.analysis.directivity import plane_points
from fmu_bearing.acoustics.analysis.spectrum import power_spectral_density
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.results.table import markdown

NAME = "impact-noise"
TITLE = "Impact-noise paper: dry 7003C, held all round, springs for a cage"
MODULES = ("impact_noise", "hearing", "values")
SCENE = "7003C-impact"
SPEEDS = (10000, 15000, 20000)
SPRINGS = (1e5, 5e6, 2.5e7)  # N/m; the paper keeps the last
ABOVE = (0.0, 0.0, 0.1)  # m
RADIUS = 0.1  # m, of the three planes
COUNT = 72  # points of a plane: every 5 degrees, the paper's are one degree apart
WINDOW = 5e-3  # s: the paper's whole history
BANDS = ((0.0, 5e3), (5e3, 1e4), (1e4, 2e4))  # Hz
#: The paper's planes (its Y is the bearing's axis, its X horizontal) and ours.
PLANES = {"XY": "XY", "YZ": "XZ", "XZ": "YZ"}
#: Rings that bend on a seat all round: the outer ring's wall, held at its circumference, yields under each
#: ball. Spring damping includes what the cage takes up. All assumed, none fitted. Waves excite to 20 kHz,
#: because the paper's peaks are from 9.7 to 20 kHz and beyond, where no ear and no meter of ours reaches.
CHANGES: Changes = (
    ("imperfections.highest_frequency_kHz", 20.0),
    ("mounting.flexure.outer_ring", (2, 3, 4, 5)),
    ("mounting.flexure.inner_ring", (2, 3)),
    ("mounting.flexure.damping_ratio", 0.005),
    ("mounting.flexure.outer_seat_stiffness_N_m", 1e8),
    ("mounting.flexure.inner_seat_stiffness_N_m", 0.0),
    ("bearing.ball_springs.damping_N_s_m", 2.0),
)
VALUES = values.read(NAME)
IDENTIFIED, BEFORE = "identified", "before"
#: Other seats of the outer ring against bending (N/m), to see what the assumed one decides.
SEATS = (1e7, 1e9)
_TURNED = (
    "12 balls map onto themselves under 90 degrees, which turns XY into YZ: they differ by the draw alone"
)
REASONS = {
    "plane YZ varies most": Reason(AGAINST, _TURNED),
    "20,000 r/min: maximum of YZ above XY above XZ": Reason(AGAINST, _TURNED),
}


_SEAT = "mounting.flexure.outer_seat_stiffness_N_m"


def _case(label: str, changes: Changes, rpm: float, seed: int, spring: float = SPRINGS[-1]) -> Case:
    stiffness = ("bearing.ball_springs.stiffness_N_m", spring)
    return Case(SCENE, rpm, (*CHANGES, *changes, stiffness), seed, label=label)


def cases(found: Changes, seeds: tuple[int, ...], quick: bool) -> list[Case]:
    """Operating points: three speeds with the stiffest springs, the softer ones at the lowest."""
    if quick:
        rigid = ("mounting.flexure", None)
        return [Case(SCENE, 10000, (*CHANGES, *found, rigid), seed, 0.01, 0.02, IDENTIFIED) for seed in seeds]
    points = [(rpm, SPRINGS[-1]) for rpm in SPEEDS] + [(SPEEDS[0], spring) for spring in SPRINGS[:-1]]
    own = [
        _case(label, changes, rpm, seed, spring)
        for label, changes in ((BEFORE, ()), (IDENTIFIED, found))
        for rpm, spring in points
        for seed in seeds
    ]
    return own + [
        _case(f"{seat:g}", (*found, (_SEAT, seat)), rpm, seeds[0]) for seat in SEATS for rpm in SPEEDS
    ]


def identified(runs: Runs) -> Answer:
    """Identify A_1 from the fitted value."""
    (value,) = (one for one in VALUES if one.role == values.FIT)

    def level(changes: Changes) -> float:
        own = (
            cases(changes, runs.seeds, True)
            if runs.quick
            else [_case(IDENTIFIED, changes, value.rpm, seed) for seed in runs.seeds]
        )
        found = runs.all(NAME, own, f"{NAME}: A_1 {changes[0][1]:.3g} um", what="top")
        return float(np.mean([result["dB"] for result in found.values()]))

    return by_bracket(SCENE, CHANGES, VALUES, level)


def top(ear: Ear, quick: bool) -> dict[str, Any]:
    """Largest A-weighted level (dB) of a 5 ms history above the bearing, mean over histories."""
    rate = ear.recording.rate
    return {"dB": float(histories(a_weighted(ear.pressure([ABOVE]), rate), rate)[0].mean())}


def histories(pressure, rate: float):
    """Largest A-weighted pressure of each 5 ms history but the first (dB), shape (mics, histories)."""
    size = round(WINDOW * rate)
    count = pressure.shape[-1] // size
    cut = pressure[:, size : count * size].reshape(len(pressure), count - 1, size)
    return level((cut**2).max(axis=2))


def reduce(ear: Ear, quick: bool) -> dict[str, Any]:
    """Levels above the bearing by component, and round the three planes."""
    recording = ear.recording
    rate = recording.rate
    skip = round(WINDOW * rate)
    parts = {}
    for name, found in ear.sources([ABOVE]).items():
        weighted = a_weighted(found.sum(axis=0), rate)
        peaks, _ = find_peaks(np.abs(weighted[0, skip:]))
        parts[name] = {
            "histories": histories(weighted, rate)[0].tolist(),
            "leq_A": float(level((weighted[:, skip:] ** 2).mean())),
            "average_peak": float(level((np.abs(weighted[0, skip:])[peaks] ** 2).mean()))
            if len(peaks)
            else -106.0,
            "bands": _bands(found.sum(axis=0)[0], rate),
        }
    planes = {}
    kept = recording.scene.bearing.ball_springs.stiffness_N_m == SPRINGS[-1]  # the paper's planes have these
    count = 24 if quick else COUNT
    points = np.concatenate([plane_points(ours, RADIUS, count) for ours in PLANES.values()])
    around = a_weighted(ear.pressure(points), rate) if kept else points  # planes share circles: one call
    for k, name in enumerate(PLANES if kept else ()):
        weighted = around[k * count : (k + 1) * count]
        largest = histories(weighted, rate)
        planes[name] = {
            "largest": largest.mean(axis=1).round(3).tolist(),
            "range": float(np.ptp(largest, axis=0).mean()),
            "maximum": float(largest.max(axis=0).mean()),
            "leq_A": level((weighted[:, skip:] ** 2).mean(axis=1)).round(3).tolist(),
        }
    spring = recording.scene.bearing.ball_springs.stiffness_N_m
    return {"above": parts, "planes": planes, "spring": float(spring)}


def _bands(pressure, rate: float) -> list[float]:
    """Share of the unweighted energy in each of `BANDS`."""
    frequency, density = power_spectral_density(pressure, rate, 100.0)
    shares = [density[(frequency >= low) & (frequency < high)].sum() for low, high in BANDS]
    return [float(share / sum(shares)) for share in shares]


def loudest(result: dict[str, Any], name: str = "total") -> float:
    """Largest of a 5 ms history (dB(A)), mean over histories."""
    return float(np.mean(result["above"][name]["histories"]))


Points = dict[tuple[int, float], dict[str, Any]]  # by speed and spring


def orderings(results: Points) -> list[Judged]:
    """Judge the paper's statements; results by speed and spring."""
    by_speed = {rpm: results[rpm, SPRINGS[-1]] for rpm in SPEEDS if (rpm, SPRINGS[-1]) in results}
    by_spring = {k: results[SPEEDS[0], k] for k in SPRINGS if (SPEEDS[0], k) in results}
    steps = list(zip(sorted(by_speed), sorted(by_speed)[1:], strict=False))
    found = [
        trend(
            "level grows with speed",
            [
                (f"{b:,}", _paper(b) - _paper(a), loudest(by_speed[b]) - loudest(by_speed[a]))
                for a, b in steps
            ],
        ),
        verdict(
            "springs of 1e5 to 2.5e7 N/m differ by less than 1 dB",
            [("10,000", 1.0 - np.ptp([loudest(r) for r in by_spring.values()]))]
            if len(by_spring) > 1
            else [],
        ),
    ]
    for one, other in (("outer_ring", "inner_ring"), ("inner_ring", "balls")):
        margins = [
            (f"{n:,}", r["above"][one]["leq_A"] - r["above"][other]["leq_A"]) for n, r in by_speed.items()
        ]
        found.append(verdict(f"{NAMES[one]} above {NAMES[other]}", margins))
    ranges = {n: {p: r["planes"][p]["range"] for p in PLANES} for n, r in by_speed.items()}
    found += [
        both(
            verdict(
                "plane XZ (across the axis) varies least",
                [(f"{n:,}", min(x["XY"], x["YZ"]) - x["XZ"]) for n, x in ranges.items()],
            ),
            trend(
                "",
                [
                    (f"{plane} - XZ, {n:,}", _range(plane, n) - _range("XZ", n), x[plane] - x["XZ"])
                    for n, x in ranges.items()
                    for plane in ("XY", "YZ")
                ],
            ),
        ),
        verdict(
            "plane YZ varies most", [(f"{n:,}", x["YZ"] - max(x["XY"], x["XZ"])) for n, x in ranges.items()]
        ),
        trend(
            "YZ and XZ vary less with every step of speed",
            [
                (f"{p}, {b:,}", _range(p, b) - _range(p, a), ranges[b][p] - ranges[a][p])
                for p in ("YZ", "XZ")
                for a, b in steps
            ],
        ),
        verdict(
            "20,000 r/min: maximum of YZ above XY above XZ",
            [
                (
                    f"{a} > {b}",
                    by_speed[20000]["planes"][a]["maximum"] - by_speed[20000]["planes"][b]["maximum"],
                )
                for a, b in (("YZ", "XY"), ("XY", "XZ"))
            ]
            if 20000 in by_speed
            else [],
        ),
        verdict(
            "most energy between 10 and 20 kHz (unweighted, above)",
            [
                (f"{n:,}", 100 * (r["above"]["total"]["bands"][2] - max(r["above"]["total"]["bands"][:2])))
                for n, r in by_speed.items()
            ],
            "%",
        ),
    ]
    return found


def _paper(rpm: int) -> float:
    """Measured level (dB(A)) at a speed."""
    return next(v.paper.middle for v in VALUES if v.group == "measured" and v.rpm == rpm)


def _range(plane: str, rpm: int) -> float:
    """Largest less smallest level (dB(A)) round a plane in the paper."""
    return next(
        v.paper.middle for v in VALUES if (v.quantity, v.place, v.rpm) == ("range", plane, float(rpm))
    )


def ours(results: Points) -> dict[str, float]:
    """Our values of one seed, by name."""
    found = {}
    for value in VALUES:
        spring = float(value.place) if value.place not in PLANES else SPRINGS[-1]
        result = results.get((int(value.rpm), spring))
        if result is None:
            continue
        if value.quantity == "peak":
            found[value.name] = loudest(result)
        elif value.quantity == "average peak":
            found[value.name] = result["above"]["total"]["average_peak"]
        else:
            found[value.name] = result["planes"][value.place][value.quantity]
    return found


def write(found: Results, answer: Answer, runs: Runs, output: Output) -> str:
    """Write pictures and CSV; return the page."""
    radiation_model = runs.radiation_model
    every: dict[str, dict[int, Points]] = {}
    for case, result in found.items():
        at = (int(case.rpm), result["spring"])
        every.setdefault(case.label, {}).setdefault(case.seed, {})[at] = result
    now = every[IDENTIFIED]
    seeds = sorted(now)
    first = now[seeds[0]]
    _pictures(first, output)
    _csv(now, output)
    judged = classed([orderings(now[seed]) for seed in seeds], REASONS)
    met = values.met(VALUES, [ours(now[seed]) for seed in seeds])
    before = values.met(VALUES, [ours(one) for one in every.get(BEFORE, {}).values()])
    any_case = next(iter(found))
    return page.template(NAME).format(
        timing=page.timing(any_case.settle, any_case.duration), seeds=len(seeds), count=COUNT,
        title=TITLE, caution=page.caution(radiation_model), radiation_model=radiation_model,
        identified=answer.words, values=page.values_part(met, before, "dB(A)"),
        slope=page.slope_table([one for one in met if one.value.group == "measured"]),
        counts=counts(judged), statements=page.statements_table(judged), above=_above_table(now),
        seats=_seat_table(every, seeds[0]),
    )  # fmt: skip


def _seat_table(every: dict[str, dict[int, Points]], seed: int) -> str:
    """Levels above the bearing with other seats, one seed, at the same A_1."""
    rows = []
    for seat in sorted((*SEATS, dict(CHANGES)[_SEAT])):
        results = every.get(f"{seat:g}" if seat in SEATS else IDENTIFIED, {}).get(seed, {})
        for (rpm, spring), result in sorted(results.items()):
            if spring == SPRINGS[-1]:
                parts = [f"{loudest(result, name):.1f}" for name in ("outer_ring", "inner_ring", "total")]
                rows.append([f"{seat:.0e}", f"{rpm:,}", *parts])
    columns = ["seat, N/m", "r/min", "outer ring, dB(A)", "inner ring", "total"]
    return markdown(columns, rows)


def _above_table(now: dict[int, Points]) -> str:
    """Levels of the components 100 mm above, over the seeds."""
    rows = []
    for rpm, spring in sorted(now[min(now)]):
        results = [by_point[rpm, spring] for by_point in now.values() if (rpm, spring) in by_point]
        for name in results[0]["above"]:
            top = [loudest(result, name) for result in results]
            parts = [result["above"][name] for result in results]
            rows.append([
                f"{rpm:,}", f"{spring:.3g}", NAMES.get(name, name), f"{np.mean(top):.1f}", page.spread(top),
                f"{np.mean([part['leq_A'] for part in parts]):.1f}",
                f"{np.mean([part['average_peak'] for part in parts]):.1f}",
            ])  # fmt: skip
    columns = ["r/min", "springs, N/m", "component", "largest of 5 ms", "seeds", "Leq", "average peak"]
    return markdown(columns, rows)


def _csv(now: dict[int, Points], output: Output) -> None:
    columns = {
        f"{seed} {rpm} {spring:g} {plane} {kind}": around[kind]
        for seed, results in sorted(now.items())
        for (rpm, spring), result in sorted(results.items())
        for plane, around in result["planes"].items()
        for kind in ("largest", "leq_A")
    }
    count = len(next(iter(columns.values())))
    rows = [
        [f"{360 * k // count}", *(f"{value:.1f}" for value in row)]
        for k, row in enumerate(zip(*columns.values(), strict=True))
    ]
    output.csv("impact-noise-planes", ["angle_deg", *columns], rows)
    rows = [
        [str(seed), str(rpm), f"{spring:g}", name, str(k), f"{top:.2f}"]
        for seed, results in sorted(now.items())
        for (rpm, spring), result in sorted(results.items())
        for name, part in result["above"].items()
        for k, top in enumerate(part["histories"])
    ]
    output.csv(
        "impact-noise-above", ["seed", "rpm", "spring_N_m", "component", "history", "largest_dBA"], rows
    )


def _pictures(results: Points, output: Output) -> None:
    """Three planes at three speeds."""
    drawn, axes = charts.figure(12.0, 4.4, 1, 3, polar=True)
    for ax, plane in zip(axes, PLANES, strict=True):
        lines = {
            f"{rpm:,} r/min": result["planes"][plane]["largest"]
            for (rpm, spring), result in sorted(results.items())
            if spring == SPRINGS[-1]
        }
        if not lines:
            continue
        count = len(next(iter(lines.values())))
        zero = "N" if plane == "XZ" else "E"  # from 12 o'clock, or from the bearing's axis
        angles = [360.0 * k / count for k in range(count)]
        charts.circle(ax, angles, lines, f"plane {plane}, dB(A)", zero)
    charts.save(drawn, output.images / "impact-noise-planes.png")
