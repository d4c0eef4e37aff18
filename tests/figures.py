"""Sentences and rows of pages whose figures come from the tables under docs/results.

Each function yields what its page has to say, made from today's tables. ``python -m tests.figures`` writes
rows and figures of these pages and of those in `tests.computed`, and prints sentences whose words are others.
"""

import csv
import re

from tests.figures_of_limits import band, full_limits, limits, response_limits, rings_limits
from tests.figures_of_paper import paper
from tests.figures_of_settled import settled
from tests.tables import (
    CASES,
    RESULTS,
    critical_speed,
    fastest,
    moved,
    percent,
    rounded,
    row,
    rows,
    scene_line,
    settings_of,
    table,
    usual,
    write,
)

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
    return [*texts, rounded(found["dB(A)"], 1)]


def _in_use(found):
    """The slowest of the speeds with inputs that move."""
    return min((found[key] for key in ("sim/CPU", "ramp", "warming", "ripple")), key=float)


def full():
    """What leaving something out saves, what sound costs, strips and damping; limits of full."""
    yield from full_limits()
    full, rings, response = ("full, of the whole", "rings, of the whole", "response, of the whole")

    def of(name, fidelity=full):
        return row("costs", variant=name)[fidelity]

    yield (
        f"takes {of('no cage')} of the time without the cage, {of('perfect surfaces and balls')} with "
        f"perfect surfaces and balls, {of('neither cage nor imperfections')} without both"
    )
    yield f"`max_internal_step_us = 100` it takes {of('the same, steps up to 100 us')} of the time"
    loud = [rounded(of("4 microphones", one)) for one in (full, rings, response)]
    yield f"make `full` {loud[0]} times, `rings` {loud[1]} times and `response` {loud[2]} times as long"
    yield f"One strip instead of five loses {percent(_setting('1')['torque'])} of the torque"
    damping = _setting(left_out="contact damping")
    yield f"without contact damping this spindle is {rounded(damping['dB(A)'])} dB(A) louder"


def choosing():
    """Which fidelity, what sound costs."""
    yield rows(
        "fidelities",
        (
            [name, *_cells(found), rounded(found["sim/CPU"]), rounded(_in_use(found))]
            for name, found in _fidelities().items()
        ),
    )
    yield from band()
    yield from _sound()


def rings():
    """How far from full, radial load, a whirl."""
    yield from rings_limits()
    yield _speeds("`rings`")
    yield from _near("rings")
    for load in ("300", "1000"):
        rings = scene_line("7003C-spindle", "20,000", "rings", load)
        yield (
            f"{load} N on the spindle at 20,000 r/min: inner ring {_ratio(rings, 'inner ring')}, outer ring "
            f"{_ratio(rings, 'outer ring')}, torque {rings['torque']}"
        )
    whirl = scene_line("7009C-full-ceramic", "18,000", "rings")
    yield f"{_ratio(whirl, 'inner ring')} on the inner ring (rings rigid)"


def response():
    """How far from full, on gate scenes too."""
    yield from response_limits()
    yield _speeds("`response`")
    yield from _near("response")
    gates = [
        float(one["outer ring"])
        for one in table("scenes")
        if one["scene"] == "gate 7003C-bare" and one["fidelity"] == "response"
    ]
    yield f"the outer ring of bare bearings has down to {min(gates):.2f}"


def _speeds(fidelity):
    """Speed beside that of full, settled and in use."""
    full_one, found = (_fidelities()[key] for key in ("`full`, `esdirk4`, 25 us, 2e-3", fidelity))
    return (
        f"{rounded(found['sim/CPU'])} simulated seconds per second of a processor where `full` has "
        f"{rounded(full_one['sim/CPU'])}, {rounded(_in_use(found))} where inputs move"
    )


def _near(fidelity):
    """Ranges over the example scenes without radial load, where no ring whirls by itself."""
    found = [
        one
        for one in table("scenes")
        if one["fidelity"] == fidelity and one["radial, N"] == "0" and "gate" not in one["scene"]
        and not (one["scene"].startswith("7009C") and one["r/min"] == "18,000")
    ]  # fmt: skip
    inner, outer = ([float(one[key]) for one in found] for key in ("inner ring", "outer ring"))
    loud, quiet = ([float(one[f"{key}, dB(A)"]) for one in found] for key in ("loudest", "quietest"))
    yield (
        f"Of {len(found)} cases of four example scenes at three to five speeds it has {min(inner):.2f} to "
        f"{max(inner):.2f} of the rms velocity of the inner ring, {min(outer):.2f} to {max(outer):.2f} of "
        f"the outer's; levels are {min(loud):+.1f} to {max(loud):+.1f} dB(A) off at the loudest of four "
        f"microphones and {min(quiet):+.1f} to {max(quiet):+.1f} at the quietest"
    )


