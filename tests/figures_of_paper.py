"""Sentences of the software paper, made from the tables and from pages that are made from tables."""

import re

from tests.figures_of_settled import settled
from tests.tables import CASES, DOCS, fastest, rounded, row, table, usual

_HEADING = "In short, misses first"
_PAPERS = (
    ("multi-source", "levels measured round a motor spindle [@multisource]"),
    (
        "sound-field",
        "levels, falls and directivities measured beside a spindle with a bearing of ceramics [@yan2020]",
    ),
    ("impact-noise", "values that others computed by finite and boundary elements [@kuan2026]"),
)

_GOAL = 3.0  # dB rms: of each paper's page


def paper():
    """All that the paper says in figures, but for years and names."""
    yield from _measured()
    yield from _papers()
    yield from _beside_other_programs()
    yield from _within()


def _row(source, what):
    """Row of the short table on what others measured."""
    (found,) = (
        one
        for one in table("../measured", _HEADING)
        if one["source"].startswith(f"[{source}]") and what in one["what"]
    )
    return found


def _measured():
    text = (DOCS / "measured.md").read_text("utf-8")
    values, sources = re.search(r"computes: (\d+) values from (\d+) sources", text).groups()
    yield f"{values} values from {sources} sources"
    verdicts = [one[""] for one in table("../measured", _HEADING)]
    goals = [one for one in verdicts if one in ("met", "**missed**")]
    yield f"{goals.count('**missed**')} of {len(goals)} goals are missed"
    nsk, tpi = _row("NSK", "stiffness of pairs"), _row("TPI", "stiffness of pairs")
    for name, found, of in ("NSK", nsk, "0.52 and 0.53"), ("TPI", tpi, "0.522 for both races"):
        assert of in found["what"]
        median, rms = re.search(r"median ([\d.]+), rms ([\d.]+) %", found["found"]).groups()
        yield (
            f"The stiffness of {found['values']} pairs printed by {name} is met with a median ratio of "
            f"{median} and {rms} % rms"
        )
    skf = _row("SKF", "torque")
    within, median = re.search(r"(\d+) within, median ([\d.]+)", skf["found"]).groups()
    yield f"{within} of {skf['values']} torques lie within {skf['goal'].split('within ')[1].split(',')[0]}"
    yield f"with a median of {median}"
    heat = _row("NASA TP-2275", "heat")
    ratios = [float(one["ours over theirs"]) for one in table("measured") if one["source"] == "tp2275"]
    assert [f"{one:.2f}" for one in ratios] == heat["found"].split(";")[0].split(", ")
    own, theirs = re.search(r"exponent of the speed ([\d.]+) against ([\d.]+)", heat["found"]).groups()
    goal = heat["goal"]
    yield f"is {min(ratios):.2f} to {max(ratios):.2f} times as large here as measured (goal: {goal})"
    yield f"grows with the speed to the power {own} in place of {theirs}"
    lift, limit = _row("Rules of makers", "lift-off"), _row("NTN", "friction coefficient")
    yield f"lift-off load of pairs is {lift['found']} of a makers' rule (goal: {lift['goal']})"
    median = re.search(r"median (\S+),", limit["found"])[1]
    yield f"friction coefficient has a median of {median} (goal: {limit['goal']})"
    cage = _row("CWRU", "cage")
    yield f"differs from that in {cage['values']} recordings by {cage['found']}"


def _papers():
    for name, words in _PAPERS:
        text = " ".join((DOCS / "papers" / f"{name}.md").read_text("utf-8").split())
        count, rms = re.search(r"\*\*Predicted:\*\* (\d+) values are ([\d.]+) dB rms off", text).groups()
        verdict = "met" if float(rms) <= _GOAL else "missed"
        yield f"{rms} dB rms for {count} {words} ({verdict})"
    yield f"The goal is {_GOAL:g} dB rms"


def _beside_other_programs():
    gates = [case for case in CASES if "example" not in case]
    lines = [usual(case)[0] for case in gates]
    span = {
        peer: "{:.0f} to {:.0f}".format(*(f(float(one[f"x {peer}"]) for one in lines) for f in (min, max)))
        for peer in ("EXUDYN", "CVODE", "Radau", "LSODA")
    }
    yield f"is {span['EXUDYN']} times as fast as the ball bearing of EXUDYN"
    yield (
        f"{span['CVODE']} times as fast as CVODE, {span['Radau']} times as Radau and {span['LSODA']} times "
        "as LSODA"
    )
    met = sum(one["verdict"] == "met" for one in lines)
    faster = sum(fastest(case)["verdict"] == "met" for case in gates)
    yield (
        f"Of {len(gates)} cases with goals of speed and error `full` meets {met} at its usual setting, and "
        f"{faster} at its fastest setting within the error of 0.1 %"
    )
    case = "7003C-spindle 20,000 r/min"
    speeds = [rounded(one["sim/CPU"]) for one in usual(case)]
    yield (
        f"the spindle at 20,000 r/min runs at {speeds[0]} (`full`), {speeds[1]} (`rings`) and {speeds[2]} "
        "(`response`) simulated seconds per second"
    )
    response = [
        float(re.search(r"outer ([+-][\d.]+)%", usual(one)[2]["remark"])[1]) for one in _with_response()
    ]
    yield (
        f"rms velocity of the outer ring by `response` differs from that by `full` by "
        f"{min(map(abs, response)):.1f} to {max(map(abs, response)):.1f} %"
    )
    roots = [abs(float(one["own, three planes, Hz"]) / float(one["ROSS, Hz"]) - 1.0) for one in table("ross")]
    most = f"{max(roots):.0e}"
    yield f"{len(roots)} natural frequencies of a shaft that ROSS computes from them agree to {most}"


def _with_response():
    return [case for case in CASES if "example" not in case and usual(case)[2]]


def _within():
    """How `full` agrees with the operating point."""
    yield next(one for one in settled() if "agree with both runs" in one)
    terms = row(
        "benchmark", "Cost of terms", scene="7003C-spindle 20,000 r/min", variant="all terms, 5 strips"
    )
    yield f"{rounded(terms['right-hand side, us'])} us for one evaluation of all forces"
