"""Friction torque, where it comes from, and where its heat goes."""

import numpy as np

from fmu_bearing.design.heat import ARISES, GOES
from fmu_bearing.design.torque_range import CAPTION, TorqueRange, torque_range
from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import EngineError
from fmu_bearing.reports.data.curves import curve, curve_words, last_turns
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Block, Chart, Section, Table, Words
from fmu_bearing.results.table import number

_SHARES = {
    "contacts": (ARISES["sliding"], "inner_ring"),
    "rolling": (ARISES["rolling"], "outer_ring"),
    "cage": (ARISES["cage"], "cage"),
    "drag": (ARISES["drag"], "balls"),
}
_HEATS = {
    "inner_ring": (GOES["inner_ring"], "inner_ring"),
    "outer_ring": (GOES["outer_ring"], "outer_ring"),
    "oil": (GOES["oil"], "balls"),
}


def friction(subject: Subject) -> Section:
    """Torque and heat over time, their means and shares."""
    subject.output("friction_torque")  # says what is missing
    blocks: list[Block] = [_torque(subject)]
    if subject.has("heat.inner_ring"):
        blocks.append(_heats(subject))
    settled = _settled(subject)
    blocks.append(_table(subject, settled))
    if settled is not None:
        blocks.append(range_table(settled))
    if subject.fidelity in ("rings", "response"):
        blocks.append(
            Words(
                f"With fidelity {subject.fidelity}, torque and heats are computed for the steady state at "
                "the present inputs.",
                "note",
            )
        )
    return Section("friction", "Friction and heat", blocks)


def _curves(subject: Subject, names: dict[str, tuple[str, str]], factor: float) -> list[dict]:
    """Traces over time of variables given with words and colour."""
    traces = []
    for name, (words, tint) in names.items():
        if not subject.has(name):
            continue
        line = {"color": look.colour(tint), "width": 1.3}
        traces += [part | {"line": line} for part in curve(subject, factor * subject.output(name), words)]
    return traces


def _torque(subject: Subject) -> Chart:
    figure = look.figure(height=360)
    names = {"friction_torque": ("torque taken from the shaft", "total")}
    names |= {f"friction_torque_share.{key}": value for key, value in _SHARES.items()}
    for trace in _curves(subject, names, 1e3):
        figure.add_scatter(**trace, hovertemplate="%{x:.4f} s: %{y:.3f} N mm<extra>%{fullData.name}</extra>")
    window = last_turns(subject)
    figure.update_layout(
        xaxis=look.axis("time after initialisation, s", range=window.options[0].layout["xaxis.range"]),
        yaxis=look.axis("torque, N mm"),
    )
    return Chart(
        "torque", "Friction torque and its shares", figure,
        f"Friction torque over time, {1e3 * subject.mean('friction_torque'):.3g} N mm in the mean, and its "
        f"shares by "
        "source.",
        (window,),
        note="A share is the power lost there over the shaft speed. The torque taken from the shaft also "
        "stores and gives "
        f"back energy, so it varies about the shares' sum. {curve_words(subject)}",
    )  # fmt: skip


def _heats(subject: Subject) -> Chart:
    figure = look.figure(height=320)
    names = {f"heat.{key}": value for key, value in _HEATS.items()}
    for trace in _curves(subject, names, 1.0):
        figure.add_scatter(**trace, hovertemplate="%{x:.4f} s: %{y:.3f} W<extra>%{fullData.name}</extra>")
    window = last_turns(subject)
    figure.update_layout(
        xaxis=look.axis("time after initialisation, s", range=window.options[0].layout["xaxis.range"]),
        yaxis=look.axis("heat, W", rangemode="tozero"),
    )
    total = sum(subject.mean(name) for name in names)
    return Chart(
        "heat", "Heat by where it goes", figure,
        f"Heat to inner ring, outer ring and oil over time; {total:.3g} W in all in the mean.",
        (window,),
        note="Means over each communication step. Half of what a contact loses heats its ring, all else "
        f"goes to oil and balls. {curve_words(subject)}",
    )  # fmt: skip


def _settled(subject: Subject) -> TorqueRange | None:
    """Range of the settled torque at the mean speed; None without scene or equilibrium."""
    scene = subject.recording.scene
    if scene is None:
        return None
    try:
        return torque_range(scene.replace({"operation.speed_rpm": subject.speed / RPM}))
    except EngineError:
        return None


def range_table(found: TorqueRange) -> Table:
    """Return the inputs of a range with their ends, and the torque at them."""
    columns, rows = found.table()
    return Table(
        f"{CAPTION[0].upper()}{CAPTION[1:]}", columns, rows,
        note="The changes are added as roots of squares, upwards and downwards apart.",
    )  # fmt: skip


def _table(subject: Subject, settled: TorqueRange | None) -> Table:
    speed = abs(subject.speed)
    rows = []
    shares = {
        key: subject.mean(f"friction_torque_share.{key}")
        for key in _SHARES
        if subject.has(f"friction_torque_share.{key}")
    }
    whole = sum(shares.values())
    for key, value in shares.items():
        share = f"{100.0 * value / whole:.1f}" if whole else ""
        rows.append([_SHARES[key][0], f"{1e3 * value:.3f}", f"{abs(value) * speed:.3f}", share])
    torque = subject.output("friction_torque")
    if shares:
        rows.append(
            ["all shares", f"{1e3 * whole:.3f}", f"{abs(whole) * speed:.3f}", "100.0" if whole else ""]
        )
    mean = float(np.mean(torque))
    rows.append(["torque taken from the shaft", f"{1e3 * mean:.3f}", f"{abs(mean) * speed:.3f}", ""])
    if settled is not None:
        rows.append(
            [
                "range of the settled torque",
                *(f"{number(one.low)} to {number(one.high)}" for one in settled.shown[0]),
                "",
            ]
        )
    for key, (words, _) in _HEATS.items():
        if subject.has(f"heat.{key}"):
            rows.append([f"heat to {words}", "", f"{subject.mean(f'heat.{key}'):.3f}", ""])
    return Table(
        "Friction and heat, means over the recording", ["", "torque, N mm", "power, W", "share, %"], rows
    )