def _sound():
    """What microphones and boundary elements cost; a paper's model beside them."""
    microphones = ("1", "4", "circle of 24", "circle of 360")
    yield rows("sound", ([name, *_sound_costs(name)] for name in microphones))
    first = sorted(table("first_sound"), key=lambda one: float(one["CPU s"]))
    yield (
        f"`bem` also takes {rounded(first[0]['CPU s'])} s ({first[0]['housing, mm']} mm) to "
        f"{rounded(first[-1]['CPU s'])} s ({first[-1]['housing, mm']} mm) of one core per geometry"
    )
    below = [
        float(one["bare bearing"]) - float(one["bare bearing, paper_contacts"])
        for one in table("papers/sound-field-values")
        if "r/min" in one["value"]
    ]
    yield f"Beside the 7009C it is {min(below):.0f} to {max(below):.0f} dB below `bem`"


def _ratio(found, key):
    return f"{float(found[key]):.2f}"


def _sound_costs(microphones):
    where = {"scene": "7003C-spindle", "microphones": microphones}
    costs = [
        row("benchmark", "Cost of sound", **where, radiation_model=model)
        for model in ("compact", "bem", "paper")
    ]
    return [rounded(one["CPU s per s"], 1) for one in costs]


def validation():
    """Speeds and errors of the benchmark, its memory; how many extreme cases there are."""
    lines = []
    for case, name in CASES.items():
        full, rings, response = usual(case)
        digits = 2, 3, 3
        full_speed, *speeds = [
            f"{rounded(one['sim/CPU'], n)}{one['goal'] and ' (' + one['goal'] + ')'}" if one else ""
            for one, n in zip((full, rings, response), digits, strict=True)
        ]
        error = rounded(full["error"])
        asked = 2e-3 if "example" in case else 1e-3
        error = error if float(full["error"]) <= asked else f"**{error}**"
        lines.append([name, full_speed, error, *speeds])
    yield rows("benchmark", lines)
    lines = [usual(case)[0] for case in CASES if "example" not in case]
    faster = {
        peer: sorted(float(one[f"x {peer}"]) for one in lines)
        for peer in ("EXUDYN", "CVODE", "Radau", "LSODA")
    }
    low_high = {peer: f"{found[0]:.0f} to {found[-1]:.0f}" for peer, found in faster.items()}
    yield f"`full` is {low_high['EXUDYN']} times as fast as EXUDYN's ball bearing"
    yield (
        f"it is {low_high['CVODE']} times as fast as CVODE, {low_high['Radau']} times as Radau and "
        f"{low_high['LSODA']} times as LSODA"
    )
    yield from _accuracy_of_the_benchmark()
    yield from _over_gate_scenes()
    yield from settled()
    yield from _sensitivities()
    from tests.extremes.cases import CASES as EXTREMES

    yield f"`tests/extremes` runs {len(EXTREMES)} cases at every fidelity and method"


