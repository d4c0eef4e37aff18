"""Sentences and rows of pages whose figures come from the tables under docs/results.

Each function yields what its page has to say, made from today's tables. A page without one of them is stale:
``python -m tests.figures`` prints what is missing, page by page.
"""

import csv
import functools
import pathlib
import re

DOCS = pathlib.Path(__file__).parents[1] / "docs"
RESULTS = DOCS / "results"


@functools.cache
def table(name, heading=""):
    """Rows of a table as dictionaries: of ``name.csv``, or the one below a heading of ``name.md``."""
    if not heading:
        with (RESULTS / f"{name}.csv").open(encoding="utf-8", newline="") as file:
            return tuple(csv.DictReader(file))
    text = (RESULTS / f"{name}.md").read_text("utf-8").split(f"## {heading}\n", 1)[1]
    lines = [line for line in re.split(r"\n## ", text)[0].splitlines() if line.startswith("|")]
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return tuple(dict(zip(cells[0], row, strict=True)) for row in cells[2:])


def row(name, heading="", **wanted):
    """Return the one row of a table whose columns have the given texts; ``_`` in a name may be a space."""
    rows = table(name, heading)
    keys = {key if key in rows[0] else key.replace("_", " "): value for key, value in wanted.items()}
    found = [one for one in rows if all(one[key] == value for key, value in keys.items())]
    assert len(found) == 1, (name, heading, wanted, len(found))
    return found[0]


def rounded(text, digits=2):
    """A number with so many significant digits, without an exponent where it needs none."""
    value = float(text.replace(",", "").rstrip(" %"))
    if value == 0.0 or 1e-3 <= abs(value) < 1e5:
        return f"{float(f'{value:.{digits}g}'):.10g}"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def percent(text, digits=2):
    """A share as per cent."""
    return f"{rounded(str(100.0 * float(text)), digits)} %"


def signed(text, decimals=1):
    """A number of decibels with its sign."""
    return f"{float(text):+.{decimals}f}" if float(f"{float(text):.{decimals}f}") else "0.0"


#: Default settings of the study of one scene.
_FULL = {"fidelity": "full", "method": "esdirk4", "tolerance": "0.002", "max_step,_us": "25", "left_out": ""}


def _setting(strips="5", **given):
    return row("tradeoff", **({**_FULL, "strips": strips} | given))


def _fidelities():
    finest = _setting(tolerance="1e-05", **{"max_step,_us": "4"})
    return {
        "`full`, `esdirk4`, 4 us, 1e-5": finest,
        "`full`, `esdirk4`, 25 us, 2e-3": _setting(),
        "`rings`": _setting(fidelity="rings", method=""),
        "`response`": row("tradeoff", fidelity="response"),
    }


def _cells(found):
    """Ring rms, load, torque and level of a setting: per cent where it is no fine figure."""
    shares = [found[key] for key in ("ring rms", "load", "torque")]
    texts = [percent(one) if float(one) >= 1e-3 else rounded(one, 1) for one in shares]
    return " | ".join([*texts, rounded(found["dB(A)"], 1)])


def choosing():
    """Which fidelity, which band, what sound costs."""
    for name, found in _fidelities().items():
        yield f"| {name} | {_cells(found)} | {rounded(found['sim/wall'])} |"
    for scene, speeds in (
        ("7003C-bare", "5,000 10,000 20,000"), ("7003C-spindle", "5,000 10,000 12,000 20,000 30,000"),
        ("7009C-full-ceramic", "9,000 12,000 15,000"), ("7009C-steel", "6,000 9,000 12,000"),
    ):  # fmt: skip
        for rpm in speeds.split():
            yield f"| {scene}, {rpm} | {_of_full(scene, rpm)} |"
    for load in ("300", "1000"):
        rings = _scene("7003C-spindle", "20,000", "rings", load)
        yield (
            f"{load} N on the spindle at 20,000 r/min: inner ring {_ratio(rings, 'inner ring')}, outer ring "
            f"{_ratio(rings, 'outer ring')}, torque {rings['torque']}"
        )
    whirl = _scene("7009C-full-ceramic", "18,000", "rings")
    yield f"{_ratio(whirl, 'inner ring')} on the inner ring (rings rigid)"
    yield f"One strip instead of five loses {percent(_setting('1')['torque'])} of the torque"
    damping = _setting(left_out="contact damping")
    yield f"without contact damping this spindle is {rounded(damping['dB(A)'])} dB(A) louder"
    for microphones in ("1", "4"):
        yield f"| {microphones} | {_sound_costs(microphones)} |"
    for circle in ("24", "360"):
        yield f"| circle of {circle} | {_sound_costs(f'circle of {circle}')} |"


