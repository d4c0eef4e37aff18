"""The impact-noise paper: dry 7003C, outer ring held all round, springs between the balls for a cage."""

from typing import Any

import numpy as np
from scipy.signal import find_peaks

from examples.papers import charts, page
from examples.papers.calibration import Calibration
from examples.papers.case import Case
from examples.papers.hearing import NAMES, Ear, a_weighted
from examples.papers.page import Ordering, Output, Value, verdict
from fmu_bearing.acoustics.analysis.directivity import plane_points
from fmu_bearing.acoustics.analysis.spectrum import power_spectral_density
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.run.table import markdown

NAME = "impact-noise"
TITLE = "Impact-noise paper: dry 7003C, held all round, springs for a cage"
MODULES = ("impact_noise", "hearing")
PAPER_MODEL_TOO = False
SPEEDS = (10000, 15000, 20000)
SPRINGS = (1e5, 5e6, 2.5e7)  # N/m; the paper keeps the last
ABOVE = (0.0, 0.0, 0.1)  # m
RADIUS = 0.1  # m, of the three planes
WINDOW = 5e-3  # s: the paper's whole history
BANDS = ((0.0, 5e3), (5e3, 1e4), (1e4, 2e4))  # Hz
#: The paper's planes (its Y is the bearing's axis, its X horizontal) and ours.
PLANES = {"XY": "XY", "YZ": "XZ", "XZ": "YZ"}
CALIBRATION = ("10,000 r/min, 100 mm above, measured", 73.96)
MEASURED = {10000: 73.96, 15000: 75.29, 20000: 80.27}
COMPUTED = {10000: 72.88, 15000: 75.16, 20000: 80.28}
AVERAGE_PEAKS = {10000: 67.0, 20000: 76.0}
BY_SPRING = {1e5: 72.74, 5e6: 72.35, 2.5e7: 72.88}
PLANE_RANGES = {
    10000: {"XY": 8.71, "YZ": 9.39, "XZ": 5.68},
    15000: {"XY": 6.42, "YZ": 8.28, "XZ": 5.37},
    20000: {"XY": 7.44, "YZ": 7.91, "XZ": 4.52},
}
PLANE_MAXIMA = {"XY": 85.45, "YZ": 86.42, "XZ": 82.50}  # 20,000 r/min


def _case(scale: float, rpm: int, spring: float) -> Case:
    changes = (("bearing.ball_springs.stiffness_N_m", spring),)
    return Case("7003C-impact", rpm, changes, scale, label=f"{spring:.3g} N/m")


def cases(scale: float, quick: bool) -> list[Case]:
    """Operating points: three speeds with the stiffest springs, the softer ones at the lowest."""
    if quick:
        return [Case("7003C-impact", 10000, (), scale, 0.01, 0.02, label=f"{SPRINGS[-1]:.3g} N/m")]
    found = [_case(scale, rpm, SPRINGS[-1]) for rpm in SPEEDS]
    return found + [_case(scale, SPEEDS[0], spring) for spring in SPRINGS[:-1]]


def calibration_case(scale: float, quick: bool) -> Case:
    """Operating point of the calibration."""
    return cases(scale, quick)[0]


def calibration_level(ear: Ear) -> float:
    """Largest of a 5 ms history 100 mm above (dB(A)), mean over the recording's histories."""
    rate = ear.recording.rate
    return float(histories(a_weighted(ear.pressure([ABOVE]), rate), rate)[0].mean())


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
    count = 24 if quick else 360
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
    return {"above": parts, "planes": planes}


def _bands(pressure, rate: float) -> list[float]:
    """Share of the unweighted energy in each of `BANDS`."""
    frequency, density = power_spectral_density(pressure, rate, 100.0)
    shares = [density[(frequency >= low) & (frequency < high)].sum() for low, high in BANDS]
    return [float(share / sum(shares)) for share in shares]


def loudest(result: dict[str, Any], name: str = "total") -> float:
    """Largest of a 5 ms history (dB(A)), mean over histories."""
    return float(np.mean(result["above"][name]["histories"]))