def _accuracy_of_the_benchmark():
    """Which cases keep the tolerance, how long steps may be, what an iteration costs, memory."""
    gates = [case for case in CASES if "example" not in case]
    kept = sum("error" not in usual(case)[0]["verdict"] for case in gates)
    yield f"A tolerance of 1e-3 keeps an error of 1e-3 in {kept} of the {len(gates)} gate cases"
    heavy = fastest("7003C-spindle 20,000 r/min, 1000 N radial")
    tolerance, longest = settings_of(heavy)
    yield (
        f"the spindle under 1000 N needs {tolerance} with steps up to {longest} us, at "
        f"{rounded(heavy['sim/CPU'])}"
    )
    slow = [fastest(f"7003C-bare {rpm} r/min") for rpm in ("1,000", "10,000")]
    assert all(one["setting"].endswith("h <= 40 us") for one in slow)
    yield (
        "40 us at 1,000 and 10,000 r/min, where the speed is "
        f"{rounded(slow[0]['sim/CPU'])} and {rounded(slow[1]['sim/CPU'])}"
    )
    agreed = max(float(one["two integrators agree to"]) for one in table("benchmark", "References"))
    yield f"agree to {rounded(str(agreed), 1)} or better over the window of each case"
    memory = table("benchmark", "Memory of an instance")
    silent, loud = (
        sorted({float(one["in all"].split()[0]) for one in memory if one["radiator"] == radiator})
        for radiator in ("none", "with sound")
    )
    yield (
        f"An instance takes {silent[-1]:g} MB, "
        f"with boundary-element sound {loud[0]:g} to {loud[-1]:g} MB (goal 3)"
    )
    terms = row(
        "benchmark",
        "Cost of terms",
        scene="7003C-spindle 20,000 r/min",
        variant="all terms, 5 strips",
    )
    single = row("sets", case="single 7003C on a rotor")
    yield (
        f"An iteration costs {rounded(single['us per bearing and iteration'])} us ([sets](results/sets.md)), "
        f"the right-hand side {rounded(terms['right-hand side, us'])} us"
    )
    text = (RESULTS / "tradeoff.md").read_text("utf-8")
    agreed = re.search(r"agree to (\S+) over the whole window", text)[1]
    yield f"holds {len(table('tradeoff'))} settings against a reference on which two integrators"
    yield f"two integrators agree to {rounded(agreed)} over the whole window"
    cases = {(one["scene"], one["r/min"], one["radial, N"]) for one in table("scenes")}
    yield f"has four settings over {len(cases)} cases"


def _over_gate_scenes():
    """Speed of full on example scenes over that on their gate scenes, both at 2e-3; error of its levels."""

    def of_full(scene, rpm):
        return row(
            "scenes", scene=scene, fidelity="full", tolerance="0.002", **{"r/min": rpm, "radial, N": "0"}
        )

    lines = []
    for scene, rpm in (
        ("7003C-bare", "20,000"), ("7003C-spindle", "20,000"), ("7009C-full-ceramic", "18,000"),
    ):  # fmt: skip
        own, gate = (float(of_full(name, rpm)["sim/CPU"]) for name in (scene, f"gate {scene}"))
        lines.append([f"{scene}, {rpm} r/min", f"{own / gate:.2f}"])
    yield rows("gates", lines)
    loudest = [
        abs(float(one["loudest, dB(A)"]))
        for one in table("scenes")
        if one["fidelity"] == "full" and one["tolerance"] == "0.002" and one["loudest, dB(A)"]
    ]
    yield f"Levels at the loudest microphone are within {max(loudest):.2f} dB(A) of the reference"


def _sensitivities():
    """What moves ring vibration."""
    inner = "inner ring rms, %"
    yield f"moves {len({one['parameter'] for one in table('sensitivity')})} assumed values"
    mass = [moved("mounting.rotor.mass_kg", to, inner) for to in ("0.96", "1.44")]
    yield f"rotor mass (20 %: {mass[0]:.0f} and {mass[1]:.0f} %)"
    damping = [moved("bearing.contact_damping_us", to, inner) for to in ("2", "3")]
    yield f"contact damping (20 %: {damping[0]:+.0f} and {damping[1]:.0f} %)"
    exponent = moved("imperfections.waviness_exponent", "1", inner)
    yield f"exponent ({exponent:+.0f} % from 1.35 to 1.0), inner race"
    yield f"seed ({moved('imperfections.seed', '2', inner):+.0f} %)"


def index():
    """How far apart the speeds of fidelities are."""
    names = [_fidelities()[key] for key in ("`full`, `esdirk4`, 25 us, 2e-3", "`response`")]
    slow, fast = (rounded(one["sim/CPU"]) for one in names)
    yield f"runs at {slow} or at {fast} simulated seconds per second"
    slow, fast = (rounded(_in_use(one)) for one in names)
    yield f"at {slow} or at {fast} where inputs move as in a co-simulation"


_IMPLICIT_STAGES = 5  # of a step of ESDIRK4