def _scene(name, rpm, fidelity, load="0"):
    return row("scenes", scene=name, fidelity=fidelity, **{"r/min": rpm, "radial,_N": load})


def _ratio(found, key):
    return f"{float(found[key]):.2f}"


def _of_full(scene, rpm):
    """Ratios and levels of rings, then of response."""
    cells = []
    for fidelity in ("rings", "response"):
        found = _scene(scene, rpm, fidelity)
        cells += [_ratio(found, "inner ring"), _ratio(found, "outer ring")]
        cells += [signed(found["loudest, dB(A)"]), signed(found["quietest, dB(A)"])]
    return " | ".join(cells)


def _sound_costs(microphones):
    where = {"scene": "7003C-spindle", "microphones": microphones}
    costs = [
        row("benchmark", "Cost of sound", **where, radiation_model=model)
        for model in ("compact", "bem", "paper")
    ]
    return " | ".join(rounded(one["CPU s per s"], 1) for one in costs)


#: Names of the benchmark's cases on the page.
_CASES = {
    "7003C-bare 1,000 r/min": "7003C bare, 1,000 r/min",
    "7003C-bare 10,000 r/min": "7003C bare, 10,000 r/min",
    "7003C-spindle 20,000 r/min": "7003C spindle, 20,000 r/min",
    "7003C-bare 28,000 r/min": "7003C bare, 28,000 r/min",
    "7009C-full-ceramic 3,000 r/min": "7009C, 3,000 r/min",
    "7009C-full-ceramic 18,000 r/min": "7009C, 18,000 r/min",
    "7003C-spindle 20,000 r/min, 300 N radial": "spindle, 300 N radial",
    "7003C-spindle 20,000 r/min, 1000 N radial": "spindle, 1000 N radial",
    "7003C-bare 10,000 r/min, 300 N radial": "bare, 10,000 r/min, 300 N",
    "7003C-bare 10,000 r/min, 1000 N radial": "bare, 10,000 r/min, 1000 N",
    "7003C-spindle 20,000 r/min, first 4 ms": "spindle, first 4 ms",
    "7009C-full-ceramic 18,000 r/min, first 4 ms": "7009C, 18,000 r/min, first 4 ms",
    "example 7003C-bare 20,000 r/min": "example 7003C bare, 20,000 r/min",
    "example 7003C-spindle 20,000 r/min": "example 7003C spindle, 20,000 r/min",
    "example 7009C-full-ceramic 18,000 r/min": "example 7009C, 18,000 r/min",
}


def _usual(case):
    """Lines of full, rings and response of a case at their usual setting."""
    lines = [one for one in table("benchmark") if one["case"] == case]
    full = [one for one in lines if one["solver"] == "full / esdirk4" and one["setting"].startswith("usual")]
    others = [[one for one in lines if one["solver"] == name] for name in ("rings", "response")]
    return [one[0] if one else None for one in (full, *others)]


def validation():
    """Speeds and errors of the benchmark, its memory; how many extreme cases there are."""
    for case, name in _CASES.items():
        full, rings, response = _usual(case)
        digits = 2, 3, 3
        full_speed, *speeds = [
            f"{rounded(one['sim/CPU'], n)}{one['goal'] and ' (' + one['goal'] + ')'}" if one else ""
            for one, n in zip((full, rings, response), digits, strict=True)
        ]
        error = rounded(full["error"])
        asked = 2e-3 if "example" in case else 1e-3
        error = error if float(full["error"]) <= asked else f"**{error}**"
        cells = [name, full_speed, error, *speeds]
        yield "| " + " | ".join(cells).replace("|  |", "| |") + " |"
    usual = [_usual(case)[0] for case in _CASES if "example" not in case]
    faster = {
        peer: sorted(float(one[f"x {peer}"]) for one in usual)
        for peer in ("EXUDYN", "CVODE", "Radau", "LSODA")
    }
    low_high = {peer: f"{found[0]:.0f} to {found[-1]:.0f}" for peer, found in faster.items()}
    yield f"`full` is {low_high['EXUDYN']} times as fast as EXUDYN's ball bearing"
    yield (
        f"it is {low_high['CVODE']} times as fast as CVODE, {low_high['Radau']} times as Radau and "
        f"{low_high['LSODA']} times as LSODA"
    )
    from tests.extremes.cases import CASES

    yield f"`tests/extremes` runs {len(CASES)} cases at every fidelity and method"
    for scene, rpm in (
        ("gate 7003C-bare", "10,000"), ("gate 7003C-bare", "20,000"), ("gate 7003C-spindle", "12,000"),
        ("gate 7003C-spindle", "20,000"), ("gate 7009C-full-ceramic", "9,000"),
        ("gate 7009C-full-ceramic", "18,000"),
    ):  # fmt: skip
        ratios = [
            f"{float(_scene(scene, rpm, fidelity)[key]):.3f}"
            for fidelity in ("rings", "response")
            for key in ("inner ring", "outer ring")
        ]
        yield f"| {scene.removeprefix('gate ')}, {rpm} | {' | '.join(ratios)} |"