def orderings(results: dict[tuple[int, float], dict[str, Any]]) -> list[Ordering]:
    """Judge the paper's statements; results by speed and spring."""
    by_speed = {rpm: results[rpm, SPRINGS[-1]] for rpm in SPEEDS if (rpm, SPRINGS[-1]) in results}
    by_spring = {k: results[SPEEDS[0], k] for k in SPRINGS if (SPEEDS[0], k) in results}
    steps = list(zip(sorted(by_speed), sorted(by_speed)[1:], strict=False))
    found = [
        verdict(
            "level grows with speed",
            [(f"{b:,}", loudest(by_speed[b]) - loudest(by_speed[a])) for a, b in steps],
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
        verdict(
            "plane XZ (across the axis) varies least",
            [(f"{n:,}", min(x["XY"], x["YZ"]) - x["XZ"]) for n, x in ranges.items()],
        ),
        verdict(
            "plane YZ varies most", [(f"{n:,}", x["YZ"] - max(x["XY"], x["XZ"])) for n, x in ranges.items()]
        ),
        verdict(
            "YZ and XZ vary less with every step of speed",
            [(f"{p}, {b:,}", ranges[a][p] - ranges[b][p]) for p in ("YZ", "XZ") for a, b in steps],
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


def values(results: dict[tuple[int, float], dict[str, Any]], calibration: Calibration) -> list[Value]:
    """Values readable from the paper."""
    found = []
    first = results.get((SPEEDS[0], SPRINGS[-1]))

    def add(what, paper, ours, source, since=None, role="predicted"):
        found.append(Value(what, paper, ours, role, "dB(A)", source, since))

    for rpm in SPEEDS:
        result = results.get((rpm, SPRINGS[-1]))
        if result is None or first is None:
            continue
        start, role = rpm == SPEEDS[0], "calibrated" if rpm == SPEEDS[0] else "predicted"
        for kind, paper in (("measured", MEASURED), ("computed there", COMPUTED)):
            since = None if start else (paper[SPEEDS[0]], loudest(first))
            add(f"{rpm:,} r/min, {kind}", paper[rpm], loudest(result), "Table 10", since, role)
        if rpm in AVERAGE_PEAKS:
            since = None if start else (AVERAGE_PEAKS[SPEEDS[0]], first["above"]["total"]["average_peak"])
            ours = result["above"]["total"]["average_peak"]
            add(f"{rpm:,} r/min, average peak", AVERAGE_PEAKS[rpm], ours, "Fig. 19", since)
        for plane in PLANES:
            since = None if start else (PLANE_RANGES[SPEEDS[0]][plane], first["planes"][plane]["range"])
            ours = result["planes"][plane]["range"]
            add(f"{rpm:,} r/min, {plane}, max - min", PLANE_RANGES[rpm][plane], ours, "Table 14", since)
    top = results.get((20000, SPRINGS[-1]))
    for plane, paper in PLANE_MAXIMA.items() if top is not None else ():
        add(f"20,000 r/min, {plane}, maximum", paper, top["planes"][plane]["maximum"], "Table 14")
    for spring in SPRINGS[:-1]:
        result = results.get((SPEEDS[0], spring))
        if result is not None:
            add(f"10,000 r/min, springs {spring:.3g} N/m", BY_SPRING[spring], loudest(result), "Table 7")
    return found


def write(
    found: dict[str, dict[Case, dict[str, Any]]],
    calibration: Calibration,
    radiation_model: str,
    output: Output,
) -> str:
    """Write pictures and CSV; return the page."""
    results = {
        (int(case.rpm), spring): result
        for case, result in found[radiation_model].items()
        for spring in SPRINGS
        if case.label == f"{spring:.3g} N/m"
    }
    _pictures(results, output)
    _csv(results, output)
    judged = orderings(results)
    rows = [
        [f"{rpm:,}", f"{spring:.3g}", NAMES.get(name, name), f"{np.mean(part['histories']):.1f}",
         f"{np.min(part['histories']):.1f} to {np.max(part['histories']):.1f}", f"{part['leq_A']:.1f}",
         f"{part['average_peak']:.1f}"]
        for (rpm, spring), result in sorted(results.items())
        for name, part in result["above"].items()
    ]  # fmt: skip
    columns = [
        "r/min",
        "springs, N/m",
        "component",
        "largest of 5 ms, mean",
        "range over histories",
        "Leq",
        "average peak",
    ]
    any_case = next(iter(found[radiation_model]))
    return page.template(NAME).format(
        timing=page.timing(any_case.settle, any_case.duration),
        title=TITLE, caution=page.caution(radiation_model), radiation_model=radiation_model,
        counts=page.counted(judged), target=CALIBRATION[1],
        calibration=calibration.words, values=page.values_table(values(results, calibration)),
        orderings=page.orderings_table([radiation_model], [judged]), above=markdown(columns, rows),
    )  # fmt: skip


def _csv(results, output: Output) -> None:
    columns = {
        f"{rpm} {spring:g} {plane} {kind}": around[kind]
        for (rpm, spring), result in sorted(results.items())
        for plane, around in result["planes"].items()
        for kind in ("largest", "leq_A")
    }
    count = len(next(iter(columns.values())))
    rows = [
        [f"{360 * k // count}", *(f"{value:.1f}" for value in values)]
        for k, values in enumerate(zip(*columns.values(), strict=True))
    ]
    output.csv("impact-noise-planes", ["angle_deg", *columns], rows)
    rows = [
        [str(rpm), f"{spring:g}", name, str(k), f"{top:.2f}"]
        for (rpm, spring), result in sorted(results.items())
        for name, part in result["above"].items()
        for k, top in enumerate(part["histories"])
    ]
    output.csv("impact-noise-above", ["rpm", "spring_N_m", "component", "history", "largest_dBA"], rows)


def _pictures(results, output: Output) -> None:
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