def spindle():
    """What sets cost, how large and how exact they are."""
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
    yield f"the modes between them, {row('sets', case='QBC, flexible shaft')['coordinates']} coordinates"
    stages = {
        one["case"]: f"{float(one['iterations']) / float(one['steps']) / _IMPLICIT_STAGES:.2g}"
        for one in table("sets")
    }
    yield (
        f"takes {stages['QBC, rigid shaft']} iterations a stage; a single bearing "
        f"takes {stages['single 7003C on a rotor']}"
    )
    errors = [float(one["error"]) for one in table("sets")]
    yield f"their ring velocities are within {rounded(str(max(errors)))} of a reference"


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


def sets():
    """Fidelities of the example sets, and what `auto` chooses."""
    lines = []
    for name, words in (("db", "DB, 15,000 r/min"), ("qbc", "QBC, 20,000 r/min")):
        default = {**_FULL, "strips": "5"}
        found_by = {
            "`full`": row(f"tradeoff_{name}", **default),
            "`rings`": row(f"tradeoff_{name}", **{**default, "fidelity": "rings", "method": ""}),
            "`response`": row(f"tradeoff_{name}", fidelity="response"),
        }
        for fidelity, found in found_by.items():
            exact = [*_cells(found)[:-1], rounded(found["dB(A)"]), rounded(found["sim/CPU"])]
            lines.append([f"{words}, {fidelity}", *exact])
        text = (RESULTS / f"tradeoff_{name}.md").read_text("utf-8")
        chosen = re.search(r"fidelity auto: (\w+) / (\w+)", text)
        yield f"for the {name.upper()} it takes `{chosen[1]}` by `{chosen[2]}`"
    yield rows("sets", lines)


def gallery():
    """Settings of the study, and the axial mode."""
    yield f"Error against speed of {len(table('tradeoff'))} settings"
    mode = float(row("axial_mode", **{"preload, N": "500"})["axial mode, Hz"])
    yield f"the axial mode at {1e-3 * mode:.1f} kHz"


def examples():
    """Critical speed of the spindle."""
    yield f"the critical speed of {critical_speed()} r/min"


def vibration():
    """What the vibration test reads, by class and piece, and each source alone."""
    lines = []
    for name, grade, rings, words in (
        ("7003C", "P2", "bend", ""), ("7003C", "P4", "bend", ""), ("7003C", "P5", "bend", ""),
        ("7003C", "P4", "round", ", rigid rings"), ("7009C", "P4", "bend", ""),
    ):  # fmt: skip
        for piece in ("soft", "firm"):
            case = {"bearing": name, "class": grade, "rings": rings}
            found = row("vibration", what=f"{piece} piece", **case)
            cells = [f"{found[f'{band} mean']} ({found[f'{band} std, %']})" for band in "LMH"]
            lines.append([f"{name}, {grade}{words}, {piece}", found["seeds"], *cells])
    yield rows("classes", lines)
    alone = []
    for source in ("inner race", "outer race", "ball sizes", "form of the balls"):
        case = {"bearing": "7003C", "class": "P4", "rings": "bend", "what": f"{source} alone"}
        cells = [row("vibration", **case)[f"{band} mean"] for band in "LMH"]
        alone.append([source, *cells])
    yield rows("sources", alone)


def modes():
    """The axial mode over preload, what excites it, and the vibration."""
    places = (0, 3, 5, 6)  # of the columns after the preload
    with (RESULTS / "axial_mode.csv").open(encoding="utf-8", newline="") as file:
        _, *lines = csv.reader(file)
    shown = [[line[0], *(line[1 + k] for k in places)] for line in lines if line[0] in _PRELOADS]
    yield rows("axial mode", shown)
    at = {line[0]: line[1:] for line in lines}["500"]
    yield f"There f_i meets the axial mode at {float(at[2]):,.0f} r/min, {float(at[3]):.1f} % above operation"


_PRELOADS = ("200", "300", "400", "500", "650", "800")


PAGES = {
    "../paper.md": paper, "examples.md": examples, "gallery.md": gallery, "choosing.md": choosing,
    "coupling.md": coupling, "index.md": index, "limits.md": limits, "modes.md": modes,
    "fidelities/full.md": full, "fidelities/rings.md": rings, "fidelities/response.md": response,
    "spindle.md": spindle, "tradeoff.md": sets, "validation.md": validation,
    "vibration.md": vibration,
}  # fmt: skip


if __name__ == "__main__":
    from tests import computed

    for pages in (PAGES, computed.PAGES):
        for page, parts in pages.items():
            print(page, *write(page, parts()), sep="\n  ")