def limits():
    """Speed of full, heavy radial load."""
    settled = [_usual(case)[0] for case in _CASES if not ("first" in case or "example" in case)]
    free = [float(one["sim/CPU"]) for one in settled if "radial" not in one["case"]]
    loaded = [float(one["sim/CPU"]) for one in settled if "radial" in one["case"]]
    yield f"runs at {min(free):.1f} to {max(free):.1f} simulated seconds per second of the processor"
    yield f"at {min(loaded):.1f} to {max(loaded):.1f} under radial loads of 1000 and 300 N"
    heavy = [_scene("7003C-spindle", "20,000", fidelity, "1000") for fidelity in ("rings", "response")]
    ratios = [float(one[key]) for one in heavy for key in ("inner ring", "outer ring")]
    yield (
        "under 1000 N on the 7003C's spindle at 20,000 r/min both read "
        f"{min(ratios):.2f} to {max(ratios):.2f} of the rings' rms"
    )


def index():
    """How far apart the speeds of fidelities are."""
    names = _fidelities()
    slow, fast = (rounded(names[key]["sim/wall"]) for key in ("`full`, `esdirk4`, 25 us, 2e-3", "`response`"))
    yield f"runs at {slow} or at {fast} simulated seconds per second"


def spindle():
    """What sets cost."""
    over = {one["case"]: one["over one"] for one in table("sets")}
    yield (
        f"Their [speed](results/sets.md) times the number of bearings is {over['DB, rigid shaft']} (DB) and "
        f"{over['QBC, rigid shaft']} (QBC) of a single bearing's on a rigid shaft, "
        f"{over['DB, flexible shaft']} and {over['QBC, flexible shaft']} on one that bends"
    )
    yield f"A set of one bearing runs at {over['set of one, rigid shaft']} of the single bearing's speed"
    cost = {one["case"]: f"{float(one['us per bearing and iteration']):.1f}" for one in table("sets")}
    yield (
        f"An iteration costs {cost['single 7003C on a rotor']} us for the single bearing, "
        f"{cost['set of one, rigid shaft']} us for a set of one, {cost['DB, rigid shaft']} us per bearing "
        f"for DB and {cost['QBC, rigid shaft']} us for QBC"
    )


def coupling():
    """Factors of light shafts; what reading outputs costs."""
    for inertia, text in (("1e-06", "1e-6 (the inner ring alone has 1.4e-6)"),
                          ("2e-07", "2e-7"), ("1e-07", "1e-7"), ("3e-08", "3e-8")):  # fmt: skip
        factor = row(
            "coupling", **{"coupling": "torque", "step_s": "0.001", "inertia_kg_m2_or_cooling": inertia}
        )
        yield f"| {text} | {float(factor['factor']):.1f} |"
    native = row("benchmark", "Calls of an FMU", FMU="native 7003C-spindle, with sound", host="C")
    fmpy = row("benchmark", "Calls of an FMU", FMU="native 7003C-spindle, with sound", host="FMPy")
    cost = [rounded(str(1e-3 * float(one["50 outputs, ns"])), 1) for one in (native, fmpy)]
    yield f"reading 50 outputs takes {cost[0]} us in C and {cost[1]} us through FMPy"


PAGES = {
    "choosing.md": choosing, "coupling.md": coupling, "index.md": index, "limits.md": limits,
    "spindle.md": spindle, "validation.md": validation,
}  # fmt: skip


def missing(page):
    """Return the sentences that a page lacks; line breaks do not count."""
    text = " ".join((DOCS / page).read_text("utf-8").split())
    return [one for one in PAGES[page]() if " ".join(one.split()) not in text]


if __name__ == "__main__":
    for page in PAGES:
        print(page, *missing(page), sep="\n  ")
